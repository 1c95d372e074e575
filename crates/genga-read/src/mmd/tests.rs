use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::curve::Curve;
use super::*;
use crate::mmd::test_models::{Layout, Written};
use genga::motion::{Body, Clip, Poser};
use genga::time::Frame;

/// A key to write: bone, frame, translation, rotation, and the handles shared by all its curves.
type Key<'a> = (&'a str, u32, [f32; 3], [f32; 4], [u8; 4]);

const STILL: [f32; 3] = [0.0; 3];
const NONE: [f32; 4] = [0.0, 0.0, 0.0, 1.0];
const LINEAR: [u8; 4] = [20, 20, 107, 107];

/// Writes a VMD with these keys, and with IK bones that are switched off at frame 0.
pub(super) fn file(keys: &[Key<'_>], off: &[&str]) -> Vec<u8> {
    file_in(encoding_rs::SHIFT_JIS, keys, off)
}

/// Writes such a VMD with names in the given encoding.
fn file_in(encoding: &'static encoding_rs::Encoding, keys: &[Key<'_>], off: &[&str]) -> Vec<u8> {
    let field = |text: &str, width: usize| {
        let mut field = encoding.encode(text).0.into_owned();
        field.resize(width, 0);
        field
    };
    let mut bytes = field("Vocaloid Motion Data 0002", 30);
    bytes.extend(field("人形", 20));
    bytes.extend((keys.len() as u32).to_le_bytes());
    for (bone, frame, translation, rotation, [x1, y1, x2, y2]) in keys {
        bytes.extend(field(bone, 15));
        bytes.extend(frame.to_le_bytes());
        translation.iter().chain(rotation).for_each(|number| bytes.extend(number.to_le_bytes()));
        let mut row: Vec<u8> = [x1, y1, x2, y2].into_iter().flat_map(|byte| [*byte; 4]).collect();
        for first in [true, false, false, false] {
            let mut written = row.clone();
            if first {
                // MMD stores the physics switch here.
                written[2..4].copy_from_slice(&[99, 15]);
            }
            bytes.extend(&written);
            row.remove(0);
            row.push(0);
        }
    }
    bytes.extend([0; 16]);
    bytes.extend(1u32.to_le_bytes());
    bytes.extend(0u32.to_le_bytes());
    bytes.push(1);
    bytes.extend((off.len() as u32).to_le_bytes());
    for ik in off {
        bytes.extend(field(ik, 20));
        bytes.push(0);
    }
    bytes
}

fn read(bytes: &[u8]) -> Result<Read, Error> {
    Options::default().read(bytes)
}

/// Position of a joint at a frame, in MMD units.
fn place(clip: &Clip, name: &str, frame: usize) -> DVec3 {
    let mut body = Body::new(clip.skeleton());
    body.place(Poser::new(clip).frame(Frame(frame)));
    body.positions()[clip.skeleton().find(name).unwrap_or_else(|| panic!("{name}")).0] / CENTIMETRES
}

#[test]
fn a_curve_of_equal_handles_is_a_line_and_others_are_beziers() {
    let line = Curve::from_bytes(LINEAR);
    assert_eq!(line.done(0.3), 0.3);
    let slow = Curve::from_bytes([127, 0, 0, 127]);
    // The curve is vertical there, so the parameter is less exact than elsewhere.
    assert!((slow.done(0.5) - 0.5).abs() < 1e-4);
    // At t = ¼: x = 3·¼·9⁄16 + 1⁄64, y = 3·1⁄16·¾ + 1⁄64.
    assert!((slow.done(28.0 / 64.0) - 10.0 / 64.0).abs() < 1e-9);
    assert_eq!((slow.done(0.0), slow.done(1.0), slow.done(2.0)), (0.0, 1.0, 1.0));
}

