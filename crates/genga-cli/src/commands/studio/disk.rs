//! The studio's file access on a disk: it reads, writes and exports as the other commands do.

use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Mutex, PoisonError};

use egui::ColorImage;

#[cfg(feature = "studio")]
use super::dialog;
use super::{pictures, sound};
use crate::clip::Part;
use crate::failure::Failure;
use crate::folder::Folder;
use crate::format_args::{FormatArgs, Formats, Overwrites};
use crate::numbers::{self, Numbering};
use crate::results::{OWN, Outcome, Results};
use crate::{files, found_settings, paths};
use genga::error::Error;
use genga::sheet::Sheet;
use genga_files::{ClipMark, Run};
use genga_studio::{Export, Exported, Host, Opened, Pictures, Playing, Waveform};

/// Files on a disk.
#[derive(Debug, Default)]
pub struct Disk {
    /// The clip named on the command line, and which part of it is used.
    named: Option<(PathBuf, Part)>,
    /// The clip opened last, and the mark that identifies it.
    opened: Mutex<Option<(PathBuf, ClipMark)>>,
    recent: Recent,
}

impl Disk {
    /// Builds a disk with a clip or a folder of clips, and the part of each to use.
    #[cfg(any(feature = "studio", test))]
    pub(super) fn with_clip(clip: Option<PathBuf>, part: Part) -> Self {
        Self { named: clip.map(|clip| (clip, part)), ..Self::default() }
    }

    /// The same with the list of recent clips.
    #[cfg(feature = "studio")]
    pub(super) fn with_recent(clip: Option<PathBuf>, part: Part) -> Self {
        Self { recent: Recent::of_person(), ..Self::with_clip(clip, part) }
    }

    /// The mark that identifies a clip: as it was when opened, even if the file has changed since.
    fn mark(&self, clip: &Path) -> Result<ClipMark, Failure> {
        let opened = self.opened.lock().unwrap_or_else(PoisonError::into_inner).clone();
        match opened {
            Some((path, mark)) if path == clip => Ok(mark),
            _ => Ok(Part::default().read(clip)?.of),
        }
    }
}

impl Host for Disk {
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        let whole = Part::default();
        let is_meant = |named: &Path| named == clip || clip.parent() == Some(named);
        let part = self.named.as_ref().filter(|(named, _)| is_meant(named));
        let read = part.map_or(&whole, |(_, part)| part).read(clip).map_err(said)?;
        let notes = read.notes.iter().map(ToString::to_string).collect();
        *self.opened.lock().unwrap_or_else(PoisonError::into_inner) =
            Some((clip.to_owned(), read.of));
        Ok(Opened { clip: read.clip, notes })
    }

    fn read(&self, path: &Path) -> Result<Option<String>, String> {
        match fs::read_to_string(path) {
            Ok(text) => Ok(Some(text)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(format!("{}: {error}", path.display())),
        }
    }

    fn write(&self, path: &Path, text: &str) -> Result<(), String> {
        files::write(path, text.as_bytes()).map_err(said)
    }

    fn remove(&self, path: &Path) -> Result<(), String> {
        match fs::remove_file(path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(format!("{}: {error}", path.display()))
            }
            _ => Ok(()),
        }
    }

    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String> {
        let written = self.mark(export.clip).and_then(|mark| written(folder, export, mark, tell));
        written.map(Exported::from).map_err(said)
    }

    fn put_sample(&self, name: &str, text: &str) -> Result<PathBuf, String> {
        put(&home().join("genga"), name, text).map_err(said)
    }

    fn sheet_in(&self, folder: &Path, clip: &Path) -> Option<Sheet> {
        let mark = self.mark(clip).ok()?;
        numbers::before(&Folder::look(folder, Overwrites::default()), &mark).ok().flatten()
    }

    #[cfg(feature = "studio")]
    fn choose(&self) -> Option<PathBuf> {
        dialog::choose()
    }

    #[cfg(feature = "studio")]
    fn choose_folder(&self) -> Option<PathBuf> {
        dialog::choose_folder()
    }

    fn always(&self) -> Vec<&'static str> {
        Run::FORMATS.to_vec()
    }

    fn clips_in(&self, folder: &Path) -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let paths = entries.map(|entry| entry.path());
        let is_clip = |path: &PathBuf| paths::is_motion(path) && path.is_file();
        let mut clips: Vec<PathBuf> = paths.filter(is_clip).collect();
        clips.sort();
        clips
    }

    fn pictures_in(&self, folder: &Path) -> Vec<PathBuf> {
        pictures::in_folder(folder)
    }

    fn pictures(&self, of: &Path) -> Result<Pictures, String> {
        pictures::list(of)
    }

    fn picture(&self, file: &Path, within: [usize; 2]) -> Result<ColorImage, String> {
        pictures::read(file, within)
    }

    fn sound(&self, file: &Path) -> Result<Waveform, String> {
        sound::look(file)
    }

    fn play(&self, file: &Path, from: f64) -> Result<Box<dyn Playing>, String> {
        sound::play(file, from)
    }

    fn noted(&self, name: &str) -> Option<String> {
        self.recent.note_of(name).and_then(|file| fs::read_to_string(file).ok())
    }

    fn note(&self, name: &str, text: &str) {
        // A failure is ignored, as for the list of clips.
        if let Some(file) = self.recent.note_of(name) {
            let folder = file.parent().unwrap_or(Path::new("."));
            drop(fs::create_dir_all(folder).map(|()| files::write(&file, text.as_bytes())));
        }
    }

    fn recent(&self) -> Vec<PathBuf> {
        self.recent.clips()
    }

    fn remember(&self, clip: &Path) {
        // A list that cannot be written is not worth an error.
        drop(self.recent.remember(clip));
    }
}

