//! Corrections that add up from run to run: later ones over earlier ones.

use super::{Edits, Frames, LayerEdits, Move, Pin};
use crate::time::Frame;

impl Edits {
    /// Lays these corrections over earlier ones. Where two contradict each other the later one wins: a pin lifts a ban
    /// of its frame, a ban removes pins and moves into it, a move replaces pins and moves at its end, a hold replaces
    /// that of the same frame. A key that was pinned or moved to a frame and is moved from there goes all the way; one
    /// that is moved back is as it was found. Splits and frozen keys replace the earlier ones.
    ///
    /// ```
    /// use genga::edits::{Edits, Move, Pin};
    ///
    /// let earlier = Edits { moves: vec![Move::parse("73:75")?], ..Edits::default() };
    /// let later = Edits { moves: vec![Move::parse("75:78")?], ..Edits::default() };
    /// assert_eq!(later.over(earlier).moves, [Move::parse("73:78")?]);
    /// # Ok::<(), genga::Error>(())
    /// ```
    #[must_use]
    pub fn over(mut self, earlier: Self) -> Self {
        let mut both = earlier;
        if self.freeze() || self.again {
            both = both.without_frozen();
            both.again = false;
        }
        let (mut of_all, later) = (both.take_of_all(), self.take_of_all());
        lay(&mut of_all, later);
        LayerEdits {
            pins: both.pins,
            forbidden: both.forbidden,
            moves: both.moves,
            frozen: both.frozen,
        } = of_all;
        for (name, later) in self.layers {
            lay(both.layers.entry(name).or_default(), later);
        }
        both.holds.retain(|hold| self.holds.iter().all(|later| later.frame != hold.frame));
        both.holds.extend(self.holds);
        both.only_pins |= self.only_pins;
        both.again |= self.again;
        if !self.splits.is_empty() {
            both.splits = self.splits;
        }
        both.speech.retain(|line| !self.speech.contains(line));
        both.speech.extend(self.speech);
        both.camera.retain(|cue| !self.camera.contains(cue));
        both.camera.extend(self.camera);
        both.at = self.at.or(both.at);
        both.length = self.length.or(both.length);
        both.slate = self.slate.over(both.slate);
        both.without_empty_layers()
    }

    /// Removes the frozen keys.
    #[must_use]
    pub fn without_frozen(mut self) -> Self {
        self.frozen.clear();
        self.layers.values_mut().for_each(|own| own.frozen.clear());
        self.without_empty_layers()
    }

    /// Leaves out corrections outside `first..=last`, which [`validate`](Self::validate) refuses.
    #[must_use]
    pub fn within(mut self, first: Frame, last: Frame) -> Self {
        let clip = Frames { first, last };
        let mut of_all = self.take_of_all();
        of_all.keep_within(clip);
        LayerEdits {
            pins: self.pins,
            forbidden: self.forbidden,
            moves: self.moves,
            frozen: self.frozen,
        } = of_all;
        self.layers.values_mut().for_each(|own| own.keep_within(clip));
        self.holds.retain(|hold| clip.has(hold.frame));
        self.splits.retain(|split| *split > first && clip.has(*split));
        self.speech.retain(|line| line.from <= last && line.past > first);
        self.camera.retain(|cue| cue.frames[0] <= last && cue.frames[1] > first);
        self.without_empty_layers()
    }

    fn take_of_all(&mut self) -> LayerEdits {
        LayerEdits {
            pins: std::mem::take(&mut self.pins),
            forbidden: std::mem::take(&mut self.forbidden),
            moves: std::mem::take(&mut self.moves),
            frozen: std::mem::take(&mut self.frozen),
        }
    }
}

impl LayerEdits {
    fn keep_within(&mut self, clip: Frames) {
        self.pins.retain(|pin| clip.has(pin.frame));
        self.forbidden.retain(|frames| frames.from <= clip.last && frames.past > clip.first);
        self.moves.retain(|moved| clip.has(moved.from) && clip.has(moved.to));
        self.frozen.retain(|frame| clip.has(*frame));
    }
}

/// Lays the corrections of a layer, or of all, over earlier ones.
fn lay(both: &mut LayerEdits, later: LayerEdits) {
    let ends: Vec<Frame> = later.moves.iter().map(|moved| moved.to).collect();
    let (mut moves, mut pins) = (Vec::new(), Vec::new());
    for moved in later.moves {
        match go_on(both, moved) {
            GoneOn::Move(moved) => moves.push(moved),
            GoneOn::Pin(pin) => pins.push(pin),
            GoneOn::Back => {}
        }
    }
    both.pins.retain(|pin| !ends.contains(&pin.frame));
    both.moves.retain(|moved| !ends.contains(&moved.to));
    both.forbidden.retain(|ban| !ban.is_one() || !ends.contains(&ban.from));
    both.pins.extend(pins);
    let comes = |frame: Frame| later.pins.iter().any(|pin| pin.frame == frame);
    let goes = |frame: Frame| moves.iter().any(|moved| moved.from == frame);
    let is_banned = |frame: Frame| later.forbidden.iter().any(|ban| ban.distance(frame) == 0);
    both.pins.retain(|pin| !comes(pin.frame) && !is_banned(pin.frame));
    both.moves.retain(|moved| {
        !comes(moved.from) && !comes(moved.to) && !goes(moved.from) && !is_banned(moved.to)
    });
    let ends: Vec<Frame> = both.moves.iter().chain(&moves).map(|moved| moved.to).collect();
    let is_kept = |frame: Frame| comes(frame) || ends.contains(&frame);
    both.forbidden
        .retain(|ban| !later.forbidden.contains(ban) && (!ban.is_one() || !is_kept(ban.from)));
    both.pins.extend(later.pins);
    both.forbidden.extend(later.forbidden);
    both.moves.extend(moves);
    if !later.frozen.is_empty() {
        both.frozen = later.frozen;
    }
}

