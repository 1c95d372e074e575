//! Draws the counts of a study as a map of both settings.

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Type};
use crate::chart::{self, Plot, bar, number};
use crate::paper_point::Point;
use crate::study_chart::{check_per_second, headline, name, named, shown, unit};
use crate::style;
use crate::title::Title;
use genga::error::Error;
use genga_lab::study::{Axis, Grid, Measure, Plateau};

/// The map of a study (設定の地図): a measure in each cell. Darker cells have greater values, which are written in
/// them if there is room. The first setting runs to the right, the second upwards. Several clips are shown by
/// their median.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HeatMap {
    /// Measure to draw; default turns of the body.
    pub show: Measure,
    /// Whether a count is drawn per second of its sheet; default no.
    pub per_second: bool,
}

/// Total width of all columns and total height of all rows, in px, unless a cell would be too large or too
/// small.
const COLUMNS: f64 = 760.0;
const ROWS: f64 = 480.0;

/// Minimum and maximum of a cell's width and of its height, in px.
const CELL: [(f64, f64); 2] = [(1.0, 72.0), (7.0, 34.0)];

/// Maximum number of cells in a row or a column: more would be illegible.
const MOST_CELLS: usize = 1000;

const TOP: f64 = 96.0;
const BOTTOM: f64 = 62.0;
/// Distance from the cells down to the legend of the marks, in px.
const LEGEND: f64 = 72.0;

/// Colours of the least value, of the middle of the range and of the greatest value.
const FEW: RGBColor = RGBColor(242, 246, 249);
const HALF: RGBColor = RGBColor(112, 170, 212);
const MOST: RGBColor = RGBColor(8, 48, 92);

impl HeatMap {
    /// Checks that a study of these settings can be drawn. Call it before running the study.
    ///
    /// # Errors
    /// [`Error::Picture`] if the picture would be too large.
    pub fn fits(x: &Axis, y: Option<&Axis>) -> Result<(), Error> {
        let (columns, rows) = (x.len(), y.map_or(1, Axis::len));
        if columns.max(rows) > MOST_CELLS {
            return Err(style::cannot(format!(
                "{columns} × {rows} cells are too many to look at, {MOST_CELLS} in a row at the most; \
                 take larger steps"
            )));
        }
        Ok(())
    }

    /// Draws the study of a clip, or the median of several, as SVG. `clips` are the names of the clips; all
    /// grids are of one study.
    ///
    /// `plateaus` are outlined: first the one with identical keys, then the one with nearly identical keys.
    /// If they are given, the cell of the recipe's own settings is marked too.
    ///
    /// # Errors
    /// [`Error::Setting`] named `per_second` if that is asked of a measure that is not a count;
    /// [`Error::Picture`] if there is no clip, if the measure was not counted, or if the picture would be too
    /// large.
    pub fn draw(
        &self,
        clips: &[String],
        grids: &[Grid],
        plateaus: Option<&[Option<Plateau>; 2]>,
    ) -> Result<String, Error> {
        let Some(grid) = grids.first() else {
            return Err(style::cannot("a study without a clip has nothing to draw"));
        };
        Self::fits(&grid.x, grid.y.as_ref())?;
        check_per_second(self.show, self.per_second)?;
        let spreads = shown(grids, self.show, self.per_second)?;
        let values: Vec<f64> = spreads.iter().map(|spread| spread.median).collect();
        let title = headline(self.show, self.per_second);
        let map = Map::new(grid, &values, (&title, plateaus.is_some()));
        let (width, height) = map.size();
        let height =
            height + if plateaus.is_some() { LEGEND - BOTTOM + style::MARGIN } else { 0.0 };
        let mut canvas = Canvas::new((width, height));
        let median = if grids.len() > 1 { "median 中央値, " } else { "" };
        let what = format!("{median}{}", unit(self.show, self.per_second));
        let free = map.scale(&mut canvas, &what);
        let width = free - 8.0 + style::MARGIN;
        Title { words: &title, clips: &named(clips), legend: &[], width }.draw(&mut canvas);
        map.cells(&mut canvas, &values)?;
        if let Some(plateaus) = plateaus {
            map.edges(&mut canvas, grid, plateaus);
        }
        map.names(&mut canvas, grid);
        Ok(canvas.finish())
    }
}

/// Words of the legend: of both plateaus and of the cell of the recipe.
const LEGEND_WORDS: [&str; 3] =
    ["same keys of the layer 原画が同じ", "nearly the same ほぼ同じ", "the recipe 現在のレシピ"];
/// Width of a mark of the legend and the gap behind its words, in px.
const MARK: f64 = 25.0;
const BETWEEN: f64 = 22.0;

/// Width of the whole legend, in px.
fn legend_width() -> f64 {
    let words = LEGEND_WORDS.iter().map(|words| style::text_width(words, style::SMALL));
    words.map(|width| MARK + width + BETWEEN).sum::<f64>() - BETWEEN
}

