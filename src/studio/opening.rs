//! A clip on its way to the table (読み込み).

use std::mem::take;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use egui::{ProgressBar, Ui};

use super::desk::{Desk, Opened};
use super::errand::{Errand, Look};
use super::step::Step;
use super::take::Take;
use super::words::Words;

/// Points that the bar is long.
const WIDTH: f32 = 120.0;

/// How far a clip has come.
#[derive(Default)]
enum Come {
    #[default]
    Nowhere,
    Read(Box<Opened>),
    Taken(Box<Take>),
}

/// A clip on its way.
pub(super) struct Opening {
    path: PathBuf,
    errand: Errand<Result<Take, String>>,
    /// The place of its step among all.
    step: Arc<AtomicUsize>,
}

impl Opening {
    /// Begins to read.
    pub(super) fn begin(desk: &Arc<dyn Desk>, path: &Path, recipe: Option<&Path>) -> Self {
        let (desk, clip) = (Arc::clone(desk), path.to_owned());
        let recipe = recipe.map(Path::to_owned);
        let step = Arc::new(AtomicUsize::new(0));
        let (told, mut come) = (Arc::clone(&step), Come::Nowhere);
        let errand = Errand::in_steps(move || {
            let at = told.load(Ordering::Relaxed);
            let further = match (Step::ALL[at], take(&mut come)) {
                (_, Come::Nowhere) => desk.open(&clip).map(Box::new).map(Come::Read),
                (Step::Clean, Come::Read(opened)) => {
                    desk.clean(&clip, *opened).map(Box::new).map(Come::Read)
                }
                (_, Come::Read(opened)) => Take::of(*opened, &*desk, &clip, recipe.as_deref())
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

    /// The clip, or why there is none; nothing while it is read.
    pub(super) fn look(&self) -> Option<Result<Take, String>> {
        match self.errand.look() {
            Look::Waiting => None,
            Look::Done(take) => Some(take),
            Look::BrokeOff => Some(Err(format!("{}: reading it broke off", self.path.display()))),
        }
    }

    /// Says how far it has come.
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
