//! Plots the spacing of one interval (詰め) [KT11 Figs. 7 to 10]: the even places of inbetweens, the places in
//! the source they are taken from, and how far along the way those are.

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Type};
use crate::chart::{Axis, Plot, curve, range_with_zero};
use crate::drawings::{shown, shown_drawings};
use crate::legend::{self, Entry};
use crate::paper_point::Point;
use crate::style;
use genga::error::Error;
use genga::motion::{Clip, JointId};
use genga::sheet::Sheet;
use genga::signal::Signals;
use genga::time::Frame;
use genga::timing::Gauge;

/// The spacing (詰め) from one genga to the next, one row per sheet, so that two ways of spacing can be
/// compared.
///
/// A row has two lines. The source line shows each inbetween at the place it is taken from, with an arrow
/// from its even place (均等割り). The way line shows each drawing where the joint that travels furthest is on
/// its path. Drawings close together mean slow movement.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpacingPlot {
    /// Width in px, 400 to 20000; default 760.
    pub width: u32,
    /// Number of the genga or end with which the interval begins, 1 or more; default 1.
    pub genga: usize,
}

impl Default for SpacingPlot {
    fn default() -> Self {
        Self { width: 760, genga: 1 }
    }
}

const LEFT: f64 = 108.0;
const RIGHT: f64 = 44.0;
const TOP: f64 = 70.0;
/// Heights of the speed panel, of the frame axis below it, and of a row with its two lines, in px.
const SPEEDS: f64 = 130.0;
const AXIS: f64 = 34.0;
const ROW: f64 = 112.0;
/// Offsets from a row's top to its name, its source line and its way line, in px.
const NAME: f64 = 18.0;
const SOURCE: f64 = 46.0;
const WAY: f64 = 84.0;
const BALL: f64 = 9.0;

/// A drawing of the interval.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stand {
    /// Place in the source it is taken from, a fractional frame.
    place: f64,
    /// Place in the source that even spacing gives.
    even: f64,
    /// Share of the way, 0 to 1; `None` if nothing moves.
    way: Option<f64>,
}

/// One spacing of the interval; its first and last drawing are the two genga.
struct Row<'a> {
    name: &'a str,
    stands: Vec<Stand>,
}

