//! Plots how far the body moves into each koma, before and after omission [KKMFT Figs. 1, 2, 8].

use plotters::element::Rectangle;
use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::canvas::{Align, Canvas, Type};
use crate::chart::{Axis, Plot, bar, number};
use crate::drawings::shown;
use crate::legend::{Entry, LEFT_OUT};
use crate::paper_point::Point;
use crate::sheet::fate::{BY_HAND, Fate, fates, held_by_hand};
use crate::style;
use crate::title::Title;
use genga::error::Error;
use genga::motion::{Clip, Screen, SeenFrom};
use genga::sheet::{Drawing, Exposure, Layer, Sheet};
use genga::timing::Stills;

/// The movement into each koma (動きの大きさ). Above stands a bar for each koma of the source, with a sign under it
/// for what omission did there. Below stands a bar for each koma of the result, except while a drawing is
/// held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SsdPlot {
    /// Width in px, 400 to 20000; default 960. A long clip has thin bars.
    pub width: u32,
    /// Height in px, 300 to 20000; default 480.
    pub height: u32,
    /// Camera in which movement is measured; default: world space.
    pub seen_from: SeenFrom,
}

impl Default for SsdPlot {
    fn default() -> Self {
        Self { width: style::WIDTH, height: 480, seen_from: SeenFrom::World }
    }
}

const LEFT: f64 = 76.0;
/// Space between the head and the charts, for the name of the first, in px.
const ABOVE: f64 = 30.0;
/// Heights of the signs under the source and of the strokes under the result, in px.
const SIGNS: f64 = 48.0;
const STROKES: f64 = 14.0;
const BOTTOM: f64 = 44.0;
const BETWEEN: f64 = 20.0;
/// Colour of a koma with a drawing of its own: blue, as in the paper's Fig. 8.
const OWN: RGBColor = style::WALL;

const LEGEND: [Entry; 4] = [
    LEFT_OUT,
    ("held コマ撮り", |canvas, at| canvas.ring(at, 3.25, style::FAINT, 1.25)),
    ("a koma longer", |canvas, at| plus(canvas, at, 3.5)),
    ("own drawing", |canvas, (x, y)| canvas.rect((x - 2.0, y - 6.0), (x + 2.0, y + 6.0), OWN)),
];

/// Returns the legend, with the sign of holds by hand only if there are some.
fn legend(fates: &[Fate]) -> Vec<Entry> {
    let by_hand = fates.contains(&Fate::HeldByHand).then_some(BY_HAND);
    LEGEND.into_iter().chain(by_hand).collect()
}

/// The movement of a layer, koma by koma.
pub struct Moves {
    /// SSD into each koma; 0 for the first, and while a drawing is held.
    pub ssd: Vec<f64>,
    /// Koma on which each exposure begins.
    begins: Vec<usize>,
}

impl Moves {
    /// Measures the movement of a layer as a screen sees it.
    pub fn new(clip: &Clip, layer: &Layer, screen: &Screen) -> Self {
        let stills = Stills::on(clip, layer, screen);
        let drawings: Vec<usize> = layer.koma().collect();
        let ssd = drawings.windows(2).map(|pair| stills.ssd(pair[0], pair[1]));
        let begins = layer.timed().map(|(koma, _)| koma).collect();
        Self { ssd: [0.0].into_iter().chain(ssd).collect(), begins }
    }

    /// Measures the movement of a layer as [`Moves::new`] does, with the stills of `all`, a layer that
    /// contains its drawings. Returns `None` if one of its drawings is missing there.
    pub fn among(stills: &Stills, all: &Layer, layer: &Layer) -> Option<Self> {
        let same = |drawing: &Drawing| {
            let place = drawing.source.place();
            let by_place = |other: &Drawing| other.source.place().total_cmp(&place);
            let at = all.drawings.binary_search_by(by_place).ok()?;
            (all.drawings[at].source == drawing.source).then_some(at)
        };
        let own: Vec<usize> = layer.drawings.iter().map(same).collect::<Option<_>>()?;
        let drawings: Vec<usize> = layer.koma().map(|drawing| own[drawing]).collect();
        let ssd = drawings.windows(2).map(|pair| stills.ssd(pair[0], pair[1]));
        let begins = layer.timed().map(|(koma, _)| koma).collect();
        Some(Self { ssd: [0.0].into_iter().chain(ssd).collect(), begins })
    }

    /// Returns the largest SSD.
    pub fn largest(&self) -> f64 {
        self.ssd.iter().copied().fold(0.0, f64::max)
    }
}

/// Contents and layout of the plot.
struct Paper<'a> {
    seen_from: SeenFrom,
    before: &'a Layer,
    after: &'a Layer,
    source: Moves,
    result: Moves,
    fates: Vec<Fate>,
    legend: Vec<Entry>,
    koma: usize,
    /// Width of a koma, in px.
    slot: f64,
    /// Charts of the source and of the result.
    charts: [Plot; 2],
}

