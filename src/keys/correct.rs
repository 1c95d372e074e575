//! A person's corrections and the ends of rests among the candidates.

use crate::edits::{Edits, Move, Pin};
use crate::keys::{Candidates, Key, Origin};
use crate::motion::Clip;
use crate::time::Frame;

/// Candidates, the ends of rests and pins in order. A pin pushes out what lies nearer than a koma, a
/// forbidden frame and both frames of a move too; the end of a rest pushes out candidates. `apart` is one
/// koma in frames.
pub(super) fn corrected(
    candidates: &Candidates,
    rests: &[Frame],
    edits: &Edits,
    clip: &Clip,
    apart: f64,
) -> Vec<Key> {
    let near = |a: Frame, b: Frame| (a.0.abs_diff(b.0) as f64) < apart;
    let is_there = |from: Frame| {
        rests.iter().any(|rest| near(*rest, from))
            || candidates.keys.iter().any(|candidate| near(candidate.frame, from))
    };
    let moves: Vec<&Move> = edits.moves.iter().filter(|moved| is_there(moved.from)).collect();
    let unwanted = |frame: Frame| {
        edits.only_pins
            || edits.pins.iter().any(|pin| near(pin.frame, frame))
            || edits.forbidden.iter().any(|range| (range.distance(frame) as f64) < apart)
            || moves.iter().any(|moved| near(moved.from, frame) || near(moved.to, frame))
    };
    let key = |frame, strength, origin| Key {
        frame,
        strength,
        price: f64::INFINITY,
        voters: Vec::new(),
        weight: None,
        name: None,
        origin,
    };
    let inside = |frame: &Frame| *frame > clip.first() && *frame < clip.last();
    let rests = rests.iter().copied().filter(inside);
    let mut keys: Vec<Key> = rests
        .filter(|frame| !unwanted(*frame))
        .map(|frame| key(frame, 1.0, Origin::Rest))
        .collect();
    let at_rest = |frame: Frame| {
        let after = keys.partition_point(|rest| rest.frame < frame);
        keys[after.saturating_sub(1)..].iter().take(2).any(|rest| near(rest.frame, frame))
    };
    let found: Vec<Key> = candidates
        .keys
        .iter()
        .filter(|candidate| !unwanted(candidate.frame) && !at_rest(candidate.frame))
        .map(|candidate| key(candidate.frame, candidate.strength, Origin::Found))
        .collect();
    keys.extend(found);
    let wanted = |pin: Pin, origin| Key {
        weight: pin.weight,
        name: pin.name,
        ..key(pin.frame, 1.0, origin)
    };
    keys.extend(edits.pins.iter().map(|pin| wanted(pin.clone(), Origin::Pinned)));
    keys.extend(moves.iter().map(|moved| wanted(moved.pin(), Origin::Moved { from: moved.from })));
    keys.sort_by_key(|key| key.frame);
    keys.dedup_by_key(|key| key.frame);
    keys
}
