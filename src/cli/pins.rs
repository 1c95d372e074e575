//! `--pin-from`: keys that a person marked in a file.

mod xdts;

use std::path::Path;

use super::args::Corrections;
use super::asked::Asked;
use super::failure::Failure;
use super::io;
use super::words::counted;
use crate::deliver::{pins_from_sheet, pins_from_table, sheet_json};
use crate::edits::{Edits, Move, Pin};
use crate::error::Error;
use crate::keys::{Key, Origin};
use crate::pipeline::{Breakdown, Engine};
use crate::recipe::Recipe;
use crate::timing::held_for;

/// Keys of a file, and of which column of it.
struct Marked {
    pins: Vec<Pin>,
    column: String,
    /// What a person should know besides.
    notes: Vec<String>,
}

/// Adds the keys marked in the file of `--pin-from` to the corrections, and says so in sentences. Pins
/// given otherwise go first: of two on one koma theirs stays.
pub(super) fn marked(
    args: &Corrections,
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &mut Edits,
) -> Result<Vec<String>, Failure> {
    let Some(path) = &args.pin_from else { return Ok(vec![]) };
    let name = io::named(path);
    let bytes = io::read(path)?;
    let column = args.pin_column.as_deref();
    let of_file = |error| Failure::of_file(&name, error);
    let marked = match Kind::of(&name, &bytes) {
        Kind::Timesheet => xdts::marked(&bytes, &name, column, engine, (recipe, edits))?,
        Kind::Table => {
            let (pins, column) = pins_from_table(&bytes, column).map_err(of_file)?;
            Marked { pins, column, notes: vec![] }
        }
        Kind::Sheet => {
            let file = sheet_json::read(&bytes).map_err(of_file)?;
            check_rate(&file, engine, &name)?;
            let (pins, column) = pins_from_sheet(&file, column).map_err(of_file)?;
            Marked { pins, column, notes: vec![] }
        }
    };
    let count = marked.pins.len();
    let layer = layer(&marked.column, engine, recipe)?;
    let pinned = add(marked.pins, layer, engine, recipe, edits);
    let mut notes = vec![format!(
        "pinned from {}: {} of column {}",
        name.display(),
        counted(pinned, "key"),
        marked.column
    )];
    if pinned < count {
        let others = counted(count - pinned, "other");
        notes.push(format!("{others} marked there gave way to pins on the same koma"));
    }
    notes.extend(marked.notes);
    Ok(notes)
}

/// The layer that a column's keys are for: of several the one of that name, else all.
fn layer<'a>(column: &'a str, engine: &Engine, recipe: &Recipe) -> Result<Option<&'a str>, Error> {
    let parts = recipe.layers.split(engine.clip())?;
    let is_one = parts.len() > 1 && parts.iter().any(|part| part.name == column);
    Ok(is_one.then_some(column))
}

/// Adds pins to a layer, or to all, on koma that have none. Gives how many.
fn add(
    pins: Vec<Pin>,
    layer: Option<&str>,
    engine: &Engine,
    recipe: &Recipe,
    edits: &mut Edits,
) -> usize {
    let clock = engine.clip().clock(recipe.rate);
    let koma = |frame: crate::time::Frame| clock.koma_from_place(frame.0 as f64);
    let mut added = 0;
    for pin in pins {
        let own = koma(pin.frame);
        let there = layer.map_or_else(|| edits.clone(), |name| edits.of_layer(name));
        let moved = there.moves.iter().map(|moved| moved.to);
        let mut taken = there.pins.iter().map(|pin| pin.frame).chain(moved);
        if !taken.any(|frame| koma(frame) == own) {
            edits.pins_of(layer).push(pin);
            added += 1;
        }
    }
    added
}

/// A sentence for each move that found nothing to move, in any of the layers it is for.
pub(super) fn unmoved(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let layers: Vec<_> = breakdown.layers().collect();
    let of_all = edits.moves.iter().map(|moved| (moved, None));
    let of_one = edits
        .layers
        .iter()
        .flat_map(|(name, own)| own.moves.iter().map(move |moved| (moved, Some(name.as_str()))));
    let said = of_all.chain(of_one).filter_map(|(moved, name)| {
        let meant = layers.iter().filter(|own| name.is_none_or(|name| own.layer.name == name));
        let keys: Vec<&[Key]> = meant.map(|own| own.keys.keys.as_slice()).collect();
        let is_moved = |key: &Key| key.origin == Origin::Moved { from: moved.from };
        let is_idle = !keys.iter().any(|keys| keys.iter().any(is_moved));
        is_idle.then(|| unmoved_one(moved, name, keys.first().copied().unwrap_or_default()))
    });
    said.collect()
}

