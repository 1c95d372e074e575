//! Tests of the file and its keys.

use std::collections::HashMap;

use proptest::prelude::*;

use super::super::{Frames, Vmd, VmdKey, VmdMotion};
use super::body::clips;
use super::reader::read;
use super::rests::{kick, on_ones, standing};
use genga::edits::Edits;
use genga::motion::body::names::bones::{LONGEST_NAME, Model, cp932};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Blank, Exposure, Feet, RootMotion, Sheet};
use genga::time::KOMA_RATE;

/// The clip's motion by the default recipe, with its sheet.
fn limited(clip: genga::motion::Clip) -> (Sheet, VmdMotion) {
    let mut engine = Engine::new(clip).unwrap();
    let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
    let made = Vmd::default().make(breakdown.clip, breakdown.sheet);
    (breakdown.sheet.clone(), made.unwrap().motion)
}

#[test]
fn what_is_read_is_what_was_meant_on_every_clip() {
    for (name, clip) in clips() {
        let (_, motion) = limited(clip);
        let bytes = motion.bytes().unwrap();
        let file = read(&bytes);
        assert_eq!(file.motion, motion, "{name}");
        assert_eq!(file.visible, [1], "{name}");
        assert_eq!(file.motion.ik_off, ["左足ＩＫ", "右足ＩＫ", "左つま先ＩＫ", "右つま先ＩＫ"]);
        let size = 50 + 4 + 111 * motion.keys.len() + 4 * 4 + 4 + 9 + 21 * 4;
        assert_eq!(bytes.len(), size, "{name}");
        let linear = &file.interpolation[0];
        assert!(file.interpolation.iter().all(|bytes| bytes == linear), "{name}");
    }
}

proptest! {
    #[test]
    fn any_motion_is_read_as_it_was_written(
        keys in prop::collection::vec(
            (
                (0usize..50, any::<u32>(), prop::array::uniform7(-1e6f32..1e6)),
                prop::array::uniform4(prop::array::uniform4(0u8..128)),
            ),
            0..20,
        ),
        model in "[a-zA-Zぁ-んァ-ン一-龠]{0,10}",
        ik in prop::collection::vec(Just("左足ＩＫ".to_owned()), 0..3),
    ) {
        prop_assume!(cp932(&model, 20).is_ok());
        let bones = Model::standard().bones;
        let key = |((bone, frame, [a, b, c, d, e, f, g]), curves): ((usize, u32, [f32; 7]), _)| VmdKey {
            bone: bones[bone].name.clone(),
            frame,
            translation: [a, b, c],
            rotation: [d, e, f, g],
            curves,
        };
        let keys = keys.into_iter().map(key).collect();
        let motion = VmdMotion { model, keys, ik_on: vec![], ik_off: ik, faces: vec![], shown: vec![] };
        prop_assert_eq!(read(&motion.bytes().unwrap()).motion, motion);
    }

    #[test]
    fn no_two_koma_are_one_frame(rate in 2.0..1000.0f64, over in 1.0..3.0f64, koma in 0usize..100_000) {
        let frames = Frames::new(rate * over, rate).unwrap();
        prop_assert!(frames.frame_at(koma).unwrap() < frames.frame_at(koma + 1).unwrap());
        let mmd = Frames::new(30.0, 24.0).unwrap();
        prop_assert!(mmd.frame_at(koma).unwrap() < mmd.frame_at(koma + 1).unwrap());
    }
}

#[test]
fn koma_fall_on_the_frames_of_the_table() {
    let of = |fps, koma| Frames::new(fps, 24.0).unwrap().frame_at(koma).unwrap();
    let table: Vec<u32> = (0..13).map(|koma| of(30.0, koma)).collect();
    assert_eq!(table, [0, 1, 3, 4, 5, 6, 8, 9, 10, 11, 13, 14, 15]);
    assert!((0..99).all(|koma| of(24.0, koma) as usize == koma), "a koma is a frame");
    let error = Frames::new(30.0, 48.0).err().unwrap().to_string();
    assert!(error.starts_with("vmd.fps: 48 koma a second"), "{error}");
}

#[test]
fn a_hold_is_written_again_on_the_frame_before_the_next_key() {
    let clip = kick();
    let mut sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 3);
    let exposures = [(0, 3), (1, 1), (2, 2)];
    sheet.layers[0].exposures =
        exposures.map(|(drawing, koma)| Exposure { drawing, koma }).to_vec();
    let motion = Vmd::default().make(&clip, &sheet).unwrap().motion;
    let head: Vec<&VmdKey> = motion.keys.iter().filter(|key| key.bone == "頭").collect();
    let frames: Vec<u32> = head.iter().map(|key| key.frame).collect();
    assert_eq!(frames, [0, 3, 4, 5, 7], "to the end of the last koma");
    assert_eq!(head[0].rotation, head[1].rotation);
    assert_eq!(head[3].rotation, head[4].rotation);
    assert_ne!(head[1].rotation, head[2].rotation);
}

