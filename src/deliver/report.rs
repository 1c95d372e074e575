//! What a run gave, in numbers: for a person's summary and for `report.json`.

use serde::Serialize;

use crate::error::Error;
use crate::keys::{Action, Actions, Phase, Walk};
use crate::motion::SeenFrom;
use crate::pipeline::{Breakdown, LayerBreakdown};
use crate::{study, timing};

/// The figures of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Frames that were worked on.
    pub frames: usize,
    /// The number of the first of them in the file.
    pub first_frame: usize,
    /// Frames a second of the source.
    pub frame_rate: f64,
    /// Joints.
    pub joints: usize,
    /// Seconds from the first frame to the last.
    pub seconds: f64,
    /// From where movement was measured, in the words of the recipe; none in the world.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_from: Option<String>,
    /// Koma of the sheet.
    pub koma: usize,
    /// Koma a second.
    pub koma_rate: f64,
    /// How much of the motion counts as drawn, 0 to 1; of several layers that of the first.
    pub drawn: f64,
    /// Turns over all joints, and distinct frames among them.
    pub turns: Turns,
    /// Key candidates of the layer, before it was asked what they are worth.
    pub candidates: usize,
    /// Genga on the sheet, the first and the last drawing among them.
    pub genga: usize,
    /// Genga a second.
    pub genga_per_second: f64,
    /// Genga that were worth a drawing and went because there were too many a second.
    pub genga_over_limit: usize,
    /// Drawings on the sheet.
    pub drawings: usize,
    /// Drawings a second.
    pub drawings_per_second: f64,
    /// Drawings before anything was left out.
    pub drawings_before_omission: usize,
    /// Koma of the longest exposure.
    pub longest_hold: usize,
    /// Koma that repeat the drawing before them.
    pub held_koma: usize,
    /// Inbetweens asked for that did not fit between their keys.
    pub inbetweens_that_did_not_fit: usize,
    /// The actions that the take consists of, in order; none where it is one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actions: Vec<Action>,
    /// The gaits whose steps have the same drawings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaits: Vec<GaitReport>,
    /// What was left out.
    pub omission: OmissionCounts,
    /// The layers, where there are several; candidates, genga, drawings and what was left out are then those
    /// of the first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<LayerReport>,
    /// What the files of formats lack and should have, as sentences: said with the first line of a run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub losses: Vec<String>,
    /// What a person should know, as sentences.
    pub notes: Vec<String>,
}

/// The figures of one of several layers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LayerReport {
    /// Its name, that of the column.
    pub name: String,
    /// Its joints.
    pub joints: Vec<String>,
    /// How much of its motion counts as drawn, 0 to 1.
    pub drawn: f64,
    /// Genga, the first and the last drawing among them.
    pub genga: usize,
    /// Drawings.
    pub drawings: usize,
    /// Drawings a second.
    pub drawings_per_second: f64,
    /// Koma of the longest exposure.
    pub longest_hold: usize,
    /// What was left out.
    pub omission: OmissionCounts,
}

/// A gait (歩き) whose steps have the same drawings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GaitReport {
    /// Its steps, but for those that a person corrects.
    pub steps: usize,
    /// Koma of the step in the middle, with a fraction.
    pub koma: f64,
    /// What each step has a genga of, in order.
    pub phases: Vec<&'static str>,
}

impl From<&Walk> for GaitReport {
    fn from(walk: &Walk) -> Self {
        Self {
            steps: walk.steps.len(),
            koma: (walk.koma * 100.0).round() / 100.0,
            phases: walk.phases.iter().copied().map(Phase::word).collect(),
        }
    }
}

/// Key turns of all joints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Turns {
    /// Sum over the joints.
    pub total: usize,
    /// Distinct frames.
    pub union: usize,
}

/// What was asked of the omission stages and what could be done, in drawings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OmissionCounts {
    /// To be left out by naka-nashi.
    pub naka_nashi_asked: usize,
    /// Left out by naka-nashi.
    pub naka_nashi_done: usize,
    /// To be held over by koma-dori.
    pub koma_dori_asked: usize,
    /// Held over by koma-dori.
    pub koma_dori_done: usize,
}

impl From<&timing::OmissionReport> for OmissionCounts {
    fn from(report: &timing::OmissionReport) -> Self {
        Self {
            naka_nashi_asked: report.naka_nashi.asked,
            naka_nashi_done: report.naka_nashi.done,
            koma_dori_asked: report.koma_dori.asked,
            koma_dori_done: report.koma_dori.done,
        }
    }
}

/// The figures of each layer; none of a single one.
fn layers(breakdown: &Breakdown<'_>) -> Vec<LayerReport> {
    let report = |LayerBreakdown { layer, omission, drawn, .. }: LayerBreakdown<'_>| LayerReport {
        name: layer.name.clone(),
        joints: layer.joints.clone(),
        drawn,
        genga: layer.genga(),
        drawings: layer.shown().count(),
        drawings_per_second: layer.shown().count() as f64 * breakdown.clock.koma_rate
            / layer.length() as f64,
        longest_hold: layer.longest_hold(),
        omission: omission.into(),
    };
    let layers = breakdown.layers();
    if layers.len() > 1 { layers.map(report).collect() } else { Vec::new() }
}

impl Report {
    /// Its text.
    ///
    /// # Errors
    /// [`Error::Encoding`] never happens: it is plain data.
    pub fn write(&self) -> Result<String, Error> {
        let text = serde_json::to_string_pretty(self);
        text.map(|text| text + "\n")
            .map_err(|source| Error::Encoding { what: "a report", source: source.into() })
    }

    /// The figures of a breakdown; `notes` are the reader's and the program's own words.
    pub fn of(breakdown: &Breakdown<'_>, notes: Vec<String>) -> Self {
        let layer = &breakdown.sheet.layers[0];
        let koma = layer.length();
        let koma_rate = breakdown.clock.koma_rate;
        let per_second = |count: usize| count as f64 * koma_rate / koma as f64;
        let first = breakdown.first_layer();
        Self {
            frames: breakdown.clip.len(),
            first_frame: breakdown.clip.first().0,
            frame_rate: breakdown.clip.rate().fps(),
            joints: breakdown.clip.skeleton().len(),
            seconds: breakdown.clip.seconds(),
            seen_from: seen_from(breakdown.seen_from),
            koma,
            koma_rate,
            drawn: first.drawn,
            turns: Turns {
                total: study::total(breakdown.turns),
                union: study::union(breakdown.turns),
            },
            candidates: first.candidates.keys.len(),
            genga: layer.genga(),
            genga_per_second: per_second(layer.genga()),
            genga_over_limit: first.keys.over_limit,
            drawings: layer.shown().count(),
            drawings_per_second: per_second(layer.shown().count()),
            drawings_before_omission: breakdown.spaced.layers[0].drawings.len(),
            longest_hold: layer.longest_hold(),
            held_koma: layer.held_koma(),
            inbetweens_that_did_not_fit: first.did_not_fit,
            actions: several(breakdown.actions),
            gaits: first.keys.gaits.iter().map(GaitReport::from).collect(),
            omission: first.omission.into(),
            layers: layers(breakdown),
            losses: Vec::new(),
            notes,
        }
    }
}

/// From where movement was measured; none in the world.
fn seen_from(seen_from: SeenFrom) -> Option<String> {
    (!seen_from.is_world()).then(|| seen_from.to_string())
}

/// The actions of a take; none for one that is whole.
fn several(actions: &Actions) -> Vec<Action> {
    if actions.splits().is_empty() { Vec::new() } else { actions.iter().collect() }
}
