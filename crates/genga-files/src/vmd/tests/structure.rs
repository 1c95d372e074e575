//! The mapping by body shape, for joints whose names do not help.

use crate::Vmd;
use crate::sample::real_clips;
use genga::motion::body::names::bones::Side;
use genga::motion::body::names::{BoneMap, SHAPE};
use genga::motion::body::structure::{LIMBS, still_limbs};
use genga::motion::{Axis, Channel, Clip, Joint, JointId, bvh};
use genga::sheet::Sheet;
use genga::time::{Frame, FrameRate};

/// The clip with renamed joints.
fn renamed(clip: &Clip, name: impl Fn(usize, &Joint) -> String) -> Clip {
    let mut skeleton = clip.skeleton().clone();
    for (at, joint) in skeleton.joints.iter_mut().enumerate() {
        joint.name = name(at, joint);
    }
    let values = clip.rows().flatten().copied().collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

/// A body with arms out and legs down, with the names, hip joints and finger bases of CMU's clips: joint, parent, and
/// offset from the parent.
const BODY: [(&str, &str, [f64; 3]); 31] = [
    ("Hips", "", [0.0, 0.0, 0.0]),
    ("LHipJoint", "Hips", [0.0, 0.0, 0.0]),
    ("LeftUpLeg", "LHipJoint", [9.0, -9.0, 4.0]),
    ("LeftLeg", "LeftUpLeg", [13.0, -36.0, 0.0]),
    ("LeftFoot", "LeftLeg", [14.0, -39.0, 0.0]),
    ("LeftToeBase", "LeftFoot", [1.0, -2.5, 10.0]),
    ("RHipJoint", "Hips", [0.0, 0.0, 0.0]),
    ("RightUpLeg", "RHipJoint", [-9.0, -9.0, 4.0]),
    ("RightLeg", "RightUpLeg", [-13.0, -36.0, 0.0]),
    ("RightFoot", "RightLeg", [-14.0, -39.0, 0.0]),
    ("RightToeBase", "RightFoot", [-1.0, -2.5, 10.0]),
    ("LowerBack", "Hips", [0.0, 0.0, 0.0]),
    ("Spine", "LowerBack", [0.0, 12.0, -0.6]),
    ("Spine1", "Spine", [0.0, 12.0, -0.4]),
    ("Neck", "Spine1", [0.0, 0.0, 0.0]),
    ("Neck1", "Neck", [0.0, 10.0, 0.0]),
    ("Head", "Neck1", [0.0, 9.0, -3.5]),
    ("LeftShoulder", "Spine1", [0.0, 0.0, 0.0]),
    ("LeftArm", "LeftShoulder", [19.0, 3.0, 1.5]),
    ("LeftForeArm", "LeftArm", [31.0, 0.0, 0.0]),
    ("LeftHand", "LeftForeArm", [14.0, 0.0, 0.0]),
    ("LeftFingerBase", "LeftHand", [0.0, 0.0, 0.0]),
    ("LeftHandIndex1", "LeftFingerBase", [4.5, 0.0, 0.0]),
    ("LThumb", "LeftHand", [0.0, 0.0, 0.0]),
    ("RightShoulder", "Spine1", [0.0, 0.0, 0.0]),
    ("RightArm", "RightShoulder", [-19.0, 3.0, 1.5]),
    ("RightForeArm", "RightArm", [-31.0, 0.0, 0.0]),
    ("RightHand", "RightForeArm", [-14.0, 0.0, 0.0]),
    ("RightFingerBase", "RightHand", [0.0, 0.0, 0.0]),
    ("RightHandIndex1", "RightFingerBase", [-4.5, 0.0, 0.0]),
    ("RThumb", "RightHand", [0.0, 0.0, 0.0]),
];

/// End Sites of the left side: joint and offset.
const ENDS: [(&str, [f64; 3]); 4] = [
    ("ToeBase", [0.0, 0.0, 5.0]),
    ("Head", [0.0, 9.5, -1.0]),
    ("HandIndex1", [3.5, 0.0, 0.0]),
    ("Thumb", [3.5, 0.0, 3.5]),
];

/// One second of [`BODY`], with every joint turning slightly and differently.
fn body() -> Clip {
    const FRAMES: usize = 24;
    let rotations = [Axis::Z, Axis::Y, Axis::X].map(Channel::Rotation);
    let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let mut skeleton = genga::motion::Skeleton::default();
    for (name, parent, offset) in BODY {
        let parent = skeleton.find(parent);
        let first_channel = skeleton.channels();
        let own: &[Channel] = if parent.is_none() { &positions } else { &[] };
        let end = ENDS.iter().find(|(end, _)| name.ends_with(end)).map(|(_, offset)| {
            let side = if name.starts_with('R') { -1.0 } else { 1.0 };
            let offset = [side * offset[0], offset[1], offset[2]].into();
            genga::motion::EndSite { name: "Site".into(), offset }
        });
        skeleton.joints.push(Joint {
            name: name.into(),
            parent,
            offset: offset.into(),
            channels: [own, &rotations].concat(),
            first_channel,
            end_sites: end.into_iter().collect(),
        });
    }
    let value = |frame: usize, column: usize| match column {
        0 => frame as f64,
        1 => 95.0,
        2 => 0.0,
        _ => 12.0 * (0.25 * frame as f64 + column as f64).sin(),
    };
    let columns = skeleton.channels();
    let values = (0..FRAMES).flat_map(|frame| (0..columns).map(move |column| value(frame, column)));
    let (rate, values) = (FrameRate::new(24.0).unwrap(), values.collect());
    Clip::new(skeleton, rate, Frame(0), FRAMES, values).unwrap()
}

fn nonsense(clip: &Clip) -> Clip {
    renamed(clip, |at, _| format!("q{at}"))
}

/// The joints by the bone that they drive.
fn driven(clip: &Clip) -> Vec<(String, Vec<JointId>)> {
    let map = BoneMap::default();
    let joints = map.locate(clip).unwrap().joints;
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
        assert_eq!(BoneMap::default().locate(&other).unwrap().dialect, SHAPE, "{name}");
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
    let clip = body();
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    let made = |clip: &Clip| Vmd::default().make(clip, &sheet).unwrap();
    let (named, shaped) = (made(&clip), made(&nonsense(&clip)));
    for bone in limbs() {
        let keys = |made: &crate::VmdMade| {
            made.motion.keys.iter().filter(|key| key.bone == bone).cloned().collect::<Vec<_>>()
        };
        assert!(!keys(&shaped).is_empty(), "{bone}");
        // A forearm turns relative to its arm, whatever the collar bone is called.
        if ["ひじ", "ひざ"].iter().any(|end| bone.ends_with(end)) {
            for (a, b) in keys(&named).iter().zip(keys(&shaped)) {
                let near = a.rotation.iter().zip(b.rotation).all(|(a, b)| (a - b).abs() < 1e-5);
                assert!(near, "{bone}: {a:?} {b:?}");
            }
        }
    }
    let told = |made: &crate::VmdMade| made.notes.iter().any(|note| note.code == "W_BY_SHAPE");
    assert!(told(&shaped) && !told(&named));
}

#[test]
fn of_a_limb_that_one_name_is_missing_of_the_shape_gives_it() {
    let clip = body();
    let odd = renamed(&clip, |at, joint| match &joint.name[..] {
        "LeftForeArm" | "RightUpLeg" => format!("q{at}"),
        name => name.into(),
    });
    assert_eq!(driven(&odd), driven(&clip));
}

/// Two clips of [`body`]: one with its usual names, one with some joints renamed.
fn called(names: &[(&str, &str)]) -> (Clip, Clip) {
    let clip = body();
    let other = renamed(&clip, |_, joint| {
        let own = names.iter().find(|(name, _)| *name == joint.name);
        own.map_or(joint.name.clone(), |(_, name)| (*name).into())
    });
    (clip, other)
}

#[test]
fn names_that_do_not_fit_the_body_give_way_to_its_shape() {
    // Each name is one joint off, such as a hip joint called the thigh. Ankles named as toes are tested elsewhere.
    let (clip, inward) = called(&[
        ("LHipJoint", "x"),
        ("LeftUpLeg", "LeftLeg"),
        ("LeftLeg", "LeftFoot"),
        ("LeftFoot", "LeftToeBase"),
        ("LeftToeBase", "y"),
    ]);
    assert_eq!(driven(&inward), driven(&clip));
    let by_shape = BoneMap::default().locate(&inward).unwrap().by_shape;
    assert_eq!(by_shape, ["左足", "左ひざ", "左足首"]);
    let (_, outward) = called(&[
        ("RightUpLeg", "z"),
        ("RightLeg", "RightUpLeg"),
        ("RightFoot", "RightLeg"),
        ("RightToeBase", "RightFoot"),
    ]);
    assert_eq!(driven(&outward), driven(&clip));
    // With the names of upper arm and forearm swapped, the hierarchy contradicts the names.
    let (_, swapped) = called(&[("LeftArm", "LeftForeArm"), ("LeftForeArm", "LeftArm")]);
    assert_eq!(driven(&swapped), driven(&clip));
    for end in ["LeftHand", "RightFoot"] {
        let (_, nameless) = called(&[(end, "x")]);
        assert_eq!(driven(&nameless), driven(&clip), "{end} without a name");
    }
    let limbs = [("LeftArm", "LeftUpLeg"), ("LeftForeArm", "LeftLeg"), ("LeftHand", "LeftFoot")];
    let exchanged: Vec<_> =
        limbs.into_iter().flat_map(|(arm, leg)| [(arm, leg), (leg, arm)]).collect();
    assert_eq!(driven(&called(&exchanged).1), driven(&clip), "an arm is no leg");
    let own = BoneMap::parse("[bones]\n\"左足\" = \"LeftLeg\"\n").unwrap();
    let found = own.locate(&inward).unwrap();
    let knee = own.model.find("左足").unwrap();
    assert_eq!(
        found.joints[knee],
        [inward.skeleton().find("LeftLeg").unwrap()],
        "a person's row stands"
    );
    let beside = "[extra.\"左つま先\"]\nparent = \"左足首\"\njoints = \"LeftFoot\"\n";
    let own = BoneMap::parse(beside).unwrap();
    let toes = own.model.find("左つま先").unwrap();
    assert_eq!(
        own.locate(&inward).unwrap().joints[toes].len(),
        1,
        "though it is a joint of the leg"
    );
}

/// The clip without the joints that hang on some of its joints, nor these: End Sites stand in their places.
fn cut(clip: &Clip, at: &[&str]) -> Clip {
    let own = clip.skeleton();
    let (mut skeleton, mut columns) = (genga::motion::Skeleton::default(), Vec::new());
    let mut kept: Vec<Option<JointId>> = Vec::new();
    for (_, joint) in own.iter() {
        let parent = joint.parent.map(|parent| kept[parent.0]);
        if at.contains(&&joint.name[..])
            && let Some(Some(parent)) = parent
        {
            let end = genga::motion::EndSite { name: "Site".into(), offset: joint.offset };
            skeleton.joints[parent.0].end_sites.push(end);
        }
        let is_kept = parent != Some(None) && !at.contains(&&joint.name[..]);
        kept.push(is_kept.then(|| JointId(skeleton.len())));
        if is_kept {
            let first_channel = columns.len();
            columns.extend(joint.first_channel..joint.first_channel + joint.channels.len());
            skeleton.joints.push(Joint {
                parent: parent.flatten(),
                first_channel,
                ..joint.clone()
            });
        }
    }
    let values = clip.rows().flat_map(|row| columns.iter().map(|column| row[*column])).collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

#[test]
fn of_a_limb_that_is_cut_short_names_give_what_is_left() {
    let clip = body();
    for (at, limb) in [
        ("LeftForeArm", &["左肩", "左腕", "左ひじ", "左手首"][..]),
        ("LeftHand", &["左肩", "左腕", "左ひじ", "左手首"]),
        ("RightFoot", &["右足", "右ひざ", "右足首"]),
    ] {
        let short = cut(&clip, &[at]);
        for ((bone, own), (_, left)) in driven(&clip).into_iter().zip(driven(&short)) {
            let name = |clip: &Clip, joint: &JointId| clip.skeleton().joints[joint.0].name.clone();
            let mut own: Vec<String> = own.iter().map(|joint| name(&clip, joint)).collect();
            own.retain(|joint| short.skeleton().find(joint).is_some());
            let left: Vec<String> = left.iter().map(|joint| name(&short, joint)).collect();
            assert!(own == left || !limb.contains(&&bone[..]), "{at}: {bone} {own:?} {left:?}");
        }
    }
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    let notes = Vmd::default().make(&cut(&clip, &["LeftForeArm"]), &sheet).unwrap().notes;
    assert!(notes.iter().any(|note| note.message.contains("left forearm will not")), "{notes:?}");
}

#[test]
fn bones_that_every_model_has_and_the_body_lacks_are_told_in_one_line() {
    let clip = body();
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    let told = |clip: &Clip| {
        let notes = Vmd::default().make(clip, &sheet).unwrap().notes;
        let told = notes.into_iter().filter(|note| note.code == "W_VMD_NO_JOINT");
        told.map(|note| note.message).collect::<Vec<_>>()
    };
    assert_eq!(told(&clip), [""; 0]);
    let short = told(&cut(&clip, &["Head", "RightFoot", "LeftHand"]));
    assert_eq!(short, ["vmd: no joint for the bones 頭, 左手首, 右足首: they will not move"]);
}

/// The clip with a second body in the same file, whose joints have other names.
fn with_another(clip: &Clip, name: impl Fn(&str) -> String) -> Clip {
    let own = clip.skeleton();
    let other = own.joints.iter().map(|joint| Joint {
        name: name(&joint.name),
        parent: joint.parent.map(|parent| JointId(parent.0 + own.len())),
        first_channel: joint.first_channel + own.channels(),
        ..joint.clone()
    });
    let joints = own.joints.iter().cloned().chain(other).collect();
    let values = clip.rows().flat_map(|row| [row, row].concat()).collect();
    let skeleton = genga::motion::Skeleton { joints };
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

#[test]
fn a_second_person_of_a_file_drives_no_bone_whatever_its_joints_are_called() {
    let clip = body();
    let of_limbs = |name: &str| {
        let is_limb = ["Left", "Right"].iter().any(|side| name.starts_with(side));
        if is_limb { format!("B_{name}") } else { format!("{name}.2") }
    };
    let names: [&dyn Fn(&str) -> String; 4] =
        [&|name| format!("{name}.2"), &of_limbs, &|name| format!("B_{name}"), &|name| {
            name.replace("Left", "L_")
        }];
    for name in names {
        let two = with_another(&clip, name);
        assert_eq!(driven(&two), driven(&clip), "{}", name("LeftArm"));
        let sheet = Sheet::on_ones(clip.clock(24.0), 3);
        let report = Vmd::default().make(&two, &sheet).unwrap().report;
        let others = two.skeleton().joints[clip.skeleton().len()..].iter();
        assert!(others.clone().all(|joint| report.left_out.contains(&joint.name)), "{report:?}");
    }
    // A person's file of bones names joints of the same person.
    let own = BoneMap::parse("[bones]\n\"上半身\" = [\"Spine\", \"Spine2\"]\n").unwrap();
    let found = own.locate(&with_another(&clip, |name| format!("{name}.2"))).unwrap();
    assert_eq!(found.missing, ["Spine2"]);
}

#[test]
fn the_ankle_of_smpl_is_no_foot_and_its_first_spine_no_chest() {
    let (clip, smpl) = called(&[
        ("Hips", "Pelvis"),
        ("LeftUpLeg", "L_Hip"),
        ("LeftLeg", "L_Knee"),
        ("LeftFoot", "L_Ankle"),
        ("LeftToeBase", "L_Foot"),
        ("LowerBack", "Spine1"),
        ("Spine", "Spine2"),
        ("Spine1", "Spine3"),
    ]);
    let joint = |bone: &str| {
        let bones = driven(&smpl).into_iter().find(|(name, _)| name == bone).unwrap().1;
        bones.iter().map(|joint| smpl.skeleton().joints[joint.0].name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(joint("左足首"), ["L_Ankle"]);
    assert_eq!([joint("上半身"), joint("上半身2")].concat(), ["Spine1", "Spine2", "Spine3"]);
    assert!(!joint("上半身").is_empty() && !joint("上半身2").is_empty());
    let sheet = Sheet::on_ones(clip.clock(24.0), 3);
    assert!(crate::vrma::write(&smpl, &sheet, None).is_ok());
}

#[test]
fn a_vrm_keeps_its_fingers() {
    let names = ["Hips", "LeftHand", "LeftHandIndex1", "LThumb"];
    let vrm = ["hips", "leftHand", "leftIndexProximal", "leftThumbMetacarpal"];
    let mut others: Vec<(&str, &str)> = names.into_iter().zip(vrm).collect();
    others.extend([("LeftArm", "leftUpperArm"), ("LeftForeArm", "leftLowerArm")]);
    others.extend([
        ("LeftUpLeg", "leftUpperLeg"),
        ("LeftLeg", "leftLowerLeg"),
        ("LeftFoot", "leftFoot"),
    ]);
    others.extend([("RightArm", "rightUpperArm"), ("RightForeArm", "rightLowerArm")]);
    let (_, clip) = called(&others);
    let found = BoneMap::default().locate(&clip).unwrap();
    assert_eq!(found.dialect, "vrm");
    let bones = driven(&clip);
    for bone in ["左人指１", "左親指０", "左手首"] {
        assert!(bones.iter().any(|(name, joints)| name == bone && joints.len() == 1), "{bone}");
    }
}

/// mocopi's 27 joints. No mocopi file is at hand, so its names are put on a clip of another system, whose trunk and
/// neck are split into as many joints as mocopi has. This tests the table, but not mocopi's own rotations.
#[test]
fn mocopi_has_arms_and_legs() {
    let clip = body();
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
    let found = BoneMap::default().locate(&mocopi).unwrap();
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
fn a_limb_whose_upper_bone_is_not_known_is_told_as_a_loss() {
    let still = still_limbs(|bone| ["左足", "左ひざ"].contains(&bone));
    assert_eq!(still, ["left arm", "right arm", "right leg"]);
    let still = still_limbs(|bone| ["腕", "ひじ", "足首"].iter().any(|end| bone.ends_with(end)));
    assert_eq!(still, ["left leg", "right leg"], "a foot alone is no leg");
    let still = still_limbs(|bone| !["左ひじ", "右ひざ", "左足首"].contains(&bone));
    assert_eq!(still, ["left forearm", "right shin"]);
}
