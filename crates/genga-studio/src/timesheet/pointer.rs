//! Pointer input on the sheet (手): drags a genga by its number or a hold by its end, else the play head.

use egui::{CursorIcon, PointerButton, Pos2, Response};

use super::paper::Paper;
use crate::column::{Column, KeyedCell};
use crate::command::Command;
use crate::held_key::Held;
use crate::view_state::Shown;
use genga::keys::Key;

/// Distance within which the end of a hold is grabbed, in points.
const NEAR_END: f32 = 3.5;

/// Pointer state on the sheet.
#[derive(Debug, Clone, Default)]
pub(super) struct Hand {
    held: Option<Held>,
    /// The key whose menu is open.
    pub(super) asked: Option<Key>,
}

impl Hand {
    /// Handles pointer input on the columns. Returns the koma to which it moves the play head.
    pub(super) fn handle(
        &mut self,
        response: &Response,
        paper: &Paper,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) -> Option<usize> {
        if response.hover_pos().is_some_and(|at| Under::new(at, paper, shown).ending().is_some()) {
            response.ctx.set_cursor_icon(CursorIcon::ResizeVertical);
        }
        let Some(at) = response.interact_pointer_pos() else {
            self.held = None;
            return None;
        };
        let origin = response.ctx.input(|input| input.pointer.press_origin()).unwrap_or(at);
        let (under, pressed) = (Under::new(at, paper, shown), Under::new(origin, paper, shown));
        if response.is_pointer_button_down_on() {
            commands.extend(pressed.at.and_then(|column| shown.choose(column)));
        }
        if response.drag_started_by(PointerButton::Primary) {
            self.held = pressed.grasped(shown);
        }
        if response.secondary_clicked() {
            self.asked = under.key().cloned();
        }
        if let Some(held) = self.held.as_mut().filter(|_| response.dragged()) {
            let (koma, line) = (under.koma, paper.line(at.y).0);
            commands.extend(held.carry(koma, line, shown).map(Command::Drag));
        }
        // A press on the end of a hold may begin a drag, so only a click there moves the play head.
        let is_of_end = match &self.held {
            Some(held) => held.is_end(),
            None => pressed.ending().is_some(),
        };
        let is_down = response.is_pointer_button_down_on() && !is_of_end;
        if response.drag_stopped() {
            self.held = None;
        }
        let goes = is_down || response.clicked() || response.secondary_clicked();
        goes.then_some(under.koma)
    }
}

/// The objects at a position on the sheet.
struct Under<'a, 'b> {
    /// The column at the position. `None` beside the columns, for which `column` is the selected one.
    at: Option<usize>,
    column: &'b Column<'a>,
    koma: usize,
    line: (usize, f32),
}

impl<'a, 'b> Under<'a, 'b> {
    fn new(at: Pos2, paper: &Paper, shown: &'b Shown<'a>) -> Self {
        let own = paper.column(at.x);
        let column = &shown.columns[own.unwrap_or(shown.chosen)];
        let koma = paper.koma(at.y, column.length);
        Self { at: own, column, koma, line: paper.line(at.y) }
    }

    /// The object grabbed at the position.
    fn grasped(&self, shown: &Shown<'_>) -> Option<Held> {
        match self.ending() {
            Some(cell) => Some(Held::end_of(cell, shown)),
            None => self.key().map(Held::key),
        }
    }

    /// The key whose number is at the position.
    fn key(&self) -> Option<&'a Key> {
        let cell = self.column.cell(self.koma);
        cell.key.filter(|_| cell.koma == self.koma)
    }

    /// The drawing that ends at the position. The last one ends with the sheet and cannot be dragged.
    fn ending(&self) -> Option<&'b KeyedCell<'a>> {
        let (line, away) = self.line;
        let is_end = |cell: &&KeyedCell<'_>| cell.koma + cell.held == line;
        let is_near = away <= NEAR_END && line >= 1 && line < self.column.length;
        is_near.then(|| self.column.cell(line - 1)).filter(is_end)
    }
}
