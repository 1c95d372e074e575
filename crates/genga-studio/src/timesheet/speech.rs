//! The S column (セリフ): spoken lines beside the koma on which they are heard. Dragging down it marks a new line. A click
//! on a line opens it.

use std::ops::Range;

use egui::epaint::TextShape;
use egui::{Align2, Color32, FontId, Painter, PointerButton, Rect, Response, Stroke, pos2, vec2};

use super::paper::Paper;
use crate::command::Command;
use crate::spoken_lines::{self, Spoken};
use crate::view_state::Shown;

/// Height of a letter in vertical text, in points.
const LETTER: f32 = 11.5;
/// Length of the hooks at both ends of a line's bracket, in points.
const HOOK: f32 = 4.0;

/// Pointer state on the S column.
#[derive(Debug, Clone, Default)]
pub(super) struct SpeechHand {
    /// The koma where the drag began, and where it is now.
    marking: Option<(usize, usize)>,
}

impl SpeechHand {
    /// Handles pointer input on the column. Returns whether the input was meant for it.
    pub(super) fn handle(
        &mut self,
        response: &Response,
        paper: &Paper,
        shown: &Shown<'_>,
        commands: &mut Vec<Command>,
    ) -> bool {
        let length = shown.column().length;
        let Some(at) = response.interact_pointer_pos() else {
            self.marking = None;
            return false;
        };
        let origin = response.ctx.input(|input| input.pointer.press_origin()).unwrap_or(at);
        if self.marking.is_none() && !paper.speech().contains(origin.x) {
            return false;
        }
        let (here, pressed) = (paper.koma(at.y, length), paper.koma(origin.y, length));
        if response.drag_started_by(PointerButton::Primary) {
            self.marking = Some((pressed, here));
        } else if let Some((_, to)) = self.marking.as_mut().filter(|_| response.dragged()) {
            *to = here;
        }
        if let Some((a, b)) = self.marking.take_if(|_| response.drag_stopped()) {
            commands.push(Command::AskSpeech(Some(a.min(b)..a.max(b) + 1)));
            return true;
        }
        if response.clicked() {
            match under(at, paper, shown) {
                Some(line) => commands.push(Command::EditSpeech(line.speech.clone())),
                None => return false,
            }
        }
        self.marking.is_some() || response.clicked()
    }

    /// The koma being marked.
    fn marked(&self) -> Option<Range<usize>> {
        self.marking.map(|(a, b)| a.min(b)..a.max(b) + 1)
    }
}

/// The line at a position.
fn under<'a>(at: egui::Pos2, paper: &Paper, shown: &'a Shown<'_>) -> Option<Spoken<'a>> {
    let koma = paper.koma(at.y, shown.column().length);
    let is_there = |spoken: &Spoken<'_>| {
        let heard = spoken.line.begin..spoken.line.past();
        heard.contains(&koma) && strip(paper, spoken).x_range().contains(at.x)
    };
    lines(shown).into_iter().find(is_there)
}

fn lines<'a>(shown: &'a Shown<'_>) -> Vec<Spoken<'a>> {
    let breakdown = &shown.breakdown;
    spoken_lines::all(shown.wanted, breakdown.sheet, breakdown.clip.last())
}

/// Rectangle of a line.
fn strip(paper: &Paper, spoken: &Spoken<'_>) -> Rect {
    let whole = paper.speech();
    let wide = whole.span() / spoken.columns.max(1) as f32;
    let left = whole.min + wide * spoken.column as f32;
    let high = paper.y(spoken.line.begin)..=paper.y(spoken.line.past());
    Rect::from_x_y_ranges(left..=left + wide, high).shrink2(vec2(2.0, 1.0))
}

