//! A reader of GLB files, independent of the writer: the document, the accessors, the node positions.

use glam::{DQuat, DVec3};
use serde_json::Value;

/// A parsed file.
pub(super) struct Read {
    pub(super) json: Value,
    binary: Vec<u8>,
}

impl Read {
    pub(super) fn new(glb: &[u8]) -> Self {
        let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(word(8), glb.len());
        let json = word(12);
        let binary = 20 + json;
        Self {
            json: serde_json::from_slice(&glb[20..binary]).unwrap(),
            binary: glb[binary + 8..binary + 8 + word(binary)].to_vec(),
        }
    }

    /// Values of an accessor of any type, one list per value.
    pub(super) fn floats(&self, accessor: &Value) -> Vec<Vec<f32>> {
        let at = |value: &Value| value.as_u64().unwrap() as usize;
        let accessor = &self.json["accessors"][at(accessor)];
        let view = &self.json["bufferViews"][at(&accessor["bufferView"])];
        let begin = at(&view["byteOffset"]);
        let bytes = &self.binary[begin..begin + at(&view["byteLength"])];
        let values: Vec<f32> = match at(&accessor["componentType"]) {
            5121 => bytes.iter().map(|byte| f32::from(*byte)).collect(),
            5123 => chunks(bytes).map(|word| f32::from(u16::from_le_bytes(word))).collect(),
            5125 => chunks(bytes).map(|word| u32::from_le_bytes(word) as f32).collect(),
            5126 => chunks(bytes).map(f32::from_le_bytes).collect(),
            other => panic!("component type {other}"),
        };
        let width = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => panic!("type {other}"),
        };
        values.chunks(width).map(<[f32]>::to_vec).collect()
    }

    pub(super) fn samplers(&self, animation: usize) -> &Vec<Value> {
        self.json["animations"][animation]["samplers"].as_array().unwrap()
    }

    /// World position of every node of the skin at a time in seconds.
    pub(super) fn positions(&self, animation: usize, time: f64) -> Vec<DVec3> {
        let mut nodes = self.json["nodes"].clone();
        for channel in self.json["animations"][animation]["channels"].as_array().unwrap() {
            let sampler = &self.samplers(animation)[channel["sampler"].as_u64().unwrap() as usize];
            let target = &channel["target"];
            let node = &mut nodes[target["node"].as_u64().unwrap() as usize];
            node[target["path"].as_str().unwrap()] = self.value(sampler, time).into();
        }
        self.placed(&nodes)
    }

    /// Value of a sampler at a time. Linear rotations are interpolated component by component.
    fn value(&self, sampler: &Value, time: f64) -> Vec<f64> {
        let (times, values) = (self.floats(&sampler["input"]), self.floats(&sampler["output"]));
        let key = times.iter().rposition(|key| f64::from(key[0]) <= time).unwrap_or(0);
        let next = (key + 1).min(times.len() - 1);
        let (begin, end) = (f64::from(times[key][0]), f64::from(times[next][0]));
        let share = match sampler["interpolation"].as_str().unwrap() {
            "STEP" => 0.0,
            "LINEAR" => ((time - begin) / (end - begin).max(1e-9)).clamp(0.0, 1.0),
            other => panic!("interpolation {other}"),
        };
        let between = |(a, b): (&f32, &f32)| f64::from(*a) + share * f64::from(b - a);
        values[key].iter().zip(&values[next]).map(between).collect()
    }

    pub(super) fn rest_positions(&self) -> Vec<DVec3> {
        self.placed(&self.json["nodes"])
    }

    fn placed(&self, nodes: &Value) -> Vec<DVec3> {
        let joints = self.json["skins"][0]["joints"].as_array().unwrap();
        let mut placed = vec![None; nodes.as_array().unwrap().len()];
        for scene in self.json["scenes"][0]["nodes"].as_array().unwrap() {
            let start = (DVec3::ZERO, DQuat::IDENTITY);
            place(nodes, scene.as_u64().unwrap() as usize, start, &mut placed);
        }
        joints.iter().map(|joint| placed[joint.as_u64().unwrap() as usize].unwrap()).collect()
    }
}

fn chunks<const N: usize>(bytes: &[u8]) -> impl Iterator<Item = [u8; N]> + '_ {
    assert_eq!(bytes.len() % N, 0);
    bytes.chunks_exact(N).map(|chunk| chunk.try_into().unwrap())
}

fn place(nodes: &Value, node: usize, parent: (DVec3, DQuat), placed: &mut [Option<DVec3>]) {
    let list = |key: &str, default: &[f64]| -> Vec<f64> {
        let values = nodes[node][key].as_array();
        values.map_or(default.to_vec(), |values| {
            values.iter().map(|value| value.as_f64().unwrap()).collect()
        })
    };
    assert!(nodes[node]["matrix"].is_null(), "a node that is animated has no matrix");
    let translation = DVec3::from_slice(&list("translation", &[0.0; 3]));
    let rotation = DQuat::from_slice(&list("rotation", &[0.0, 0.0, 0.0, 1.0])).normalize();
    let position = parent.0 + parent.1 * translation;
    placed[node] = Some(position);
    for child in nodes[node]["children"].as_array().into_iter().flatten() {
        let carried = (position, parent.1 * rotation);
        place(nodes, child.as_u64().unwrap() as usize, carried, placed);
    }
}
