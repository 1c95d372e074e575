//! Draws the parts of a preview that are the same on every koma: words, floors, the sheets as bars.

use super::scene::{BOTTOM, PAD};
use crate::canvas::{Align, Canvas, Type};
use crate::drawings::{ShownDrawing, seconds_and_koma, shown_drawings};
use crate::paper_point::Point;
use crate::side_by_side::{Reel, SideBySide, longest, runs};
use crate::style;
use genga::sheet::Role;

/// Height of the bars of a sheet beside its source, and of each of two sheets, in px.
const ALONE: f64 = 10.0;
const EACH: f64 = 9.0;
/// Distance of the lowest bars from the lower edge, and from the top of the upper bars to that of the lower, in px.
const UP: f64 = 30.0;
const STEP: f64 = 18.0;
/// Largest share of the width that the names of two sheets take up before their bars.
const NAMES: f64 = 0.2;

/// Words before the number of a drawing.
const NUMBER: &str = "drawing 動画";
/// Words on koma on which two versions differ, and for two that do not.
const DIFFERENT: &str = "≠ different drawings 絵が違う";
const SAME: &str = "the same drawings throughout 全コマ同じ絵";

/// What the backdrop shows.
pub(super) struct Backdrop<'a> {
    pub(super) cut: &'a str,
    pub(super) shown: &'a SideBySide<'a>,
    pub(super) reels: &'a [Reel<'a>],
    /// Whether two versions differ, for each koma.
    pub(super) differences: &'a [bool],
    /// Number of koma in the film.
    pub(super) koma: usize,
    pub(super) size: (f64, f64),
    /// Whether the camera follows the body.
    pub(super) follows: bool,
}

/// The room of the bars: the koma along it, and its upper and lower edge, in px.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    left: f64,
    /// Width of a koma.
    one: f64,
    top: f64,
    low: f64,
}

impl Room {
    /// Left edge of a koma.
    fn x(&self, koma: usize) -> f64 {
        self.left + self.one * koma as f64
    }

    /// Upper left corner and height of the mark of a koma that is on screen.
    pub(super) fn here(&self, koma: usize) -> (Point, f64) {
        (
            (self.left + self.one * (koma as f64 + 0.5) - 1.0, self.top - 4.0),
            self.low - self.top + 8.0,
        )
    }
}

