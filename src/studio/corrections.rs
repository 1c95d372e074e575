//! Corrections (修正) of keys and holds, as a hand makes them: each is a change of the [`Edits`].

use crate::edits::{Edits, Forbidden, Hold, Move, Pin};
use crate::keys::{Key, Origin};
use crate::time::Frame;

/// A correction of one key, or of how long a drawing stays.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Correction {
    /// A key where there is none.
    Pin(Frame),
    /// What was found stays where it is, whatever the knobs say.
    Lock(Key),
    /// A correction goes; what is found stands again.
    TakeBack(Key),
    /// No key here.
    Forbid(Key),
    /// A key is drawn elsewhere.
    Move(Key, Frame),
    /// A key gets a name; none when it is empty.
    Name(Key, String),
    /// A key gets a spacing weight of its own, or loses it.
    Weight(Key, Option<f64>),
    /// What was forbidden is not any more.
    Allow(Forbidden),
    /// The drawing of a frame stays for so many koma.
    Hold(Frame, usize),
    /// It stays as long as was found.
    LetGo(Frame),
    /// Whether all keys are chosen again around the corrections.
    Again(bool),
}

impl Correction {
    /// The corrections with this one.
    pub(super) fn on(&self, edits: &Edits) -> Edits {
        let mut edits = edits.clone();
        match self {
            Self::Pin(frame) => pin(&mut edits, *frame),
            Self::Lock(key) => drop(own_pin(&mut edits, key)),
            Self::TakeBack(key) => take_back(&mut edits, key),
            Self::Forbid(key) => forbid(&mut edits, key),
            Self::Move(key, to) => move_to(&mut edits, key, *to),
            Self::Name(key, name) => {
                let name = name.trim();
                let name = (!name.is_empty()).then(|| name.to_owned());
                match own_move(&mut edits, key) {
                    Some(moved) => moved.name = name,
                    None => own_pin(&mut edits, key).name = name,
                }
            }
            Self::Weight(key, weight) => match own_move(&mut edits, key) {
                Some(moved) => moved.weight = *weight,
                None => own_pin(&mut edits, key).weight = *weight,
            },
            Self::Allow(range) => edits.forbidden.retain(|other| other != range),
            Self::Hold(frame, koma) => hold(&mut edits, *frame, *koma),
            Self::Again(again) => edits.again = *again,
            Self::LetGo(frame) => edits.holds.retain(|hold| hold.frame != *frame),
        }
        edits
    }
}

fn pin(edits: &mut Edits, frame: Frame) {
    edits.forbidden.retain(|range| *range != Forbidden::one(frame));
    edits.pins.push(Pin { frame, name: None, weight: None });
    edits.pins.sort_by_key(|pin| pin.frame);
}

fn take_back(edits: &mut Edits, key: &Key) {
    match key.origin {
        Origin::Moved { from } => edits.moves.retain(|moved| moved.from != from),
        _ => edits.pins.retain(|pin| pin.frame != key.frame),
    }
    // Without a pin nothing would be left to be the only key.
    edits.only_pins &= !(edits.pins.is_empty() && edits.moves.is_empty());
}

fn forbid(edits: &mut Edits, key: &Key) {
    take_back(edits, key);
    let found = match key.origin {
        Origin::Moved { from } => from,
        _ => key.frame,
    };
    let range = Forbidden::one(found);
    if !edits.forbidden.contains(&range) {
        edits.forbidden.push(range);
        edits.forbidden.sort_by_key(|range| range.from);
    }
}

fn move_to(edits: &mut Edits, key: &Key, to: Frame) {
    if let Some(moved) = own_move(edits, key) {
        moved.to = to;
        edits.moves.retain(|moved| moved.from != moved.to);
    } else if key.origin == Origin::Pinned {
        own_pin(edits, key).frame = to;
        edits.pins.sort_by_key(|pin| pin.frame);
    } else if to != key.frame {
        edits.moves.push(Move { from: key.frame, to, name: None, weight: None });
        edits.moves.sort_by_key(|moved| moved.from);
    }
}

fn hold(edits: &mut Edits, frame: Frame, koma: usize) {
    edits.holds.retain(|hold| hold.frame != frame);
    edits.holds.push(Hold { frame, koma });
    edits.holds.sort_by_key(|hold| hold.frame);
}

/// The move that put a key where it is.
fn own_move<'a>(edits: &'a mut Edits, key: &Key) -> Option<&'a mut Move> {
    let Origin::Moved { from } = key.origin else { return None };
    edits.moves.iter_mut().find(|moved| moved.from == from)
}