/// Draws the lines of the koma in view, and the range being marked.
pub(super) fn draw(
    painter: &Painter,
    paper: &Paper,
    rows: &Range<usize>,
    hand: &SpeechHand,
    shown: &Shown<'_>,
) {
    let look = &shown.look;
    waveform(painter, paper, rows, shown);
    if let Some(marked) = hand.marked() {
        let high = paper.y(marked.start)..=paper.y(marked.end);
        let rect = Rect::from_x_y_ranges(paper.speech(), high);
        painter.rect_filled(rect, 2.0, look.chosen);
        painter.rect_stroke(rect, 2.0, Stroke::new(1.5, look.playhead), egui::StrokeKind::Inside);
    }
    for spoken in lines(shown) {
        if spoken.line.begin < rows.end && spoken.line.past() > rows.start {
            line(painter, strip(paper, &spoken), &spoken, look.ink);
        }
    }
}

/// Draws the waveform down the column, behind the lines.
fn waveform(painter: &Painter, paper: &Paper, rows: &Range<usize>, shown: &Shown<'_>) {
    if shown.beside.waveform.is_none() {
        return;
    }
    let (column, middle) = (paper.speech(), paper.speech().center());
    let (first, last) = (paper.y(rows.start), paper.y(rows.end));
    let koma = |y: f32| f64::from((y - paper.rect.min.y) / paper.row);
    for point in 0..(last - first).ceil() as usize {
        let y = first + point as f32;
        let level = shown.level(koma(y), koma(y + 1.0)).unwrap_or(0.0);
        let half = 0.5 * level * (column.span() - 4.0);
        if half >= 0.5 {
            let stroke = Stroke::new(1.0, shown.look.wall.gamma_multiply(0.35));
            painter.hline(middle - half..=middle + half, y + 0.5, stroke);
        }
    }
}

/// Draws a bracket, and the words beside it.
fn line(painter: &Painter, rect: Rect, spoken: &Spoken<'_>, ink: Color32) {
    let stroke = Stroke::new(1.4, ink);
    let left = rect.min.x + 1.0;
    painter.vline(left, rect.y_range(), stroke);
    for y in [rect.min.y, rect.max.y] {
        painter.hline(left..=left + HOOK, y, stroke);
    }
    let inside = rect.with_min_x(left + 3.0).shrink2(vec2(0.0, 2.0));
    let painter = painter.with_clip_rect(painter.clip_rect().intersect(rect.expand(1.0)));
    let text = spoken.line.to_string();
    let is_wide = text.chars().any(|letter| (letter as u32) >= 0x2e80);
    if is_wide {
        stacked(&painter, inside, &text, ink)
    } else {
        turned(&painter, inside, &text, ink)
    }
}

/// Draws letters one below the other, as Japanese is written (縦書き), as many as fit.
fn stacked(painter: &Painter, rect: Rect, text: &str, ink: Color32) {
    let count = text.chars().count();
    let room = (rect.height() / LETTER).floor().max(0.0) as usize;
    let shown = if count > room { room.saturating_sub(1) } else { count };
    let more = (count > room).then_some('…');
    for (at, letter) in text.chars().take(shown).chain(more).enumerate() {
        let middle = pos2(rect.center().x, rect.min.y + LETTER * (at as f32 + 0.5));
        painter.text(
            middle,
            Align2::CENTER_CENTER,
            upright(letter),
            FontId::proportional(11.0),
            ink,
        );
    }
}

/// The vertical form of a letter: brackets, long vowels and ellipses are turned.
fn upright(letter: char) -> char {
    match letter {
        '「' => '﹁',
        '」' => '﹂',
        'ー' => '｜',
        '…' => '︙',
        other => other,
    }
}

/// Draws Latin letters, turned to run down.
fn turned(painter: &Painter, rect: Rect, text: &str, ink: Color32) {
    let mut job =
        egui::text::LayoutJob::simple_singleline(text.to_owned(), FontId::proportional(11.0), ink);
    job.wrap = egui::text::TextWrapping::truncate_at_width(rect.height());
    let galley = painter.layout_job(job);
    // Turning moves the upper left corner to the upper right.
    let at = pos2(rect.center().x + 0.5 * galley.size().y, rect.min.y);
    painter.add(TextShape::new(at, galley, ink).with_angle(std::f32::consts::FRAC_PI_2));
}
