//! How many keys the two numbers of the key search leave [KT11 Table 1].

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::plot::axis::{Scale, number, range_with_zero};
use crate::plot::canvas::{Align, Canvas, Point, Type, paint};
use crate::plot::style;

/// One run of the key search (原画の数).
#[derive(Debug, Clone, PartialEq)]
pub struct StudyRow {
    /// Width of the low pass in source frames.
    pub filter_width: f64,
    /// Frames that have to confirm a turn.
    pub persistence: f64,
    /// Distinct frames that are a key of any joint.
    pub union: usize,
    /// Keys of all joints together.
    pub total: usize,
    /// Keys of the layer.
    pub layer_keys: usize,
}

/// Which of the three counts of a [`StudyRow`] is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StudyCount {
    /// Distinct frames over all joints, what Table 1 counts.
    #[default]
    Union,
    /// The sum over the joints.
    Total,
    /// Keys of the layer.
    LayerKeys,
}

impl StudyCount {
    fn of(self, row: &StudyRow) -> f64 {
        let count = match self {
            Self::Union => row.union,
            Self::Total => row.total,
            Self::LayerKeys => row.layer_keys,
        };
        count as f64
    }

    fn words(self) -> &'static str {
        match self {
            Self::Union => "frames with a key of any joint",
            Self::Total => "keys of all joints",
            Self::LayerKeys => "keys of the layer",
        }
    }
}

/// Keys against the filter width (フィルタ適用範囲と原画の数), a line a persistence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StudyPlot {
    /// Width in px, 400 to 20000; default 900.
    pub width: u32,
    /// Height in px, 300 to 20000; default 560.
    pub height: u32,
    /// Which count is drawn; default the union, what the paper counts.
    pub count: StudyCount,
    /// Whether the six values of the paper stand beside as hollow marks; default no. They are of
    /// another clip.
    pub paper: bool,
}

impl Default for StudyPlot {
    fn default() -> Self {
        Self { width: 900, height: 560, count: StudyCount::Union, paper: false }
    }
}

/// Table 1 of the paper: filter width, persistence, keys.
const PAPER: [(f64, f64, f64); 6] = [
    (10.0, 5.0, 99.0),
    (10.0, 10.0, 75.0),
    (20.0, 5.0, 80.0),
    (20.0, 10.0, 71.0),
    (30.0, 5.0, 64.0),
    (30.0, 10.0, 52.0),
];

/// One line's colour, after the other; persistences beyond them begin again.
const COLORS: [RGBColor; 6] = [
    style::GENGA,
    style::WALL,
    RGBColor(0, 140, 102),
    style::RIGHT,
    RGBColor(140, 80, 140),
    style::END,
];

const LEFT: f64 = 72.0;
const RIGHT: f64 = 92.0;
const TOP: f64 = 72.0;
const BOTTOM: f64 = 58.0;

