//! The cameras that nodes carry.

use glam::DAffine3;

use crate::error::Error;
use crate::motion::read::gltf::Document;

/// A camera that a node carries.
#[derive(Debug)]
pub(super) struct Carried<'a> {
    pub(super) node: usize,
    /// The node's name and its own, as far as they have one.
    pub(super) names: Vec<&'a str>,
    pub(super) is_orthographic: bool,
}

impl Carried<'_> {
    pub(super) fn name(&self) -> String {
        self.names.first().map_or_else(|| format!("of node {}", self.node), ToString::to_string)
    }
}

/// The cameras of a document, and what carries its nodes.
pub(super) struct Cameras<'a> {
    document: &'a Document,
    parents: Vec<Option<usize>>,
}

impl<'a> Cameras<'a> {
    pub(super) fn of(document: &'a Document) -> Result<Self, Error> {
        Ok(Self { document, parents: document.parents()? })
    }

    /// Those that stand somewhere, in the order of their nodes.
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

    /// Where a node stands in the world.
    pub(super) fn place(&self, node: usize) -> DAffine3 {
        let nodes = &self.document.nodes;
        self.way_up(node).fold(DAffine3::IDENTITY, |below, node| nodes[node].local() * below)
    }

    /// Whether an animation moves a node or what carries it.
    pub(super) fn is_animated(&self, node: usize) -> bool {
        let channels = self.document.animations.iter().flat_map(|animation| &animation.channels);
        let mut moved = channels.filter_map(|channel| channel.target.node);
        moved.any(|moved| self.way_up(node).any(|node| node == moved))
    }

    /// A node and all that carry it, from below.
    fn way_up(&self, node: usize) -> impl Iterator<Item = usize> {
        std::iter::successors(Some(node), |node| self.parents[*node])
    }
}
