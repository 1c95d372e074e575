//! The skeleton in glTF: its nodes, and a skin that lists them.
//! The octahedra are in `mesh.rs`.

use std::collections::HashSet;

use glam::DVec3;
use serde_json::{Value, json};

use super::Space;
use super::binary::{Binary, Use};
use genga::error::Error;
use genga::motion::Skeleton;

/// A joint or the tip of a bone.
struct Node {
    name: String,
    parent: Option<usize>,
    /// Offset from the parent at rest, in metres.
    offset: DVec3,
}

/// The bones at rest. Rest rotations are the identity, as in BVH.
pub(super) struct Bones {
    nodes: Vec<Node>,
    /// World position of each node at rest.
    positions: Vec<DVec3>,
}

impl Bones {
    /// Collects the joints in their order, then the End Sites as leaves.
    pub(super) fn new(skeleton: &Skeleton, space: Space) -> Result<Self, Error> {
        let joint = |joint: &genga::motion::Joint| Node {
            name: joint.name.clone(),
            parent: joint.parent.map(|parent| parent.0),
            offset: space.position(joint.offset),
        };
        let mut nodes: Vec<Node> = skeleton.joints.iter().map(joint).collect();
        let mut taken: HashSet<String> = nodes.iter().map(|node| node.name.clone()).collect();
        for (joint, data) in skeleton.iter() {
            for end in &data.end_sites {
                let name = free_name(&taken, &format!("{}_end", data.name));
                taken.insert(name.clone());
                let offset = space.position(end.offset);
                nodes.push(Node { name, parent: Some(joint.0), offset });
            }
        }
        if nodes.is_empty() {
            return Err(Error::clip("the clip has no joint: there is nothing to write"));
        }
        if nodes.len() > usize::from(u16::MAX) {
            let message = format!("{} joints; a GLB's skin can list 65535", nodes.len());
            return Err(Error::clip(message));
        }
        let mut positions: Vec<DVec3> = Vec::with_capacity(nodes.len());
        for node in &nodes {
            let carrier = node.parent.map_or(DVec3::ZERO, |parent| positions[parent]);
            positions.push(carrier + node.offset);
        }
        Ok(Self { nodes, positions })
    }

    /// Builds the document's nodes. Several roots get a common parent, because a skin must have a single root.
    pub(super) fn nodes(&self) -> Vec<Value> {
        let mut children = vec![Vec::new(); self.nodes.len()];
        for (node, data) in self.nodes.iter().enumerate() {
            data.parent.into_iter().for_each(|parent| children[parent].push(node));
        }
        let document = |(node, children): (&Node, Vec<usize>)| {
            let mut document = json!({ "name": node.name, "translation": floats(node.offset) });
            if !children.is_empty() {
                document["children"] = children.into();
            }
            document
        };
        let mut nodes: Vec<Value> = self.nodes.iter().zip(children).map(document).collect();
        if let roots @ [_, _, ..] = &self.roots()[..] {
            nodes.push(json!({ "name": "roots", "children": roots }));
        }
        nodes
    }

    /// Index of the root node.
    pub(super) fn root(&self) -> usize {
        match self.roots()[..] {
            [root] => root,
            _ => self.nodes.len(),
        }
    }

    fn roots(&self) -> Vec<usize> {
        let nodes = self.nodes.iter().enumerate();
        nodes.filter(|(_, node)| node.parent.is_none()).map(|(node, _)| node).collect()
    }

    /// Builds the skin: all joints and tips with their inverse bind matrices.
    pub(super) fn skin(&self, binary: &mut Binary) -> Value {
        let back = |position: &DVec3| {
            let [x, y, z] = floats(-*position);
            [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., x, y, z, 1.]
        };
        let matrices: Vec<[f32; 16]> = self.positions.iter().map(back).collect();
        json!({
            "joints": (0..self.nodes.len()).collect::<Vec<_>>(),
            "skeleton": self.root(),
            "inverseBindMatrices": binary.add(Use::Data, "MAT4", &matrices),
        })
    }

    /// Number of nodes.
    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// World position of each node at rest, in metres.
    pub(super) fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// Lists the bones that have a length, each as joint, tip and name. The bone leads from the joint that turns
    /// it to the tip, and has the tip's name.
    pub(super) fn bones(&self) -> impl Iterator<Item = (usize, usize, &str)> {
        self.nodes.iter().enumerate().filter_map(|(tip, node)| {
            let joint = node.parent.filter(|_| node.offset.length() > 0.0)?;
            Some((joint, tip, node.name.as_str()))
        })
    }
}

/// A unique node name: the wanted one, numbered if taken.
fn free_name(taken: &HashSet<String>, wish: &str) -> String {
    let numbered = (2..).map(|number| format!("{wish}{number}"));
    let mut names = std::iter::once(wish.to_owned()).chain(numbered);
    names.find(|name| !taken.contains(name)).expect("one of endlessly many names is free")
}

pub(crate) fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array().map(|value| value + 0.0)
}
