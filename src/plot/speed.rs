//! The speed of joints over time (速度のグラフ), with their keys and walls [KT11 Figs. 3, 4, 6].

mod curve;
mod legend;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::JointId;
use crate::plot::axis::{Scale, number, range_with_zero};
use crate::plot::canvas::{Align, Canvas, Point, Type};
use crate::plot::style;
use crate::signal::{Signals, Turn, TurnKind};
use crate::time::Frame;

pub use curve::SpeedCurves;

/// Speeds (速度): a panel a joint over one time axis.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpeedPlot {
    /// Width in px, 400 to 20000; default 1200.
    pub width: u32,
    /// Height in px, 300 to 20000; default 900. Many panels in a low picture cannot be read.
    pub height: u32,
    /// Panels at most, 1 or more; default 4. More panels are lower ones.
    pub joints: usize,
    /// Which curves are shown; default both, as measured and after the low pass.
    pub curves: SpeedCurves,
    /// Source frames with which actions (動作) begin, as dashed lines; default none.
    pub splits: Vec<Frame>,
}

impl Default for SpeedPlot {
    fn default() -> Self {
        Self { width: 1200, height: 900, joints: 4, curves: SpeedCurves::Both, splits: Vec::new() }
    }
}

const LEFT: f64 = 64.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = 58.0;
const GAP: f64 = 14.0;
/// How far over the filtered curve a panel reaches for the raw one, which has spikes.
const OVER: f64 = 1.6;
/// Lanes for the numbers of the layer's keys at most.
const LANES: usize = 3;

/// What all panels share.
struct Shared<'a> {
    time: Scale,
    /// The layer's keys in px.
    keys: Vec<f64>,
    /// Where actions part, in px.
    splits: Vec<f64>,
    speed: &'a Signals,
    filtered: &'a Signals,
    curves: SpeedCurves,
}

impl Shared<'_> {
    /// The right edge of the panels.
    fn right(&self) -> f64 {
        let last = self.speed.first.0 + self.speed.frames().max(2) - 1;
        self.time.at(last as f64)
    }
}

/// One panel's place on the paper.
struct Panel<'a> {
    name: &'a str,
    joint: JointId,
    turns: &'a [Turn],
    top: f64,
    bottom: f64,
}

impl SpeedPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn or for no panel.
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
    /// `names` and `turns` have one entry a joint of `speed` and `filtered`; `keys` are the layer's
    /// genga; `order` names the joints to show, the most important first. Values are written in the
    /// unit for people (°/s). Where a px holds several frames, their least and greatest are drawn.
    /// The filtered curve is always whole; beside it spikes of the raw one beyond 1.6 times its range
    /// are cut at the panel's edge, and the panel says how far they go.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`SpeedPlot::validate`]; [`Error::Picture`] when the tables do not
    /// belong together, when there is no frame or when `order` names no joint that there is.
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
        let time = Scale::new((first, first + speed.frames() as f64 - 1.0), (LEFT, right));
        let mut keys: Vec<f64> = keys.iter().map(|key| time.at(key.0 as f64)).collect();
        keys.retain(|x| (LEFT..=right).contains(x));
        let splits = self.splits.iter().map(|split| time.at(split.0 as f64));
        let splits: Vec<f64> = splits.filter(|x| (LEFT..=right).contains(x)).collect();
        let lanes = style::lanes(&keys, 2.0 * style::BADGE + 1.0, LANES);
        let used = lanes.iter().flatten().max().map_or(0.0, |lane| *lane as f64 + 1.0);
        let top = TOP + 2.0 * style::BADGE * used;
        let bottom = height - BOTTOM;
        let step = (bottom - top + GAP) / shown.len() as f64;
        let shared = Shared { time, keys, splits, speed, filtered, curves: self.curves };
        let turns_shown: Vec<&Turn> = shown.iter().flat_map(|joint| &turns[joint.0]).collect();
        let has = (!shared.keys.is_empty(), !shared.splits.is_empty());
        let legend = legend::of(self.curves, &turns_shown, has);
        let panels = shown.iter().enumerate().map(|(row, &joint)| Panel {
            name: names[joint.0],
            joint,
            turns: &turns[joint.0],
            top: top + step * row as f64,
            bottom: top + step * (row + 1) as f64 - GAP,
        });
        let mut canvas = Canvas::new((f64::from(self.width), f64::from(self.height)));
        legend::head(&mut canvas, width, &legend);
        time_axis(&mut canvas, &shared, (top, bottom));
        for panel in panels {
            panel.draw(&mut canvas, &shared);
        }
        numbers(&mut canvas, &shared.keys, &lanes, top);
        Ok(canvas.finish())
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

/// Source frames on the upper line under the panels, seconds on the lower.
fn time_axis(canvas: &mut Canvas, shared: &Shared<'_>, (top, bottom): (f64, f64)) {
    let fps = shared.speed.rate.fps();
    let look = Type::new(style::SMALL).align(Align::Center);
    for frame in shared.time.ticks(64.0) {
        let x = shared.time.at(frame);
        canvas.line((x, top), (x, bottom), style::GRID, 1.0);
        canvas.text(&number(frame), (x, bottom + 17.0), look);
    }
    let first = shared.speed.first.0 as f64;
    let last = first + (shared.speed.frames() - 1) as f64;
    let seconds =
        Scale::new((first / fps, last / fps), (shared.time.at(first), shared.time.at(last)));
    for second in seconds.ticks(90.0) {
        let x = shared.time.at(second * fps);
        canvas.line((x, bottom + 25.0), (x, bottom + 30.0), style::FAINT, 1.0);
        canvas.text(&number(second), (x, bottom + 42.0), look.color(style::FAINT));
    }
    let words = Type::new(style::SMALL).align(Align::Right);
    canvas.text("frame", (LEFT - 18.0, bottom + 17.0), words);
    canvas.text("s 秒", (LEFT - 18.0, bottom + 42.0), words.color(style::FAINT));
}

