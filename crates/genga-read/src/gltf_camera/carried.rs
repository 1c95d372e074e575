//! Finds the cameras that nodes carry.

use glam::DAffine3;

use crate::gltf::Document;
use genga::error::Error;

/// A camera that a node carries.
#[derive(Debug)]
pub(super) struct Carried<'a> {
    pub(super) node: usize,
    /// The names of the node and of the camera, as far as they exist.
    pub(super) names: Vec<&'a str>,
    pub(super) is_orthographic: bool,
}

impl Carried<'_> {
    pub(super) fn name(&self) -> String {
        self.names.first().map_or_else(|| format!("of node {}", self.node), ToString::to_string)
    }
}

/// The cameras of a document, with the parents of its nodes.
pub(super) struct Cameras<'a> {
    document: &'a Document,
    parents: Vec<Option<usize>>,
}

impl<'a> Cameras<'a> {
    pub(super) fn new(document: &'a Document) -> Result<Self, Error> {
        Ok(Self { document, parents: document.parents()? })
    }

    /// The cameras attached to nodes, in the order of the nodes.
    pub(super) fn all(&self) -> Vec<Carried<'a>> {
        let nodes = self.document.nodes.iter().enumerate();
        let carried = nodes.filter_map(|(node, data)| {
            let lens = self.document.cameras.get(data.camera?)?;
            Some(Carried {
                node,
                names: [&data.name, &lens.name].into_iter().flatten().map(String::as_str).collect(),
                is_orthographic: lens.kind == "orthographic",
            })
        });
        carried.collect()
    }

    /// World transform of a node.
    pub(super) fn place(&self, node: usize) -> DAffine3 {
        let nodes = &self.document.nodes;
        self.way_up(node).fold(DAffine3::IDENTITY, |below, node| nodes[node].local() * below)
    }

    /// Whether an animation moves a node or one of its ancestors.
    pub(super) fn is_animated(&self, node: usize) -> bool {
        let channels = self.document.animations.iter().flat_map(|animation| &animation.channels);
        let mut moved = channels.filter_map(|channel| channel.target.node);
        moved.any(|moved| self.way_up(node).any(|node| node == moved))
    }

    /// A node and its ancestors, from the node upwards.
    fn way_up(&self, node: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(node), |node| self.parents[*node])
    }
}