impl Backdrop<'_> {
    /// Lays out the room of the bars.
    pub(super) fn room(&self) -> Room {
        let (left, high) = match self.shown {
            SideBySide::Source(..) => (PAD, ALONE),
            SideBySide::Versions(_) => (PAD + self.names_width(), STEP + EACH),
        };
        let low = self.size.1 - UP;
        let one = (self.size.0 - PAD - left) / self.koma as f64;
        Room { left, one, top: low - high, low }
    }

    /// Width of the names before the bars of two sheets, with a gap.
    fn names_width(&self) -> f64 {
        let SideBySide::Versions(versions) = self.shown else { return 0.0 };
        let widths = versions.map(|version| style::text_width(version.name, style::SMALL));
        widths[0].max(widths[1]).min(NAMES * self.size.0) + 8.0
    }

    /// Right end of the number of the drawing in a panel. Between two versions there is room for ≠.
    pub(super) fn number_end(&self, panel: usize) -> f64 {
        let pad = if self.reels.len() == 1 { PAD } else { 2.0 * PAD };
        0.5 * self.size.0 * (panel + 1) as f64 - pad
    }

    /// Draws it as SVG.
    pub(super) fn draw(&self) -> String {
        let mut canvas = Canvas::new(self.size);
        let (half, floor) = (0.5 * self.size.0, self.size.1 - BOTTOM);
        self.titles(&mut canvas);
        for x in [0.0, half] {
            canvas.line((x + PAD, floor), (x + half - PAD, floor), style::RAW, 1.25);
        }
        canvas.line((half, 12.0), (half, floor), style::GRID, 1.0);
        self.sheets(&mut canvas);
        self.words(&mut canvas);
        canvas.finish()
    }

    /// Draws what each half shows.
    fn titles(&self, canvas: &mut Canvas) {
        let half = 0.5 * self.size.0;
        let bold = Type::new(style::WORDS).bold();
        let faint = Type::new(style::SMALL).color(style::FAINT);
        let along = "camera goes along";
        let number = |canvas: &mut Canvas, panel: usize| {
            let right = self.number_end(panel) - 46.0;
            if self.reels[panel + self.reels.len() - 2].signs.is_empty() {
                canvas.text(NUMBER, (right, 27.0), faint.align(Align::Right));
            }
        };
        match self.shown {
            SideBySide::Source(..) => {
                canvas.text("source 素材", (PAD, 27.0), bold);
                canvas.text("result 結果", (half + PAD, 27.0), bold);
                number(canvas, 1);
                if self.follows {
                    canvas.text(along, (half - PAD, 27.0), faint.align(Align::Right));
                }
            }
            SideBySide::Versions(versions) => {
                let taken = 4.0 * PAD + 46.0 + style::text_width(NUMBER, style::SMALL);
                for (panel, version) in versions.iter().enumerate() {
                    let name = style::fitted(version.name, style::WORDS, half - taken);
                    canvas.text(&name, (half * panel as f64 + PAD, 27.0), bold);
                    number(canvas, panel);
                }
                if self.follows {
                    canvas.text(along, (PAD, 42.0), faint);
                }
            }
        }
    }

    /// Draws the bars of each sheet, and where two of them differ.
    fn sheets(&self, canvas: &mut Canvas) {
        let room = self.room();
        if let SideBySide::Versions(versions) = self.shown {
            for (at, version) in versions.iter().enumerate() {
                let name = style::fitted(version.name, style::SMALL, NAMES * self.size.0);
                let base = room.top + STEP * at as f64 + EACH;
                canvas.text(&name, (PAD, base), Type::new(style::SMALL).color(style::FAINT));
            }
            for (from, koma) in runs(self.differences).filter(|(from, _)| *from < self.koma) {
                let past = (from + koma).min(self.koma);
                let (y, middle) = (room.top + EACH + 2.0, STEP - EACH - 4.0);
                canvas.rect((room.x(from), y), (room.x(past), y + middle), style::INK);
            }
        }
        let high = if self.reels.len() == 1 { ALONE } else { EACH };
        for (at, reel) in self.reels.iter().enumerate() {
            let mut cells = shown_drawings(reel.composite.layer());
            cells.iter_mut().for_each(|cell| cell.koma += reel.sheet.blank.before);
            bars(canvas, &cells, self.koma, (room, room.top + STEP * at as f64, high));
        }
    }

    /// Writes the line below the bars.
    fn words(&self, canvas: &mut Canvas) {
        let base = self.size.1 - 10.0;
        let faint = Type::new(style::WORDS).color(style::FAINT);
        canvas.text("koma", (PAD, base), faint);
        let whole = longest(self.reels);
        let length = seconds_and_koma(whole, self.shown.koma_rate());
        let koma = self.koma;
        let more = if koma < whole { format!(", the first {koma} shown") } else { String::new() };
        let of = format!("of {whole} (尺 {length}){more}");
        canvas.text(&of, (PAD + 76.0, base), faint);
        let left = PAD + 90.0 + style::text_width(&of, style::WORDS);
        let right = match self.shown {
            SideBySide::Source(..) => self.cut.to_owned(),
            SideBySide::Versions(_) if self.differences.contains(&true) => {
                format!("{} · {DIFFERENT}", self.cut)
            }
            SideBySide::Versions(_) => format!("{} · {SAME}", self.cut),
        };
        let right = style::fitted(&right, style::WORDS, self.size.0 - PAD - left);
        canvas.text(&right, (self.size.0 - PAD, base), faint.align(Align::Right));
    }
}

/// Draws a bar for each exposure, coloured by its role.
fn bars(
    canvas: &mut Canvas,
    cells: &[ShownDrawing<'_>],
    koma: usize,
    (room, y, high): (Room, f64, f64),
) {
    for cell in cells.iter().take_while(|cell| cell.koma < koma) {
        let held = cell.held.min(koma - cell.koma);
        let from: Point = (room.x(cell.koma), y);
        let color = match cell.drawing.role {
            Role::Inbetween => style::mixed(style::INBETWEEN, style::PAPER, 0.5),
            role => style::of_role(role),
        };
        let gap = if room.one >= 3.0 { 1.0 } else { 0.0 };
        canvas.rect(from, (from.0 + room.one * held as f64 - gap, y + high), color);
    }
}
