//! A desk with files in memory.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, Weak};

use genga::edits::Edits;
use genga::sheet::Sheet;
use genga_cli::Disk;
use genga_studio::{Export, Exported, Host, Opened, Pictures, Playing, Waveform};

/// Reads clips from the disk, and keeps all other files in memory.
#[derive(Default)]
pub(crate) struct Memory {
    pub(crate) files: Mutex<BTreeMap<PathBuf, String>>,
    /// Whether every write fails as on a full disk.
    pub(crate) is_full: Mutex<bool>,
    /// Lock that holds up an export.
    pub(crate) is_writing: Mutex<()>,
    /// Corrections of the exports so far.
    pub(crate) exported: Mutex<Vec<Edits>>,
    /// The file chosen in the next dialog.
    pub(crate) chosen: Mutex<Option<PathBuf>>,
    /// The clips opened so far, newest first.
    pub(crate) opened: Mutex<Vec<PathBuf>>,
    /// Notes by their names.
    pub(crate) notes: Mutex<BTreeMap<String, String>>,
    /// Sounds played so far: the file, the second it began at, and whether it still plays.
    pub(crate) played: Mutex<Vec<(PathBuf, f64, Weak<()>)>>,
    /// Whether playing fails as on a machine without sound.
    pub(crate) is_silent: Mutex<bool>,
    /// Lock that holds up the reading of a picture.
    pub(crate) is_reading: Mutex<()>,
    disk: Disk,
}

/// A sound being played, silently.
struct Heard(#[allow(dead_code, reason = "it is there for as long as it is played")] Arc<()>);

impl Playing for Heard {
    fn fault(&self) -> Option<String> {
        None
    }
}

impl Memory {
    /// Returns the text of a file. `None` if the file does not exist.
    pub(crate) fn text(&self, path: &Path) -> Option<String> {
        self.files.lock().unwrap().get(path).cloned()
    }
}

impl Host for Memory {
    fn open(&self, clip: &Path) -> Result<Opened, String> {
        self.disk.open(clip)
    }

    fn read(&self, path: &Path) -> Result<Option<String>, String> {
        Ok(self.text(path))
    }

    fn write(&self, path: &Path, text: &str) -> Result<(), String> {
        if *self.is_full.lock().unwrap() {
            return Err(format!("{}: no space left", path.display()));
        }
        self.files.lock().unwrap().insert(path.to_owned(), text.to_owned());
        Ok(())
    }

    fn remove(&self, path: &Path) -> Result<(), String> {
        self.files.lock().unwrap().remove(path);
        Ok(())
    }

    fn export(
        &self,
        folder: &Path,
        export: &Export<'_>,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String> {
        drop(self.is_writing.lock().unwrap());
        if folder == crate::harness::sample("kick-genga") {
            // No files are written beside the samples.
            self.exported.lock().unwrap().push(export.edits.clone());
            return Ok(vec![].into());
        }
        self.disk.export(folder, export, tell)
    }

    fn put_sample(&self, name: &str, text: &str) -> Result<PathBuf, String> {
        let path = crate::harness::sample(name);
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
        Ok(path)
    }

    fn sheet_in(&self, folder: &Path, clip: &Path) -> Option<Sheet> {
        self.disk.sheet_in(folder, clip)
    }

    fn choose(&self) -> Option<PathBuf> {
        self.chosen.lock().unwrap().take()
    }

    fn choose_folder(&self) -> Option<PathBuf> {
        self.choose()
    }

    fn always(&self) -> Vec<&'static str> {
        self.disk.always()
    }

    fn clips_in(&self, folder: &Path) -> Vec<PathBuf> {
        self.disk.clips_in(folder)
    }

    fn pictures_in(&self, folder: &Path) -> Vec<PathBuf> {
        self.disk.pictures_in(folder)
    }

    fn pictures(&self, of: &Path) -> Result<Pictures, String> {
        self.disk.pictures(of)
    }

    fn picture(&self, file: &Path, within: [usize; 2]) -> Result<egui::ColorImage, String> {
        drop(self.is_reading.lock().unwrap());
        self.disk.picture(file, within)
    }

    fn sound(&self, file: &Path) -> Result<Waveform, String> {
        self.disk.sound(file)
    }

    fn play(&self, file: &Path, from: f64) -> Result<Box<dyn Playing>, String> {
        if *self.is_silent.lock().unwrap() {
            return Err("no sound is heard: there is no player".into());
        }
        let heard = Arc::new(());
        self.played.lock().unwrap().push((file.to_owned(), from, Arc::downgrade(&heard)));
        Ok(Box::new(Heard(heard)))
    }

    fn noted(&self, name: &str) -> Option<String> {
        self.notes.lock().unwrap().get(name).cloned()
    }

    fn note(&self, name: &str, text: &str) {
        self.notes.lock().unwrap().insert(name.to_owned(), text.to_owned());
    }

    fn recent(&self) -> Vec<PathBuf> {
        self.opened.lock().unwrap().clone()
    }

    fn remember(&self, clip: &Path) {
        let mut opened = self.opened.lock().unwrap();
        opened.retain(|other| other != clip);
        opened.insert(0, clip.to_owned());
    }
}

impl Memory {
    /// Writes a file.
    pub(crate) fn write_text(&self, path: &Path, text: &str) {
        self.files.lock().unwrap().insert(path.to_owned(), text.to_owned());
    }
}
