//! Tests that world positions are preserved, whatever the parents of the joints.

use proptest::prelude::*;

use super::*;
use genga::motion::{Body, Poser};

fn bone(name: &str, parent: Option<usize>, rest: DAffine3) -> Bone {
    Bone { name: name.into(), parent, rest: Stand::new(&rest) }
}

fn affine(numbers: &[f64]) -> DAffine3 {
    let turn = DQuat::from_euler(glam::EulerRot::XYZ, numbers[0], numbers[1], numbers[2]);
    let scale = DVec3::splat(numbers[3].abs() + 0.1);
    DAffine3::from_scale_rotation_translation(
        scale,
        turn,
        DVec3::new(numbers[4], numbers[5], numbers[6]),
    )
}

/// World transforms of three joints in a chain, frame by frame, from their local ones.
fn chain(frames: &[[f64; 21]]) -> Vec<[DAffine3; 3]> {
    let world = |numbers: &[f64; 21]| {
        let [a, b, c] = [0, 7, 14].map(|at| affine(&numbers[at..at + 7]));
        [a, a * b, a * b * c]
    };
    frames.iter().map(world).collect()
}

fn made(rest: &[DAffine3; 3], frames: &[[DAffine3; 3]]) -> Clip {
    let bones = ["hip", "knee", "foot"];
    let bones = bones.iter().zip(rest).enumerate();
    let bones =
        bones.map(|(at, (name, rest))| bone(name, at.checked_sub(1), *rest)).collect::<Vec<_>>();
    let stand = |frame: usize, world: &mut [DAffine3]| world.copy_from_slice(&frames[frame]);
    let posed = Posed::new(bones, frames.len(), &Options::default(), stand).unwrap();
    posed.clip(FrameRate::new(30.0).unwrap()).unwrap().0
}

fn places(clip: &Clip, frame: usize) -> Vec<DVec3> {
    let mut poser = Poser::new(clip);
    let mut body = Body::new(clip.skeleton());
    body.place(poser.frame(Frame(frame)));
    body.positions().to_vec()
}

proptest! {
    #[test]
    fn places_in_the_world_stay_whatever_scales_and_turns(
        rest in prop::array::uniform21(-3.0f64..3.0),
        frames in prop::collection::vec(prop::array::uniform21(-3.0f64..3.0), 1..6),
    ) {
        let (rest, frames) = (chain(&[rest])[0], chain(&frames));
        let clip = made(&rest, &frames);
        for (frame, world) in frames.iter().enumerate() {
            for (place, world) in places(&clip, frame).iter().zip(world) {
                prop_assert!((*place - world.translation).length() < 1e-7 * (1.0 + place.length()));
            }
        }
    }
}

#[test]
fn at_rest_nothing_is_turned_and_a_bone_that_keeps_its_place_has_no_position() {
    let turned = |angle: f64, y: f64| {
        DAffine3::from_rotation_translation(DQuat::from_rotation_x(angle), DVec3::new(0.0, y, 0.0))
    };
    let rest = [turned(1.2, 3.0), turned(-0.4, 2.0), turned(0.3, 0.5)];
    let clip = made(&rest, &[rest, rest]);
    let channels: Vec<usize> = clip.skeleton().joints.iter().map(|j| j.channels.len()).collect();
    assert_eq!(channels, [6, 3, 3]);
    let offsets: Vec<f64> = clip.skeleton().joints.iter().map(|j| j.offset.y).collect();
    assert!((offsets[1] + 1.0).abs() < 1e-12 && (offsets[2] + 1.5).abs() < 1e-12, "{offsets:?}");
    assert!(
        clip.row(Frame(1))[3..].iter().all(|angle| angle.abs() < 1e-6),
        "{:?}",
        clip.row(Frame(1))
    );
}

#[test]
fn an_end_becomes_a_tip_and_two_trees_are_told() {
    let at = |x: f64, y: f64| DAffine3::from_translation(DVec3::new(x, y, 0.0));
    let rests = [at(0.0, 1.0), at(0.0, 2.0), at(5.0, 0.0)];
    let called = |end: &str| {
        vec![
            bone("Hips", None, rests[0]),
            bone(end, Some(0), rests[1]),
            bone("Hips", None, rests[2]),
        ]
    };
    let bones = || called("Hips_end");
    let stand = |_: usize, world: &mut [DAffine3]| world.copy_from_slice(&rests);
    let rate = FrameRate::new(24.0).unwrap();
    let options = Options::default();
    for (end, joints) in [("EndSite_Hips", 2), ("Endless", 3)] {
        let (clip, _) = Posed::new(called(end), 2, &options, stand).unwrap().clip(rate).unwrap();
        assert_eq!(clip.skeleton().len(), joints, "{end}");
    }
    let (clip, warnings) = Posed::new(bones(), 2, &options, stand).unwrap().clip(rate).unwrap();
    let names: Vec<&str> = clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["Hips", "Hips.2"]);
    assert_eq!(clip.skeleton().joints[0].end_sites[0].offset, DVec3::Y);
    let codes: Vec<&str> = warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(codes, ["W_NAME_TWICE", "W_ROOTS"]);
    let second = Options { root: Some("Hips.2".into()), ..Options::default() };
    let (clip, _) = Posed::new(bones(), 2, &second, stand).unwrap().clip(rate).unwrap();
    assert_eq!((clip.skeleton().len(), clip.row(Frame(0))[0]), (1, 5.0));
    let none = Options { root: Some("Sword".into()), ..Options::default() };
    let error = Posed::new(bones(), 2, &none, stand).err().unwrap().to_string();
    assert_eq!(error, "root: no tree is called \"Sword\"; the file has Hips, Hips.2");
    let error = Posed::new(bones(), usize::MAX, &options, stand).err().unwrap().to_string();
    assert!(error.contains("--fps"), "{error}");
    assert!(Posed::new(vec![], 2, &options, stand).is_err());
}
