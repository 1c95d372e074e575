//! Compares one take in two rigs: an animator sees one motion, so the keys should be the same.

use crate::Outcome;
use crate::table::{Table, number};
use crate::takes::{MERGES, Take, named};

pub(crate) const RIGS: [&str; 2] = ["cmu-05_11-dance-pirouette", "threejs-pirouette"];

/// A table of the F1 of both rigs' genga for each merge, and their numbers.
pub(crate) fn table(takes: &[Take]) -> Outcome<String> {
    let mut table = Table::new(&[
        "`keys.merge`",
        ">genga, first rig",
        ">genga, second rig",
        ">pairs at ±1 koma",
        ">F1 at ±1 koma",
        ">by chance",
        ">F1 at ±0.5 koma",
        ">by chance",
    ]);
    for merge in MERGES {
        let [first, second] = rigs(takes, merge)?;
        table.row(&[
            merge.into(),
            first.len().to_string(),
            second.len().to_string(),
            pairs(&first, &second, 1.0).to_string(),
            number(f1(takes, merge, 1.0)?, 2),
            number(chance(&first, &second, 1.0), 2),
            number(f1(takes, merge, 0.5)?, 2),
            number(chance(&first, &second, 0.5), 2),
        ]);
    }
    Ok(table.text())
}

/// F1 = 2·pairs / (genga of both rigs), with each genga in one pair at most.
pub(crate) fn f1(takes: &[Take], merge: &str, tolerance: f64) -> Outcome<f64> {
    let [first, second] = rigs(takes, merge)?;
    Ok(share(&first, &second, tolerance))
}

fn share(first: &[f64], second: &[f64], tolerance: f64) -> f64 {
    2.0 * pairs(first, second, tolerance) as f64 / (first.len() + second.len()) as f64
}

/// The F1 by chance: the mean F1 with the second list rotated by 1, 2, 3 … koma, which keeps its size and gaps.
fn chance(first: &[f64], second: &[f64], tolerance: f64) -> f64 {
    let past = first.iter().chain(second).copied().fold(0.0, f64::max).floor() + 1.0;
    let turned = |by: usize| {
        let mut turned: Vec<f64> = second.iter().map(|koma| (koma + by as f64) % past).collect();
        turned.sort_by(f64::total_cmp);
        share(first, &turned, tolerance)
    };
    (1..past as usize).map(turned).sum::<f64>() / (past - 1.0)
}

/// Source times of both rigs' genga, in koma from frame 0 of the file.
fn rigs(takes: &[Take], merge: &str) -> Outcome<[Vec<f64>; 2]> {
    let times = |name| {
        let take = named(takes, name)?;
        let run = take.merged(merge);
        let apart = run.sheet.clock.frames_in_koma();
        Ok(run.genga().iter().map(|genga| genga.place / apart).collect())
    };
    let [first, second] = RIGS.map(times);
    first.and_then(|first| Ok([first, second?]))
}

/// Largest number of pairs no further apart than `tolerance`. Both lists are sorted, so taking the first that fits is
/// optimal.
fn pairs(first: &[f64], second: &[f64], tolerance: f64) -> usize {
    let (mut a, mut b, mut pairs) = (0, 0, 0);
    while a < first.len() && b < second.len() {
        // The epsilon makes 5 frames at 120 fps one koma whatever the rounding.
        if (first[a] - second[b]).abs() <= tolerance + 1e-9 {
            (a, b, pairs) = (a + 1, b + 1, pairs + 1);
        } else if first[a] < second[b] {
            a += 1;
        } else {
            b += 1;
        }
    }
    pairs
}