/// The layout of the cells.
struct Map {
    /// Chart whose values are columns from the left and rows from below.
    plot: Plot,
    rows: usize,
    /// Width that the words above and below the cells need, in px.
    words: f64,
    /// Width and height of a cell, in px.
    cell: (f64, f64),
    low: f64,
    high: f64,
    /// Font size of the numbers in the cells, if they have room.
    type_size: Option<f64>,
}

impl Map {
    fn new(grid: &Grid, values: &[f64], (title, has_legend): (&str, bool)) -> Self {
        let (columns, rows) = (grid.x.len(), grid.rows());
        let px = |all: f64, count: usize, (least, most): (f64, f64)| {
            (all / count as f64).floor().clamp(least, most)
        };
        let cell = (px(COLUMNS, columns, CELL[0]), px(ROWS, rows, CELL[1]));
        let finite = || values.iter().copied().filter(|value| value.is_finite());
        let widest = values.iter().map(|value| style::text_width(&written(*value), 1.0));
        let widest = widest.fold(0.57, f64::max);
        let fits = ((cell.0 - 4.0) / widest).min(0.62 * cell.1).min(style::WORDS);
        let labels = grid.y.iter().flat_map(Axis::values);
        let label = labels.map(|value| style::text_width(value, style::SMALL)).fold(0.0, f64::max);
        let title = style::text_width(title, 1.1 * style::TITLE);
        let axes = [Some(&grid.x), grid.y.as_ref()].into_iter().flatten();
        let words = axes.map(|axis| style::text_width(&name(axis), style::WORDS));
        let left = style::MARGIN + label + if grid.y.is_some() { 30.0 } else { 0.0 };
        let widest = grid.x.values().iter().map(|value| style::text_width(value, style::SMALL));
        let below = labels_of(&grid.x, (widest.fold(0.0, f64::max) + 8.0) / cell.0);
        let beside = grid.y.as_ref().map(|axis| labels_of(axis, 14.0 / cell.1));
        Self {
            plot: Plot {
                from: (left, TOP),
                to: (left + columns as f64 * cell.0, TOP + rows as f64 * cell.1),
                x: chart::Axis::labelled((0.0, columns as f64), below).plain(),
                y: chart::Axis::labelled((0.0, rows as f64), beside.unwrap_or_default()).plain(),
            },
            rows,
            words: words.fold(if has_legend { title.max(legend_width()) } else { title }, f64::max),
            cell,
            low: finite().fold(f64::INFINITY, f64::min),
            high: finite().fold(f64::NEG_INFINITY, f64::max),
            type_size: (fits >= style::SMALL).then_some(fits),
        }
    }

    fn size(&self) -> (f64, f64) {
        let width = self.plot.to.0.max(style::MARGIN + self.words) + style::MARGIN;
        (width.max(560.0), self.plot.to.1 + BOTTOM)
    }

    /// Returns the upper left corner of a cell; the first row is the lowest.
    fn corner(&self, x: usize, y: usize) -> Point {
        self.plot.at(x as f64, (y + 1) as f64)
    }

    /// Returns the place of a value in the range: 0 for the least, 1 for the greatest.
    fn share(&self, value: f64) -> f64 {
        if self.high > self.low { (value - self.low) / (self.high - self.low) } else { 0.0 }
    }

    /// Draws the cells, their axes and their values.
    fn cells(&self, canvas: &mut Canvas, values: &[f64]) -> Result<(), Error> {
        // A hairline of paper between cells that are large enough to show it.
        let hair = if self.cell.0.min(self.cell.1) >= 14.0 { 0.5 } else { 0.0 };
        let (wide, high) = (hair / self.cell.0, hair / self.cell.1);
        let place = |at: usize| ((at / self.rows) as f64, (at % self.rows) as f64);
        let finite = || values.iter().enumerate().filter(|(_, value)| value.is_finite());
        let cells = finite().map(|(at, value)| {
            let (x, y) = place(at);
            let to = (x + 1.0 - wide, y + 1.0 - high);
            bar((x + wide, y + high), to, color(self.share(*value)))
        });
        self.plot.draw(canvas, |chart| chart.draw_series(cells).map(drop))?;
        let Some(size) = self.type_size else { return Ok(()) };
        for (at, value) in finite() {
            let (x, y) = place(at);
            let (middle, base) = self.plot.at(x + 0.5, y + 0.5);
            let ink = if self.share(*value) > 0.55 { style::PAPER } else { style::INK };
            let look = Type::new(size).color(ink).align(Align::Center);
            canvas.text(&written(*value), (middle, base + 0.36 * size), look);
        }
        Ok(())
    }

    /// Draws the names of both axes.
    fn names(&self, canvas: &mut Canvas, grid: &Grid) {
        let words = Type::new(style::WORDS);
        // A name may be wider than a map of few columns.
        let middle = self.plot.at(0.5 * grid.x.len() as f64, 0.0).0;
        let place = (middle.max(0.5 * self.size().0.min(560.0)), self.plot.to.1 + 42.0);
        canvas.text(&name(&grid.x), place, words.align(Align::Center));
        if let Some(axis) = &grid.y {
            canvas.text(&name(axis), (style::MARGIN, TOP - 10.0), words);
        }
    }

