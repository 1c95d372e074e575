//! The skeleton as glTF has it: nodes, a skin that lists them, and a mesh to see them by.

use std::collections::HashSet;

use glam::DVec3;
use serde_json::{Value, json};

use super::Space;
use super::binary::{Binary, Use};
use crate::error::Error;
use crate::motion::Skeleton;

/// Where an octahedron is widest, and how wide, as a share of its length.
const WAIST: f64 = 0.1;
/// Half the size of the one octahedron of a body without any bone, in metres.
const LONELY: f64 = 0.05;

/// A joint or the tip of a bone.
struct Node {
    name: String,
    parent: Option<usize>,
    /// From the parent at rest, in metres.
    offset: DVec3,
}

/// The bones at rest. Rest rotations are the identity, as in BVH.
pub(super) struct Bones {
    nodes: Vec<Node>,
    /// Where each node stands in the world at rest.
    positions: Vec<DVec3>,
}

impl Bones {
    /// The joints in their order, then the End Sites as leaves.
    pub(super) fn of(skeleton: &Skeleton, space: Space) -> Result<Self, Error> {
        let joint = |joint: &crate::motion::Joint| Node {
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

    /// The nodes of the document. Several roots hang on one node more: a skin must have one root.
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

    /// The node that all others hang on.
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

    /// The skin: all joints and tips, and the way back from where each stands at rest.
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

    /// An octahedron a bone, each on the joint that turns it. The bone of a joint leads to its child.
    pub(super) fn mesh(&self, binary: &mut Binary) -> Value {
        let mut octahedra = self.octahedra();
        if octahedra.is_empty() {
            let (half, at) = (0.5 * LONELY * DVec3::Y, self.positions[0]);
            octahedra.push((0, octahedron(at - half, at + half)));
        }
        let corners: Vec<[f32; 3]> =
            octahedra.iter().flat_map(|(_, corners)| corners.map(floats)).collect();
        let carriers = octahedra.iter().flat_map(|(joint, corners)| corners.map(|_| *joint));
        let joints = if self.nodes.len() > 255 {
            let joints: Vec<[u16; 4]> = carriers.map(|joint| [joint as u16, 0, 0, 0]).collect();
            binary.add(Use::Vertices, "VEC4", &joints)
        } else {
            let joints: Vec<[u8; 4]> = carriers.map(|joint| [joint as u8, 0, 0, 0]).collect();
            binary.add(Use::Vertices, "VEC4", &joints)
        };
        let weights = vec![[1.0f32, 0.0, 0.0, 0.0]; corners.len()];
        json!({
            "name": "bones",
            "primitives": [{
                "attributes": {
                    "POSITION": binary.add_bounded(Use::Vertices, "VEC3", &corners),
                    "JOINTS_0": joints,
                    "WEIGHTS_0": binary.add(Use::Vertices, "VEC4", &weights),
                },
                "indices": triangles(octahedra.len(), binary),
                "material": 0,
            }],
        })
    }

    /// The joint and the corners of every bone that has a length.
    fn octahedra(&self) -> Vec<(usize, [DVec3; 6])> {
        let bone = |(node, data): (usize, &Node)| {
            let joint = data.parent.filter(|_| data.offset.length() > 0.0)?;
            Some((joint, octahedron(self.positions[joint], self.positions[node])))
        };
        self.nodes.iter().enumerate().filter_map(bone).collect()
    }
}

/// What the bones are made of: without it a viewer takes metal, which is black without surroundings.
pub(super) fn material() -> Value {
    json!({
        "name": "bones",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.72, 0.74, 0.78, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.8,
        },
    })
}

/// The corners of a bone: its joint, four round its waist, its tip.
fn octahedron(from: DVec3, to: DVec3) -> [DVec3; 6] {
    let along = to - from;
    let (a, b) = along.normalize_or(DVec3::Y).any_orthonormal_pair();
    let (waist, radius) = (from + WAIST * along, WAIST * along.length());
    let corner = |out: DVec3| waist + radius * out;
    [from, corner(a), corner(b), corner(-a), corner(-b), to]
}

/// The triangles of one octahedron, each seen counter-clockwise from outside.
const FACES: [[u32; 3]; 8] =
    [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [5, 1, 2], [5, 2, 3], [5, 3, 4], [5, 4, 1]];

fn triangles(octahedra: usize, binary: &mut Binary) -> usize {
    let corners = (0..octahedra as u32)
        .flat_map(|octahedron| FACES.as_flattened().iter().map(move |at| [6 * octahedron + at]));
    if 6 * octahedra <= usize::from(u16::MAX) {
        let corners: Vec<[u16; 1]> = corners.map(|[corner]| [corner as u16]).collect();
        return binary.add(Use::Triangles, "SCALAR", &corners);
    }
    binary.add(Use::Triangles, "SCALAR", &corners.collect::<Vec<_>>())
}

/// A name that no other node has: the wish, or the wish with a number.
fn free_name(taken: &HashSet<String>, wish: &str) -> String {
    let numbered = (2..).map(|number| format!("{wish}{number}"));
    let mut names = std::iter::once(wish.to_owned()).chain(numbered);
    names.find(|name| !taken.contains(name)).expect("one of endlessly many names is free")
}

fn floats(vector: DVec3) -> [f32; 3] {
    vector.as_vec3().to_array().map(|value| value + 0.0)
}
