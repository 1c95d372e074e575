//! The bans (禁止) on the strip: a line where no genga may stand, with a cross that lifts the ban.

use egui::{
    CursorIcon, Id, Painter, Pos2, Rangef, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2,
};

use super::layout::Layout;
use crate::command::Command;
use crate::corrections::Correction;
use crate::icon::cross;
use crate::label_culling::Room;
use crate::theme::Look;
use crate::view_state::Shown;
use genga::edits::Forbidden;
use genga::time::Frame;

/// Half the side of a cross, and its distance to the next and to the upper edge of the figures, in points.
const HALF: f32 = 3.5;
const APART: f32 = 16.0;
const BELOW: f32 = 7.0;
/// Side of the room in which a cross can be clicked, in points.
const ROOM: f32 = 15.0;

/// A ban on the strip.
#[derive(Debug, Clone)]
pub(super) struct Ban {
    range: Forbidden,
    /// The column that it is of. `None` for all columns.
    column: Option<String>,
    /// Koma and frames of the genga that it takes away.
    taken: Vec<(usize, Frame)>,
    line: Rangef,
    at: Pos2,
    /// Whether its cross is drawn.
    has_cross: bool,
}

impl Ban {
    /// Whether its cross is at a position.
    pub(super) fn is_at(&self, at: Pos2) -> bool {
        self.has_cross && self.room().contains(at)
    }

    /// The koma of the genga that it takes away, and the places of the source that they show.
    pub(super) fn taken(&self) -> impl Iterator<Item = (usize, f64)> {
        self.taken.iter().map(|(koma, frame)| (*koma, frame.0 as f64))
    }

    fn room(&self) -> Rect {
        Rect::from_center_size(self.at, vec2(ROOM, ROOM))
    }
}

/// The bans of the selected column. Crosses that would touch others are left out.
pub(super) fn of(layout: &Layout, shown: &Shown<'_>) -> Vec<Ban> {
    let (edits, column) = (&shown.wanted.edits, shown.column());
    let own = edits.layers.get(column.name).into_iter().flat_map(|own| &own.forbidden);
    let own = own.map(|range| (Some(column.name.to_owned()), *range));
    let all = edits.forbidden.iter().map(|range| (None, *range));
    let mut room = Room::default();
    let ban = |(column_of, range)| {
        let [from, to] = shown.koma_of_ban(column, range);
        let [left, right] = [from, to.min(column.length.saturating_sub(1))]
            .map(|koma| layout.x(koma) + 0.5 * layout.koma());
        let x = layout.time.x(f64::from(shown.middle_of_ban(column, range)) + 0.5);
        // Above the figures, where no number covers it.
        let at = pos2(x, layout.figures.min.y + BELOW);
        let (line, taken) = (Rangef::new(left, right), shown.taken_away(column, range));
        let has_cross = layout.rect.contains(at) && room.take(at.x, APART);
        Ban { range, column: column_of, taken, line, at, has_cross }
    };
    all.chain(own).map(ban).collect()
}

/// Draws the bans.
pub(super) fn draw(painter: &Painter, bans: &[Ban], look: &Look) {
    for ban in bans {
        painter.hline(ban.line, ban.at.y, Stroke::new(1.0, look.genga.gamma_multiply(0.5)));
        if ban.has_cross {
            painter.circle(ban.at, 0.5 * ROOM, look.ground, Stroke::new(1.0, look.genga));
            cross(painter, ban.at, HALF, Stroke::new(1.8, look.genga));
        }
    }
}

/// Lets a click on a cross lift its ban.
pub(super) fn handle(ui: &Ui, bans: &[Ban], shown: &Shown<'_>, commands: &mut Vec<Command>) {
    for ban in bans.iter().filter(|ban| ban.has_cross) {
        let id = Id::unique(("ban", ban.range.from, ban.range.past));
        let response = ui.interact(ban.room(), id, Sense::click());
        let name = name(ban, shown);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
        let response = response.on_hover_cursor(CursorIcon::PointingHand).on_hover_text(&name);
        if response.clicked() {
            let allow = Correction::Allow(ban.range);
            commands.push(Command::CorrectOf(ban.column.clone(), allow));
        }
    }
}

/// Says where no genga may stand, and what a click does.
fn name(ban: &Ban, shown: &Shown<'_>) -> String {
    let place = shown.named_ban(ban.range);
    match shown.words.is_japanese() {
        true => format!("禁止 {place}。クリックで解除"),
        false => format!("Forbidden {place}. Click to allow it"),
    }
}