/// What a move becomes that goes on from an earlier correction.
enum GoneOn {
    Move(Move),
    Pin(Pin),
    /// The key is back where it was found.
    Back,
}

/// Takes away what an earlier correction set at the begin of a move, and moves it on.
fn go_on(earlier: &mut LayerEdits, moved: Move) -> GoneOn {
    if let Some(at) = earlier.moves.iter().position(|before| before.to == moved.from) {
        let before = earlier.moves.remove(at);
        let name = moved.name.or(before.name);
        let whole =
            Move { from: before.from, name, weight: moved.weight.or(before.weight), ..moved };
        if whole.from == whole.to { GoneOn::Back } else { GoneOn::Move(whole) }
    } else if let Some(at) = earlier.pins.iter().position(|pin| pin.frame == moved.from) {
        let pin = earlier.pins.remove(at);
        let name = moved.name.or(pin.name);
        GoneOn::Pin(Pin { frame: moved.to, name, weight: moved.weight.or(pin.weight) })
    } else {
        GoneOn::Move(moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edits::Hold;

    fn edits(pins: &[&str], forbidden: &[&str], moves: &[&str]) -> Edits {
        Edits {
            pins: pins.iter().map(|text| Pin::parse(text).unwrap()).collect(),
            forbidden: forbidden.iter().map(|text| text.parse().unwrap()).collect(),
            moves: moves.iter().map(|text| Move::parse(text).unwrap()).collect(),
            ..Edits::default()
        }
    }

    #[test]
    fn corrections_add_up_and_the_later_one_wins() {
        for (earlier, later, both) in [
            (
                edits(&["42"], &["50"], &[]),
                edits(&["60"], &[], &[]),
                edits(&["42", "60"], &["50"], &[]),
            ),
            (
                edits(&["42:a@0.5"], &[], &[]),
                edits(&["42:b"], &[], &[]),
                edits(&["42:b"], &[], &[]),
            ),
            (
                edits(&[], &["50", "60..66"], &[]),
                edits(&["50", "62"], &[], &[]),
                edits(&["50", "62"], &["60..66"], &[]),
            ),
            (
                edits(&["60", "66"], &[], &["30:62"]),
                edits(&[], &["60..66"], &[]),
                edits(&["66"], &["60..66"], &[]),
            ),
            (
                edits(&[], &[], &["73:75:land"]),
                edits(&[], &[], &["75:78@0.1"]),
                edits(&[], &[], &["73:78:land@0.1"]),
            ),
            (edits(&[], &[], &["73:75"]), edits(&[], &[], &["75:73"]), edits(&[], &[], &[])),
            (edits(&[], &[], &["73:75"]), edits(&[], &[], &["73:70"]), edits(&[], &[], &["73:70"])),
            (
                edits(&["60:hit"], &["62"], &[]),
                edits(&[], &[], &["60:62"]),
                edits(&["62:hit"], &[], &[]),
            ),
            (edits(&[], &["75"], &[]), edits(&[], &[], &["73:75"]), edits(&[], &[], &["73:75"])),
            (edits(&[], &[], &["73:75"]), edits(&[], &[], &["71:75"]), edits(&[], &[], &["71:75"])),
            (edits(&["75:a"], &[], &[]), edits(&[], &[], &["71:75"]), edits(&[], &[], &["71:75"])),
            (
                edits(&["60:a", "75:b"], &[], &[]),
                edits(&[], &[], &["60:75"]),
                edits(&["75:a"], &[], &[]),
            ),
            (
                edits(&[], &[], &["71:75"]),
                edits(&[], &[], &["73:75", "75:78"]),
                edits(&[], &[], &["73:75", "71:78"]),
            ),
        ] {
            assert_eq!(later.clone().over(earlier.clone()), both, "{later:?} over {earlier:?}");
            both.validate(Frame(0), Frame(91)).unwrap();
        }
    }

    #[test]
    fn layers_holds_and_switches_add_up_too() {
        let mut earlier = edits(&[], &[], &[]);
        earlier.pins_of(Some("B")).push(Pin::parse("60").unwrap());
        earlier.holds = vec![Hold::parse("12:4").unwrap(), Hold::parse("60:6").unwrap()];
        earlier.frozen = vec![Frame(5)];
        let mut later = edits(&["12"], &[], &[]);
        later.forbidden_of(Some("B")).push("60".parse().unwrap());
        later.holds = vec![Hold::parse("60:2").unwrap()];
        later.again = true;
        let both = later.over(earlier);
        assert!(both.layers["B"].pins.is_empty() && both.layers["B"].forbidden.len() == 1);
        assert_eq!(both.holds, ["12:4", "60:2"].map(|text| Hold::parse(text).unwrap()));
        assert!(both.again && both.frozen.is_empty(), "frozen keys are not chosen again");
        both.validate(Frame(0), Frame(91)).unwrap();
    }

    #[test]
    fn what_lies_outside_a_part_of_the_clip_is_left_out() {
        let whole = edits(&["10", "80"], &["5", "40..60"], &["20:30", "45:55"]);
        assert_eq!(whole.within(Frame(8), Frame(50)), edits(&["10"], &["40..60"], &["20:30"]));
    }
}
