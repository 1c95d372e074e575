//! A results folder, which belongs to one run (一回の結果). Its manifest tells the next run which files are genga's and
//! which a person has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use super::failure::Failure;
use super::format_args::{Overwrites, shortened};
use super::found_settings::Found;
use super::paths;
use super::staging::{self, Bundle};
use genga_files::{ClipMark, Format, Manifest, Run};

/// A results folder as it is before a run writes to it.
pub(super) struct Folder<'a> {
    path: &'a Path,
    /// Text of its manifest; empty without one.
    text: String,
    /// Manifest of the previous run. `None` without a manifest, or with one that somebody edited.
    before: Option<Manifest>,
    /// Changed files that this run may overwrite.
    over: Overwrites<'a>,
}

/// Products of a run besides its files.
pub(super) struct Made<'a> {
    pub(super) clip: ClipMark,
    /// Digest of the recipe. `None` if a sheet was delivered.
    pub(super) recipe: Option<String>,
    /// Names of the formats that were written.
    pub(super) formats: Vec<&'static str>,
    /// Their settings that differ from the defaults.
    pub(super) settings: BTreeMap<String, String>,
    /// Settings of the recipe that targets found.
    pub(super) found: Found,
    /// Numbered files left over from a longer sheet.
    pub(super) stale: Vec<String>,
    /// Whether all other files of the previous run stay.
    pub(super) adds: bool,
    /// An input file that may be overwritten.
    pub(super) given: Option<&'a str>,
    /// The files that the run read, which are not removed.
    pub(super) sources: Vec<&'a Path>,
}

/// Files in the folder that are not part of this run.
pub(super) struct Left {
    /// Files of an earlier run that were removed.
    gone: Vec<String>,
    /// Pictures that a person painted on, which this run would have written.
    painted: Vec<String>,
    /// Such pictures that this run would have drawn otherwise than the run before.
    outgrown: Vec<String>,
    /// Files of an earlier run that a person changed.
    changed: Vec<String>,
    /// Files of an earlier run that lie behind a link to another folder.
    linked: Vec<String>,
    /// Files of an earlier run that this one read.
    read: Vec<String>,
    /// Numbered files of a longer sheet that no manifest lists.
    stale: Vec<String>,
}

impl Left {
    /// Returns a sentence for each group of files.
    pub(super) fn notes(self) -> Vec<String> {
        let named = |of: &str, files: Vec<String>| {
            let (count, files) = (files.len(), shortened(files));
            let count = if count > files.len() { format!(" ({count})") } else { String::new() };
            (!files.is_empty()).then(|| format!("{of}: {}{count}", files.join(" ")))
        };
        let groups = [
            ("painted, kept and not written again (--overwrite NAME does)", self.painted),
            (
                "painted, kept, but would be drawn otherwise now, in pose or framing (--overwrite NAME does)",
                self.outgrown,
            ),
            ("of an earlier run, removed", self.gone),
            (
                "of an earlier run and not of this sheet, kept because they were changed since",
                self.changed,
            ),
            ("of an earlier run, kept because a link leads to them", self.linked),
            ("of an earlier run and not of this sheet, kept because this run reads it", self.read),
            ("of an earlier sheet, not of this one", self.stale),
        ];
        groups.into_iter().filter_map(|(of, files)| named(of, files)).collect()
    }
}

impl<'a> Folder<'a> {
    /// Reads the folder's manifest, after finishing what a killed run had begun there.
    pub(super) fn look(path: &'a Path, over: Overwrites<'a>) -> Self {
        staging::sweep(path);
        let text = manifest_text(path);
        let before = Manifest::read(&text).ok();
        let is_as_written = |read: &Manifest| read.write().is_ok_and(|written| written == text);
        Self { before: before.filter(is_as_written), path, text, over }
    }

    /// Refuses a folder into which another run has written since this one looked at it.
    fn check_alone(&self) -> Result<(), Failure> {
        match manifest_text(self.path) == self.text {
            true => Ok(()),
            false => Err(Failure::at(
                self.path,
                "another run is at work in this folder; wait for it and run again, or name another folder with --out",
            )),
        }
    }

