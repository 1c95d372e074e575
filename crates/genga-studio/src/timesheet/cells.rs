//! Draws the sheet: lines, koma numbers, actions, and the drawings of each column.

use std::ops::Range;

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Ui, pos2, vec2};

use super::paper::{KOMA, Paper};
use super::speech::{self, SpeechHand};
use crate::column::{Column, KeyedCell};
use crate::icon::cross;
use crate::label_culling::Room;
use crate::view_state::Shown;
use crate::why;
use genga::edits::Forbidden;
use genga::keys::Key;
use genga::sheet::Number;

/// Radius of the circle around the number of a genga, in points.
const CIRCLE: f32 = 8.0;
/// Least height of a koma at which numbers and words can be read, in points.
const READABLE: f32 = 12.0;
/// Koma between two thin lines, as on printed sheets.
const THIN: usize = 6;

/// Draws the koma in view.
pub(super) fn draw(
    ui: &Ui,
    paper: &Paper,
    rows: Range<usize>,
    hand: &SpeechHand,
    shown: &Shown<'_>,
) {
    if rows.is_empty() {
        return;
    }
    let painter = ui.painter_at(paper.rect.intersect(ui.clip_rect()));
    painter.rect_filled(paper.rect, 0.0, shown.look.paper);
    grid(&painter, paper, &rows, shown);
    actions(&painter, paper, &rows, shown);
    speech::draw(&painter, paper, &rows, hand, shown);
    for (at, column) in shown.columns.iter().enumerate() {
        let strip = Strip { painter: &painter, paper, column, x: paper.x(at), shown };
        strip.draw(&rows);
        if at == shown.chosen {
            strip.words(&rows);
        }
    }
}

fn grid(painter: &Painter, paper: &Paper, rows: &Range<usize>, shown: &Shown<'_>) {
    let (look, across) = (&shown.look, paper.rect.x_range());
    if rows.contains(&shown.at) {
        let row = Rect::from_x_y_ranges(across, paper.koma_range(shown.at));
        painter.rect_filled(row, 0.0, look.chosen);
    }
    let second = shown.column().clock.koma_rate.round().max(1.0) as usize;
    // Lines too close to be told apart are left out, and so are numbers.
    let fine = if paper.row < 6.0 { THIN } else { 1 };
    let numbered = [1, THIN, second].into_iter().find(|step| *step as f32 * paper.row >= READABLE);
    let numbered = numbered.unwrap_or(second);
    for koma in rows.clone() {
        let (width, color) = match koma {
            koma if koma % second == 0 => (1.6, look.faint),
            koma if koma % THIN == 0 => (1.0, look.raw),
            _ => (1.0, look.grid),
        };
        if koma % fine == 0 {
            painter.hline(across, paper.y(koma), Stroke::new(width, color));
        }
        let is_now = koma == shown.at;
        let is_by_now = koma.abs_diff(shown.at) as f32 * paper.row < READABLE;
        if is_now || koma % numbered == 0 && !is_by_now {
            let (size, ink) = if is_now { (12.0, look.playhead) } else { (10.0, look.faint) };
            let at = pos2(paper.rect.min.x + KOMA - 6.0, paper.koma_range(koma).center());
            painter.text(at, Align2::RIGHT_CENTER, koma + 1, FontId::monospace(size), ink);
        }
    }
    for x in paper.edges() {
        painter.vline(x, paper.rect.y_range(), Stroke::new(1.0, look.grid));
    }
}

/// Draws a line where an action ends and the next begins, with its number.
fn actions(painter: &Painter, paper: &Paper, rows: &Range<usize>, shown: &Shown<'_>) {
    let look = &shown.look;
    for (at, koma) in shown.breakdown.actions.koma(shown.column().clock).into_iter().enumerate() {
        if rows.contains(&koma) {
            let y = paper.y(koma);
            painter.hline(paper.rect.x_range(), y, Stroke::new(2.0, look.action));
            let at = (at + 2).to_string();
            tab(painter, pos2(paper.rect.min.x, y), &at, look.action, look.paper);
        }
    }
}

/// Draws the number of an action on a tab that hangs from its line.
fn tab(painter: &Painter, corner: Pos2, number: &str, color: Color32, ink: Color32) {
    let galley = painter.layout_no_wrap(number.to_owned(), FontId::proportional(9.0), ink);
    let rect = Rect::from_min_size(corner, galley.size() + vec2(5.0, 1.0));
    painter.rect_filled(rect, 2.0, color);
    painter.galley(corner + vec2(2.5, 0.5), galley, ink);
}

