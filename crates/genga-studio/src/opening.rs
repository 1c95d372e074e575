//! A clip being opened (読み込み).

use std::mem::take;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use egui::{ProgressBar, Ui};

use super::host::{Host, Opened};
use super::open_take::Take;
use super::opening_steps::Step;
use super::task::{Look, Task};
use super::words::Words;

/// Width of the progress bar in points.
const WIDTH: f32 = 120.0;

/// Stage that a clip has reached.
#[derive(Default)]
enum Come {
    #[default]
    Nowhere,
    Read(Box<Opened>),
    Taken(Box<Take>),
}

/// A clip being opened.
pub(super) struct Opening {
    path: PathBuf,
    errand: Task<Result<Take, String>>,
    /// Index of the current step in [`Step::ALL`].
    step: Arc<AtomicUsize>,
}

impl Opening {
    /// Starts reading.
    pub(super) fn begin(desk: &Arc<dyn Host>, path: &Path, recipe: Option<&Path>) -> Self {
        let (desk, clip) = (Arc::clone(desk), path.to_owned());
        let recipe = recipe.map(Path::to_owned);
        let step = Arc::new(AtomicUsize::new(0));
        let (told, mut come) = (Arc::clone(&step), Come::Nowhere);
        let errand = Task::in_steps(move || {
            let at = told.load(Ordering::Relaxed);
            let further = match (Step::ALL[at], take(&mut come)) {
                (_, Come::Nowhere) => desk.open(&clip).map(Box::new).map(Come::Read),
                (Step::Clean, Come::Read(opened)) => {
                    desk.clean(&clip, *opened).map(Box::new).map(Come::Read)
                }
                (_, Come::Read(opened)) => Take::new(*opened, &*desk, &clip, recipe.as_deref())
                    .map(|take| Come::Taken(Box::new(take))),
                (step, Come::Taken(mut take)) => take.run(step).map(|()| Come::Taken(take)),
            };
            match further {
                Ok(Come::Taken(take)) if at + 1 == Step::ALL.len() => return Some(Ok(*take)),
                Ok(further) => come = further,
                Err(why) => return Some(Err(why)),
            }
            told.store(at + 1, Ordering::Relaxed);
            None
        });
        Self { path: path.to_owned(), errand, step }
    }

    /// Returns the clip, or why it cannot be opened. `None` while it is being read.
    pub(super) fn look(&self) -> Option<Result<Take, String>> {
        match self.errand.look() {
            Look::Waiting => None,
            Look::Done(take) => Some(take),
            Look::BrokeOff => Some(Err(format!("{}: reading was aborted", self.path.display()))),
        }
    }

    /// Shows the progress.
    pub(super) fn show(&self, ui: &mut Ui, words: Words) {
        let at = self.step.load(Ordering::Relaxed);
        let (what, steps) = (Step::ALL[at].words(words), Step::ALL.len());
        ui.horizontal(|ui| {
            ui.spinner();
            let share = at as f32 / steps as f32;
            ui.add(
                ProgressBar::new(share).desired_width(WIDTH).text(format!("{}/{steps}", at + 1)),
            );
            ui.label(format!("{what} {}", self.path.display()));
        });
    }
}
