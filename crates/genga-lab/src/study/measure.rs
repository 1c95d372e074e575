//! The measures of a study, and how far the chain has to run for each.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::study::{Axis, total, union};
use genga::error::Error;
use genga::keys::{BodyTurns, LayerKeys, Origin};
use genga::maths::median;
use genga::motion::Clip;
use genga::recipe::Recipe;
use genga::sheet::Layer;
use genga::signal::Turn;
use genga::timing::Stills;

/// A measure of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Distinct frames that are a key of any joint, as the paper counts them.
    Union,
    /// Keys summed over the joints.
    Total,
    /// Turns of the body.
    #[default]
    Turns,
    /// Genga on the sheet, including the first and the last drawing.
    Genga,
    /// Genga that are neither a turn nor the first or last drawing.
    Fills,
    /// Drawings on the sheet.
    Drawings,
    /// Drawings per second.
    DrawingsPerSecond,
    /// Genga per second.
    GengaPerSecond,
    /// Length of the longest exposure, in koma.
    LongestHold,
    /// Number of koma that repeat the drawing before them.
    HeldKoma,
    /// The largest SSD between consecutive drawings on screen: the size of the worst jump.
    PeakSsd,
    /// The median SSD between consecutive drawings on screen: the size of a usual step.
    MedianSsd,
}

/// How far the chain has to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Reach {
    Joints,
    Body,
    Keys,
    Sheet,
}

/// The results of a cell; those that no measure needs are absent.
pub(super) struct Found<'a> {
    pub(super) clip: &'a Clip,
    pub(super) turns: &'a [Vec<Turn>],
    pub(super) body: Option<&'a BodyTurns>,
    pub(super) keys: Option<&'a LayerKeys>,
    /// The layer, and koma per second.
    pub(super) layer: Option<(&'a Layer, f64)>,
}

impl Found<'_> {
    /// Counts keys of an origin between the first and the last drawing; NaN if keys were not computed.
    fn keys_of(&self, is_of: impl Fn(Origin) -> bool) -> f64 {
        let count = |keys: &LayerKeys| keys.keys.iter().filter(|key| is_of(key.origin)).count();
        self.keys.map_or(f64::NAN, |keys| count(keys) as f64)
    }

    /// Returns the koma of the sheet over the koma rate; of a loop, those of a round. Where the chain made no sheet, the
    /// koma are those that the clip would have.
    pub(super) fn seconds(&self, recipe: &Recipe) -> f64 {
        let Some((layer, koma_rate)) = self.layer else {
            let koma = self.clip.rate().koma_from_frames(self.clip.len(), recipe.rate);
            return koma as f64 / recipe.rate;
        };
        let rounds = if recipe.r#loop { recipe.cycles } else { 1 };
        layer.length().max(1) as f64 / koma_rate / rounds as f64
    }
}

impl Measure {
    /// Every measure: first those of turns and keys, then those of the sheet.
    pub const ALL: [Self; 12] = [
        Self::Turns,
        Self::Genga,
        Self::Fills,
        Self::Union,
        Self::Total,
        Self::Drawings,
        Self::DrawingsPerSecond,
        Self::GengaPerSecond,
        Self::LongestHold,
        Self::HeldKoma,
        Self::PeakSsd,
        Self::MedianSsd,
    ];

    /// Returns the measures of a study that names none: those of turns and keys; all if a setting of the sheet varies.
    pub fn usual(x: &Axis, y: Option<&Axis>) -> Vec<Self> {
        if x.is_of_the_sheet() || y.is_some_and(Axis::is_of_the_sheet) {
            return Self::ALL.to_vec();
        }
        vec![Self::Turns, Self::Genga, Self::Fills, Self::Union, Self::Total]
    }

