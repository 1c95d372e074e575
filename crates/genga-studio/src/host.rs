//! The desk (机): the studio's access to the world outside. The studio itself opens no files, so that tests can run it
//! without a disk or with a full one.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use egui::ColorImage;

use super::waveform::Waveform;
use genga::edits::Edits;
use genga::motion::Clip;
use genga::pipeline::Breakdown;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga_files::Settings;

/// Access to files, as the host program has it. Every failure is described in one plain sentence.
pub trait Host: Send + Sync {
    /// Reads a motion.
    ///
    /// # Errors
    /// Why the file is not a motion, with the place in the file.
    fn open(&self, clip: &Path) -> Result<Opened, String>;

    /// Removes capture errors from a motion, if [`Host::open`] leaves that to a separate step: a web page is blocked
    /// while a step runs. Default: returns the motion unchanged.
    ///
    /// # Errors
    /// Why no motion is left.
    fn clean(&self, _: &Path, opened: Opened) -> Result<Opened, String> {
        Ok(opened)
    }

    /// Returns the text of a file. `None` if the file does not exist.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&self, path: &Path) -> Result<Option<String>, String>;

    /// Writes a file, either whole or not at all.
    ///
    /// # Errors
    /// Why the file cannot be written. Its previous content is unchanged.
    fn write(&self, path: &Path, text: &str) -> Result<(), String>;

    /// Keeps unsaved work in case of a crash. By default writes it with [`Host::write`]; a desk may have a better
    /// place.
    ///
    /// # Errors
    /// Those of [`Host::write`].
    fn keep(&self, path: &Path, text: &str) -> Result<(), String> {
        self.write(path, text)
    }

    /// Removes a file. Succeeds if the file does not exist.
    ///
    /// # Errors
    /// Why the file is still there.
    fn remove(&self, path: &Path) -> Result<(), String>;

    /// Writes all exports of a run into a folder, on its own thread. Calls `tell` with the name of each before writing
    /// it.
    ///
    /// # Errors
    /// Why the folder cannot be written. It is left as it was.
    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String>;

    /// Puts the built-in clip where [`open`](Self::open) finds it, and returns its path. Nothing is overwritten.
    ///
    /// # Errors
    /// Why it cannot be put there. By default there is no such place.
    fn put_sample(&self, name: &str, _text: &str) -> Result<PathBuf, String> {
        Err(format!("{name}: there is no place for it here"))
    }

    /// Returns the sheet that the last export of a clip wrote into a folder: its drawings keep their numbers. Default:
    /// there is none, and drawings are numbered from 1.
    fn sheet_in(&self, _folder: &Path, _clip: &Path) -> Option<Sheet> {
        None
    }

    /// Lets the person choose a clip or a recipe in a system dialog, on its own thread. `None` if they cancel. Default:
    /// the desk has no dialog, and returns `None`.
    fn choose(&self) -> Option<PathBuf> {
        None
    }

    /// Lets the person choose a folder, as [`choose`](Self::choose) does a file.
    fn choose_folder(&self) -> Option<PathBuf> {
        None
    }

    /// Whether files can be found by their names and folders listed. Otherwise a person hands over each file.
    fn has_names(&self) -> bool {
        true
    }

    /// The names of the formats that every export has.
    fn always(&self) -> Vec<&'static str> {
        vec![]
    }

    /// Returns the clips in a folder, sorted by name. Empty if it is no folder.
    fn clips_in(&self, _folder: &Path) -> Vec<PathBuf> {
        vec![]
    }

    /// Returns the pictures in a folder, in order. Empty if it is no folder.
    fn pictures_in(&self, _folder: &Path) -> Vec<PathBuf> {
        vec![]
    }

    /// Returns the pictures of a reference: a folder, a numbered sequence given by one of its files, or a video. Called
    /// on its own thread, since it may take long.
    ///
    /// # Errors
    /// Why there are none. By default pictures are not supported.
    fn pictures(&self, of: &Path) -> Result<Pictures, String> {
        Err(format!("{}: reference pictures are not supported here", of.display()))
    }

    /// Returns a picture, scaled down to fit into `within`. Called on its own thread.
    ///
    /// # Errors
    /// Why it is no picture.
    fn picture(&self, file: &Path, _within: [usize; 2]) -> Result<ColorImage, String> {
        Err(format!("{}: pictures are not supported here", file.display()))
    }

    /// Returns the loudness of a sound. Called on its own thread.
    ///
    /// # Errors
    /// Why it is no sound. By default sound is not supported.
    fn sound(&self, file: &Path) -> Result<Waveform, String> {
        Err(format!("{}: sound is not supported here", file.display()))
    }

    /// Plays a sound in the background from the given second, until the returned [`Playing`] is dropped.
    ///
    /// # Errors
    /// Why the sound cannot be played.
    fn play(&self, file: &Path, _from: f64) -> Result<Box<dyn Playing>, String> {
        Err(format!("{}: playing sound is not supported here", file.display()))
    }

    /// Returns the text last noted under a name. Default: remembers nothing, and returns `None`.
    fn noted(&self, _name: &str) -> Option<String> {
        None
    }

    /// Notes a preference of the person under a name, for the next session.
    fn note(&self, _name: &str, _text: &str) {}

    /// Returns the clips opened last, newest first. Default: remembers nothing, and returns an empty list.
    fn recent(&self) -> Vec<PathBuf> {
        vec![]
    }

    /// Remembers a clip as the newest one.
    fn remember(&self, _clip: &Path) {}
}