impl SpacingPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the width cannot be drawn or `genga` is 0.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        if self.genga == 0 {
            return Err(Error::setting("genga", "genga and ends are numbered from 1"));
        }
        Ok(())
    }

    /// Draws the interval as SVG, one row per sheet of the clip under the sheet's name. If a speed is given,
    /// a panel above the rows shows that joint's speed. The layer's walls (壁) are marked.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`SpacingPlot::validate`], and if a sheet has no interval of that number;
    /// [`Error::Sheet`] or [`Error::Picture`] if there is no sheet, or if clip, sheet or speed have nothing
    /// to show.
    pub fn draw(
        &self,
        clip: &Clip,
        sheets: &[(&str, &Sheet)],
        speed: Option<(&Signals, JointId)>,
        walls: &[Frame],
    ) -> Result<String, Error> {
        self.validate()?;
        let rows = sheets.iter().map(|(name, sheet)| self.row(clip, name, sheet));
        let rows = rows.collect::<Result<Vec<_>, Error>>()?;
        if rows.is_empty() {
            return Err(style::cannot("no sheet, no spacing to draw"));
        }
        if let Some((speed, joint)) = speed
            && (speed.frames() == 0 || joint.0 >= speed.joints())
        {
            return Err(style::cannot("there is no such joint or no frame in the speeds"));
        }
        let right = f64::from(self.width) - RIGHT;
        let places = rows.iter().flat_map(|row| row.stands.iter().map(|stand| stand.place));
        let range = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place), high.max(place))
        });
        let time = Axis::round(range, (right - LEFT) / 64.0).plain();
        let inside = |wall: &&Frame| (range.0..=range.1).contains(&(wall.0 as f64));
        let walls: Vec<f64> = walls.iter().filter(inside).map(|wall| wall.0 as f64).collect();
        let begin = TOP + if speed.is_some() { SPEEDS + AXIS } else { 0.0 };
        let height = begin + ROW * rows.len() as f64 + 10.0;
        let mut canvas = Canvas::new((f64::from(self.width), height));
        head(&mut canvas, right, !walls.is_empty());
        if let Some((speed, joint)) = speed {
            speeds(&mut canvas, (speed, joint), (range, &time), right, &walls)?;
        }
        for (at, row) in rows.iter().enumerate() {
            let top = begin + ROW * at as f64;
            for wall in &walls {
                let (x, y) = (time.at(*wall, (LEFT, right)), top + SOURCE);
                canvas.line((x, y - 17.0), (x, y + 17.0), style::WALL, 1.0);
            }
            row.draw(&mut canvas, &time, (top, right));
        }
        Ok(canvas.finish())
    }

    fn row<'a>(&self, clip: &Clip, name: &'a str, sheet: &Sheet) -> Result<Row<'a>, Error> {
        let layer = shown(clip, sheet)?;
        let cells = shown_drawings(layer);
        let kept: Vec<usize> = (0..cells.len()).filter(|at| cells[*at].genga.is_some()).collect();
        let Some(&[from, to]) = kept.windows(2).nth(self.genga - 1) else {
            let message = format!(
                "{} begins no interval: the sheet has {} genga and ends",
                self.genga,
                kept.len()
            );
            return Err(Error::setting("genga", message));
        };
        let gauge = Gauge::from_layer(clip, layer).into_iter().find(|gauge| gauge.first == from);
        let place = |at: usize| cells[at].drawing.source.place();
        let (begin, koma) = (cells[from].koma, (cells[to].koma - cells[from].koma) as f64);
        let stand = |at: usize| Stand {
            place: place(at),
            even: place(from) + (cells[at].koma - begin) as f64 / koma * (place(to) - place(from)),
            way: gauge.as_ref().map(|gauge| gauge.shares[at - from]),
        };
        Ok(Row { name, stands: (from..=to).map(stand).collect() })
    }
}

