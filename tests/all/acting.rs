//! Small but deliberate movement: a nod, a gaze, a fist and a wave of the hand of somebody who otherwise stands still.

use std::f64::consts::TAU;
use std::fmt::Write;

use genga::edits::Edits;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::target::{Target, meet};

/// Frames per second, and frames of a clip.
const FPS: f64 = 30.0;
const FRAMES: usize = 91;

/// A joint: name, parent, offset and tip.
type Bone = (&'static str, &'static str, [f64; 3], Option<[f64; 3]>);

/// A body with eyes, and a hand with one finger.
const BONES: [Bone; 23] = [
    ("Hips", "", [0.0; 3], None),
    ("Spine", "Hips", [0.0, 15.0, 0.0], None),
    ("Chest", "Spine", [0.0, 20.0, 0.0], None),
    ("Neck", "Chest", [0.0, 20.0, 0.0], None),
    ("Head", "Neck", [0.0, 10.0, 0.0], Some([0.0, 18.0, 0.0])),
    ("LeftEye", "Head", [3.0, 8.0, 8.0], Some([0.0, 0.0, 2.0])),
    ("RightEye", "Head", [-3.0, 8.0, 8.0], Some([0.0, 0.0, 2.0])),
    ("LeftArm", "Chest", [18.0, 15.0, 0.0], None),
    ("LeftForeArm", "LeftArm", [28.0, 0.0, 0.0], None),
    ("LeftHand", "LeftForeArm", [25.0, 0.0, 0.0], None),
    ("LeftHandIndex1", "LeftHand", [9.0, 0.0, 2.0], None),
    ("LeftHandIndex2", "LeftHandIndex1", [4.0, 0.0, 0.0], None),
    ("LeftHandIndex3", "LeftHandIndex2", [3.0, 0.0, 0.0], Some([2.0, 0.0, 0.0])),
    ("RightArm", "Chest", [-18.0, 15.0, 0.0], None),
    ("RightForeArm", "RightArm", [-28.0, 0.0, 0.0], None),
    ("RightHand", "RightForeArm", [-25.0, 0.0, 0.0], Some([-15.0, 0.0, 0.0])),
    ("LeftUpLeg", "Hips", [9.0, -5.0, 0.0], None),
    ("LeftLeg", "LeftUpLeg", [0.0, -42.0, 0.0], None),
    ("LeftFoot", "LeftLeg", [0.0, -40.0, 0.0], Some([0.0, -5.0, 12.0])),
    ("RightUpLeg", "Hips", [-9.0, -5.0, 0.0], None),
    ("RightLeg", "RightUpLeg", [0.0, -42.0, 0.0], None),
    ("RightFoot", "RightLeg", [0.0, -40.0, 0.0], Some([0.0, -5.0, 12.0])),
    ("Jaw", "Head", [0.0, 2.0, 4.0], Some([0.0, -3.0, 5.0])),
];

/// Writes a joint and its descendants.
fn write(bvh: &mut String, name: &str, order: &mut Vec<&'static str>) {
    let (own, parent, [x, y, z], tip) = BONES.into_iter().find(|bone| bone.0 == name).unwrap();
    order.push(own);
    let (kind, channels) = match parent {
        "" => ("ROOT", "6 Xposition Yposition Zposition"),
        _ => ("JOINT", "3"),
    };
    write!(
        bvh,
        "{kind} {own}\n{{\nOFFSET {x} {y} {z}\nCHANNELS {channels} Zrotation Xrotation Yrotation\n"
    )
    .unwrap();
    for (child, ..) in BONES.into_iter().filter(|bone| bone.1 == name) {
        write(bvh, child, order);
    }
    if let Some([x, y, z]) = tip {
        write!(bvh, "End Site\n{{\nOFFSET {x} {y} {z}\n}}\n").unwrap();
    }
    bvh.push_str("}\n");
}

/// A standing body whose joints turn about X by `turn` degrees, given the joint and the second.
fn standing(turn: impl Fn(&str, f64) -> f64) -> Clip {
    let (mut bvh, mut order) = (String::from("HIERARCHY\n"), Vec::new());
    write(&mut bvh, "Hips", &mut order);
    write!(bvh, "MOTION\nFrames: {FRAMES}\nFrame Time: {}\n", 1.0 / FPS).unwrap();
    for frame in 0..FRAMES {
        bvh.push_str("0 93 0");
        for joint in &order {
            write!(bvh, " 0 {} 0", turn(joint, frame as f64 / FPS)).unwrap();
        }
        bvh.push('\n');
    }
    bvh::read(bvh.as_bytes()).unwrap().clip
}

