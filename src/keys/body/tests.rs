use std::f64::consts::TAU;

use glam::{DQuat, DVec3};
use proptest::prelude::*;

use super::*;
use crate::keys::tests::swing;
use crate::motion::lanes::{LaneQuat, narrow};
use crate::motion::{Build, Clip, Screen};
use crate::time::{FrameRate, Span};

fn speeds(clip: &Clip, width: f64) -> BodySpeeds {
    let filter = LowPass { width: Span::Frames(width), ..LowPass::default() };
    BodySpeeds::new(&Tracks::of_all(clip, &Build::new(clip), &Screen::WORLD, 2.0), &filter)
}

fn turns(clip: &Clip, width: f64, persistence: f64) -> BodyTurns {
    speeds(clip, width).turns(persistence, clip.clock(24.0).frames_in_koma())
}

/// An arm that swings to and fro, at 120 frames a second.
fn to_and_fro(frames: usize, period: f64) -> Clip {
    let angles: Vec<f64> = (0..frames).map(|at| 40.0 * (TAU * at as f64 / period).cos()).collect();
    swing(&angles).with_rate(FrameRate::new(120.0).unwrap())
}

#[test]
fn an_arm_turns_where_it_reverses_and_its_walls_are_where_it_is_fastest() {
    let found = turns(&to_and_fro(241, 80.0), 9.0, 12.0);
    assert_eq!(found.turns, [40, 80, 120, 160, 200].map(Frame));
    let walls: Vec<Frame> = found.walls.iter().map(|wall| wall.frame).collect();
    assert_eq!(walls, [20, 60, 100, 140, 180, 220].map(Frame));
    assert!(found.evidence.iter().all(|own| (0.0..=1.0).contains(own)));
    assert!(found.evidence[80] > 0.9, "it turns as a whole: {}", found.evidence[80]);
    assert_eq!(found.evidence[60], 0.0, "no wall is a turn");
    let beside = found.evidence[40..80].iter().filter(|own| **own > 0.3).count();
    assert!(beside < 12, "half of a persistence away hardly anything is one: {beside}");
}

#[test]
fn a_body_that_never_moves_and_one_that_moves_evenly_do_not_turn() {
    for step in [0.0, 1.5] {
        let angles: Vec<f64> = (0..120).map(|at| step * f64::from(at)).collect();
        let found = turns(&swing(&angles), 4.0, 3.0);
        assert!(found.turns.is_empty() && found.walls.is_empty(), "{found:?}");
        assert_eq!(found.evidence.len(), 120);
    }
    for short in 1..4 {
        let found = turns(&swing(&vec![5.0; short]), 4.0, 3.0);
        assert_eq!(found.evidence.len(), short);
    }
}

#[test]
fn what_is_shorter_than_the_filter_or_the_persistence_is_no_turn() {
    let trembling: Vec<f64> = (0..241)
        .map(|at| {
            let at = f64::from(at);
            40.0 * (TAU * at / 120.0).cos() + 0.4 * (TAU * at / 8.0).cos()
        })
        .collect();
    let clip = swing(&trembling).with_rate(FrameRate::new(120.0).unwrap());
    // A window at an end of the clip does not hold whole trembles.
    let inner = |frame: &&Frame| (24..217).contains(&frame.0);
    let found = |width, persistence| turns(&clip, width, persistence).turns;
    let count = |width, persistence| found(width, persistence).iter().filter(inner).count();
    assert!(count(1.0, 3.0) > 12, "a koma apart each tremble is one: {}", count(1.0, 3.0));
    assert_eq!(count(24.0, 12.0), 3, "{:?}", found(24.0, 12.0));
}