/// Draws the title and, on its right, the legend.
fn head(canvas: &mut Canvas, right: f64, has_wall: bool) {
    canvas.text("Spacing 詰め", (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
    let mut entries: Vec<Entry> = vec![
        ("genga 原画", |canvas, at| canvas.disc(at, 6.0, style::GENGA)),
        ("inbetween 中割り", |canvas, at| canvas.disc(at, 6.0, style::INBETWEEN)),
        ("even place 均等割り", |canvas, at| canvas.ring(at, 4.0, style::INBETWEEN, 1.25)),
    ];
    if has_wall {
        entries.push(("wall 壁", |canvas, at| canvas.triangle(at, 5.5, style::WALL)));
    }
    legend::draw(canvas, (right - legend::width(&entries), 34.0), &entries);
}

/// Draws the joint's speed over the interval with its walls, and the frames below.
fn speeds(
    canvas: &mut Canvas,
    (speed, joint): (&Signals, JointId),
    ((from, to), time): ((f64, f64), &Axis),
    right: f64,
    walls: &[f64],
) -> Result<(), Error> {
    let (people, first) = (speed.unit.for_people(), speed.first.0 as f64);
    let points: Vec<(f64, f64)> = speed
        .joint(joint)
        .iter()
        .enumerate()
        .map(|(row, value)| (first + row as f64, value * people))
        .filter(|(frame, value)| (from..=to).contains(frame) && value.is_finite())
        .collect();
    let (low, high) = range_with_zero(&points.iter().map(|point| point.1).collect::<Vec<_>>());
    let bottom = TOP + SPEEDS;
    let y = Axis::round((1.08 * low, 1.08 * high), SPEEDS / 34.0);
    let plot = Plot { from: (LEFT, TOP), to: (right, bottom), x: time.clone(), y };
    plot.draw(canvas, |chart| {
        chart.draw_series(curve(points.iter().copied(), style::FILTERED, 1.75)).map(drop)
    })?;
    for &wall in walls {
        canvas.line(plot.at(wall, 1.08 * low), plot.at(wall, 1.08 * high), style::WALL, 1.0);
        if let Some(&(frame, value)) = points.iter().find(|point| point.0 >= wall) {
            canvas.triangle(plot.at(frame, value), 6.0, style::WALL);
        }
    }
    let look = Type::new(style::SMALL);
    let words = format!("speed 速度 ({})", speed.unit.symbol());
    canvas.text(&words, (LEFT, TOP - 7.0), look.bold());
    canvas.text("frame", (LEFT - 18.0, bottom + 17.0), look.align(Align::Right));
    Ok(())
}

impl Row<'_> {
    fn draw(&self, canvas: &mut Canvas, time: &Axis, (top, right): (f64, f64)) {
        let px = |place: f64| time.at(place, (LEFT, right));
        let way = |share: f64| LEFT + share * (right - LEFT);
        let words = style::fitted(self.name, style::WORDS, right - style::MARGIN);
        canvas.text(&words, (style::MARGIN, top + NAME), Type::new(style::WORDS).bold());
        let look = Type::new(style::SMALL).color(style::FAINT);
        for (word, y) in [("source 素材", top + SOURCE), ("way 移動", top + WAY)] {
            canvas.text(word, (style::MARGIN, y + 4.0), look);
            canvas.line((LEFT, y), (right, y), style::RAW, 1.0);
        }
        let last = self.stands.len() - 1;
        for (at, stand) in self.stands.iter().enumerate().filter(|(at, _)| *at > 0 && *at < last) {
            let y = top + SOURCE;
            let (even, x) = (px(stand.even), px(stand.place));
            canvas.ring((even, y), 4.0, style::INBETWEEN, 1.25);
            arrow(canvas, (even, x), y);
            ball(canvas, (x, y), at, style::INBETWEEN);
        }
        for (at, stand) in self.stands.iter().enumerate() {
            let is_genga = at == 0 || at == last;
            let color = if is_genga { style::GENGA } else { style::INBETWEEN };
            if is_genga {
                ball(canvas, (px(stand.place), top + SOURCE), at, color);
            }
            if let Some(share) = stand.way {
                ball(canvas, (way(share), top + WAY), at, color);
            }
        }
        for (at, letter) in [(0, "A"), (last, "B")] {
            let look = Type::new(style::SMALL).bold().color(style::PAPER).align(Align::Center);
            let x = px(self.stands[at].place);
            canvas.text(letter, (x, top + SOURCE + 4.0), look);
            if let Some(share) = self.stands[at].way {
                canvas.text(letter, (way(share), top + WAY + 4.0), look);
            }
        }
    }
}

/// Draws a ball for a drawing; inbetweens carry their number, from 1.
fn ball(canvas: &mut Canvas, (x, y): Point, number: usize, color: RGBColor) {
    canvas.spot((x, y), BALL, color);
    if color == style::GENGA {
        return;
    }
    let look = Type::new(style::SMALL).bold().align(Align::Center);
    canvas.text(&number.to_string(), (x, y + 4.0), look);
}

/// Draws an arrow from an even place to the edge of the inbetween's ball, if there is room for one.
fn arrow(canvas: &mut Canvas, (from, to): (f64, f64), y: f64) {
    let way = (to - from).signum();
    let (begin, end) = (from + 5.0 * way, to - (BALL + 2.0) * way);
    if (end - begin) * way < 6.0 {
        return;
    }
    canvas.line((begin, y), (end, y), style::FAINT, 1.25);
    let back = end - 6.0 * way;
    canvas.area(&[(end, y), (back, y - 3.5), (back, y + 3.5)], style::FAINT);
}