    /// Returns its name, which is also that of its column.
    pub fn name(self) -> &'static str {
        match self {
            Self::Union => "union",
            Self::Total => "total",
            Self::Turns => "turns",
            Self::Genga => "genga",
            Self::Fills => "fills",
            Self::Drawings => "drawings",
            Self::DrawingsPerSecond => "drawings_per_second",
            Self::GengaPerSecond => "genga_per_second",
            Self::LongestHold => "longest_hold",
            Self::HeldKoma => "held_koma",
            Self::PeakSsd => "peak_ssd",
            Self::MedianSsd => "median_ssd",
        }
    }

    /// Describes it in English and Japanese.
    pub fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Union => ("frames with a key of any joint", "いずれかの関節の候補があるフレーム"),
            Self::Total => ("sum of the keys of all joints", "全関節の候補の合計"),
            Self::Turns => ("turns of the whole body", "全身の変わり目"),
            Self::Genga => ("genga", "原画"),
            Self::Fills => ("genga that are not turns", "補いの原画"),
            Self::Drawings => ("drawings on the sheet", "動画枚数"),
            Self::DrawingsPerSecond => ("drawings per second", "毎秒の枚数"),
            Self::GengaPerSecond => ("genga per second", "毎秒の原画数"),
            Self::LongestHold => ("longest hold", "最長の止め"),
            Self::HeldKoma => ("held koma", "止めのコマ数"),
            Self::PeakSsd => ("largest SSD between drawings", "SSD の最大値"),
            Self::MedianSsd => ("median SSD between drawings", "SSD の中央値"),
        }
    }

    /// Returns its unit; empty for plain counts.
    pub fn unit(self) -> &'static str {
        match self {
            Self::DrawingsPerSecond | Self::GengaPerSecond => "1/s",
            Self::LongestHold | Self::HeldKoma => "koma",
            Self::PeakSsd | Self::MedianSsd => "square of the file's unit",
            Self::Union
            | Self::Total
            | Self::Turns
            | Self::Genga
            | Self::Fills
            | Self::Drawings => "",
        }
    }

    /// Whether it grows with the length of a clip, so that clips are compared per second.
    pub fn is_count(self) -> bool {
        self.unit().is_empty() || self == Self::HeldKoma
    }

    /// Whether its values are whole numbers.
    pub fn is_whole(self) -> bool {
        self.is_count() || self == Self::LongestHold
    }

    pub(super) fn reach(self) -> Reach {
        match self {
            Self::Union | Self::Total => Reach::Joints,
            Self::Turns => Reach::Body,
            Self::Fills => Reach::Keys,
            _ => Reach::Sheet,
        }
    }

    /// Returns its value; NaN if the chain did not run far enough.
    pub(super) fn evaluate(self, found: &Found<'_>) -> f64 {
        match self {
            Self::Union => union(found.turns) as f64,
            Self::Total => total(found.turns) as f64,
            Self::Turns => found.body.map_or(f64::NAN, |body| body.turns.len() as f64),
            Self::Fills => found.keys_of(|origin| origin == Origin::Fill),
            _ => found.layer.map_or(f64::NAN, |layer| self.of_layer(found.clip, layer)),
        }
    }

    fn of_layer(self, clip: &Clip, (layer, koma_rate): (&Layer, f64)) -> f64 {
        match self {
            Self::Drawings => layer.shown().count() as f64,
            Self::DrawingsPerSecond => layer.drawings_per_second(koma_rate),
            Self::Genga => layer.genga() as f64,
            Self::GengaPerSecond => layer.genga_per_second(koma_rate),
            Self::LongestHold => layer.longest_hold() as f64,
            Self::HeldKoma => layer.held_koma() as f64,
            Self::PeakSsd => steps(clip, layer).last().copied().unwrap_or(0.0),
            Self::MedianSsd => median(steps(clip, layer)).unwrap_or(0.0),
            Self::Union | Self::Total | Self::Turns | Self::Fills => f64::NAN,
        }
    }
}

/// Returns the SSD between consecutive drawings on screen, in ascending order.
fn steps(clip: &Clip, layer: &Layer) -> Vec<f64> {
    let stills = Stills::from_layer(clip, layer);
    let pairs = layer.exposures.windows(2);
    let mut steps: Vec<f64> =
        pairs.map(|pair| stills.ssd(pair[0].drawing, pair[1].drawing)).collect();
    steps.sort_by(f64::total_cmp);
    steps
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Measure {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let named = |measure: &Self| measure.name() == text.trim();
        Self::ALL.into_iter().find(named).ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            Error::setting("measure", format!("expected one of {names}, found \"{text}\""))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::swinging;
    use genga::sheet::Sheet;

    #[test]
    fn a_measure_is_called_what_its_file_calls_it() {
        for measure in Measure::ALL {
            assert_eq!(measure.name().parse::<Measure>().unwrap(), measure);
            let json = serde_json::to_string(&measure).unwrap();
            assert_eq!(json, format!("\"{measure}\""));
        }
        let said = "keys".parse::<Measure>().unwrap_err().to_string();
        assert!(said.contains("turns, genga, fills, union"), "{said}");
    }

    #[test]
    fn ssd_is_from_what_is_on_screen_to_the_next_that_is() {
        let clip = swinging(40);
        let mut layer = Sheet::on_ones(clip.clock(24.0), 5).layers.remove(0);
        let stills = Stills::from_layer(&clip, &layer);
        let of = |measure: Measure, layer: &Layer| measure.of_layer(&clip, (layer, 24.0));
        let mut steps: Vec<f64> = (0..4).map(|at| stills.ssd(at, at + 1)).collect();
        steps.sort_by(f64::total_cmp);
        assert_eq!(of(Measure::PeakSsd, &layer), steps[3]);
        assert_eq!(of(Measure::MedianSsd, &layer), 0.5 * (steps[1] + steps[2]));
        layer.exposures.remove(1);
        layer.exposures[0].koma = 2;
        assert_eq!(of(Measure::DrawingsPerSecond, &layer), 4.0 * 24.0 / 5.0);
        assert_eq!(of(Measure::HeldKoma, &layer), 1.0);
        let mut steps = [stills.ssd(0, 2), stills.ssd(2, 3), stills.ssd(3, 4)];
        steps.sort_by(f64::total_cmp);
        assert_eq!(of(Measure::PeakSsd, &layer), steps[2]);
        assert_eq!(of(Measure::MedianSsd, &layer), steps[1]);
        layer.exposures.truncate(1);
        assert_eq!(of(Measure::PeakSsd, &layer), 0.0, "one drawing jumps nowhere");
    }
}
