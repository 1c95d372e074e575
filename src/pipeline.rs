//! The whole chain: [`Clip`] + [`Recipe`] + [`Edits`] → [`Breakdown`].

mod budget;
mod joints;
mod layer;
mod moving;
mod stage;
#[cfg(test)]
pub(crate) mod tests;
mod voices;

use std::sync::Arc;

use crate::edits::{Edits, Hold, Speech};
use crate::error::Error;
use crate::keys::{
    ActionFinder, Actions, BodyTurns, Key, LayerJoints, LayerKeys, Layers, Reconstruction,
};
use crate::motion::{Clip, Screen, SeenFrom};
use crate::recipe::Recipe;
use crate::sheet::{Feet, RootMotion, Sheet, SpokenLine};
use crate::signal::{Signals, Spectrum, Speed, Turn};
use crate::time::{Clock, Frame};
use crate::timing::{Omitted, Spaced, with_holds};

pub use budget::Budget;
use joints::JointStages;
pub use layer::LayerBreakdown;
use layer::{LayerStages, Measured};
use moving::{Moving, MovingStages};
use stage::{Of, Stage};

/// Runs the chain and keeps each stage's last output with the settings that made it, so that a run
/// starts again at the first stage whose input changed. A clone shares what was made so far.
#[derive(Debug, Clone)]
pub struct Engine {
    clip: Arc<Clip>,
    budget: Budget,
    moving: MovingStages,
    /// The speeds, and what filters make of them first.
    speed: Stage<(Speed, Screen), Spectrum>,
    joints: JointStages,
    split: Stage<Layers, Vec<LayerJoints>>,
    /// The stages of each layer. Those of layers that a recipe does not have wait for one that has them.
    layers: Vec<LayerStages>,
    /// The actions of the take, by the body or the first of its layers.
    actions: Stage<(ActionFinder, Vec<Frame>), Actions>,
    sheets: Stage<SheetSettings, [Sheet; 2]>,
    /// Whether all outputs are of one run.
    is_whole: bool,
}

/// Of which time and motion the sheet is and with which frame that ends, what a person holds, and what is spoken.
type SheetSettings = ((Clock, RootMotion, Feet, Frame), Vec<Hold>, Vec<Speech>);

/// Every intermediate result of a run.
#[derive(Debug, Clone, Copy)]
pub struct Breakdown<'a> {
    /// The motion as it was given.
    pub source: &'a Clip,
    /// The motion that is measured and drawn: the source, exaggerated where the recipe asks for it.
    pub clip: &'a Clip,
    /// From where its movement was measured.
    pub seen_from: SeenFrom,
    /// The screen there.
    pub screen: &'a Screen,
    /// Where the sheet's koma stand in it.
    pub clock: Clock,
    /// How fast each joint is.
    pub speed: &'a Signals,
    /// The same, smoothed.
    pub filtered: &'a Signals,
    /// Confirmed keys and walls of each joint, by frame.
    pub turns: &'a [Vec<Turn>],
    /// The actions that the take consists of.
    pub actions: &'a Actions,
    /// The sheet before anything was left out.
    pub spaced: &'a Sheet,
    /// The result.
    pub sheet: &'a Sheet,
    layers: &'a [LayerStages],
}

/// What was found up to the keys of the first layer.
#[derive(Debug, Clone, Copy)]
pub struct FoundKeys<'a> {
    /// Confirmed keys and walls of each joint, by frame.
    pub turns: &'a [Vec<Turn>],
    /// The turns of the layer as a whole.
    pub body: &'a BodyTurns,
    /// Keys and walls of the layer.
    pub keys: &'a LayerKeys,
    /// Its keys without corrections, or those that are frozen.
    pub uncorrected: &'a [Key],
}

impl<'a> Breakdown<'a> {
    /// What was found and decided for each layer of the sheet.
    pub fn layers(&self) -> impl ExactSizeIterator<Item = LayerBreakdown<'a>> + use<'a> {
        self.layers.iter().map(LayerStages::breakdown)
    }

    /// The first layer of the sheet: the whole body where a recipe asks for no others.
    pub fn first_layer(&self) -> LayerBreakdown<'a> {
        self.layers[0].breakdown()
    }
}

impl Engine {
    /// An engine for a clip.
    ///
    /// # Errors
    /// [`Error::Clip`] when the clip has no frame or no joint, or values that are no motion.
    pub fn new(clip: impl Into<Arc<Clip>>) -> Result<Self, Error> {
        let clip = clip.into();
        if clip.is_empty() || clip.skeleton().is_empty() {
            return Err(Error::clip("the clip has no motion: it needs a joint and a frame"));
        }
        clip.check_size()?;
        Ok(Self {
            clip,
            budget: Budget::default(),
            moving: MovingStages::default(),
            speed: Stage::default(),
            joints: JointStages::default(),
            split: Stage::default(),
            layers: Vec::new(),
            actions: Stage::default(),
            sheets: Stage::default(),
            is_whole: false,
        })
    }

