//! The result of a run in numbers: for the summary on screen and for `report.json`.

use serde::Serialize;

use genga::error::Error;
use genga::keys::{Action, Actions, Phase, Walk};
use genga::motion::SeenFrom;
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::sheet::Layer;
use genga::timing;
use genga_lab::study;

/// The figures of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Number of frames that were used.
    pub frames: usize,
    /// Number of the first used frame in the file.
    pub first_frame: usize,
    /// Frames per second of the source.
    pub frame_rate: f64,
    /// Number of joints.
    pub joints: usize,
    /// Seconds from the first frame to the last.
    pub seconds: f64,
    /// Camera in which movement was measured, as the recipe writes it; `None` for world space.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_from: Option<String>,
    /// Number of koma of the sheet.
    pub koma: usize,
    /// Koma per second.
    pub koma_rate: f64,
    /// Degree to which the motion counts as hand-drawn, 0 (captured) to 1; with several layers, that of the first.
    pub drawn: f64,
    /// Key turns of all joints.
    pub turns: Turns,
    /// Number of key candidates of the first layer, before they are scored.
    pub candidates: usize,
    /// Number of genga on the sheet, the first and the last drawing included.
    pub genga: usize,
    /// Genga per second.
    pub genga_per_second: f64,
    /// Number of keys that were worth a drawing but were dropped to stay below the limit per second.
    pub genga_over_limit: usize,
    /// Number of drawings on the sheet.
    pub drawings: usize,
    /// Drawings per second.
    pub drawings_per_second: f64,
    /// Number of drawings before omission.
    pub drawings_before_omission: usize,
    /// Koma of the longest exposure.
    pub longest_hold: usize,
    /// Number of koma that repeat the drawing before them.
    pub held_koma: usize,
    /// Number of requested inbetweens that did not fit between their keys.
    pub inbetweens_that_did_not_fit: usize,
    /// The actions of the take, in order; empty for a single action.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub actions: Vec<Action>,
    /// The round of a loop; `None` for a sheet that is played once.
    #[serde(rename = "loop", skip_serializing_if = "Option::is_none")]
    pub repeat: Option<LoopReport>,
    /// The gaits whose steps have the same drawings.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gaits: Vec<GaitReport>,
    /// Drawings left out by the omission stages.
    pub omission: OmissionCounts,
    /// The layers, if there are several. Candidates, genga, drawings and omission above are then those of the first.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub layers: Vec<LayerReport>,
    /// Losses in the written files, such as missing motion, as sentences. Shown with the first line of a run.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub losses: Vec<String>,
    /// Notes for the user, as sentences.
    pub notes: Vec<String>,
}

/// The round of a loop (リピート).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LoopReport {
    /// Number of koma of a round on the sheet.
    pub koma: usize,
    /// Koma that the round lasts in the source; a sheet has whole ones.
    pub source_koma: f64,
    /// Number of rounds on the sheet.
    pub rounds: usize,
    /// Source frame of the first drawing.
    pub from_frame: f64,
}

/// The figures of one of several layers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LayerReport {
    /// Name of the layer and its column.
    pub name: String,
    /// Its joints.
    pub joints: Vec<String>,
    /// Degree to which its motion counts as hand-drawn, 0 (captured) to 1.
    pub drawn: f64,
    /// Number of genga, the first and the last drawing included.
    pub genga: usize,
    /// Number of drawings.
    pub drawings: usize,
    /// Drawings per second.
    pub drawings_per_second: f64,
    /// Koma of the longest exposure.
    pub longest_hold: usize,
    /// Drawings left out by the omission stages.
    pub omission: OmissionCounts,
}

/// A gait (歩き) whose steps have the same drawings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GaitReport {
    /// Number of steps, without those that a person corrected.
    pub steps: usize,
    /// Koma of the median step, with a fraction.
    pub koma: f64,
    /// The phases at which each step has a genga, in order.
    pub phases: Vec<&'static str>,
}

