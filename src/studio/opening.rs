//! A clip that is being read (読み込み), on a thread of its own, so that the window does not freeze.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread;

use egui::Ui;

use super::desk::Desk;
use super::take::Take;
use super::words::Words;

/// A clip on its way.
pub(super) struct Opening {
    path: PathBuf,
    done: Receiver<Result<Take, String>>,
}

/// What a look at it finds.
pub(super) enum Look {
    /// Not yet.
    Waiting(Opening),
    /// The clip, or why there is none.
    Done(Result<Box<Take>, String>),
}

impl Opening {
    /// Begins to read.
    pub(super) fn begin(desk: &Arc<dyn Desk>, path: &Path, recipe: Option<&Path>) -> Self {
        let (send, done) = channel();
        let (desk, clip) = (Arc::clone(desk), path.to_owned());
        let recipe = recipe.map(Path::to_owned);
        // Nobody is left to hear it when the window was closed meanwhile.
        thread::spawn(move || drop(send.send(Take::open(&*desk, &clip, recipe.as_deref()))));
        Self { path: path.to_owned(), done }
    }

    /// Whether it has come.
    pub(super) fn look(self) -> Look {
        match self.done.try_recv() {
            Ok(take) => Look::Done(take.map(Box::new)),
            Err(TryRecvError::Empty) => Look::Waiting(self),
            Err(TryRecvError::Disconnected) => {
                Look::Done(Err(format!("{}: reading it broke off", self.path.display())))
            }
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