/// The numbers of the layer's keys above the panels; where they would lie on each other only as many
/// as there is room for.
fn numbers(canvas: &mut Canvas, keys: &[f64], lanes: &[Option<usize>], top: f64) {
    for (at, (&x, lane)) in keys.iter().zip(lanes).enumerate() {
        let Some(lane) = *lane else { continue };
        let y = top - style::BADGE - 3.0 - 2.0 * style::BADGE * lane as f64;
        canvas.line((x, y + style::BADGE), (x, top), style::GENGA_LINE, 1.0);
        canvas.badge((x, y), at + 1, style::GENGA, false);
    }
}

impl Panel<'_> {
    fn draw(&self, canvas: &mut Canvas, shared: &Shared<'_>) {
        let unit = shared.speed.unit;
        let raw = shared.speed.joint(self.joint);
        let filtered = shared.filtered.joint(self.joint);
        let kept = curve::kept(raw, self.turns, shared.speed.first);
        let people = unit.for_people();
        let (whole, most) = (range_with_zero(filtered), range_with_zero(raw));
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
        // A little air, so that no peak touches the name or the edge.
        let (low, high) = (least * people * 1.04, greatest * people * 1.08);
        let values = Scale::new((low, high), (self.bottom, self.top));
        self.value_axis(canvas, shared, &values);
        for &x in &shared.keys {
            canvas.line((x, self.top), (x, self.bottom), style::GENGA_LINE, 1.0);
        }
        for &x in &shared.splits {
            canvas.dashes((x, self.top), (x, self.bottom), style::INK, 1.25);
        }
        let place = |at: usize, value: f64| {
            let y = values.at(value * people).clamp(self.top, self.bottom);
            (shared.time.at((shared.speed.first.0 + at) as f64), y)
        };
        let faint = (raw, style::RAW, 1.0);
        let firm = (filtered, style::FILTERED, 1.75);
        let curves = match shared.curves {
            SpeedCurves::Both => vec![faint, firm],
            SpeedCurves::Measured => vec![(raw, style::FAINT, 1.25)],
            SpeedCurves::Filtered | SpeedCurves::Kept => vec![firm],
        };
        for (curve, color, width) in curves {
            for run in curve::runs(curve, place) {
                canvas.path(&run, color, width);
            }
        }
        if shared.curves == SpeedCurves::Kept {
            let corners: Vec<Point> = kept.iter().map(|(row, value)| place(*row, *value)).collect();
            canvas.path(&corners, style::GENGA, curve::KEPT);
        }
        let right = shared.right();
        let radius = (0.36 * (right - LEFT) / self.turns.len() as f64).clamp(2.0, 4.0);
        let marked = if shared.curves == SpeedCurves::Measured { raw } else { filtered };
        for turn in self.turns {
            let at = turn.frame.0.checked_sub(shared.speed.first.0);
            let Some((at, &value)) = at.and_then(|at| Some((at, marked.get(at)?))) else {
                continue;
            };
            mark(canvas, place(at, value), radius, turn.kind);
        }
        let is_cut = most.1 * people > high || most.0 * people < low;
        if shared.curves == SpeedCurves::Both && is_cut {
            let beyond = if most.1 * people > high { most.1 } else { most.0 };
            let look = Type::new(style::SMALL).color(style::FAINT).align(Align::Right);
            let text = format!("raw goes to {}", number((beyond * people).round()));
            self.words(canvas, &text, right - 4.0, look);
        }
        let title = format!("{} ({})", self.name, unit.symbol());
        let title = style::fitted(&title, style::WORDS, 400.0);
        self.words(canvas, &title, LEFT + 6.0, Type::new(style::WORDS).bold());
    }

    /// Words at the panel's upper edge, on white.
    fn words(&self, canvas: &mut Canvas, text: &str, x: f64, look: Type) {
        let wide = style::text_width(text, look.size) + 4.0;
        let left = if look.align == Align::Right { x - wide } else { x - 4.0 };
        let corner = (left + wide + 4.0, self.top + 20.0);
        canvas.rect((left, self.top), corner, style::PAPER);
        canvas.text(text, (x, self.top + 15.0), look);
    }

    fn value_axis(&self, canvas: &mut Canvas, shared: &Shared<'_>, values: &Scale) {
        let right = shared.right();
        let look = Type::new(style::SMALL).align(Align::Right);
        for value in values.ticks(34.0) {
            let y = values.at(value);
            let color = if value == 0.0 { style::FAINT } else { style::GRID };
            canvas.line((LEFT, y), (right, y), color, 1.0);
            canvas.text(&number(value), (LEFT - 7.0, y + 4.0), look);
        }
        canvas.line((LEFT, self.top), (LEFT, self.bottom), style::FAINT, 1.0);
    }
}

fn mark(canvas: &mut Canvas, (x, y): Point, radius: f64, kind: TurnKind) {
    // A white rim keeps a mark apart from the curve; small ones stand too close for it.
    let rim = radius > 3.0;
    match kind {
        TurnKind::Key => {
            if rim {
                canvas.disc((x, y), radius + 1.0, style::PAPER);
            }
            canvas.disc((x, y), radius, style::GENGA)
        }
        TurnKind::Wall => {
            if rim {
                canvas.triangle((x, y), radius + 2.5, style::PAPER);
            }
            canvas.triangle((x, y), radius + 1.0, style::WALL)
        }
    }
}
