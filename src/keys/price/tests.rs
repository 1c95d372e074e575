use glam::DVec3;

use super::*;
use crate::motion::{Axis, Body, Channel, EndSite, Joint, JointId, Pose, Skeleton};
use crate::time::FrameRate;

/// An arm of one bone that swings about Z, given by its angle in degrees at each frame of 24 fps.
pub(in crate::keys) fn swing(angles: &[f64]) -> Clip {
    let joint = |name: &str, parent, channels: &[Channel], end_sites| Joint {
        name: name.into(),
        parent,
        offset: DVec3::X,
        channels: channels.to_vec(),
        first_channel: 0,
        end_sites,
    };
    let tip = EndSite { name: "Site".into(), offset: DVec3::X };
    let skeleton = Skeleton {
        joints: vec![
            joint("shoulder", None, &[Channel::Rotation(Axis::Z)], vec![]),
            Joint { first_channel: 1, ..joint("hand", Some(JointId(0)), &[], vec![tip]) },
        ],
    };
    let rate = FrameRate::new(24.0).unwrap();
    Clip::new(skeleton, rate, Frame(0), angles.len(), angles.to_vec()).unwrap()
}

fn entries(frames: &[usize], last: usize) -> Vec<Entry> {
    let entry =
        |frame: &usize| Entry { frame: Frame(*frame), stays: *frame == 0 || *frame == last };
    frames.iter().map(entry).collect()
}

fn frames(entries: &[Entry]) -> Vec<Frame> {
    entries.iter().map(|entry| entry.frame).collect()
}

fn triangle(frames: usize, turn: usize) -> Vec<f64> {
    (0..frames).map(|at| 3.0 * (turn as f64 - at.abs_diff(turn) as f64)).collect()
}

/// The error of a bridge without anything known of it before.
fn whole_error(bridge: &mut Bridge<'_>, from: usize, at: usize, to: usize) -> f64 {
    let (least, _) = bridge.least_error(from, at, to);
    bridge.error(from, at, to, least)
}

#[test]
fn a_key_on_an_even_turn_goes_and_the_turning_point_stays() {
    let clip = swing(&triangle(21, 10));
    let reference = Reference::of(&clip, clip.clock(24.0));
    let kept =
        worthwhile(&clip, &reference, &entries(&[0, 5, 10, 20], 20), 1e-6, usize::MAX).prices;
    assert_eq!(kept[1], None);
    assert!(kept[2].is_some_and(|price| price > 20.0), "{kept:?}");
    assert_eq!((kept[0], kept[3]), (Some(f64::INFINITY), Some(f64::INFINITY)));
}

#[test]
fn the_bridge_equals_a_slerp_a_koma() {
    let clip = swing(&(0..40).map(|at| 40.0 * (at as f64 * 0.4).sin()).collect::<Vec<_>>());
    let clip = clip.with_rate(FrameRate::new(50.0).unwrap());
    let reference = Reference::of(&clip, clip.clock(24.0));
    let ends = entries(&[3, 36], 36);
    let fast = whole_error(&mut Bridge::new(&clip, &reference, &frames(&ends)), 0, 0, 1);
    let (mut from, mut to) = (Pose::rest(clip.skeleton()), Pose::rest(clip.skeleton()));
    from.take_frame(&clip, Frame(3));
    to.take_frame(&clip, Frame(36));
    let mut pose = from.clone();
    let (mut source, mut slow) = (from.clone(), 0.0);
    let mut body = Body::new(clip.skeleton());
    let (mut a, mut b) = ([DVec3::ZERO; 2], [DVec3::ZERO; 2]);
    for koma in 0..20 {
        let place = koma as f64 * 50.0 / 24.0;
        if place > 3.0 && place < 36.0 {
            pose.take_blend(&from, &to, (place - 3.0) / 33.0);
            source.take_place(&clip, place);
            body.place(&pose, &mut a);
            body.place(&source, &mut b);
            // The arm is straight: its tip lies as far from the hand as the hand from the shoulder.
            let tip = |arm: &[DVec3; 2]| 2.0 * arm[1] - arm[0];
            let squares = a[1].distance_squared(b[1]) + tip(&a).distance_squared(tip(&b));
            slow = f64::max(slow, (squares / 2.0).sqrt());
        }
    }
    slow *= 100.0 / reference.height();
    assert!((fast - slow).abs() < 1e-9 * slow, "{fast} {slow}");
}