/// Returns the title.
fn title(seen_from: SeenFrom) -> &'static str {
    if seen_from.is_world() {
        "Movement into each koma 動きの大きさ"
    } else {
        "Movement on screen into each koma 画面での動きの大きさ"
    }
}

impl SsdPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if a size cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)
    }

    /// Draws the first layer of a sheet, before and after omission, as SVG.
    ///
    /// SSD is the sum over the joints of the squared distance from the koma before (KKMFT §3.1), in the
    /// file's unit squared. Bars are as high as its root, so that twice the height is twice the distance.
    /// Both rows have one scale. Drawings at the same place in the source count as the same.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`SsdPlot::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and
    /// sheets have nothing to show.
    pub fn draw(&self, clip: &Clip, before: &Sheet, after: &Sheet) -> Result<String, Error> {
        self.validate()?;
        let second = (before.clock.koma_rate.round() as usize).max(1);
        let (before, after) = (shown(clip, before)?, shown(clip, after)?);
        let koma = before.length().max(after.length());
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let screen = Screen::new(self.seen_from, clip);
        let (source, result) =
            (Moves::new(clip, before, &screen), Moves::new(clip, after, &screen));
        let words = title(self.seen_from);
        let fates = fates(before, after);
        let legend = legend(&fates);
        let top = Title { words, clips: "", legend: &legend, width }.height() + ABOVE;
        let most = source.largest().max(result.largest());
        let paper = Paper {
            seen_from: self.seen_from,
            charts: charts((width, height), top, (koma, second), most),
            source,
            result,
            fates,
            legend,
            before,
            after,
            koma,
            slot: (width - style::MARGIN - LEFT) / koma as f64,
        };
        let mut canvas = Canvas::new((width, height));
        paper.draw(&mut canvas)?;
        Ok(canvas.finish())
    }
}

/// Builds both charts, one over the other, on one scale. Lines mark the seconds and round roots of SSD.
fn charts(
    (width, height): (f64, f64),
    top: f64,
    (koma, second): (usize, usize),
    most: f64,
) -> [Plot; 2] {
    let high = 0.5 * (height - top - SIGNS - BETWEEN - STROKES - BOTTOM);
    let seconds = (0..=koma).step_by(second).map(|koma| (koma as f64, String::new()));
    let x = Axis::labelled((0.0, koma as f64), seconds.collect());
    let y = Axis::round((0.0, most.sqrt()), high / 30.0).written(|root| number(root * root));
    [top, top + high + SIGNS + BETWEEN].map(|top| Plot {
        from: (LEFT, top),
        to: (width - style::MARGIN, top + high),
        x: x.clone(),
        y: y.clone(),
    })
}

