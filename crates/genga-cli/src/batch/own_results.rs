//! Recognises what genga wrote: motion among its results is no clip of a batch.

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;

use super::super::failure::Failure;
use super::journal::{Header, is_journal};
use super::place::CLIPS;
use genga_files::{Manifest, Run};

/// Whether a folder holds the results of a run or a batch.
pub(super) fn is_results(folder: &Path) -> bool {
    manifest(folder).is_some() || is_batch(folder)
}

/// Whether a path lies among the clips of a batch.
pub(super) fn is_in_batch(path: &Path) -> bool {
    let is_clips = |folder: &&Path| folder.ends_with(CLIPS);
    path.ancestors().filter(is_clips).filter_map(Path::parent).any(is_batch)
}

/// Refuses a folder in which a batch keeps a clip. The batch's tables and journal describe what it wrote there.
pub(crate) fn spare_batch(folder: &Path) -> Result<(), Failure> {
    if !is_in_batch(folder) {
        return Ok(());
    }
    Err(Failure::AskedWrongly(format!(
        "{}: a batch keeps a clip here; correct it by a table of the batch (columns clip, pin, recipe …), or write \
         elsewhere with --out",
        folder.display()
    )))
}

/// Whether a folder holds the results of a run, and the file is one of them.
pub(super) fn is_result(file: &Path) -> bool {
    let (Some(folder), Some(name)) = (file.parent(), file.file_name()) else { return false };
    let is_listed = |run: Manifest| run.files.contains_key(&*name.to_string_lossy());
    manifest(folder).is_some_and(is_listed)
}

fn manifest(folder: &Path) -> Option<Manifest> {
    Manifest::read(&fs::read_to_string(folder.join(Run::MANIFEST)).ok()?).ok()
}

fn is_batch(folder: &Path) -> bool {
    folder.join(CLIPS).is_dir() && has_journal(folder)
}

fn has_journal(folder: &Path) -> bool {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries
        .filter(|entry| is_journal(&entry.file_name().to_string_lossy()))
        .any(|entry| begins_with_header(&entry.path()).unwrap_or_default())
}

fn begins_with_header(journal: &Path) -> std::io::Result<bool> {
    let mut line = String::new();
    BufReader::new(File::open(journal)?).read_line(&mut line)?;
    Ok(Header::is_header(&line))
}