    /// Refuses a folder that holds the results of another clip.
    pub(super) fn check(&self, clip: &ClipMark) -> Result<(), Failure> {
        let Some(before) = self.before.as_ref().filter(|before| !before.clip.is_of(clip)) else {
            return Ok(());
        };
        if self.over.is_forced {
            return Ok(());
        }
        let (folder, theirs, ours) = (self.path.display(), &before.clip.file, &clip.file);
        let other = match theirs == ours {
            true => format!("another {ours}, with another motion"),
            false => format!("another clip, {theirs}"),
        };
        Err(Failure::AskedWrongly(format!(
            "{folder}: this folder is of {other}; write elsewhere with --out, or take it over with --force"
        )))
    }

    /// Whether it holds the results of a run of this clip.
    pub(super) fn has_run_of(&self, clip: &ClipMark) -> bool {
        self.of(clip).is_some_and(|run| run.recipe.is_some())
    }

    /// Whether it holds results of this clip.
    pub(super) fn is_of(&self, clip: &ClipMark) -> bool {
        self.of(clip).is_some()
    }

    /// Names of the formats that runs and deliveries of this clip wrote here, but those that this build does not have.
    pub(super) fn formats(&self, clip: &ClipMark) -> Vec<&'static str> {
        let names = self.of(clip).into_iter().flat_map(|before| &before.formats);
        names.filter_map(|name| Some(Format::find(name).ok()?.name)).collect()
    }

    /// The settings of these formats that differ from the defaults.
    pub(super) fn settings(&self, clip: &ClipMark) -> BTreeMap<String, String> {
        self.of(clip).map(|before| before.settings.clone()).unwrap_or_default()
    }

    /// The settings of the recipe that targets found.
    pub(super) fn found(&self, clip: &ClipMark) -> Found {
        self.of(clip).map(|before| before.found.clone()).unwrap_or_default()
    }

    /// The manifest, if the folder holds results of this clip.
    fn of(&self, clip: &ClipMark) -> Option<&Manifest> {
        self.before.as_ref().filter(|before| before.clip.is_of(clip))
    }

    /// The folder's path.
    pub(super) fn path(&self) -> &'a Path {
        self.path
    }

    /// Moves the files of a run into their places, the manifest last. Files that only the previous run wrote are
    /// removed; those that a person changed stay and are reported, and so do painted pictures.
    pub(super) fn finish(self, mut bundle: Bundle<'_>, made: Made<'_>) -> Result<Left, Failure> {
        self.check_alone()?;
        let mut come = bundle.files();
        self.over.check(self.path, &come)?;
        let painted: Vec<String> = come
            .iter()
            .filter(|file| self.is_painted(file))
            .map(|(name, _)| name.clone())
            .collect();
        self.spare(&come, &painted, made.given)?;
        painted.iter().try_for_each(|name| bundle.leave(name))?;
        // What was painted on is what was drawn then, until it is drawn anew.
        let before = |name: &String| self.before.as_ref()?.files.get(name).cloned();
        let (painted, outgrown): (Vec<_>, Vec<_>) = painted
            .into_iter()
            .partition(|name| before(name).is_none_or(|digest| come.get(name) == Some(&digest)));
        come.extend(outgrown.iter().filter_map(|name| Some((name.clone(), before(name)?))));
        let (stay, rest) = self.others(&come, &made);
        let is_as_written =
            |name: &String| self.digest(name).is_some_and(|digest| self.has(name, &digest));
        let (mut gone, changed): (Vec<_>, Vec<_>) = rest.into_iter().partition(is_as_written);
        let linked: Vec<_> = gone.extract_if(.., |name| self.is_behind_link(name)).collect();
        let is_read = |name: &String| {
            made.sources.iter().any(|path| paths::is_same(path, &self.path.join(name)))
        };
        let read: Vec<_> = gone.extract_if(.., |name| is_read(name)).collect();
        let is_known =
            |name: &String| [&gone, &changed, &linked, &read].iter().any(|of| of.contains(name));
        let stale = made.stale.into_iter().filter(|name| !is_known(name)).collect();
        let recipe = made.recipe.or_else(|| self.before.as_ref()?.recipe.clone());
        let before = if made.adds { self.formats(&made.clip) } else { vec![] };
        let formats: BTreeSet<&str> = before.into_iter().chain(made.formats).collect();
        let mut manifest = Manifest::new(made.clip);
        manifest.formats = formats.into_iter().map(str::to_owned).collect();
        manifest.settings = made.settings;
        manifest.found = made.found;
        manifest.recipe = recipe;
        // What a person changed, or the run reads, is listed as it was written, so that the next run tells of it again.
        let digest =
            |name: &String| Some((name.clone(), self.before.as_ref()?.files.get(name)?.clone()));
        let changed_since = changed.iter().chain(&read).filter_map(digest);
        manifest.files = stay.into_iter().chain(come).chain(changed_since).collect();
        bundle.add(Run::MANIFEST, manifest.write()?)?;
        bundle.finish(gone.clone())?;
        Ok(Left { painted, outgrown, gone, changed, linked, read, stale })
    }

    /// Splits the previous run's files that this run does not write into those that stay in the manifest and the names
    /// of the rest.
    fn others(
        &self,
        come: &BTreeMap<String, String>,
        made: &Made<'_>,
    ) -> (BTreeMap<String, String>, Vec<String>) {
        let mut rest = self.before.as_ref().map(|run| run.files.clone()).unwrap_or_default();
        rest.retain(|name, _| !come.contains_key(name) && self.path.join(name).is_file());
        let stays = |name: &String| made.adds && !made.stale.contains(name);
        let stay = rest.extract_if(.., |name, _| stays(name)).collect();
        rest.retain(|name, _| made.given != Some(name));
        (stay, rest.into_keys().collect())
    }

    /// Whether the picture in the place of a file, given with its digest, is neither that file nor as a run wrote it,
    /// and not to be overwritten.
    fn is_painted(&self, (name, digest): &(&String, &String)) -> bool {
        let is_results = self.before.is_some() || self.over.is_forced;
        let stays = paths::is_picture(Path::new(name)) && !self.over.has(self.path, name);
        let is_other = |there: String| there != **digest && !self.has(name, &there);
        is_results && stays && self.digest(name).is_some_and(is_other)
    }

    /// Refuses to overwrite files, but painted pictures, that differ from what a run wrote.
    fn spare(
        &self,
        come: &BTreeMap<String, String>,
        painted: &[String],
        given: Option<&str>,
    ) -> Result<(), Failure> {
        if self.over.is_forced {
            return Ok(());
        }
        let is_ours = |name: &str, digest: &String| match self.digest(name) {
            None => true,
            Some(_)
                if painted.iter().any(|picture| picture == name)
                    || self.over.has(self.path, name) =>
            {
                true
            }
            Some(there) => there == *digest || self.has(name, &there) || given == Some(name),
        };
        let mut others: Vec<&str> = Vec::new();
        if self.before.is_none() && self.path.join(Run::MANIFEST).is_file() {
            others.push(Run::MANIFEST);
        }
        others.extend(
            come.iter().filter(|(name, digest)| !is_ours(name, digest)).map(|(name, _)| &**name),
        );
        let Some((first, more)) = others.split_first() else { return Ok(()) };
        let more =
            if more.is_empty() { String::new() } else { format!(" (nor {})", more.join(" ")) };
        // An edited recipe or timesheet is usually meant.
        let way_in = match self.path.join(first) {
            path if *first == Run::RECIPE => {
                format!("; to run with it: --recipe {}", path.display())
            }
            path if matches!(paths::ending(&path).as_deref(), Some("xdts" | "tdts")) => {
                format!("; to pin the keys that are marked in it: --pin-from {}", path.display())
            }
            _ => String::new(),
        };
        Err(Failure::AskedWrongly(format!(
            "{}: this file is not as a run wrote it{more}, and would be lost; move it, write elsewhere with --out, or write over \
             it with --force{way_in}",
            self.path.join(first).display()
        )))
    }

    fn digest(&self, name: &str) -> Option<String> {
        digest(self.path, name)
    }

    fn is_behind_link(&self, name: &str) -> bool {
        is_behind_link(self.path, name)
    }

    fn has(&self, name: &str, digest: &str) -> bool {
        self.before.as_ref().is_some_and(|before| before.has(name, digest))
    }
}

fn manifest_text(folder: &Path) -> String {
    fs::read_to_string(folder.join(Run::MANIFEST)).unwrap_or_default()
}

/// Returns the current digest of a file in a folder: `None` if it does not exist, and an empty string, which matches no
/// file, if it cannot be read.
pub(super) fn digest(folder: &Path, name: &str) -> Option<String> {
    match fs::read(folder.join(name)) {
        Ok(bytes) => Some(Manifest::digest(&bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(_) => Some(String::new()),
    }
}

/// Whether a folder on the path from a folder to a file in it is a symbolic link.
pub(super) fn is_behind_link(folder: &Path, name: &str) -> bool {
    let way = Path::new(name).ancestors().skip(1);
    way.filter(|part| !part.as_os_str().is_empty()).any(|part| folder.join(part).is_symlink())
}