/// Computes the bend of a track at a frame directly.
fn slow_bend(speeds: &[f64], at: usize, reach: f64) -> f64 {
    let last = speeds.len() as f64 - 1.0;
    let reach = reach.min(last);
    let place = |place: f64| {
        let place = if place > last { 2.0 * last - place } else { place.abs() };
        let low = place.floor().min(last) as usize;
        let high = (low + 1).min(speeds.len() - 1);
        speeds[low] + (place - low as f64) * (speeds[high] - speeds[low])
    };
    0.5 * (place(at as f64 - reach) + place(at as f64 + reach)) - speeds[at]
}

proptest! {
    #[test]
    fn bends_are_what_each_frame_says(
        tracks in prop::collection::vec(prop::collection::vec(0.0..9.0, 17), 1..4),
        frames in 1usize..17,
        reach in prop_oneof![0.0..30.0, (0u32..30).prop_map(f64::from)],
    ) {
        let weights: Vec<f64> = (0..tracks.len()).map(|track| 1.0 + track as f64).collect();
        let all: f64 = weights.iter().sum();
        let pattern = Pattern::from_speeds(
            tracks.iter().flat_map(|track| track[..frames].to_vec()).collect(),
            weights.iter().map(|own| own / all).collect(),
        );
        let (valleys, hills) = pattern.bends(reach);
        for at in 0..frames {
            let bend = |track: &Vec<f64>| slow_bend(&track[..frames], at, reach);
            let sum = |of: fn(f64) -> f64| -> f64 {
                tracks.iter().zip(&weights).map(|(track, own)| own / all * of(bend(track))).sum()
            };
            prop_assert!((valleys[at] - sum(|bend| bend.max(0.0))).abs() < 1e-12);
            prop_assert!((hills[at] - sum(|bend| (-bend).max(0.0))).abs() < 1e-12);
        }
    }

    #[test]
    fn the_largest_near_is_found_by_looking_at_all(
        values in prop::collection::vec(0.0..5.0, 0..40),
        reach in 0usize..12,
    ) {
        let slow = |at: usize| {
            let near = &values[at.saturating_sub(reach)..(at + reach + 1).min(values.len())];
            near.iter().copied().fold(0.0, f64::max)
        };
        let found = largest_near(&values, reach);
        prop_assert_eq!(found, (0..values.len()).map(slow).collect::<Vec<_>>());
    }

    #[test]
    fn the_way_between_rotations_is_an_axis_times_an_angle(
        from in prop::array::uniform4(-1.0..1.0f64),
        axis in prop::array::uniform3(-1.0..1.0f64),
        angle in prop_oneof![0.0..1e-9, 0.0..3.0],
        sign in prop::sample::select(&[-1.0, 1.0][..]),
    ) {
        let (from, axis) = (DQuat::from_array(from), DVec3::from_array(axis));
        prop_assume!(from.length() > 0.1 && axis.length() > 0.1);
        let (from, axis) = (from.normalize(), axis.normalize());
        let to = DQuat::from_axis_angle(axis, angle) * from * sign;
        let found = LaneQuat::splat(from).way_to(LaneQuat::splat(to)).lane(2);
        prop_assert!((found - angle * axis).length() < 1e-14 + 1e-12 * angle, "{} {}", found, angle * axis);
    }

    #[test]
    fn time_run_backwards_turns_at_the_same_moments(
        angles in prop::collection::vec(-60.0..60.0, 8..60),
        width in 1.0..9.0,
        persistence in 1.0..6.0,
    ) {
        let clip = swing(&angles);
        let back = swing(&angles.iter().rev().copied().collect::<Vec<_>>());
        let [forth, back] = [&clip, &back].map(|clip| speeds(clip, width).0.bends(persistence).0);
        for (a, b) in forth.iter().zip(back.iter().rev()) {
            prop_assert!((a - b).abs() < 1e-9 * (1.0 + a), "{} {}", a, b);
        }
    }
}

#[test]
fn wide_registers_find_the_same_bits() {
    let clip = to_and_fro(200, 37.0);
    let [wide, narrow] = [turns(&clip, 18.0, 12.5), narrow(|| turns(&clip, 18.0, 12.5))];
    assert_eq!(wide, narrow);
}
