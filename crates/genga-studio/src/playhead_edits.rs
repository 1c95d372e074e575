//! Corrections at the play head (再生位置) by the keyboard.

use super::column::Column;
use super::command::Command;
use super::corrections::Correction;
use super::document::Document;
use genga::keys::{Key, Origin};
use genga::motion::Clip;
use genga::time::Frame;

/// Greatest spacing weight that can be set by hand. At 1 all inbetweens would equal the key.
pub(super) const MOST_WEIGHT: f64 = 0.95;

/// The context of a correction at the play head.
pub(super) struct Here<'a> {
    pub(super) clip: &'a Clip,
    pub(super) column: &'a Column<'a>,
    pub(super) wanted: &'a Document,
    /// The koma of the play head.
    pub(super) at: usize,
}

impl Here<'_> {
    /// The correction that a command asks for. `None` if the command does not apply here.
    pub(super) fn correction(&self, command: &Command) -> Option<Correction> {
        let column = self.column;
        let key = column.key(self.at).cloned();
        Some(match (command, key) {
            (Command::ToggleKey, Some(key)) if self.is_here(&key) => match self.is_set(&key) {
                false => Correction::Forbid(key.clone(), column.place_of(&key)),
                true => Correction::TakeBack(key),
            },
            (Command::Pin, Some(key)) if self.is_here(&key) => match self.is_set(&key) {
                false => Correction::PinKey(key),
                true => Correction::TakeBack(key),
            },
            (Command::ToggleKey | Command::Pin, _) => {
                Correction::Pin(self.frame(column.clock.place_from_koma(self.at)))
            }
            (Command::Nudge(by), Some(key)) => {
                let way = *by as f64 * column.clock.frames_in_koma();
                let to = self.frame(key.frame.0 as f64 + way);
                Correction::Move(key, to)
            }
            (Command::NudgeFrame(by), Some(key)) => {
                let to = self.frame(key.frame.0.saturating_add_signed(*by) as f64);
                Correction::Move(key, to)
            }
            (Command::Crowd(by), Some(key)) => {
                let usual = column.usual_weight(&key, &self.wanted.recipe, self.clip.last());
                let weight = key.weight.unwrap_or(usual) + by;
                let weight = (weight * 100.0).round() / 100.0;
                Correction::Weight(key, Some(weight.clamp(0.0, MOST_WEIGHT)))
            }
            (Command::Hold(by), _) => {
                let cell = column.cell(self.at);
                let koma = cell.held.saturating_add_signed(*by).max(1);
                Correction::Hold(cell.hold_frame(&self.wanted.edits), koma)
            }
            _ => return None,
        })
    }

    /// Whether a correction put the key there. A merely frozen key also has the origin `Pinned`.
    fn is_set(&self, key: &Key) -> bool {
        let edits = self.wanted.edits.of_layer(self.column.name);
        match key.origin {
            Origin::Turn | Origin::Fill | Origin::Rest | Origin::Contact | Origin::Step => false,
            Origin::Moved { .. } => true,
            Origin::Pinned => edits.pins.iter().any(|pin| pin.frame == key.frame),
        }
    }

    /// Whether a key stands at the play head: on the koma nearest to its frame, or on the first koma of its drawing.
    fn is_here(&self, key: &Key) -> bool {
        let cell = self.column.cell(self.at);
        let begins = cell.koma == self.at && cell.key.is_some_and(|own| own.frame == key.frame);
        begins || self.column.clock.koma_from_frame(key.frame) == self.at
    }

    /// The source frame nearest to a place, within the clip.
    fn frame(&self, place: f64) -> Frame {
        let (first, last) = (self.clip.first().0, self.clip.last().0);
        Frame((place.round() as usize).clamp(first, last))
    }
}
