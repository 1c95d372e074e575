//! How far the body moves into each koma, before and after omission [KKMFT Figs. 1, 2, 8].

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::{Clip, Screen, SeenFrom};
use crate::plot::axis::{Scale, number};
use crate::plot::canvas::{Align, Canvas, Point, Type};
use crate::plot::cells::shown;
use crate::plot::sheet::fate::{Fate, fates};
use crate::plot::style;
use crate::sheet::{Layer, Sheet};
use crate::timing::Stills;

/// The movement into each koma (動きの大きさ): a bar a koma of the source, under it a sign for what
/// omission did there, and below a bar a koma of the result, none where a drawing is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SsdPlot {
    /// Width in px, 400 to 20000; default 1200. A koma of a long clip is a thin bar.
    pub width: u32,
    /// Height in px, 300 to 20000; default 480.
    pub height: u32,
    /// From where movement is seen; default from nowhere, in the world.
    pub seen_from: SeenFrom,
}

impl Default for SsdPlot {
    fn default() -> Self {
        Self { width: 1200, height: 480, seen_from: SeenFrom::World }
    }
}

const LEFT: f64 = 76.0;
const TOP: f64 = 90.0;
/// Room for the signs under the source, and for the strokes under the result.
const SIGNS: f64 = 48.0;
const STROKES: f64 = 14.0;
const BOTTOM: f64 = 44.0;
const BETWEEN: f64 = 20.0;
/// A koma with a drawing of its own: blue, as in the paper's Fig. 8.
const OWN: RGBColor = style::WALL;

/// A layer koma by koma.
pub(crate) struct Moves {
    /// SSD into each koma; 0 into the first and where a drawing is held.
    pub(crate) ssd: Vec<f64>,
    /// The koma on which each exposure begins.
    begins: Vec<usize>,
}

impl Moves {
    pub(crate) fn of(clip: &Clip, layer: &Layer, screen: &Screen) -> Self {
        let stills = Stills::on(clip, layer, screen);
        let drawings: Vec<usize> = layer.koma().collect();
        let ssd = drawings.windows(2).map(|pair| stills.ssd(pair[0], pair[1]));
        let begins = layer.timed().map(|(koma, _)| koma).collect();
        Self { ssd: [0.0].into_iter().chain(ssd).collect(), begins }
    }

    pub(crate) fn largest(&self) -> f64 {
        self.ssd.iter().copied().fold(0.0, f64::max)
    }
}

/// Everything drawn, and where.
struct Paper<'a> {
    seen_from: SeenFrom,
    before: &'a Layer,
    after: &'a Layer,
    source: Moves,
    result: Moves,
    fates: Vec<Fate>,
    koma: usize,
    second: usize,
    slot: f64,
    right: f64,
    /// Where the bars of the source and of the result stand, and how high the highest may be.
    floors: (f64, f64),
    high: f64,
}

impl SsdPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a size that cannot be drawn.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        style::check_size("height", self.height, 300)
    }

    /// Draws the first layers of a sheet and of what omission left of it, as SVG.
    ///
    /// SSD is the sum over the joints of the squared distance from the koma before (KKMFT §3.1), in
    /// the file's unit squared; bars are as high as its root, so that twice as high is twice as far. Both rows have
    /// one scale. Drawings of the same place in the source are the same.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`SsdPlot::validate`]; [`Error::Sheet`] or [`Error::Picture`] when clip and sheets have
    /// nothing to show.
    pub fn draw(&self, clip: &Clip, before: &Sheet, after: &Sheet) -> Result<String, Error> {
        self.validate()?;
        let second = (before.clock.koma_rate.round() as usize).max(1);
        let (before, after) = (shown(clip, before)?, shown(clip, after)?);
        let koma = before.length().max(after.length());
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let high = 0.5 * (height - TOP - SIGNS - BETWEEN - STROKES - BOTTOM);
        let floor = TOP + high;
        let right = width - style::MARGIN;
        let screen = Screen::of(self.seen_from, clip);
        let paper = Paper {
            seen_from: self.seen_from,
            source: Moves::of(clip, before, &screen),
            result: Moves::of(clip, after, &screen),
            fates: fates(before, after),
            before,
            after,
            koma,
            second,
            slot: (right - LEFT) / koma as f64,
            right,
            floors: (floor, floor + SIGNS + BETWEEN + high),
            high,
        };
        let mut canvas = Canvas::new((f64::from(self.width), f64::from(self.height)));
        paper.draw(&mut canvas);
        Ok(canvas.finish())
    }
}

