//! Reads Acclaim's two files (アクレイム形式), in which Carnegie Mellon University publishes its motion library: a
//! skeleton (.asf) and a motion (.amc) per take.
//!
//! The user opens the motion; its skeleton lies beside it. Values stay in the file's unit. Joint limits are
//! ignored, because they describe what the solver allowed, not what the body did.

mod amc;
mod asf;
mod clip;
mod lines;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use super::reading::{Found, Given, Options, Read};
use amc::Amc;
use asf::Asf;
use genga::error::{Error, Place};
use genga::motion::Declared;
use genga::time::FrameRate;

/// Default frame rate for motions without one; nearly all of CMU's have this.
const RATE: f64 = 120.0;

/// Length of an inch in CMU's files.
const CMU_LENGTH: f64 = 0.45;

/// Whether a file begins like an Acclaim motion.
pub(crate) fn is_motion(head: &[u8]) -> bool {
    says(head, &[":fully-specified", ":degrees", ":radians", "#!oml:asf"])
}

/// Whether a file begins like an Acclaim skeleton.
pub(super) fn is_skeleton(head: &[u8]) -> bool {
    says(head, &[":version", ":bonedata", ":root", ":units"])
}

/// Whether any line of the head begins with one of the words.
fn says(head: &[u8], words: &[&str]) -> bool {
    let mut lines = head.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii_start);
    lines.any(|line| {
        let begins = |word: &&str| {
            line.get(..word.len()).is_some_and(|begin| begin.eq_ignore_ascii_case(word.as_bytes()))
        };
        words.iter().any(begins)
    })
}

/// Reads a motion with the skeleton beside it.
///
/// # Errors
/// [`Error::Motion`] with line and column if a file is invalid, preceded by the name of the skeleton if the
/// fault is there; also if no skeleton is found.
pub(super) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    if is_skeleton(given.bytes) && !is_motion(given.bytes) {
        return Err(whole(
            "this is a skeleton (.asf) without a motion: give the .amc of a take; it finds the .asf beside it",
        ));
    }
    Amc::check(&text(given.bytes))?;
    let (name, skeleton) = match &options.skeleton {
        Some(path) => (path.display().to_string(), opened(path, options)?),
        None => {
            let name = skeleton_name(given)?;
            let skeleton = given.beside(&name, Place::Whole, options)?;
            (name, skeleton)
        }
    };
    let of_skeleton = |error| match error {
        Error::Motion { place, message } => Error::Motion {
            place: Place::Part(format!("{name}:{place}").trim_end_matches([':', ' ']).to_owned()),
            message,
        },
        other => other,
    };
    let asf = Asf::read(&text(&skeleton)).map_err(of_skeleton)?;
    let amc = Amc::read(&text(given.bytes), &asf)?;
    joined(&asf, amc, &name)
}

/// Builds the clip and the facts about it.
fn joined(asf: &Asf, mut amc: Amc, name: &str) -> Result<Read, Error> {
    let rate = FrameRate::new(amc.rate.unwrap_or(RATE))
        .map_err(|_| whole("its frames a second are no rate; --fps N gives another"))?;
    let said =
        if amc.rate.is_some() { "" } else { ", which the file does not say (--fps N for another)" };
    let metres = 0.0254 / asf.length;
    let of_cmu = if asf.length == CMU_LENGTH { ", as CMU's" } else { "" };
    let found = vec![
        Found::new("format", format!("ASF/AMC with the skeleton {name}")),
        Found::new("unit", format!("1 is {metres:.4} m{of_cmu}")),
        Found::new("rate", format!("{} frames a second{said}", rate.fps())),
    ];
    let warnings = std::mem::take(&mut amc.warnings);
    let written_frame_time = amc.rate.map(|rate| 1.0 / rate);
    let declared = Declared { metres: Some(metres), ..Declared::default() };
    let clip = clip::clip(asf, amc, rate)?.with_declared(declared);
    Ok(Read { clip, warnings, written_frame_time, found, takes: Vec::new() })
}

fn opened(path: &Path, options: &Options) -> Result<Vec<u8>, Error> {
    let failed = |source| Error::Io { path: path.to_owned(), source };
    let file = std::fs::File::open(path).map_err(failed)?;
    options.stream.read(file).map_err(failed)
}

/// Finds the skeleton beside a motion: the one whose name is the longest beginning of the motion's name
/// (02.asf for 02_05.amc), or the only one.
fn skeleton_name(given: &Given<'_>) -> Result<String, Error> {
    let skeletons = given.neighbours("asf");
    let name = |path: &PathBuf| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let stem = |path: &Path| {
        path.file_stem().map(|stem| stem.to_string_lossy().to_lowercase()).unwrap_or_default()
    };
    let own = given.path.map(stem).unwrap_or_default();
    let fits = |path: &&PathBuf| {
        let stem = stem(path);
        !stem.is_empty() && own.starts_with(&stem)
    };
    let longest = skeletons.iter().filter(fits).max_by_key(|path| stem(path).len());
    let only = skeletons.first().filter(|_| skeletons.len() == 1);
    if let Some(name) = longest.or(only).and_then(name) {
        return Ok(name);
    }
    let names: Vec<String> = skeletons.iter().take(12).filter_map(name).collect();
    Err(whole(match &names[..] {
        [] => "this motion needs its skeleton: put the .asf of the same subject beside it, or name it by --skeleton FILE".to_owned(),
        names => format!(
            "which skeleton is this motion's: {}? Say it by --skeleton FILE",
            names.join(", ")
        ),
    }))
}

fn text(bytes: &[u8]) -> std::borrow::Cow<'_, str> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    String::from_utf8_lossy(bytes)
}

fn whole(message: impl Into<String>) -> Error {
    Error::Motion { place: Place::Whole, message: message.into() }
}
