//! Moves the files of a clip into its folder: all together, never over a person's changes, and beside a person's files.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::super::failure::Failure;
use super::super::folder::{digest, is_behind_link};
use super::super::format_args::Overwrites;
use super::super::paths;
use super::super::shell::quoted;
use super::super::staging::Staging;
use super::row::Line;
use genga::error::Error;

/// Folder that holds a folder per clip.
pub(crate) const CLIPS: &str = "clips";

/// Digests of files by name.
type Files = BTreeMap<String, String>;

/// The output folder of a batch, with the clips' folders.
pub(crate) struct Places<'a> {
    pub(crate) out: &'a Path,
    /// Changed files that this batch may overwrite.
    pub(crate) over: Overwrites<'a>,
}

impl Places<'_> {
    /// The folder of a clip.
    pub(crate) fn clip_folder(&self, name: &str) -> PathBuf {
        self.out.join(CLIPS).join(name)
    }

    /// Names of a clip's files that are not as a batch wrote them; `None` if one is missing.
    pub(crate) fn changed(&self, name: &str, files: &Files) -> Option<Vec<String>> {
        let folder = self.clip_folder(name);
        let mut changed = Vec::new();
        for (file, written) in files {
            if digest(&folder, file)? != *written {
                changed.push(file.clone());
            }
        }
        Some(changed)
    }

    /// Whether the user asks to write over one of these files of a clip, of which some are changed.
    pub(crate) fn writes_over(&self, name: &str, files: &Files, changed: &[String]) -> bool {
        let folder = self.clip_folder(name);
        files.keys().any(|file| self.over.has(&folder, file))
            || self.over.is_forced && changed.iter().any(|file| !is_picture(file))
    }

    /// Moves the staged files of a clip into its folder, and removes the others that the earlier batch wrote. Returns
    /// the names of files that stay because a person changed them. All else in the folder is left alone.
    pub(crate) fn put(
        &self,
        line: &Line,
        staging: &Staging,
        before: &Files,
    ) -> Result<Vec<String>, Failure> {
        let Line { clip: name, files: come, .. } = line;
        let place = self.clip_folder(name);
        let failed = |error: io::Error| refused(&place, error);
        if place.exists() {
            let kept = self.kept(&place, line, before)?;
            let stays = |file: &&String| kept.contains(file);
            let is_left = |file: &&String| come.contains_key(*file) || is_behind_link(&place, file);
            let come = come.keys().filter(|file| !stays(file));
            let go = before.keys().filter(|file| !stays(file) && !is_left(file));
            let staged = |file: &String| staged(name, file);
            let (come, go) = (come.map(staged).collect(), go.map(staged).collect());
            staging.exchange(self.out, come, go).map_err(|error| match error {
                Error::Io { path, source } => refused(&path, source),
                other => other.into(),
            })?;
            return Ok(kept);
        }
        if !come.is_empty() {
            place.parent().map_or(Ok(()), fs::create_dir_all).map_err(failed)?;
            fs::rename(staging.place(&staged(name, "")), &place).map_err(failed)?;
        }
        Ok(vec![])
    }

    /// Names of files that a person changed and that stay: pictures, files that do not come now, and files that would
    /// come as they came before. Refuses any other that would be lost, and a picture that may be of another drawing now.
    fn kept(&self, place: &Path, line: &Line, before: &Files) -> Result<Vec<String>, Failure> {
        let come = &line.files;
        if let Some(path) = come.keys().find_map(|file| in_the_way(place, file)) {
            return Err(Failure::AskedWrongly(format!(
                "{}: is in the way of a file or a folder of that name; move it",
                path.display()
            )));
        }
        let (mut kept, mut lost, mut other) = (Vec::new(), Vec::new(), Vec::new());
        let others = before.keys().filter(|file| !come.contains_key(*file));
        for file in come.keys().chain(others) {
            let Some(there) = digest(place, file) else { continue };
            let (old, new) = (before.get(file), come.get(file));
            let is_ours = [old, new].into_iter().flatten().any(|written| *written == there);
            let is_over = new.is_some()
                && (self.over.has(place, file) || self.over.is_forced && !is_picture(file));
            let is_as_drawn = line.keeps_numbers || old.is_none() || new.is_none() || old == new;
            match is_ours || is_over {
                true => {}
                false if is_picture(file) && !is_as_drawn => {
                    other.push(place.join(file).display().to_string());
                }
                false if is_picture(file) || new.is_none() || old == new => kept.push(file.clone()),
                false => lost.push(place.join(file).display().to_string()),
            }
        }
        match (lost.is_empty(), other.is_empty()) {
            (true, true) => Ok(kept),
            (true, false) => Err(of_another_drawing(&other)),
            (false, _) => Err(would_be_lost(&lost)),
        }
    }
}