impl Paper<'_> {
    fn draw(&self, canvas: &mut Canvas) {
        self.head(canvas);
        let most = self.source.largest().max(self.result.largest());
        let (above, below) = self.floors;
        for (floor, words) in [(above, "source 素材"), (below, "result 結果")] {
            self.grid(canvas, floor, most);
            let base = floor - self.high - 7.0;
            canvas.text(words, (style::MARGIN, base), Type::new(style::WORDS).bold());
        }
        let scale = |floor: f64| Scale::new((0.0, most.sqrt()), (floor, floor - self.high));
        self.above(canvas, &scale(above));
        self.below(canvas, &scale(below));
        self.koma_numbers(canvas);
    }

    /// The left edge of a koma.
    fn x(&self, koma: usize) -> f64 {
        LEFT + koma as f64 * self.slot
    }

    /// What was done, in numbers, and what the signs mean.
    fn head(&self, canvas: &mut Canvas) {
        let title = Type::new(style::TITLE).bold();
        let (words, seen) = if self.seen_from.is_world() {
            ("Movement into each koma 動きの大きさ", String::new())
        } else {
            let seen = format!("  ·  seen from 見る位置 {}", self.seen_from);
            ("Movement on screen into each koma 画面での動きの大きさ", seen)
        };
        canvas.text(words, (style::MARGIN, 34.0), title);
        let count = |fate| self.fates.iter().filter(|of_drawing| **of_drawing == fate).count();
        let (left_out, held) = (count(Fate::LeftOut), count(Fate::Held));
        let (was, is) = (self.source.largest(), self.result.largest());
        let times = if was > 0.0 { format!(", {:.1} times", is / was) } else { String::new() };
        let facts = format!(
            "{} koma  ·  left out 中無し {left_out}  ·  held コマ撮り {held}  ·  \
             largest SSD {was:.0} → {is:.0}{times}  ·  bars are √SSD high{seen}",
            self.koma
        );
        let facts = style::fitted(&facts, style::WORDS, self.right - style::MARGIN);
        canvas.text(&facts, (style::MARGIN, 56.0), Type::new(style::WORDS).color(style::FAINT));
        if self.right >= 736.0 {
            self.legend(canvas);
        }
    }

    fn legend(&self, canvas: &mut Canvas) {
        let words = ["left out 中無し", "held コマ撮り", "a koma longer", "own drawing"];
        let wide = |word: &str| style::text_width(word, style::WORDS) + 34.0;
        let mut x = self.right + 14.0 - words.iter().map(|word| wide(word)).sum::<f64>();
        for (at, word) in words.into_iter().enumerate() {
            let sign = (x + 7.0, 29.0);
            match at {
                0 => canvas.cross(sign, 4.0, style::GENGA, 1.75),
                1 => canvas.ring(sign, 3.25, style::FAINT, 1.25),
                2 => plus(canvas, sign, 3.5),
                _ => canvas.rect((x + 5.0, 23.0), (x + 9.0, 35.0), OWN),
            }
            canvas.text(word, (x + 17.0, 34.0), Type::new(style::WORDS));
            x += wide(word);
        }
    }

    /// Lines to read the SSD and the seconds by.
    fn grid(&self, canvas: &mut Canvas, floor: f64, most: f64) {
        let top = floor - self.high;
        for koma in (0..=self.koma).step_by(self.second) {
            canvas.line((self.x(koma), top), (self.x(koma), floor), style::GRID, 1.0);
        }
        let scale = Scale::new((0.0, most.sqrt()), (floor, top));
        let look = Type::new(style::SMALL).align(Align::Right).color(style::FAINT);
        for root in scale.ticks(30.0) {
            let y = scale.at(root);
            canvas.line((LEFT, y), (self.right, y), style::GRID, 1.0);
            canvas.text(&number(root * root), (LEFT - 8.0, y + 4.0), look);
        }
        canvas.line((LEFT, floor), (self.right, floor), style::FAINT, 1.0);
    }

    fn bar(&self, canvas: &mut Canvas, (koma, ssd): (usize, f64), scale: &Scale, color: RGBColor) {
        let gap = (0.12 * self.slot).clamp(0.0, 3.0);
        let (left, right) = (self.x(koma) + gap, self.x(koma + 1) - gap);
        canvas.rect((left, scale.at(ssd.sqrt())), (right, scale.at(0.0)), color);
    }

    /// The source, and what was done to each of its drawings.
    fn above(&self, canvas: &mut Canvas, scale: &Scale) {
        let floor = scale.at(0.0);
        let radius = (0.42 * self.slot).clamp(1.5, 4.0);
        for ((koma, exposure), begin) in self.before.timed().zip(&self.source.begins) {
            let fate = self.fates[exposure.drawing];
            let color = match fate {
                Fate::Stays => style::INBETWEEN,
                Fate::LeftOut => style::GENGA,
                Fate::Held => style::RAW,
            };
            self.bar(canvas, (koma, self.source.ssd[*begin]), scale, color);
            let sign = (self.x(koma) + 0.5 * self.slot, floor + 10.0);
            match fate {
                Fate::LeftOut => canvas.cross(sign, radius, style::GENGA, 1.5),
                Fate::Held => canvas.ring(sign, 0.8 * radius, style::FAINT, 1.0),
                Fate::Stays => {
                    for more in 0..self.given(exposure.drawing) {
                        let y = sign.1 + 2.4 * radius * more as f64;
                        plus(canvas, (sign.0, y), radius);
                    }
                }
            }
        }
    }

    /// Koma that naka-nashi gave to a drawing.
    fn given(&self, drawing: usize) -> usize {
        let place = self.before.drawings[drawing].source.place();
        let same = |other: &&crate::sheet::Drawing| (other.source.place() - place).abs() <= 1e-6;
        self.after.drawings.iter().find(same).map_or(0, |same| same.why.lengthened)
    }

    /// The result; red where drawings are left out before it.
    fn below(&self, canvas: &mut Canvas, scale: &Scale) {
        let floor = scale.at(0.0);
        for (koma, exposure) in self.after.timed() {
            let omitted = self.after.drawings[exposure.drawing].why.omitted_before;
            let color = if omitted > 0 { style::GENGA } else { OWN };
            let ssd = self.result.ssd[koma];
            self.bar(canvas, (koma, ssd), scale, color);
            let x = self.x(koma) + 0.5 * self.slot;
            let half = (0.25 * self.slot).clamp(0.5, 2.0);
            canvas.rect((x - half, floor + 4.0), (x + half, floor + STROKES), OWN);
            if omitted > 0 {
                let look = Type::new(style::SMALL).bold().color(style::GENGA);
                let at: Point = (self.x(koma + 1) + 5.0, scale.at(ssd.sqrt()) + 10.0);
                canvas.text(&format!("中無し {omitted}"), at, look);
            }
        }
    }

    fn koma_numbers(&self, canvas: &mut Canvas) {
        let base = self.floors.1 + STROKES + 18.0;
        let look = Type::new(style::SMALL).align(Align::Center);
        let steps = [1, 6, 12, 24, 48, 144, 480];
        let step = steps.into_iter().find(|step| *step as f64 * self.slot > 36.0).unwrap_or(1440);
        for koma in (0..self.koma).filter(|koma| *koma == 0 || (koma + 1) % step == 0) {
            let x = self.x(koma) + 0.5 * self.slot;
            canvas.text(&(koma + 1).to_string(), (x, base), look);
        }
        let look = look.align(Align::Right).color(style::FAINT);
        canvas.text("koma", (LEFT - 8.0, base), look);
    }
}

/// A +: a koma more.
fn plus(canvas: &mut Canvas, (x, y): Point, radius: f64) {
    canvas.line((x - radius, y), (x + radius, y), OWN, 1.75);
    canvas.line((x, y - radius), (x, y + radius), OWN, 1.75);
}
