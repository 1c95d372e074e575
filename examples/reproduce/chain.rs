//! The chain: the effect of both papers together, which neither has alone.

use std::collections::BTreeSet;

use genga::motion::Clip;
use genga::sheet::{Layer, Role, Sheet};
use genga::time::KOMA_RATE;
use genga::timing::{Amount, Omission, Stills};

use crate::Outcome;
use crate::part::Part;
use crate::table::{Table, number, percent, spread};
use crate::takes::Take;

/// The ways to make a sheet.
const WAYS: [&str; 5] = [
    "on ones",
    "first paper alone",
    "second paper alone",
    "second paper, as few drawings as the chain",
    "chain",
];

/// The figures of a sheet.
struct Look {
    drawings_per_second: f64,
    longest_hold: usize,
    /// Share of koma that repeat the one before.
    held: f64,
    /// Largest and median distance from each drawing to the next, as squared distances of all joints, relative to the
    /// source on ones.
    peak: f64,
    median: f64,
    /// Share of the first paper's genga whose source place is drawn.
    genga_drawn: f64,
}

/// Makes the tables.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let looks = takes.iter().map(looks).collect::<Outcome<Vec<_>>>()?;
    let mut part = Part::default();
    part.table("chain", medians(&looks));
    let larger = looks.iter().filter(|[.., second, _, chain]| chain.peak > second.peak).count();
    part.number("chain.larger", larger);
    part.number("chain.clips", looks.len());
    for (at, way) in ["ones", "first", "second", "few", "both"].into_iter().enumerate() {
        let figures = |of: fn(&Look) -> f64| spread(looks.iter().map(|looks| of(&looks[at])));
        let mut tell = |name: &str, figures: [f64; 3], places| {
            for (figure, word) in figures.into_iter().zip(["least", "median", "most"]) {
                part.number(&format!("chain.{way}.{name}.{word}"), number(figure, places));
            }
        };
        tell("drawings", figures(|look| look.drawings_per_second), 1);
        tell("peak", figures(|look| look.peak), 1);
        tell("step", figures(|look| look.median), 1);
        tell("genga", figures(|look| 100.0 * look.genga_drawn), 0);
    }
    Ok(part)
}

/// Computes a look for each way.
fn looks(take: &Take) -> Outcome<[Look; 5]> {
    let clip = &take.clip;
    let run = take.default();
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let ones = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let ones_layer = &ones.layers[0];
    let stills = Stills::from_layer(clip, ones_layer);
    // Koma-dori is asked for as many as the chain leaves out, naka-nashi included.
    let left_out = koma - run.sheet.layers[0].drawings.len();
    let second = Omission::default().apply(ones_layer, &stills, 1)?;
    let koma_dori = Amount::Count(left_out - second.report.naka_nashi.done);
    let few = Omission { koma_dori, ..Omission::default() }.apply(ones_layer, &stills, 1)?;
    let genga = genga(&run.spaced.layers[0]);
    let [peak, median] = steps(&stills);
    let look = |layer: &Layer| {
        let [own_peak, own_median] = steps(&Stills::from_layer(clip, layer));
        Look {
            drawings_per_second: layer.drawings.len() as f64 * KOMA_RATE / layer.length() as f64,
            longest_hold: layer.longest_hold(),
            held: layer.held_koma() as f64 / layer.length() as f64,
            peak: own_peak / peak,
            median: own_median / median,
            genga_drawn: genga_drawn(clip, &genga, layer),
        }
    };
    Ok([ones_layer, &run.spaced.layers[0], &second.layer, &few.layer, &run.sheet.layers[0]]
        .map(look))
}

/// The source places of the genga.
fn genga(layer: &Layer) -> Vec<f64> {
    let genga = layer.drawings.iter().filter(|drawing| drawing.role == Role::Genga);
    genga.map(|drawing| drawing.source.place()).collect()
}

/// The share of the genga whose koma of the source is drawn.
fn genga_drawn(clip: &Clip, genga: &[f64], layer: &Layer) -> f64 {
    let clock = clip.clock(KOMA_RATE);
    let drawn: BTreeSet<usize> = layer
        .drawings
        .iter()
        .map(|drawing| clock.koma_from_place(drawing.source.place()))
        .collect();
    let there = genga.iter().filter(|place| drawn.contains(&clock.koma_from_place(**place)));
    there.count() as f64 / genga.len() as f64
}

/// The largest and the median distance from a drawing to the next.
fn steps(stills: &Stills) -> [f64; 2] {
    let steps = spread((1..stills.len()).map(|at| stills.ssd(at - 1, at)));
    [steps[2], steps[1]]
}

/// A table with one row per way, medians over the clips.
fn medians(looks: &[[Look; 5]]) -> Table {
    let mut table = Table::new(&[
        "way",
        ">drawings/s",
        ">longest hold, koma",
        ">koma held",
        ">largest step (SSD), times the source's",
        ">middle step, times the source's",
        ">genga drawn",
    ]);
    for (at, way) in WAYS.into_iter().enumerate() {
        let median = |of: fn(&Look) -> f64| spread(looks.iter().map(|looks| of(&looks[at])))[1];
        table.row(&[
            way.into(),
            number(median(|look| look.drawings_per_second), 1),
            number(median(|look| look.longest_hold as f64), 0),
            percent(median(|look| look.held)),
            number(median(|look| look.peak), 1),
            number(median(|look| look.median), 1),
            percent(median(|look| look.genga_drawn)),
        ]);
    }
    table
}
