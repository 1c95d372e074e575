//! A small stage as a GLB, for tests of several packages: a body of two bones with a skin, a camera that pans, a sword in
//! its hand, a prop with morphs, and a light.

use serde_json::{Value, json};

/// Keys of a second each: three a channel.
const TIMES: [f32; 3] = [0.0, 1.0, 2.0];

/// A document and its buffer.
pub(crate) struct Stage {
    pub(crate) document: Value,
    bytes: Vec<u8>,
}

impl Stage {
    /// Adds numbers, and returns the index of their accessor.
    pub(crate) fn add(&mut self, kind: &str, width: usize, numbers: &[f32]) -> usize {
        let offset = self.bytes.len();
        self.bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        let lists = ["bufferViews", "accessors"]
            .map(|list| self.document[list].as_array().map_or(0, Vec::len));
        let mut accessor = json!({
            "bufferView": lists[0], "componentType": 5126, "count": numbers.len() / width, "type": kind,
        });
        if width == 1 || kind == "VEC3" {
            let along = |axis: usize| numbers.iter().skip(axis).step_by(width).copied();
            let bound = |of: fn(f32, f32) -> f32| -> Vec<f32> {
                (0..width).map(|axis| along(axis).reduce(of).unwrap_or_default()).collect()
            };
            (accessor["min"], accessor["max"]) = (json!(bound(f32::min)), json!(bound(f32::max)));
        }
        let view = json!({ "buffer": 0, "byteOffset": offset, "byteLength": 4 * numbers.len() });
        for (list, element) in [("bufferViews", view), ("accessors", accessor)] {
            match self.document[list].as_array_mut() {
                Some(list) => list.push(element),
                None => self.document[list] = json!([element]),
            }
        }
        lists[1]
    }

    /// Adds keys at the three times to the animation.
    pub(crate) fn play(&mut self, node: usize, path: &str, between: &str, output: usize) {
        let input = self.add("SCALAR", 1, &TIMES);
        let animation = &mut self.document["animations"][0];
        let sampler = animation["samplers"].as_array().map_or(0, Vec::len);
        let channel = json!({ "sampler": sampler, "target": { "node": node, "path": path } });
        let own = json!({ "input": input, "output": output, "interpolation": between });
        for (list, element) in [("channels", channel), ("samplers", own)] {
            match animation[list].as_array_mut() {
                Some(list) => list.push(element),
                None => animation[list] = json!([element]),
            }
        }
    }

    /// Packs the file.
    pub(crate) fn glb(&self) -> Vec<u8> {
        let mut document = self.document.clone();
        document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let word = |number: usize| (number as u32).to_le_bytes();
        let length = 12 + 8 + text.len() + 8 + self.bytes.len();
        let head = [&b"glTF"[..], &word(2), &word(length), &word(text.len()), b"JSON"].concat();
        [head, text, word(self.bytes.len()).to_vec(), b"BIN\0".to_vec(), self.bytes.clone()]
            .concat()
    }
}

/// The camera slides two metres to the right in the second second. The morphs of the prop go from 0 to 1 and back, the
/// sword turns in steps, the hip turns and travels evenly, and the knee rests turned by a quarter.
pub(crate) fn stage() -> Stage {
    let half = 0.5_f32.sqrt();
    let document = json!({
        "asset": { "version": "2.0", "generator": "a test" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "name": "room", "children": [1, 4, 5, 6, 7] },
            { "name": "hip", "translation": [0, 1, 0], "children": [2] },
            { "name": "knee", "translation": [0, -0.5, 0], "rotation": [half, 0, 0, half],
              "scale": [2, 2, 2], "children": [3] },
            { "name": "sword", "translation": [0, 0.25, 0], "mesh": 0 },
            { "name": "eye", "camera": 0, "translation": [0, 1, 5] },
            { "name": "balloon", "translation": [1, 0, 0], "mesh": 1, "weights": [0, 0] },
            { "name": "skin", "mesh": 0, "skin": 0 },
            { "name": "lamp", "translation": [0, 3, 0],
              "extensions": { "KHR_lights_punctual": { "light": 0 } } },
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.6, "znear": 0.1 } }],
        "materials": [{ "name": "steel", "pbrMetallicRoughness": { "roughnessFactor": 0.2 } }],
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "type": "point" }] } },
        "animations": [{ "name": "act" }],
    });
    let mut stage = Stage { document, bytes: Vec::new() };
    let corners = stage.add("VEC3", 3, &[0., 0., 0., 0.1, 0., 0., 0., 0.5, 0.]);
    let [wide, high] = [[0.2, 0., 0.], [0., 0.2, 0.]].map(|way: [f32; 3]| way.repeat(3));
    let (wide, high) = (stage.add("VEC3", 3, &wide), stage.add("VEC3", 3, &high));
    let triangle = json!({ "attributes": { "POSITION": corners }, "material": 0 });
    let mut morphed = triangle.clone();
    morphed["targets"] = json!([{ "POSITION": wide }, { "POSITION": high }]);
    stage.document["meshes"] =
        json!([{ "primitives": [triangle] }, { "primitives": [morphed], "weights": [0, 0] }]);
    stage.document["skins"] = json!([{ "joints": [1, 2] }]);
    let way = stage.add("VEC3", 3, &[0., 1., 0., 0.5, 1., 0., 1., 1., 0.]);
    stage.play(1, "translation", "LINEAR", way);
    let turn = stage.add("VEC4", 4, &[0., 0., 0., 1., 0., half, 0., half, 0., 1., 0., 0.]);
    stage.play(1, "rotation", "LINEAR", turn);
    let slide = stage.add("VEC3", 3, &[0., 1., 5., 0., 1., 5., 2., 1., 5.]);
    stage.play(4, "translation", "LINEAR", slide);
    let weights = stage.add("SCALAR", 1, &[0., 0., 1., 0.5, 0., 0.]);
    stage.play(5, "weights", "LINEAR", weights);
    let steps = stage.add("VEC4", 4, &[0., 0., 0., 1., half, 0., 0., half, 1., 0., 0., 0.]);
    stage.play(3, "rotation", "STEP", steps);
    let pulse = stage.add(
        "VEC3",
        3,
        &[
            [0., 0., 0.],
            [1., 1., 1.],
            [0., 1., 0.],
            [0., 1., 0.],
            [1., 2., 1.],
            [0., 0., 0.],
            [0., 0., 0.],
            [1., 1., 1.],
            [0., 0., 0.],
        ]
        .concat(),
    );
    stage.play(5, "scale", "CUBICSPLINE", pulse);
    stage
}
