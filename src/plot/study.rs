//! What a study counted, as curves [KT11 Table 1].

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::plot::canvas::{Align, Canvas, Point, Type};
use crate::plot::chart::{self, Plot, curve, range_with_zero};
use crate::plot::style;
use crate::study::{Axis, Grid, Measure, medians};

/// A measure against the first setting of a study (設定と原画の数), a line a value of the second.
///
/// Of several clips the line is their median, and each clip a thin line behind it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StudyPlot {
    /// Width in px, 400 to 20000; default 900.
    pub width: u32,
    /// Height in px, 300 to 20000; default 560.
    pub height: u32,
    /// Which measure is drawn; default the union, what the paper counts.
    pub show: Measure,
    /// Whether the six values of the paper stand beside as hollow marks; default no. They are of
    /// another clip.
    pub paper: bool,
}

impl Default for StudyPlot {
    fn default() -> Self {
        Self { width: 900, height: 560, show: Measure::Turns, paper: false }
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

/// The lines' colours as long as there is one for each.
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
const TOP: f64 = 84.0;
const BOTTOM: f64 = 62.0;

impl StudyPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)
    }

    /// Checks the settings and that they go with those that a study varies: known before it is run.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`StudyPlot::validate`], and named `paper` where the paper's marks are
    /// asked for and the axes are not the paper's.
    pub fn fits(&self, x: &Axis, y: Option<&Axis>) -> Result<(), Error> {
        self.validate()?;
        if self.paper { papers_persistences(x, y).map(drop) } else { Ok(()) }
    }

    /// Draws the study of one clip, or of several, as SVG. All grids are of one study.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`StudyPlot::fits`]; [`Error::Picture`] when there is no clip or the
    /// measure was not counted.
    pub fn draw(&self, grids: &[Grid]) -> Result<String, Error> {
        self.validate()?;
        let Some(grid) = grids.first() else {
            return Err(style::cannot("a study without a clip has nothing to draw"));
        };
        let paper = if self.paper { papers_marks(grid)? } else { vec![] };
        let medians = shown(grids, self.show)?;
        let clips: Vec<Vec<f64>> = match grids {
            [_] => vec![],
            several => several.iter().filter_map(|grid| grid.values(self.show)).collect(),
        };
        let at = Places::of(&grid.x);
        let plot = self.plot(&at, medians.iter().chain(clips.iter().flatten()), &paper);
        let colors = colors(grid.rows());
        let mut canvas = Canvas::new((f64::from(self.width), f64::from(self.height)));
        self.words(&mut canvas, grids);
        plot.draw(&mut canvas, |chart| {
            for (line, color) in clips.iter().flat_map(|values| at.lines(values).zip(&colors)) {
                let faded = style::mixed(*color, style::PAPER, 0.65);
                chart.draw_series(curve(line, faded, 1.0))?;
            }
            for (line, color) in at.lines(&medians).zip(&colors) {
                chart.draw_series(curve(line, *color, 2.0))?;
            }
            Ok(())
        })?;
        for Mark { at: (width, keys), line } in &paper {
            let color = line.map_or(style::FAINT, |y| colors[y]);
            canvas.ring(plot.at(*width, *keys), 5.5, color, 1.75);
        }
        let mut ends = Vec::new();
        for (y, (line, color)) in at.lines(&medians).zip(colors).enumerate() {
            let radius = if at.numbers.len() > 30 { 2.5 } else { 4.0 };
            let points = line.into_iter().map(|(number, value)| plot.at(number, value));
            let end = points.inspect(|point| canvas.disc(*point, radius, color)).last();
            ends.extend(end.map(|end| (end, y, color)));
        }
        if let Some(y) = &grid.y {
            names(&mut canvas, y, ends, plot.to.1);
        }
        Ok(canvas.finish())
    }

    fn plot<'a>(&self, at: &Places, values: impl Iterator<Item = &'a f64>, paper: &[Mark]) -> Plot {
        let to = (f64::from(self.width) - RIGHT, f64::from(self.height) - BOTTOM);
        let numbers = at.numbers.iter().copied().chain(paper.iter().map(|mark| mark.at.0));
        let values: Vec<f64> = values.copied().chain(paper.iter().map(|mark| mark.at.1)).collect();
        let (_, most) = range_with_zero(&values);
        let range = padded(numbers);
        let x = match &at.words {
            Some(words) => {
                let ticks = at.numbers.iter().copied().zip(words.iter().cloned());
                chart::Axis::labelled(range, ticks.collect())
            }
            None => chart::Axis::round(range, (to.0 - LEFT) / 70.0),
        };
        Plot {
            from: (LEFT, TOP),
            to,
            x: x.plain().named(at.name.clone()),
            y: chart::Axis::round((0.0, 1.08 * most), (to.1 - TOP) / 44.0),
        }
    }

    /// The title and what the lines are.
    fn words(&self, canvas: &mut Canvas, grids: &[Grid]) {
        title(canvas, self.show);
        let right = f64::from(self.width) - style::MARGIN;
        if self.paper {
            canvas.ring((right - 158.0, 29.0), 5.5, style::INK, 1.75);
            canvas.text("Kuroda & Tokoi, Table 1", (right - 146.0, 34.0), Type::new(style::WORDS));
        }
        let faint = Type::new(style::WORDS).color(style::FAINT);
        if grids.len() > 1 {
            let of_clips = format!("median of {} clips, each of them a thin line", grids.len());
            canvas.text(&of_clips, (style::MARGIN, 58.0), faint);
        }
        if let Some(y) = &grids[0].y {
            let unit = y.scale().map_or("", |(_, unit)| unit);
            canvas.text(&name(y, unit), (right, 58.0), faint.align(Align::Right));
        }
    }
}