/// Path of a clip's file in the output folder, which is also that in the staging.
pub(super) fn staged(clip: &str, file: &str) -> String {
    format!("{CLIPS}/{clip}/{file}")
}

/// Whether a file is a picture, on which a person may paint.
pub(super) fn is_picture(file: &str) -> bool {
    paths::is_picture(Path::new(file))
}

/// A folder at the place of a file, or a file at that of one of its folders.
fn in_the_way(place: &Path, file: &str) -> Option<PathBuf> {
    let path = place.join(file);
    if path.is_dir() {
        return Some(path);
    }
    let above = path.ancestors().skip(1).take_while(|above| above.starts_with(place));
    above.filter(|above| above.is_file()).map(Path::to_owned).last()
}

/// The failure of a clip with files that are not as a batch wrote them, and that its results would replace.
fn would_be_lost(files: &[String]) -> Failure {
    Failure::AskedWrongly(format!(
        "{}: this file is not as a batch wrote it{}, and would be lost; move it{}",
        files[0],
        nor(files),
        or_over(files)
    ))
}

/// The failure of a clip with pictures that a person changed, and whose drawings have other numbers now.
fn of_another_drawing(files: &[String]) -> Failure {
    Failure::AskedWrongly(format!(
        "{}: this picture is not as a batch wrote it{}, and may be of another drawing now, for numbers are not kept; move \
         it{}",
        files[0],
        nor(files),
        or_over(files)
    ))
}

/// Names the files after the first.
fn nor(files: &[String]) -> String {
    match &files[1..] {
        [] => String::new(),
        others => format!(" (nor {})", others.join(" ")),
    }
}

/// The option that writes over files.
fn or_over(files: &[String]) -> String {
    // A comma separates names, so none can have one.
    match files.iter().any(|file| file.contains(',')) {
        true => String::new(),
        false => format!(", or write over it with --overwrite {}", quoted(&files.join(","))),
    }
}

/// The failure at a place of a clip. If the place alone is at fault, and not the whole disk, it becomes the clip's row.
fn refused(path: &Path, error: io::Error) -> Failure {
    use io::ErrorKind::{
        AlreadyExists, IsADirectory, NotADirectory, PermissionDenied, ReadOnlyFilesystem,
    };
    match error.kind() {
        _ if is_too_long(&error) => Failure::AskedWrongly(too_long(path)),
        AlreadyExists | IsADirectory | NotADirectory | PermissionDenied | ReadOnlyFilesystem => {
            Failure::AskedWrongly(Failure::io(path, error).to_string())
        }
        _ => Failure::io(path, error),
    }
}

/// Whether the file system refuses a name, usually one of more than 255 bytes.
pub(super) fn is_too_long(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::InvalidFilename
}

/// The message for a name that the file system refuses.
pub(super) fn too_long(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    format!("{name}: the name is too long for the file system; give the clip a shorter one")
}

/// The failure for an archive or a table that no batch wrote and that would be overwritten.
pub(super) fn foreign(path: &Path, what: &str) -> Failure {
    let path = path.display();
    Failure::AskedWrongly(format!(
        "{path}: this {what} is not as a batch wrote it, and would be lost; move it, write elsewhere with --out, or write \
         over it with --force"
    ))
}
