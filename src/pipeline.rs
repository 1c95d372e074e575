//! The whole chain: [`Clip`] + [`Recipe`] + [`Edits`] → [`Breakdown`].

use std::sync::Arc;

use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{
    self, Candidates, Chords, JointTurns, JointWeights, Judges, LayerKeys, Reconstruction,
    Reference,
};
use crate::motion::Clip;
use crate::recipe::Recipe;
use crate::sheet::Sheet;
use crate::signal::{LowPass, Signals, Spectrum, Turn, TurnFinder};
use crate::time::{Clock, Frame, Span};
use crate::timing::{Omitted, Pace, Report, Spaced, Stills};

#[cfg(test)]
mod tests;

/// Runs the chain and keeps each stage's last output with the settings that made it, so that a run
/// starts again at the first stage whose input changed. A clone shares what was made so far.
#[derive(Debug, Clone)]
pub struct Engine {
    clip: Arc<Clip>,
    /// The speeds, and what filters make of them first.
    speed: Stage<crate::signal::Speed, Spectrum>,
    filtered: Stage<LowPass, Signals>,
    /// The turns whatever the persistence, and those that it confirms.
    turning: Stage<(TurnFinder, LowPass), Vec<Vec<Turn>>>,
    turns: Stage<Span, Vec<Vec<Turn>>>,
    /// How much each joint counts, and the turns of those that do.
    voices: Stage<JointWeights, Voices>,
    candidates: Stage<CandidateSettings, Candidates>,
    reference: Stage<(f64, JointWeights), Reference>,
    chords: Stage<(f64, JointWeights, f64), Chords>,
    keys: Stage<(keys::Choose, Edits, f64), LayerKeys>,
    spaced: Stage<(crate::timing::Spacing, f64), Spaced>,
    stills: Stage<(), Stills>,
    omitted: Stage<(crate::timing::Omission, usize), Omitted>,
    sheets: Stage<f64, [Sheet; 2]>,
}

type CandidateSettings = (keys::Choose, TurnFinder, LowPass, f64);