#[test]
fn held_feet_are_keys_on_every_koma_only_where_the_body_goes_on_above_them() {
    let (sheet, free) = limited(kick());
    let held = Sheet { feet: Feet::Held, ..sheet.clone() };
    let made = |sheet: &Sheet| Vmd::default().make(&kick(), sheet).unwrap().motion.keys;
    let frames = |keys: &[VmdKey]| -> Vec<(String, u32)> {
        keys.iter().map(|key| (key.bone.clone(), key.frame)).collect()
    };
    assert_eq!(frames(&made(&held)), frames(&free.keys), "a drawing stays one pose");
    assert_ne!(made(&held), free.keys, "the legs give way");
    let ones = made(&Sheet { root: RootMotion::Ones, ..held });
    let knees = ones.iter().filter(|key| key.bone == "右ひざ").map(|key| key.frame);
    let mut knees: Vec<u32> = knees.collect();
    knees.dedup();
    assert!(knees.len() >= sheet.length(), "{} of {}", knees.len(), sheet.length());
}

#[test]
fn a_repeat_has_a_root_on_ones_where_the_first_round_had_it() {
    let mut sheet = Sheet { root: RootMotion::Ones, ..limited(kick()).0 };
    let exposures = sheet.layers[0].exposures.repeat(2);
    sheet.layers[0].exposures = exposures;
    let keys = Vmd::default().make(&kick(), &sheet).unwrap().motion.keys;
    let center = keys.iter().filter(|key| key.bone == "センター");
    let places: Vec<[f32; 3]> = center.map(|key| key.translation).collect();
    let (first, second) = places.split_at(places.len() / 2);
    assert_eq!(first, second);
    assert_ne!(first[0], first[1], "it slides");
}

#[test]
fn a_root_on_ones_is_the_centre_on_every_koma_and_nothing_else() {
    let (sheet, held) = limited(kick());
    let ones = Sheet { root: RootMotion::Ones, ..sheet.clone() };
    let slid = Vmd::default().make(&kick(), &ones).unwrap().motion;
    let others = |keys: &[VmdKey]| -> Vec<VmdKey> {
        keys.iter().filter(|key| key.bone != "センター").cloned().collect()
    };
    assert_eq!(others(&slid.keys), others(&held.keys));
    let center = slid.keys.iter().filter(|key| key.bone == "センター");
    let frames: Vec<u32> = center.clone().map(|key| key.frame).collect();
    let koma = (0..sheet.length()).map(|koma| (1.25 * koma as f64 + 0.5).floor() as u32);
    assert_eq!(frames, koma.collect::<Vec<_>>());
    let mut places: Vec<[f32; 3]> = center.map(|key| key.translation).collect();
    places.dedup();
    assert!(places.len() > sheet.layers[0].exposures.len(), "it goes on in holds");
}

#[test]
fn the_first_pose_stands_over_the_blank_koma_before_it_and_the_last_over_those_after() {
    let (sheet, _) = limited(kick());
    for (root, feet) in [
        (RootMotion::Drawings, Feet::Free),
        (RootMotion::Ones, Feet::Free),
        (RootMotion::Ones, Feet::Held),
    ] {
        let sheet = Sheet { root, feet, ..sheet.clone() };
        // 24 koma are 30 frames.
        let late = sheet.clone().with_blank(Blank { before: 24, after: 24 });
        let [plain, late] =
            [&sheet, &late].map(|sheet| Vmd::default().make(&kick(), sheet).unwrap().motion.keys);
        let bones: std::collections::BTreeSet<&str> = plain.iter().map(|key| &*key.bone).collect();
        for bone in bones {
            // The pose on a frame, with the line from key to key that MMD draws.
            let pose = |keys: &[VmdKey], frame: f32| {
                let own: Vec<&VmdKey> = keys.iter().filter(|key| key.bone == bone).collect();
                let after = own.partition_point(|key| key.frame as f32 <= frame);
                let (from, to) = (own[after - 1], own[after.min(own.len() - 1)]);
                let share = (frame - from.frame as f32) / (to.frame - from.frame).max(1) as f32;
                let between = |a: f32, b: f32| a + share * (b - a);
                let place: Vec<f32> =
                    (0..3).map(|at| between(from.translation[at], to.translation[at])).collect();
                let turn: Vec<f32> =
                    (0..4).map(|at| between(from.rotation[at], to.rotation[at])).collect();
                [place, turn].concat()
            };
            let last = plain.last().unwrap().frame;
            for frame in 0..=30 {
                assert_eq!(pose(&late, frame as f32), pose(&plain, 0.0), "{bone}, {frame}");
            }
            for frame in 0..=last {
                let mut near =
                    pose(&late, (frame + 30) as f32).into_iter().zip(pose(&plain, frame as f32));
                assert!(near.all(|(a, b)| (a - b).abs() < 1e-5), "{bone}, {frame}");
            }
            assert_eq!(pose(&late, (last + 55) as f32), pose(&plain, last as f32), "{bone}");
        }
    }
}

