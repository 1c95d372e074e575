//! An export in progress (書き出し).

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use egui::Ui;

use super::command::Command;
use super::destinations::{self, Destination};
use super::document::Document;
use super::export_settings::Order;
use super::focus::Part;
use super::host::{Export, Exported, Host, Pending};
use super::task::{Look, Task};
use super::words::Words;
use genga::pipeline::Engine;

/// Everything an export needs, independent of the clip on the table, which may change meanwhile.
pub(super) struct Parcel {
    /// The clip's file.
    pub(super) clip: PathBuf,
    pub(super) order: Order,
    pub(super) document: Document,
    pub(super) notes: Vec<String>,
    /// The engine with the results so far.
    pub(super) engine: Engine,
}

impl Parcel {
    fn write(
        mut self,
        desk: &dyn Host,
        stop: &AtomicBool,
        tell: &dyn Fn(&str),
    ) -> Result<Exported, String> {
        let Document { recipe, edits, .. } = &self.document;
        let breakdown = self.engine.run(recipe, edits).map_err(|error| error.to_string())?;
        let (clip, notes) = (&*self.clip, &*self.notes);
        let (formats, settings) = (&*self.order.formats, &self.order.settings());
        let export =
            Export { clip, breakdown: &breakdown, recipe, edits, formats, settings, stop, notes };
        desk.export(&self.order.folder, &export, tell)
    }
}

/// An export in progress.
pub(super) struct Exporting {
    pub(super) folder: PathBuf,
    /// The clip that is exported.
    pub(super) clip: PathBuf,
    /// Where the results go. `None` for formats of its own.
    pub(super) to: Option<&'static Destination>,
    /// Name of the result being written.
    what: Arc<Mutex<String>>,
    stop: Arc<AtomicBool>,
    errand: Task<Result<Vec<String>, String>>,
}

impl Exporting {
    /// Starts writing.
    pub(super) fn begin(desk: &Arc<dyn Host>, parcel: Parcel) -> Self {
        let (desk, folder) = (Arc::clone(desk), parcel.order.folder.clone());
        let clip = parcel.clip.clone();
        let to = destinations::of(&parcel.order);
        let what: Arc<Mutex<String>> = Arc::default();
        let told = Arc::clone(&what);
        // The text is replaced as a whole, so that a poisoned lock is harmless.
        let tell = move |name: &str| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = name.to_owned();
        };
        let stop: Arc<AtomicBool> = Arc::default();
        let stopped = Arc::clone(&stop);
        let (mut parcel, mut elsewhere) = (Some(parcel), None::<Pending>);
        let errand = Task::in_steps(move || {
            if let Some(look) = &mut elsewhere {
                return look(&stopped, &tell);
            }
            match parcel.take()?.write(&*desk, &stopped, &tell) {
                Ok(Exported::Elsewhere(pending)) => elsewhere = Some(pending),
                Ok(Exported::Files(files)) => return Some(Ok(files)),
                Err(why) => return Some(Err(why)),
            }
            None
        });
        Self { folder, clip, to, what, stop, errand }
    }

    /// Returns the files written, or why there are none, as a sentence. `None` while writing.
    pub(super) fn look(&self) -> Option<Result<String, String>> {
        let folder = self.folder.display();
        match self.errand.look() {
            Look::Waiting => None,
            Look::Done(files) => Some(files.map(|files| format!("{folder}: {}", listed(&files)))),
            Look::BrokeOff => Some(Err(format!("{folder}: writing was aborted"))),
        }
    }

    /// Asks the export to stop.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Shows the progress, with a button that stops the export.
    pub(super) fn show(&self, ui: &mut Ui, words: Words, commands: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            ui.spinner();
            let exporting = words.say("exporting to", "書き出し中");
            let what = self.what.lock().unwrap_or_else(PoisonError::into_inner);
            ui.label(format!("{exporting} {}: {what}", self.folder.display()));
            let stop = ui.button(words.say("Stop writing", "書き出しを中止"));
            Part::Notices.begins(&stop);
            if stop.clicked() {
                commands.push(Command::StopExport);
            }
        });
    }
}

/// Lists files by name, those of a folder by their number.
fn listed(files: &[String]) -> String {
    let mut words: Vec<String> = Vec::new();
    for some in files.chunk_by(|a, b| folder(a) == folder(b)) {
        match folder(&some[0]) {
            Some(name) => words.push(format!("{name}/ ({})", some.len())),
            None => words.extend_from_slice(some),
        }
    }
    words.join(" ")
}

fn folder(file: &str) -> Option<&str> {
    file.split_once('/').map(|(folder, _)| folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_a_folder_are_counted_and_others_are_named() {
        let files = ["sheet.json", "images/A_0001.png", "images/A_0002.png", "a.xdts"];
        let files = files.map(String::from);
        assert_eq!(listed(&files), "sheet.json images/ (2) a.xdts");
    }
}