/// Every intermediate result of a run.
#[derive(Debug, Clone, Copy)]
pub struct Breakdown<'a> {
    /// The motion.
    pub clip: &'a Clip,
    /// Where the sheet's koma stand in it.
    pub clock: Clock,
    /// How fast each joint is.
    pub speed: &'a Signals,
    /// The same, smoothed.
    pub filtered: &'a Signals,
    /// Confirmed keys and walls of each joint, by frame.
    pub turns: &'a [Vec<Turn>],
    /// What the joints say together, before it was asked what a key is worth.
    pub candidates: &'a Candidates,
    /// Keys and walls of the layer.
    pub keys: &'a LayerKeys,
    /// Inbetweens that were asked for and did not fit.
    pub did_not_fit: usize,
    /// The sheet before anything was left out.
    pub spaced: &'a Sheet,
    /// The result.
    pub sheet: &'a Sheet,
    /// What was left out, and what could not be.
    pub omission: &'a Report,
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
            speed: Stage::default(),
            filtered: Stage::default(),
            turning: Stage::default(),
            turns: Stage::default(),
            voices: Stage::default(),
            candidates: Stage::default(),
            reference: Stage::default(),
            chords: Stage::default(),
            keys: Stage::default(),
            spaced: Stage::default(),
            stills: Stage::default(),
            omitted: Stage::default(),
            sheets: Stage::default(),
        })
    }

    /// The motion.
    pub fn clip(&self) -> &Clip {
        &self.clip
    }

    /// Runs the chain as far as it has to be run again.
    ///
    /// # Errors
    /// [`Error::Setting`] or [`Error::Edits`] when a setting or a correction does not hold, and when two
    /// pins fall on one koma.
    pub fn run(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Breakdown<'_>, Error> {
        let keys_made = self.find(recipe, edits)?;
        let clock = self.clip.clock(recipe.rate);
        self.time(recipe, clock, keys_made)?;
        Ok(self.breakdown(clock))
    }

    /// [`Engine::run`] for the last time: what only another run would use is forgotten.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn run_once(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Breakdown<'_>, Error> {
        let clock = self.run(recipe, edits)?.clock;
        self.turning.forget();
        self.reference.forget();
        self.chords.forget();
        self.stills.forget();
        Ok(self.breakdown(clock))
    }

    fn breakdown(&self, clock: Clock) -> Breakdown<'_> {
        let [spaced, sheet] = self.sheets.output();
        Breakdown {
            clip: &self.clip,
            clock,
            speed: self.speed.output().unfiltered(),
            filtered: self.filtered.output(),
            turns: self.turns.output(),
            candidates: self.candidates.output(),
            keys: self.keys.output(),
            did_not_fit: self.spaced.output().did_not_fit,
            spaced,
            sheet,
            omission: &self.omitted.output().report,
        }
    }

    /// Runs the chain up to every joint's turns.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_turns(&mut self, recipe: &Recipe) -> Result<&[Vec<Turn>], Error> {
        recipe.validate()?;
        self.measure(recipe)?;
        Ok(self.turns.output())
    }

    /// Runs the chain up to the keys: every joint's turns, and the keys of the layer.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn find_keys(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<(&[Vec<Turn>], &LayerKeys), Error> {
        self.find(recipe, edits)?;
        Ok((self.turns.output(), self.keys.output()))
    }

    /// How far off the body is when nothing but the keys of a recipe is left.
    ///
    /// # Errors
    /// Those of [`Engine::run`].
    pub fn reconstruction(
        &mut self,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<Reconstruction, Error> {
        self.find(recipe, edits)?;
        let keys: Vec<Frame> = self.keys.output().keys.iter().map(|key| key.frame).collect();
        Ok(Reconstruction::of(&self.clip, self.reference.output(), &keys))
    }

    fn find(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Made, Error> {
        let turns = self.check_and_measure(recipe, edits)?;
        let candidates = self.merge(recipe, turns);
        Ok(self.choose(recipe, edits, candidates))
    }

    fn check_and_measure(&mut self, recipe: &Recipe, edits: &Edits) -> Result<Made, Error> {
        recipe.validate()?;
        edits.validate(self.clip.first(), self.clip.last())?;
        one_pin_a_koma(edits, self.clip.clock(recipe.rate))?;
        let weights = &recipe.keys.weights;
        // What is wrong with them is said before the work.
        let own = weights.of(self.clip.skeleton())?;
        let turns = self.measure(recipe)?;
        let (clip, found) = (&*self.clip, self.turns.output());
        Ok(self.voices.renew(turns, weights, || Voices::of(clip, own, found)))
    }

    /// Speeds, smoothed, and where they turn.
    fn measure(&mut self, recipe: &Recipe) -> Result<Made, Error> {
        let clip = &*self.clip;
        let measure = || recipe.speed.measure(clip).map(Spectrum::from);
        let made = self.speed.refresh(Made::CLIP, &recipe.speed, measure)?;
        let spectrum = self.speed.output();
        let made =
            self.filtered.refresh(made, &recipe.filter, || Ok(recipe.filter.apply(spectrum)))?;
        let filtered = self.filtered.output();
        let delay = recipe.filter.delay(clip.rate());
        // A candidate knows for how long it is confirmed: another persistence needs no new search.
        let persistence = recipe.turns.persistence;
        let search = TurnFinder { persistence: Span::Frames(0.0), ..recipe.turns.clone() };
        let settings = (search, recipe.filter.clone());
        let made = self.turning.renew(made, &settings, || recipe.turns.candidates(filtered, delay));
        let candidates = self.turning.output();
        let confirm = || recipe.turns.confirmed(candidates, filtered);
        Ok(self.turns.renew(made, &persistence, confirm))
    }

    /// What is known of the joints once their turns are found.
    fn joints<'a>(&'a self, recipe: &'a Recipe) -> JointTurns<'a> {
        JointTurns {
            filtered: self.filtered.output(),
            turns: self.voices.output().turns.as_deref().unwrap_or(self.turns.output()),
            finder: &recipe.turns,
            delay: recipe.filter.delay(self.clip.rate()),
            weights: &self.voices.output().weights,
            apart: self.clip.clock(recipe.rate).frames_in_koma(),
        }
    }

    /// The candidates for keys, and what they are judged against.
    fn merge(&mut self, recipe: &Recipe, turns_made: Made) -> Made {
        // What is asked of the ranked list does not change the candidates.
        let merging = keys::Choose {
            min_price: 0.0,
            rest: 0.0,
            per_second: f64::INFINITY,
            ..recipe.keys.clone()
        };
        let settings = (merging, recipe.turns.clone(), recipe.filter.clone(), recipe.rate);
        let mut candidates = std::mem::take(&mut self.candidates);
        let make = || recipe.keys.candidates(&self.joints(recipe));
        let made = candidates.renew(turns_made, &settings, make);
        self.candidates = candidates;
        let clip = &*self.clip;
        let settings = (recipe.rate, recipe.keys.weights.clone());
        let own = &self.voices.output().own;
        self.reference.renew(Made::CLIP, &settings, || {
            Reference::weighted(clip, clip.clock(recipe.rate), own)
        });
        let reference = self.reference.output();
        let (rate, weights) = settings;
        let span = recipe.keys.span();
        let settings = (rate, weights, span);
        self.chords.renew(Made::CLIP, &settings, || Chords::of(clip, reference, own, span));
        made
    }

    /// The keys and walls of the layer.
    fn choose(&mut self, recipe: &Recipe, edits: &Edits, candidates_made: Made) -> Made {
        let settings = (recipe.keys.clone(), edits.clone(), recipe.rate);
        let mut keys = std::mem::take(&mut self.keys);
        let made = keys.renew(candidates_made, &settings, || {
            let judges =
                Judges { reference: self.reference.output(), chords: self.chords.output() };
            let candidates = self.candidates.output();
            recipe.keys.choose(&self.clip, judges, candidates, &self.joints(recipe), edits)
        });
        self.keys = keys;
        made
    }

    /// The sheet, before and after omission.
    fn time(&mut self, recipe: &Recipe, clock: Clock, keys_made: Made) -> Result<(), Error> {
        let clip = &*self.clip;
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let keys = self.keys.output();
        let reference = self.reference.output();
        let made = self.spaced.renew(keys_made, &(recipe.spacing.clone(), recipe.rate), || {
            let spacing = &recipe.spacing;
            let pace = if spacing.on.is_fixed() { Pace::default() } else { Pace::of(reference) };
            spacing.place(keys, clip.skeleton(), clock, koma, &pace)
        });
        let layer = &self.spaced.output().layer;
        let made = self.stills.renew(made, &(), || Stills::of(clip, layer));
        let stills = self.stills.output();
        let on = recipe.spacing.on.most;
        let settings = (recipe.omission, on);
        let made =
            self.omitted.refresh(made, &settings, || recipe.omission.apply(layer, stills, on))?;
        let omitted = &self.omitted.output().layer;
        self.sheets.renew(made, &recipe.rate, || {
            [layer, omitted].map(|layer| Sheet { clock, layers: vec![layer.clone()] })
        });
        Ok(())
    }
}

/// How much each joint counts when keys are chosen.
#[derive(Debug)]
struct Voices {
    /// What a person says of each joint, 1 where they say nothing.
    own: Vec<f64>,
    /// The same times what hangs on it: the weight of its vote.
    weights: Vec<f64>,
    /// The turns without those of joints that have no say; none where all have.
    turns: Option<Vec<Vec<Turn>>>,
}

impl Voices {
    fn of(clip: &Clip, own: Vec<f64>, turns: &[Vec<Turn>]) -> Self {
        let weights = keys::weights(clip);
        let weights = weights.iter().zip(&own).map(|(by_bones, own)| by_bones * own).collect();
        let heard = |(turns, own): (&Vec<Turn>, &f64)| {
            if *own > 0.0 { turns.clone() } else { Vec::new() }
        };
        let some_are_mute = own.contains(&0.0);
        let turns = some_are_mute.then(|| turns.iter().zip(&own).map(heard).collect());
        Self { own, weights, turns }
    }
}

/// A koma shows one drawing: of two pins on it, or keys moved there, one would be lost, and they survive
/// everything.
fn one_pin_a_koma(edits: &Edits, clock: Clock) -> Result<(), Error> {
    let moved = edits.moves.iter().map(|moved| moved.to);
    let mut frames: Vec<Frame> = edits.pins.iter().map(|pin| pin.frame).chain(moved).collect();
    frames.sort_unstable();
    let koma = |frame: Frame| clock.koma_from_place(frame.0 as f64);
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

/// Which of its outputs a stage holds, so that the next stage knows whether it has used that one. A
/// run may end after any stage: whether a stage did something *in this run* would not tell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
struct Made(u64);

impl Made {
    /// The clip never changes.
    const CLIP: Self = Self(0);
}

/// A stage's last output with the input and the settings that made it.
#[derive(Debug)]
struct Stage<Settings, Output> {
    last: Option<Arc<(Made, Settings, Output)>>,
    made: Made,
}

impl<Settings, Output> Clone for Stage<Settings, Output> {
    fn clone(&self) -> Self {
        Self { last: self.last.clone(), made: self.made }
    }
}

impl<Settings, Output> Default for Stage<Settings, Output> {
    fn default() -> Self {
        Self { last: None, made: Made::default() }
    }
}

impl<Settings: Clone + PartialEq, Output> Stage<Settings, Output> {
    /// Makes the output again if its input or its settings changed. Says which output it holds now.
    fn refresh(
        &mut self,
        input: Made,
        settings: &Settings,
        make: impl FnOnce() -> Result<Output, Error>,
    ) -> Result<Made, Error> {
        let is_fresh =
            self.last.as_deref().is_some_and(|(from, with, _)| *from == input && with == settings);
        if !is_fresh {
            // Forgotten first: should `make` fail, a later run must not take the old output for the new.
            self.last = None;
            self.last = Some(Arc::new((input, settings.clone(), make()?)));
            self.made = Made(self.made.0 + 1);
        }
        Ok(self.made)
    }

    /// [`Stage::refresh`] for a stage that cannot fail.
    fn renew(&mut self, input: Made, settings: &Settings, make: impl FnOnce() -> Output) -> Made {
        self.refresh(input, settings, || Ok(make())).expect("this stage cannot fail")
    }

    /// Drops the output; asked for again, it is made again.
    fn forget(&mut self) {
        self.last = None;
    }

    fn output(&self) -> &Output {
        &self.last.as_ref().expect("the stage was run before its output is asked for").2
    }
}
