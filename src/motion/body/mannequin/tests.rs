use super::*;
use crate::motion::{Axis, Build, Channel, Clip, EndSite, Joint, JointId};
use crate::time::{Frame, FrameRate};

/// Name, parent and offset of a joint.
type Bone = (&'static str, Option<usize>, [f64; 3]);

/// A standing body with its arms spread.
const BODY: [Bone; 16] = [
    ("hips", None, [0.0, 90.0, 0.0]),
    ("chest", Some(0), [0.0, 45.0, 0.0]),
    ("neck", Some(1), [0.0, 10.0, 0.0]),
    ("head", Some(2), [0.0, 12.0, 0.0]),
    ("collar.l", Some(1), [4.0, 6.0, 0.0]),
    ("shoulder.l", Some(4), [14.0, 0.0, 0.0]),
    ("elbow.l", Some(5), [28.0, 0.0, 0.0]),
    ("wrist.l", Some(6), [25.0, 0.0, 0.0]),
    ("shoulder.r", Some(1), [-18.0, 6.0, 0.0]),
    ("twist.r", Some(8), [-9.0, 0.0, 0.0]),
    ("elbow.r", Some(9), [-19.0, 0.0, 0.0]),
    ("wrist.r", Some(10), [-25.0, 0.0, 0.0]),
    ("hip.l", Some(0), [9.0, -4.0, 0.0]),
    ("knee.l", Some(12), [0.0, -40.0, 0.0]),
    ("hip.r", Some(0), [-9.0, -4.0, 0.0]),
    ("knee.r", Some(14), [0.0, -40.0, 0.0]),
];

/// The body of [`BODY`] with ankles, toes, hands and a crown.
fn body() -> Clip {
    let mut joints: Vec<Joint> = BODY
        .iter()
        .enumerate()
        .map(|(at, (name, parent, offset))| Joint {
            name: (*name).into(),
            parent: parent.map(JointId),
            offset: DVec3::from_array(*offset),
            channels: vec![Channel::Rotation(Axis::X)],
            first_channel: at,
            end_sites: vec![],
        })
        .collect();
    let mut add = |name: &str, parent: usize, offset: DVec3, tip: DVec3| {
        let end_sites = vec![EndSite { name: "Site".into(), offset: tip }];
        let (channels, first_channel) = (vec![Channel::Rotation(Axis::X)], joints.len());
        let parent = Some(JointId(parent));
        joints.push(Joint {
            name: name.into(),
            parent,
            offset,
            channels,
            first_channel,
            end_sites,
        });
    };
    add("ankle.l", 13, -39.0 * DVec3::Y, DVec3::new(0.0, -6.0, 14.0));
    add("ankle.r", 15, -39.0 * DVec3::Y, DVec3::new(0.0, -6.0, 14.0));
    add("fingers.l", 7, 9.0 * DVec3::X, 8.0 * DVec3::X);
    add("fingers.r", 11, -9.0 * DVec3::X, -8.0 * DVec3::X);
    joints[3].end_sites = vec![EndSite { name: "Site".into(), offset: 12.0 * DVec3::Y }];
    clip(Skeleton { joints })
}

/// Two frames without rotation.
fn clip(skeleton: Skeleton) -> Clip {
    let rate = FrameRate::new(24.0).unwrap();
    let values = vec![0.0; 2 * skeleton.channels()];
    Clip::new(skeleton, rate, Frame(0), 2, values).unwrap()
}

fn mannequin(clip: &Clip) -> Option<Mannequin> {
    Build::new(clip).mannequin
}

fn stand(clip: &Clip) -> Stand {
    let body = crate::motion::Body::new(clip.skeleton());
    mannequin(clip).unwrap().stand(|point| point.position(&body))
}

#[test]
fn its_joints_are_found_past_collars_and_twists() {
    let clip = body();
    let names = mannequin(&clip).unwrap().joints().map(|joint| &clip.skeleton().joints[joint].name);
    assert_eq!(
        names.map(String::as_str),
        [
            "chest",
            "neck",
            "shoulder.l",
            "elbow.l",
            "wrist.l",
            "wrist.l",
            "hip.l",
            "knee.l",
            "ankle.l",
            "ankle.l",
            "shoulder.r",
            "elbow.r",
            "wrist.r",
            "wrist.r",
            "hip.r",
            "knee.r",
            "ankle.r",
            "ankle.r",
        ]
    );
}

#[test]
fn it_stands_as_the_rig_stands_with_bones_of_its_own() {
    let stand = stand(&body());
    let [neck, head] = [stand.points[0], stand.points[1]];
    assert!(neck.abs_diff_eq(0.30 * DVec3::Y, 1e-12) && head.abs_diff_eq(0.44 * DVec3::Y, 1e-12));
    let elbow = stand.points[3];
    assert!((elbow.x - 0.28).abs() < 1e-12 && (elbow.y - 0.30).abs() < 1e-12, "{elbow}");
    let ankles = [stand.points[8], stand.points[16]];
    assert!(ankles.iter().all(|ankle| (ankle.y + 0.48).abs() < 0.05), "{ankles:?}");
    assert_eq!(stand.across, [-DVec3::X; 2]);
    // The leg, 79 long, is that of a person of height 79 / 0.48.
    assert!((stand.pelvis.y - 86.0 * 0.48 / 79.0).abs() < 1e-12);
}

#[test]
fn a_spine_of_more_joints_and_a_bigger_head_change_nothing() {
    let plain = body();
    let mut skeleton = plain.skeleton().clone();
    skeleton.joints[2].offset *= 0.9;
    skeleton.joints[3].offset += 1.0 * DVec3::Y;
    let other = clip(skeleton);
    let [a, b] = [&plain, &other].map(stand);
    assert!(a.points.iter().zip(b.points).all(|(a, b)| a.abs_diff_eq(b, 1e-12)));
}

#[test]
fn what_is_no_person_has_none() {
    let mut skeleton = body().skeleton().clone();
    skeleton.joints.truncate(4);
    assert_eq!(mannequin(&clip(skeleton)), None);
}
