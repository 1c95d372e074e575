//! The moving body, shared by all layers: the drawn motion, the camera, and the body's build.

use std::sync::Arc;

use super::laid::Laid;
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
    /// The drawn motion with its exaggeration; the clip itself if there is none.
    drawn: Stage<Option<Exaggerate>, Arc<Clip>>,
    /// The camera.
    screen: Stage<SeenFrom, Screen>,
    build: Stage<(), Build>,
    /// The standing height, by which the layers are judged.
    height: Stage<Clock, f64>,
    /// The crispness of the body, which bounds that of its layers.
    crispness: Stage<Screen, f64>,
}

/// The last outputs of [`MovingStages`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Moving<'a> {
    pub(super) clip: Of<'a, Arc<Clip>>,
    pub(super) build: Of<'a, Build>,
    /// The body's height in the file's unit, for a layer that is only a part of it.
    pub(super) height: Option<f64>,
    /// The body's crispness, for a layer that is only a part of it.
    pub(super) crispness: Option<f64>,
    /// The screen of the camera.
    pub(super) screen: Screen,
}

impl Moving<'_> {
    /// Returns the least distance between two keys in frames: one koma.
    pub(super) fn apart(&self, recipe: &Recipe) -> f64 {
        self.clip.clock(recipe.rate).frames_in_koma()
    }
}

impl MovingStages {
    /// Exaggerates the motion if the recipe asks for it.
    pub(super) fn exaggerate(&mut self, laid: Of<'_, Laid>, recipe: &Recipe) -> Result<(), Error> {
        // A disabled exaggeration must not invalidate the cache.
        let settings = (!recipe.exaggerate.is_off()).then(|| recipe.exaggerate.clone());
        self.drawn.try_make((laid,), settings, |(laid,), settings| match settings {
            None => Ok(Arc::clone(&laid.clip)),
            Some(exaggerate) => exaggerate.apply(&laid.clip).map(Arc::new),
        })
    }

    /// Computes the screen and the body's build.
    pub(super) fn see(&mut self, from: SeenFrom) {
        let clip = self.drawn.output();
        self.screen.make((clip,), from, |(clip,), from| Screen::new(*from, &clip));
        self.build.make((clip,), (), |(clip,), ()| Build::new(&clip));
    }

    /// Measures the body's standing height and its crispness.
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

    /// Returns the drawn motion.
    pub(super) fn drawn(&self) -> Of<'_, Arc<Clip>> {
        self.drawn.output()
    }

    /// Returns the screen of the camera.
    pub(super) fn screen(&self) -> Of<'_, Screen> {
        self.screen.output()
    }

    /// Returns the outputs that a layer is made from; `is_split` if it is one of several.
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
