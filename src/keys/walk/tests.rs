use std::ops::Range;

use super::*;
use crate::edits::{Forbidden, Move, Pin};
use crate::motion::Step;

/// Frames in a koma.
const KOMA: f64 = 5.0;

/// Six steps of 13 koma from koma 2 on, the body highest as the feet pass, in a clip of 90 koma.
fn gait() -> Gait {
    let step = |at: usize| {
        let contact = 2.0 + 13.0 * at as f64;
        let [down, passing, next] = [3.0, 6.0, 13.0].map(|koma| contact + koma);
        Step { foot: at % 2, contact, down, passing, up: passing + 0.4, next }
    };
    Gait { steps: (0..6).map(step).collect() }
}

fn found(koma: f64, origin: Origin) -> Key {
    Key { origin, strength: 0.5, ..Key::set(Frame((KOMA * koma).round() as usize)) }
}

/// Lays a gait with corrections, and returns the keys in koma: a turn a koma behind each contact, two fills beside each
/// passing.
fn laid(edits: &Edits) -> Vec<(f64, Origin)> {
    let mut keys: Vec<Key> = (0..6)
        .flat_map(|at| {
            let contact = 2.0 + 13.0 * f64::from(at);
            let turn = found(contact + 0.8, Origin::Turn);
            [turn, found(contact + 4.6, Origin::Fill), found(contact + 7.4, Origin::Fill)]
        })
        .collect();
    let ends = (Frame(0), Frame(450));
    let found = keys.clone();
    let walks = Walks::new(&[gait()], Drawable { found: &found, edits, koma: KOMA, ends });
    walks.give(&mut keys, edits, KOMA);
    crate::keys::correct::moved(&mut keys, edits, KOMA);
    keys.extend(edits.pins.iter().map(|pin| Key::set(pin.frame)));
    keys.sort_by_key(|key| key.frame);
    walks.lay(&mut keys, &found, edits, KOMA);
    keys.iter().map(|key| (key.frame.0 as f64 / KOMA, key.origin)).collect()
}

/// Returns the koma of the keys of one origin.
fn koma_of(laid: &[(f64, Origin)], origin: Origin) -> Vec<f64> {
    laid.iter().filter(|key| key.1 == origin).map(|key| key.0).collect()
}

/// Returns the phases of a gait except those of some steps in a row.
fn all_but(broken: Range<usize>) -> Vec<f64> {
    let phases = |at: usize| [0.8, 3.0, 6.0, 9.6].map(|koma| 2.0 + 13.0 * at as f64 + koma);
    let steps = (0..6).filter(|at| !broken.contains(at)).flat_map(phases);
    let mut all: Vec<f64> = steps.chain([80.0]).collect();
    if !broken.is_empty() {
        // The step before them ends with their first contact.
        all.push(2.8 + 13.0 * broken.start as f64);
    }
    all.sort_by(f64::total_cmp);
    all.iter().map(|koma| (koma * KOMA).round() / KOMA).collect()
}

#[test]
fn every_step_has_the_same_phases_and_takes_the_turns_that_were_found() {
    let laid = laid(&Edits::default());
    assert_eq!(laid.len(), koma_of(&laid, Origin::Step).len(), "{laid:?}");
    assert_eq!(koma_of(&laid, Origin::Step), all_but(0..0), "up is half-way to the next contact");
}

#[test]
fn a_turn_at_the_next_contact_is_not_the_phase_before_it() {
    // The body is highest half a koma before the next foot comes down, and turns as it does.
    let mut gait = gait();
    gait.steps
        .iter_mut()
        .for_each(|step| (step.passing, step.up) = (step.contact + 8.0, step.next));
    gait.steps.iter_mut().for_each(|step| step.up = step.next - 1.2);
    let keys: Vec<Key> =
        gait.steps.iter().map(|step| found(step.next - 0.4, Origin::Turn)).collect();
    let (edits, ends) = (Edits::default(), (Frame(0), Frame(450)));
    let walks = Walks::new(&[gait], Drawable { found: &keys, edits: &edits, koma: KOMA, ends });
    for step in &walks.0[0].steps {
        let frames: Vec<f64> = step.frames.iter().flatten().map(|at| at.0 as f64 / KOMA).collect();
        assert_eq!(frames.len(), 5, "{step:?}");
        assert!((frames[3] - (step.next - 1.2)).abs() <= 0.5, "up: {frames:?}");
        assert!((frames[4] - (step.next - 0.4)).abs() <= 0.5, "contact: {frames:?}");
    }
}

