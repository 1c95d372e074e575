//! A mesh that makes the skeleton visible: one octahedron per bone.

use glam::DVec3;
use serde_json::{Value, json};

use super::binary::{Binary, Use};
use super::bones::{Bones, floats};
use genga::motion::BodySide;

/// Position of an octahedron's widest point, and its radius there, as shares of its length.
const WAIST: f64 = 0.1;
/// Minimum radius of an octahedron, as a share of the whole skeleton's size, capped by a share of the bone's own
/// length. Without it a spine of many small joints would hardly be visible.
const LEAST: (f64, f64) = (0.011, 0.25);
/// Size in metres of the only octahedron of a body without bones.
const LONELY: f64 = 0.05;

/// The parts of the body with their colours, linear as in glTF. The colours match the pictures, except for the
/// trunk: a black mesh would show no shape.
const PARTS: [(BodySide, &str, [f64; 3]); 3] = [
    (BodySide::Trunk, "trunk", [0.45, 0.47, 0.5]),
    (BodySide::Left, "left", [0.0, 0.138, 0.434]),
    (BodySide::Right, "right", [0.73, 0.223, 0.0]),
];

/// The visible shape of a bone.
struct Octahedron {
    /// Index of the node that turns it.
    joint: usize,
    side: BodySide,
    corners: [DVec3; 6],
}

/// The material of a part. glTF's default is metal, which looks black without an environment.
fn material(name: &str, [red, green, blue]: [f64; 3]) -> Value {
    json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [red, green, blue, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 0.8,
        },
    })
}

/// Builds one mesh of all bones, each bound to the joint that turns it, and the materials. Each side of the body
/// that has bones is a primitive. `first` is the index of the first material.
pub(super) fn mesh(bones: &Bones, first: usize, binary: &mut Binary) -> (Value, Vec<Value>) {
    let octahedra = octahedra(bones);
    let corners = |octahedron: &Octahedron| octahedron.corners.map(floats);
    let corners: Vec<[f32; 3]> = octahedra.iter().flat_map(corners).collect();
    let carriers = octahedra.iter().flat_map(|octahedron| [octahedron.joint; 6]);
    let joints = if bones.len() > 255 {
        let joints: Vec<[u16; 4]> = carriers.map(|joint| [joint as u16, 0, 0, 0]).collect();
        binary.add(Use::Vertices, "VEC4", &joints)
    } else {
        let joints: Vec<[u8; 4]> = carriers.map(|joint| [joint as u8, 0, 0, 0]).collect();
        binary.add(Use::Vertices, "VEC4", &joints)
    };
    let weights = vec![[1.0f32, 0.0, 0.0, 0.0]; corners.len()];
    let attributes = json!({
        "POSITION": binary.add_bounded(Use::Vertices, "VEC3", &corners),
        "JOINTS_0": joints,
        "WEIGHTS_0": binary.add(Use::Vertices, "VEC4", &weights),
    });
    let (mut primitives, mut materials) = (Vec::new(), Vec::new());
    for (side, name, color) in PARTS {
        let of_side = octahedra.iter().enumerate().filter(|(_, bone)| bone.side == side);
        let of_side: Vec<u32> = of_side.map(|(number, _)| number as u32).collect();
        if !of_side.is_empty() {
            let indices = triangles(&of_side, corners.len(), binary);
            primitives.push(json!({
                "attributes": attributes,
                "indices": indices,
                "material": first + materials.len(),
            }));
            materials.push(material(name, color));
        }
    }
    (json!({ "name": "bones", "primitives": primitives }), materials)
}

/// One octahedron per bone that has a length, or a single upright one if no bone has.
fn octahedra(bones: &Bones) -> Vec<Octahedron> {
    let at = bones.positions();
    let low = at.iter().copied().fold(at[0], DVec3::min);
    let size = at.iter().copied().fold(at[0], DVec3::max) - low;
    let least = LEAST.0 * size.max_element();
    let bone = |(joint, tip, name): (usize, usize, &str)| Octahedron {
        joint,
        side: BodySide::from_name(name),
        corners: octahedron(at[joint], at[tip], least),
    };
    let mut octahedra: Vec<Octahedron> = bones.bones().map(bone).collect();
    if octahedra.is_empty() {
        let half = 0.5 * LONELY * DVec3::Y;
        let corners = octahedron(at[0] - half, at[0] + half, LONELY);
        octahedra.push(Octahedron { joint: 0, side: BodySide::Trunk, corners });
    }
    octahedra
}

/// The corners of a bone: its joint, four around its waist, its tip.
fn octahedron(from: DVec3, to: DVec3, least: f64) -> [DVec3; 6] {
    let along = to - from;
    let (a, b) = along.normalize_or(DVec3::Y).any_orthonormal_pair();
    let radius = (WAIST * along.length()).max(least.min(LEAST.1 * along.length()));
    let corner = |out: DVec3| from + WAIST * along + radius * out;
    [from, corner(a), corner(b), corner(-a), corner(-b), to]
}

/// The triangles of an octahedron, counter-clockwise as seen from outside.
const FACES: [[u32; 3]; 8] =
    [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [5, 1, 2], [5, 2, 3], [5, 3, 4], [5, 4, 1]];

/// Adds the triangles of some octahedra. `corners`, the number of all corners, decides the index type.
fn triangles(octahedra: &[u32], corners: usize, binary: &mut Binary) -> usize {
    let face = FACES.as_flattened();
    let indices = octahedra.iter().flat_map(|number| face.iter().map(move |at| [6 * number + at]));
    if corners <= usize::from(u16::MAX) {
        let indices: Vec<[u16; 1]> = indices.map(|[index]| [index as u16]).collect();
        return binary.add(Use::Triangles, "SCALAR", &indices);
    }
    binary.add(Use::Triangles, "SCALAR", &indices.collect::<Vec<_>>())
}
