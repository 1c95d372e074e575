//! Plots the speed of joints over time (速度のグラフ), with their keys and walls [KT11 Figs. 3, 4, 6].

mod curve;
mod legend;
mod panel;

use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Type};
use crate::chart::{Axis, Plot};
use crate::speed::panel::{Panel, Shared};
use crate::style;
use crate::title::Title;
use genga::error::Error;
use genga::motion::JointId;
use genga::sheet::Number;
use genga::signal::{Signals, Turn};
use genga::time::Frame;

pub use curve::SpeedCurves;

/// Speeds (速度): one panel per joint, over a common time axis.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedPlot {
    /// Name of the clip, below the title; default empty, not shown.
    pub clip: String,
    /// Width in px, 400 to 20000; default 960.
    pub width: u32,
    /// Height in px, 300 to 20000; default 900. Many panels in a low picture are illegible.
    pub height: u32,
    /// Maximum number of panels, 1 or more; default 4. More panels are lower.
    pub joints: usize,
    /// Curves to show; default both, as measured and after the low pass.
    pub curves: SpeedCurves,
    /// Source frames on which actions (動作) begin, shown as dashed lines; default none.
    pub splits: Vec<Frame>,
    /// Numbers of the layer's keys; default none: 1, 2, 3 ….
    pub numbers: Vec<Number>,
}

impl Default for SpeedPlot {
    fn default() -> Self {
        Self {
            clip: String::new(),
            width: style::WIDTH,
            height: 900,
            joints: 4,
            curves: SpeedCurves::Both,
            splits: Vec::new(),
            numbers: Vec::new(),
        }
    }
}

const LEFT: f64 = 64.0;
/// Space between the head and the first numbers, in px.
const ABOVE: f64 = 14.0;
const BOTTOM: f64 = 58.0;
/// Height of the line above each panel with the joint's name, in px.
const NAME: f64 = 20.0;
const GAP: f64 = 10.0;
/// Maximum number of lanes for the numbers of the layer's keys.
const LANES: usize = 3;

