//! Draws the spacing gauges (ツメ指示) beside ACTION, upright like the time.

use crate::canvas::{Align, Canvas, Type};
use crate::style;
use crate::xsheet::half_page::{Half, ROW};
use crate::xsheet::layout::{NUMBERS, Page, STRIP};
use crate::xsheet::paper_layer::Leaf;
use crate::xsheet::spread::Spread;
use genga::timing::{Gauge, Packing, fraction};

/// Half the length of a tick between keys and of a tick at a key, in px.
const TICK: f64 = 3.5;
const KEY_TICK: f64 = 5.5;
/// Height of a fraction, in px.
const APART: f64 = 9.5;

/// Draws the strip of one layer. Words and fractions have room only if no other layer is on the page.
pub(super) fn draw(canvas: &mut Canvas, page: &Page<'_>, leaf: &Leaf<'_>, half: Half, at: usize) {
    let lane = STRIP / page.leaves.len() as f64;
    let alone = page.leaves.len() == 1;
    let left = half.left + NUMBERS + lane * at as f64;
    let x = left + if alone { 12.0 } else { 0.5 * lane };
    for (gauge, from, to) in leaf.gauges_on(half) {
        let span = Span { half, x, from, to };
        span.line(canvas, gauge);
        if alone {
            span.words(canvas, gauge, left + STRIP);
        }
    }
}

/// A span from the middle of a key's koma to the middle of the next key's koma.
struct Span {
    half: Half,
    x: f64,
    from: usize,
    to: usize,
}

impl Span {
    /// Returns the y of a share of the way, if it lies on this half.
    fn y(&self, share: f64) -> Option<f64> {
        let koma = self.from as f64 + 0.5 + share * (self.to - self.from) as f64;
        let here = koma >= self.half.begin as f64 && koma <= self.half.end() as f64;
        here.then(|| self.half.y_at(koma))
    }

    fn line(&self, canvas: &mut Canvas, gauge: &Gauge) {
        let (x, half) = (self.x, self.half);
        let top = self.y(0.0).unwrap_or(half.y(half.begin));
        let bottom = self.y(1.0).unwrap_or(half.y(half.end()));
        canvas.line((x, top), (x, bottom), style::FAINT, 1.0);
        for y in [self.y(0.0), self.y(1.0)].into_iter().flatten() {
            canvas.line((x - KEY_TICK, y), (x + KEY_TICK, y), style::INK, 1.3);
        }
        for y in gauge.between().iter().filter_map(|share| self.y(*share)) {
            canvas.line((x - TICK, y), (x + TICK, y), style::INK, 1.0);
        }
    }

    /// Returns the y nearest to a tick at which a fraction is clear of the lines between koma.
    fn inside_koma(&self, y: f64) -> f64 {
        let (top, half) = (self.half.y(self.half.begin), 0.5 * APART + 0.5);
        let koma = ((y - top) / ROW).floor();
        y.clamp(top + koma * ROW + half, top + (koma + 1.0) * ROW - half)
    }

    /// Writes the fractions beside the ticks, and the kind of packing.
    fn words(&self, canvas: &mut Canvas, gauge: &Gauge, right: f64) {
        let here = gauge
            .between()
            .iter()
            .filter_map(|share| Some((self.inside_koma(self.y(*share)?), fraction(*share))));
        let (wanted, fractions): (Vec<f64>, Vec<&str>) = here.unzip();
        let top = self.y(0.0).unwrap_or(self.half.y(self.half.begin));
        let bottom = self.y(1.0).unwrap_or(self.half.y(self.half.end()));
        let room = (top - 0.5 * APART, bottom + 0.5 * APART);
        let spread = Spread::new(&wanted, &vec![APART; wanted.len()], room);
        let scale = spread.scale;
        let size = 8.5 * scale;
        for (fraction, y) in fractions.into_iter().zip(spread.middles) {
            let (left, width) = (self.x + KEY_TICK + 1.0, style::text_width(fraction, size) + 2.0);
            canvas.rect((left, y - 4.0 * scale), (left + width, y + 4.5 * scale), style::PAPER);
            let look = Type::new(size).color(style::FAINT);
            canvas.text(fraction, (left + 1.0, y + 3.0 * scale), look);
        }
        // Written in the koma in the middle: clear of the lines between koma, and on one half only.
        let middle = (self.from + self.to) / 2;
        if !self.half.shows(middle) {
            return;
        }
        let y = self.half.y(middle) + 0.5 * ROW;
        let look = Type::new(11.0).align(Align::Right);
        match gauge.packing() {
            None if self.to - self.from > 1 => {
                let word = "中割なし";
                canvas.text(word, (right - 2.0, y + 3.2), Type::new(9.0).align(Align::Right))
            }
            Some(packing) if (self.to - self.from) as f64 * ROW > 20.0 => {
                canvas.text(kanji(packing), (right - 3.0, y + 4.0), look.bold())
            }
            _ => {}
        }
    }
}

fn kanji(packing: Packing) -> &'static str {
    match packing {
        Packing::Even => "均",
        Packing::Sakizume => "先",
        Packing::Atozume => "後",
        Packing::Both => "両",
    }
}
