use std::path::Path;

use glam::{DQuat, DVec3};
use serde_json::Value;

use super::*;
use crate::real;
use genga::motion::{Body, Pose, RowWriter, bvh, local_rotation, local_translation};
use genga::sheet::{Blank, RootMotion};

/// A parsed file: its JSON document, and the floats behind each accessor.
struct File {
    document: Value,
    binary: Vec<u8>,
}

impl File {
    fn parse(bytes: &[u8]) -> Self {
        let long = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], long(8)), (&b"glTF"[..], bytes.len()));
        let document = serde_json::from_slice(&bytes[20..20 + long(12)]).unwrap();
        Self { document, binary: bytes[28 + long(12)..].to_vec() }
    }

    fn floats(&self, accessor: &Value) -> Vec<f64> {
        let accessor = &self.document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &self.document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let of = |key: &str| view[key].as_u64().unwrap() as usize;
        let bytes = &self.binary[of("byteOffset")..of("byteOffset") + of("byteLength")];
        bytes
            .chunks(4)
            .map(|four| f64::from(f32::from_le_bytes(four.try_into().unwrap())))
            .collect()
    }

    /// Position of every node at a time in seconds, interpolated linearly as by players that ignore steps.
    fn at(&self, second: f64) -> Vec<(String, DVec3)> {
        let nodes = self.document["nodes"].as_array().unwrap();
        let three = |value: &Value| {
            let value: Vec<f64> =
                value.as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
            DVec3::from_slice(&value)
        };
        let mut ways: Vec<DVec3> = nodes.iter().map(|node| three(&node["translation"])).collect();
        let mut turns = vec![DQuat::IDENTITY; nodes.len()];
        let animation = &self.document["animations"][0];
        for channel in animation["channels"].as_array().unwrap() {
            let sampler = &animation["samplers"][channel["sampler"].as_u64().unwrap() as usize];
            assert_eq!(sampler["interpolation"], "LINEAR");
            let (times, values) = (self.floats(&sampler["input"]), self.floats(&sampler["output"]));
            let width = values.len() / times.len();
            let next = times.partition_point(|time| *time <= second).min(times.len() - 1);
            let share = ((second - times[next - 1]) / (times[next] - times[next - 1])).min(1.0);
            let line: Vec<f64> = (0..width)
                .map(|at| {
                    values[(next - 1) * width + at] * (1.0 - share)
                        + values[next * width + at] * share
                })
                .collect();
            let node = channel["target"]["node"].as_u64().unwrap() as usize;
            if channel["target"]["path"] == "rotation" {
                turns[node] = DQuat::from_slice(&line).normalize();
            } else {
                assert_eq!(node, 0, "the hips alone move");
                ways[node] = DVec3::from_slice(&line);
            }
        }
        let mut parents = vec![None; nodes.len()];
        for (at, node) in nodes.iter().enumerate() {
            for child in node["children"].as_array().into_iter().flatten() {
                parents[child.as_u64().unwrap() as usize] = Some(at);
            }
        }
        let mut placed: Vec<(DQuat, DVec3)> = Vec::new();
        for at in 0..nodes.len() {
            let (turn, place) =
                parents[at].map_or((DQuat::IDENTITY, DVec3::ZERO), |parent: usize| placed[parent]);
            placed.push((turn * turns[at], place + turn * ways[at]));
        }
        nodes
            .iter()
            .zip(placed)
            .map(|(node, (_, place))| (node["name"].as_str().unwrap().to_owned(), place))
            .collect()
    }
}

fn place(placed: &[(String, DVec3)], name: &str) -> DVec3 {
    placed.iter().find(|(own, _)| own == name).unwrap_or_else(|| panic!("{name}")).1
}

/// Pairs of bones with all rotations between them in the file, by VRM's names and by those of the clip.
const SPANS: [[&str; 4]; 6] = [
    ["leftUpperArm", "leftLowerArm", "LeftArm", "LeftForeArm"],
    ["rightLowerArm", "rightHand", "RightForeArm", "RightHand"],
    ["leftUpperLeg", "leftLowerLeg", "LeftUpLeg", "LeftLeg"],
    ["rightLowerLeg", "rightFoot", "RightLeg", "RightFoot"],
    ["leftLowerLeg", "leftFoot", "LeftLeg", "LeftFoot"],
    ["hips", "leftUpperLeg", "Hips", "LeftUpLeg"],
];

#[test]
fn limbs_point_on_every_koma_where_the_captures_do_to_its_end() {
    let kick = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/kick.bvh");
    limbs_point_where_the_capture_s_do(&kick);
    real::with(["cmu-07_01-walk", "cmu-09_01-run"], |paths| {
        paths.iter().for_each(|path| limbs_point_where_the_capture_s_do(path));
    });
}

