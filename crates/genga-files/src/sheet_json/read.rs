//! Reads a sheet and reports mistakes with their place.

use std::collections::HashMap;

use serde::Deserialize;
use serde_json::value::RawValue;

use super::layer::DrawingLine;
use super::text::Text;
use super::{MadeOf, MadeWith, SCHEMA, SCHEMA_FROM_0, SheetFile, check};
use genga::error::Error;
use genga::exaggerate::Exaggerate;
use genga::sheet::{Blank, CameraWork, Exposure, Gone, Layer, Repeat, Sheet, SpokenLine};
use genga::slate::Slate;
use genga::time::{Clock, Frame, FrameRate};

/// The part common to all versions of the schema.
#[derive(Deserialize)]
struct AnyVersion<'a> {
    #[serde(borrow)]
    schema: Option<&'a RawValue>,
}

/// The file. Parts that are checked in detail stay raw and are parsed separately, so that their place is known.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a sheet")]
struct Written<'a> {
    #[serde(borrow, rename = "schema")]
    _schema: &'a RawValue,
    #[serde(default)]
    genga: String,
    cut: String,
    #[serde(borrow)]
    slate: Option<&'a RawValue>,
    #[serde(borrow)]
    fps: &'a RawValue,
    #[serde(borrow)]
    frame_base: &'a RawValue,
    #[serde(borrow)]
    clip: &'a RawValue,
    #[serde(borrow)]
    made_with: Option<&'a RawValue>,
    #[serde(borrow)]
    exaggerate: Option<&'a RawValue>,
    #[serde(borrow)]
    root: Option<&'a RawValue>,
    #[serde(borrow)]
    feet: Option<&'a RawValue>,
    #[serde(borrow, rename = "loop")]
    repeat: Option<&'a RawValue>,
    #[serde(borrow)]
    at: Option<&'a RawValue>,
    #[serde(borrow)]
    length: Option<&'a RawValue>,
    #[serde(borrow)]
    lines: Option<&'a RawValue>,
    #[serde(borrow)]
    camera: Option<&'a RawValue>,
    #[serde(borrow)]
    layers: Vec<&'a RawValue>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a layer {\"name\", \"drawings\", \"exposures\"}")]
struct WrittenLayer<'a> {
    name: String,
    #[serde(default)]
    joints: Vec<String>,
    #[serde(borrow)]
    drawings: Vec<&'a RawValue>,
    #[serde(borrow)]
    exposures: Vec<&'a RawValue>,
    #[serde(borrow, default)]
    gone: Vec<&'a RawValue>,
}

/// Reads a `sheet.json`.
///
/// The number by which exposures refer to a drawing may be any that is unique in its layer. The drawings keep the order
/// of the list, whatever it is.
///
/// # Errors
/// [`Error::Sheet`] with line and column if the text is not such a file, has another schema version, or
/// is inconsistent.
pub fn read(bytes: &[u8]) -> Result<SheetFile, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes)
        .map_err(|_| Error::sheet("this is not text in UTF-8; a sheet is JSON"))?;
    let text = Text(text);
    let first = first_number(text)?;
    let written: Written<'_> = text.whole()?;
    if written.frame_base.get() != "0" {
        let message = "frame_base is 0 in this schema: frames count from 0";
        return Err(text.error(written.frame_base, message));
    }
    let clip: MadeOf = text.value(written.clip)?;
    let frame_rate = FrameRate::new(clip.frame_rate)
        .map_err(|error| text.error(written.clip, error.to_string()))?;
    let koma_rate = text.value(written.fps)?;
    check::koma_rate(koma_rate).map_err(|message| text.error(written.fps, message))?;
    let clock = Clock { first: Frame(clip.first_frame), frame_rate, koma_rate };
    let mut length = 0;
    let layers =
        written.layers.into_iter().map(|raw| layer(text, raw, (&clip, first), &mut length));
    let layers: Vec<Layer> = layers.collect::<Result<_, _>>()?;
    let root = written.root.map(|raw| text.value(raw)).transpose()?.unwrap_or_default();
    let feet = written.feet.map(|raw| text.value(raw)).transpose()?.unwrap_or_default();
    let repeat = written.repeat.map(|raw| repeat(text, raw, &clip)).transpose()?;
    let lines = written.lines.map(|raw| lines(text, raw, first)).transpose()?.unwrap_or_default();
    let camera = written.camera.map(|raw| camera(text, raw)).transpose()?.unwrap_or_default();
    let slate = written.slate.map(|raw| slate(text, raw)).transpose()?.unwrap_or_default();
    let blank = blank(text, (written.at, written.length), &layers)?;
    let exaggerate = match written.exaggerate {
        None => Exaggerate::default(),
        Some(raw) => exaggeration(text, raw)?,
    };
    let made_with: Option<MadeWith> = written.made_with.map(|raw| text.value(raw)).transpose()?;
    let file = SheetFile {
        cut: written.cut,
        genga: written.genga,
        clip,
        exaggerate,
        made_with,
        sheet: Sheet { clock, layers, root, feet, lines, repeat, camera, blank, slate },
    };
    file.check()?;
    Ok(file)
}

/// Reads the round of a loop, which is the whole clip.
fn repeat(text: Text<'_>, raw: &RawValue, clip: &MadeOf) -> Result<Repeat, Error> {
    let repeat: Repeat = text.value(raw)?;
    check::repeat(repeat, clip).map_err(|message| text.error(raw, message))?;
    Ok(repeat)
}