impl Paper<'_> {
    fn draw(&self, canvas: &mut Canvas) -> Result<(), Error> {
        self.head(canvas);
        let words = ["source 素材", "result 結果"];
        let bars = [self.source_bars(), self.result_bars()];
        for ((plot, words), bars) in self.charts.iter().zip(words).zip(bars) {
            let place = (style::MARGIN, plot.from.1 - 7.0);
            canvas.text(words, place, Type::new(style::WORDS).bold());
            plot.draw(canvas, |chart| chart.draw_series(bars).map(drop))?;
        }
        self.signs(canvas);
        self.strokes(canvas);
        self.koma_numbers(canvas)
    }

    fn right(&self) -> f64 {
        self.charts[0].to.0
    }

    /// Draws the title, the facts about omission in numbers, and the legend.
    fn head(&self, canvas: &mut Canvas) {
        let seen = match self.seen_from.is_world() {
            true => String::new(),
            false => format!("  ·  seen from 見る位置 {}", self.seen_from),
        };
        let count = |fate| self.fates.iter().filter(|of_drawing| **of_drawing == fate).count();
        let (left_out, held) = (count(Fate::LeftOut), count(Fate::Held));
        let (was, is) = (self.source.largest(), self.result.largest());
        let times = if was > 0.0 { format!(", {:.1} times", is / was) } else { String::new() };
        let facts = format!(
            "{} koma  ·  left out 抜いた中割 {left_out}  ·  held コマ撮り {held}  ·  \
             largest SSD {was:.0} → {is:.0}{times}  ·  bars are √SSD high{seen}",
            self.koma
        );
        let width = self.right() + style::MARGIN;
        Title { words: title(self.seen_from), clips: &facts, legend: &self.legend, width }
            .draw(canvas);
    }

    /// Builds a bar as high as the root of an SSD, with a small gap between koma.
    fn bar(&self, koma: usize, ssd: f64, color: RGBColor) -> Rectangle<(f64, f64)> {
        let gap = f64::min(0.12, 3.0 / self.slot);
        bar((koma as f64 + gap, 0.0), ((koma + 1) as f64 - gap, ssd.sqrt()), color)
    }

    fn source_bars(&self) -> Vec<Rectangle<(f64, f64)>> {
        let bar = |((koma, exposure), begin): ((usize, Exposure), &usize)| {
            let color = match self.fates[exposure.drawing] {
                Fate::Stays => style::INBETWEEN,
                Fate::LeftOut => style::GENGA,
                Fate::Held | Fate::HeldByHand => style::RAW,
            };
            self.bar(koma, self.source.ssd[*begin], color)
        };
        self.before.timed().zip(&self.source.begins).map(bar).collect()
    }

    /// Builds the bars of the result: red if drawings were left out before it.
    fn result_bars(&self) -> Vec<Rectangle<(f64, f64)>> {
        let bar = |(koma, exposure): (usize, Exposure)| {
            let color = if self.omitted_before(exposure) > 0 { style::GENGA } else { OWN };
            self.bar(koma, self.result.ssd[koma], color)
        };
        self.after.timed().map(bar).collect()
    }

    fn omitted_before(&self, exposure: Exposure) -> usize {
        self.after.drawings[exposure.drawing].why.omitted_before
    }

    /// Draws, under each drawing of the source, the sign of what omission did to it.
    fn signs(&self, canvas: &mut Canvas) {
        let radius = (0.42 * self.slot).clamp(1.5, 4.0);
        for (koma, exposure) in self.before.timed() {
            let (x, floor) = self.charts[0].at(koma as f64 + 0.5, 0.0);
            let sign = (x, floor + 10.0);
            match self.fates[exposure.drawing] {
                Fate::LeftOut => canvas.cross(sign, radius, style::GENGA, 1.5),
                Fate::Held => canvas.ring(sign, 0.8 * radius, style::FAINT, 1.0),
                Fate::HeldByHand => held_by_hand(canvas, sign, 0.8 * radius),
                Fate::Stays => {
                    for more in 0..self.given(exposure.drawing) {
                        plus(canvas, (x, sign.1 + 2.4 * radius * more as f64), radius);
                    }
                }
            }
        }
    }

    /// Returns the number of koma that naka-nashi gave to a drawing.
    fn given(&self, drawing: usize) -> usize {
        let place = self.before.drawings[drawing].source.place();
        let same = |other: &&Drawing| (other.source.place() - place).abs() <= 1e-6;
        self.after.drawings.iter().find(same).map_or(0, |same| same.why.lengthened)
    }

    /// Draws a stroke under each drawing of the result, and writes how many were left out before it, where there is
    /// room: every one of them has a sign above.
    fn strokes(&self, canvas: &mut Canvas) {
        let half = (0.25 * self.slot).clamp(0.5, 2.0);
        let look = Type::new(style::SMALL).bold().color(style::GENGA);
        let mut free = 0.0;
        for (koma, exposure) in self.after.timed() {
            let (x, floor) = self.charts[1].at(koma as f64 + 0.5, 0.0);
            canvas.rect((x - half, floor + 5.0), (x + half, floor + STROKES), OWN);
            let omitted = self.omitted_before(exposure);
            let (x, top) = self.charts[1].at((koma + 1) as f64, self.result.ssd[koma].sqrt());
            if omitted > 0 && x > free {
                let words = format!("×{omitted}");
                canvas.text(&words, (x + 5.0, top + 10.0), look);
                free = x + style::BOLDER * style::text_width(&words, style::SMALL);
            }
        }
    }

    /// Writes the koma numbers from 1, below both charts.
    fn koma_numbers(&self, canvas: &mut Canvas) -> Result<(), Error> {
        let steps = [1, 6, 12, 24, 48, 144, 480];
        let step = steps.into_iter().find(|step| *step as f64 * self.slot > 36.0).unwrap_or(1440);
        let has_room = |koma: &usize| *koma == 1 || koma.is_multiple_of(step);
        let numbers = (1..=self.koma).filter(has_room);
        let numbers = numbers.map(|koma| (koma as f64 - 0.5, koma.to_string())).collect();
        let y = self.charts[1].to.1 + STROKES + 5.0;
        let axis = Axis::labelled((0.0, self.koma as f64), numbers);
        Plot::ruler((LEFT, self.right()), y, axis).draw(canvas, |_| Ok(()))?;
        let look = Type::new(style::SMALL).align(Align::Right).color(style::FAINT);
        canvas.text("koma", (LEFT - 8.0, y + 17.0), look);
        Ok(())
    }
}

/// Draws a +: one koma more.
fn plus(canvas: &mut Canvas, (x, y): Point, radius: f64) {
    canvas.line((x - radius, y), (x + radius, y), OWN, 1.75);
    canvas.line((x, y - radius), (x, y + radius), OWN, 1.75);
}