impl StudyPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)
    }

    /// Draws the study as SVG.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`StudyPlot::validate`]; [`Error::Picture`] when there is no row or a
    /// width or persistence is not finite.
    pub fn draw(&self, rows: &[StudyRow]) -> Result<String, Error> {
        self.validate()?;
        if rows.is_empty() {
            return Err(style::cannot("a study without rows has nothing to draw"));
        }
        if !rows.iter().all(|row| row.filter_width.is_finite() && row.persistence.is_finite()) {
            return Err(style::cannot("filter widths and persistences must be finite"));
        }
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let paper: &[_] = if self.paper { &PAPER } else { &[] };
        let widths = rows.iter().map(|row| row.filter_width).chain(paper.iter().map(|row| row.0));
        let counts: Vec<_> = rows
            .iter()
            .map(|row| self.count.of(row))
            .chain(paper.iter().map(|row| row.2))
            .collect();
        let x = Scale::new(padded(widths), (LEFT, width - RIGHT));
        let (_, most) = range_with_zero(&counts);
        let y = Scale::new((0.0, 1.08 * most), (height - BOTTOM, TOP));
        paint((self.width, self.height), |canvas| {
            self.axes(canvas, &x, &y)?;
            for (at, persistence) in persistences(rows, paper).into_iter().enumerate() {
                let color = COLORS[at % COLORS.len()];
                let mut ours: Vec<Point> = rows
                    .iter()
                    .filter(|row| row.persistence == persistence)
                    .map(|row| (x.at(row.filter_width), y.at(self.count.of(row))))
                    .collect();
                ours.sort_by(|a, b| a.0.total_cmp(&b.0));
                for row in paper.iter().filter(|row| row.1 == persistence) {
                    canvas.ring((x.at(row.0), y.at(row.2)), 5.5, color, 1.75)?;
                }
                curve(canvas, &ours, color)?;
            }
            self.names(canvas, rows, (&x, &y))
        })
    }

    fn axes(&self, canvas: &mut Canvas<'_>, x: &Scale, y: &Scale) -> Result<(), Error> {
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let (right, bottom) = (width - RIGHT, height - BOTTOM);
        let title = Type::new(style::TITLE).bold();
        canvas.text("Keys and the filter 原画の数とフィルタ", (style::MARGIN, 34.0), title)?;
        let words = Type::new(style::WORDS);
        canvas.text(self.count.words(), (style::MARGIN, 56.0), words.color(style::FAINT))?;
        let look = Type::new(style::SMALL);
        for value in y.ticks(44.0) {
            let at = y.at(value);
            canvas.line((LEFT, at), (right, at), style::GRID, 1.0)?;
            let look = look.align(Align::Right);
            canvas.text(&number(value), (LEFT - 8.0, at + 4.0), look)?;
        }
        canvas.line((LEFT, bottom), (right, bottom), style::FAINT, 1.0)?;
        for value in x.ticks(70.0) {
            let at = x.at(value);
            canvas.line((at, bottom), (at, bottom + 5.0), style::FAINT, 1.0)?;
            canvas.text(&number(value), (at, bottom + 19.0), look.align(Align::Center))?;
        }
        let middle = 0.5 * (LEFT + right);
        let name = "filter width W (source frames) フィルタ適用範囲";
        canvas.text(name, (middle, bottom + 42.0), words.align(Align::Center))?;
        if !self.paper {
            return Ok(());
        }
        canvas.ring((right - 150.0, 51.0), 5.5, style::INK, 1.75)?;
        canvas.text("Kuroda & Tokoi, Table 1", (right - 138.0, 56.0), words)
    }

    /// The persistences beside the ends of their lines, moved apart where they would lie on each
    /// other.
    fn names(
        &self,
        canvas: &mut Canvas<'_>,
        rows: &[StudyRow],
        (x, y): (&Scale, &Scale),
    ) -> Result<(), Error> {
        let last = |persistence: f64| {
            let of_line = rows.iter().filter(|row| row.persistence == persistence);
            of_line.max_by(|a, b| a.filter_width.total_cmp(&b.filter_width))
        };
        let paper: &[_] = if self.paper { &PAPER } else { &[] };
        let mut ends: Vec<(f64, f64, f64, RGBColor)> = persistences(rows, paper)
            .into_iter()
            .enumerate()
            .filter_map(|(at, persistence)| {
                let row = last(persistence)?;
                let place = (x.at(row.filter_width), y.at(self.count.of(row)));
                Some((place.1, place.0, persistence, COLORS[at % COLORS.len()]))
            })
            .collect();
        ends.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut above = f64::NEG_INFINITY;
        for (at, x, persistence, color) in ends {
            let base = (at + 5.0).max(above + 17.0);
            above = base;
            let look = Type::new(style::WORDS).bold().color(color);
            canvas.text(&format!("M = {}", number(persistence)), (x + 12.0, base), look)?;
        }
        Ok(())
    }
}

/// The persistences there are, from the least.
fn persistences(rows: &[StudyRow], paper: &[(f64, f64, f64)]) -> Vec<f64> {
    let mut all: Vec<f64> =
        rows.iter().map(|row| row.persistence).chain(paper.iter().map(|row| row.1)).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// The range of the widths with some air at both ends.
fn padded(widths: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = widths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), width| {
        (low.min(width), high.max(width))
    });
    let air = if high > low { 0.05 * (high - low) } else { 1.0 };
    (low - air, high + air)
}

fn curve(canvas: &mut Canvas<'_>, points: &[Point], color: RGBColor) -> Result<(), Error> {
    canvas.path(points, color, 2.0)?;
    points.iter().try_for_each(|point| canvas.disc(*point, 4.0, color))
}
