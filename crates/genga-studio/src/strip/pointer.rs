//! Pointer input on the strip (手): drags a genga by its figure or a hold by its end, else the play head.

use egui::{CursorIcon, PointerButton, Pos2, Response};

use super::layout::Layout;
use crate::command::Command;
use crate::held_key::Held;
use crate::view_state::Shown;
use genga::keys::Key;

/// Pointer state on the strip.
#[derive(Debug, Clone, Default)]
pub(super) struct Hand {
    held: Option<Held>,
    /// The key whose menu is open.
    pub(super) asked: Option<Key>,
}

impl Hand {
    /// Handles pointer input.
    pub(super) fn handle(
        &mut self,
        response: &Response,
        layout: &Layout,
        figured: &[usize],
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) {
        if response.hover_pos().is_some_and(|at| layout.ending(at, shown).is_some()) {
            response.ctx.set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        let Some(at) = response.interact_pointer_pos() else {
            self.held = None;
            return;
        };
        let column = shown.column();
        let origin = response.ctx.input(|input| input.pointer.press_origin()).unwrap_or(at);
        if response.drag_started_by(PointerButton::Primary) {
            self.held = grasped(origin, layout, figured, shown);
        }
        let under = layout.cell(at, figured, shown);
        if response.secondary_clicked() {
            self.asked = under.and_then(|cell| column.cells[cell].key).cloned();
        }
        let koma = layout.meant(at, column.length);
        if let Some(held) = self.held.as_mut().filter(|_| response.dragged()) {
            let correction = held.carry(koma, layout.line(at.x), shown);
            commands.extend(correction.map(Command::Drag));
            if !held.is_end() {
                commands.extend(shown.go(koma));
            }
        } else if response.clicked() || response.secondary_clicked() {
            let own = under.map(|cell| column.cells[cell].koma);
            commands.extend(shown.go(own.unwrap_or(koma)));
        } else if response.dragged_by(PointerButton::Primary) {
            commands.extend(shown.go(koma));
        }
        if response.drag_stopped() {
            self.held = None;
        }
    }
}

/// What is grabbed at a position: the end of a hold, or the genga of a figure.
fn grasped(at: Pos2, layout: &Layout, figured: &[usize], shown: &Shown<'_>) -> Option<Held> {
    match layout.ending(at, shown) {
        Some(cell) => Some(Held::end_of(cell, shown)),
        None => {
            let cell = layout.cell(at, figured, shown)?;
            shown.column().cells[cell].key.map(Held::key)
        }
    }
}