#[test]
fn the_error_is_the_same_whichever_koma_was_looked_at_first() {
    let clip = swing(&(0..40).map(|at| 40.0 * (at as f64 * 0.4).sin()).collect::<Vec<_>>());
    let reference = Reference::of(&clip, clip.clock(24.0));
    let list = entries(&(3..37).collect::<Vec<_>>(), 36);
    let list = frames(&list);
    let mut bridge = Bridge::new(&clip, &reference, &list);
    let last = list.len() - 1;
    let wholes: Vec<f64> = (0..=last).map(|at| whole_error(&mut bridge, 0, at, last)).collect();
    assert!(wholes.iter().all(|whole| *whole == wholes[0]), "{wholes:?}");
    let leasts = (0..=last).map(|at| bridge.least_error(0, at, last).0);
    assert_eq!(leasts.fold(0.0, f64::max), wholes[0], "the worst koma is one of them");
}

/// The same from the words: each round prices every entry anew and takes the cheapest away.
fn slowly(
    clip: &Clip,
    reference: &Reference,
    entries: &[Entry],
    enough: f64,
    most: usize,
) -> Vec<Frame> {
    let mut kept = entries.to_vec();
    loop {
        let frames = frames(&kept);
        let price =
            |at: usize| whole_error(&mut Bridge::new(clip, reference, &frames), at - 1, at, at + 1);
        let cheapest = (1..kept.len() - 1)
            .filter(|at| !kept[*at].stays)
            .map(|at| (price(at), at))
            .reduce(|a, b| if b.0 < a.0 { b } else { a });
        let left = kept.iter().filter(|entry| !entry.stays).count();
        match cheapest {
            Some((price, at)) if price < enough || left > most => kept.remove(at),
            _ => return kept.iter().map(|entry| entry.frame).collect(),
        };
    }
}

#[test]
fn the_ranked_list_equals_pricing_everything_anew_each_round() {
    let angles: Vec<f64> = (0..60).map(|at| 30.0 * (at as f64 * 0.3).sin() + at as f64).collect();
    let clip = swing(&angles);
    let reference = Reference::of(&clip, clip.clock(24.0));
    let mut list = entries(&[0, 5, 11, 16, 22, 27, 33, 40, 48, 59], 59);
    list[4].stays = true;
    for (enough, most) in [(0.0, 9), (1.0, 9), (5.0, 9), (20.0, 9), (0.0, 4), (1.0, 2), (0.0, 0)] {
        let kept = worthwhile(&clip, &reference, &list, enough, most).prices;
        let frames: Vec<Frame> = list
            .iter()
            .zip(&kept)
            .filter(|(_, kept)| kept.is_some())
            .map(|(e, _)| e.frame)
            .collect();
        assert_eq!(frames, slowly(&clip, &reference, &list, enough, most), "{enough} {most}");
        assert_eq!(kept[4], Some(f64::INFINITY), "what stays is never taken away");
    }
}

#[test]
fn nothing_between_two_frames_costs_nothing() {
    let clip = swing(&[0.0, 10.0, 0.0]);
    let reference = Reference::of(&clip, clip.clock(24.0));
    let ends = entries(&[0, 1], 2);
    assert_eq!(whole_error(&mut Bridge::new(&clip, &reference, &frames(&ends)), 0, 0, 1), 0.0);
    let still = swing(&[0.0; 9]);
    let reference = Reference::of(&still, still.clock(24.0));
    assert_eq!(
        worthwhile(&still, &reference, &entries(&[0, 4, 8], 8), 0.0, usize::MAX).prices[1],
        Some(0.0)
    );
}

#[test]
fn what_is_worth_it_but_over_the_limit_is_counted() {
    let angles: Vec<f64> = (0..60).map(|at| 30.0 * (at as f64 * 0.3).sin() + at as f64).collect();
    let clip = swing(&angles);
    let reference = Reference::of(&clip, clip.clock(24.0));
    let list = entries(&[0, 5, 11, 16, 22, 27, 33, 40, 48, 59], 59);
    let kept = |most| {
        let worthwhile = worthwhile(&clip, &reference, &list, 5.0, most);
        (worthwhile.prices.iter().flatten().count() - 2, worthwhile.over_limit)
    };
    let (worth, none) = kept(usize::MAX);
    assert!(worth > 2 && none == 0);
    assert_eq!(kept(2), (2, worth - 2));
}