impl SpeedPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn or `joints` is 0.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)?;
        if self.joints == 0 {
            return Err(Error::setting("joints", "0 panels show nothing; it must be 1 or more"));
        }
        Ok(())
    }

    /// Draws the speeds as SVG.
    ///
    /// `names` and `turns` have one entry per joint of `speed` and `filtered`. `keys` are the layer's genga.
    /// `order` lists the joints to show, the most important first.
    ///
    /// Values are written in the unit for people (°/s). If several frames share a px, their least and
    /// greatest value are drawn. A glitch of the filtered curve, beyond twice what the curve reaches for a fiftieth
    /// of the time, is cut at the panel's edge under a sign. So are spikes of the raw curve beyond 1.6 times the
    /// filtered range, without a sign. The words over the panel say how far both go.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`SpeedPlot::validate`]; [`Error::Picture`] if the tables do not belong
    /// together, if there is no frame, or if `order` is empty or names a joint that does not exist.
    pub fn draw(
        &self,
        names: &[&str],
        speed: &Signals,
        filtered: &Signals,
        turns: &[Vec<Turn>],
        keys: &[Frame],
        order: &[JointId],
    ) -> Result<String, Error> {
        self.validate()?;
        check(names, speed, filtered, turns, order)?;
        let shown = &order[..order.len().min(self.joints)];
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let right = width - style::MARGIN;
        let first = speed.first.0 as f64;
        let last = first + (speed.frames() - 1) as f64;
        let time = Axis::round((first, last), (right - LEFT) / 64.0);
        let px = |frames: &[Frame]| -> Vec<f64> {
            let px = frames.iter().map(|frame| time.at(frame.0 as f64, (LEFT, right)));
            px.filter(|x| (LEFT..=right).contains(x)).collect()
        };
        let (keys, splits) = (px(keys), px(&self.splits));
        let reach = |at: usize| style::badge_reach(&self.number(at).to_string()) + 0.5;
        let marks = keys.iter().enumerate().map(|(at, x)| (*x, reach(at)));
        let lanes = style::lanes(marks, LANES);
        let used = lanes.iter().flatten().max().map_or(0.0, |lane| *lane as f64 + 1.0);
        let shared = Shared { time, right, keys, splits, speed, filtered, curves: self.curves };
        let turns_shown: Vec<&Turn> = shown.iter().flat_map(|joint| &turns[joint.0]).collect();
        let has = legend::Has {
            genga: !shared.keys.is_empty(),
            splits: !shared.splits.is_empty(),
            cuts: shown.iter().any(|joint| shared.is_cut(*joint)),
        };
        let entries = legend::entries(self.curves, &turns_shown, has);
        let title = Title { words: "Speed 速度", clips: &self.clip, legend: &entries, width };
        let top = title.height() + ABOVE + 2.0 * style::BADGE * used;
        let bottom = height - BOTTOM;
        let step = (bottom - top + GAP) / shown.len() as f64;
        let panels = shown.iter().enumerate().map(|(row, &joint)| Panel {
            name: names[joint.0],
            joint,
            turns: &turns[joint.0],
            top: top + step * row as f64 + NAME,
            bottom: top + step * (row + 1) as f64 - GAP,
            is_last: row + 1 == shown.len(),
        });
        let mut canvas = Canvas::new((width, height));
        title.draw(&mut canvas);
        for panel in panels {
            panel.draw(&mut canvas, &shared)?;
        }
        let fps = speed.rate.fps();
        seconds(&mut canvas, (first / fps, last / fps), (right, bottom))?;
        self.write_numbers(&mut canvas, &shared.keys, &lanes, top);
        Ok(canvas.finish())
    }

    /// Draws the numbers of the layer's keys above the panels. Numbers without a free lane are left out.
    fn write_numbers(&self, canvas: &mut Canvas, keys: &[f64], lanes: &[Option<usize>], top: f64) {
        for (at, (&x, lane)) in keys.iter().zip(lanes).enumerate() {
            let Some(lane) = *lane else { continue };
            let y = top - style::BADGE - 3.0 - 2.0 * style::BADGE * lane as f64;
            // The first panel's name is left free.
            canvas.line((x, y + style::BADGE), (x, top + 2.0), style::GENGA_LINE, 1.0);
            canvas.badge((x, y), &self.number(at).to_string(), style::GENGA, false);
        }
    }

    /// Returns the number of a key of the layer.
    fn number(&self, at: usize) -> Number {
        self.numbers.get(at).cloned().unwrap_or_else(|| (at + 1).into())
    }
}

fn check(
    names: &[&str],
    speed: &Signals,
    filtered: &Signals,
    turns: &[Vec<Turn>],
    order: &[JointId],
) -> Result<(), Error> {
    let joints = speed.joints();
    if filtered.values.shape() != speed.values.shape() {
        return Err(style::cannot("raw and filtered speed differ in frames or joints"));
    }
    if names.len() != joints || turns.len() != joints {
        let message = format!(
            "{joints} joints, but {} names and {} lists of turns",
            names.len(),
            turns.len()
        );
        return Err(style::cannot(message));
    }
    if speed.frames() == 0 {
        return Err(style::cannot("a clip without frames has no speed to draw"));
    }
    if order.is_empty() {
        return Err(style::cannot("no joint to show"));
    }
    match order.iter().find(|joint| joint.0 >= joints) {
        Some(joint) => {
            Err(style::cannot(format!("joint {} of {joints}: there is no such joint", joint.0)))
        }
        None => Ok(()),
    }
}

/// Draws the axis of seconds below the frames, and the names of both axes.
fn seconds(
    canvas: &mut Canvas,
    seconds: (f64, f64),
    (right, bottom): (f64, f64),
) -> Result<(), Error> {
    let axis = Axis::round(seconds, (right - LEFT) / 90.0);
    Plot::ruler((LEFT, right), bottom + 26.0, axis).draw(canvas, |_| Ok(()))?;
    let look = Type::new(style::SMALL).align(Align::Right);
    canvas.text("frame", (LEFT - 18.0, bottom + 17.0), look);
    canvas.text("s 秒", (LEFT - 18.0, bottom + 43.0), look);
    Ok(())
}
