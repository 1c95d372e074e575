//! Applies a person's corrections: pins and forbidden frames to the candidates, moves to the keys.

use crate::edits::{Edits, Move, Pin};
use crate::keys::merge::is_taken;
use crate::keys::{Candidates, Key, Origin};
use crate::motion::Clip;
use crate::time::Frame;

/// Returns the candidates, the moments that stay (ends of rests, then of contacts) and the pins, in order. A pin pushes
/// out everything nearer than a koma. Moments that stay push out candidates, and ends of rests push out those of
/// contacts. Everything within two koma of a forbidden frame goes, except pins. `apart` is one koma in frames.
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

/// Moves chosen keys and, if a person wants only their own keys, drops the others.
///
/// Moves come last, so that a nudge changes nothing but the nudged key: the keys beside it are still worth a drawing. A
/// move takes the key nearest to its begin, nearer than a koma, and pushes out every key nearer than a koma to its end,
/// unless a person set it.
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