/// Writes the same files as a run, and refuses to overwrite the same files.
fn written(
    folder: &Path,
    export: &Export<'_>,
    clip: ClipMark,
    tell: &dyn Fn(&str),
) -> Result<Vec<String>, Failure> {
    let names: Vec<String> = export.formats.iter().map(|name| (*name).to_owned()).collect();
    let formats = Formats::new("deliver", &names, &Run::FORMATS, &FormatArgs::default(), None)?;
    let formats = formats.set(export.settings);
    let tell = |name: &str| {
        tell(name);
        match export.stop.load(Ordering::Relaxed) {
            true => {
                let source = io::Error::new(ErrorKind::Interrupted, "stopped: nothing was written");
                Err(Error::Io { path: folder.to_owned(), source })
            }
            false => Ok(()),
        }
    };
    let name = paths::stem(export.clip);
    formats.spare("motion", export.clip, folder, &name)?;
    let motion = [("motion", Some(export.clip))];
    OWN.iter().try_for_each(|file| paths::spare(&motion, &folder.join(file)))?;
    formats.spare_edited(folder)?;
    let place = Folder::look(folder, Overwrites::default());
    let numbering = Numbering::new(export.breakdown.sheet, &place, &clip, false);
    let found = found_settings::still_in(export.recipe, place.found(&clip));
    let results = Results {
        name: &name,
        clip,
        breakdown: &export.breakdown.with_sheet(&numbering.sheet),
        recipe: export.recipe,
        edits: export.edits,
        found,
        renumbered: &numbering.drawings,
        notes: export.notes.iter().cloned().chain(numbering.note.clone()).collect(),
        is_own_recipe: false,
        sources: vec![],
        kept: None,
        tell: &tell,
    };
    let Outcome { mut files, unmade, left, .. } = results.write(&formats, place)?;
    let unmade = unmade.into_iter().map(|warning| warning.message);
    let counts = numbering.counts().map(|counts| format!("numbers as before: {counts}"));
    let said = counts.into_iter().chain(numbering.note);
    let notes = unmade.chain(left.notes()).chain(said);
    files.extend(notes.map(|note| format!("({note})")));
    Ok(files)
}

/// The person's own folder, where files are found again.
fn home() -> PathBuf {
    let name = if cfg!(windows) { "USERPROFILE" } else { "HOME" };
    let named = std::env::var_os(name).filter(|value| !value.is_empty());
    named.map_or_else(std::env::temp_dir, PathBuf::from)
}

/// Puts a file into a folder, unless it is there already. A file of the same name with other contents is refused.
fn put(folder: &Path, name: &str, text: &str) -> Result<PathBuf, Failure> {
    let path = folder.join(name);
    match fs::read(&path) {
        Ok(bytes) if bytes == text.as_bytes() => {}
        Ok(_) => {
            let message =
                format!("{}: another file has this name; open it, or move it away", path.display());
            return Err(Failure::CouldNot(message));
        }
        Err(_) => {
            fs::create_dir_all(folder).map_err(|error| Failure::io(folder, error))?;
            files::write(&path, text.as_bytes())?;
        }
    }
    Ok(path)
}

fn said(failure: Failure) -> String {
    failure.to_string()
}

