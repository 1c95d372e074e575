//! The whole chain: [`Clip`] + [`Recipe`] + [`Edits`] → [`Breakdown`].

mod breakdown;
mod budget;
mod joints;
mod laid;
mod layer;
mod looped;
mod moving;
mod stage;
mod stop;
#[cfg(test)]
pub(crate) mod tests;
mod voters;

use std::borrow::Cow;
use std::sync::Arc;

use crate::edits::{CameraCue, Edits, Hold, Speech};
use crate::error::Error;
use crate::keys::{ActionFinder, Actions, BodyTurns, LayerJoints, Layers, Reconstruction};
use crate::motion::{Clip, Filmed, Screen};
use crate::recipe::Recipe;
use crate::sheet::{CameraWork, Feet, Layer, RootMotion, Sheet, SpokenLine};
use crate::signal::{Spectrum, Speed, Turn};
use crate::slate::Slate;
use crate::time::{Clock, Frame};
use crate::timing::{Omitted, Spaced, owed_at_end, with_holds};

use breakdown::Shown;
pub use breakdown::{Breakdown, FoundKeys};
pub use budget::Budget;
use joints::JointStages;
use laid::{Laid, Round};
pub use layer::LayerBreakdown;
use layer::{LayerStages, Measured};
use looped::{Looped, Rounded};
use moving::{Moving, MovingStages};
use stage::{Of, Stage};
pub use stop::Stop;

/// Runs the chain and keeps each stage's last output with the settings that made it, so that a run restarts at the
/// first stage whose input changed. A clone shares the outputs made so far.
#[derive(Debug, Clone)]
pub struct Engine {
    clip: Arc<Clip>,
    budget: Budget,
    stop: Stop,
    /// The clip that the chain runs over: the source, or its rounds for a loop, at a rate in koma per second.
    laid: Stage<Option<f64>, Laid>,
    moving: MovingStages,
    /// The speeds, and the spectrum that the filters start from.
    speed: Stage<(Speed, Screen), Spectrum>,
    joints: JointStages,
    split: Stage<Layers, Vec<LayerJoints>>,
    /// The stages of each layer. Layers that the current recipe lacks are kept for a recipe that has them.
    layers: Vec<LayerStages>,
    /// The actions of the take, found in the body or its first layer.
    actions: Stage<(ActionFinder, Vec<Frame>), Actions>,
    sheets: Stage<SheetSettings, [Sheet; 2]>,
    /// The round that is shown of a loop.
    looped: Option<Arc<Looped>>,
    /// Whether all outputs belong to the same run.
    is_whole: bool,
}

/// The sheet's clock, root motion, feet and last frame, a person's holds, the spoken lines, and the place in the cut.
type SheetSettings = ((Clock, RootMotion, Feet, Frame), Vec<Hold>, Vec<Speech>, InCut);
/// The koma on which the first drawing stands, the length of the cut, its slate, and its camera work.
type InCut = ((Option<usize>, Option<usize>), Slate, Vec<CameraCue>);

impl Engine {
    /// Creates an engine for a clip.
    ///
    /// # Errors
    /// [`Error::Clip`] when the clip has no frame or no joint, or when its values are not a motion.
    pub fn new(clip: impl Into<Arc<Clip>>) -> Result<Self, Error> {
        let clip = clip.into();
        if clip.is_empty() || clip.skeleton().is_empty() {
            return Err(Error::clip("the clip has no motion: it needs a joint and a frame"));
        }
        clip.check_size()?;
        Ok(Self {
            clip,
            budget: Budget::default(),
            stop: Stop::default(),
            laid: Stage::default(),
            moving: MovingStages::default(),
            speed: Stage::default(),
            joints: JointStages::default(),
            split: Stage::default(),
            layers: Vec::new(),
            actions: Stage::default(),
            sheets: Stage::default(),
            looped: None,
            is_whole: false,
        })
    }

    /// Replaces the memory budget.
    pub fn with_budget(self, budget: Budget) -> Self {
        Self { budget, ..self }
    }

    /// Makes further runs end with [`Error::Stopped`], after the stage in progress, once `stop` is asked. What was
    /// made until then is kept.
    pub fn stop_with(&mut self, stop: Stop) {
        self.stop = stop;
    }

