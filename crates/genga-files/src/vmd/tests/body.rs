//! The oracle: a stand-in model is posed by the file, bone by bone, and must point the same way as the capture's
//! joints.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use glam::{DQuat, DVec3};

use super::super::{Vmd, VmdBones};
use super::reader::read;
use crate::sample;
use genga::motion::bvh;
use genga::motion::{Body, Clip, Pose, RowWriter, local_rotation, local_translation};
use genga::sheet::Sheet;
use genga::time::KOMA_RATE;

/// The parent of a bone, in which all standard models agree.
fn parent(bone: &str) -> Option<String> {
    let up = [
        ("上半身", "センター"),
        ("下半身", "センター"),
        ("上半身2", "上半身"),
        ("首", "上半身2"),
        ("頭", "首"),
    ];
    if let Some((_, parent)) = up.iter().find(|(name, _)| *name == bone) {
        return Some((*parent).into());
    }
    let side = bone.chars().next().filter(|side| "左右".contains(*side))?;
    let rest: String = bone.chars().skip(1).collect();
    let parent = match &rest[..] {
        "肩" => return Some("上半身2".into()),
        "足" => return Some("下半身".into()),
        "腕" => "肩",
        "ひじ" => "腕",
        "手首" => "ひじ",
        "ひざ" => "足",
        "足首" => "ひざ",
        "親指１" => "親指０",
        "親指２" => "親指１",
        finger if finger.ends_with('３') => return Some(bone.replace('３', "２")),
        finger if finger.ends_with('２') => return Some(bone.replace('２', "１")),
        _ => "手首",
    };
    Some(format!("{side}{parent}"))
}

/// The model on one frame: local poses in MMD's axes.
pub(super) struct Stood {
    local: HashMap<String, (DVec3, DQuat)>,
}

impl Stood {
    /// A bone's world rotation.
    pub(super) fn world(&self, bone: &str) -> DQuat {
        let local = self.turned(bone);
        parent(bone).map_or(local, |parent| self.world(&parent) * local)
    }

    /// Rotation relative to the parent; the identity if the file has none.
    pub(super) fn turned(&self, bone: &str) -> DQuat {
        self.local.get(bone).map_or(DQuat::IDENTITY, |(_, rotation)| *rotation)
    }

    /// The bones that the file turns or moves.
    pub(super) fn bones(&self) -> impl Iterator<Item = &str> {
        self.local.keys().map(String::as_str)
    }

    pub(super) fn moved(&self) -> DVec3 {
        self.local["センター"].0
    }

    pub(super) fn local(&self, bone: &str) -> DQuat {
        self.local[bone].1
    }
}

/// Writes a clip on ones to a file and visits each koma with the posed model and the joints' positions, in MMD's axes.
pub(super) fn each_koma(clip: &Clip, vmd: &Vmd, look: impl Fn(usize, &Stood, &Places<'_>)) {
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let made = vmd.make(clip, &sheet).unwrap();
    let file = read(&made.motion.bytes().unwrap()).motion;
    let mut stood: HashMap<u32, Stood> = HashMap::new();
    for key in file.keys {
        let translation = DVec3::from_array(key.translation.map(f64::from));
        let rotation = DQuat::from_array(key.rotation.map(f64::from));
        let at = stood.entry(key.frame).or_insert_with(|| Stood { local: HashMap::new() });
        assert!(at.local.insert(key.bone, (translation, rotation)).is_none(), "a key twice");
    }
    let mut writer = RowWriter::new(clip);
    let mut row = vec![0.0; clip.skeleton().channels()];
    let mut pose = Pose::rest(clip.skeleton());
    let mut body = Body::new(clip.skeleton());
    for (at, drawing) in sheet.layers[0].drawings.iter().enumerate() {
        writer.write(drawing.source, &mut row);
        for (index, joint) in clip.skeleton().joints.iter().enumerate() {
            pose.rotations[index] = local_rotation(joint, &row);
            pose.translations[index] = local_translation(joint, &row);
        }
        body.place(&pose);
        let frame = (at as f64 * 1.25).round() as u32;
        look(at, &stood[&frame], &Places { clip, places: body.positions() });
    }
}

/// Positions of the clip's joints.
pub(super) struct Places<'a> {
    clip: &'a Clip,
    places: &'a [DVec3],
}

