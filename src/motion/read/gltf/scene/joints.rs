//! Which nodes are joints.

use std::collections::BTreeMap;

use super::super::document::{Document, Node};
use crate::motion::read::posed::join;

/// All nodes, parents first, the children of each in their order.
pub(super) fn order(document: &Document, parents: &[Option<usize>]) -> Vec<usize> {
    let mut open: Vec<usize> =
        (0..parents.len()).rev().filter(|node| parents[*node].is_none()).collect();
    let mut order = Vec::with_capacity(parents.len());
    while let Some(node) = open.pop() {
        order.push(node);
        open.extend(document.nodes[node].children.iter().rev());
    }
    order
}

/// The nodes that become joints, parents first, each with the place of its parent among them: bones of VRM and those
/// of skins; without such, what the animation moves and what hangs on it. Trees that hang on one node are one tree.
pub(super) fn of(
    document: &Document,
    parents: &[Option<usize>],
    moved: &[bool],
    called: &BTreeMap<usize, String>,
) -> Vec<(usize, Option<usize>)> {
    let order = order(document, parents);
    let mut chosen = vec![false; parents.len()];
    let bones = document.skins.iter().flat_map(|skin| skin.joints.iter().copied());
    for node in called.keys().copied().chain(bones) {
        chosen.get_mut(node).into_iter().for_each(|chosen| *chosen = true);
    }
    if !chosen.contains(&true) {
        chosen.copy_from_slice(moved);
        // What moves carries what hangs on it.
        for &node in &order {
            let Node { camera, mesh, .. } = &document.nodes[node];
            let is_seen = camera.is_some() || mesh.is_some();
            chosen[node] |= !is_seen && parents[node].is_some_and(|parent| chosen[parent]);
        }
    }
    join(&order, parents, &mut chosen, |_| true);
    let mut places: Vec<Option<usize>> = vec![None; parents.len()];
    let mut joints = Vec::new();
    for node in order {
        let carrier = parents[node].and_then(|parent| places[parent]);
        places[node] = carrier;
        if chosen[node] {
            places[node] = Some(joints.len());
            joints.push((node, carrier));
        }
    }
    joints
}
