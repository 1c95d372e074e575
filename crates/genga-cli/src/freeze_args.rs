//! `--freeze`: keeps the genga of an earlier run.

use super::console::counted;
use super::corrections::Corrections;
use super::failure::Failure;
use super::sheets::SHEET;
use super::{files, paths, pin_args};
use genga::edits::Edits;
use genga::error::Error;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Role;
use genga::time::Frame;
use genga_files::{pins_from_sheet, sheet_json};

/// Freezes the genga of the given sheet, layer by layer, and returns a sentence about it.
pub(super) fn freeze(
    args: &Corrections,
    engine: &Engine,
    recipe: &Recipe,
    edits: &mut Edits,
) -> Result<Option<String>, Failure> {
    let Some(path) = &args.freeze else { return Ok(None) };
    let path = if path.is_dir() { path.join(SHEET) } else { path.clone() };
    let file = sheet_json::read(&files::read(&path)?).map_err(files::fault_of(&path))?;
    pin_args::check_rate(&file, engine, &paths::named(&path))?;
    edits.frozen.clear();
    edits.layers.values_mut().for_each(|own| own.frozen.clear());
    let mut count = 0;
    for layer in file.sheet.layers.iter().filter(|layer| layer.count(Role::Genga) > 0) {
        let (pins, name) =
            pins_from_sheet(&file, Some(&layer.name)).map_err(files::fault_of(&path))?;
        let frames = pins.iter().map(|pin| pin.frame);
        count += pins.len();
        edits.frozen_of(pin_args::layer(&name, engine, recipe)?).extend(frames);
    }
    check_frames(edits, engine, &path)?;
    match count {
        0 => Err(Failure::of_file(&path, Error::sheet("there is no genga in it to keep"))),
        _ => Ok(Some(format!("frozen from {}: {}", path.display(), counted(count, "key")))),
    }
}

/// Refuses a sheet with frames that the clip does not have.
fn check_frames(edits: &Edits, engine: &Engine, path: &std::path::Path) -> Result<(), Failure> {
    let clip = engine.clip();
    let of_layers = edits.layers.values().flat_map(|own| &own.frozen);
    let has = |frame: &&Frame| clip.contains(**frame);
    match edits.frozen.iter().chain(of_layers).find(|frame| !has(frame)) {
        None => Ok(()),
        Some(frame) => {
            let (first, last) = (clip.first(), clip.last());
            let message = format!(
                "frame {frame} of it is not in the clip, which has frames {first} to {last}: is it the sheet of \
                 another clip, or of another part (--trim)?"
            );
            Err(Failure::of_file(path, Error::sheet(message)))
        }
    }
}