#[test]
fn two_steps_share_the_frame_of_their_contact() {
    // The body is highest shortly before each contact, and each turn between the two is shown once.
    let mut gait = gait();
    gait.steps.iter_mut().for_each(|step| step.up = step.next - 1.4);
    let (edits, ends) = (Edits::default(), (Frame(0), Frame(450)));
    for off in (-10..=10).map(|tenths| f64::from(tenths) / 5.0) {
        let turn = |step: &Step| found(step.contact + off, Origin::Turn);
        let keys: Vec<Key> = gait.steps.iter().map(turn).collect();
        let drawable = Drawable { found: &keys, edits: &edits, koma: KOMA, ends };
        let walks = Walks::new(&[gait.clone()], drawable);
        let steps = &walks.0[0].steps;
        assert!(steps.windows(2).all(|pair| pair[0].frames[4] == pair[1].frames[0]), "{off}");
        let frames: Vec<Frame> =
            steps.iter().flat_map(|step| &step.frames[..4]).copied().flatten().collect();
        assert!(frames.len() == 24 && frames.is_sorted_by(|a, b| a < b), "{off}: {frames:?}");
    }
}

#[test]
fn gaits_that_meet_share_the_frame_of_their_contact() {
    // The turn is nearer to the *up* before the contact.
    let (mut slow, mut quick) = (gait(), gait());
    slow.steps.iter_mut().for_each(|step| step.up = step.next - 1.4);
    let begin = slow.steps[5].next;
    for (at, step) in quick.steps.iter_mut().enumerate() {
        let contact = begin + 9.0 * at as f64;
        let [down, passing, up, next] = [2.0, 4.0, 6.6, 9.0].map(|koma| contact + koma);
        *step = Step { foot: step.foot, contact, down, passing, up, next };
    }
    let keys = [found(begin - 0.8, Origin::Turn)];
    let (edits, ends) = (Edits::default(), (Frame(0), Frame(900)));
    let drawable = Drawable { found: &keys, edits: &edits, koma: KOMA, ends };
    let walks = Walks::new(&[slow, quick], drawable);
    assert_eq!(walks.0[0].steps[5].frames[4], walks.0[1].steps[0].frames[0]);
}

#[test]
fn a_step_that_shows_nothing_of_the_clip_takes_no_key() {
    let step = WalkStep {
        contact: 95.0,
        next: 108.0,
        frames: vec![None; 5],
        taken: vec![None; 5],
        has_no_phase: false,
    };
    assert!(!step.covers(Frame(0), KOMA));
    let begun = WalkStep { frames: vec![None, None, None, None, Some(Frame(40))], ..step };
    assert!(begun.covers(Frame(10), KOMA));
    assert!(!begun.covers(Frame(60), KOMA));
}

/// Returns the phases of all steps without those between some koma.
fn without(gone: Range<f64>) -> Vec<f64> {
    all_but(0..0).into_iter().filter(|koma| !gone.contains(koma)).collect()
}

#[test]
fn a_pin_takes_the_place_of_the_phases_near_it_and_of_no_others() {
    let pinned_at = |frame: usize| {
        let pin = Pin { frame: Frame(frame), ..Pin::parse("1").unwrap() };
        laid(&Edits { pins: vec![pin], ..Edits::default() })
    };
    let passing = pinned_at(5 * 33);
    assert_eq!(koma_of(&passing, Origin::Pinned), [33.0]);
    assert!(koma_of(&passing, Origin::Fill).is_empty(), "no key comes back");
    assert_eq!(koma_of(&passing, Origin::Step), without(34.0..34.1), "31 is two koma away");
    // Two steps share the contact at 28.8.
    let contact = pinned_at(5 * 28 + 1);
    assert_eq!(koma_of(&contact, Origin::Pinned), [28.2]);
    assert_eq!(koma_of(&contact, Origin::Step), without(28.8..28.9));
    // Between up and the next contact there is room.
    assert_eq!(koma_of(&pinned_at(198), Origin::Step), all_but(0..0));
}

