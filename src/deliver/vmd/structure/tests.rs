use super::*;
use crate::deliver::Vmd;
use crate::deliver::vmd::map::{BoneMap, SHAPE};
use crate::motion::bvh::sample::real_clips;
use crate::motion::{Joint, bvh};
use crate::sheet::Sheet;

/// A clip whose joints have other names.
fn renamed(clip: &Clip, name: impl Fn(usize, &Joint) -> String) -> Clip {
    let mut skeleton = clip.skeleton().clone();
    for (at, joint) in skeleton.joints.iter_mut().enumerate() {
        joint.name = name(at, joint);
    }
    let values = clip.rows().flatten().copied().collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

fn nonsense(clip: &Clip) -> Clip {
    renamed(clip, |at, _| format!("q{at}"))
}

/// Joints by the bone that they drive.
fn driven(clip: &Clip) -> Vec<(String, Vec<JointId>)> {
    let map = BoneMap::default();
    let joints = map.of(clip).unwrap().joints;
    map.model.bones.iter().map(|bone| bone.name.clone()).zip(joints).collect()
}

fn limbs() -> Vec<String> {
    let bones = LIMBS.iter().flat_map(|(_, bones)| bones);
    bones.flat_map(|bone| Side::BOTH.map(|side| side.named(bone))).collect()
}

#[test]
fn without_its_names_every_real_clip_has_the_same_arms_legs_and_head() {
    for (name, bytes) in real_clips() {
        let clip = bvh::read(&bytes).unwrap().clip;
        let other = nonsense(&clip);
        assert_eq!(BoneMap::default().of(&other).unwrap().dialect, SHAPE, "{name}");
        let wanted = [limbs(), vec!["頭".into(), "下半身".into(), "センター".into()]].concat();
        for ((bone, named), (_, shaped)) in driven(&clip).into_iter().zip(driven(&other)) {
            if wanted.contains(&bone) {
                assert_eq!(named.last(), shaped.last(), "{name}: {bone}");
            }
        }
    }
}

#[test]
fn the_vmd_of_nonsense_moves_as_that_of_names() {
    let (_, bytes) = real_clips().into_iter().find(|(name, _)| name.starts_with("cmu-05")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    let made = |clip: &Clip| Vmd::default().make(clip, &sheet).unwrap();
    let (named, shaped) = (made(&clip), made(&nonsense(&clip)));
    for bone in limbs() {
        let keys = |made: &crate::deliver::VmdMade| {
            made.motion.keys.iter().filter(|key| key.bone == bone).cloned().collect::<Vec<_>>()
        };
        assert!(!keys(&shaped).is_empty(), "{bone}");
        // A forearm is turned against its arm whatever its collar bone is called.
        if ["ひじ", "ひざ"].iter().any(|end| bone.ends_with(end)) {
            for (a, b) in keys(&named).iter().zip(keys(&shaped)) {
                let near = a.rotation.iter().zip(b.rotation).all(|(a, b)| (a - b).abs() < 1e-5);
                assert!(near, "{bone}: {a:?} {b:?}");
            }
        }
    }
    let told =
        |made: &crate::deliver::VmdMade| made.notes.iter().any(|note| note.code == "W_BY_SHAPE");
    assert!(told(&shaped) && !told(&named));
}

#[test]
fn of_a_limb_that_one_name_is_missing_of_the_shape_gives_it() {
    let (_, bytes) = real_clips().into_iter().find(|(name, _)| name.starts_with("cmu-05")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let odd = renamed(&clip, |at, joint| match &joint.name[..] {
        "LeftForeArm" | "RightUpLeg" => format!("q{at}"),
        name => name.into(),
    });
    assert_eq!(driven(&odd), driven(&clip));
}

/// mocopi's 27 joints. No file of it is at hand: its names stand on a clip of another system, whose trunk and neck are given as
/// many joints as mocopi has. What this shows is the table, not mocopi's own way to turn joints.
#[test]
fn mocopi_has_arms_and_legs() {
    let (_, bytes) = real_clips().into_iter().find(|(name, _)| name.starts_with("cmu-05")).unwrap();
    let clip = bvh::read(&bytes).unwrap().clip;
    let names = [
        ("Hips", "root"),
        ("LowerBack", "torso_1"),
        ("Spine", "torso_3"),
        ("Spine1", "torso_7"),
        ("Neck", "neck_1"),
        ("Neck1", "neck_2"),
        ("Head", "head"),
        ("LeftShoulder", "l_shoulder"),
        ("LeftArm", "l_up_arm"),
        ("LeftForeArm", "l_low_arm"),
        ("LeftHand", "l_hand"),
        ("RightShoulder", "r_shoulder"),
        ("RightArm", "r_up_arm"),
        ("RightForeArm", "r_low_arm"),
        ("RightHand", "r_hand"),
        ("LeftUpLeg", "l_up_leg"),
        ("LeftLeg", "l_low_leg"),
        ("LeftFoot", "l_foot"),
        ("LeftToeBase", "l_toes"),
        ("RightUpLeg", "r_up_leg"),
        ("RightLeg", "r_low_leg"),
        ("RightFoot", "r_foot"),
        ("RightToeBase", "r_toes"),
    ];
    let mocopi = renamed(&clip, |_, joint| {
        let own = names.iter().find(|(name, _)| *name == joint.name);
        own.map_or(joint.name.clone(), |(_, name)| (*name).into())
    });
    let found = BoneMap::default().of(&mocopi).unwrap();
    assert_eq!((&found.dialect[..], found.by_shape.len()), ("mocopi", 0));
    for (bone, joints) in driven(&mocopi) {
        assert!(!joints.is_empty() || !limbs().contains(&bone), "{bone}");
    }
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    let left_out = |clip: &Clip| Vmd::default().make(clip, &sheet).unwrap().report.left_out;
    let is_limb =
        |name: &String| names.iter().any(|(_, own)| own == name && !own.ends_with("toes"));
    assert!(!left_out(&mocopi).iter().any(is_limb), "{:?}", left_out(&mocopi));
}

#[test]
fn a_body_without_arms_is_told_as_a_loss() {
    let still = still_limbs(|bone| bone.starts_with("左足"));
    assert_eq!(still, ["left arm", "right arm", "right leg"]);
}