fn limbs_point_where_the_capture_s_do(path: &Path) {
    let name = real::name(path);
    let clip = bvh::read(&real::bytes(path)).unwrap().clip;
    let mut sheet =
        Sheet::on_ones(clip.clock(24.0), clip.rate().koma_from_frames(clip.len(), 24.0));
    sheet.layers[0].exposures.iter_mut().step_by(3).for_each(|exposure| exposure.koma = 3);
    let file = File::parse(&write(&clip, &sheet, None).unwrap());
    let (mut writer, mut row) = (RowWriter::new(&clip), vec![0.0; clip.skeleton().channels()]);
    let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
    for (begin, exposure) in sheet.layers[0].timed() {
        writer.write(sheet.layers[0].drawings[exposure.drawing].source, &mut row);
        for (index, joint) in clip.skeleton().joints.iter().enumerate() {
            pose.rotations[index] = local_rotation(joint, &row);
            pose.translations[index] = local_translation(joint, &row);
        }
        body.place(&pose);
        let own = |name: &str| body.positions()[clip.skeleton().find(name).unwrap().0];
        for koma in [0.05, exposure.koma as f64 - 0.05] {
            let placed = file.at((begin as f64 + koma) / 24.0);
            for [from, to, own_from, own_to] in SPANS {
                let (found, should) =
                    (place(&placed, to) - place(&placed, from), own(own_to) - own(own_from));
                let off = found.angle_between(should).to_degrees();
                assert!(off < 0.1, "{name}, koma {begin} {koma}: {from} to {to} is off by {off}°");
            }
        }
    }
}

#[test]
fn a_repeat_has_a_root_on_ones_where_the_first_round_had_it() {
    let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let mut sheet = Sheet { root: RootMotion::Ones, ..Sheet::on_ones(clip.clock(24.0), 37) };
    let on_threes = [0, 12, 24, 36].map(|drawing| Exposure { drawing, koma: 3 });
    sheet.layers[0].exposures = on_threes.repeat(2);
    let file = File::parse(&write(&clip, &sheet, None).unwrap());
    let hips = |koma: usize| place(&file.at((koma as f64 + 0.5) / 24.0), "hips");
    for koma in 0..12 {
        assert!(hips(koma).abs_diff_eq(hips(koma + 12), 1e-6), "koma {koma}");
    }
    assert!(!hips(0).abs_diff_eq(hips(1), 1e-4), "it slides");
}

#[test]
fn the_first_pose_stands_over_the_blank_koma_before_it() {
    let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    for root in [RootMotion::Drawings, RootMotion::Ones] {
        let sheet = Sheet { root, ..Sheet::on_ones(clip.clock(24.0), 37) };
        let late = sheet.clone().with_blank(Blank { before: 24, after: 12 });
        let [plain, late] =
            [&sheet, &late].map(|sheet| File::parse(&write(&clip, sheet, None).unwrap()));
        let hand = |file: &File, koma: usize| {
            let placed = file.at((koma as f64 + 0.5) / 24.0);
            [place(&placed, "hips"), place(&placed, "leftHand")]
        };
        for koma in 0..73 {
            let shown = koma.clamp(24, 60) - 24;
            let mut apart = hand(&late, koma).into_iter().zip(hand(&plain, shown));
            assert!(apart.all(|(a, b)| a.abs_diff_eq(b, 1e-5)), "koma {koma}");
        }
    }
}

#[test]
fn it_rests_in_a_t_pose_that_faces_the_front_and_stands_on_the_floor() {
    let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let sheet = Sheet::on_ones(clip.clock(24.0), 2);
    let mut file = File::parse(&write(&clip, &sheet, None).unwrap());
    let used = &file.document["extensions"][EXTENSION];
    assert_eq!(
        (&used["specVersion"], &file.document["extensionsUsed"][0]),
        (&"1.0".into(), &EXTENSION.into())
    );
    assert_eq!(used["humanoid"]["humanBones"]["hips"]["node"], 0);
    file.document["animations"][0]["channels"] = json!([]);
    let rest = file.at(0.0);
    let span = |from: &str, to: &str| (place(&rest, to) - place(&rest, from)).normalize();
    assert!(span("leftUpperArm", "leftLowerArm").abs_diff_eq(DVec3::X, 1e-6));
    assert!(span("rightLowerArm", "rightHand").abs_diff_eq(DVec3::NEG_X, 1e-6));
    assert!(span("leftUpperLeg", "leftLowerLeg").abs_diff_eq(DVec3::NEG_Y, 1e-6));
    let foot = place(&rest, "leftFoot").y;
    assert!((0.0..0.2).contains(&foot) && place(&rest, "head").y > 1.2, "{foot}");
}

#[test]
fn a_body_that_vrm_has_none_of_is_refused_with_what_it_lacks() {
    let bytes = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let mut skeleton = clip.skeleton().clone();
    skeleton.joints.truncate(3);
    let rows = vec![0.0; skeleton.channels()];
    let part = Clip::new(skeleton, clip.rate(), clip.first(), 1, rows).unwrap();
    let error = notes(&part, None).unwrap_err().to_string();
    assert!(
        error.starts_with("vrma: VRM has no body without spine, head, leftUpperArm"),
        "{error}"
    );
}