/// Pictures in order.
#[derive(Clone)]
pub struct Pictures {
    /// Their files, in order.
    pub files: Vec<PathBuf>,
    /// A sentence about the pictures that the person should know.
    pub note: Option<String>,
    /// Guard that keeps the files in place while it lives.
    pub kept: Option<Arc<dyn Send + Sync>>,
}

/// A sound that is being played. Dropping it stops the sound.
pub trait Playing: Send {
    /// Returns why the sound cannot be heard, once that is known.
    fn fault(&self) -> Option<String>;
}

/// A motion that was read.
#[derive(Debug)]
pub struct Opened {
    /// The motion, without a T-pose in front of it.
    pub clip: Clip,
    /// Sentences about the file that the person should know.
    pub notes: Vec<String>,
}

/// Outcome of an export.
pub enum Exported {
    /// The export is written. Holds the names of its files.
    Files(Vec<String>),
    /// The export is being written elsewhere, for example by a desk without threads.
    Elsewhere(Pending),
}

impl From<Vec<String>> for Exported {
    fn from(files: Vec<String>) -> Self {
        Self::Files(files)
    }
}

/// Polls an export that is written elsewhere, once a frame. Takes the stop flag, and a callback to call with the name
/// of each file. Returns the names of the files, or why there are none, once the export has ended.
pub type Pending =
    Box<dyn FnMut(&AtomicBool, &dyn Fn(&str)) -> Option<Result<Vec<String>, String>> + Send>;

/// Contents of an export.
#[derive(Debug, Clone, Copy)]
pub struct Export<'a> {
    /// Path of the clip, as it was opened.
    pub clip: &'a Path,
    /// All results of the run.
    pub breakdown: &'a Breakdown<'a>,
    /// Settings from which the results were made.
    pub recipe: &'a Recipe,
    /// Corrections from which the results were made.
    pub edits: &'a Edits,
    /// Formats beyond those that every export has.
    pub formats: &'a [&'static str],
    /// Settings of the formats: paper, pictures, tables, and the camera of figures.
    pub settings: &'a Settings,
    /// Set when the person stops the export: the remaining files are not written.
    pub stop: &'a AtomicBool,
    /// The reader's notes on the clip.
    pub notes: &'a [String],
}

/// A desk that only opens clips: it discards everything written or exported.
///
/// ```
/// use std::path::Path;
/// use genga::motion::bvh;
/// use genga_studio::{ClipsAlone, Host};
///
/// let desk = ClipsAlone(|path: &Path| match bvh::open(path) {
///     Ok(read) => Ok(read.clip),
///     Err(error) => Err(error.to_string()),
/// });
/// assert_eq!(desk.open("../../data/kick.bvh".as_ref())?.clip.len(), 92);
/// assert_eq!(desk.read("../../data/kick.genga.toml".as_ref())?, None);
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ClipsAlone<F>(
    /// Returns the clip at a path, or says why there is none.
    pub F,
);

impl<F> Host for ClipsAlone<F>
where
    F: Fn(&Path) -> Result<Clip, String> + Send + Sync,
{
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        Ok(Opened { clip: (self.0)(clip)?, notes: vec![] })
    }

    fn read(&self, _: &Path) -> Result<Option<String>, String> {
        Ok(None)
    }

    fn write(&self, _: &Path, _: &str) -> Result<(), String> {
        Ok(())
    }

    fn remove(&self, _: &Path) -> Result<(), String> {
        Ok(())
    }

    fn export(&self, _: &Path, _: &Export<'_>, _: &dyn Fn(&str)) -> Result<Exported, String> {
        Ok(vec![].into())
    }
}