/// A column being drawn.
struct Strip<'a> {
    painter: &'a Painter,
    paper: &'a Paper,
    column: &'a Column<'a>,
    /// Horizontal position of its middle.
    x: f32,
    shown: &'a Shown<'a>,
}

impl Strip<'_> {
    fn draw(&self, rows: &Range<usize>) {
        let column = self.column;
        let last = rows.end.min(column.length).saturating_sub(1);
        let cells = &column.cells[column.at(rows.start)..=column.at(last)];
        // From last to first, so that in a crowd earlier circles lie on top of later ones.
        cells.iter().rev().for_each(|cell| self.cell(cell));
        let edits = &self.shown.wanted.edits;
        let own = edits.layers.get(column.name).map(|own| &own.forbidden);
        let all = edits.forbidden.iter().chain(own.into_iter().flatten());
        all.for_each(|range| self.forbidden(*range, rows));
    }

    fn middle(&self, koma: usize) -> Pos2 {
        pos2(self.x, self.paper.koma_range(koma).center())
    }

    /// Draws the mark of a drawing, and the line of its hold.
    fn cell(&self, cell: &KeyedCell<'_>) {
        let (look, middle) = (&self.shown.look, self.middle(cell.koma));
        let color = look.of_role(cell.drawing.role);
        let circle = CIRCLE.min(0.5 * self.paper.row);
        if cell.held > 1 {
            let end = self.paper.y(cell.koma + cell.held) - 0.2 * self.paper.row;
            let begin = middle.y + if cell.genga.is_some() { circle + 1.0 } else { 5.0 };
            let (width, color) =
                if cell.drawing.why.hold_set { (2.2, look.genga) } else { (1.4, look.faint) };
            self.painter.vline(self.x, begin.min(end)..=end, Stroke::new(width, color));
            self.painter.hline(self.x - 3.0..=self.x + 3.0, end, Stroke::new(width, color));
        }
        match cell.genga_number() {
            Some(number) if self.paper.row >= READABLE => {
                badge(self.painter, middle, &number, color, cell.key, look.paper);
            }
            Some(_) => drop(self.painter.circle_filled(middle, circle.max(2.5), color)),
            None => drop(self.painter.circle_filled(middle, 2.6_f32.min(circle), color)),
        }
    }

    /// Writes why each drawing is there, as far as there is room.
    fn words(&self, rows: &Range<usize>) {
        let (column, look) = (self.column, &self.shown.look);
        let last = rows.end.min(column.length).saturating_sub(1);
        let mut room = Room::default();
        for cell in &column.cells[column.at(rows.start)..=column.at(last)] {
            let words = why::in_short(cell, self.shown.words);
            let at = pos2(self.paper.words(), self.middle(cell.koma).y);
            if words.is_empty() || !room.take(at.y, READABLE) {
                continue;
            }
            let is_set =
                cell.key.is_some_and(|key| key.origin.is_set()) || cell.drawing.why.hold_set;
            let ink = if is_set { look.genga } else { look.faint };
            self.painter.text(at, Align2::LEFT_CENTER, words, FontId::proportional(11.0), ink);
        }
    }

    /// Draws a cross where no key may stand, and a line as long as the range.
    fn forbidden(&self, range: Forbidden, rows: &Range<usize>) {
        let [from, to] = self.shown.koma_of_ban(self.column, range);
        if to < rows.start || from >= rows.end {
            return;
        }
        let [top, bottom] = [from, to].map(|koma| self.middle(koma) - vec2(13.0, 0.0));
        let share = self.shown.middle_of_ban(self.column, range) - from as f32;
        let share = share / (to - from).max(1) as f32;
        let ink = self.shown.look.genga;
        self.painter.vline(top.x, top.y..=bottom.y, Stroke::new(1.0, ink.gamma_multiply(0.5)));
        let half = 3.0_f32.min(0.4 * self.paper.row);
        cross(self.painter, top.lerp(bottom, share), half, Stroke::new(1.6, ink));
    }
}

/// Draws a number in a circle, which is filled if a person set the key.
pub(crate) fn badge(
    painter: &Painter,
    middle: Pos2,
    number: &Number,
    color: Color32,
    key: Option<&Key>,
    paper: Color32,
) {
    let is_set = key.is_some_and(|key| key.origin.is_set());
    let (fill, ink) = if is_set { (color, paper) } else { (paper, color) };
    painter.circle(middle, CIRCLE, fill, Stroke::new(1.6, color));
    let number = number.to_string();
    let size = match number.len() {
        ..3 => 10.5,
        3 => 8.5,
        _ => 7.0,
    };
    painter.text(middle, Align2::CENTER_CENTER, number, FontId::proportional(size), ink);
}
