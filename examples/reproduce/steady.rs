//! Measures how steady keys are under small changes of a setting and under a little noise.

use std::slice::from_ref;

use genga::keys::Matching;
use genga::pipeline::Budget;
use genga::recipe::Recipe;
use genga::time::Frame;
use genga_lab::study::{Axis, Grid, Measure, Plateau, Study};
use genga_plot::HeatMap;

use crate::part::Part;
use crate::table::{Table, number, percent, spread};
use crate::takes::Take;
use crate::{Outcome, samples};

/// Settings, each with its value in the default recipe first, then others.
const CHANGES: [(&str, &[&str]); 3] = [
    ("filter.width", &["0.15s", "0.14s", "0.16s"]),
    ("turns.persistence", &["0.1s", "0.09s", "0.11s"]),
    ("noise", &["0", "0.05", "0.1", "0.2", "0.5"]),
];

/// Ranges around the default recipe in which plateaus are looked for.
const ROUND: [(&str, &str); 2] =
    [("filter.width", "0.11s..0.19s:0.01s"), ("turns.persistence", "0.06s..0.14s:0.01s")];

/// Draws the map of Table 1.
pub(crate) fn from_samples() -> Outcome<Part> {
    let study = Study {
        recipe: Recipe::default(),
        x: Axis::new("filter.width", "4..40:2")?,
        y: Some(Axis::new("turns.persistence", "1..12:1")?),
        measures: vec![Measure::Turns],
        keep_keys: true,
        budget: Budget::default(),
    };
    let grid = study.run(samples::clip("kuroda-pitch")?, || ())?;
    let plateaus = [0.0, 1.0].map(|koma| Plateau::largest(from_ref(&grid), koma));
    let mut part = Part::default();
    let map = HeatMap { show: Measure::Turns, per_second: false };
    let clips = ["kuroda-pitch".to_owned()];
    part.picture("table-1-map", map.draw(&clips, &[grid], Some(&plateaus))?);
    Ok(part)
}

/// Makes the table and the numbers of the prose.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let mut part = Part::default();
    let header = ["changed", ">to", ">kept within a koma, median", ">least", ">by chance"];
    let mut table = Table::new(&header);
    for (name, values) in CHANGES {
        let grids = grids(takes, Axis::new(name, &values.join(","))?, None)?;
        for (cell, value) in values.iter().enumerate().skip(1) {
            let [least, median, _] = spread(grids.iter().map(|grid| kept(grid, cell)));
            let chance = spread(grids.iter().map(|grid| chance(grid, cell)))[1];
            let [median, least, chance] = [median, least, chance].map(percent);
            table.row(&[format!("`{name}`"), (*value).into(), median, least, chance]);
        }
    }
    part.table("steady", table);
    plateaus(takes, &mut part)?;
    Ok(part)
}

/// Finds the range in which the keys of each clip stay the same within a koma.
fn plateaus(takes: &[Take], part: &mut Part) -> Outcome<()> {
    let [x, y] = ROUND.map(|(name, values)| Axis::new(name, values));
    let grids = grids(takes, x?, Some(y?))?;
    let mut on = 0;
    let mut sizes = Vec::new();
    for grid in &grids {
        let plateau = Plateau::largest(from_ref(grid), 1.0);
        on += usize::from(
            plateau.as_ref().zip(grid.own).is_some_and(|(plateau, own)| plateau.holds(own)),
        );
        sizes.push(plateau.map_or(0, |plateau| plateau.cells.len()) as f64);
    }
    for (size, word) in spread(sizes).into_iter().zip(["least", "middle", "most"]) {
        part.number(&format!("steady.size.{word}"), number(size, 0));
    }
    part.number("steady.cells", grids[0].cells.len());
    part.number("steady.clips", takes.len());
    part.number("steady.on", on);
    Ok(())
}

/// Runs the default recipe with varied settings on every clip.
fn grids(takes: &[Take], x: Axis, y: Option<Axis>) -> Outcome<Vec<Grid>> {
    let (recipe, measures) = (Recipe::default(), vec![Measure::Genga]);
    let study = Study { recipe, x, y, measures, keep_keys: true, budget: Budget::default() };
    takes.iter().map(|take| Ok(study.run(take.clip.clone(), || ())?)).collect()
}

/// Share of keys within a koma of the recipe's own, which are those of the first cell.
fn kept(grid: &Grid, cell: usize) -> f64 {
    Matching::between(keys(grid, 0), keys(grid, cell), grid.frames_in_koma).kept()
}

/// Share of keys that would agree within a koma by chance: the mean over all rotations of the second list by a whole
/// number of koma, which keeps its size and gaps.
fn chance(grid: &Grid, cell: usize) -> f64 {
    let (own, other) = (keys(grid, 0), keys(grid, cell));
    let past = own.iter().chain(other).map(|frame| frame.0).max().unwrap_or(0) + 1;
    let turned = |by: usize| {
        let mut turned: Vec<Frame> =
            other.iter().map(|frame| Frame((frame.0 + by) % past)).collect();
        turned.sort_unstable();
        Matching::between(own, &turned, grid.frames_in_koma).kept()
    };
    let steps: Vec<usize> = (1..)
        .map(|koma| (f64::from(koma) * grid.frames_in_koma).round() as usize)
        .take_while(|by| *by < past)
        .collect();
    steps.iter().map(|by| turned(*by)).sum::<f64>() / steps.len() as f64
}

fn keys(grid: &Grid, cell: usize) -> &[Frame] {
    grid.cells[cell].keys.as_deref().unwrap_or_default()
}
