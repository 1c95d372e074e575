//! Tests that every joint is in one layer, and that a body that cannot be split gets an error with the reason.

use proptest::prelude::*;

use super::*;
use crate::motion::{Pose, bvh};
use crate::time::Frame;

fn sample(name: &str) -> Clip {
    let path = format!("{}/data/{name}.bvh", env!("CARGO_MANIFEST_DIR"));
    bvh::read(&std::fs::read(path).unwrap()).unwrap().clip
}

/// Returns the names of each layer's joints.
fn names(clip: &Clip, layers: &Layers) -> Vec<Vec<String>> {
    let name = |joint: &JointId| clip.skeleton().joints[joint.0].name.clone();
    let parts = layers.split(clip).unwrap();
    parts.iter().map(|part| part.joints.iter().map(name).collect()).collect()
}

fn named(layers: &[(&str, &[&str])]) -> Layers {
    let layer = |(name, joints): &(&str, &[&str])| NamedLayer {
        name: (*name).into(),
        joints: joints.iter().map(|joint| (*joint).into()).collect(),
    };
    Layers::Named(layers.iter().map(layer).collect())
}

fn assert_covers_once(clip: &Clip, parts: &[LayerJoints]) {
    let mut joints: Vec<usize> =
        parts.iter().flat_map(|part| part.joints.iter().map(|joint| joint.0)).collect();
    joints.sort_unstable();
    assert!(joints.iter().copied().eq(0..clip.skeleton().len()), "{joints:?}");
    assert!(parts.iter().all(|part| !part.joints.is_empty()));
}

#[test]
fn every_way_to_split_has_every_joint_once() {
    for name in ["kick", "pitch", "swing", "tennis", "kuroda-pitch"] {
        let clip = sample(name);
        for (layers, count) in [(Layers::Body, 1), (Layers::Limbs, 5)] {
            let parts = layers.split(&clip).unwrap();
            assert_eq!(parts.len(), count, "{name}");
            assert_covers_once(&clip, &parts);
        }
        let parts = Layers::Joints.split(&clip).unwrap();
        assert!(parts.len() > 10, "{name}: {}", parts.len());
        assert_covers_once(&clip, &parts);
    }
}

#[test]
fn limbs_are_the_trunk_then_left_and_right_arms_and_legs() {
    let clip = sample("kick");
    let layers = names(&clip, &Layers::Limbs);
    let tops: Vec<&str> = layers.iter().map(|joints| joints[0].as_str()).collect();
    let is_of = |layer: usize, side: &str, part: &str| {
        tops[layer].contains(side) && tops[layer].contains(part)
    };
    assert!(is_of(1, "Left", "Arm") && is_of(2, "Right", "Arm"), "{tops:?}");
    assert!(is_of(3, "Left", "Leg") && is_of(4, "Right", "Leg"), "{tops:?}");
    assert!(layers[0].iter().any(|joint| joint.contains("Head")), "{:?}", layers[0]);
    for (layer, side) in [(1, "Left"), (2, "Right"), (3, "Left"), (4, "Right")] {
        assert!(layers[layer].iter().all(|joint| joint.contains(side)), "{:?}", layers[layer]);
    }
    let parts = Layers::Limbs.split(&clip).unwrap();
    let columns: Vec<&str> = parts.iter().map(|part| part.name.as_str()).collect();
    assert_eq!(columns, ["A", "B", "C", "D", "E"]);
}

#[test]
fn what_never_moves_goes_with_what_carries_it() {
    let clip = sample("kick");
    let still = JointId(clip.skeleton().len() - 1);
    let carrier = clip.skeleton().joints[still.0].parent.unwrap();
    let mut moves = vec![true; clip.skeleton().len()];
    moves[still.0] = false;
    let parts = Layers::Joints.split(&clip.with_others_still(&moves)).unwrap();
    let own = parts.iter().find(|part| part.joints.contains(&still)).unwrap();
    assert!(own.joints.contains(&carrier), "{own:?}");
    let at_rest = clip.with_others_still(&vec![false; moves.len()]);
    assert_eq!(Layers::Joints.split(&at_rest).unwrap(), Layers::Body.split(&clip).unwrap());
}

