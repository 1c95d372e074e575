//! The cameras of a document, through an animation.

use glam::DAffine3;

use super::document::{Document, Lens as Optics};
use crate::posed::Stand;
use genga::maths;
use genga::motion::{CameraPath, CameraPose, Lens};

/// Most cameras whose ways are read: those of a lying file could fill the memory.
const MOST: usize = 16;

/// The nodes that carry a camera, with its lens, and their ways so far.
pub(super) struct Cameras {
    nodes: Vec<(usize, Lens)>,
    paths: Vec<CameraPath>,
}

impl Cameras {
    /// Finds the cameras, in the order of their nodes.
    pub(super) fn new(document: &Document) -> Self {
        let carried = document.nodes.iter().enumerate();
        let carried = carried.filter_map(|(node, data)| {
            let optics = document.cameras.get(data.camera?)?;
            let name = data.name.clone().or_else(|| optics.name.clone());
            let name = name.unwrap_or_else(|| format!("of node {node}"));
            Some(((node, lens(optics)?), CameraPath { name, poses: Vec::new() }))
        });
        let (nodes, paths) = carried.take(MOST).unzip();
        Self { nodes, paths }
    }

    /// Adds a frame, on which the nodes stand so in the world.
    pub(super) fn add(&mut self, world: &[DAffine3]) {
        for ((node, lens), path) in self.nodes.iter().zip(&mut self.paths) {
            let Stand { place, turn } = Stand::new(&world[*node]);
            path.poses.push(CameraPose { place, turn, lens: *lens });
        }
    }

    /// Returns the first camera that moves, or else the first.
    pub(super) fn path(mut self) -> Option<CameraPath> {
        let first = self.paths.iter().position(CameraPath::moves).unwrap_or(0);
        (first < self.paths.len()).then(|| self.paths.swap_remove(first))
    }
}

/// Returns what a camera sees; `None` if it does not say.
fn lens(optics: &Optics) -> Option<Lens> {
    let perspective = optics.perspective.as_ref().filter(|_| optics.kind != "orthographic");
    let angle = perspective.map(|lens| Lens::Perspective(2.0 * maths::tan(0.5 * lens.yfov)));
    angle.or_else(|| Some(Lens::Orthographic(2.0 * optics.orthographic.as_ref()?.ymag)))
}