impl Places<'_> {
    /// Position of the first joint that exists of some names, in MMD's axes.
    pub(super) fn find(&self, names: &[&str]) -> DVec3 {
        let joint = names.iter().find_map(|name| self.clip.skeleton().find(name));
        let place = self.places[joint.unwrap_or_else(|| panic!("{names:?}")).0];
        DVec3::new(place.x, place.y, -place.z)
    }

    pub(super) fn way(&self, from: &[&str], to: &[&str]) -> DVec3 {
        (self.find(to) - self.find(from)).normalize()
    }
}

/// Joint names of a limb (upper, lower, end) in all clips used here.
pub(super) fn limb<'a>(clip: &Clip, arm: bool, left: bool) -> [[&'a str; 4]; 3] {
    let biped = clip.skeleton().find("LeftElbow").is_some();
    match (arm, left, biped) {
        (true, true, true) => [["LeftShoulder"; 4], ["LeftElbow"; 4], ["LeftWrist"; 4]],
        (true, false, true) => [["RightShoulder"; 4], ["RightElbow"; 4], ["RightWrist"; 4]],
        (false, true, true) => [["LeftHip"; 4], ["LeftKnee"; 4], ["LeftAnkle"; 4]],
        (false, false, true) => [["RightHip"; 4], ["RightKnee"; 4], ["RightAnkle"; 4]],
        (true, true, false) => [
            ["LeftArm", "lShldr", "UpperArm_L", "L UpperArm"],
            ["LeftForeArm", "lForeArm", "LowerArm_L", "L Forearm"],
            ["LeftHand", "lHand", "Hand_L", "L Hand"],
        ],
        (true, false, false) => [
            ["RightArm", "rShldr", "UpperArm_R", "R UpperArm"],
            ["RightForeArm", "rForeArm", "LowerArm_R", "R Forearm"],
            ["RightHand", "rHand", "Hand_R", "R Hand"],
        ],
        (false, true, false) => [
            ["LeftUpLeg", "lThigh", "UpperLeg_L", "L Thigh"],
            ["LeftLeg", "lShin", "LowerLeg_L", "L Calf"],
            ["LeftFoot", "lFoot", "Foot_L", "L Foot"],
        ],
        (false, false, false) => [
            ["RightUpLeg", "rThigh", "UpperLeg_R", "R Thigh"],
            ["RightLeg", "rShin", "LowerLeg_R", "R Calf"],
            ["RightFoot", "rFoot", "Foot_R", "R Foot"],
        ],
    }
}

/// Every clip of the repository and every real one that is present.
pub(super) fn clips() -> Vec<(String, Clip)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let samples = paths.filter(|path| path.extension().is_some_and(|ending| ending == "bvh"));
    let named = |path: std::path::PathBuf| {
        (path.file_stem().unwrap().to_string_lossy().into_owned(), fs::read(path).unwrap())
    };
    let files = samples.map(named).chain(sample::real_clips());
    let motion =
        |bytes: Vec<u8>| genga::motion::clean::lead_in::strip(bvh::read(&bytes).unwrap().clip).0;
    let mut clips: Vec<_> = files.map(|(name, bytes)| (name, motion(bytes))).collect();
    clips.sort_by(|a, b| a.0.cmp(&b.0));
    clips
}

const UPPER: [[&str; 2]; 2] = [["左腕", "左ひじ"], ["右腕", "右ひじ"]];
const LEGS: [[&str; 2]; 2] = [["左足", "左ひざ"], ["右足", "右ひざ"]];

#[test]
fn arms_and_legs_of_the_model_point_where_those_of_the_capture_do() {
    for bones in [VmdBones::Standard, VmdBones::Semi] {
        limbs_point_as_captured(&Vmd { bones, ..Vmd::default() });
    }
}

fn limbs_point_as_captured(vmd: &Vmd) {
    let (sin, cos) = vmd.arm_angle.to_radians().sin_cos();
    for (name, clip) in clips() {
        each_koma(&clip, vmd, |koma, model, capture| {
            for (arm, bones) in [(true, UPPER), (false, LEGS)] {
                for (bones, left) in bones.iter().zip([true, false]) {
                    let sign = if left { 1.0 } else { -1.0 };
                    let rest = if arm { DVec3::new(sign * cos, -sin, 0.0) } else { DVec3::NEG_Y };
                    let joints = limb(&clip, arm, left);
                    for (at, bone) in bones.iter().enumerate() {
                        let points = model.world(bone) * rest;
                        let should = capture.way(&joints[at], &joints[at + 1]);
                        let off = points.angle_between(should).to_degrees();
                        assert!(off < 1e-3, "{name} koma {koma}: {bone} is {off}° off");
                    }
                }
            }
        });
    }
}

