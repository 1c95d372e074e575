//! Results that are being written (書き出し).

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use egui::Ui;

use super::desk::{Desk, Export};
use super::document::Document;
use super::errand::{Errand, Look};
use super::words::Words;
use crate::pipeline::Engine;

/// Everything that is exported, apart from the clip that is worked on meanwhile.
pub(super) struct Parcel {
    /// The clip's file.
    pub(super) clip: PathBuf,
    pub(super) folder: PathBuf,
    pub(super) document: Document,
    pub(super) notes: Vec<String>,
    /// With the results made so far.
    pub(super) engine: Engine,
}

impl Parcel {
    fn write(mut self, desk: &dyn Desk, tell: &dyn Fn(&str)) -> Result<Vec<String>, String> {
        let Document { recipe, edits } = &self.document;
        let breakdown = self.engine.run(recipe, edits).map_err(|error| error.to_string())?;
        let (clip, notes) = (&*self.clip, &*self.notes);
        let export = Export { clip, breakdown: &breakdown, recipe, edits, notes };
        desk.export(&self.folder, &export, tell)
    }
}

/// An export on its way.
pub(super) struct Exporting {
    folder: PathBuf,
    /// What is being written.
    what: Arc<Mutex<String>>,
    errand: Errand<Result<Vec<String>, String>>,
}

impl Exporting {
    /// Begins to write.
    pub(super) fn begin(desk: &Arc<dyn Desk>, parcel: Parcel) -> Self {
        let (desk, folder) = (Arc::clone(desk), parcel.folder.clone());
        let what: Arc<Mutex<String>> = Arc::default();
        let told = Arc::clone(&what);
        // A word is whole whatever happened to whoever wrote the last one.
        let tell = move |name: &str| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = name.to_owned();
        };
        Self { folder, what, errand: Errand::begin(move || parcel.write(&*desk, &tell)) }
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

    /// Says what is being written.
    pub(super) fn show(&self, ui: &mut Ui, words: Words) {
        ui.horizontal(|ui| {
            ui.spinner();
            let exporting = words.say("exporting to", "書き出し中");
            let what = self.what.lock().unwrap_or_else(PoisonError::into_inner);
            ui.label(format!("{exporting} {}: {what}", self.folder.display()));
        });
    }
}
