//! The clip and the recipe that a command asks for.

use std::path::{Path, PathBuf};

use super::args::{ClipArgs, Corrections, Part, Reading, Settings};
use super::failure::Failure;
use super::io;
use super::words::Words;
use crate::edits::{Edits, Forbidden, Move, Pin};
use crate::error::{Error, Warning};
use crate::motion::{Clip, bvh};
use crate::recipe::Recipe;
use crate::time::Frame;

/// A clip ready to be worked on, and what a person should know about it.
pub(super) struct Source {
    pub(super) clip: Clip,
    pub(super) notes: Vec<Warning>,
    /// Seconds a frame as the file writes them.
    pub(super) written_frame_time: f64,
}

/// Reads the clip, leaves out an inserted T-pose unless asked to keep it, and trims.
///
/// A T-pose is a fact about the motion and no fault of the file: `--strict` lets it pass.
pub(super) fn clip(args: &ClipArgs) -> Result<Source, Failure> {
    part(&args.clip, &args.part)
}

/// [`clip`] of any of several files.
pub(super) fn part(path: &Path, args: &Part) -> Result<Source, Failure> {
    let failed = |error| Failure::of_file(&io::named(path), error);
    let bvh::Read { mut clip, warnings: mut notes, written_frame_time } =
        whole(path, &args.reading)?;
    let begin = args.trim.as_ref().map_or(clip.first().0, |frames| frames.start);
    if !args.keep_lead_in {
        let (motion, note) = bvh::lead_in::strip(clip);
        clip = motion;
        if begin < clip.first().0 {
            notes.extend(note);
        }
    }
    if let Some(frames) = &args.trim {
        // A trim from before the motion means from its beginning.
        let begin = Frame(frames.start.max(clip.first().0));
        let end = Frame(if frames.end == usize::MAX { clip.last().0 + 1 } else { frames.end });
        clip = clip.trimmed(begin, end).map_err(|error| match error {
            Error::Clip { message } => Failure::AskedWrongly(format!("--trim: {message}")),
            other => failed(other),
        })?;
    }
    clip.check_size().map_err(failed)?;
    Ok(Source { clip, notes, written_frame_time })
}

/// [`clip`] of every file, before any work on one begins; says what there is to know of each.
pub(super) fn parts(paths: &[PathBuf], args: &Part, words: &Words) -> Result<Vec<Clip>, Failure> {
    let read = |path: &PathBuf| {
        let source = part(path, args)?;
        for note in &source.notes {
            if paths.len() > 1 {
                words.say(format_args!("{}: {note}", path.display()));
            } else {
                words.say(note);
            }
        }
        Ok(source.clip)
    };
    paths.iter().map(read).collect()
}

/// Reads the whole file, with everything that stands in front of the motion.
pub(super) fn whole(path: &Path, reading: &Reading) -> Result<bvh::Read, Failure> {
    let options = options(reading);
    let read =
        if io::is_stream(path) { options.read(&io::read(path)?) } else { options.open(path) };
    read.map_err(|error| match error {
        Error::Setting { name, message } => Failure::AskedWrongly(format!("--{name}: {message}")),
        other => Failure::of_file(&io::named(path), other),
    })
}

fn options(args: &Reading) -> bvh::Options {
    let Reading { fps, root, repair, strict } = args;
    bvh::Options { strict: *strict, repair: *repair, fps: *fps, root: root.clone() }
}

/// The recipe and corrections that are asked for, on top of `default`.
pub(super) fn recipe(args: &Settings, default: Recipe) -> Result<(Recipe, Edits), Failure> {
    let (mut recipe, edits) = match &args.recipe {
        None => (default, Edits::default()),
        Some(path) => {
            let bytes = io::read(path)?;
            let text = String::from_utf8(bytes)
                .map_err(|_| Failure::AskedWrongly(format!("{}: is not text", path.display())))?;
            default.overlaid(&text).map_err(|error| Failure::of_file(&io::named(path), error))?
        }
    };
    for (name, value) in &args.set {
        recipe.set(name, value)?;
    }
    Ok((recipe, edits))
}

/// The recipe and corrections of a run: those of the settings, and those of the command line on top.
pub(super) fn corrected(args: &Corrections) -> Result<(Recipe, Edits), Failure> {
    let (recipe, mut edits) = recipe(&args.settings, Recipe::default())?;
    for pin in &args.pin {
        let pin = Pin::parse(pin).map_err(|error| wrongly("pin", error))?;
        // A pin given again says more about the same frame.
        edits.pins.retain(|other| other.frame != pin.frame);
        edits.pins.push(pin);
    }
    for frames in &args.forbid {
        let frames: Forbidden = frames
            .parse()
            .map_err(|message| Failure::AskedWrongly(format!("--forbid: {message}")))?;
        if !edits.forbidden.contains(&frames) {
            edits.forbidden.push(frames);
        }
    }
    for moved in &args.moves {
        let moved = Move::parse(moved).map_err(|error| wrongly("move", error))?;
        edits.moves.retain(|other| other.from != moved.from);
        edits.moves.push(moved);
    }
    if !args.split.is_empty() {
        edits.splits = args.split.clone();
    }
    edits.only_pins = args.only_pins.unwrap_or(edits.only_pins);
    Ok((recipe, edits))
}

fn wrongly(option: &str, error: Error) -> Failure {
    match error {
        Error::Edits { message } => Failure::AskedWrongly(format!("--{option}: {message}")),
        other => other.into(),
    }
}
