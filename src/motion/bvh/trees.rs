//! Selects one of several trees in a file.

use std::ops::Range;

use super::hierarchy::Head;
use super::names::renamed;
use super::scanner::quoted;
use super::warnings::{Notices, ROOTS};
use crate::error::Error;
use crate::motion::{Joint, JointId};

/// Most trees listed in a message.
const MOST_NAMED: usize = 8;

/// Keeps the tree with the given root, or all trees. Several trees give a warning, because a captured prop
/// such as a sword must not be dropped unasked.
pub(super) fn choose(
    root: Option<&str>,
    head: &mut Head,
    notices: &mut Notices,
) -> Result<(), Error> {
    let trees = Tree::all(&head.skeleton.joints);
    match root {
        None if trees.len() == 1 => {}
        None => {
            let at = head.names_at[trees[1].joints.start];
            notices.add(ROOTS, at, || {
                let listed = listed(&trees, &head.skeleton.joints);
                format!(
                    "the file has {} trees, all of them used; --root takes one: {listed}",
                    trees.len()
                )
            });
        }
        Some(name) => match trees.iter().find(|tree| tree.name == name) {
            Some(tree) => select(tree.joints.clone(), head),
            None => {
                let listed = listed(&trees, &head.skeleton.joints);
                return Err(no_tree(name, &listed));
            }
        },
    }
    Ok(())
}

/// Builds the error that no tree has the requested root; `listed` names the existing ones.
pub fn no_tree(root: &str, listed: &str) -> Error {
    Error::setting("root", format!("no tree is called {root:?}; the file has {listed}"))
}

/// A root and all joints below it, which follow it contiguously.
struct Tree {
    /// The root's name; of two roots `Hips` the second is `Hips.2`.
    name: String,
    joints: Range<usize>,
}

impl Tree {
    fn all(joints: &[Joint]) -> Vec<Self> {
        let roots: Vec<usize> =
            (0..joints.len()).filter(|&joint| joints[joint].parent.is_none()).collect();
        let ends = roots.iter().skip(1).copied().chain([joints.len()]);
        let mut trees: Vec<Self> = roots
            .iter()
            .zip(ends)
            .map(|(&root, end)| Self { name: joints[root].name.clone(), joints: root..end })
            .collect();
        let names: Vec<&str> = roots.iter().map(|&root| &joints[root].name[..]).collect();
        for (tree, name) in renamed(&names) {
            trees[tree].name = name;
        }
        trees
    }

    /// Whether the tree has a hip and a head.
    fn is_a_body(&self, joints: &[Joint]) -> bool {
        let has = |parts: &[&str]| {
            joints[self.joints.clone()].iter().any(|joint| {
                let name = joint.name.to_lowercase();
                parts.iter().any(|part| name.contains(part))
            })
        };
        has(&["hip", "pelvis", "腰"]) && has(&["head", "頭"])
    }
}

fn listed(trees: &[Tree], joints: &[Joint]) -> String {
    let describe = |tree: &Tree| {
        let count = tree.joints.len();
        let s = if count == 1 { "" } else { "s" };
        let body = if tree.is_a_body(joints) { ", with hip and head" } else { "" };
        format!("{} ({count} joint{s}{body})", quoted(tree.name.as_bytes()))
    };
    let mut names: Vec<String> = trees.iter().take(MOST_NAMED).map(describe).collect();
    if trees.len() > MOST_NAMED {
        names.push(format!("{} more", trees.len() - MOST_NAMED));
    }
    names.join(", ")
}

/// Keeps only the joints of one tree and their channels.
fn select(tree: Range<usize>, head: &mut Head) {
    let channels =
        |joints: &[Joint]| joints.iter().map(|joint| joint.channels.len()).sum::<usize>();
    let joints = &mut head.skeleton.joints;
    let first = channels(&joints[..tree.start]);
    head.columns.select(first..first + channels(&joints[tree.clone()]));
    joints.truncate(tree.end);
    joints.drain(..tree.start);
    head.names_at.truncate(tree.end);
    head.names_at.drain(..tree.start);
    for joint in joints {
        joint.parent = joint.parent.map(|parent| JointId(parent.0 - tree.start));
        joint.first_channel -= first;
    }
}
