//! Draws the spacing gauges (ツメ指示) again, lying and large enough to copy onto the keys.

use crate::canvas::{Align, Canvas, Type};
use crate::style;
use crate::xsheet::column::key;
use crate::xsheet::grid::{FRAME, WIDTH};
use crate::xsheet::head;
use crate::xsheet::layout::{Page, SIZE};
use crate::xsheet::paper_layer::Leaf;
use crate::xsheet::spread::Spread;
use genga::motion::Clip;
use genga::timing::{Gauge, fraction};

const TOP: f64 = 118.0;
const HIGH: f64 = 56.0;
const ROWS: usize = 23;
const WIDE: f64 = 492.0;
/// Distance from the left edge of an entry to the first key, and from there to the second, in px.
const BEFORE: f64 = 112.0;
const LONG: f64 = 244.0;
/// Font size of the labels at the ticks, and how far they may reach beyond the keys, in px.
const LABEL: f64 = 10.0;
const OVER: f64 = 11.0;

/// A gauge and its layer.
pub(super) type Entry<'a> = (&'a Leaf<'a>, &'a Gauge);

/// Returns the gauges that have a drawing between their keys.
pub(super) fn entries<'a>(leaves: &'a [Leaf<'a>]) -> Vec<Entry<'a>> {
    let all = leaves.iter().flat_map(|leaf| leaf.gauges.iter().map(move |gauge| (leaf, gauge)));
    all.filter(|(_, gauge)| !gauge.between().is_empty()).collect()
}

/// Returns how many pages gauges need; none without a gauge.
pub(super) fn count(entries: &[Entry<'_>]) -> usize {
    entries.len().div_ceil(2 * ROWS)
}

/// Draws the pages of gauges, numbered from `first` on.
pub(super) fn draw(first: &Page<'_>, clip: &Clip, entries: &[Entry<'_>]) -> Vec<String> {
    let page = |(at, gauges): (usize, &[Entry<'_>])| {
        let mut canvas = Canvas::new(SIZE);
        head::boxes(&mut canvas, &Page { number: first.number + at, ..*first });
        title(&mut canvas);
        for (at, (leaf, gauge)) in gauges.iter().enumerate() {
            let left = WIDTH.0 + (at / ROWS) as f64 * WIDE;
            let top = TOP + (at % ROWS) as f64 * HIGH;
            entry(&mut canvas, clip, leaf, gauge, (left, top));
        }
        canvas.finish()
    };
    entries.chunks(2 * ROWS).enumerate().map(page).collect()
}

fn title(canvas: &mut Canvas) {
    let words = "ツメ指示 spacing gauges";
    canvas.text(words, (WIDTH.0 + 2.0, 82.0), Type::new(15.0).bold());
    let words = "From key to key, along the path of the joint that travels furthest. Above a tick the \
                 drawing (CELL number), below it the nearest fraction. Keys without inbetweens (中割なし) \
                 are left out.";
    canvas.text(words, (WIDTH.0 + 2.0, 101.0), Type::new(11.5).color(style::FAINT));
}

fn entry(
    canvas: &mut Canvas,
    clip: &Clip,
    leaf: &Leaf<'_>,
    gauge: &Gauge,
    (left, top): (f64, f64),
) {
    let layer = leaf.layer;
    let koma = |exposure: usize| leaf.begins[exposure] + 1;
    let last = gauge.first + gauge.shares.len() - 1;
    let base = top + 0.5 * HIGH;
    canvas.line((left, top), (left + WIDE - 8.0, top), style::GRID, 1.0);
    let range = format!("{}  {}–{}", layer.name, koma(gauge.first), koma(last));
    canvas.text(&range, (left + 4.0, base - 3.0), Type::new(12.0).bold());
    let joint = style::fitted(&clip.skeleton().joints[gauge.joint.0].name, 10.0, BEFORE - 22.0);
    canvas.text(&joint, (left + 4.0, base + 12.0), Type::new(10.0).color(style::FAINT));
    let from = left + BEFORE;
    canvas.line((from, base), (from + LONG, base), FRAME, 1.3);
    ticks(canvas, leaf, gauge, (from, base));
    for (exposure, x) in [(gauge.first, from), (last, from + LONG)] {
        let drawing = layer.exposures[exposure].drawing;
        if let Some(number) = &leaf.genga[drawing] {
            key(canvas, leaf, drawing, number, (x, base));
        }
    }
    let Some(packing) = gauge.packing() else { return };
    let x = from + LONG + 16.0;
    canvas.text(packing.japanese(), (x, base - 3.0), Type::new(12.0).bold());
    let room = left + WIDE - 8.0 - x;
    let english = style::fitted(packing.english(), 9.5, room);
    canvas.text(&english, (x, base + 12.0), Type::new(9.5).color(style::FAINT));
}

/// Draws a tick for each drawing, with its number above and its fraction below.
fn ticks(canvas: &mut Canvas, leaf: &Leaf<'_>, gauge: &Gauge, (from, base): (f64, f64)) {
    let wanted: Vec<f64> = gauge.between().iter().map(|share| from + share * LONG).collect();
    for &x in &wanted {
        // The tick is longer than a circle is high, so that a drawing close to a key does not hide behind it.
        canvas.line((x, base - 10.5), (x, base + 10.5), style::INK, 1.2);
    }
    let exposures = &leaf.layer.exposures[gauge.first + 1..][..wanted.len()];
    let numbers = exposures.iter().map(|shown| leaf.numbers[shown.drawing].to_string()).collect();
    let fractions = gauge.between().iter().map(|share| fraction(*share).to_owned()).collect();
    let rows: [(Vec<String>, f64); 2] = [(numbers, base - 13.0), (fractions, base + 21.0)];
    for (labels, y) in rows {
        row(canvas, &wanted, &labels, (from, y));
    }
}

/// Writes a row of labels, each as near to its tick as its neighbours allow. `from` is the x of the first key.
fn row(canvas: &mut Canvas, wanted: &[f64], labels: &[String], (from, y): (f64, f64)) {
    let lengths: Vec<f64> =
        labels.iter().map(|label| style::text_width(label, LABEL) + 2.0).collect();
    let spread = Spread::new(wanted, &lengths, (from - OVER, from + LONG + OVER));
    let small = Type::new(LABEL * spread.scale).align(Align::Center);
    for (label, x) in labels.iter().zip(spread.middles) {
        canvas.text(label, (x, y), small);
    }
}