proptest! {
    #[test]
    fn a_curve_never_goes_back_and_ends_where_it_should(bytes in prop::array::uniform4(0u8..=127)) {
        let curve = Curve::from_bytes(bytes);
        let places: Vec<f64> = (0..=64).map(|at| curve.done(f64::from(at) / 64.0)).collect();
        prop_assert_eq!((places[0], places[64]), (0.0, 1.0));
        for pair in places.windows(2) {
            prop_assert!(pair[1] >= pair[0] - 1e-9, "{:?}", places);
        }
    }

    #[test]
    fn bytes_of_any_kind_are_read_or_refused(cut in 0usize..700, at in 0usize..700, byte in any::<u8>()) {
        let mut bytes = file(&[
            ("センター", 0, [1.0, 2.0, 3.0], NONE, LINEAR),
            ("左足ＩＫ", 12, STILL, [0.1, 0.2, 0.3, 0.9], [1, 2, 3, 4]),
            ("左腕", 7, STILL, NONE, LINEAR),
        ], &["左足ＩＫ"]);
        bytes.truncate(cut);
        if let Some(byte_there) = bytes.get_mut(at) {
            *byte_there = byte;
        }
        let options = Options { stream: genga::motion::StreamLimit { bytes: 1 << 20 }, ..Options::default() };
        if let Ok(read) = options.read(&bytes) {
            prop_assert!(!read.clip.is_empty());
        }
    }
}

#[test]
fn keys_move_bones_between_them_by_their_curves() {
    let quarter = [0.0, 0.0, -0.5f32.sqrt(), 0.5f32.sqrt()];
    let bytes = file(
        &[
            ("センター", 0, STILL, NONE, LINEAR),
            ("センター", 8, [8.0, 0.0, -16.0], NONE, LINEAR),
            ("左腕", 4, STILL, NONE, LINEAR),
            ("左腕", 14, STILL, quarter, [127, 0, 0, 127]),
        ],
        &[],
    );
    let Read { clip, warnings, found, .. } = read(&bytes).unwrap();
    assert_eq!((clip.len(), clip.rate().fps()), (15, 30.0));
    assert_eq!(warnings.len(), 1, "what it was read as: {warnings:?}");
    assert!(found.iter().any(|found| found.is == "VMD for 人形"), "{found:?}");
    let center = |frame| place(&clip, "センター", frame);
    assert!(center(2).abs_diff_eq(DVec3::new(2.0, 8.0, 4.0), 1e-9), "{}", center(2));
    assert_eq!(center(14), center(8), "after its last key it stays");
    let arm = |frame| place(&clip, "左ひじ", frame) - place(&clip, "左腕", frame);
    assert!(arm(4).abs_diff_eq(arm(0), 1e-9), "before its first key it is as there");
    // The slow curve covers half the way in half the time; the arm turns by 90° about −Z of the left-handed
    // axes.
    let turned = DQuat::from_rotation_z(-45f64.to_radians()) * arm(4);
    assert!(arm(9).abs_diff_eq(turned, 1e-3), "{} {turned}", arm(9));
    let early = arm(4).angle_between(arm(6)).to_degrees();
    assert!((1.0..10.0).contains(&early), "the curve begins slowly: {early}");
}

#[test]
fn a_keyed_ik_brings_the_foot_and_its_switch_lets_it_go() {
    let up = [0.0, 3.0, -2.0];
    let keys = [("左足ＩＫ", 0, up, NONE, LINEAR), ("センター", 0, [0.0, -1.0, 0.0], NONE, LINEAR)];
    let clip = read(&file(&keys, &[])).unwrap().clip;
    let (hip, knee, ankle) =
        (place(&clip, "左足", 0), place(&clip, "左ひざ", 0), place(&clip, "左足首", 0));
    // The file's Z axis points backwards.
    assert!(ankle.abs_diff_eq(DVec3::new(0.8, 4.5, 2.0), 1e-6), "{ankle}");
    assert!((hip.distance(knee) - 4.9).abs() < 1e-6 && (knee.distance(ankle) - 4.8).abs() < 1e-6);
    assert!(knee.z > hip.z.midpoint(ankle.z) + 1.0, "the knee bends to the front: {knee}");
    let right = place(&clip, "右足首", 0);
    assert!(right.abs_diff_eq(DVec3::new(-0.8, 0.5, 0.0), 1e-6), "its IK has no key: {right}");
    let off = read(&file(&keys, &["左足ＩＫ"])).unwrap().clip;
    assert!(place(&off, "左足首", 0).abs_diff_eq(DVec3::new(0.8, 0.5, 0.0), 1e-6));
}

