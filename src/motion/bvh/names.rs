//! Makes joint names unique.

use std::collections::{HashMap, HashSet};

use super::scanner::quoted;
use super::warnings::{NAME_TWICE, Notices};
use crate::motion::Joint;

/// Gives every joint a unique name: the second of two joints `Hand` becomes `Hand.2`, or the next free
/// number. `at` holds the byte offset of each name.
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

/// New names for repeated ones, with their index. Runs in linear time: no candidate is tried twice, and a
/// candidate is rejected only if it is itself one of the names.
pub fn renamed(names: &[&str]) -> Vec<(usize, String)> {
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
