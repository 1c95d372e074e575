use super::*;
use crate::motion::bvh;
use crate::pipeline::tests::walking::{ROUND, walk};

/// A pendulum of one bone at 48 frames per second, a round of 48 frames.
fn pendulum(frames: usize, degrees: f64) -> Clip {
    let mut text = String::from(
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n\
         OFFSET 0 -50 0\n}\n}\nMOTION\n",
    );
    text += &format!("Frames: {frames}\nFrame Time: {}\n", 1.0 / 48.0);
    for frame in 0..frames {
        let turn = std::f64::consts::TAU * frame as f64 / 48.0;
        text += &format!("{} 0 0\n", degrees * turn.sin());
    }
    bvh::read(text.as_bytes()).unwrap().clip
}

#[test]
fn a_clip_that_ends_as_it_begins_is_a_cycle_however_far_it_travelled() {
    for (phase, travel) in [(0.3, 0.0), (0.3, 2.0), (0.77, 2.0)] {
        let clip = walk(phase, ROUND + 1, travel);
        let cycle = Cycle::of_clip(&clip).unwrap();
        assert!(cycle.pose < 1e-4 && cycle.is_closed() && cycle.reach > 8.0, "{cycle:?}");
        assert_eq!(Cycle::note(&clip).unwrap().code, IS_CYCLE);
        for frames in [ROUND - 3, ROUND + 6, ROUND / 2 + 1] {
            let cycle = Cycle::of_clip(&walk(phase, frames, travel)).unwrap();
            assert!(!cycle.is_closed(), "{frames}: {cycle:?}");
        }
    }
}

#[test]
fn a_pose_that_is_passed_again_the_other_way_is_no_cycle() {
    let whole = Cycle::of_clip(&pendulum(49, 30.0)).unwrap();
    assert!(whole.is_closed(), "{whole:?}");
    let half = Cycle::of_clip(&pendulum(25, 30.0)).unwrap();
    assert!(half.pose < 1e-6 && half.speed > SAME_SPEED && !half.is_closed(), "{half:?}");
}

#[test]
fn a_body_that_does_not_move_or_has_few_frames_is_no_cycle() {
    let still = pendulum(49, 0.0);
    assert!(!Cycle::of_clip(&still).unwrap().is_closed());
    assert_eq!((Cycle::note(&still), Cycle::find_all(&still)), (None, vec![]));
    assert_eq!(Cycle::of_clip(&pendulum(4, 30.0)), None);
    assert_eq!(Cycle::find_all(&pendulum(4, 30.0)), []);
}

#[test]
fn a_walk_offers_its_strides_from_contact_to_contact() {
    let cycles = Cycle::find_all(&walk(0.3, 6 * ROUND, 2.0));
    assert!((4..=MOST).contains(&cycles.len()), "{cycles:?}");
    assert!(cycles.is_sorted_by(|a, b| a.gap() <= b.gap()), "{cycles:?}");
    assert!(cycles.iter().all(|cycle| cycle.frames() % ROUND == 0 && cycle.is_closed()));
    assert!(cycles.iter().any(|cycle| cycle.frames() == 2 * ROUND), "two strides");
}

#[test]
fn a_motion_without_a_gait_offers_its_closest_poses() {
    let cycles = Cycle::find_all(&pendulum(160, 30.0));
    assert!(!cycles.is_empty() && cycles.len() <= MOST);
    let best = cycles[0];
    assert!(best.frames().is_multiple_of(48) && best.is_closed(), "{cycles:?}");
}