/// Oscillates once per second between −1 and 1, with extremes at a quarter and at three quarters.
fn to_and_fro(second: f64) -> f64 {
    (TAU * second).sin()
}

/// The frames of the genga with some settings, and the koma of the longest exposure.
fn drawn(clip: &Clip, settings: &[(&str, &str)], count: Option<usize>) -> (Vec<usize>, usize) {
    let mut recipe = Recipe::default();
    for (name, value) in settings {
        recipe.set(name, value).unwrap();
    }
    let mut engine = Engine::new(clip.clone()).unwrap();
    if let Some(count) = count {
        let target = Target::Keys(count);
        let met = meet(&mut engine, &recipe, &Edits::default(), &[target]).unwrap();
        assert!(met.outcomes[0].shortfall.is_none(), "{}", met.outcomes[0]);
        recipe = met.recipe;
    }
    let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
    let layer = breakdown.first_layer();
    let longest = layer.layer.exposures.iter().map(|exposure| exposure.koma).max().unwrap();
    (layer.keys.keys.iter().map(|key| key.frame.0).collect(), longest)
}

#[test]
fn what_single_parts_act_has_genga_at_its_extremes() {
    // Joints, amplitude to each side, and an amplitude too small to be acting.
    let parts: [(&[&str], f64, f64); 8] = [
        (&["Head"], 20.0, 5.0),
        (&["Neck", "Head"], 20.0, 2.0),
        (&["LeftEye", "RightEye"], 15.0, 3.0),
        (&["Jaw"], 15.0, 3.0),
        (&["LeftHandIndex1", "LeftHandIndex2", "LeftHandIndex3"], 25.0, 8.0),
        (&["RightHand"], 30.0, 10.0),
        (&["LeftFoot"], 15.0, 5.0),
        (&["RightArm"], 20.0, 1.0),
    ];
    let extremes: Vec<f64> = (0..6).map(|half| FPS * (0.25 + 0.5 * f64::from(half))).collect();
    for (joints, far, near) in parts {
        let turned = |degrees: f64| {
            standing(
                |joint, second| {
                    if joints.contains(&joint) { degrees * to_and_fro(second) } else { 0.0 }
                },
            )
        };
        let (genga, _) = drawn(&turned(far), &[], None);
        assert_eq!(genga.len(), extremes.len(), "{joints:?}: {genga:?}");
        for (genga, extreme) in genga.iter().zip(&extremes) {
            assert!((*genga as f64 - extreme).abs() <= FPS / 24.0, "{joints:?}: {genga} {extreme}");
        }
        let (genga, longest) = drawn(&turned(near), &[], None);
        assert!(genga.is_empty() && longest == 73, "{joints:?}: {genga:?} {longest}");
    }
}

#[test]
fn before_and_after_a_nod_a_drawing_is_held() {
    let nod = standing(|joint, second| match second {
        1.0..2.0 if joint == "Head" => -20.0 * to_and_fro(second),
        _ => 0.0,
    });
    let (genga, longest) = drawn(&nod, &[], None);
    let inner: Vec<usize> =
        genga.iter().copied().filter(|frame| (32..58).contains(frame)).collect();
    assert_eq!(inner.len(), 2, "{genga:?}");
    assert!(longest >= 20, "{longest}");
}

#[test]
fn a_number_of_genga_on_a_quiet_clip_stands_at_its_own_extremes() {
    let slight =
        standing(|joint, second| if joint == "Head" { 4.0 * to_and_fro(second) } else { 0.0 });
    let (genga, _) = drawn(&slight, &[], Some(8));
    assert_eq!(genga.len(), 6, "besides both ends: {genga:?}");
    for (genga, half) in genga.iter().zip(0u32..) {
        let extreme = FPS * (0.25 + 0.5 * f64::from(half));
        assert!((*genga as f64 - extreme).abs() <= FPS / 24.0, "{genga} {extreme}");
    }
}

#[test]
fn of_a_clip_in_which_nothing_moves_no_number_of_genga_is_made() {
    let still = standing(|_, _| 0.0);
    let mut engine = Engine::new(still).unwrap();
    let targets = [Target::Keys(8)];
    let met = meet(&mut engine, &Recipe::default(), &Edits::default(), &targets).unwrap();
    let said = met.outcomes[0].to_string();
    assert!(said.contains("nothing moves"), "{said}");
}
