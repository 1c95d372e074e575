//! Plots the counts of a study as curves [KT11 Table 1].

mod legend;
mod lines;
mod paper;

use serde::{Deserialize, Serialize};

use crate::canvas::{Canvas, Type};
use crate::chart::{self, Plot, curve, range_with_zero};
use crate::study_chart::legend::{Behind, Legend};
use crate::study_chart::lines::Places;
use crate::study_chart::paper::Mark;
use crate::style;
use crate::title::Title;
use genga::error::Error;
use genga_lab::study::{Axis, Grid, Measure, Spread, spreads};

/// The curves of a study (設定と原画の数): a measure against the first setting, one line per value of the second.
///
/// The line of several clips is their median. Behind it, up to three clips have a thin line each; more have a
/// band between their quartiles.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StudyPlot {
    /// Width in px, 400 to 20000; default 900.
    pub width: u32,
    /// Height in px, 300 to 20000; default 560.
    pub height: u32,
    /// Measure to draw; default turns of the body.
    pub show: Measure,
    /// Whether a count is drawn per second of its sheet, so that clips of different lengths compare; default
    /// no.
    pub per_second: bool,
    /// Whether the six values of the paper are added as hollow marks; default no. They come from another
    /// clip.
    pub paper: bool,
}

impl Default for StudyPlot {
    fn default() -> Self {
        Self { width: 900, height: 560, show: Measure::Turns, per_second: false, paper: false }
    }
}

/// Maximum number of clips with lines of their own; more become a band.
const FEW_CLIPS: usize = 3;

const LEFT: f64 = 84.0;
const TOP: f64 = 80.0;
const BOTTOM: f64 = 62.0;

impl StudyPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn. It is named `per_second` if that is asked of a measure
    /// that is not a count, or beside the paper's marks, which are counts of a whole clip.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)?;
        check_per_second(self.show, self.per_second)?;
        if self.per_second && self.paper {
            let message = "the paper's counts are of a whole clip; leave out one of the two";
            return Err(Error::setting("per_second", message));
        }
        Ok(())
    }

    /// Checks the settings, and that they suit the axes of a study. Call it before running the study.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`StudyPlot::validate`], and named `paper` if the paper's marks are asked for
    /// and the axes are not the paper's.
    pub fn fits(&self, x: &Axis, y: Option<&Axis>) -> Result<(), Error> {
        self.validate()?;
        if self.paper { paper::persistences(x, y).map(drop) } else { Ok(()) }
    }

    /// Draws the study of some clips as SVG. `clips` are the names of the clips; all grids are of one study.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`StudyPlot::fits`]; [`Error::Picture`] if there is no clip or the measure
    /// was not counted.
    pub fn draw(&self, clips: &[String], grids: &[Grid]) -> Result<String, Error> {
        self.validate()?;
        let Some(grid) = grids.first() else {
            return Err(style::cannot("a study without a clip has nothing to draw"));
        };
        let marks = if self.paper { paper::marks(grid)? } else { vec![] };
        let spreads = shown(grids, self.show, self.per_second)?;
        let at = Places::from_axis(&grid.x);
        let behind = self.behind(grids, &spreads, &at)?;
        let legend = Legend::new(grid, grids.len(), self.paper);
        let values = spreads.iter().map(|spread| spread.median).chain(behind.values());
        let plot = self.plot(&at, values.collect(), &marks, legend.width());
        let mut canvas = Canvas::new((f64::from(self.width), f64::from(self.height)));
        let (title, value) =
            (headline(self.show, self.per_second), unit(self.show, self.per_second));
        let width = f64::from(self.width);
        Title { words: &title, clips: &named(clips), legend: &[], width }.draw(&mut canvas);
        let middle = (style::MARGIN + 8.0, 0.5 * (plot.from.1 + plot.to.1));
        // The title says it already where it is longer than the axis.
        let named = format!("{title} ({value})");
        let is_short = style::text_width(&named, style::WORDS) <= (plot.to.1 - plot.from.1).abs();
        let named = if is_short { named } else { value.to_owned() };
        canvas.text_upwards(&named, middle, Type::new(style::WORDS));
        behind.veils(&mut canvas, &plot, &legend.looks);
        let medians = at.lines(spreads.iter().map(|spread| spread.median).collect());
        plot.draw(&mut canvas, |chart| {
            for (line, look) in behind.lines().zip(legend.looks.iter().cycle()) {
                let faded = style::mixed(look.color, style::PAPER, 0.6);
                chart.draw_series(curve(line.iter().copied(), faded, 1.0))?;
            }
            for (line, look) in medians.iter().zip(&legend.looks) {
                chart.draw_series(curve(line.iter().copied(), look.color, 2.0))?;
            }
            Ok(())
        })?;
        for mark in &marks {
            let color = mark.line.map_or(style::FAINT, |y| legend.looks[y].color);
            canvas.ring(plot.at(mark.at.0, mark.at.1), 6.5, color, 1.75);
        }
        let radius = if at.numbers.len() > 30 { 2.5 } else { 4.0 };
        for (line, look) in medians.iter().zip(&legend.looks) {
            let points = line.iter().map(|(number, value)| plot.at(*number, *value));
            points.for_each(|point| look.mark(&mut canvas, point, radius));
        }
        legend.draw(&mut canvas, (plot.to.0 + 24.0, TOP + 12.0));
        Ok(canvas.finish())
    }

    /// Builds the lines or bands behind the medians of several clips.
    fn behind(&self, grids: &[Grid], spreads: &[Spread], at: &Places) -> Result<Behind, Error> {
        let alone = |grid| -> Result<_, Error> {
            let own = shown(std::slice::from_ref(grid), self.show, self.per_second)?;
            Ok(at.lines(own.iter().map(|spread| spread.median).collect()))
        };
        let of = |value: fn(&Spread) -> f64| at.lines(spreads.iter().map(value).collect());
        Ok(match grids.len() {
            0 | 1 => Behind::Nothing,
            2..=FEW_CLIPS => {
                let clips: Vec<_> = grids.iter().map(alone).collect::<Result<_, _>>()?;
                Behind::Clips(clips.concat())
            }
            _ => Behind::Bands(of(|spread| spread.low), of(|spread| spread.high)),
        })
    }

    fn plot(&self, at: &Places, mut values: Vec<f64>, marks: &[Mark], legend: f64) -> Plot {
        let to = (f64::from(self.width) - legend, f64::from(self.height) - BOTTOM);
        let numbers = at.numbers.iter().copied().chain(marks.iter().map(|mark| mark.at.0));
        values.extend(marks.iter().map(|mark| mark.at.1));
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
}

