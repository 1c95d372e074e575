//! Corrections (修正) of keys, holds and spoken lines, as changes of the [`Edits`].

use genga::edits::{Edits, Forbidden, Hold, Move, Pin, Speech};
use genga::keys::{Key, Origin};
use genga::time::Frame;

/// A correction of one key, of a hold, or of a spoken line.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Correction {
    /// Sets a key at a frame.
    Pin(Frame),
    /// Keeps a found key where it is, whatever the knobs say.
    PinKey(Key),
    /// Takes a correction back, so that what was found applies again.
    TakeBack(Key),
    /// Takes a key away, and bans all keys from a range, so that none is found in its place.
    Forbid(Key, Forbidden),
    /// Moves a key to a frame.
    Move(Key, Frame),
    /// Names a key. An empty name removes the name.
    Name(Key, String),
    /// Gives a key its own spacing weight, or removes it.
    Weight(Key, Option<f64>),
    /// Lifts a ban on keys.
    Allow(Forbidden),
    /// Sets for how many koma the drawing of a frame stays.
    Hold(Frame, usize),
    /// Restores the length that was found for the drawing of a frame.
    LetGo(Frame),
    /// Sets whether all keys are chosen again around the corrections.
    Again(bool),
    /// Adds copied keys.
    Paste(Vec<Pin>),
    /// Replaces a spoken line by another. Without the first adds one, without the second removes one.
    Say(Option<Speech>, Option<Speech>),
}

impl Correction {
    /// Applies this correction to those of the named column, or of all columns. A key that was set for all columns is
    /// corrected there.
    pub(super) fn on(&self, edits: &Edits, column: Option<&str>) -> Edits {
        let mut on = Of { edits: edits.clone(), column };
        match self {
            Self::Pin(frame) => on.pin(*frame),
            Self::PinKey(key) => drop(on.own_pin(key)),
            Self::TakeBack(key) => on.take_back(key),
            Self::Forbid(key, range) => on.forbid(key, *range),
            Self::Move(key, to) => on.move_to(key, *to),
            Self::Name(key, name) => {
                let name = name.trim();
                let name = (!name.is_empty()).then(|| name.to_owned());
                match on.own_move(key) {
                    Some(moved) => moved.name = name,
                    None => on.own_pin(key).name = name,
                }
            }
            Self::Weight(key, weight) => match on.own_move(key) {
                Some(moved) => moved.weight = *weight,
                None => on.own_pin(key).weight = *weight,
            },
            Self::Allow(range) => on.edits.forbidden_of(column).retain(|other| other != range),
            Self::Hold(frame, koma) => on.hold(*frame, *koma),
            Self::Paste(pins) => pins.iter().for_each(|pin| {
                on.allow(pin.frame);
                *on.own_pin(&Key::set(pin.frame)) = pin.clone();
            }),
            Self::Again(again) => on.edits.again = *again,
            Self::Say(before, line) => on.say(before.as_ref(), line.clone()),
            Self::LetGo(frame) => on.edits.holds.retain(|hold| hold.frame != *frame),
        }
        on.edits.without_empty_layers()
    }
}

/// Corrections in the making, for all columns or one.
struct Of<'a> {
    edits: Edits,
    column: Option<&'a str>,
}

