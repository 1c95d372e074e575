//! A given model, posed by the file along its own hierarchy.

use glam::{DQuat, DVec3};

use super::super::{MmdModel, Vmd, VmdBones};
use super::body::{Stood, clips, each_koma, limb};
use super::rests::{kick, on_ones, standing};
use crate::test_models::{Layout, Written};
use genga::sheet::Sheet;
use genga::time::KOMA_RATE;

/// A model like those of MMD's first years: no 上半身2 and no 親指０, a グルーブ between センター and the body, arms that hang
/// by 40° and bend forward at the elbow, legs that are not quite straight. Unusually, 下半身 is a child of 上半身, and the
/// right arm a sibling of its collar bone. Positions are in MMD's axes.
pub(super) fn written() -> Written {
    let mut bones = vec![
        ("全ての親", None, [0.0, 0.0, 0.0]),
        ("センター", Some(0), [0.0, 8.0, 0.0]),
        ("グルーブ", Some(1), [0.0, 8.5, 0.0]),
        // The head comes first, because parents need not precede their children.
        ("頭", Some(5), [0.0, 17.0, -0.2]),
        ("上半身", Some(2), [0.0, 13.0, 0.0]),
        ("首", Some(4), [0.0, 16.0, 0.1]),
        ("下半身", Some(4), [0.0, 13.0, 0.0]),
    ];
    let mut ik = Vec::new();
    for (side, x) in [("左", 1.0), ("右", -1.0)] {
        let at = bones.len();
        let carrier = if side == "左" { at } else { 4 };
        let named = |name: &str| -> &'static str { format!("{side}{name}").leak() };
        bones.extend([
            (named("肩"), Some(4), [0.3 * x, 15.8, 0.0]),
            (named("腕"), Some(carrier), [1.2 * x, 15.6, 0.1]),
            (named("腕捩"), Some(at + 1), [2.2 * x, 14.6, 0.1]),
            (named("ひじ"), Some(at + 2), [3.2 * x, 13.922, 0.1]),
            (named("手首"), Some(at + 3), [4.9 * x, 12.6, -0.6]),
            (named("足"), Some(6), [0.9 * x, 11.6, 0.0]),
            (named("ひざ"), Some(at + 5), [1.0 * x, 6.7, -0.3]),
            (named("足首"), Some(at + 6), [1.1 * x, 1.5, 0.2]),
            (named("足ＩＫ"), Some(0), [1.1 * x, 1.5, 0.2]),
            (named("髪ＩＫ"), Some(0), [0.0, 17.0, 0.0]),
        ]);
        ik.extend([(at + 8, vec![at + 6, at + 5]), (at + 9, vec![0])]);
    }
    Written { bones, ik }
}

pub(super) fn given(written: &Written) -> Vmd {
    let file = written.pmx(Layout { is_utf8: false, width: 2 });
    let mut vmd = Vmd::default();
    vmd.play(MmdModel::read(&file).unwrap());
    vmd
}

/// World rotation of a bone along the model's own hierarchy.
fn world(body: &MmdModel, stood: &Stood, bone: &str) -> DQuat {
    let above = body.above(body.find(bone).unwrap());
    above.fold(stood.turned(bone), |world, above| stood.turned(above) * world)
}

/// Bones of the limbs, each leading from its start to that of the next.
const LIMBS: [(bool, [&str; 3]); 2] =
    [(true, ["腕", "ひじ", "手首"]), (false, ["足", "ひざ", "足首"])];

#[test]
fn directions_hold_on_the_model_that_was_given() {
    let vmd = given(&written());
    let body = vmd.body.as_ref().unwrap();
    for (name, clip) in clips() {
        each_koma(&clip, &vmd, |koma, stood, capture| {
            for (is_arm, bones) in LIMBS {
                for (side, is_left) in [("左", true), ("右", false)] {
                    let joints = limb(&clip, is_arm, is_left);
                    for at in 0..2 {
                        let [from, to] = [at, at + 1].map(|bone| format!("{side}{}", bones[bone]));
                        let way = body.way(&from, &to).unwrap() * DVec3::new(1.0, 1.0, -1.0);
                        let points = world(body, stood, &from) * way;
                        let should = capture.way(&joints[at], &joints[at + 1]);
                        let off = points.angle_between(should).to_degrees();
                        assert!(off < 0.01, "{name} koma {koma}: {from} is {off}° off");
                    }
                }
            }
        });
    }
}

#[test]
fn only_bones_that_the_model_has_get_keys_and_its_own_ik_is_off() {
    let vmd = given(&written());
    let body = vmd.body.as_ref().unwrap();
    for (name, clip) in clips() {
        let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
        let made = vmd.make(&clip, &sheet).unwrap();
        assert_eq!(made.notes, vmd.notes(&clip, &sheet).unwrap(), "{name}");
        assert!(made.motion.keys.iter().all(|key| body.find(&key.bone).is_some()), "{name}");
        assert_eq!(made.motion.ik_off, ["左足ＩＫ", "右足ＩＫ"], "{name}: not that of the hair");
        assert_eq!(made.motion.model, "人形");
    }
    let clip = kick();
    let made = vmd.make(&clip, &Sheet::on_ones(clip.clock(KOMA_RATE), 1)).unwrap();
    let (_, chest) = made.report.bones.iter().find(|(bone, _)| bone == "上半身").unwrap();
    assert_eq!(chest, &["Spine", "Spine1", "Spine2"], "the chest is taken over");
    let pmd = MmdModel::read(&written().pmd()).unwrap();
    assert_eq!(pmd, *body, "the older format says the same");
}