/// Refuses `per_second` for a measure that does not grow with the length of a clip.
pub(super) fn check_per_second(show: Measure, per_second: bool) -> Result<(), Error> {
    if per_second && !show.is_count() {
        let message = format!("{show} does not grow with the length of a clip; draw it as it is");
        return Err(Error::setting("per_second", message));
    }
    Ok(())
}

/// Returns the spread of the drawn measure over the clips.
pub(super) fn shown(grids: &[Grid], show: Measure, per_second: bool) -> Result<Vec<Spread>, Error> {
    spreads(grids, show, per_second).ok_or_else(|| style::cannot(format!("{show} was not counted")))
}

/// Returns the label of an axis: its name, its unit, its Japanese name.
pub(super) fn name(axis: &Axis) -> String {
    format!("{}  {}", with_unit(axis), axis.knob().japanese)
}

/// Returns the name and the unit of an axis.
fn with_unit(axis: &Axis) -> String {
    // The words after a comma say more than a picture needs.
    let own = axis.knob().unit.split(',').next().unwrap_or_default();
    let unit = match (axis.scale().map_or("", |(_, unit)| unit), own) {
        ("s", _) => " (seconds)".to_owned(),
        ("%", _) => " (%)".to_owned(),
        (_, "source frames or seconds") if axis.scale().is_some() => " (source frames)".to_owned(),
        (_, "") => String::new(),
        (_, own) => format!(" ({own})"),
    };
    format!("{}{unit}", axis.name())
}

/// Returns the names of clips; several are preceded by their number.
pub(super) fn named(clips: &[String]) -> String {
    match clips {
        [only] => only.clone(),
        _ => format!("{} clips: {}", clips.len(), clips.join(", ")),
    }
}

/// Returns the measure's name in both languages.
pub(super) fn headline(show: Measure, per_second: bool) -> String {
    let (english, japanese) = show.words();
    let mut letters = english.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string());
    let (second, every) = if per_second { (" a second", "毎秒の") } else { ("", "") };
    format!("{}{}{second}  {every}{japanese}", first.unwrap_or_default(), letters.as_str())
}

/// Returns the unit of the values.
pub(super) fn unit(show: Measure, per_second: bool) -> String {
    match (show.unit(), per_second) {
        ("", false) => "number".to_owned(),
        ("", true) => "1/s".to_owned(),
        (unit, false) => unit.to_owned(),
        (unit, true) => format!("{unit}/s"),
    }
}

/// Returns the range of some numbers, padded at both ends.
fn padded(numbers: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = numbers.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), number| {
        (low.min(number), high.max(number))
    });
    let air = if high > low { 0.05 * (high - low) } else { 1.0 };
    (low - air, high + air)
}
