//! The clip and the recipe that a command asks for.

use std::path::{Path, PathBuf};

use super::args::{ClipArgs, Corrections, LayerArgs, Part, Reading, Settings};
use super::failure::Failure;
use super::io;
use super::words::Words;
use crate::edits::{Edits, Forbidden, Hold, Move, Pin, layer_of};
use crate::error::{Error, Warning};
use crate::keys::Layers;
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
    let (mut recipe, mut edits) = recipe(&args.settings, Recipe::default())?;
    split(&args.layers, &mut recipe)?;
    for text in &args.pin {
        let (layer, text) = layer_of(text);
        let pin = Pin::parse(text).map_err(|error| wrongly("pin", error))?;
        let pins = edits.pins_of(layer);
        // A pin given again says more about the same frame.
        pins.retain(|other| other.frame != pin.frame);
        pins.push(pin);
    }
    for text in &args.forbid {
        let (layer, text) = layer_of(text);
        let frames: Forbidden = text
            .parse()
            .map_err(|message| Failure::AskedWrongly(format!("--forbid: {message}")))?;
        let forbidden = edits.forbidden_of(layer);
        if !forbidden.contains(&frames) {
            forbidden.push(frames);
        }
    }
    for text in &args.moves {
        let (layer, text) = layer_of(text);
        let moved = Move::parse(text).map_err(|error| wrongly("move", error))?;
        let moves = edits.moves_of(layer);
        moves.retain(|other| other.from != moved.from);
        moves.push(moved);
    }
    for hold in &args.holds {
        let hold = Hold::parse(hold).map_err(|error| wrongly("hold", error))?;
        edits.holds.retain(|other| other.frame != hold.frame);
        edits.holds.push(hold);
    }
    if !args.split.is_empty() {
        edits.splits = args.split.clone();
    }
    edits.only_pins = args.only_pins.unwrap_or(edits.only_pins);
    Ok((recipe, edits))
}

/// The layers and the root that are asked for, on top of a recipe.
fn split(args: &LayerArgs, recipe: &mut Recipe) -> Result<(), Failure> {
    match args.layers.as_deref() {
        None => {}
        Some(word @ ("body" | "limbs" | "joints")) => recipe.set("layers", word)?,
        Some(file) => recipe.layers = layers_of_file(Path::new(file))?,
    }
    if let Some(word) = &args.root_on {
        recipe.set("root", word)?;
    }
    Ok(())
}

fn layers_of_file(path: &Path) -> Result<Layers, Failure> {
    if !io::is_stream(path) && !path.exists() {
        let message = format!(
            "--layers: expected body, limbs, joints or a file of layers; there is no file {}",
            path.display()
        );
        return Err(Failure::AskedWrongly(message));
    }
    let name = io::named(path);
    let wrong = |reason: &dyn std::fmt::Display| {
        Failure::AskedWrongly(format!("--layers: {}: {reason}", name.display()))
    };
    let text = String::from_utf8(io::read(path)?).map_err(|_| wrong(&"is not UTF-8"))?;
    Layers::parse(&text).map_err(|error| wrong(&error))
}

fn wrongly(option: &str, error: Error) -> Failure {
    match error {
        Error::Edits { message } => Failure::AskedWrongly(format!("--{option}: {message}")),
        other => other.into(),
    }
}
