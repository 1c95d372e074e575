//! A person's corrections: pins and what is forbidden among the candidates, moves among the keys.

use crate::edits::{Edits, Move, Pin};
use crate::keys::merge::is_taken;
use crate::keys::{Candidates, Key, Origin};
use crate::motion::Clip;
use crate::time::Frame;

/// Candidates, what stays of itself (the ends of rests, then of contacts) and pins in order. A pin pushes out
/// what lies nearer than a koma; what stays pushes out candidates, and the end of a
/// rest those of contacts; what lies within two koma of a forbidden frame goes. `apart` is one koma in frames.
pub(super) fn corrected(
    candidates: &Candidates,
    (rests, contacts): (&[Frame], &[Frame]),
    edits: &Edits,
    clip: &Clip,
    apart: f64,
) -> Vec<Key> {
    let near = |a: Frame, b: Frame| distance(a, b) < apart;
    let unwanted = |frame: Frame| {
        edits.pins.iter().any(|pin| near(pin.frame, frame))
            || edits.forbidden.iter().any(|range| range.reaches(frame, apart))
    };
    let inside = |frame: &Frame| *frame > clip.first() && *frame < clip.last();
    let rests = rests.iter().copied().filter(inside);
    let mut keys: Vec<Key> = rests
        .filter(|frame| !unwanted(*frame))
        .map(|frame| key(frame, 1.0, Origin::Rest))
        .collect();
    for &frame in contacts.iter().filter(|frame| inside(frame) && !unwanted(**frame)) {
        if !is_taken(&keys, |key| key.frame, frame, apart) {
            let at = keys.partition_point(|other| other.frame < frame);
            keys.insert(at, key(frame, 1.0, Origin::Contact));
        }
    }
    let found: Vec<Key> = candidates
        .keys
        .iter()
        .filter(|found| {
            !unwanted(found.frame) && !is_taken(&keys, |key| key.frame, found.frame, apart)
        })
        .map(|candidate| {
            key(
                candidate.frame,
                candidate.strength,
                if candidate.is_turn { Origin::Turn } else { Origin::Fill },
            )
        })
        .collect();
    keys.extend(found);
    keys.extend(edits.pins.iter().map(|pin| wanted(pin.clone(), Origin::Pinned)));
    keys.sort_by_key(|key| key.frame);
    keys
}

/// Moves keys that were chosen, and where a person wants no others leaves theirs alone.
///
/// Only now, so that a nudge changes nothing but the key that is nudged: what was worth a drawing beside
/// it still is. A move takes the key nearest to where it begins and nearer than a koma, and pushes out
/// what lies nearer than a koma to where it ends.
pub(super) fn moved(keys: &mut Vec<Key>, edits: &Edits, apart: f64) {
    let mut taken: Vec<(usize, &Move)> = Vec::new();
    for moved in &edits.moves {
        let is_free = |at: &usize| {
            let key = &keys[*at];
            key.origin != Origin::Pinned
                && distance(key.frame, moved.from) < apart
                && taken.iter().all(|(other, _)| other != at)
        };
        let free = (0..keys.len()).filter(is_free);
        let nearest = free.min_by_key(|at| keys[*at].frame.0.abs_diff(moved.from.0));
        taken.extend(nearest.map(|at| (at, moved)));
    }
    for (at, moved) in &taken {
        keys[*at] = wanted(moved.pin(), Origin::Moved { from: moved.from });
    }
    let gives_way = |key: &Key| {
        let ends = taken.iter().map(|(_, moved)| moved.to);
        edits.only_pins || ends.clone().any(|to| distance(key.frame, to) < apart)
    };
    keys.retain(|key| key.origin.is_set() || !gives_way(key));
    keys.sort_by_key(|key| key.frame);
}

fn distance(a: Frame, b: Frame) -> f64 {
    a.0.abs_diff(b.0) as f64
}

fn key(frame: Frame, strength: f64, origin: Origin) -> Key {
    let (voters, weight, name) = (Vec::new(), None, None);
    Key { frame, strength, price: f64::INFINITY, voters, weight, name, origin }
}

fn wanted(pin: Pin, origin: Origin) -> Key {
    Key { weight: pin.weight, name: pin.name, ..key(pin.frame, 1.0, origin) }
}