/// The pin of a key; one that was found gets it now.
fn own_pin<'a>(edits: &'a mut Edits, key: &Key) -> &'a mut Pin {
    let at = edits.pins.iter().position(|pin| pin.frame == key.frame).unwrap_or_else(|| {
        let after = edits.pins.partition_point(|pin| pin.frame < key.frame);
        edits.pins.insert(after, Pin { frame: key.frame, name: None, weight: None });
        after
    });
    &mut edits.pins[at]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(frame: usize, origin: Origin) -> Key {
        let (voters, weight, name) = (vec![], None, None);
        Key { frame: Frame(frame), strength: 1.0, price: 5.0, voters, weight, name, origin }
    }

    fn on(edits: &Edits, corrections: &[Correction]) -> Edits {
        corrections.iter().fold(edits.clone(), |edits, correction| correction.on(&edits))
    }

    #[test]
    fn a_found_key_is_locked_named_weighted_and_taken_back() {
        let found = key(42, Origin::Turn);
        let name = Correction::Name(found.clone(), " contact ".into());
        let edits = on(&Edits::default(), &[Correction::Lock(found.clone()), name]);
        let edits = Correction::Weight(found, Some(0.5)).on(&edits);
        assert_eq!(edits.pins, [Pin::parse("42:contact@0.5").unwrap()]);
        let pinned = key(42, Origin::Pinned);
        assert_eq!(Correction::TakeBack(pinned).on(&edits), Edits::default());
    }

    #[test]
    fn a_found_key_moves_on_and_back() {
        let to = |key, frame| Correction::Move(key, Frame(frame));
        let edits = to(key(41, Origin::Turn), 43).on(&Edits::default());
        assert_eq!(edits.moves, [Move::parse("41:43").unwrap()]);
        let moved = key(43, Origin::Moved { from: Frame(41) });
        let edits = to(moved.clone(), 44).on(&edits);
        assert_eq!(edits.moves, [Move::parse("41:44").unwrap()]);
        let named = Correction::Name(moved.clone(), "hit".into()).on(&edits);
        assert_eq!(named.moves, [Move::parse("41:44:hit").unwrap()]);
        assert_eq!(to(moved.clone(), 41).on(&edits), Edits::default(), "it is where it was");
        assert_eq!(Correction::TakeBack(moved).on(&edits), Edits::default());
        assert_eq!(to(key(7, Origin::Rest), 7).on(&Edits::default()), Edits::default());
    }

    #[test]
    fn a_pin_moves_as_a_pin() {
        let edits = Correction::Pin(Frame(9)).on(&Edits::default());
        let edits = Correction::Move(key(9, Origin::Pinned), Frame(12)).on(&edits);
        assert_eq!((edits.pins[0].frame, edits.moves.len()), (Frame(12), 0));
    }

    #[test]
    fn a_drawing_is_held_held_otherwise_and_let_go() {
        let edits = Correction::Hold(Frame(42), 4).on(&Edits::default());
        let edits = on(&edits, &[Correction::Hold(Frame(7), 3), Correction::Hold(Frame(42), 2)]);
        assert_eq!(edits.holds, ["7:3", "42:2"].map(|text| Hold::parse(text).unwrap()));
        let edits = Correction::LetGo(Frame(7)).on(&edits);
        assert_eq!(edits.holds, [Hold::parse("42:2").unwrap()]);
        assert_eq!(Correction::LetGo(Frame(42)).on(&edits), Edits::default());
    }

    #[test]
    fn a_forbidden_key_is_forbidden_where_it_was_found_and_may_be_again() {
        let one = |frame| vec![Forbidden::one(Frame(frame))];
        let edits = Correction::Forbid(key(41, Origin::Turn)).on(&Edits::default());
        assert_eq!(edits.forbidden, one(41));
        let moved = Correction::Move(key(41, Origin::Turn), Frame(43)).on(&Edits::default());
        let gone = Correction::Forbid(key(43, Origin::Moved { from: Frame(41) })).on(&moved);
        assert_eq!((gone.forbidden, gone.moves), (one(41), vec![]));
        assert_eq!(Correction::Allow(Forbidden::one(Frame(41))).on(&edits), Edits::default());
        let pinned = Correction::Pin(Frame(41)).on(&edits);
        assert_eq!((pinned.forbidden.len(), pinned.pins.len()), (0, 1), "the last word counts");
    }

    #[test]
    fn all_keys_are_chosen_again_while_a_person_wants_it() {
        let edits = Correction::Again(true).on(&Edits::default());
        assert!(edits.again);
        assert_eq!(Correction::Again(false).on(&edits), Edits::default());
    }

    #[test]
    fn the_last_of_the_only_pins_takes_that_wish_with_it() {
        let edits = Correction::Pin(Frame(9)).on(&Edits { only_pins: true, ..Edits::default() });
        assert!(edits.only_pins);
        let edits = Correction::TakeBack(key(9, Origin::Pinned)).on(&edits);
        assert!(!edits.only_pins, "the chain refuses to run without any key");
    }
}