/// Length of the list of recent clips, short enough to read at a glance.
const MOST: usize = 8;

/// Path of the list of recent clips: one path a line, newest first. `None` if the system has no folder for such
/// files.
#[derive(Debug, Default)]
struct Recent(Option<PathBuf>);

impl Recent {
    /// The list of the current user.
    #[cfg(feature = "studio")]
    fn of_person() -> Self {
        let folder =
            |name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let state = match cfg!(windows) {
            true => folder("LOCALAPPDATA"),
            false => folder("XDG_STATE_HOME")
                .or_else(|| folder("HOME").map(|home| home.join(".local/state"))),
        };
        Self(state.map(|state| state.join("genga/recent.txt")))
    }

    /// The file of a note, beside the list.
    fn note_of(&self, name: &str) -> Option<PathBuf> {
        self.0.as_ref().map(|list| list.with_file_name(format!("{name}.txt")))
    }

    /// The clips that still exist.
    fn clips(&self) -> Vec<PathBuf> {
        let text = self.0.as_ref().and_then(|file| fs::read_to_string(file).ok());
        let text = text.unwrap_or_default();
        text.lines().map(PathBuf::from).filter(|clip| clip.is_file()).take(MOST).collect()
    }

    /// Moves a clip to the front of the list.
    fn remember(&self, clip: &Path) -> Result<(), Failure> {
        let Some(file) = &self.0 else { return Ok(()) };
        let clip = std::path::absolute(clip).unwrap_or_else(|_| clip.to_owned());
        let others = self.clips().into_iter().filter(|other| *other != clip);
        let clips = [clip.clone()].into_iter().chain(others).take(MOST);
        // A path that is not UTF-8 or contains a newline could not be read back.
        let lines = clips.filter_map(|clip| Some(clip.to_str()?.to_owned()));
        let text: String =
            lines.filter(|line| !line.contains('\n')).map(|line| line + "\n").collect();
        if let Some(folder) = file.parent() {
            fs::create_dir_all(folder).map_err(|error| Failure::io(folder, error))?;
        }
        files::write(file, text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_offers_the_clips_of_every_format_and_nothing_else() {
        let place = tempfile::tempdir().unwrap();
        let files = ["b.FBX", "a.bvh", "c.vmd", "d.glb", "e.amc", "f.asf", "g.toml", "h", "i.vrma"];
        for file in files {
            fs::write(place.path().join(file), "").unwrap();
        }
        fs::create_dir(place.path().join("folder.bvh")).unwrap();
        let offered = Disk::default().clips_in(place.path());
        let names: Vec<_> = offered.iter().filter_map(|clip| clip.file_name()?.to_str()).collect();
        assert_eq!(names, ["a.bvh", "b.FBX", "c.vmd", "d.glb", "e.amc", "i.vrma"]);
    }

    #[test]
    fn the_sample_is_put_once_and_overwrites_nothing() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("genga");
        let path = put(&folder, "kick.bvh", genga::motion::bvh::KICK).unwrap();
        assert_eq!(Disk::default().open(&path).unwrap().clip.len(), 92);
        assert_eq!(put(&folder, "kick.bvh", genga::motion::bvh::KICK).unwrap(), path);
        fs::write(&path, "mine").unwrap();
        let refused = put(&folder, "kick.bvh", genga::motion::bvh::KICK).unwrap_err();
        assert!(refused.to_string().contains("another file has this name"), "{refused}");
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    }

    #[test]
    fn the_newest_comes_first_and_what_is_gone_is_not_offered() {
        let place = tempfile::tempdir().unwrap();
        let clips: Vec<PathBuf> =
            (0..MOST + 2).map(|at| place.path().join(format!("{at}.bvh"))).collect();
        let recent = Recent(Some(place.path().join("state/recent.txt")));
        assert!(recent.clips().is_empty());
        for clip in &clips {
            fs::write(clip, "").unwrap();
            recent.remember(clip).unwrap();
        }
        let newest: Vec<PathBuf> = clips.iter().rev().take(MOST).cloned().collect();
        assert_eq!(recent.clips(), newest);
        recent.remember(&clips[5]).unwrap();
        assert_eq!(recent.clips()[..2], [clips[5].clone(), clips[MOST + 1].clone()]);
        fs::remove_file(&clips[5]).unwrap();
        assert_eq!(recent.clips()[0], clips[MOST + 1]);
        assert!(Recent(None).remember(&clips[0]).is_ok(), "nowhere to remember is no failure");
    }
}
