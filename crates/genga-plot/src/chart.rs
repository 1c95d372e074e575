//! Draws charts: boxes of the paper with axes and series, which a library draws.

mod axis;
mod backend;
mod ticks;

use std::convert::Infallible;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::{DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::Rectangle;
use plotters::series::LineSeries;
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, ShapeStyle, TextStyle};

use crate::canvas::Canvas;
use crate::chart::backend::{Tenths, units};
use crate::paper_point::Point;
use crate::style;
use genga::error::Error;

pub(super) use axis::{Axis, number, range_with_zero, robust_top};

/// Length of a tick in px. The library writes labels twice as far from the axis.
const TICK: f64 = 4.0;
/// Height below a chart for the labels of its ticks, and below them for its name, in px.
const LABELS: f64 = 24.0;
const NAME: f64 = 24.0;

/// A chart that series are drawn on.
pub(super) type Chart<'a> = ChartContext<'a, Tenths<'a>, Cartesian2d<Axis, Axis>>;

/// The result of drawing a series.
pub(super) type Outcome = Result<(), DrawingAreaErrorKind<Infallible>>;

/// A chart's box, from its upper left to its lower right corner, and its axes. A ruler has no height.
pub(super) struct Plot {
    pub(super) from: Point,
    pub(super) to: Point,
    pub(super) x: Axis,
    pub(super) y: Axis,
}

impl Plot {
    /// Builds a chart that is only a horizontal axis.
    pub(super) fn ruler((from, to): (f64, f64), y: f64, x: Axis) -> Self {
        Self { from: (from, y), to: (to, y), x: x.plain(), y: Axis::labelled((0.0, 1.0), vec![]) }
    }

    /// Returns the point in px at which a value is drawn.
    pub(super) fn at(&self, x: f64, y: f64) -> Point {
        let (from, to) = (self.from, self.to);
        (self.x.at(x, (from.0, to.0)), self.y.at(y, (to.1, from.1)))
    }

    /// Draws the axes, then whatever `series` draws on them.
    ///
    /// # Errors
    /// [`Error::Picture`] if the library fails.
    pub(super) fn draw(
        &self,
        canvas: &mut Canvas,
        series: impl FnOnce(&mut Chart<'_>) -> Outcome,
    ) -> Result<(), Error> {
        self.try_draw(canvas, series).map_err(style::failed)
    }

    fn try_draw(
        &self,
        canvas: &mut Canvas,
        series: impl FnOnce(&mut Chart<'_>) -> Outcome,
    ) -> Outcome {
        let room = |is_empty: bool, px: f64| if is_empty { 0 } else { units(px) };
        let below = room(self.x.ticks.is_empty(), LABELS) + room(self.x.name.is_empty(), NAME);
        let left = room(self.y.ticks.is_empty(), self.from.0);
        // The library's last unit is one before the edge of its paper.
        let size = (units(self.to.0) + 1, units(self.to.1) + below + 1);
        let paper = Tenths { canvas, size }.into_drawing_area();
        let mut chart = ChartBuilder::on(&paper)
            .margin_top(units(self.from.1))
            .margin_left(units(self.from.0) - left)
            .y_label_area_size(left)
            .x_label_area_size(below)
            .build_cartesian_2d(self.x.clone(), self.y.clone())?;
        self.mesh(&mut chart)?;
        series(&mut chart)
    }

    fn mesh(&self, chart: &mut Chart<'_>) -> Outcome {
        let mut mesh = chart.configure_mesh();
        if !self.x.lines {
            mesh.disable_x_mesh();
        }
        if !self.y.lines {
            mesh.disable_y_mesh();
        }
        mesh.bold_line_style(pen(style::GRID, 1.0))
            .axis_style(pen(style::FAINT, 1.0))
            .set_all_tick_mark_size(units(TICK))
            .label_style(words(style::SMALL))
            .x_desc(self.x.name.as_str())
            .axis_desc_style(words(style::WORDS))
            .draw()
    }
}

/// Builds an open line through values.
pub(super) fn curve<'a>(
    points: impl IntoIterator<Item = (f64, f64)>,
    color: RGBColor,
    width: f64,
) -> LineSeries<Tenths<'a>, (f64, f64)> {
    LineSeries::new(points, pen(color, width))
}

/// Builds a filled box between two values.
pub(super) fn bar(from: (f64, f64), to: (f64, f64), color: RGBColor) -> Rectangle<(f64, f64)> {
    Rectangle::new([from, to], color.filled())
}

fn pen(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width(units(width))
}

/// Builds the style of words. Only its size counts, since the canvas has a font of its own.
fn words(size: f64) -> TextStyle<'static> {
    let size = f64::from(units(size));
    TextStyle::from(FontDesc::new(FontFamily::SansSerif, size, FontStyle::Normal))
        .color(&style::INK)
}