    /// Returns the source motion.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    /// Returns the source motion, shared so that it can outlive this engine.
    pub fn shared_clip(&self) -> Arc<Clip> {
        Arc::clone(&self.clip)
    }

    /// Runs the chain from the first stage whose input changed.
    ///
    /// # Errors
    /// [`Error::Setting`] or [`Error::Edits`] when a setting or a correction is invalid, and when two pins fall on one
    /// koma.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let (mut recipe, edits) = (Recipe::default(), Edits::default());
    /// let mut engine = Engine::new(clip)?;
    /// let keys = engine.run(&recipe, &edits)?.first_layer().keys.keys.len();
    /// // The motion is not measured again: spacing comes after the keys.
    /// recipe.set("spacing.on", "3")?;
    /// assert_eq!(engine.run(&recipe, &edits)?.first_layer().keys.keys.len(), keys);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn run(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Breakdown<'_>, Error> {
        self.make(recipe, edits, |_| {})
    }

    /// Like [`Engine::run`], for the last run: drops outputs that only a further run would use.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn run_once(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Breakdown<'_>, Error> {
        // Finishes one layer before the next, so that only one layer's large outputs exist at a time.
        self.make(recipe, edits, LayerStages::forget)?;
        self.joints.forget();
        Ok(self.breakdown(recipe))
    }

    /// Runs the chain layer by layer and calls `done` with each finished layer.
    fn make(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
        done: impl Fn(&mut LayerStages),
    ) -> Result<Breakdown<'_>, Error> {
        let own = edits;
        let edits = &*self.in_rounds(recipe, own)?;
        self.find(recipe, edits)?;
        self.split(recipe, edits);
        let later = self.later(recipe);
        let laid = Arc::clone(&self.laid.output().clip);
        let place = (laid.clock(recipe.rate), laid.last());
        let length = laid.rate().koma_from_frames(laid.len(), recipe.rate);
        let stop = self.stop.clone();
        let (measured, split, layers) = self.layers();
        for (joints, layer) in split.iter().zip(layers) {
            stop.check()?;
            let name = &joints.name;
            layer.take(&measured, joints, &recipe.keys.weights)?;
            layer.find(&measured, &recipe.of_layer(name), &edits.of_layer(name));
            stop.check()?;
            let timing = recipe.timing_of(name, place, length);
            layer.time(&measured, joints, timing, &later)?;
            done(layer);
        }
        self.sheet(recipe, edits)?;
        self.cut(recipe, own)?;
        self.is_whole = true;
        Ok(self.breakdown(recipe))
    }

    /// Returns the outputs of the last run, without checking whether they are current for `recipe`. `None` if that run
    /// failed or did not reach the sheet.
    pub fn last(&self, recipe: &Recipe) -> Option<Breakdown<'_>> {
        self.is_whole.then(|| self.breakdown(recipe))
    }

    fn breakdown(&self, recipe: &Recipe) -> Breakdown<'_> {
        if let Some(looped) = self.looped.as_deref() {
            return Breakdown {
                source: &self.clip,
                clip: &looped.clip,
                seen_from: recipe.seen_from,
                screen: self.moving.screen().value(),
                clock: looped.clock,
                speed: &looped.speed,
                filtered: &looped.filtered,
                turns: &looped.turns,
                actions: &looped.actions,
                spaced: &looped.spaced,
                sheet: &looped.sheet,
                layers: Shown::Round(&looped.layers),
            };
        }
        let [spaced, sheet] = self.sheets.output().value();
        let layers = &self.layers[..sheet.layers.len()];
        Breakdown {
            source: &self.clip,
            clip: self.moving.drawn().value(),
            seen_from: recipe.seen_from,
            screen: self.moving.screen().value(),
            clock: self.clip.clock(recipe.rate),
            speed: self.speed.output().value().unfiltered(),
            filtered: self.joints.filtered.output().value(),
            turns: self.joints.turns.output().value(),
            actions: self.actions.output().value(),
            spaced,
            sheet,
            layers: Shown::Whole(layers),
        }
    }

    /// Runs the chain up to the turns of every joint.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn find_turns(&mut self, recipe: &Recipe) -> Result<&[Vec<Turn>], Error> {
        self.measure(recipe)?;
        self.joints.turn(self.moving.drawn(), self.speed.output(), recipe);
        Ok(self.joints.turns.output().value())
    }

    /// Runs the chain up to the keys of the first layer.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn find_keys(&mut self, recipe: &Recipe, edits: &Edits) -> Result<FoundKeys<'_>, Error> {
        let edits = &self.in_rounds(recipe, edits)?;
        self.find(recipe, edits)?;
        let (body, keys, uncorrected) = self.layers[0].keys();
        Ok(FoundKeys { turns: self.joints.turns.output().value(), body, keys, uncorrected })
    }

    /// Runs the chain up to the turns: those of every joint, and those of the body or its first layer.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn find_body_turns(
        &mut self,
        recipe: &Recipe,
    ) -> Result<(&[Vec<Turn>], &BodyTurns), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, own, _| {
            first.find_body_turns(moving, own);
        })?;
        Ok((self.joints.turns.output().value(), self.layers[0].body_turns()))
    }

    /// Runs the chain up to the tracks of the body or its first layer, in which its turns are found.
    pub fn follow(&mut self, recipe: &Recipe) -> Result<(), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, own, _| {
            first.follow(moving, own);
        })
    }

    /// Runs the chain up to the body's turns and the loss between any two koma, by which genga are chosen.
    pub fn compare(&mut self, recipe: &Recipe) -> Result<(), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, own, _| {
            first.find_body_turns(moving, own);
            first.compare(moving, own);
        })
    }

    /// Runs the chain up to the actions of the take.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn find_actions(&mut self, recipe: &Recipe, edits: &Edits) -> Result<&Actions, Error> {
        let edits = &self.in_rounds(recipe, edits)?;
        self.find(recipe, edits)?;
        self.split(recipe, edits);
        Ok(self.actions.output().value())
    }

    /// Measures how far the body or its first layer deviates if only the keys of a recipe remain.
    ///
    /// # Errors
    /// As for [`Engine::run`].
    pub fn reconstruction(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<Reconstruction, Error> {
        let edits = &self.in_rounds(recipe, edits)?;
        self.find(recipe, edits)?;
        Ok(self.layers[0].reconstruction())
    }

    /// Makes the clip that the chain runs over.
    fn lay(&mut self, recipe: &Recipe) -> Result<(), Error> {
        if recipe.cycles > 1 && !recipe.r#loop {
            let message =
                "only a loop has several rounds; --loop makes one, in a recipe loop = true";
            return Err(Error::setting("cycles", message));
        }
        if recipe.r#loop && recipe.scopes.has_passages() {
            let message = "a loop has no passages: its rounds are timed alike; a layer may have settings of its own";
            return Err(Error::setting("passages", message));
        }
        let rate = recipe.r#loop.then_some(recipe.rate);
        self.laid.try_make((Of::given(&self.clip),), rate, |(clip,), rate| Laid::new(&clip, *rate))
    }

    /// Returns the corrections for the clip that the chain runs over: those of a loop in every round.
    fn in_rounds<'e>(
        &mut self,
        recipe: &Recipe,
        edits: &'e Edits,
    ) -> Result<Cow<'e, Edits>, Error> {
        if !recipe.r#loop {
            return Ok(Cow::Borrowed(edits));
        }
        recipe.validate()?;
        edits.validate(self.clip.first(), self.clip.last())?;
        self.lay(recipe)?;
        let round = self.laid.output().round;
        Ok(round.map_or(Cow::Borrowed(edits), |round| Cow::Owned(round.spread(edits))))
    }

    /// Returns the koma on which each action after the first begins.
    fn later(&self, recipe: &Recipe) -> Vec<usize> {
        let (laid, actions) = (self.laid.output(), self.actions.output());
        let clock = laid.clip.clock(recipe.rate);
        match laid.round {
            None => actions.koma(clock),
            Some(round) => {
                let frames = round.actions(&actions).into_iter();
                frames.map(|frame| clock.koma_from_frame(frame)).collect()
            }
        }
    }

    /// Cuts the round of a loop out of the results.
    fn cut(&mut self, recipe: &Recipe, edits: &Edits) -> Result<(), Error> {
        let count = self.split.output().len();
        let looped = self.laid.output().round.map(|round| {
            let all = Rounded {
                source: &self.clip,
                drawn: self.moving.drawn().value(),
                speed: self.speed.output().value().unfiltered(),
                filtered: self.joints.filtered.output().value(),
                turns: self.joints.turns.output().value(),
                sheets: self.sheets.output().value(),
                layers: self.layers[..count].iter().map(LayerStages::breakdown).collect(),
            };
            round.cut(&all, recipe, edits).map(Arc::new)
        });
        self.looped = looped.transpose()?;
        Ok(())
    }

    /// Finds the keys of the first layer.
    fn find(&mut self, recipe: &Recipe, edits: &Edits) -> Result<(), Error> {
        self.check_and_turn(recipe, edits, |first, moving, own, name| {
            first.find_alone(moving, own, &edits.of_layer(name));
        })?;
        let (measured, split, layers) = self.layers();
        let name = &split[0].name;
        layers[0].find(&measured, &recipe.of_layer(name), &edits.of_layer(name));
        Ok(())
    }

    /// Splits the take into actions by the loss between instants of the first layer.
    fn split(&mut self, recipe: &Recipe, edits: &Edits) {
        let settings = (recipe.actions.clone(), edits.splits.clone());
        let inputs = (self.moving.drawn(), self.layers[0].chords());
        self.actions.make(inputs, settings, |(clip, chords), (finder, splits)| {
            finder.find(&clip, &chords, splits)
        });
    }

    /// Finds the turns of every joint while `alone` runs those stages of the first layer that do not need them, with the
    /// recipe and the name of that layer.
    fn check_and_turn(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
        alone: impl FnOnce(&mut LayerStages, &Moving<'_>, &Recipe, &str) + Send,
    ) -> Result<(), Error> {
        recipe.validate()?;
        self.lay(recipe)?;
        let laid = Arc::clone(&self.laid.output().clip);
        edits.validate(laid.first(), laid.last())?;
        // Reports invalid corrections before the expensive work.
        self.is_whole = false;
        self.split.try_make(
            (Of::given(&self.clip),),
            recipe.layers.clone(),
            |(clip,), layers| layers.split(&clip),
        )?;
        let split = self.split.output();
        let names: Vec<&str> = split.iter().map(|joints| joints.name.as_str()).collect();
        edits.check_layers(&names)?;
        recipe.scopes.check_on(&names, (laid.first(), laid.last()), recipe)?;
        let clock = laid.clock(recipe.rate);
        let round = self.laid.output().round;
        names.iter().try_for_each(|name| one_pin_a_koma(&edits.of_layer(name), clock, round))?;
        recipe.keys.weights.resolve(self.clip.skeleton())?;
        let count = split.len();
        self.layers.resize_with(count.max(self.layers.len()), LayerStages::default);
        self.measure(recipe)?;
        if count > 1 {
            self.moving.stand(clock);
        }
        let split = self.split.output().value();
        let moving = self.moving.outputs(split.len() > 1);
        let first = &mut self.layers[0];
        first.take(&moving, &split[0], &recipe.keys.weights)?;
        let (clip, speed) = (moving.clip, self.speed.output());
        let joints = &mut self.joints;
        let name = &split[0].name;
        let own = recipe.of_layer(name);
        rayon::join(|| joints.turn(clip, speed, recipe), || alone(first, &moving, &own, name));
        Ok(())
    }

    /// Returns the measurements of the whole body, its layers, and their stages.
    fn layers(&mut self) -> (Measured<'_>, &[LayerJoints], &mut [LayerStages]) {
        let split = self.split.output().value();
        let moving = self.moving.outputs(split.len() > 1);
        let (filtered, turns) = (self.joints.filtered.output(), self.joints.turns.output());
        let measured = Measured { moving, filtered, turns };
        (measured, split, &mut self.layers[..split.len()])
    }

    /// Measures the speed of every joint.
    pub fn measure(&mut self, recipe: &Recipe) -> Result<(), Error> {
        recipe.validate()?;
        self.lay(recipe)?;
        self.budget.check(&self.laid.output().clip, recipe.rate)?;
        self.stop.check()?;
        self.is_whole = false;
        self.moving.exaggerate(self.laid.output(), recipe)?;
        self.moving.see(recipe.seen_from);
        // Rotations do not depend on the camera.
        let is_seen = recipe.speed.measure.is_seen();
        let screen = if is_seen { *self.moving.screen() } else { Screen::WORLD };
        let clip = self.moving.drawn();
        self.speed.try_make((clip,), (recipe.speed.clone(), screen), |(clip,), settings| {
            let (speed, screen) = settings;
            speed.measure_on(&clip, screen).map(Spectrum::from)
        })?;
        self.stop.check()
    }

    /// Builds the sheet before and after omission and a person's holds.
    fn sheet(&mut self, recipe: &Recipe, edits: &Edits) -> Result<(), Error> {
        let layers = &self.layers[..self.split.output().len()];
        let layers: Vec<_> = layers.iter().map(LayerStages::timed).collect();
        let output = self.laid.output();
        let laid = &output.value().clip;
        let of = (laid.clock(recipe.rate), recipe.root, recipe.feet, laid.last());
        // A loop is placed in the cut with all its rounds.
        let placed = match output.round {
            None => (edits.at, edits.length),
            Some(_) => (None, None),
        };
        let in_cut = (placed, edits.slate.clone(), edits.camera.clone());
        let settings = (of, edits.holds.clone(), edits.speech.clone(), in_cut);
        self.sheets.try_make((output, layers), settings, |(laid, layers), settings| {
            let ((clock, root, feet, last), holds, speech, ((at, end), slate, cues)) = settings;
            let held = |(spaced, omitted): (Of<'_, Spaced>, Of<'_, Omitted>)| {
                let spaced = &spaced.value().layer;
                (spaced.clone(), with_holds(&omitted.layer, spaced, holds, *clock))
            };
            let (spaced, layers): (Vec<Layer>, Vec<Layer>) = layers.into_iter().map(held).unzip();
            let owed = |layer: &Layer| owed_at_end(layer, holds, *clock);
            let owed = layers.iter().map(owed).max().unwrap_or(0);
            let filmed = Filmed::new(&laid.value().clip);
            let sheet = |layers| {
                let sheet = Sheet { root: *root, feet: *feet, ..Sheet::new(*clock, layers) };
                let length = sheet.length();
                let lines = speech.iter().filter_map(|line| line.on_sheet(*clock, *last, length));
                let mut lines: Vec<SpokenLine> = lines.collect();
                lines.sort_by_key(|line| line.begin);
                let camera = cues.iter().filter_map(|cue| cue.on_sheet(*clock, *last, length));
                let mut camera: Vec<CameraWork> = camera.collect();
                camera.sort_by_key(|work| work.begin);
                let guesses = filmed.map_or_else(Vec::new, |filmed| filmed.work(&sheet));
                let camera = CameraWork::with_guesses(camera, guesses);
                let sheet = Sheet { lines, camera, slate: slate.clone(), ..sheet };
                Ok(sheet.placed(*at, *end)?.with_end_held(owed))
            };
            Ok([sheet(spaced)?, sheet(layers)?])
        })
    }
}

