use super::*;
use crate::motion::bvh::{read, sample};
use crate::motion::{Joint, JointId, Pose};

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh");
    read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Returns the points of a frame, followed by the marks.
fn points(clip: &Clip, lay: &MannequinParts, frame: Frame) -> Vec<DVec3> {
    let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
    pose.take_frame(clip, frame);
    body.place(&pose);
    let marks = lay.marks.iter().map(|mark| mark.position(&body));
    body.points().iter().copied().chain(marks).collect()
}

/// Changes the joints of a clip and keeps its values.
fn with_joints(clip: &Clip, change: impl FnOnce(&mut Vec<Joint>)) -> Clip {
    let mut skeleton = clip.skeleton().clone();
    change(&mut skeleton.joints);
    let values = clip.rows().flatten().copied().collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

fn names(clip: &Clip, limb: LimbPoints) -> Vec<String> {
    limb[..3].iter().map(|joint| clip.skeleton().joints[*joint].name.clone()).collect()
}

#[test]
fn limbs_are_found_left_before_right() {
    let clip = kick();
    let lay = MannequinParts::new(&clip).unwrap();
    assert_eq!(names(&clip, lay.arms[0]), ["LeftArm", "LeftForeArm", "LeftHand"]);
    assert_eq!(names(&clip, lay.legs[1]), ["RightUpLeg", "RightLeg", "RightFoot"]);
    assert_eq!(lay.forward, 1.0);
}

#[test]
fn without_names_toes_say_which_side_is_left() {
    let clip = kick();
    let nameless = with_joints(&clip, |joints| {
        joints.iter_mut().enumerate().for_each(|(at, joint)| joint.name = format!("j{at}"));
    });
    let [named, nameless] = [&clip, &nameless].map(|clip| MannequinParts::new(clip).unwrap());
    assert_eq!((named.arms, named.legs), (nameless.arms, nameless.legs));
    assert_eq!(named.head, nameless.head);
}

#[test]
fn where_left_and_right_are_exchanged_the_face_still_looks_where_toes_point() {
    let clip = kick();
    let exchanged = with_joints(&clip, |joints| {
        joints.iter_mut().for_each(|joint| {
            joint.name = match joint.name.strip_prefix("Left") {
                Some(rest) => format!("Right{rest}"),
                None => joint.name.replace("Right", "Left"),
            };
        });
    });
    let (lay, turned) =
        (MannequinParts::new(&clip).unwrap(), MannequinParts::new(&exchanged).unwrap());
    assert_eq!((turned.forward, turned.arms[0][0]), (-1.0, lay.arms[1][0]));
    let nose = |lay: &MannequinParts| lay.marks[5].offset;
    assert!(nose(&lay).abs_diff_eq(nose(&turned), 1e-9), "{} {}", nose(&lay), nose(&turned));
}

#[test]
fn in_real_clips_noses_look_where_toes_point_and_heads_stand_on_shoulders() {
    let mut found = 0;
    let clips = sample::real_clips();
    for (name, bytes) in &clips {
        let clip = read(bytes).unwrap().clip;
        let Some(lay) = MannequinParts::new(&clip) else { continue };
        found += 1;
        let tall = lay.height;
        let mut ahead = 0.0;
        for frame in (clip.first().0..=clip.last().0).step_by(97).map(Frame) {
            let points = points(&clip, &lay, frame);
            let [middle, nose, crown] = lay.head.map(|mark| points[mark]);
            let toes = lay.legs.map(|leg| points[leg[3]] - points[leg[2]]);
            ahead += (nose - middle).dot(toes[0] + toes[1]);
            assert!((nose - middle).dot(crown - middle).abs() < 1e-6 * tall * tall, "{name}");
            let shoulders = points[lay.arms[0][0]].midpoint(points[lay.arms[1][0]]);
            let neck = middle.distance(shoulders) / tall;
            assert!((0.07..0.24).contains(&neck), "{name} {frame}: the neck is {neck} long");
            for limb in lay.arms.iter().chain(&lay.legs) {
                let tip = points[limb[2]].distance(points[limb[3]]) / tall;
                assert!((0.03..0.17).contains(&tip), "{name}: {limb:?} ends after {tip}");
            }
        }
        assert!(ahead > 0.0, "{name} looks back");
    }
    assert_eq!(found, clips.len(), "every real clip has a body");
}

/// The kick below a root that stays on the floor, as in game rigs.
fn on_a_root() -> Clip {
    let clip = kick();
    let mut skeleton = clip.skeleton().clone();
    for joint in &mut skeleton.joints {
        joint.parent = Some(joint.parent.map_or(JointId(0), |parent| JointId(parent.0 + 1)));
    }
    let root = Joint {
        name: "joint_Root".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: vec![],
        first_channel: 0,
        end_sites: vec![],
    };
    skeleton.joints.insert(0, root);
    skeleton.joints[1].offset = 90.0 * DVec3::Y;
    let values = clip.rows().flatten().copied().collect();
    Clip::new(skeleton, clip.rate(), clip.first(), clip.len(), values).unwrap()
}

#[test]
fn a_root_on_the_floor_is_no_part_of_the_body_and_changes_none() {
    let (plain, rooted) =
        (MannequinParts::new(&kick()).unwrap(), MannequinParts::new(&on_a_root()).unwrap());
    assert_eq!((rooted.root, rooted.covered[1]), (1, false), "the bone to the hips is a guide");
    assert_eq!(rooted.arms.map(|arm| arm.map(|point| point - 1)), plain.arms);
    assert!((rooted.height - plain.height).abs() < 1e-9);
    assert!(plain.covered[1..].iter().all(|covered| *covered), "the kick has nothing but a body");
}

#[test]
fn what_hangs_far_from_the_body_is_not_covered() {
    let clip = kick();
    let with_tail = with_joints(&clip, |joints| {
        let tail = Joint {
            name: "tail".into(),
            parent: Some(JointId(0)),
            offset: -40.0 * DVec3::Z,
            channels: vec![],
            first_channel: 0,
            end_sites: vec![],
        };
        joints.push(tail);
    });
    let lay = MannequinParts::new(&with_tail).unwrap();
    let (tail, body) = lay.covered.split_last().unwrap();
    assert!(!tail && body[1..].iter().all(|covered| *covered));
}

#[test]
fn a_body_without_arms_has_none() {
    let clip = kick();
    let armless = with_joints(&clip, |joints| {
        let is_arm =
            |name: &str| ["Shoulder", "Arm", "Hand"].iter().any(|part| name.contains(part));
        for joint in joints.iter_mut().filter(|joint| is_arm(&joint.name)) {
            joint.offset = DVec3::ZERO;
            joint.end_sites.clear();
        }
    });
    assert_eq!(MannequinParts::new(&armless), None);
}
