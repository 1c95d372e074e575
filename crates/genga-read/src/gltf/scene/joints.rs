//! Chooses the nodes that become joints.

use std::collections::BTreeMap;

use super::super::document::{Document, Node};
use super::{Motion, Moved};
use crate::posed::{Nodes, join};

/// All nodes, parents first, with the children of each in their order.
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

/// Chooses the nodes that become joints, parents first, each with the index of its parent joint: the bones of VRM and of skins, and the moving nodes in their trees or, without such
/// bones, the nodes that the animation moves and the nodes that hang on them. Trees that hang on one node
/// are joined.
pub(super) fn find(
    document: &Document,
    parents: &[Option<usize>],
    motion: &Motion,
    called: &BTreeMap<usize, String>,
) -> Vec<(usize, Option<usize>)> {
    let order = order(document, parents);
    let is_seen = |Node { camera, mesh, .. }: &Node| camera.is_some() || mesh.is_some();
    let is_seen: Vec<bool> = document.nodes.iter().map(is_seen).collect();
    let mut chosen = vec![false; parents.len()];
    let bones = document.skins.iter().flat_map(|skin| skin.joints.iter().copied());
    for node in called.keys().copied().chain(bones) {
        chosen.get_mut(node).into_iter().for_each(|chosen| *chosen = true);
    }
    if chosen.contains(&true) {
        let moves: Vec<bool> = motion.nodes.iter().map(Moved::moves).collect();
        let nodes = Nodes { order: &order, parents, moves: &moves, is_seen: &is_seen };
        nodes.choose_moving(&mut chosen);
    } else {
        // A camera that moves is no body, unless nothing else moves.
        let is_camera = |node: usize| document.nodes[node].camera.is_some();
        let is_body = |node: usize| motion.nodes[node].is_moved() && !is_camera(node);
        let has_body = order.iter().any(|node| is_body(*node));
        // Nodes that hang on a moving node move with it.
        for &node in &order {
            let hangs = !is_seen[node] && parents[node].is_some_and(|parent| chosen[parent]);
            let moves = if has_body { is_body(node) } else { motion.nodes[node].is_moved() };
            chosen[node] = moves || hangs;
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
