//! Files on a page (ページの机): a person gives them, the browser's storage keeps what is written, and saved or exported
//! files are returned as downloads. Nothing is sent anywhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use eframe::egui::Context;
use genga_files::{ClipMark, Run};
use genga_studio::{Export, Exported, Host, Opened};

use super::clip::Read;
use super::{clip, export, page, worker};

/// The files of a page.
#[derive(Clone)]
pub(crate) struct Table {
    /// Repainted when a file has come.
    context: Context,
    files: Arc<Mutex<Files>>,
}

/// The files that a person gave.
#[derive(Default)]
struct Files {
    by_name: BTreeMap<PathBuf, Result<Vec<u8>, String>>,
    /// Files that have not been opened yet.
    new: Vec<PathBuf>,
    /// Marks that identify the opened clips.
    marks: BTreeMap<PathBuf, ClipMark>,
}

impl Files {
    /// The bytes of a given file.
    fn bytes(&self, path: &Path) -> Result<&[u8], String> {
        let why = match self.by_name.get(path) {
            Some(Ok(bytes)) => return Ok(bytes),
            Some(Err(error)) => error,
            None => "choose the file or drop it here",
        };
        Err(format!("{}: {why}", path.display()))
    }

    /// The storage key of a file. It contains the motion's digest, so that clips of the same name with different
    /// motions share nothing.
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

    /// Adds a file with its bytes, or with the error of reading it.
    pub(crate) fn arrive(&self, name: PathBuf, bytes: Result<Vec<u8>, String>) {
        let mut files = self.files();
        files.by_name.insert(name.clone(), bytes);
        files.new.push(name);
        self.context.request_repaint();
    }

    /// Takes the files that came since the last call.
    pub(crate) fn arrived(&self) -> Vec<PathBuf> {
        std::mem::take(&mut self.files().new)
    }

    fn files(&self) -> MutexGuard<'_, Files> {
        self.files.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Host for Table {
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        let mut files = self.files();
        let name = file_name(clip);
        let Read { clip: read, mark, notes } = Read::new(&name, files.bytes(clip)?)?;
        files.marks.insert(clip.to_owned(), mark);
        Ok(Opened { clip: read, notes })
    }

    fn clean(&self, clip: &Path, opened: Opened) -> Result<Opened, String> {
        let (clip, notes) = clip::cleaned(&file_name(clip), opened.clip, opened.notes)?;
        Ok(Opened { clip, notes })
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

    /// Keeps the file for the next visit and also downloads it, because the browser may forget it.
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

    /// Exports on a worker, or on this thread if there is none.
    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String> {
        let (files, folder) = (self.files(), file_name(folder));
        let (bytes, name) = (files.bytes(export.clip)?, file_name(export.clip));
        if let Some(pending) = worker::begin(&folder, &name, bytes, export) {
            return Ok(Exported::Elsewhere(pending));
        }
        let clip = files.marks.get(export.clip).ok_or("no clip is open")?;
        let (archive, files) = export::archive(&folder, export, clip, tell)?;
        page::give(&format!("{folder}.zip"), &archive)?;
        Ok(files.into())
    }

    fn noted(&self, name: &str) -> Option<String> {
        page::storage().ok()?.get_item(&note(name)).ok()?
    }

    fn note(&self, name: &str, text: &str) {
        // A preference that cannot be kept is not worth an error.
        drop(page::storage().map(|storage| storage.set_item(&note(name), text)));
    }

    fn put_sample(&self, name: &str, text: &str) -> Result<PathBuf, String> {
        self.files().by_name.insert(name.into(), Ok(text.as_bytes().to_vec()));
        Ok(name.into())
    }

    fn has_names(&self) -> bool {
        false
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

/// The storage key of a note.
fn note(name: &str) -> String {
    format!("genga-note/{name}")
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
