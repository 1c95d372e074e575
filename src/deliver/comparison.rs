//! Methods side by side, as a table.

use crate::deliver::{csv_table, number};
use crate::error::Error;
use crate::quality::Comparison;

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

/// A row a clip, count and method: `asked` and `keys` are counts, errors are in % of body height, `off`
/// is in koma, the others are shares and multiples. What was not measured is empty.
///
/// # Errors
/// Only when memory runs out.
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
