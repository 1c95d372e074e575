//! The whole body that moves, the same for all layers: as it is drawn, from where it is seen, how it is built.

use std::sync::Arc;

use super::stage::{Of, Stage};
use crate::error::Error;
use crate::exaggerate::Exaggerate;
use crate::keys::{Reference, Tracks};
use crate::motion::{Build, Clip, Screen, SeenFrom};
use crate::recipe::Recipe;
use crate::time::Clock;

/// The stages of the whole body, each with its last output.
#[derive(Debug, Clone, Default)]
pub(super) struct MovingStages {
    /// The motion that is drawn, and how it was exaggerated; the clip itself where it was not.
    drawn: Stage<Option<Exaggerate>, Arc<Clip>>,
    /// From where movement is seen.
    screen: Stage<SeenFrom, Screen>,
    build: Stage<(), Build>,
    /// How high it stands, beside which its layers are judged.
    height: Stage<Clock, f64>,
    /// How suddenly it changes its velocities: its layers are no crisper.
    crispness: Stage<Screen, f64>,
}

/// What they made last.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving<'a> {
    pub(super) clip: Of<'a, Arc<Clip>>,
    pub(super) build: Of<'a, Build>,
    /// The body's height in the file's unit, for a layer that is not all of it.
    pub(super) height: Option<f64>,
    /// The crispness of the body, likewise.
    pub(super) crispness: Option<f64>,
    /// From where it is seen.
    pub(super) screen: Screen,
}

impl Moving<'_> {
    /// The least distance of two keys in frames: a koma.
    pub(super) fn apart(&self, recipe: &Recipe) -> f64 {
        self.clip.clock(recipe.rate).frames_in_koma()
    }
}

impl MovingStages {
    /// Exaggerates the motion where the recipe asks for it.
    pub(super) fn exaggerate(&mut self, clip: &Arc<Clip>, recipe: &Recipe) -> Result<(), Error> {
        // What is off is off whatever its other settings.
        let settings = (!recipe.exaggerate.is_off()).then(|| recipe.exaggerate.clone());
        self.drawn.try_make((Of::given(clip),), settings, |(clip,), settings| match settings {
            None => Ok(Arc::clone(&clip)),
            Some(exaggerate) => exaggerate.apply(&clip).map(Arc::new),
        })
    }

    /// Looks at the motion that is drawn.
    pub(super) fn see(&mut self, from: SeenFrom) {
        let clip = self.drawn.output();
        self.screen.make((clip,), from, |(clip,), from| Screen::of(*from, &clip));
        self.build.make((clip,), (), |(clip,), ()| Build::of(&clip));
    }

    /// Measures how high the body stands and how crisp its motion is.
    pub(super) fn stand(&mut self, clock: Clock) {
        let inputs = (self.drawn.output(), self.build.output());
        self.height.make(inputs, clock, |(clip, build), clock| {
            let all = vec![1.0; clip.skeleton().len()];
            Reference::of_build(&clip, &build, *clock, &all).height()
        });
        let inputs = (self.drawn.output(), self.build.output(), self.height.output());
        self.crispness.make(inputs, *self.screen.output(), |(clip, build, height), screen| {
            Tracks::of_all(&clip, &build, screen, *height).crispness()
        });
    }

    /// The motion that is drawn.
    pub(super) fn drawn(&self) -> Of<'_, Arc<Clip>> {
        self.drawn.output()
    }

    /// From where it is seen.
    pub(super) fn screen(&self) -> Of<'_, Screen> {
        self.screen.output()
    }

    /// What a layer is made of; `is_split` where it is one of several.
    pub(super) fn outputs(&self, is_split: bool) -> Moving<'_> {
        Moving {
            clip: self.drawn.output(),
            build: self.build.output(),
            height: is_split.then(|| *self.height.output()),
            crispness: is_split.then(|| *self.crispness.output()),
            screen: *self.screen.output(),
        }
    }
}
