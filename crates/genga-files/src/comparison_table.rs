//! A comparison of methods, as a table.

use crate::{csv_table, number};
use genga::error::Error;
use genga_lab::quality::Comparison;

const HEADER: [&str; 13] = [
    "clip",
    "asked",
    "method",
    "keys",
    "mean",
    "worst",
    "mean_ratio",
    "worst_ratio",
    "hits",
    "by_chance",
    "off",
    "steady",
    "ms",
];

/// Writes a row per clip, count and method. `asked` and `keys` are counts, errors are in % of body height, `off`
/// is in koma, the other columns are ratios. Cells that were not measured are empty.
///
/// # Errors
/// Fails only if memory runs out.
pub fn comparison_csv(clips: &[String], comparisons: &[Comparison]) -> Result<String, Error> {
    let some = |value: Option<f64>| value.map_or(String::new(), number);
    let rows = clips.iter().zip(comparisons).flat_map(|(clip, comparison)| {
        comparison.rows.iter().chain(&comparison.paces).map(move |row| {
            [
                clip.clone(),
                row.asked.to_string(),
                row.method.word().into(),
                row.keys.to_string(),
                number(row.mean),
                number(row.worst),
                some(row.mean_ratio),
                some(row.worst_ratio),
                some(row.hits),
                some(row.by_chance),
                some(row.off),
                some(row.steady),
                some(row.ms),
            ]
        })
    });
    csv_table(&HEADER, rows)
}
