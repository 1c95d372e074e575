//! Corrections in every round of a cycle.

use crate::edits::{Edits, Forbidden, Hold, Move, Pin};
use crate::time::Frame;

/// Rounds of a cycle laid end to end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rounds {
    /// The first frame of the first round.
    pub(crate) first: Frame,
    /// Frames of a round.
    pub(crate) frames: usize,
    /// Number of rounds.
    pub(crate) count: usize,
}

impl Rounds {
    /// Returns a frame of the first round in every round.
    fn of(self, frame: Frame) -> impl Iterator<Item = Frame> {
        (0..self.count).map(move |round| Frame(frame.0 + round * self.frames))
    }

    fn last(self) -> Frame {
        Frame(self.first.0 + self.frames)
    }

    fn pins(self, pins: &[Pin]) -> Vec<Pin> {
        let pin =
            |pin: &Pin| self.of(pin.frame).map(|frame| Pin { frame, ..pin.clone() }).collect();
        let mut all: Vec<Pin> = pins.iter().flat_map(|own| -> Vec<Pin> { pin(own) }).collect();
        // The last frame of a round is the first of the next one.
        all.sort_by_key(|pin| pin.frame);
        all.dedup_by_key(|pin| pin.frame);
        all
    }

    fn forbidden(self, forbidden: &[Forbidden]) -> Vec<Forbidden> {
        let in_all = |range: &Forbidden| {
            let from = range.from.max(self.first);
            // An open range ends with its round.
            let koma = range.past.min(Frame(self.last().0 + 1)).0.saturating_sub(from.0);
            self.of(from).map(move |from| Forbidden { from, past: Frame(from.0 + koma) })
        };
        forbidden.iter().flat_map(in_all).collect()
    }

    fn moves(self, moves: &[Move]) -> Vec<Move> {
        let in_all = |own: &Move| -> Vec<Move> {
            let both = self.of(own.from).zip(self.of(own.to));
            both.map(|(from, to)| Move { from, to, ..own.clone() }).collect()
        };
        moves.iter().flat_map(in_all).collect()
    }

    fn frames(self, frames: &[Frame]) -> Vec<Frame> {
        let mut all: Vec<Frame> = frames.iter().flat_map(|frame| self.of(*frame)).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

impl Edits {
    /// Returns the corrections of a cycle for its rounds laid end to end. Spoken lines stay in the first.
    pub(crate) fn in_rounds(&self, rounds: Rounds) -> Self {
        let mut edits = self.clone();
        edits.pins = rounds.pins(&self.pins);
        edits.forbidden = rounds.forbidden(&self.forbidden);
        edits.moves = rounds.moves(&self.moves);
        edits.frozen = rounds.frames(&self.frozen);
        edits.splits = rounds.frames(&self.splits);
        let holds = self
            .holds
            .iter()
            .flat_map(|hold| rounds.of(hold.frame).map(|frame| Hold { frame, koma: hold.koma }));
        edits.holds = holds.collect();
        edits.holds.sort_by_key(|hold| hold.frame);
        edits.holds.dedup_by_key(|hold| hold.frame);
        for (name, own) in &self.layers {
            let all = edits.layers.entry(name.clone()).or_default();
            all.pins = rounds.pins(&own.pins);
            all.forbidden = rounds.forbidden(&own.forbidden);
            all.moves = rounds.moves(&own.moves);
            all.frozen = rounds.frames(&own.frozen);
        }
        edits
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_correction_holds_in_every_round_and_once_at_a_seam() {
        let edits = Edits {
            pins: vec![Pin::parse("4").unwrap(), Pin::parse("14:seam").unwrap()],
            forbidden: vec!["6".parse().unwrap(), "9..".parse().unwrap()],
            moves: vec![Move::parse("7:8").unwrap()],
            holds: vec![Hold::parse("5:3").unwrap()],
            ..Edits::default()
        };
        let rounds = Rounds { first: Frame(4), frames: 10, count: 3 };
        let all = edits.in_rounds(rounds);
        all.validate(Frame(4), Frame(34)).unwrap();
        let frames: Vec<usize> = all.pins.iter().map(|pin| pin.frame.0).collect();
        assert_eq!(frames, [4, 14, 24, 34]);
        let forbidden: Vec<String> = all.forbidden.iter().map(ToString::to_string).collect();
        assert_eq!(forbidden, ["6", "16", "26", "9..15", "19..25", "29..35"]);
        assert_eq!(all.moves[2], Move { from: Frame(27), to: Frame(28), ..edits.moves[0].clone() });
        assert_eq!(all.holds[1], Hold { frame: Frame(15), koma: 3 });
    }
}
