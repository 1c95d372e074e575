//! The key-frame table: one row an exposure.

use crate::deliver::{csv_table, number};
use crate::error::Error;
use crate::motion::Clip;
use crate::sheet::{Drawing, Layer, Role, Sheet};
use crate::timing::Stills;

/// A drawing on screen for more koma than this is a hold (止メ) to a person.
const HOLD: usize = 3;

/// Fractions an animator writes on a spacing gauge (ツメ指示).
const FRACTIONS: [(f64, &str); 13] = [
    (0.0, "0"),
    (0.125, "1/8"),
    (1.0 / 6.0, "1/6"),
    (0.25, "1/4"),
    (1.0 / 3.0, "1/3"),
    (0.375, "3/8"),
    (0.5, "1/2"),
    (0.625, "5/8"),
    (2.0 / 3.0, "2/3"),
    (0.75, "3/4"),
    (5.0 / 6.0, "5/6"),
    (0.875, "7/8"),
    (1.0, "1"),
];

/// Which rows a table has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rows {
    /// Every exposure: `drawings.csv`.
    All,
    /// Genga and ends alone: `keys.csv`.
    Keys,
}

/// The key-frame table of a sheet.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawings {
    /// The name of the cut, in the first column.
    pub cut: String,
    /// Which rows it has.
    pub rows: Rows,
}

const HEADER: [&str; 16] = [
    "cut",
    "column",
    "drawing",
    "role",
    "genga_no",
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
    /// The table as CSV. Drawings, genga and koma count from 1, source frames from 0 as in the file.
    ///
    /// `on` is 1, 2 or 3 for ones, twos and threes and empty for a longer hold. `spacing_pos` is the
    /// share of the way from the kept drawing before to the next one, 0 at the first, measured along
    /// the path of the `lead_joint`: the joint that travels furthest between the two.
    ///
    /// # Errors
    /// Only when memory runs out.
    pub fn write(&self, clip: &Clip, sheet: &Sheet) -> Result<String, Error> {
        let mut rows = Vec::new();
        for layer in &sheet.layers {
            let gauge = gauge(clip, layer);
            let mut genga = 0;
            for ((begin, exposure), gauge) in layer.timed().zip(gauge) {
                let drawing = &layer.drawings[exposure.drawing];
                genga += usize::from(drawing.role.is_kept());
                if self.rows == Rows::Keys && !drawing.role.is_kept() {
                    continue;
                }
                let place = drawing.source.place();
                let genga_number = drawing.role.is_kept().then(|| genga.to_string());
                rows.push([
                    self.cut.clone(),
                    layer.name.clone(),
                    (exposure.drawing + 1).to_string(),
                    drawing.role.word().into(),
                    genga_number.unwrap_or_default(),
                    (begin + 1).to_string(),
                    exposure.koma.to_string(),
                    number(begin as f64 / sheet.clock.koma_rate),
                    number(place),
                    number(sheet.clock.seconds_from_place(place)),
                    if exposure.koma <= HOLD { exposure.koma.to_string() } else { String::new() },
                    mark(drawing, exposure.koma).into(),
                    gauge.as_ref().map(|gauge| number(gauge.share)).unwrap_or_default(),
                    gauge.as_ref().map(|gauge| fraction(gauge.share)).unwrap_or_default().into(),
                    gauge
                        .map(|gauge| clip.skeleton().joints[gauge.joint].name.clone())
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

fn fraction(share: f64) -> &'static str {
    let nearest =
        FRACTIONS.iter().min_by(|a, b| (a.0 - share).abs().total_cmp(&(b.0 - share).abs()));
    nearest.map_or("", |fraction| fraction.1)
}

/// Where a drawing stands between two kept ones.
#[derive(Clone)]
struct Gauge {
    joint: usize,
    share: f64,
}

/// The gauge of each exposure; none for the last drawing, after which nothing follows, and where
/// nothing moves.
fn gauge(clip: &Clip, layer: &Layer) -> Vec<Option<Gauge>> {
    let stills = Stills::of(clip, layer);
    let drawings: Vec<usize> = layer.exposures.iter().map(|exposure| exposure.drawing).collect();
    let kept: Vec<usize> = (0..drawings.len())
        .filter(|at| layer.drawings[drawings[*at]].role != Role::Inbetween)
        .collect();
    let mut gauge = vec![None; drawings.len()];
    let mut way = Vec::new();
    for pair in kept.windows(2) {
        let path = &drawings[pair[0]..=pair[1]];
        let length = |joint: usize| steps(&stills, path, joint).sum::<f64>();
        let Some((joint, whole)) = (0..clip.skeleton().len())
            .map(|joint| (joint, length(joint)))
            .reduce(|a, b| if b.1 > a.1 { b } else { a })
            .filter(|(_, whole)| *whole > 0.0)
        else {
            continue;
        };
        way.clear();
        way.extend(steps(&stills, path, joint).scan(0.0, |way, step| {
            *way += step;
            Some(*way)
        }));
        gauge[pair[0]] = Some(Gauge { joint, share: 0.0 });
        for (at, way) in (pair[0] + 1..pair[1]).zip(&way) {
            gauge[at] = Some(Gauge { joint, share: way / whole });
        }
    }
    gauge
}

fn steps<'a>(
    stills: &'a Stills,
    path: &'a [usize],
    joint: usize,
) -> impl Iterator<Item = f64> + 'a {
    let position = move |drawing: usize| stills.position(drawing, joint);
    path.windows(2).map(move |pair| position(pair[0]).distance(position(pair[1])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_reads_as_the_nearest_fraction() {
        assert_eq!(fraction(0.26), "1/4");
        assert_eq!(fraction(0.34), "1/3");
        assert_eq!(fraction(0.99), "1");
    }
}