impl Of<'_> {
    fn pin(&mut self, frame: Frame) {
        self.allow(frame);
        let is_it = |pin: &Pin| pin.frame == frame;
        if [self.column, None].iter().any(|column| self.edits.pins_of(*column).iter().any(is_it)) {
            return;
        }
        self.insert(Pin { frame, name: None, weight: None });
    }

    /// Inserts a pin into those of the column, in order of frames.
    fn insert(&mut self, pin: Pin) -> &mut Pin {
        let pins = self.edits.pins_of(self.column);
        let at = pins.partition_point(|other| other.frame < pin.frame);
        pins.insert(at, pin);
        &mut pins[at]
    }

    /// Lifts a ban on exactly this frame.
    fn allow(&mut self, frame: Frame) {
        let range = Forbidden::one(frame);
        for column in [self.column, None] {
            self.edits.forbidden_of(column).retain(|other| *other != range);
        }
    }

    fn take_back(&mut self, key: &Key) {
        for column in [self.column, None] {
            match key.origin {
                Origin::Moved { from } => {
                    self.edits.moves_of(column).retain(|moved| moved.from != from);
                }
                _ => self.edits.pins_of(column).retain(|pin| pin.frame != key.frame),
            }
        }
        // Without pins or moves, `only_pins` would leave the sheet without keys.
        let (edits, layers) = (&self.edits, &self.edits.layers);
        let mut own = layers.values().map(|own| own.pins.len() + own.moves.len());
        let of_all = edits.pins.len() + edits.moves.len();
        let is_left = of_all > 0 || own.any(|count| count > 0);
        self.edits.only_pins &= is_left;
    }

    fn forbid(&mut self, key: &Key, range: Forbidden) {
        self.take_back(key);
        if self.edits.forbidden.contains(&range) {
            return;
        }
        let forbidden = self.edits.forbidden_of(self.column);
        // A ban within another one stays: each genga that was taken away has its own, and comes back by it.
        forbidden.retain(|other| *other != range);
        forbidden.push(range);
        forbidden.sort_by_key(|range| range.from);
    }

    fn move_to(&mut self, key: &Key, to: Frame) {
        if let Some(moved) = self.own_move(key) {
            moved.to = to;
            for column in [self.column, None] {
                self.edits.moves_of(column).retain(|moved| moved.from != moved.to);
            }
        } else if key.origin == Origin::Pinned {
            self.own_pin(key).frame = to;
            for column in [self.column, None] {
                self.edits.pins_of(column).sort_by_key(|pin| pin.frame);
            }
        } else if to != key.frame {
            let moves = self.edits.moves_of(self.column);
            moves.push(Move { from: key.frame, to, name: None, weight: None });
            moves.sort_by_key(|moved| moved.from);
        }
    }

    fn hold(&mut self, frame: Frame, koma: usize) {
        let holds = &mut self.edits.holds;
        holds.retain(|hold| hold.frame != frame);
        holds.push(Hold { frame, koma });
        holds.sort_by_key(|hold| hold.frame);
    }

    fn say(&mut self, before: Option<&Speech>, line: Option<Speech>) {
        let speech = &mut self.edits.speech;
        if let Some(at) = speech.iter().position(|line| Some(line) == before) {
            speech.remove(at);
        }
        speech.extend(line);
        speech.sort_by_key(|line| (line.from, line.past));
    }

    /// The move that put a key where it is.
    fn own_move(&mut self, key: &Key) -> Option<&mut Move> {
        let Origin::Moved { from } = key.origin else { return None };
        let is_it = |moved: &Move| moved.from == from;
        let column = [self.column, None]
            .into_iter()
            .find(|column| self.edits.moves_of(*column).iter().any(is_it))?;
        self.edits.moves_of(column).iter_mut().find(|moved| is_it(moved))
    }

    /// The pin of a key. A found key is pinned first.
    fn own_pin(&mut self, key: &Key) -> &mut Pin {
        let is_it = |pin: &Pin| pin.frame == key.frame;
        let column = [self.column, None].into_iter().find_map(|column| {
            let at = self.edits.pins_of(column).iter().position(is_it)?;
            Some((column, at))
        });
        match column {
            Some((column, at)) => &mut self.edits.pins_of(column)[at],
            None => self.insert(Pin { frame: key.frame, name: None, weight: None }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn key(frame: usize, origin: Origin) -> Key {
        let (voters, weight, name) = (vec![], None, None);
        Key { frame: Frame(frame), strength: 1.0, price: 5.0, voters, weight, name, origin }
    }

    fn on(edits: &Edits, corrections: &[Correction]) -> Edits {
        corrections.iter().fold(edits.clone(), |edits, correction| correction.on(&edits, None))
    }

    #[test]
    fn a_found_key_is_pinned_named_weighted_and_taken_back() {
        let found = key(42, Origin::Turn);
        let name = Correction::Name(found.clone(), " contact ".into());
        let edits = on(&Edits::default(), &[Correction::PinKey(found.clone()), name]);
        let edits = Correction::Weight(found, Some(0.5)).on(&edits, None);
        assert_eq!(edits.pins, [Pin::parse("42:contact@0.5").unwrap()]);
        let pinned = key(42, Origin::Pinned);
        assert_eq!(Correction::TakeBack(pinned).on(&edits, None), Edits::default());
    }

    #[test]
    fn a_found_key_moves_on_and_back() {
        let to = |key, frame| Correction::Move(key, Frame(frame));
        let edits = to(key(41, Origin::Turn), 43).on(&Edits::default(), None);
        assert_eq!(edits.moves, [Move::parse("41:43").unwrap()]);
        let moved = key(43, Origin::Moved { from: Frame(41) });
        let edits = to(moved.clone(), 44).on(&edits, None);
        assert_eq!(edits.moves, [Move::parse("41:44").unwrap()]);
        let named = Correction::Name(moved.clone(), "hit".into()).on(&edits, None);
        assert_eq!(named.moves, [Move::parse("41:44:hit").unwrap()]);
        assert_eq!(to(moved.clone(), 41).on(&edits, None), Edits::default(), "it is where it was");
        assert_eq!(Correction::TakeBack(moved).on(&edits, None), Edits::default());
        assert_eq!(to(key(7, Origin::Rest), 7).on(&Edits::default(), None), Edits::default());
    }

    #[test]
    fn a_pin_moves_as_a_pin() {
        let edits = Correction::Pin(Frame(9)).on(&Edits::default(), None);
        let edits = Correction::Move(key(9, Origin::Pinned), Frame(12)).on(&edits, None);
        assert_eq!((edits.pins[0].frame, edits.moves.len()), (Frame(12), 0));
    }

    #[test]
    fn a_drawing_is_held_held_otherwise_and_let_go() {
        let edits = Correction::Hold(Frame(42), 4).on(&Edits::default(), None);
        let edits = on(&edits, &[Correction::Hold(Frame(7), 3), Correction::Hold(Frame(42), 2)]);
        assert_eq!(edits.holds, ["7:3", "42:2"].map(|text| Hold::parse(text).unwrap()));
        let edits = Correction::LetGo(Frame(7)).on(&edits, None);
        assert_eq!(edits.holds, [Hold::parse("42:2").unwrap()]);
        assert_eq!(Correction::LetGo(Frame(42)).on(&edits, None), Edits::default());
    }

    #[test]
    fn a_key_that_is_taken_away_bans_a_range_until_a_person_wants_one_there() {
        let range = Forbidden { from: Frame(37), past: Frame(52) };
        let edits = Correction::Forbid(key(41, Origin::Turn), range).on(&Edits::default(), None);
        assert_eq!(edits.forbidden, [range]);
        let again = Correction::Forbid(key(41, Origin::Turn), range).on(&edits, None);
        assert_eq!(again, edits, "once is enough");
        let wide = Forbidden { from: Frame(30), past: Frame(60) };
        let both = Correction::Forbid(key(33, Origin::Turn), wide).on(&edits, None);
        assert_eq!(both.forbidden, [wide, range], "a ban for each genga");
        assert_eq!(Correction::Allow(wide).on(&both, None), edits, "the other stays away");
        let moved = Correction::Move(key(41, Origin::Turn), Frame(43)).on(&Edits::default(), None);
        let gone =
            Correction::Forbid(key(43, Origin::Moved { from: Frame(41) }), range).on(&moved, None);
        assert_eq!((gone.forbidden, gone.moves), (vec![range], vec![]));
        assert_eq!(Correction::Allow(range).on(&edits, None), Edits::default());
        let pinned = Correction::Pin(Frame(41)).on(&edits, None);
        assert_eq!((pinned.forbidden.len(), pinned.pins.len()), (1, 1), "a pin is an exception");
        let one = Forbidden::one(Frame(41));
        let edits = Correction::Forbid(key(41, Origin::Turn), one).on(&Edits::default(), None);
        let twice =
            Correction::Pin(Frame(41)).on(&Correction::Pin(Frame(41)).on(&edits, None), None);
        assert_eq!((twice.forbidden.len(), twice.pins.len()), (0, 1), "the last word counts");
    }

    #[test]
    fn a_line_is_said_changed_and_taken_out() {
        let line = |text: &str| Speech::parse(text).unwrap();
        let said = |before: Option<&str>, after: Option<&str>| {
            Correction::Say(before.map(line), after.map(line))
        };
        let edits =
            on(&Edits::default(), &[said(None, Some("40..60:b")), said(None, Some("5..9:a"))]);
        assert_eq!(edits.speech, [line("5..9:a"), line("40..60:b")]);
        let edits = said(Some("5..9:a"), Some("70..90:Aki:c")).on(&edits, Some("B"));
        assert_eq!(edits.speech, [line("40..60:b"), line("70..90:Aki:c")]);
        let none = on(&edits, &[said(Some("40..60:b"), None), said(Some("70..90:Aki:c"), None)]);
        assert_eq!(none, Edits::default());
    }

    #[test]
    fn all_keys_are_chosen_again_while_a_person_wants_it() {
        let edits = Correction::Again(true).on(&Edits::default(), None);
        assert!(edits.again);
        assert_eq!(Correction::Again(false).on(&edits, None), Edits::default());
    }

    #[test]
    fn the_last_of_the_only_pins_takes_that_wish_with_it() {
        let edits =
            Correction::Pin(Frame(9)).on(&Edits { only_pins: true, ..Edits::default() }, None);
        assert!(edits.only_pins);
        let edits = Correction::TakeBack(key(9, Origin::Pinned)).on(&edits, None);
        assert!(!edits.only_pins, "the chain refuses to run without any key");
    }

    #[test]
    fn a_column_has_corrections_of_its_own_and_those_of_all_are_corrected_there() {
        let all = Correction::Pin(Frame(9)).on(&Edits::default(), None);
        let edits = Correction::Pin(Frame(20)).on(&all, Some("B"));
        assert_eq!(edits.pins, [Pin::parse("9").unwrap()]);
        assert_eq!(edits.layers["B"].pins, [Pin::parse("20").unwrap()]);
        let moved = Correction::Move(key(30, Origin::Turn), Frame(33)).on(&edits, Some("C"));
        assert_eq!(moved.layers["C"].moves, [Move::parse("30:33").unwrap()]);
        let name = Correction::Name(key(9, Origin::Pinned), "hit".into());
        assert_eq!(name.on(&edits, Some("B")).pins, [Pin::parse("9:hit").unwrap()]);
        let bare = Correction::TakeBack(key(20, Origin::Pinned)).on(&edits, Some("B"));
        assert_eq!(bare, all, "a column of which nothing is said is not named");
        let none = Correction::TakeBack(key(9, Origin::Pinned)).on(&bare, Some("B"));
        assert_eq!(none, Edits::default());
        let one = Forbidden::one(Frame(41));
        let forbidden = Correction::Forbid(key(41, Origin::Turn), one);
        let forbidden = forbidden.on(&Edits::default(), Some("B"));
        assert_eq!(forbidden.layers["B"].forbidden, [Forbidden::one(Frame(41))]);
        let allowed = Correction::Allow(Forbidden::one(Frame(41))).on(&forbidden, Some("B"));
        assert_eq!(allowed, Edits::default());
    }
}
