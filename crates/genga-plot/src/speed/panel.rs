//! Draws a panel: the speed of one joint, with its keys and walls.

use plotters::style::RGBColor;

use crate::canvas::{Align, Canvas, Type};
use crate::chart::{Axis, Plot, curve, number, range_with_zero, robust_top};
use crate::paper_point::Point;
use crate::speed::curve::{self, KEPT};
use crate::speed::{LEFT, SpeedCurves};
use crate::style;
use genga::error::Error;
use genga::motion::JointId;
use genga::signal::{Signals, Turn, TurnKind};

/// Maximum range of a panel relative to the filtered curve's range: the raw curve has spikes beyond it.
const OVER: f64 = 1.6;
/// Seconds for which a value lasts that is no glitch.
const LASTING: f64 = 0.125;

/// Data that all panels share.
pub(super) struct Shared<'a> {
    /// Axis of time, in source frames.
    pub(super) time: Axis,
    /// The right edge of the panels.
    pub(super) right: f64,
    /// X of the layer's keys, in px.
    pub(super) keys: Vec<f64>,
    /// X at which actions begin, in px.
    pub(super) splits: Vec<f64>,
    pub(super) speed: &'a Signals,
    pub(super) filtered: &'a Signals,
    pub(super) curves: SpeedCurves,
}

/// A panel and its place on the paper.
pub(super) struct Panel<'a> {
    pub(super) name: &'a str,
    pub(super) joint: JointId,
    pub(super) turns: &'a [Turn],
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// Whether the frame numbers are written under it.
    pub(super) is_last: bool,
}

/// Points of a curve, its colour and its width.
type Line = (Vec<(f64, f64)>, RGBColor, f64);

/// The curves of a panel, and the factor to the unit for people.
struct Values<'a> {
    raw: &'a [f64],
    filtered: &'a [f64],
    /// Corners of the curve reduced to the keys: (row, value).
    kept: Vec<(usize, f64)>,
    people: f64,
    /// Frame of the first row.
    first: f64,
    /// Least and greatest value that have room, in the unit for people.
    range: (f64, f64),
}

impl Panel<'_> {
    pub(super) fn draw(&self, canvas: &mut Canvas, shared: &Shared<'_>) -> Result<(), Error> {
        let values = self.values(shared);
        for &x in &shared.keys {
            canvas.line((x, self.top), (x, self.bottom), style::GENGA_LINE, 1.0);
        }
        for &x in &shared.splits {
            canvas.dashes((x, self.top), (x, self.bottom), style::INK, 1.25);
        }
        let time = shared.time.clone();
        let plot = Plot {
            from: (LEFT, self.top),
            to: (shared.right, self.bottom),
            x: if self.is_last { time } else { time.written(|_| String::new()) },
            y: Axis::round(values.range, (self.bottom - self.top) / 34.0),
        };
        plot.draw(canvas, |chart| {
            let (from, to) = (values.first, values.first + (values.raw.len() - 1) as f64);
            chart.draw_series(curve([(from, 0.0), (to, 0.0)], style::FAINT, 1.0))?;
            for (points, color, width) in values.curves(shared.curves, |row| plot.at(row, 0.0).0) {
                chart.draw_series(curve(points, color, width))?;
            }
            Ok(())
        })?;
        self.marks(canvas, &plot, &values, shared.curves);
        if shared.curves != SpeedCurves::Measured {
            for (frame, value) in values.cuts() {
                canvas.cut(plot.at(frame, value));
            }
        }
        self.words(canvas, &values, shared);
        Ok(())
    }

    fn values<'a>(&self, shared: &Shared<'a>) -> Values<'a> {
        let (raw, filtered) = (shared.speed.joint(self.joint), shared.filtered.joint(self.joint));
        let kept = curve::kept(raw, self.turns, shared.speed.first);
        let people = shared.speed.unit.for_people();
        let (whole, most) = (shared.robust_range(self.joint), range_with_zero(raw));
        let (least, greatest) = match shared.curves {
            SpeedCurves::Both => {
                (most.0.max(OVER * whole.0).min(whole.0), most.1.min(OVER * whole.1).max(whole.1))
            }
            SpeedCurves::Measured => most,
            SpeedCurves::Filtered => whole,
            SpeedCurves::Kept => {
                let values = kept.iter().map(|corner| corner.1);
                values.fold(whole, |(low, high), value| (low.min(value), high.max(value)))
            }
        };
        // A little space keeps peaks off the name and the edge.
        let range = (least * people * 1.04, greatest * people * 1.08);
        let first = shared.speed.first.0 as f64;
        Values { raw, filtered, kept, people, first, range }
    }

    /// Draws the joint's own keys and walls, on the curve that is shown.
    fn marks(&self, canvas: &mut Canvas, plot: &Plot, values: &Values<'_>, curves: SpeedCurves) {
        let wide = plot.to.0 - plot.from.0;
        let radius = (0.36 * wide / self.turns.len() as f64).clamp(2.0, 4.0);
        let marked = if curves == SpeedCurves::Measured { values.raw } else { values.filtered };
        for turn in self.turns {
            let row = turn.frame.0.checked_sub(values.first as usize);
            if let Some((row, &value)) = row.and_then(|row| Some((row, marked.get(row)?))) {
                let (frame, value) = values.place((row, value));
                mark(canvas, plot.at(frame, value), radius, turn.kind);
            }
        }
    }

    /// Writes the joint's name above the panel and, if curves are cut, how far they go.
    fn words(&self, canvas: &mut Canvas, values: &Values<'_>, shared: &Shared<'_>) {
        let shows = |curve: &str| match shared.curves {
            SpeedCurves::Both => true,
            SpeedCurves::Measured => false,
            SpeedCurves::Filtered | SpeedCurves::Kept => curve == "filtered",
        };
        let curves = [("filtered", values.filtered), ("raw", values.raw)];
        let goes =
            curves.into_iter().filter(|(name, _)| shows(name)).filter_map(|(name, curve)| {
                Some(format!("{name} goes to {}", number(values.beyond(curve)?.round())))
            });
        let goes = goes.collect::<Vec<_>>().join("  ·  ");
        let base = self.top - 6.0;
        let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Right);
        canvas.text(&goes, (shared.right, base), look);
        let title = format!("{} ({})", self.name, shared.speed.unit.symbol());
        let room = shared.right - LEFT - style::text_width(&goes, style::SMALL) - 16.0;
        let title = style::fitted(&title, style::BOLDER * style::WORDS, room);
        canvas.text(&title, (LEFT, base), Type::new(style::WORDS).bold());
    }
}

