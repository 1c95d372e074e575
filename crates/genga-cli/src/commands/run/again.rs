//! The formats of a folder (前の形式). A run that names none writes them again, with their settings, for their timing would
//! not be that of the new sheet.

use std::path::Path;

use super::{RunArgs, sources};
use crate::folder::Folder;
use crate::format_args::Formats;
use crate::paths;
use genga_files::{ClipMark, Cut, Format};

/// Adds the formats of a folder, with their settings. Returns notes on what was added and what was not.
pub(super) fn add(
    mut formats: Formats,
    args: &RunArgs,
    (place, clip): (&Folder<'_>, &ClipMark),
) -> (Formats, Vec<String>) {
    if args.fresh {
        return (formats, vec![]);
    }
    let names_some = !args.deliver.is_empty() || args.formats.asks_for_bvh();
    let there = if names_some { vec![] } else { place.formats(clip) };
    let there = there.into_iter().filter(|name| !formats.writes(name));
    let (read, again): (Vec<_>, Vec<_>) = there
        .map(|name| (name, read_of(args, place.path(), name)))
        .partition(|(_, file)| file.is_some());
    let again: Vec<&str> = again.into_iter().map(|(name, _)| name).collect();
    formats = formats.with(&again);
    let mut notes = formats.keep(&place.settings(clip), &args.formats, "--fresh goes without");
    if !again.is_empty() {
        let again = again.join(", ");
        notes.push(format!(
            "also written, as the folder has them: {again} (--deliver names others)"
        ));
    }
    notes.extend(read.into_iter().filter_map(|(name, file)| {
        let file = file?.display();
        Some(format!(
            "{name} is not written again, because this run reads {file}; --deliver {name} writes it once that file is \
             called otherwise, or with --out into another folder"
        ))
    }));
    (formats, notes)
}

/// The file of a format in a folder that the run reads.
fn read_of<'a>(args: &'a RunArgs, folder: &Path, name: &str) -> Option<&'a Path> {
    let cut = paths::stem(&args.plan.clip.path);
    let files = Format::find(name).ok()?.files;
    let mut files = files.iter().map(|file| folder.join(Cut::file_of(&cut, file)));
    files.find_map(|file| {
        sources(args).map(|(_, path)| path).find(|path| paths::is_same(path, &file))
    })
}
