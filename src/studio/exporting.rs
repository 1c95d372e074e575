//! Results that are being written (書き出し).

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use egui::Ui;

use super::command::Command;
use super::desk::{Desk, Export, Exported, Pending};
use super::document::Document;
use super::errand::{Errand, Look};
use super::focus::Part;
use super::order::Order;
use super::words::Words;
use crate::pipeline::Engine;

/// Everything that is exported, apart from the clip that is worked on meanwhile.
pub(super) struct Parcel {
    /// The clip's file.
    pub(super) clip: PathBuf,
    pub(super) order: Order,
    pub(super) document: Document,
    pub(super) notes: Vec<String>,
    /// With the results made so far.
    pub(super) engine: Engine,
}

impl Parcel {
    fn write(
        mut self,
        desk: &dyn Desk,
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

/// An export on its way.
pub(super) struct Exporting {
    folder: PathBuf,
    /// What is being written.
    what: Arc<Mutex<String>>,
    stop: Arc<AtomicBool>,
    errand: Errand<Result<Vec<String>, String>>,
}

impl Exporting {
    /// Begins to write.
    pub(super) fn begin(desk: &Arc<dyn Desk>, parcel: Parcel) -> Self {
        let (desk, folder) = (Arc::clone(desk), parcel.order.folder.clone());
        let what: Arc<Mutex<String>> = Arc::default();
        let told = Arc::clone(&what);
        // A word is whole whatever happened to whoever wrote the last one.
        let tell = move |name: &str| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = name.to_owned();
        };
        let stop: Arc<AtomicBool> = Arc::default();
        let stopped = Arc::clone(&stop);
        let (mut parcel, mut elsewhere) = (Some(parcel), None::<Pending>);
        let errand = Errand::in_steps(move || {
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
        Self { folder, what, stop, errand }
    }

    /// What was written, or why nothing was, as a sentence; nothing while it is written.
    pub(super) fn look(&self) -> Option<Result<String, String>> {
        let folder = self.folder.display();
        match self.errand.look() {
            Look::Waiting => None,
            Look::Done(files) => Some(files.map(|files| format!("{folder}: {}", files.join(" ")))),
            Look::BrokeOff => Some(Err(format!("{folder}: writing it broke off"))),
        }
    }

    /// Wants no more of it.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Says what is being written, and lets it be stopped.
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
