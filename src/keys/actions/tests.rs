use proptest::prelude::*;

use super::*;
use crate::keys::tests::swing;
use crate::keys::{Chords, Reference};
use crate::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use crate::time::{FrameRate, Span};
use glam::DVec3;

/// Two arms of one bone that swing about Z, by their angles in degrees at each frame of 24 fps.
fn arms(angles: &[(f64, f64)]) -> Clip {
    let joint = |name: &str, parent, channel, offset, end_sites| Joint {
        name: name.into(),
        parent,
        offset,
        channels: vec![Channel::Rotation(Axis::Z); channel],
        first_channel: 0,
        end_sites,
    };
    let tip = || vec![EndSite { name: "Site".into(), offset: DVec3::X }];
    let root = Some(JointId(0));
    let skeleton = Skeleton {
        joints: vec![
            joint("body", None, 0, DVec3::ZERO, vec![]),
            joint("left", root, 1, DVec3::Y, tip()),
            Joint { first_channel: 1, ..joint("right", root, 1, -DVec3::Y, tip()) },
        ],
    };
    let values = angles.iter().flat_map(|(left, right)| [*left, *right]).collect();
    Clip::new(skeleton, FrameRate::new(24.0).unwrap(), Frame(0), angles.len(), values).unwrap()
}

fn found(clip: &Clip, finder: &ActionFinder, asked: &[Frame]) -> Actions {
    let reference = Reference::new(clip, clip.clock(24.0));
    let chords = Chords::new(clip, &reference, &vec![1.0; clip.skeleton().len()], 2.0);
    finder.find(clip, &chords, asked)
}

/// Returns the splits that the defaults find.
fn splits(clip: &Clip) -> Vec<(usize, SplitReason)> {
    let actions = found(clip, &ActionFinder::default(), &[]);
    actions.splits().iter().map(|split| (split.frame.0, split.why)).collect()
}

/// An arm that goes to and fro for so many frames and then stands still for so many, again and again.
fn bursts(lengths: &[(usize, usize)]) -> Vec<f64> {
    let mut angles = Vec::new();
    for (moves, stands) in lengths {
        angles.extend((0..*moves).map(wave));
        let last = angles.last().copied().unwrap_or(0.0);
        angles.extend(vec![last; *stands]);
    }
    angles
}

#[test]
fn settings_that_cannot_be_are_refused() {
    let plain = ActionFinder::default;
    assert!(plain().validate().is_ok());
    for (wrong, knob) in [
        (ActionFinder { length: Span::Seconds(0.0), ..plain() }, "actions.length: "),
        (ActionFinder { length: Span::Seconds(f64::INFINITY), ..plain() }, "actions.length: "),
        (ActionFinder { contrast: 0.9, ..plain() }, "actions.contrast: "),
        (ActionFinder { contrast: f64::NAN, ..plain() }, "actions.contrast: "),
        (ActionFinder { contrast: f64::INFINITY, ..plain() }, "actions.contrast: "),
        (ActionFinder { shortest: Span::Frames(f64::NAN), ..plain() }, "actions.shortest: "),
        (ActionFinder { shortest: Span::Seconds(-1.0), ..plain() }, "actions.shortest: "),
    ] {
        assert!(wrong.validate().unwrap_err().to_string().starts_with(knob), "{knob}");
    }
}

/// To and fro at 24 frames a second.
fn wave(at: usize) -> f64 {
    40.0 * (at as f64 * 0.6).sin()
}

#[test]
fn a_rest_between_two_movements_parts_them_in_its_middle() {
    // Moves for 4 s, stands for 1 s, moves for 4 s.
    let clip = swing(&bursts(&[(96, 24), (96, 0)]));
    let [(frame, why)] = splits(&clip)[..] else { panic!("{:?}", splits(&clip)) };
    assert_eq!(why, SplitReason::Rest);
    assert!(frame.abs_diff(96 + 12) <= 1, "{frame}");
    let off = ActionFinder { split: false, ..ActionFinder::default() };
    assert!(found(&clip, &off, &[]).splits().is_empty());
}

#[test]
fn a_short_pause_parts_what_would_be_too_long_and_not_what_is_usual() {
    let pause = |moves: usize| splits(&swing(&bursts(&[(moves, 5), (moves, 0)])));
    assert_eq!(pause(48), [], "4.2 s are one action");
    let [(frame, why)] = pause(144)[..] else { panic!("{:?}", pause(144)) };
    assert_eq!(why, SplitReason::Lull);
    assert!(frame.abs_diff(144 + 2) <= 2, "{frame}");
    let clip = swing(&bursts(&[(144, 5), (144, 0)]));
    let strict = ActionFinder { contrast: 200.0, ..ActionFinder::default() };
    assert!(found(&clip, &strict, &[]).splits().is_empty());
    let long = ActionFinder { length: Span::Seconds(40.0), contrast: 20.0, ..Default::default() };
    assert!(found(&clip, &long, &[]).splits().is_empty());
}