/// Rejects two pins or moved keys on one koma: a koma shows one drawing, so one of them would be lost, and corrections
/// must never be lost. In a loop the error names frames of the clip, and no koma: its sheet begins with another one.
fn one_pin_a_koma(edits: &Edits, clock: Clock, round: Option<Round>) -> Result<(), Error> {
    let moved = edits.moves.iter().map(|moved| moved.to);
    let mut frames: Vec<Frame> = edits.pins.iter().map(|pin| pin.frame).chain(moved).collect();
    frames.sort_unstable();
    let koma = |frame: Frame| clock.koma_from_frame(frame);
    match frames.windows(2).find(|pair| koma(pair[0]) == koma(pair[1])) {
        None => Ok(()),
        Some(pair) => {
            let mut own = [pair[0], pair[1]]
                .map(|frame| round.map_or(frame, |round| round.frame_in_clip(frame)));
            own.sort_unstable();
            let [a, b] = own;
            let koma = match round {
                None => format!(", {}", koma(pair[0]) + 1),
                Some(_) => String::new(),
            };
            let message = if a == b {
                format!("frame {a} is pinned or moved to twice: once is enough")
            } else {
                format!(
                    "frames {a} and {b}, pinned or moved to, fall on one koma{koma}: take one of them away"
                )
            };
            Err(Error::Edits { message })
        }
    }
}
