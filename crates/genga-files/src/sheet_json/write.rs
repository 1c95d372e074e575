//! Writes a sheet.

use serde::Serialize;
use serde_json::Serializer;

use super::layer::LayerLines;
use super::lines::Lines;
use super::{MadeOf, MadeWith, SCHEMA, SheetFile, digest};
use crate::Cut;
use genga::error::Error;
use genga::exaggerate::Exaggerate;
use genga::sheet::{CameraWork, Feet, Repeat, RootMotion, SpokenLine, is_default};
use genga::slate::Slate;

/// The sheet of a cut as `sheet.json`.
///
/// # Errors
/// [`Error::Sheet`] if the sheet does not belong to the clip: see [`SheetFile::write`].
pub fn write(cut: &Cut<'_>) -> Result<String, Error> {
    SheetFile::new(cut).write()
}

/// The file's fields, in their order.
#[derive(Serialize)]
struct Written<'a> {
    schema: &'static str,
    genga: &'a str,
    cut: &'a str,
    #[serde(skip_serializing_if = "Slate::is_empty")]
    slate: &'a Slate,
    fps: f64,
    frame_base: u8,
    clip: &'a MadeOf,
    #[serde(skip_serializing_if = "Option::is_none")]
    made_with: Option<&'a MadeWith>,
    #[serde(skip_serializing_if = "Exaggerate::is_off")]
    exaggerate: &'a Exaggerate,
    #[serde(skip_serializing_if = "is_default")]
    root: RootMotion,
    #[serde(skip_serializing_if = "is_default")]
    feet: Feet,
    #[serde(rename = "loop", skip_serializing_if = "Option::is_none")]
    repeat: Option<Repeat>,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<usize>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    lines: Vec<SpokenLine>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    camera: Vec<CameraWork>,
    layers: Vec<LayerLines>,
}

impl SheetFile {
    /// Builds the contents of `sheet.json` for a cut.
    pub fn new(cut: &Cut<'_>) -> Self {
        let (source, exaggerate) = match cut.exaggerated {
            Some((source, exaggerate)) => (source, exaggerate.clone()),
            None => (cut.clip, Exaggerate::default()),
        };
        Self {
            cut: cut.name.into(),
            genga: env!("CARGO_PKG_VERSION").into(),
            clip: MadeOf::new(cut.clip_file, source),
            exaggerate,
            made_with: cut.made_with.cloned(),
            sheet: cut.sheet.clone(),
        }
    }

    /// Whether layers, root, feet and exaggeration are unchanged since they were made. `false` for a sheet without a
    /// record, because it may be a person's work.
    pub fn is_as_made(&self) -> bool {
        let made = self.made_with.as_ref();
        made.is_some_and(|made| made.layers == digest::sheet(&self.sheet, &self.exaggerate))
    }

    /// Writes the file in a readable layout. The same sheet always gives the same bytes.
    ///
    /// # Errors
    /// [`Error::Sheet`] if the sheet does not begin on its clip's first frame, has another rate, a place outside
    /// the clip, or an exposure of no koma or of a missing drawing.
    pub fn write(&self) -> Result<String, Error> {
        self.check()?;
        let blank = self.sheet.blank;
        let file = Written {
            schema: SCHEMA,
            genga: &self.genga,
            cut: &self.cut,
            slate: &self.sheet.slate,
            fps: self.sheet.clock.koma_rate,
            frame_base: 0,
            clip: &self.clip,
            made_with: self.made_with.as_ref(),
            exaggerate: &self.exaggerate,
            root: self.sheet.root,
            feet: self.sheet.feet,
            repeat: self.sheet.repeat,
            at: (blank.before > 0).then_some(blank.before + 1),
            length: (blank.after > 0).then(|| self.sheet.cut_length()),
            lines: self.sheet.lines.iter().map(from_1).collect(),
            camera: self.sheet.camera.iter().map(work_from_1).collect(),
            layers: self.sheet.layers.iter().map(|layer| LayerLines::new(layer, 1)).collect(),
        };
        let mut bytes = Vec::new();
        file.serialize(&mut Serializer::with_formatter(&mut bytes, Lines::default()))
            .map_err(|error| Error::Encoding { what: "the sheet", source: error.into() })?;
        bytes.push(b'\n');
        Ok(String::from_utf8(bytes).expect("JSON is text"))
    }
}

/// Counts the koma of camera work from 1.
fn work_from_1(work: &CameraWork) -> CameraWork {
    CameraWork { begin: work.begin + 1, ..work.clone() }
}

/// Counts the koma of a spoken line from 1.
fn from_1(line: &SpokenLine) -> SpokenLine {
    SpokenLine { begin: line.begin + 1, ..line.clone() }
}