/// The median over the clips of the measure that is drawn.
pub(super) fn shown(grids: &[Grid], show: Measure) -> Result<Vec<f64>, Error> {
    medians(grids, show).ok_or_else(|| style::cannot(format!("{show} was not counted")))
}

/// A count of the paper.
struct Mark {
    /// Filter width and keys.
    at: (f64, f64),
    /// The line of its persistence, where there is one.
    line: Option<usize>,
}

/// The paper's marks with the line that each belongs to, where the axes are its own.
fn papers_marks(grid: &Grid) -> Result<Vec<Mark>, Error> {
    let persistences = papers_persistences(&grid.x, grid.y.as_ref())?;
    let line = |persistence: f64| persistences.iter().position(|own| *own == persistence);
    let mark = |row: &(f64, f64, f64)| Mark { at: (row.0, row.2), line: line(row.1) };
    Ok(PAPER.iter().map(mark).collect())
}

/// The values of the second axis, where both are the paper's.
fn papers_persistences(x: &Axis, y: Option<&Axis>) -> Result<Vec<f64>, Error> {
    let frames = |axis: &Axis, name| {
        let (numbers, unit) = axis.scale()?;
        (axis.name() == name && unit.is_empty()).then_some(numbers)
    };
    let widths = frames(x, "filter.width");
    let persistences = y.and_then(|y| frames(y, "turns.persistence"));
    widths.and(persistences).ok_or_else(|| {
        let message =
            "the paper's counts stand beside filter.width and turns.persistence in frames alone";
        Error::setting("paper", message)
    })
}

/// Where the values of an axis stand: on their scale, or one after the other.
struct Places {
    numbers: Vec<f64>,
    /// What is written at each, where they are words.
    words: Option<Vec<String>>,
    name: String,
}

impl Places {
    fn of(axis: &Axis) -> Self {
        let (numbers, words, unit) = match axis.scale() {
            Some((numbers, unit)) => (numbers, None, unit),
            None => {
                let numbers = (0..axis.len()).map(|at| at as f64).collect();
                (numbers, Some(axis.values().to_vec()), "")
            }
        };
        Self { numbers, words, name: name(axis, unit) }
    }

    /// The lines of all values, each from left to right; the value of the second axis runs fastest.
    fn lines<'a>(&'a self, values: &'a [f64]) -> impl Iterator<Item = Vec<(f64, f64)>> + 'a {
        let rows = values.len() / self.numbers.len().max(1);
        (0..rows).map(move |y| {
            let of_line = values.iter().skip(y).step_by(rows).copied();
            let mut points: Vec<(f64, f64)> = self.numbers.iter().copied().zip(of_line).collect();
            points.retain(|(_, value)| value.is_finite());
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        })
    }
}

/// What an axis is called: its name, its unit, its Japanese name.
pub(super) fn name(axis: &Axis, unit: &str) -> String {
    // What stands behind a comma says more than a picture needs.
    let own = axis.knob().unit.split(',').next().unwrap_or_default();
    let unit = match (unit, own) {
        ("s", _) => " (seconds)".to_owned(),
        ("%", _) => " (%)".to_owned(),
        (_, "source frames or seconds") if axis.scale().is_some() => " (source frames)".to_owned(),
        (_, "") => String::new(),
        (_, own) => format!(" ({own})"),
    };
    format!("{}{unit}  {}", axis.name(), axis.knob().japanese)
}

/// A colour a line: apart as long as there are enough, else from blue to vermilion.
fn colors(lines: usize) -> Vec<RGBColor> {
    let share = |line: usize| line as f64 / (lines - 1) as f64;
    if lines <= COLORS.len() {
        return COLORS[..lines].to_vec();
    }
    (0..lines).map(|line| style::mixed(style::WALL, style::GENGA, share(line))).collect()
}

/// The values of the second setting beside the ends of their lines, moved apart where they would
/// lie on each other; of many lines, whose colours are in order, a few.
fn names(canvas: &mut Canvas, y: &Axis, mut ends: Vec<(Point, usize, RGBColor)>, bottom: f64) {
    const LINE: f64 = 17.0;
    let (last, every) = (ends.len().saturating_sub(1), ends.len().div_ceil(COLORS.len()));
    ends.retain(|(_, y, _)| every == 1 || *y == last || (y % every == 0 && y + every <= last));
    ends.sort_by(|a, b| a.0.1.total_cmp(&b.0.1));
    let mut above = f64::NEG_INFINITY;
    let mut bases: Vec<f64> = Vec::new();
    for (end, ..) in &ends {
        above = (end.1 + 5.0).max(above + LINE);
        bases.push(above);
    }
    // What would hang over the axis is pushed up again.
    let mut below = bottom - 3.0 + LINE;
    for base in bases.iter_mut().rev() {
        *base = base.min(below - LINE);
        below = *base;
    }
    for ((end, y_at, color), base) in ends.into_iter().zip(bases) {
        let look = Type::new(style::WORDS).bold().color(color);
        canvas.text(&y.values()[y_at], (end.0 + 12.0, base), look);
    }
}

/// What is drawn, in both languages.
pub(super) fn title(canvas: &mut Canvas, show: Measure) {
    canvas.text(&headline(show), (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
}

/// The measure in both languages.
pub(super) fn headline(show: Measure) -> String {
    let (english, japanese) = show.words();
    let mut letters = english.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string());
    format!("{}{}  {japanese}", first.unwrap_or_default(), letters.as_str())
}

/// The range of some numbers with some air at both ends.
fn padded(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
        (low.min(number), high.max(number))
    });
    let air = if high > low { 0.05 * (high - low) } else { 1.0 };
    (low - air, high + air)
}
