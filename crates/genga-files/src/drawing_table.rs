//! The key-frame table: one row per exposure.

use crate::{csv_table, number};
use genga::error::Error;
use genga::motion::{Clip, JointId, played_out};
use genga::sheet::{Drawing, Layer, Number, Reason, Sheet};
use genga::timing::{Gauge, fraction};

/// Number of koma above which an exposure is marked as a hold (止メ).
const HOLD: usize = 3;

/// The rows of a key-frame table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// Every exposure: `drawings.csv`.
    All,
    /// Genga and ends only: `keys.csv`.
    Keys,
}

/// The key-frame table of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawings {
    /// The name of the cut, in the first column.
    pub cut: String,
    /// The rows to include.
    pub rows: Rows,
}

const HEADER: [&str; 17] = [
    "cut",
    "column",
    "drawing",
    "role",
    "genga_no",
    "reason",
    "koma_first",
    "koma_count",
    "time_s",
    "source_frame",
    "source_time_s",
    "on",
    "mark",
    "spacing_pos",
    "spacing_fraction",
    "lead_joint",
    "note",
];

impl Drawings {
    /// Writes the table as CSV, with the numbers of drawings and genga as on paper. Koma count from 1, source frames
    /// from 0 as in the file.
    ///
    /// `on` is 1, 2 or 3 for ones, twos and threes and empty for a longer hold. `spacing_pos` is the share of
    /// the way from the previous kept drawing to the next one, 0 at the first. It is measured along the path
    /// of the `lead_joint`, the joint that travels furthest between the two.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::check`].
    pub fn write(&self, clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
        sheet.check()?;
        let mut rows = Vec::new();
        // The way over a seam shows only where the rounds follow each other.
        let (played_clip, played) = played_out(clip, sheet);
        for (layer, played) in sheet.layers.iter().zip(&played.layers) {
            let gauge = gauge(&played_clip, played);
            let (numbers, genga) = (layer.numbers(), layer.genga_numbers());
            for ((begin, exposure), gauge) in layer.timed().zip(gauge) {
                let begin = sheet.blank.before + begin;
                let drawing = &layer.drawings[exposure.drawing];
                if self.rows == Rows::Keys && !drawing.role.is_kept() {
                    continue;
                }
                let place = drawing.source.place();
                let genga_number = genga[exposure.drawing].as_ref().map(Number::to_string);
                rows.push([
                    self.cut.clone(),
                    layer.name.clone(),
                    numbers[exposure.drawing].to_string(),
                    drawing.role.word().into(),
                    genga_number.unwrap_or_default(),
                    drawing.why.reason.map_or("", Reason::word).into(),
                    (begin + 1).to_string(),
                    exposure.koma.to_string(),
                    number(begin as f64 / sheet.clock.koma_rate),
                    number(place),
                    number(sheet.clock.seconds_from_place(place)),
                    if exposure.koma <= HOLD { exposure.koma.to_string() } else { String::new() },
                    mark(drawing, exposure.koma).into(),
                    gauge.map(|(_, share)| number(share)).unwrap_or_default(),
                    gauge.map(|(_, share)| fraction(share)).unwrap_or_default().into(),
                    gauge
                        .map(|(joint, _)| clip.skeleton().joints[joint.0].name.clone())
                        .unwrap_or_default(),
                    drawing.why.to_string(),
                ]);
            }
        }
        csv_table(&HEADER, rows)
    }
}

fn mark(drawing: &Drawing, koma: usize) -> &'static str {
    if drawing.why.omitted_before > 0 {
        "nakanashi"
    } else if koma > HOLD {
        "hold"
    } else {
        ""
    }
}

/// The lead joint of each exposure and its share of the way; `None` for the last drawing and for
/// intervals without movement.
fn gauge(clip: &Clip, layer: &Layer) -> Vec<Option<(JointId, f64)>> {
    let mut shares = vec![None; layer.exposures.len()];
    for gauge in Gauge::from_layer(clip, layer) {
        // Leave out the closing key: it is the first of the next gauge.
        let own = &gauge.shares[..gauge.shares.len() - 1];
        for (at, share) in own.iter().enumerate() {
            shares[gauge.first + at] = Some((gauge.joint, *share));
        }
    }
    shares
}
