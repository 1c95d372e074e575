//! Names made unique.

use std::collections::{HashMap, HashSet};

use super::scanner::quoted;
use super::warnings::{NAME_TWICE, Notices};
use crate::motion::Joint;

/// Gives every joint a name of its own: of two joints `Hand` the second is `Hand.2`, unless there is
/// one. `at` is where the names stand.
pub(super) fn make_unique(joints: &mut [Joint], at: &[usize], notices: &mut Notices) {
    let names: Vec<&str> = joints.iter().map(|joint| &joint.name[..]).collect();
    for (joint, name) in renamed(&names) {
        let old = std::mem::replace(&mut joints[joint].name, name);
        notices.add(NAME_TWICE, at[joint], || {
            let new = quoted(joints[joint].name.as_bytes());
            format!("two joints are called {}; this one is called {new}", quoted(old.as_bytes()))
        });
    }
}

/// New names for those that stand there a second time, with their index. Linear in the names: no
/// candidate is tried twice, and one is taken only if it is a name itself.
pub(in crate::motion::read) fn renamed(names: &[&str]) -> Vec<(usize, String)> {
    let taken: HashSet<&str> = names.iter().copied().collect();
    if taken.len() == names.len() {
        return Vec::new();
    }
    let mut next: HashMap<&str, usize> = HashMap::new();
    let mut renamed = Vec::new();
    for (index, &name) in names.iter().enumerate() {
        let Some(number) = next.get_mut(name) else {
            next.insert(name, 2);
            continue;
        };
        loop {
            let candidate = format!("{name}.{number}");
            *number += 1;
            if !taken.contains(&candidate[..]) {
                renamed.push((index, candidate));
                break;
            }
        }
    }
    renamed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_come_again_get_a_number_that_no_name_has() {
        assert_eq!(renamed(&["a", "b"]), []);
        let renamed = renamed(&["a", "a", "a.2", "a", "a.2", "b", "a"]);
        let expected = [(1, "a.3"), (3, "a.4"), (4, "a.2.2"), (6, "a.5")];
        assert_eq!(renamed, expected.map(|(index, name)| (index, name.to_owned())));
    }
}
