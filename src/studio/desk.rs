//! The desk (机): what the studio asks of the world outside. It has no files of its own, so that it can be
//! tried without a disk, and on a full one.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use egui::ColorImage;

use super::waveform::Waveform;
use crate::deliver::Settings;
use crate::edits::Edits;
use crate::motion::Clip;
use crate::pipeline::Breakdown;
use crate::recipe::Recipe;

/// Files, as a program has them. Whatever fails is said in one plain sentence.
pub trait Desk: Send + Sync {
    /// Reads a motion.
    ///
    /// # Errors
    /// Why it is none, with the place in the file.
    fn open(&self, clip: &Path) -> Result<Opened, String>;

    /// Takes out of a motion what no body did, where [`Desk::open`] leaves that to a step of its own: a page stands still
    /// for as long as one takes. Default: nothing is left to do.
    ///
    /// # Errors
    /// Why nothing is left of it.
    fn clean(&self, _: &Path, opened: Opened) -> Result<Opened, String> {
        Ok(opened)
    }

    /// The text of a file; none where there is no such file.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn read(&self, path: &Path) -> Result<Option<String>, String>;

    /// Writes a file whole or not at all.
    ///
    /// # Errors
    /// Why it cannot be written. What was there before still is.
    fn write(&self, path: &Path, text: &str) -> Result<(), String>;

    /// Keeps what is not saved, in case of a crash: writes it, unless a desk has a better place for it.
    ///
    /// # Errors
    /// Those of [`Desk::write`].
    fn keep(&self, path: &Path, text: &str) -> Result<(), String> {
        self.write(path, text)
    }

    /// Takes a file away. One that is not there is no failure.
    ///
    /// # Errors
    /// Why it is still there.
    fn remove(&self, path: &Path) -> Result<(), String>;

    /// Writes everything that a run writes into a folder, on a thread of its own, and tells what it is about to write.
    ///
    /// # Errors
    /// Why it cannot be written. The folder is as it was before.
    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String>;

    /// Lets the person choose a clip or a recipe in a dialog of the system, on a thread of its own. None when they
    /// choose none, and where there is no such dialog, as on a desk that says nothing else.
    fn choose(&self) -> Option<PathBuf> {
        None
    }

    /// Lets the person choose a folder, as [`choose`](Self::choose) a file.
    fn choose_folder(&self) -> Option<PathBuf> {
        None
    }

    /// Whether files are found by their names, and folders hold them. Else a person gives each by hand.
    fn has_names(&self) -> bool {
        true
    }

    /// The names of the formats that every export has.
    fn always(&self) -> Vec<&'static str> {
        vec![]
    }

    /// The clips in a folder, in the order of their names; none for what is no folder.
    fn clips_in(&self, _folder: &Path) -> Vec<PathBuf> {
        vec![]
    }

    /// The pictures in a folder, in their order; none for what is no folder.
    fn pictures_in(&self, _folder: &Path) -> Vec<PathBuf> {
        vec![]
    }

    /// The pictures that something beside a clip consists of: a folder of them, a numbered sequence by one of it, or a
    /// video. Asked on a thread of its own; it may take long.
    ///
    /// # Errors
    /// Why there are none, as on a desk that shows none.
    fn pictures(&self, of: &Path) -> Result<Pictures, String> {
        Err(format!("{}: pictures beside the motion cannot be shown here", of.display()))
    }

    /// A picture, made as small as it takes to be nowhere larger than `within`; on a thread of its own.
    ///
    /// # Errors
    /// Why it is none.
    fn picture(&self, file: &Path, _within: [usize; 2]) -> Result<ColorImage, String> {
        Err(format!("{}: pictures cannot be shown here", file.display()))
    }

    /// How loud a sound is, on a thread of its own.
    ///
    /// # Errors
    /// Why it is none, as on a desk that hears nothing.
    fn sound(&self, file: &Path) -> Result<Waveform, String> {
        Err(format!("{}: sound cannot be heard here", file.display()))
    }

    /// Plays a sound from a second on, beside everything else, until what it gives is dropped.
    ///
    /// # Errors
    /// Why nothing is heard.
    fn play(&self, file: &Path, _from: f64) -> Result<Box<dyn Playing>, String> {
        Err(format!("{}: sound cannot be played here", file.display()))
    }

    /// What was last noted under a name; none on a desk that remembers nothing.
    fn noted(&self, _name: &str) -> Option<String> {
        None
    }

    /// Notes how a person likes to work, for the next time.
    fn note(&self, _name: &str, _text: &str) {}

    /// The clips that were opened last, the newest first; none on a desk that remembers nothing.
    fn recent(&self) -> Vec<PathBuf> {
        vec![]
    }

    /// Remembers a clip as the newest.
    fn remember(&self, _clip: &Path) {}
}

/// Pictures in their order.
#[derive(Clone)]
pub struct Pictures {
    /// Their files.
    pub files: Vec<PathBuf>,
    /// What a person should know of them, as a sentence.
    pub note: Option<String>,
    /// Whatever keeps the files where they are.
    pub kept: Option<Arc<dyn Send + Sync>>,
}

/// A sound that is being played. It ends when this is dropped.
pub trait Playing: Send {
    /// Why nothing is heard, once that is known.
    fn fault(&self) -> Option<String>;
}

/// A motion that was read.
#[derive(Debug)]
pub struct Opened {
    /// The motion, without a T-pose in front of it.
    pub clip: Clip,
    /// What a person should know about the file, as sentences.
    pub notes: Vec<String>,
}

/// What became of an export.
pub enum Exported {
    /// It is written: the names of its files.
    Files(Vec<String>),
    /// It is being written elsewhere, as by a desk without threads.
    Elsewhere(Pending),
}

impl From<Vec<String>> for Exported {
    fn from(files: Vec<String>) -> Self {
        Self::Files(files)
    }
}

/// A look at what is written elsewhere, once a frame. It hears whether to stop, tells what is being written, and gives in the
/// end the names of the files, or why there are none.
pub type Pending =
    Box<dyn FnMut(&AtomicBool, &dyn Fn(&str)) -> Option<Result<Vec<String>, String>> + Send>;

/// What is exported.
#[derive(Debug, Clone, Copy)]
pub struct Export<'a> {
    /// The clip's file, as it was opened.
    pub clip: &'a Path,
    /// Every result.
    pub breakdown: &'a Breakdown<'a>,
    /// The settings it was made with.
    pub recipe: &'a Recipe,
    /// The corrections it was made with.
    pub edits: &'a Edits,
    /// Formats beside those that every export has.
    pub formats: &'a [&'static str],
    /// The settings of the formats: paper, pictures, tables, and from where figures are seen.
    pub settings: &'a Settings,
    /// Set once the person wants no more of it: what is yet to be written is not.
    pub stop: &'a AtomicBool,
    /// What the reader said of the file.
    pub notes: &'a [String],
}

/// A desk with clips and nothing else: what is written on it is gone, and so is what is exported.
///
/// ```
/// use std::path::Path;
/// use genga::motion::bvh;
/// use genga::studio::{ClipsAlone, Desk};
///
/// let desk = ClipsAlone(|path: &Path| match bvh::open(path) {
///     Ok(read) => Ok(read.clip),
///     Err(error) => Err(error.to_string()),
/// });
/// assert_eq!(desk.open("data/kick.bvh".as_ref())?.clip.len(), 92);
/// assert_eq!(desk.read("data/kick.genga.toml".as_ref())?, None);
/// # Ok::<(), String>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct ClipsAlone<F>(
    /// Gives the clip of a name, or says why there is none.
    pub F,
);

impl<F> Desk for ClipsAlone<F>
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
