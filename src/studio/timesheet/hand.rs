//! The hand on the sheet (手): it takes a genga by its number, a drawing by its end, and else the play head.

use egui::{CursorIcon, PointerButton, Pos2, Rect, Response};

use crate::keys::Key;
use crate::studio::column::KeyedCell;
use crate::studio::command::Command;
use crate::studio::corrections::Correction;
use crate::studio::held_key::HeldKey;
use crate::studio::shown::Shown;
use crate::time::Frame;

/// Height of a koma on the sheet.
pub(super) const ROW: f32 = 17.0;
/// How near a hand has to be to the end of a hold.
const NEAR_END: f32 = 3.5;

/// What a hand holds.
#[derive(Debug, Clone)]
enum Held {
    /// A key.
    Key(HeldKey),
    /// The end of a drawing by its frame, the koma on which that begins, and its last length.
    End { frame: Frame, begin: usize, koma: usize },
}

/// A hand on the sheet.
#[derive(Debug, Clone, Default)]
pub(super) struct Hand {
    held: Option<Held>,
    /// The key whose menu is open.
    pub(super) asked: Option<Key>,
}

impl Hand {
    /// Takes what the hand does to the column in `rect`. Gives the koma that it brings the play head to.
    pub(super) fn handle(
        &mut self,
        response: &Response,
        rect: Rect,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) -> Option<usize> {
        if response.hover_pos().is_some_and(|at| ending(at, rect, shown).is_some()) {
            response.ctx.set_cursor_icon(CursorIcon::ResizeVertical);
        }
        let Some(at) = response.interact_pointer_pos() else {
            self.held = None;
            return None;
        };
        let origin = response.ctx.input(|input| input.pointer.press_origin()).unwrap_or(at);
        if response.drag_started_by(PointerButton::Primary) {
            self.held = grasped(origin, rect, shown);
        }
        if response.secondary_clicked() {
            self.asked = key(at, rect, shown).cloned();
        }
        if let Some(held) = self.held.as_mut().filter(|_| response.dragged()) {
            commands.extend(held.follow(at, rect, shown).map(Command::Drag));
        }
        // A hand that comes down on an end may be about to drag it: only a click is meant for the play head.
        let is_of_end = match &self.held {
            Some(held) => matches!(held, Held::End { .. }),
            None => ending(origin, rect, shown).is_some(),
        };
        let is_down = response.is_pointer_button_down_on() && !is_of_end;
        if response.drag_stopped() {
            self.held = None;
        }
        let goes = is_down || response.clicked() || response.secondary_clicked();
        goes.then(|| koma(at, rect, shown))
    }
}

impl Held {
    /// What brings it under the hand, when that has come to another koma.
    fn follow(&mut self, at: Pos2, rect: Rect, shown: &Shown<'_>) -> Option<Correction> {
        match self {
            Self::Key(key) => key.carry(shown.frame_of_koma(koma(at, rect, shown))),
            Self::End { frame, begin, koma } => {
                let line = ((at.y - rect.min.y) / ROW).round().max(0.0) as usize;
                let wanted = line.saturating_sub(*begin).max(1);
                let is_new = std::mem::replace(koma, wanted) != wanted;
                is_new.then_some(Correction::Hold(*frame, wanted))
            }
        }
    }
}

/// What a hand takes that comes down there.
fn grasped(at: Pos2, rect: Rect, shown: &Shown<'_>) -> Option<Held> {
    if let Some(cell) = ending(at, rect, shown) {
        let frame = cell.hold_frame(&shown.wanted.edits);
        return Some(Held::End { frame, begin: cell.koma, koma: cell.held });
    }
    key(at, rect, shown).map(|key| Held::Key(HeldKey::take(key)))
}

/// The koma that is there.
fn koma(at: Pos2, rect: Rect, shown: &Shown<'_>) -> usize {
    (((at.y - rect.min.y) / ROW).max(0.0) as usize).min(shown.column.length - 1)
}

/// The key whose number is there.
fn key<'a>(at: Pos2, rect: Rect, shown: &Shown<'a>) -> Option<&'a Key> {
    let koma = koma(at, rect, shown);
    let cell = shown.column.cell(koma);
    cell.key.filter(|_| cell.koma == koma)
}

/// The drawing that ends there; the last one ends with the sheet.
fn ending<'a, 'b>(at: Pos2, rect: Rect, shown: &'b Shown<'a>) -> Option<&'b KeyedCell<'a>> {
    let lines = (at.y - rect.min.y) / ROW;
    let line = lines.round();
    let is_near = (lines - line).abs() * ROW <= NEAR_END && line >= 1.0;
    let is_end = |cell: &&KeyedCell<'_>| cell.koma + cell.held == line as usize;
    let ends = (line as usize) < shown.column.length;
    let cell = (is_near && ends).then(|| shown.column.cell(line as usize - 1));
    cell.filter(is_end)
}