#[test]
fn keys_are_sorted_unit_and_take_the_short_way() {
    for (name, clip) in clips() {
        let (sheet, motion) = limited(clip);
        let mut before: HashMap<&str, &VmdKey> = HashMap::new();
        let mut last = 0;
        for key in &motion.keys {
            assert!(key.frame >= last, "{name}: frame {} after {last}", key.frame);
            last = key.frame;
            let length: f64 = key.rotation.iter().map(|x| f64::from(*x).powi(2)).sum();
            assert!((length - 1.0).abs() < 1e-6, "{name}: a rotation of length² {length}");
            assert!(key.translation.iter().all(|way| way.is_finite()), "{name}");
            if let Some(before) = before.insert(&key.bone, key) {
                assert!(before.frame < key.frame, "{name}: {} twice", key.bone);
                let dot = before.rotation.iter().zip(key.rotation).map(|(a, b)| a * b);
                assert!(dot.sum::<f32>() >= 0.0, "{name}: {} goes the long way", key.bone);
            }
        }
        let end = (1.25 * sheet.length() as f64).round() as u32 - 1;
        assert_eq!(last, end, "{name}: the last drawing stays to the end");
    }
}

#[test]
fn one_koma_is_one_key_a_bone() {
    let keys = on_ones(&standing(glam::DVec3::ZERO), &Vmd::default()).keys;
    assert!(keys.iter().all(|key| key.frame == 0));
    assert_eq!(keys.len(), 19, "{keys:?}");
}

#[test]
fn every_bone_has_a_name_that_fits() {
    let bones = Model::standard().bones;
    assert_eq!(bones.len(), 50);
    for bone in bones {
        let bytes = cp932(&bone.name, LONGEST_NAME).unwrap();
        let (again, _, wrong) = encoding_rs::SHIFT_JIS.decode(&bytes);
        assert!(!wrong && again == bone.name, "{}", bone.name);
    }
}

#[test]
fn a_long_name_of_a_model_is_cut_between_letters_and_said() {
    let (clip, model) = (standing(glam::DVec3::ZERO), "とても長い名前のモデル".to_owned());
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
    let made = Vmd { model, ..Vmd::default() }.make(&clip, &sheet).unwrap();
    assert_eq!(read(&made.motion.bytes().unwrap()).motion.model, "とても長い名前のモデ");
    assert!(made.notes.iter().any(|note| note.code == "W_VMD_MODEL_NAME"), "{:?}", made.notes);
}

#[test]
fn settings_out_of_range_and_empty_sheets_are_refused() {
    let clip = standing(glam::DVec3::ZERO);
    let sheet = |koma| Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let make = |vmd: Vmd, koma| vmd.make(&clip, &sheet(koma));
    for (vmd, name) in [
        (Vmd { fps: 0.0, ..Vmd::default() }, "vmd.fps"),
        (Vmd { fps: f64::NAN, ..Vmd::default() }, "vmd.fps"),
        (Vmd { arm_angle: 91.0, ..Vmd::default() }, "vmd.arm_angle"),
        (Vmd { leg: 0.0, ..Vmd::default() }, "vmd.leg"),
        (Vmd { model: "🦵".into(), ..Vmd::default() }, "vmd"),
    ] {
        let error = make(vmd, 1).unwrap_err().to_string();
        assert!(error.starts_with(&format!("{name}: ")), "{error}");
    }
    assert!(make(Vmd::default(), 0).unwrap_err().to_string().contains("no koma"));
}

#[test]
fn the_table_of_bones_of_a_sample_is_as_it_was() {
    let clip = kick();
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
    let made = Vmd::default().make(&clip, &sheet).unwrap();
    insta::assert_snapshot!("bones", made.report.csv().unwrap());
}
