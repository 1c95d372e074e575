//! Layers, drawings and exposures as laid out in the file.

use serde::{Deserialize, Serialize};

use genga::sheet::{
    Drawing, Exposure, Gone, Layer, Number, Numbers, Role, Source, Why, is_default,
};

/// A layer.
#[derive(Debug, Serialize)]
pub(super) struct LayerLines {
    name: String,
    #[serde(skip_serializing_if = "is_default")]
    joints: Vec<String>,
    drawings: Vec<DrawingLine>,
    exposures: Vec<Exposure>,
    #[serde(skip_serializing_if = "is_default")]
    gone: Vec<Gone>,
}

/// A drawing as a line: its number, its role, the source of its pose, and why it was drawn.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a drawing {\"drawing\", \"role\", \"frame\"}")]
pub(super) struct DrawingLine {
    /// Number by which exposures refer to it.
    pub(super) drawing: usize,
    /// Its number on paper, if it comes from an earlier sheet.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    name: Option<Number>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    genga_no: Option<Number>,
    role: Role,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    frame: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    between: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    share: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    why: Why,
}

impl LayerLines {
    /// Lays out a layer whose drawings have the numbers from `first` on.
    pub(super) fn new(layer: &Layer, first: usize) -> Self {
        let numbered =
            |exposure: &Exposure| Exposure { drawing: first + exposure.drawing, ..*exposure };
        let drawings = (first..).zip(&layer.drawings);
        Self {
            name: layer.name.clone(),
            joints: layer.joints.clone(),
            drawings: drawings.map(|(number, drawing)| DrawingLine::new(number, drawing)).collect(),
            exposures: layer.exposures.iter().map(numbered).collect(),
            gone: layer.gone.clone(),
        }
    }
}

impl DrawingLine {
    fn new(number: usize, drawing: &Drawing) -> Self {
        let (frame, between, share) = match drawing.source {
            Source::At(place) => (Some(place), None, None),
            Source::Between { from, to, share } => (None, Some([from, to]), Some(share)),
        };
        let Drawing { role, why, numbers, .. } = drawing.clone();
        let Numbers { drawing: name, genga: genga_no } = numbers;
        Self { drawing: number, name, genga_no, role, frame, between, share, why }
    }

    /// Converts the line to a drawing, or returns what is wrong with it.
    pub(super) fn drawing(self) -> Result<Drawing, &'static str> {
        let source = match (self.frame, self.between, self.share) {
            (Some(place), None, None) => Source::At(place),
            (None, Some([from, to]), Some(share)) => Source::Between { from, to, share },
            _ => {
                return Err("a drawing shows a source frame, \"frame\": 42, or a blend of two, \
                            \"between\": [42, 48], \"share\": 0.5");
            }
        };
        let numbers = Numbers { drawing: self.name, genga: self.genga_no };
        Ok(Drawing { source, role: self.role, why: self.why, numbers })
    }
}