impl From<&Walk> for GaitReport {
    fn from(walk: &Walk) -> Self {
        Self {
            steps: walk.regular().count(),
            koma: (walk.koma * 100.0).round() / 100.0,
            phases: walk.phases.iter().copied().map(Phase::word).collect(),
        }
    }
}

/// Key turns of all joints.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Turns {
    /// Number of turns, summed over the joints.
    pub total: usize,
    /// Number of distinct frames among them.
    pub union: usize,
}

/// Drawings that the omission stages were asked to leave out, and those they did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OmissionCounts {
    /// Drawings to leave out by naka-nashi.
    pub naka_nashi_asked: usize,
    /// Drawings left out by naka-nashi.
    pub naka_nashi_done: usize,
    /// Drawings to cover by holds (koma-dori).
    pub koma_dori_asked: usize,
    /// Drawings covered by holds (koma-dori).
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

/// The figures of each layer; empty if there is only one.
fn layers(breakdown: &Breakdown<'_>) -> Vec<LayerReport> {
    // On the sheet all layers end together, and holds by hand count.
    let report = |(of, layer): (LayerBreakdown<'_>, &Layer)| LayerReport {
        name: layer.name.clone(),
        joints: layer.joints.clone(),
        drawn: of.drawn,
        genga: layer.genga(),
        drawings: layer.shown().count(),
        drawings_per_second: layer.drawings_per_second(breakdown.clock.koma_rate),
        longest_hold: layer.longest_hold(),
        omission: of.omission.into(),
    };
    let layers = breakdown.layers().zip(&breakdown.sheet.layers);
    if layers.len() > 1 { layers.map(report).collect() } else { Vec::new() }
}

impl Report {
    /// Writes the report as JSON.
    ///
    /// # Errors
    /// Never fails in practice, because the report is plain data; the signature allows [`Error::Encoding`].
    pub fn write(&self) -> Result<String, Error> {
        let text = serde_json::to_string_pretty(self);
        text.map(|text| text + "\n")
            .map_err(|source| Error::Encoding { what: "a report", source: source.into() })
    }

    /// Collects the figures of a breakdown. `notes` come from the reader and the program.
    pub fn new(breakdown: &Breakdown<'_>, notes: Vec<String>) -> Self {
        let layer = &breakdown.sheet.layers[0];
        let koma = layer.length();
        let koma_rate = breakdown.clock.koma_rate;
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
            genga_per_second: layer.genga_per_second(koma_rate),
            genga_over_limit: first.keys.over_limit,
            drawings: layer.shown().count(),
            drawings_per_second: layer.drawings_per_second(koma_rate),
            drawings_before_omission: breakdown.spaced.layers[0].drawings.len(),
            longest_hold: layer.longest_hold(),
            held_koma: layer.held_koma(),
            inbetweens_that_did_not_fit: first.did_not_fit,
            actions: several(breakdown.actions),
            repeat: repeat(breakdown),
            gaits: first.keys.gaits.iter().map(GaitReport::from).collect(),
            omission: first.omission.into(),
            layers: layers(breakdown),
            losses: Vec::new(),
            notes,
        }
    }
}

/// Camera in which movement was measured; `None` for world space.
fn seen_from(seen_from: SeenFrom) -> Option<String> {
    (!seen_from.is_world()).then(|| seen_from.to_string())
}

/// The round of a loop; `None` if the sheet is played once.
fn repeat(breakdown: &Breakdown<'_>) -> Option<LoopReport> {
    let (sheet, clock) = (breakdown.sheet, breakdown.clock);
    let frames = sheet.repeat?.frames as f64;
    let rounds = sheet.rounds();
    Some(LoopReport {
        koma: sheet.length() / rounds,
        source_koma: (1e3 * frames / clock.frames_in_koma()).round() / 1e3,
        rounds,
        from_frame: sheet.layers[0].shown_at(0)?.source.place(),
    })
}

/// The actions of a take; empty if it is a single action.
fn several(actions: &Actions) -> Vec<Action> {
    if actions.splits().is_empty() { Vec::new() } else { actions.iter().collect() }
}
