//! A clip that is being read (読み込み).

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Ui;

use super::desk::Desk;
use super::errand::{Errand, Look};
use super::take::Take;
use super::words::Words;

/// A clip on its way.
pub(super) struct Opening {
    path: PathBuf,
    errand: Errand<Result<Take, String>>,
}

impl Opening {
    /// Begins to read.
    pub(super) fn begin(desk: &Arc<dyn Desk>, path: &Path, recipe: Option<&Path>) -> Self {
        let (desk, clip) = (Arc::clone(desk), path.to_owned());
        let recipe = recipe.map(Path::to_owned);
        let errand = Errand::begin(move || Take::open(&*desk, &clip, recipe.as_deref()));
        Self { path: path.to_owned(), errand }
    }

    /// The clip, or why there is none; nothing while it is read.
    pub(super) fn look(&self) -> Option<Result<Take, String>> {
        match self.errand.look() {
            Look::Waiting => None,
            Look::Done(take) => Some(take),
            Look::BrokeOff => Some(Err(format!("{}: reading it broke off", self.path.display()))),
        }
    }

    /// Says that it is read.
    pub(super) fn show(&self, ui: &mut Ui, words: Words) {
        ui.horizontal(|ui| {
            ui.spinner();
            let what = words.say("reading", "読み込み中");
            ui.label(format!("{what} {}", self.path.display()));
        });
    }
}