fn exaggeration(text: Text<'_>, raw: &RawValue) -> Result<Exaggerate, Error> {
    let exaggerate: Exaggerate = text.value(raw)?;
    exaggerate.validate().map_err(|error| text.error(raw, error.to_string()))?;
    Ok(exaggerate)
}

fn camera(text: Text<'_>, raw: &RawValue) -> Result<Vec<CameraWork>, Error> {
    let written: Vec<CameraWork> = text.value(raw)?;
    let work = |work: CameraWork| match work.begin.checked_sub(1) {
        Some(begin) => Ok(CameraWork { begin, ..work }),
        None => Err(text.error(raw, "camera work begins on koma 0; koma count from 1")),
    };
    written.into_iter().map(work).collect()
}

fn slate(text: Text<'_>, raw: &RawValue) -> Result<Slate, Error> {
    let slate: Slate = text.value(raw)?;
    slate.validate().map_err(|error| text.error(raw, error.to_string()))?;
    Ok(slate)
}

/// Reads the koma on which the first drawing stands and the length of the cut, as blank koma.
fn blank(
    text: Text<'_>,
    (at, length): (Option<&RawValue>, Option<&RawValue>),
    layers: &[Layer],
) -> Result<Blank, Error> {
    let before = match at {
        None => 0,
        Some(raw) => text.value::<usize>(raw)?.checked_sub(1).ok_or_else(|| {
            text.error(raw, "at is the koma on which the first drawing stands; koma count from 1")
        })?,
    };
    let drawn = layers.iter().map(Layer::length).max().unwrap_or(0);
    let end = before.saturating_add(drawn);
    let after = match length {
        None => 0,
        Some(raw) => text.value::<usize>(raw)?.checked_sub(end).ok_or_else(|| {
            let message =
                format!("the drawings end on koma {end}; length is that of the cut, {end} or more");
            text.error(raw, message)
        })?,
    };
    Ok(Blank { before, after })
}

/// Checks the version, and returns the number of the first drawing and koma in it.
fn first_number(text: Text<'_>) -> Result<usize, Error> {
    if !text.0.trim_start().starts_with('{') {
        let is_motion = text.0.trim_start().starts_with("HIERARCHY");
        let way_out = if is_motion { "; a sheet stands first, its motion second" } else { "" };
        let message =
            format!("this is no sheet of genga, which is JSON and begins with {{{way_out}");
        return Err(Error::sheet(message));
    }
    let AnyVersion { schema } = text.whole()?;
    let Some(raw) = schema else {
        let message = format!("this is no sheet of genga: it has no \"schema\": \"{SCHEMA}\"");
        return Err(Error::sheet(message));
    };
    match text.value::<String>(raw)? {
        version if version == SCHEMA => Ok(1),
        version if version == SCHEMA_FROM_0 => Ok(0),
        other => Err(text.error(
            raw,
            format!(
                "the sheet is of the schema {other}, and this genga reads {SCHEMA_FROM_0} and {SCHEMA}; the \
                 genga that wrote it reads it"
            ),
        )),
    }
}

/// Reads the spoken lines, whose koma count from `first`.
fn lines(text: Text<'_>, raw: &RawValue, first: usize) -> Result<Vec<SpokenLine>, Error> {
    let written: Vec<SpokenLine> = text.value(raw)?;
    let line = |line: SpokenLine| match line.begin.checked_sub(first) {
        Some(begin) => Ok(SpokenLine { begin, ..line }),
        None => Err(text.error(raw, "a spoken line begins on koma 0; koma count from 1")),
    };
    written.into_iter().map(line).collect()
}

/// Reads a layer, whose drawings count from `first`. `length` is the total koma of the layers before it, to which its
/// own are added.
fn layer(
    text: Text<'_>,
    raw: &RawValue,
    (clip, first): (&MadeOf, usize),
    length: &mut usize,
) -> Result<Layer, Error> {
    let written: WrittenLayer<'_> = text.value(raw)?;
    check::joints(&written.joints, clip).map_err(|message| text.error(raw, message))?;
    let mut numbers = HashMap::new();
    let mut drawings = Vec::with_capacity(written.drawings.len());
    for raw in written.drawings {
        let line: DrawingLine = text.value(raw)?;
        let number = line.drawing;
        if number < first {
            let message = format!("this is drawing {number}; drawings count from {first}");
            return Err(text.error(raw, message));
        }
        if numbers.insert(number, drawings.len()).is_some() {
            let message =
                format!("there is a drawing {number} before; give this one another number");
            return Err(text.error(raw, message));
        }
        let drawing = line.drawing().map_err(|message| text.error(raw, message))?;
        check::source(drawing.source, clip).map_err(|message| text.error(raw, message))?;
        drawings.push(drawing);
    }
    let mut exposures = Vec::with_capacity(written.exposures.len());
    for raw in written.exposures {
        let shown: Exposure = text.value(raw)?;
        let Some(&drawing) = numbers.get(&shown.drawing) else {
            let (name, count, number) = (&written.name, drawings.len(), shown.drawing);
            let message = format!("layer {name} has {count} drawings, none of them is {number}");
            return Err(text.error(raw, message));
        };
        let exposure = Exposure { drawing, ..shown };
        *length = exposure.after(*length).map_err(|message| text.error(raw, message))?;
        exposures.push(exposure);
    }
    let gone = written.gone.into_iter().map(|raw| text.value::<Gone>(raw));
    let gone = gone.collect::<Result<_, _>>()?;
    Ok(Layer { name: written.name, joints: written.joints, drawings, exposures, gone })
}