#[test]
fn a_model_says_where_bones_are_and_a_stranger_is_told() {
    let bones = vec![
        ("センター", None, [0.0, 9.0, 0.0]),
        ("上半身", Some(0), [0.0, 13.0, 0.0]),
        ("首", Some(1), [0.0, 17.0, 0.0]),
        ("頭", Some(2), [0.0, 18.0, 0.0]),
    ];
    let written = Written { bones, ik: vec![] }.pmx(Layout { is_utf8: false, width: 1 });
    let place_of = tempfile::tempdir().unwrap();
    let path = place_of.path().join("doll.pmx");
    std::fs::write(&path, written).unwrap();
    let bytes = file(&[("頭", 0, STILL, NONE, LINEAR), ("尾", 3, STILL, NONE, LINEAR)], &[]);
    let options = Options { skeleton: Some(path), ..Options::default() };
    let read = options.read(&bytes).unwrap();
    assert_eq!(place(&read.clip, "頭", 0), DVec3::new(0.0, 18.0, 0.0));
    assert_eq!(read.clip.skeleton().len(), 4);
    assert!(read.warnings[0].to_string().contains("尾") && read.warnings[0].code == BONES);
    let bvh = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh")).unwrap();
    assert!(options.read(&bvh).unwrap_err().to_string().starts_with("skeleton: BVH has its bones"));
}

/// Names of the joints and of their parents.
fn tree(clip: &Clip) -> Vec<(&str, Option<&str>)> {
    let joints = &clip.skeleton().joints;
    let parent = |at: genga::motion::JointId| joints[at.0].name.as_str();
    joints.iter().map(|joint| (joint.name.as_str(), joint.parent.map(parent))).collect()
}

#[test]
fn the_spine_hangs_on_the_pelvis_and_stays_where_mmd_has_it() {
    let quarter = [0.5f32.sqrt(), 0.0, 0.0, 0.5f32.sqrt()];
    let clip = read(&file(&[("下半身", 0, STILL, quarter, LINEAR)], &[])).unwrap().clip;
    let hung = tree(&clip);
    assert_eq!(hung[..2], [("センター", None), ("下半身", Some("センター"))]);
    assert!(hung.contains(&("上半身", Some("下半身"))), "{hung:?}");
    for pair in hung.windows(2) {
        let mut up = std::iter::successors(Some(pair[0].0), |name| {
            hung.iter().find(|(own, _)| own == name).and_then(|(_, parent)| *parent)
        });
        assert!(
            up.any(|name| pair[1].1 == Some(name)),
            "a tree is written branch by branch: {hung:?}"
        );
    }
    let neck = place(&clip, "首", 0);
    assert!(neck.abs_diff_eq(DVec3::new(0.0, 16.4, 0.0), 1e-9), "only the pelvis turns: {neck}");
    assert!(place(&clip, "左ひざ", 0).z.abs() > 4.0, "and the legs with it");
}

#[test]
fn a_spine_that_begins_elsewhere_than_the_pelvis_keeps_its_place() {
    let bones = vec![
        ("センター", None, [0.0, 9.0, 0.0]),
        ("上半身", Some(0), [0.0, 13.0, 0.0]),
        ("下半身", Some(0), [0.0, 12.0, 0.0]),
    ];
    let quarter = [0.0, 0.0, 0.5f32.sqrt(), 0.5f32.sqrt()];
    let clip = on(Written { bones, ik: vec![] }.pmd(), &[("下半身", 3, STILL, quarter, LINEAR)]);
    assert_eq!(tree(&clip)[2], ("上半身", Some("下半身")));
    assert!(place(&clip, "上半身", 0).abs_diff_eq(DVec3::new(0.0, 13.0, 0.0), 1e-9));
}