    /// The same with another bound of memory.
    pub fn with_budget(self, budget: Budget) -> Self {
        Self { budget, ..self }
    }

    /// The motion as it was given.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    /// The motion as it was given, to be kept beyond this engine.
    pub fn shared_clip(&self) -> Arc<Clip> {
        Arc::clone(&self.clip)
    }

    /// Runs the chain as far as it has to be run again.
    ///
    /// # Errors
    /// [`Error::Setting`] or [`Error::Edits`] when a setting or a correction does not hold, and when two
    /// pins fall on one koma.
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

    /// [`Engine::run`] for the last time: what only another run would use is forgotten.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn run_once(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Breakdown<'_>, Error> {
        // One layer after the other, so that what is large is there for one of them at a time.
        self.make(recipe, edits, LayerStages::forget)?;
        self.joints.forget();
        Ok(self.breakdown(recipe))
    }

    /// Runs the chain, layer by layer; `done` is called with each that is done.
    fn make(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
        done: impl Fn(&mut LayerStages),
    ) -> Result<Breakdown<'_>, Error> {
        self.find(recipe, edits)?;
        self.split(recipe, edits);
        let later = self.actions.output().koma(self.clip.clock(recipe.rate));
        let (measured, split, layers) = self.layers();
        for (joints, layer) in split.iter().zip(layers) {
            layer.take(&measured, joints, &recipe.keys.weights)?;
            layer.find(&measured, recipe, &edits.of_layer(&joints.name));
            layer.time(&measured, joints, recipe, &later)?;
            done(layer);
        }
        self.sheet(recipe, edits);
        self.is_whole = true;
        Ok(self.breakdown(recipe))
    }

    /// What the last run made of a recipe, without a look at what would be made now; none after a run that failed or
    /// did not come to the sheet.
    pub fn last(&self, recipe: &Recipe) -> Option<Breakdown<'_>> {
        self.is_whole.then(|| self.breakdown(recipe))
    }

    fn breakdown(&self, recipe: &Recipe) -> Breakdown<'_> {
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
            layers,
        }
    }

    /// Runs the chain up to every joint's turns.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_turns(&mut self, recipe: &Recipe) -> Result<&[Vec<Turn>], Error> {
        self.measure(recipe)?;
        self.joints.turn(self.moving.drawn(), self.speed.output(), recipe);
        Ok(self.joints.turns.output().value())
    }

    /// Runs the chain up to the keys of the first layer.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_keys(&mut self, recipe: &Recipe, edits: &Edits) -> Result<FoundKeys<'_>, Error> {
        self.find(recipe, edits)?;
        let (body, keys, uncorrected) = self.layers[0].keys();
        Ok(FoundKeys { turns: self.joints.turns.output().value(), body, keys, uncorrected })
    }

    /// Runs the chain up to the turns: every joint's, and those of the body, or of the first of its layers.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_body_turns(
        &mut self,
        recipe: &Recipe,
    ) -> Result<(&[Vec<Turn>], &BodyTurns), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, _| {
            first.find_body_turns(moving, recipe);
        })?;
        Ok((self.joints.turns.output().value(), self.layers[0].body_turns()))
    }

    /// Runs the chain up to how the body, or the first of its layers, moves: what its turns are found in.
    #[cfg(feature = "panels")]
    pub(crate) fn follow(&mut self, recipe: &Recipe) -> Result<(), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, _| {
            first.follow(moving, recipe);
        })
    }

    /// Runs the chain up to the turns of the body and what is lost from any koma to another, by which genga are chosen.
    #[cfg(feature = "panels")]
    pub(crate) fn compare(&mut self, recipe: &Recipe) -> Result<(), Error> {
        self.check_and_turn(recipe, &Edits::default(), |first, moving, _| {
            first.find_body_turns(moving, recipe);
            first.compare(moving, recipe);
        })
    }

    /// Runs the chain as far as it takes to tell the actions of the take.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_actions(&mut self, recipe: &Recipe, edits: &Edits) -> Result<&Actions, Error> {
        self.find(recipe, edits)?;
        self.split(recipe, edits);
        Ok(self.actions.output().value())
    }

    /// How far off the body, or the first of its layers, is when nothing but the keys of a recipe is left.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn reconstruction(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<Reconstruction, Error> {
        self.find(recipe, edits)?;
        Ok(self.layers[0].reconstruction())
    }

    /// The keys of the first layer.
    fn find(&mut self, recipe: &Recipe, edits: &Edits) -> Result<(), Error> {
        self.check_and_turn(recipe, edits, |first, moving, name| {
            first.find_alone(moving, recipe, &edits.of_layer(name));
        })?;
        let (measured, split, layers) = self.layers();
        layers[0].find(&measured, recipe, &edits.of_layer(&split[0].name));
        Ok(())
    }

    /// The take split into its actions, by what is lost between the instants of the first layer.
    fn split(&mut self, recipe: &Recipe, edits: &Edits) {
        let settings = (recipe.actions.clone(), edits.splits.clone());
        let inputs = (self.moving.drawn(), self.layers[0].chords());
        self.actions.make(inputs, settings, |(clip, chords), (finder, splits)| {
            finder.find(&clip, &chords, splits)
        });
    }

    /// The turns of every joint and, beside that, of the first layer what does not wait for them.
    fn check_and_turn(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
        alone: impl FnOnce(&mut LayerStages, &Moving<'_>, &str) + Send,
    ) -> Result<(), Error> {
        recipe.validate()?;
        edits.validate(self.clip.first(), self.clip.last())?;
        // What is wrong with them is said before the work.
        self.is_whole = false;
        self.split.try_make(
            (Of::given(&self.clip),),
            recipe.layers.clone(),
            |(clip,), layers| layers.split(&clip),
        )?;
        let split = self.split.output();
        let names: Vec<&str> = split.iter().map(|joints| joints.name.as_str()).collect();
        edits.check_layers(&names)?;
        let clock = self.clip.clock(recipe.rate);
        names.iter().try_for_each(|name| one_pin_a_koma(&edits.of_layer(name), clock))?;
        recipe.keys.weights.of(self.clip.skeleton())?;
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
        rayon::join(|| joints.turn(clip, speed, recipe), || alone(first, &moving, &split[0].name));
        Ok(())
    }

    /// What was measured of the whole body, its layers, and their stages.
    fn layers(&mut self) -> (Measured<'_>, &[LayerJoints], &mut [LayerStages]) {
        let split = self.split.output().value();
        let moving = self.moving.outputs(split.len() > 1);
        let (filtered, turns) = (self.joints.filtered.output(), self.joints.turns.output());
        let measured = Measured { moving, filtered, turns };
        (measured, split, &mut self.layers[..split.len()])
    }

    /// How fast every joint is.
    pub(crate) fn measure(&mut self, recipe: &Recipe) -> Result<(), Error> {
        recipe.validate()?;
        self.budget.check(&self.clip, recipe.rate)?;
        self.is_whole = false;
        self.moving.exaggerate(&self.clip, recipe)?;
        self.moving.see(recipe.seen_from);
        // A rotation is the same from everywhere.
        let is_seen = recipe.speed.measure.is_seen();
        let screen = if is_seen { *self.moving.screen() } else { Screen::WORLD };
        let clip = self.moving.drawn();
        self.speed.try_make((clip,), (recipe.speed.clone(), screen), |(clip,), settings| {
            let (speed, screen) = settings;
            speed.measure_on(&clip, screen).map(Spectrum::from)
        })?;
        Ok(())
    }

    /// The sheet, before and after omission and what a person holds.
    fn sheet(&mut self, recipe: &Recipe, edits: &Edits) {
        let layers = &self.layers[..self.split.output().len()];
        let layers: Vec<_> = layers.iter().map(LayerStages::timed).collect();
        let of = (self.clip.clock(recipe.rate), recipe.root, recipe.feet, self.clip.last());
        let settings = (of, edits.holds.clone(), edits.speech.clone());
        self.sheets.make(layers, settings, |layers, settings| {
            let ((clock, root, feet, last), holds, speech) = settings;
            let held = |(spaced, omitted): (Of<'_, Spaced>, Of<'_, Omitted>)| {
                let spaced = &spaced.value().layer;
                (spaced.clone(), with_holds(&omitted.layer, spaced, holds, *clock))
            };
            let (spaced, layers) = layers.into_iter().map(held).unzip();
            [spaced, layers].map(|layers| {
                let sheet = Sheet { root: *root, feet: *feet, ..Sheet::new(*clock, layers) };
                let length = sheet.length();
                let lines = speech.iter().filter_map(|line| line.on_sheet(*clock, *last, length));
                let mut lines: Vec<SpokenLine> = lines.collect();
                lines.sort_by_key(|line| line.begin);
                Sheet { lines, ..sheet }
            })
        });
    }
}

/// A koma shows one drawing: of two pins on it, or keys moved there, one would be lost, and they survive
/// everything.
fn one_pin_a_koma(edits: &Edits, clock: Clock) -> Result<(), Error> {
    let moved = edits.moves.iter().map(|moved| moved.to);
    let mut frames: Vec<Frame> = edits.pins.iter().map(|pin| pin.frame).chain(moved).collect();
    frames.sort_unstable();
    let koma = |frame: Frame| clock.koma_from_frame(frame);
    match frames.windows(2).find(|pair| koma(pair[0]) == koma(pair[1])) {
        None => Ok(()),
        Some(pair) => {
            let (a, b, koma) = (pair[0], pair[1], koma(pair[0]) + 1);
            let message = if a == b {
                format!("frame {a} is pinned or moved to twice: once is enough")
            } else {
                format!(
                    "frames {a} and {b}, pinned or moved to, fall on one koma, {koma}: take one of them away"
                )
            };
            Err(Error::Edits { message })
        }
    }
}