#[test]
fn pelvis_chest_and_feet_face_where_those_of_the_capture_do() {
    for (name, clip) in clips() {
        let [left, right] = [true, false].map(|left| limb(&clip, false, left));
        let [left_arm, right_arm] = [true, false].map(|left| limb(&clip, true, left));
        let pelvis = ["Hips", "hip"];
        let neck = ["Neck", "neck", "lowerneck"];
        each_koma(&clip, &Vmd::default(), |koma, model, capture| {
            let close = |bone: &str, rest: DVec3, should: DVec3, most: f64| {
                let off = (model.world(bone) * rest).angle_between(should).to_degrees();
                assert!(off < most, "{name} koma {koma}: {bone} is {off}° off");
            };
            close("下半身", DVec3::X, capture.way(&right[0], &left[0]), 0.5);
            // The tolerance is wide because shoulders do not belong to the chest: they shrug and reach.
            close("上半身2", DVec3::X, capture.way(&right_arm[0], &left_arm[0]), 45.0);
            // This direction is that of the whole spine, which bends between pelvis and neck.
            close("上半身2", DVec3::Y, capture.way(&pelvis, &neck), 45.0);
        });
    }
}

/// If the rest is not a standing body, the roll of a bone is derived from the clip. The thumb shows whether it is
/// right.
#[test]
fn the_palm_of_a_rest_along_one_axis_faces_as_in_the_capture() {
    let mut clips = clips().into_iter();
    // The real clips may be missing; `tests/what_was_left_out.rs` reports that.
    let Some((_, clip)) = clips.find(|(name, _)| name == "rokoko-jesse-dance") else { return };
    each_koma(&clip, &Vmd::default(), |koma, model, capture| {
        for (side, joint) in [("左", "Left"), ("右", "Right")] {
            let named = |name: &str| capture.find(&[&format!("{joint}{name}")]);
            let along = (named("HandMiddle1") - named("Hand")).normalize();
            let thumb = (named("HandThumb2") - named("Hand")).reject_from_normalized(along);
            let ahead = model.world(&format!("{side}手首")) * DVec3::NEG_Z;
            let off = ahead.reject_from_normalized(along).angle_between(thumb).to_degrees();
            assert!(off < 25.0, "koma {koma}: the {joint} thumb is {off}° off");
        }
    });
}

/// Elbows and knees turn about a single axis, in the anatomical direction.
#[test]
fn knees_bend_back_and_elbows_forward() {
    for (name, clip) in clips() {
        let bent = std::cell::RefCell::new([DVec3::ZERO; 4]);
        each_koma(&clip, &Vmd::default(), |_, model, _| {
            for (sum, bone) in
                bent.borrow_mut().iter_mut().zip(["左ひざ", "右ひざ", "左ひじ", "右ひじ"])
            {
                let turn = model.local(bone);
                *sum += if turn.w < 0.0 { -turn.xyz() } else { turn.xyz() };
            }
        });
        let axes = bent.into_inner().map(DVec3::normalize);
        // In MMD's axes, a bending knee turns about −X, an elbow about the vertical.
        for knee in &axes[..2] {
            assert!(knee.x < -0.85, "{name}: a knee turns about {knee}");
        }
        assert!(axes[2].y > 0.4 && axes[3].y < -0.4, "{name}: elbows turn about {axes:?}");
    }
}

#[test]
fn the_model_travels_as_the_waist_does_by_the_length_of_its_leg() {
    for (name, clip) in clips() {
        let vmd = Vmd { leg: 10.0, ..Vmd::default() };
        let legs = [true, false].map(|left| limb(&clip, false, left));
        let waist = ["LowerBack", "lowerback", "Spine", "Chest", "abdomen"];
        let first = std::cell::Cell::new(None);
        each_koma(&clip, &vmd, |koma, model, capture| {
            let span = |a: &[&str], b: &[&str]| (capture.find(b) - capture.find(a)).length();
            let leg = legs.map(|[hip, knee, ankle]| span(&hip, &knee) + span(&knee, &ankle));
            let scale = 10.0 / (0.5 * (leg[0] + leg[1]));
            let (moved, place) = (model.moved(), scale * capture.find(&waist));
            let (moved_at_first, place_at_first) = first.get().unwrap_or((moved, place));
            first.set(Some((moved_at_first, place_at_first)));
            let off = ((moved - moved_at_first) - (place - place_at_first)).length();
            assert!(off < 1e-4, "{name} koma {koma}: {off} units off");
            assert!(moved.y.abs() < 12.0, "{name} koma {koma}: {} above the ground", moved.y);
        });
    }
}