#[test]
fn a_model_with_semi_standard_bones_gets_them() {
    let mut written = written();
    let chest = written.bones.len();
    written.bones.push(("上半身2", Some(4), [0.0, 14.5, 0.0]));
    for (bone, parent, _) in &mut written.bones {
        if ["首", "左肩", "右肩", "右腕"].contains(bone) {
            *parent = Some(chest);
        }
    }
    let vmd = given(&written);
    let body = vmd.body.as_ref().unwrap();
    each_koma(&kick(), &vmd, |koma, stood, capture| {
        assert!(stood.bones().any(|bone| bone == "上半身2"));
        let way = body.way("左腕", "左ひじ").unwrap() * DVec3::new(1.0, 1.0, -1.0);
        let should = capture.way(&["LeftArm"], &["LeftForeArm"]);
        let off = (world(body, stood, "左腕") * way).angle_between(should).to_degrees();
        assert!(off < 0.01, "koma {koma}: {off}° off");
    });
}

#[test]
fn without_a_model_the_standard_bones_alone_get_keys() {
    let bones = |vmd: Vmd| -> Vec<String> {
        let keys = on_ones(&standing(DVec3::ZERO), &vmd).keys;
        keys.into_iter().map(|key| key.bone).collect()
    };
    let standard = bones(Vmd::default());
    let semi = bones(Vmd { bones: VmdBones::Semi, ..Vmd::default() });
    let others: Vec<&String> = semi.iter().filter(|bone| !standard.contains(bone)).collect();
    assert_eq!(others, ["上半身2"]);
    assert!(standard.iter().all(|bone| semi.contains(bone)));
}

#[test]
fn a_models_leg_is_the_measure_of_ways() {
    let clip = standing(DVec3::new(0.0, 192.5, 1.0));
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
    let vmd = given(&written());
    let leg = vmd.body.as_ref().unwrap().leg().unwrap();
    let scale = |vmd: &Vmd| vmd.make(&clip, &sheet).unwrap().report.scale;
    assert!((leg - 10.14).abs() < 0.01, "{leg}");
    let plain = Vmd { leg, ..Vmd::default() };
    assert!((scale(&vmd) - scale(&plain)).abs() < 1e-12);
    assert!((scale(&vmd) - scale(&Vmd::default())).abs() > 1e-3);
}

#[test]
fn what_the_model_lacks_is_said_and_a_model_of_other_bones_is_refused() {
    let (clip, mut few) = (standing(DVec3::ZERO), written());
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
    for (bone, ..) in &mut few.bones {
        if ["左肩", "右肩"].contains(bone) {
            *bone = "collar";
        }
    }
    let made = given(&few).make(&clip, &sheet).unwrap();
    let note = made.notes.iter().find(|note| note.code == "W_VMD_NO_BONE").unwrap();
    assert!(note.message.contains("the model has no bone 左肩, 右肩:"), "{note:?}");
    assert!(made.report.carried.contains(&"LeftShoulder".to_owned()), "{:?}", made.report);
    let ball = Written { bones: vec![("ball", None, [0.0; 3])], ik: vec![] };
    let error = given(&ball).make(&clip, &sheet).unwrap_err().to_string();
    assert!(
        error.contains("the model 人形 has none of the bones that the clip drives (センター, "),
        "{error}"
    );
    assert!(error.ends_with("its bones begin with ball"), "{error}");
}

#[test]
fn names_that_no_vmd_holds_are_said() {
    let clip = standing(DVec3::ZERO);
    let sheet = Sheet::on_ones(clip.clock(KOMA_RATE), 1);
    let mut long = written();
    long.bones
        .iter_mut()
        .filter(|bone| bone.0 == "左足ＩＫ")
        .for_each(|bone| bone.0 = "とても長い名前の左足ＩＫ");
    let made = given(&long).make(&clip, &sheet).unwrap();
    assert_eq!(made.motion.ik_off, ["右足ＩＫ"]);
    let note = made.notes.iter().find(|note| note.code == "W_VMD_IK_STAYS").unwrap();
    assert!(note.message.contains("とても長い名前の左足ＩＫ"), "{note:?}");
    let mut vmd = given(&written());
    let mut body = vmd.body.clone().unwrap();
    body.name = "🦵".into();
    vmd.play(body);
    let made = vmd.make(&clip, &sheet).unwrap();
    assert_eq!(made.motion.model, "genga");
    assert!(made.notes.iter().any(|note| note.code == "W_VMD_MODEL_NAME"), "{:?}", made.notes);
}

#[test]
fn a_file_where_only_a_name_can_stand_is_refused() {
    let clip = standing(DVec3::ZERO);
    let vmd = Vmd { model: "miku.PMX".into(), ..Vmd::default() };
    let error = vmd.make(&clip, &Sheet::on_ones(clip.clock(KOMA_RATE), 1)).unwrap_err().to_string();
    assert!(error.starts_with("vmd.model: this is a file: "), "{error}");
    // A model's name may look like a file.
    let mut vmd = given(&written());
    vmd.model = "miku.pmx".into();
    assert_eq!(on_ones(&clip, &vmd).model, "miku.pmx");
}