    /// Draws the outlines of plateaus and the mark of the recipe's own cell, with their legend below the map.
    fn edges(&self, canvas: &mut Canvas, grid: &Grid, plateaus: &[Option<Plateau>; 2]) {
        let base = self.plot.to.1 + LEGEND;
        let mut left = style::MARGIN;
        let looks = [(style::GENGA, 2.0), (style::RIGHT, 4.0)];
        let [same, nearly, recipe] = LEGEND_WORDS;
        // The wider edge lies under the other.
        for ((plateau, (color, width)), words) in
            plateaus.iter().zip(looks).zip([same, nearly]).rev()
        {
            let Some(plateau) = plateau else { continue };
            for (from, to) in self.edge_of(grid, plateau) {
                canvas.line(from, to, color, width);
            }
            canvas.line((left, base - 4.0), (left + 18.0, base - 4.0), color, width);
            left = self.legend(canvas, left, base, words);
        }
        let Some(own) = grid.own else { return };
        let (x, y) = self.corner(own / self.rows, own % self.rows);
        let radius = (0.2 * self.cell.0.min(self.cell.1)).clamp(2.0, 4.5);
        let place = (x + self.cell.0 - radius - 2.0, y + radius + 2.0);
        for place in [place, (left + 9.0, base - 4.0)] {
            canvas.spot(place, radius, style::GENGA);
        }
        self.legend(canvas, left, base, recipe);
    }

    /// Writes the words of the legend beside a mark, and returns the x of the next mark.
    fn legend(&self, canvas: &mut Canvas, left: f64, base: f64, words: &str) -> f64 {
        canvas.text(words, (left + MARK, base), Type::new(style::SMALL));
        left + MARK + style::text_width(words, style::SMALL) + BETWEEN
    }

    /// Returns the sides of cells at which the plateau ends.
    fn edge_of(&self, grid: &Grid, plateau: &Plateau) -> Vec<(Point, Point)> {
        let mut edge = Vec::new();
        for at in &plateau.cells {
            let (x, y) = (at / self.rows, at % self.rows);
            let (left, top) = self.corner(x, y);
            let (right, bottom) = (left + self.cell.0, top + self.cell.1);
            let holds = |beside: Option<usize>| beside.is_some_and(|at| plateau.holds(at));
            let beside = |x: Option<usize>, y: Option<usize>| {
                let (x, y) = (x?, y?);
                (x < grid.x.len() && y < self.rows).then_some(x * self.rows + y)
            };
            for (other, from, to) in [
                (beside(x.checked_sub(1), Some(y)), (left, top), (left, bottom)),
                (beside(Some(x + 1), Some(y)), (right, top), (right, bottom)),
                (beside(Some(x), Some(y + 1)), (left, top), (right, top)),
                (beside(Some(x), y.checked_sub(1)), (left, bottom), (right, bottom)),
            ] {
                if !holds(other) {
                    edge.push((from, to));
                }
            }
        }
        edge
    }

    /// Draws the scale of colours at the upper right, and returns its left edge in px.
    fn scale(&self, canvas: &mut Canvas, words: &str) -> f64 {
        const STEPS: usize = 24;
        let (width, right) = (96.0, self.size().0 - style::MARGIN);
        let look = Type::new(style::SMALL);
        let (least, most) = (written(self.low), written(self.high));
        let right = right - style::text_width(&most, style::SMALL) - 6.0;
        for step in 0..STEPS {
            let left = right - width + width * step as f64 / STEPS as f64;
            let share = step as f64 / (STEPS - 1) as f64;
            canvas.rect((left, 47.0), (left + width / STEPS as f64, 57.0), color(share));
        }
        canvas.text(&most, (right + 6.0, 56.0), look);
        let left = right - width - 6.0;
        canvas.text(&least, (left, 56.0), look.align(Align::Right));
        let left = left - style::text_width(&least, style::SMALL) - 8.0;
        let faint = look.color(style::FAINT).align(Align::Right);
        canvas.text(words, (left, 56.0), faint);
        left - style::text_width(words, style::SMALL)
    }
}

/// Returns the colour of a share, 0 to 1; greater is darker.
pub fn color(share: f64) -> RGBColor {
    if share < 0.5 {
        style::mixed(FEW, HALF, 2.0 * share)
    } else {
        style::mixed(HALF, MOST, 2.0 * share - 1.0)
    }
}

/// Formats a value with few digits, to be read at a glance.
fn written(value: f64) -> String {
    match value.abs() {
        size if size >= 1e5 => format!("{value:.1e}"),
        size if size >= 100.0 => number(value.round()),
        size if size >= 1.0 => number((value * 10.0).round() / 10.0),
        _ => number((value * 100.0).round() / 100.0),
    }
}

/// Returns the labels of an axis, in the middle of their cells. They are thinned so that each label has
/// `cells` cells of room.
fn labels_of(axis: &Axis, cells: f64) -> Vec<(f64, String)> {
    let every = cells.ceil().max(1.0) as usize;
    let values = axis.values().iter().enumerate().step_by(every);
    values.map(|(at, value)| (at as f64 + 0.5, value.clone())).collect()
}
