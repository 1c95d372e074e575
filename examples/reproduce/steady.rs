//! How steady keys are: what a little more or less of a setting, or a little noise, does to them.

use std::slice::from_ref;

use genga::keys::Matching;
use genga::pipeline::Budget;
use genga::plot::HeatMap;
use genga::recipe::Recipe;
use genga::study::{Axis, Grid, Measure, Plateau, Study};
use genga::time::Frame;

use crate::part::Part;
use crate::table::{Table, number, percent, spread};
use crate::takes::Take;
use crate::{Outcome, samples};

/// A setting, its own value in the default recipe first, then others.
const CHANGES: [(&str, &[&str]); 3] = [
    ("filter.width", &["0.15s", "0.14s", "0.16s", "0.13s", "0.17s"]),
    ("turns.persistence", &["0.1s", "0.09s", "0.11s", "0.08s", "0.12s"]),
    ("noise", &["0", "0.05", "0.1", "0.2", "0.5"]),
];

/// Where plateaus are looked for, round the default recipe.
const ROUND: [(&str, &str); 2] =
    [("filter.width", "0.11s..0.19s:0.01s"), ("turns.persistence", "0.06s..0.14s:0.01s")];

/// The map of Table 1.
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

/// The tables.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let mut part = Part::default();
    let mut table = Table::new(&[
        "changed",
        ">to",
        ">kept within a koma, median",
        ">least",
        ">most",
        ">by chance",
    ]);
    for (name, values) in CHANGES {
        let grids = grids(takes, Axis::new(name, &values.join(","))?, None)?;
        for (cell, value) in values.iter().enumerate().skip(1) {
            let [least, median, most] = spread(grids.iter().map(|grid| kept(grid, cell)));
            let chance = spread(grids.iter().map(|grid| chance(grid, cell)))[1];
            for (word, share) in [("kept", median), ("chance", chance)] {
                part.number(&format!("steady.{name}.{value}.{word}"), number(100.0 * share, 0));
            }
            let [median, least, most, chance] = [median, least, most, chance].map(percent);
            table.row(&[format!("`{name}`"), (*value).into(), median, least, most, chance]);
        }
    }
    part.table("steady", table);
    plateaus(takes, &mut part)?;
    Ok(part)
}

/// Where the keys of each clip do not change.
fn plateaus(takes: &[Take], part: &mut Part) -> Outcome<()> {
    let [x, y] = ROUND.map(|(name, values)| Axis::new(name, values));
    let mut table = Table::new(&[
        "clip",
        ">cells with the very same keys",
        ">the same within a koma",
        "where",
        "the recipe stands on it",
    ]);
    let grids = grids(takes, x?, Some(y?))?;
    let (mut on, cells) = (0, grids[0].cells.len());
    for (take, grid) in takes.iter().zip(&grids) {
        let [same, near] = [0.0, 1.0].map(|koma| Plateau::largest(from_ref(grid), koma));
        let count = |plateau: &Option<Plateau>| {
            plateau.as_ref().map_or(0, |plateau| plateau.cells.len()).to_string()
        };
        let is_own = near.as_ref().zip(grid.own).is_some_and(|(near, own)| near.holds(own));
        on += usize::from(is_own);
        table.row(&[
            take.name.clone(),
            count(&same),
            count(&near),
            near.as_ref().map_or("–".into(), |near| near.words(grid)),
            if is_own { "yes" } else { "no" }.into(),
        ]);
    }
    part.table("plateaus", table);
    part.number("steady.cells", cells);
    part.number("steady.clips", takes.len());
    part.number("steady.on", on);
    Ok(())
}

/// The default recipe with settings varied, on every clip.
fn grids(takes: &[Take], x: Axis, y: Option<Axis>) -> Outcome<Vec<Grid>> {
    let (recipe, measures) = (Recipe::default(), vec![Measure::Genga]);
    let study = Study { recipe, x, y, measures, keep_keys: true, budget: Budget::default() };
    takes.iter().map(|take| Ok(study.run(take.clip.clone(), || ())?)).collect()
}

/// The share of keys within a koma of the recipe's own, which are those of the first cell.
fn kept(grid: &Grid, cell: usize) -> f64 {
    Matching::between(keys(grid, 0), keys(grid, cell), grid.frames_in_koma).kept()
}

/// What keys as many and as far apart would share within a koma that have nothing to do with each
/// other: the mean with the second list turned round by every whole number of koma.
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