#[test]
fn a_forbidden_phase_goes_alone_and_a_step_of_none_keeps_what_was_found() {
    let laid_without = |ban: Forbidden| laid(&Edits { forbidden: vec![ban], ..Edits::default() });
    let forbid_frame = |frame: usize| laid_without(Forbidden::one(Frame(frame)));
    let forbid = |from: usize, past: usize| {
        laid_without(Forbidden { from: Frame(5 * from), past: Frame(5 * past) })
    };
    let is_passing = 34.0;
    let laid_with = forbid(34, 35);
    assert_eq!(koma_of(&laid_with, Origin::Step), without(is_passing..is_passing + 0.1));
    assert!(koma_of(&laid_with, Origin::Fill).is_empty(), "no key comes in its place");
    // The contact at 28.8 is within two koma too: a single frame means the nearest alone, down.
    assert_eq!(koma_of(&forbid_frame(5 * 30), Origin::Step), without(31.0..31.1));
    // Both steps go without the contact that they share.
    assert_eq!(koma_of(&forbid(28, 29), Origin::Step), without(28.0..29.0));
    // All phases of the third step; those of its neighbours stay.
    assert_eq!(koma_of(&forbid(29, 41), Origin::Step), without(28.0..42.0));
}

#[test]
fn a_correction_of_one_step_moves_no_phase_of_another() {
    let keys: Vec<Key> =
        gait().steps.iter().map(|step| found(step.passing + 0.6, Origin::Turn)).collect();
    let frames = |edits: &Edits| {
        let ends = (Frame(0), Frame(450));
        let walks = Walks::new(&[gait()], Drawable { found: &keys, edits, koma: KOMA, ends });
        let mut laid: Vec<Key> = edits.pins.iter().map(|pin| Key::set(pin.frame)).collect();
        walks.lay(&mut laid, &keys, edits, KOMA);
        laid
    };
    let free = frames(&Edits::default());
    let pin = Pin { frame: Frame(5 * 33), ..Pin::parse("1").unwrap() };
    let pinned = frames(&Edits { pins: vec![pin], ..Edits::default() });
    let is_other = |key: &&Key| !(5 * 29..5 * 41).contains(&key.frame.0);
    assert!(free.iter().filter(is_other).eq(pinned.iter().filter(is_other)));
    assert_eq!(
        pinned.iter().filter(|key| key.strength == 0.5).count(),
        5,
        "the turns that were found"
    );
}

#[test]
fn a_phase_can_be_moved() {
    let moved = Move { from: Frame(5 * 31), to: Frame(5 * 32), name: None, weight: None };
    let laid = laid(&Edits { moves: vec![moved], ..Edits::default() });
    assert_eq!(koma_of(&laid, Origin::Moved { from: Frame(155) }), [32.0]);
    assert_eq!(koma_of(&laid, Origin::Step), without(31.0..31.1));
}

#[test]
fn where_keys_are_frozen_steps_stay_that_were_there_and_no_others_come() {
    let steps: Vec<Frame> =
        all_but(2..3).iter().map(|koma| Frame((koma * KOMA).round() as usize)).collect();
    let frozen = laid(&Edits { frozen: steps, ..Edits::default() });
    assert_eq!(koma_of(&frozen, Origin::Step), all_but(2..3));
    let frozen = laid(&Edits { frozen: vec![Frame(10)], ..Edits::default() });
    assert!(koma_of(&frozen, Origin::Step).is_empty());
    let alone = laid(&Edits { only_pins: true, ..Edits::default() });
    assert!(alone.is_empty(), "{alone:?}");
}

#[test]
fn a_step_has_the_phases_that_have_room_in_it() {
    use Phase::{Contact, Down, Passing, Up};
    for (koma, passing, phases) in [
        (20.0, 0.5, vec![Contact, Down, Passing, Up]),
        (8.0, 0.5, vec![Contact, Down, Passing, Up]),
        (8.8, 0.36, vec![Contact, Passing, Up]),
        (8.8, 0.62, vec![Contact, Down, Passing]),
        (7.0, 0.48, vec![Contact, Passing, Up]),
        (6.0, 0.5, vec![Contact, Passing]),
        (3.6, 0.5, vec![Contact, Passing]),
        (3.4, 0.5, vec![Contact]),
    ] {
        assert_eq!(Phase::with_room(koma, passing), phases, "{koma} {passing}");
    }
}

#[test]
fn a_frozen_phase_is_a_phase_again() {
    let laid = |found: &[Key], edits: &Edits| {
        let ends = (Frame(0), Frame(450));
        let walks = Walks::new(&[gait()], Drawable { found, edits, koma: KOMA, ends });
        let mut keys = found.to_vec();
        walks.lay(&mut keys, found, edits, KOMA);
        keys
    };
    let free = laid(&[], &Edits::default());
    let frames: Vec<Frame> = free.iter().map(|key| key.frame).collect();
    let found: Vec<Key> = frames.iter().copied().map(Key::set).collect();
    assert_eq!(laid(&found, &Edits { frozen: frames, ..Edits::default() }), free);
}