#[test]
fn a_movement_that_goes_on_is_one_action_however_long() {
    let walk: Vec<f64> = (0..24 * 60).map(wave).collect();
    assert_eq!(splits(&swing(&walk)), []);
}

#[test]
fn a_rest_at_an_end_of_the_clip_parts_nothing() {
    assert_eq!(splits(&swing(&bursts(&[(0, 60), (96, 60)]))), []);
    assert_eq!(splits(&swing(&[30.0; 600])), [], "nothing moves at all");
    for frames in 1..4 {
        assert_eq!(splits(&swing(&vec![0.0; frames])), []);
    }
}

#[test]
fn no_action_is_shorter_than_the_shortest() {
    let clip = swing(&bursts(&[(96, 24), (26, 24), (96, 0)]));
    let frames = |shortest| -> Vec<usize> {
        let finder = ActionFinder { shortest: Span::Seconds(shortest), ..Default::default() };
        let actions = found(&clip, &finder, &[]);
        actions.splits().iter().map(|split| split.frame.0).collect()
    };
    assert_eq!(frames(1.0).len(), 2, "{:?}", frames(1.0));
    assert_eq!(frames(3.0).len(), 1, "{:?}", frames(3.0));
    assert!(frames(9.0).is_empty());
}

#[test]
fn where_another_limb_takes_over_a_new_action_begins() {
    let angles: Vec<_> =
        (0..216).map(|at| if at < 108 { (wave(at), 0.0) } else { (0.0, wave(at)) }).collect();
    let [(frame, why)] = splits(&arms(&angles))[..] else { panic!("{:?}", splits(&arms(&angles))) };
    assert_eq!(why, SplitReason::Change);
    assert!(frame.abs_diff(108) <= 2, "{frame}");
    let both: Vec<_> = (0..216).map(|at| (wave(at), wave(at + 40))).collect();
    assert_eq!(splits(&arms(&both)), [], "the same goes on");
    let faster: Vec<_> =
        (0..216).map(|at| wave(if at < 108 { at } else { 3 * at })).map(|a| (a, a)).collect();
    assert_eq!(splits(&arms(&faster)), [], "faster is the same movement");
}

#[test]
fn a_person_s_splits_are_all_there_are() {
    let clip = swing(&bursts(&[(48, 24), (48, 0)]));
    let asked = [Frame(100), Frame(7), Frame(100)];
    let off = ActionFinder { split: false, ..ActionFinder::default() };
    for finder in [ActionFinder::default(), off] {
        let actions = found(&clip, &finder, &asked);
        let all: Vec<_> =
            actions.iter().map(|action| (action.from.0, action.past.0, action.why)).collect();
        let asked = Some(SplitReason::Asked);
        assert_eq!(all, [(0, 7, None), (7, 100, asked), (100, 120, asked)]);
        assert_eq!(actions.koma(clip.clock(24.0)), [7, 100]);
        assert_eq!(actions.koma(clip.clock(12.0)), [4, 50], "the nearest koma");
    }
}

/// Angles of two arms: pieces in which each moves or stands.
fn moving() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let piece = (1..90usize, 0.0..60.0f64, 0.0..60.0f64, 0.1..1.2f64);
    prop::collection::vec(piece, 1..8).prop_map(|pieces| {
        let mut angles = Vec::new();
        for (frames, left, right, pace) in pieces {
            // Half of the pieces stand still.
            let wide = |angle: f64| if angle < 30.0 { 0.0 } else { angle };
            let wave = |at: usize| (at as f64 * pace).sin();
            angles.extend((0..frames).map(|at| (wide(left) * wave(at), wide(right) * wave(at))));
        }
        angles
    })
}

proptest! {
    #[test]
    fn actions_cover_the_clip_once_and_none_is_too_short(
        angles in moving(),
        contrast in 1.0..6.0,
        shortest in 0.0..3.0,
    ) {
        let clip = arms(&angles);
        let finder = ActionFinder { contrast, shortest: Span::Seconds(shortest), ..Default::default() };
        let actions = found(&clip, &finder, &[]);
        let mut next = clip.first();
        for action in actions.iter() {
            prop_assert_eq!(action.from, next);
            let frames = action.past.0 - action.from.0;
            prop_assert!(frames > 0);
            let whole = actions.splits().is_empty();
            prop_assert!(whole || frames as f64 >= 24.0 * shortest, "{frames} frames");
            next = action.past;
        }
        prop_assert_eq!(next.0, clip.last().0 + 1);
        prop_assert_eq!(actions.iter().count(), actions.splits().len() + 1);
    }
}
