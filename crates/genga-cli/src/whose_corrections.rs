//! Corrections are of the frames of one clip: several clips are refused them, and another clip's in a recipe are told.

use std::fs;
use std::path::Path;

use super::failure::Failure;
use super::listed::{list, shortened_list};
use super::paths::named;
use genga::edits::Edits;
use genga::slate::Slate;
use genga_files::{ClipMark, Manifest, Run};

/// Refuses corrections of frames in a recipe that would go into several clips.
pub(super) fn check(recipe: &Path, edits: &Edits, clips: usize) -> Result<(), Failure> {
    let frames = of_frames(edits);
    if frames.is_empty() || clips < 2 {
        return Ok(());
    }
    Err(Failure::AskedWrongly(format!(
        "{}: has corrections of frames, which are of one clip, and {clips} clips are to have them: {}; take its [edits] \
         out, or name it for its clip alone in a table with a column recipe",
        named(recipe).display(),
        shortened_list(frames)
    )))
}

/// Refuses a correction of frames on the command line that would go into several clips.
pub(super) fn check_given(option: &str, given: &str, clips: usize) -> Result<(), Failure> {
    if clips < 2 {
        return Ok(());
    }
    Err(Failure::AskedWrongly(format!(
        "--{option} {given}: is of the frames of one clip, and {clips} clips are to have it; give it to its clip alone in \
         a table with a column {option} (@table.csv)"
    )))
}

/// Says whose corrections a recipe in a results folder has, if they are of another motion.
pub(super) fn of_another(recipe: &Path, edits: &Edits, clip: &ClipMark) -> Option<String> {
    let frames = of_frames(edits);
    let manifest = fs::read_to_string(recipe.parent()?.join(Run::MANIFEST)).ok()?;
    let Manifest { clip: theirs, .. } = Manifest::read(&manifest).ok()?;
    (!frames.is_empty() && !theirs.is_of(clip)).then(|| {
        format!(
            "{} has corrections of another motion, {}, which are made in this one too: {}; take its [edits] out if they are \
             not meant",
            recipe.display(),
            theirs.file,
            shortened_list(frames)
        )
    })
}

/// Lists corrections of frames. A slate, the koma of a cut and switches may be meant for every clip.
fn of_frames(edits: &Edits) -> Vec<String> {
    list(&Edits {
        only_pins: false,
        again: false,
        at: None,
        length: None,
        slate: Slate::default(),
        ..edits.clone()
    })
}