impl Shared<'_> {
    /// Returns the range of a filtered curve without glitches, 0 included; 0 to 1 if all of it is 0.
    fn robust_range(&self, joint: JointId) -> (f64, f64) {
        let curve = self.filtered.joint(joint);
        let lasting = (LASTING * self.filtered.rate.fps()).ceil() as usize;
        let top = |sign: f64| robust_top(curve.iter().map(|value| sign * value), lasting);
        let (low, high) = (0.0 - top(-1.0), top(1.0));
        if low == high { (0.0, 1.0) } else { (low, high) }
    }

    /// Whether a filtered curve that is shown goes on beyond its panel.
    pub(super) fn is_cut(&self, joint: JointId) -> bool {
        let (whole, shown) =
            (range_with_zero(self.filtered.joint(joint)), self.robust_range(joint));
        self.curves != SpeedCurves::Measured && (whole.0 < shown.0 || whole.1 > shown.1)
    }
}

impl Values<'_> {
    /// Returns frame and value of a row, with the value clamped to the panel.
    fn place(&self, (row, value): (usize, f64)) -> (f64, f64) {
        let (low, high) = self.range;
        (self.first + row as f64, (value * self.people).max(low).min(high))
    }

    /// Returns the greatest value of a curve if it has no room, otherwise the least one if that has none.
    fn beyond(&self, curve: &[f64]) -> Option<f64> {
        let (least, most) = range_with_zero(curve);
        let (least, most) = (least * self.people, most * self.people);
        let above = Some(most).filter(|most| *most > self.range.1);
        above.or(Some(least).filter(|least| *least < self.range.0))
    }

    /// Returns the middle of each stretch of frames for which the filtered curve has no room, and the edge behind which
    /// it is.
    fn cuts(&self) -> Vec<(f64, f64)> {
        let edge = |value: f64| match value * self.people {
            value if value > self.range.1 => Some(self.range.1),
            value if value < self.range.0 => Some(self.range.0),
            _ => None,
        };
        let rows: Vec<(usize, f64)> = self.filtered.iter().copied().enumerate().collect();
        let stretches = rows.chunk_by(|a, b| edge(a.1) == edge(b.1));
        let middle = |stretch: &[(usize, f64)]| {
            let (first, last) = (stretch[0], stretch[stretch.len() - 1]);
            Some((self.first + 0.5 * (first.0 + last.0) as f64, edge(first.1)?))
        };
        stretches.filter_map(middle).collect()
    }

    /// Returns the lines of the curves to show. `px` maps a frame to its x.
    fn curves(&self, curves: SpeedCurves, px: impl Fn(f64) -> f64) -> Vec<Line> {
        let firm = (self.filtered, style::FILTERED, 1.75);
        let whole = match curves {
            SpeedCurves::Both => vec![(self.raw, style::RAW, 1.0), firm],
            SpeedCurves::Measured => vec![(self.raw, style::FAINT, 1.25)],
            SpeedCurves::Filtered | SpeedCurves::Kept => vec![firm],
        };
        let line = |rows: Vec<(usize, f64)>| rows.into_iter().map(|row| self.place(row)).collect();
        let px = |row: usize| px(self.first + row as f64);
        let mut lines = Vec::new();
        for (values, color, width) in whole {
            let runs = curve::runs(values, px).into_iter();
            lines.extend(runs.map(|rows| (line(rows), color, width)));
        }
        if curves == SpeedCurves::Kept {
            lines.push((line(self.kept.clone()), style::GENGA, KEPT));
        }
        lines
    }
}

/// Draws a key or a wall. A white rim sets a mark apart from the curve; small marks stand too close for it.
fn mark(canvas: &mut Canvas, at: Point, radius: f64, kind: TurnKind) {
    match kind {
        TurnKind::Key if radius > 3.0 => canvas.spot(at, radius, style::GENGA),
        TurnKind::Key => canvas.disc(at, radius, style::GENGA),
        TurnKind::Wall => {
            if radius > 3.0 {
                canvas.triangle(at, radius + 2.5, style::PAPER);
            }
            canvas.triangle(at, radius + 1.0, style::WALL);
        }
    }
}