#[test]
fn what_no_layer_names_is_of_the_first() {
    let clip = sample("kick");
    let layers = named(&[("body", &["Hips"]), ("腕", &["*Arm*", "*Hand*"])]);
    let parts = layers.split(&clip).unwrap();
    assert_covers_once(&clip, &parts);
    assert_eq!(parts[1].name, "腕");
    let arms = &names(&clip, &layers)[1];
    assert!(arms.iter().all(|joint| joint.contains("Arm") || joint.contains("Hand")), "{arms:?}");
    let all = named(&[("A", &["*"])]);
    assert_eq!(all.split(&clip).unwrap(), Layers::Body.split(&clip).unwrap());
}

#[test]
fn layers_that_cannot_be_say_what_would_be_right() {
    let clip = sample("kick");
    let error = |layers: &[(&str, &[&str])]| named(layers).split(&clip).unwrap_err().to_string();
    assert!(error(&[]).starts_with("layers: the list has no layer; name one, or take body"));
    assert_eq!(
        error(&[("A", &["Hips"]), ("B", &[])]),
        "layers.B: has no joint; name some, or take the layer away"
    );
    assert!(error(&[("A", &["LeftHnad"])]).ends_with("did you mean LeftHand?"));
    assert!(error(&[("A", &["*Tail*"])]).starts_with("layers.A: the clip has no joint *Tail*"));
    let twice = error(&[("A", &["Left*"]), ("B", &["*Arm"])]);
    assert!(
        twice.starts_with("layers.B: Left") && twice.contains("is in layer A already"),
        "{twice}"
    );
    assert!(error(&[("A", &["Hips"]), ("A", &["Head"])]).contains("two layers are called A"));
    for name in ["", " ", "a/b", "a:b", "a@b", "a,b"] {
        assert!(error(&[(name, &["Hips"])]).contains("is no name of a layer"), "{name}");
    }
}

#[test]
fn a_body_without_limbs_is_not_split_into_them() {
    let clip = crate::keys::tests::swing(&[0.0, 10.0, 20.0]);
    let error = Layers::Limbs.split(&clip).unwrap_err().to_string();
    assert!(error.starts_with("layers: this body has no head, two arms and two legs"), "{error}");
    assert!(error.contains("or take body"), "{error}");
}

#[test]
fn a_file_is_a_list_as_in_a_recipe() {
    let text = "[[layers]]\nname = \"A\"\njoints = [\"Hips\"]\n\n[[layers]]\nname = \"B\"\njoints = [\"*Arm\"]\n";
    assert_eq!(Layers::parse(text).unwrap(), named(&[("A", &["Hips"]), ("B", &["*Arm"])]));
    for wrong in
        ["", "layers = 3", "[[layers]]\nname = \"A\"\n", "[[layers]]\nname = \"A\"\njoint = []\n"]
    {
        let error = Layers::parse(wrong).unwrap_err().to_string();
        assert!(error.starts_with("layers: "), "{error}");
    }
}

proptest! {
    #[test]
    fn only_the_joints_of_a_part_move_and_they_move_as_before(chosen in any::<u32>()) {
        let clip = sample("kick");
        let joints = clip.skeleton().len();
        let moves: Vec<bool> = (0..joints).map(|joint| chosen >> (joint % 32) & 1 == 1).collect();
        let part = clip.with_others_still(&moves);
        let [mut own, mut first, mut found] = [0; 3].map(|_| Pose::rest(clip.skeleton()));
        first.take_frame(&clip, clip.first());
        for frame in [0, 7, clip.len() - 1].map(|row| Frame(clip.first().0 + row)) {
            own.take_frame(&clip, frame);
            found.take_frame(&part, frame);
            for (joint, moves) in moves.iter().enumerate() {
                let expected = if *moves { &own } else { &first };
                prop_assert_eq!(found.rotations[joint], expected.rotations[joint]);
                prop_assert_eq!(found.translations[joint], expected.translations[joint]);
            }
        }
    }
}