#[test]
fn the_last_joint_ends_where_its_model_says() {
    let bones = vec![
        ("センター", None, [0.0, 9.0, 0.0]),
        ("頭", Some(0), [0.0, 18.0, 0.0]),
        ("頭先", Some(1), [0.0, 21.0, 1.0]),
    ];
    let mut pmd = Written { bones, ik: vec![] }.pmd();
    let key = [("頭", 0, STILL, NONE, LINEAR)];
    let tip = |clip: &Clip| clip.skeleton().joints[1].end_sites[0].offset / CENTIMETRES;
    assert_eq!(tip(&on(pmd.clone(), &key)), DVec3::new(0.0, 2.4, 0.0), "as is usual");
    let (name, ..) = encoding_rs::SHIFT_JIS.encode("頭\0");
    let at = pmd.windows(name.len()).position(|bytes| bytes == &name[..]).unwrap();
    pmd[at + 22] = 2;
    assert_eq!(tip(&on(pmd, &key)), DVec3::new(0.0, 3.0, -1.0));
}

/// Reads a motion onto a model.
fn on(model: Vec<u8>, keys: &[Key<'_>]) -> Clip {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("doll.pmd");
    std::fs::write(&path, model).unwrap();
    let options = Options { skeleton: Some(path), ..Options::default() };
    options.read(&file(keys, &[])).unwrap().clip
}

#[test]
fn noise_of_single_floats_is_no_way() {
    let channels = |way: f32| {
        let keys = [("頭", 0, [way, 0.0, 0.0], NONE, LINEAR)];
        let clip = read(&file(&keys, &[])).unwrap().clip;
        let head = clip.skeleton().find("頭").unwrap();
        clip.skeleton().joints[head.0].channels.len()
    };
    assert_eq!((channels(1e-4), channels(0.1)), (3, 6));
}

#[test]
fn what_is_damaged_is_refused_at_its_byte() {
    let good = file(&[("頭", 5, STILL, NONE, LINEAR)], &[]);
    let said = |bytes: &[u8]| Motion::read(bytes).unwrap_err().to_string();
    assert!(said(&good[..40]).starts_with("byte 30: the file ends in its model's name"));
    assert!(said(&good[..60]).starts_with("byte 50: 1 keys of bones do not go into the 6 bytes"));
    let mut nan = good.clone();
    nan[54 + 19..54 + 23].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(said(&nan), "byte 73: a key of 頭 has a value that is no number");
    let mut late = good.clone();
    late[54 + 15..54 + 19].copy_from_slice(&u32::MAX.to_le_bytes());
    let late = read(&late).unwrap_err().to_string();
    assert!(
        late.starts_with("byte 54: there is no key between frame 0 and frame 4294967295"),
        "{late}"
    );
    let long: Vec<Key<'_>> = (0..60).map(|at| ("頭", 36_000 * at, STILL, NONE, LINEAR)).collect();
    let options =
        Options { stream: genga::motion::StreamLimit { bytes: 1 << 20 }, ..Options::default() };
    let long = options.read(&file(&long, &[])).unwrap_err().to_string();
    assert!(long.contains("frame 2124000 is the last: so long a motion takes"), "{long}");
    let none = file(&[], &[]);
    assert!(said(&none).ends_with("this VMD has no key of a bone"), "{}", said(&none));
    let mut camera = none[..54].to_vec();
    camera.extend([0, 0, 0, 0, 1, 0, 0, 0]);
    camera.extend([0; 61]);
    assert!(
        said(&camera)
            .contains("no key of a bone, but 1 keys of the camera; give the motion of a body"),
        "{}",
        said(&camera)
    );
    let mut old = good[..54 + 111].to_vec();
    assert!(Motion::read(&old).is_ok(), "old files end after the bones");
    old.extend([9, 0, 0, 0]);
    assert!(said(&old).starts_with("byte 165: 9 keys of the face"));
}

#[test]
fn a_root_that_is_not_there_is_refused_with_those_there_are() {
    let bytes = file(&[("センター", 0, STILL, NONE, LINEAR)], &[]);
    let of = |root: &str| Options { root: Some(root.into()), ..Options::default() }.read(&bytes);
    let error = of("Hips").unwrap_err().to_string();
    assert!(
        error.starts_with("root: no tree is called \"Hips\"; the file has センター"),
        "{error}"
    );
    assert!(of("センター").is_ok());
}

#[test]
fn a_key_that_stands_hours_behind_the_others_is_left_out_and_told() {
    let keys = |last: u32| {
        let (rest, last) = ([9.0, 0.0, 0.0], ("頭", last, STILL, NONE, LINEAR));
        file(&[("頭", 0, STILL, NONE, LINEAR), ("センター", 40, rest, NONE, LINEAR), last], &[])
    };
    let Read { clip, warnings, .. } = read(&keys(1_000_000)).unwrap();
    assert_eq!(clip.len(), 41);
    assert_eq!(warnings[0].code, "W_KEY_FAR");
    assert!(warnings[0].message.starts_with("a key stands at frame 1000000"), "{}", warnings[0]);
    assert_eq!(key_frames(&keys(1_000_000)).unwrap(), [0, 40]);
    let Read { clip, warnings, .. } = read(&keys(36_000)).unwrap();
    assert_eq!((clip.len(), warnings[0].code), (36_001, "W_FORMAT"));
}

#[test]
fn a_motion_of_which_the_skeleton_has_no_bone_is_refused() {
    let keys = file(&[("しっぽ", 0, STILL, NONE, LINEAR), ("耳", 9, STILL, NONE, LINEAR)], &[]);
    let without = read(&keys).unwrap_err().to_string();
    assert!(without.contains("しっぽ, 耳") && without.contains("--skeleton"), "{without}");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("doll.pmd");
    let bones = vec![("頭", None, [0.0, 18.0, 0.0])];
    std::fs::write(&path, Written { bones, ik: vec![] }.pmd()).unwrap();
    let options = Options { skeleton: Some(path.clone()), ..Options::default() };
    let with = options.read(&keys).unwrap_err().to_string();
    assert!(with.contains("is it another model's motion, for 人形?"), "{with}");
    std::fs::write(&path, b"Pmd\0\0").unwrap();
    let broken = options.read(&keys).unwrap_err().to_string();
    assert!(broken.starts_with(&format!("{}:byte 3: ", path.display())), "{broken}");
}

#[test]
fn frames_with_a_key_of_the_body_are_an_animators_keys() {
    let keys = [
        ("左腕", 9, STILL, NONE, LINEAR),
        ("センター", 0, STILL, NONE, LINEAR),
        ("頭", 9, STILL, NONE, LINEAR),
        ("左人指１", 4, STILL, NONE, LINEAR),
        ("右足ＩＫ", 20, STILL, NONE, LINEAR),
    ];
    assert_eq!(key_frames(&file(&keys, &[])).unwrap(), [0, 9, 20], "a finger is none");
}

#[test]
fn names_are_read_in_the_encoding_in_which_they_are_bones() {
    let turned = [0.0, 0.0, 0.6, 0.8];
    let keys = [
        ("センター", 0, STILL, NONE, LINEAR),
        ("左足ＩＫ", 0, STILL, NONE, LINEAR),
        ("左足ＩＫ", 9, [0.0, 2.0, 1.0], NONE, LINEAR),
        // The field holds only four and a half letters of this name in UTF-8.
        ("左つま先ＩＫ", 0, STILL, NONE, LINEAR),
        ("左つま先ＩＫ", 9, [0.0, 1.0, 0.0], NONE, LINEAR),
        ("右ひじ", 5, STILL, turned, LINEAR),
        ("髪の毛", 5, STILL, turned, LINEAR),
    ];
    let own = read(&file(&keys, &["右足ＩＫ"])).unwrap();
    assert!(own.found.iter().all(|found| found.what != "names"));
    for encoding in [encoding_rs::UTF_8, encoding_rs::GBK] {
        let bytes = file_in(encoding, &keys, &["右足ＩＫ"]);
        let other = read(&bytes).unwrap();
        assert_eq!(other.clip, own.clip, "{}", encoding.name());
        assert_eq!(other.warnings[0], own.warnings[0], "the hair is none of the figure's");
        let named = other.found.iter().find(|found| found.what == "names").unwrap();
        assert_eq!(named.is, format!("names in {}", encoding.name()));
        assert_eq!(key_frames(&bytes).unwrap(), [0, 5, 9]);
    }
}
