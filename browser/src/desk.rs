//! Files as a page has them (ページの机): a person gives them, the browser's storage keeps what is written, and what is
//! saved or exported is given back as a download. Nothing is sent anywhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use eframe::egui::Context;
use genga::deliver::{ClipMark, Run};
use genga::motion::bvh::Cleaning;
use genga::motion::file;
use genga::studio::{Desk, Export, Opened};

use super::{export, page};

/// The files of a page.
#[derive(Clone)]
pub(crate) struct Table {
    /// To be woken when a file has come.
    context: Context,
    files: Arc<Mutex<Files>>,
}

/// What a person gave.
#[derive(Default)]
struct Files {
    by_name: BTreeMap<PathBuf, Result<Vec<u8>, String>>,
    /// Those that nobody has opened yet.
    new: Vec<PathBuf>,
    /// By what the clips are known again that were opened.
    marks: BTreeMap<PathBuf, ClipMark>,
}

impl Files {
    /// Under what the browser keeps a file. Clips of one name and another motion have nothing in common.
    fn key(&self, path: &Path) -> String {
        let name = file_name(path);
        let is_beside = |clip: &Path| {
            let stem = clip.file_stem().unwrap_or_default().to_string_lossy();
            name.strip_prefix(&*stem).is_some_and(|ending| ending.starts_with('.'))
        };
        let of = self.marks.iter().find(|(clip, _)| is_beside(clip));
        format!("genga/{}/{name}", of.map_or("", |(_, mark)| &mark.motion))
    }
}

impl Table {
    pub(crate) fn new(context: Context) -> Self {
        Self { context, files: Arc::default() }
    }

    /// Puts down a file with its bytes, or with why it could not be read.
    pub(crate) fn arrive(&self, name: PathBuf, bytes: Result<Vec<u8>, String>) {
        let mut files = self.files();
        files.by_name.insert(name.clone(), bytes);
        files.new.push(name);
        self.context.request_repaint();
    }

    /// The files that came since this was asked last.
    pub(crate) fn arrived(&self) -> Vec<PathBuf> {
        std::mem::take(&mut self.files().new)
    }

    fn files(&self) -> MutexGuard<'_, Files> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Desk for Table {
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        let mut files = self.files();
        let of_clip = |error: &dyn std::fmt::Display| format!("{}: {error}", clip.display());
        let bytes =
            files.by_name.get(clip).ok_or_else(|| of_clip(&"choose the file or drop it here"))?;
        let bytes = bytes.as_ref().map_err(|error| of_clip(error))?;
        let read = file::Options::default().read(bytes).map_err(|error| of_clip(&error))?;
        let mark = ClipMark::of(&file_name(clip), &read.clip);
        let (cleaned, notes) =
            Cleaning::default().of(read.clip).map_err(|error| of_clip(&error))?;
        cleaned.check_size().map_err(|error| of_clip(&error))?;
        let notes = read.warnings.iter().chain(&notes).map(ToString::to_string).collect();
        files.marks.insert(clip.to_owned(), mark);
        Ok(Opened { clip: cleaned, notes })
    }

    fn read(&self, path: &Path) -> Result<Option<String>, String> {
        let files = self.files();
        let Some(bytes) = files.by_name.get(path) else {
            return page::storage()?.get_item(&files.key(path)).map_err(page::said);
        };
        let text = bytes
            .clone()
            .and_then(|bytes| String::from_utf8(bytes).map_err(|_| "is not UTF-8".to_owned()));
        text.map(Some).map_err(|error| format!("{}: {error}", path.display()))
    }

    /// Both kept for the next visit and given to the person: the browser may forget it.
    fn write(&self, path: &Path, text: &str) -> Result<(), String> {
        self.keep(path, text)?;
        self.files().by_name.remove(path);
        page::give(&file_name(path), text.as_bytes())
    }

    fn keep(&self, path: &Path, text: &str) -> Result<(), String> {
        page::storage()?.set_item(&self.files().key(path), text).map_err(page::said)
    }

    fn remove(&self, path: &Path) -> Result<(), String> {
        page::storage()?.remove_item(&self.files().key(path)).map_err(page::said)
    }

    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Vec<String>, String> {
        let clip = self.files().marks.get(export.clip).cloned().ok_or("no clip is open")?;
        let folder = file_name(folder);
        let (archive, files) = export::archive(&folder, export, &clip, tell)?;
        page::give(&format!("{folder}.zip"), &archive)?;
        Ok(files)
    }

    fn always(&self) -> Vec<&'static str> {
        Run::FORMATS.to_vec()
    }

    fn choose(&self) -> Option<PathBuf> {
        let table = self.clone();
        page::choose(move |name, bytes| table.arrive(name.into(), bytes));
        None
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