/// A sentence for each hold of which a layer has less or more than was asked for, and for each that found no drawing.
pub(super) fn unheld(edits: &Edits, breakdown: &Breakdown<'_>) -> Vec<String> {
    let layers = &breakdown.sheet.layers;
    let several = layers.len() > 1;
    let mut said = Vec::new();
    for hold in &edits.holds {
        let (frame, asked) = (hold.frame, hold.koma);
        let stays = |layer| held_for(layer, *hold, breakdown.clock);
        let found: Vec<_> = layers.iter().filter_map(|own| Some((own, stays(own)?))).collect();
        if found.is_empty() {
            said.push(format!(
                "no drawing is within two koma of frame {frame}, so none stays for {asked} koma; --pin {frame} makes one there"
            ));
        }
        for (layer, koma) in found.into_iter().filter(|(_, koma)| *koma != asked) {
            let of = if several { format!("{}/", layer.name) } else { String::new() };
            said.push(format!(
                "the drawing of frame {of}{frame} was to stay for {asked} koma and stays for {koma}: genga stay on their \
                 koma, and on twos and threes no drawing for one"
            ));
        }
    }
    said
}

/// That there was no key to move, and where the nearest are.
fn unmoved_one(moved: &Move, layer: Option<&str>, keys: &[Key]) -> String {
    let (from, to) = (moved.from, moved.to);
    let after = keys.partition_point(|key| key.frame < from);
    let round = &keys[after.saturating_sub(1)..keys.len().min(after + 1)];
    let round: Vec<String> = round.iter().map(|key| key.frame.to_string()).collect();
    let nearest = match round.as_slice() {
        [] => String::new(),
        [only] => format!(" (the nearest is at {only})"),
        both => format!(" (the nearest are at {})", both.join(" and ")),
    };
    let layer = layer.map_or_else(String::new, |name| format!("{name}/"));
    format!(
        "no key is found at frame {layer}{from}{nearest}, so none was moved to {to}; --pin {layer}{to} makes one there"
    )
}

/// Refuses to write over the marked file: a person's work is in it.
pub(super) fn spare(
    args: &Corrections,
    asked: &Asked,
    folder: &Path,
    cut: &str,
) -> Result<(), Failure> {
    let Some(marked) = args.pin_from.as_deref() else { return Ok(()) };
    xdts::spare(marked, asked, folder, cut)?;
    asked.spare("file with your keys", marked, folder, cut)
}

/// What kind of file keys are marked in.
enum Kind {
    /// XDTS or TDTS.
    Timesheet,
    /// CSV.
    Table,
    /// `sheet.json`.
    Sheet,
}

impl Kind {
    /// By its ending, and by its first letters where that says nothing.
    fn of(name: &Path, bytes: &[u8]) -> Self {
        let ending = name.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        match ending.as_deref() {
            Some("xdts" | "tdts") => Self::Timesheet,
            Some("csv" | "tsv" | "txt") => Self::Table,
            Some("json") => Self::Sheet,
            _ if bytes.trim_ascii_start().starts_with(b"{") => Self::Sheet,
            _ if first_line(bytes).ends_with(b"DigitalTimeSheet Save Data") => Self::Timesheet,
            _ => Self::Table,
        }
    }
}

fn first_line(bytes: &[u8]) -> &[u8] {
    let line = bytes.split(|byte| matches!(byte, b'\r' | b'\n')).next();
    line.unwrap_or_default().trim_ascii()
}

/// Frames of another rate are other moments.
fn check_rate(file: &sheet_json::SheetFile, engine: &Engine, name: &Path) -> Result<(), Failure> {
    let (sheet, clip) = (file.clip.frame_rate, engine.clip().rate().fps());
    if sheet == clip {
        return Ok(());
    }
    let message = format!(
        "the sheet is for {sheet} frames a second, the clip has {clip}: its frames are other moments here; \
         --fps {sheet} reads the clip so"
    );
    Err(Failure::of_file(name, Error::sheet(message)))
}
