//! The stages of one layer (セル): from the turns of its joints to its column of the sheet.

use std::sync::Arc;

use super::stage::{Made, Stage};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{
    self, Candidates, Choice, Chords, JointTurns, JointWeights, Judges, LayerKeys, Part,
    PartMotion, Picked, Reconstruction, Reference,
};
use crate::motion::{Clip, Screen, Skeleton};
use crate::recipe::Recipe;
use crate::sheet::Layer;
use crate::signal::{LowPass, Signals, Turn, TurnFinder};
use crate::time::{Clock, Frame};
use crate::timing::{Omission, Omitted, Pace, Report, Spaced, Spacing, Stills};

/// What is known of the whole body, measured once for all layers.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured<'a> {
    pub(super) clip: &'a Arc<Clip>,
    /// Which clip this is.
    pub(super) clip_made: Made,
    pub(super) filtered: &'a Signals,
    pub(super) turns: &'a [Vec<Turn>],
    /// Which turns these are.
    pub(super) made: Made,
    /// The body's height in the file's unit, for a layer that is only a part of it.
    pub(super) height: Option<f64>,
    /// From where it is seen.
    pub(super) screen: Screen,
}

/// The stages of one layer, each with its last output.
#[derive(Debug, Clone, Default)]
pub(super) struct Column {
    /// The motion of its joints, and how much each counts.
    motion: Stage<(Part, JointWeights), PartMotion>,
    /// The turns of those that have a say, and the weight of each one's vote.
    voices: Stage<Made, Voices>,
    /// When feet and hands of the layer come down or leave, where that counts.
    contacts: Stage<(keys::AtContacts, f64), Vec<Frame>>,
    candidates: Stage<CandidateSettings, Candidates>,
    reference: Stage<(f64, Option<f64>, Screen), Reference>,
    chords: Stage<f64, Chords>,
    /// What was picked: not made again where all that changed is how strong its keys are.
    picked: Stage<Choice, Picked>,
    keys: Stage<(keys::Choose, Edits, f64, Screen, usize), LayerKeys>,
    spaced: Stage<(Spacing, f64, Part), Spaced>,
    stills: Stage<Screen, Stills>,
    omitted: Stage<(Omission, usize, Vec<usize>), Omitted>,
}

type CandidateSettings = (keys::Choose, TurnFinder, LowPass, f64);

/// What was found and decided for one layer.
#[derive(Debug, Clone, Copy)]
pub struct LayerBreakdown<'a> {
    /// What the joints say together, before it was asked what a key is worth.
    pub candidates: &'a Candidates,
    /// Keys and walls.
    pub keys: &'a LayerKeys,
    /// Inbetweens that were asked for and did not fit.
    pub did_not_fit: usize,
    /// The layer before anything was left out.
    pub spaced: &'a Layer,
    /// The layer on the sheet.
    pub layer: &'a Layer,
    /// What was left out, and what could not be.
    pub omission: &'a Report,
}

impl Column {
    /// Takes on a part of the body.
    pub(super) fn take(
        &mut self,
        measured: &Measured<'_>,
        part: &Part,
        weights: &JointWeights,
    ) -> Result<(), Error> {
        let settings = (part.clone(), weights.clone());
        let motion = || PartMotion::of(measured.clip, part, weights);
        self.motion.refresh(measured.clip_made, &settings, motion)?;
        Ok(())
    }

    /// The keys and walls of the layer.
    pub(super) fn find(&mut self, measured: &Measured<'_>, recipe: &Recipe, edits: &Edits) -> Made {
        let voices = |motion: &PartMotion| Voices::of(measured.clip, motion, measured.turns);
        let motion = self.motion.made;
        let made = self.voices.renew(measured.made, &motion, || voices(self.motion.output()));
        self.touch(measured, recipe);
        let made = self.merge(measured, recipe, made);
        self.compare(measured, recipe);
        self.choose(measured, recipe, edits, made)
    }

    /// The ends of contacts, which are not looked for where they do not count.
    fn touch(&mut self, measured: &Measured<'_>, recipe: &Recipe) {
        let (clip, heard) = (measured.clip, &self.motion.output().heard);
        let settings = (recipe.keys.contacts, recipe.rate);
        self.contacts.renew(self.motion.made, &settings, || match recipe.keys.contacts {
            keys::AtContacts::Off => Vec::new(),
            _ => keys::contact_ends(clip, clip.clock(recipe.rate), heard),
        });
    }

    /// The candidates for keys.
    fn merge(&mut self, measured: &Measured<'_>, recipe: &Recipe, voices_made: Made) -> Made {
        // What is asked of the ranked list does not change the candidates.
        let merging = keys::Choose {
            min_price: 0.0,
            rest: 0.0,
            per_second: f64::INFINITY,
            ..recipe.keys.clone()
        };
        let settings = (merging, recipe.turns.clone(), recipe.filter.clone(), recipe.rate);
        let joints = joints(self.voices.output(), self.contacts.output(), measured, recipe);
        self.candidates.renew(voices_made, &settings, || recipe.keys.candidates(&joints))
    }

    /// What the candidates are judged against.
    fn compare(&mut self, measured: &Measured<'_>, recipe: &Recipe) {
        let PartMotion { clip, judged, .. } = self.motion.output();
        let settings = (recipe.rate, measured.height, measured.screen);
        let made = self.reference.renew(self.motion.made, &settings, || {
            let own =
                Reference::weighted(clip, clip.clock(recipe.rate), judged).on(measured.screen);
            match measured.height {
                None => own,
                Some(height) => own.beside(height),
            }
        });
        let reference = self.reference.output();
        let span = recipe.keys.span();
        self.chords
            .renew(made, &span, || Chords::of_part(clip, measured.clip, reference, judged, span));
    }

    fn choose(
        &mut self,
        measured: &Measured<'_>,
        recipe: &Recipe,
        edits: &Edits,
        candidates_made: Made,
    ) -> Made {
        // Keys stand as far apart as a drawing stays, or the sheet would have no room for both.
        let stay = recipe.spacing.on.stay();
        let settings = (recipe.keys.clone(), edits.clone(), recipe.rate, measured.screen, stay);
        let reference = self.reference.output();
        let judges = Judges { reference, chords: self.chords.output() };
        let candidates = self.candidates.output();
        let joints = joints(self.voices.output(), self.contacts.output(), measured, recipe);
        let (clip, keys, picked) = (measured.clip, &recipe.keys, &mut self.picked);
        let chords_made = self.chords.made;
        self.keys.renew(candidates_made, &settings, || {
            let mut eligible = keys.eligible(clip, judges.chords, candidates, &joints, edits);
            let has_room =
                |frame| recipe.spacing.has_room(frame, reference.clock(), reference.koma());
            eligible.retain(|key| key.origin != keys::Origin::Found || has_room(key.frame));
            let choice = keys.choice(clip, judges, &eligible, stay as f64 * joints.apart);
            picked.renew(chords_made, &choice, || choice.pick(judges.chords));
            keys.drawn(judges.chords, eligible, picked.output(), candidates, &joints, edits)
        })
    }

    /// The column, before and after omission; `later` are the koma on which actions begin after the first.
    pub(super) fn time(
        &mut self,
        (clip, part): (&Clip, &Part),
        recipe: &Recipe,
        clock: Clock,
        (keys_made, later): (Made, &[usize]),
    ) -> Result<Made, Error> {
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let (keys, reference) = (self.keys.output(), self.reference.output());
        let settings = (recipe.spacing.clone(), recipe.rate, part.clone());
        let made = self.spaced.renew(keys_made, &settings, || {
            let spaced =
                recipe.spacing.place(keys, clip.skeleton(), clock, koma, &Pace::of(reference));
            named(spaced, part, clip.skeleton())
        });
        let layer = &self.spaced.output().layer;
        let screen = reference.screen();
        let made = self.stills.renew(made, screen, || Stills::on(clip, layer, screen));
        let stills = self.stills.output();
        let on = recipe.spacing.on.most;
        let omit = || recipe.omission.apply_by_action(layer, stills, on, later);
        self.omitted.refresh(made, &(recipe.omission, on, later.to_vec()), omit)
    }

    /// Drops what only another run would use, and what is large.
    pub(super) fn forget(&mut self) {
        self.motion.forget();
        self.reference.forget();
        self.chords.forget();
        self.stills.forget();
    }

    pub(super) fn breakdown(&self) -> LayerBreakdown<'_> {
        let (spaced, omitted) = (self.spaced.output(), self.omitted.output());
        LayerBreakdown {
            candidates: self.candidates.output(),
            keys: self.keys.output(),
            did_not_fit: spaced.did_not_fit,
            spaced: &spaced.layer,
            layer: &omitted.layer,
            omission: &omitted.report,
        }
    }

    /// What is lost from any instant to another, and which output that is.
    pub(super) fn chords(&self) -> (Made, &Chords) {
        (self.chords.made, self.chords.output())
    }

    pub(super) fn keys(&self) -> &LayerKeys {
        self.keys.output()
    }

    /// How far off the layer is when nothing but its keys is left.
    pub(super) fn reconstruction(&self) -> Reconstruction {
        let keys: Vec<Frame> = self.keys.output().keys.iter().map(|key| key.frame).collect();
        Reconstruction::of(&self.motion.output().clip, self.reference.output(), &keys)
    }
}

/// What is known of the joints once their turns are found.
fn joints<'a>(
    voices: &'a Voices,
    contacts: &'a [Frame],
    measured: &Measured<'a>,
    recipe: &'a Recipe,
) -> JointTurns<'a> {
    JointTurns {
        filtered: measured.filtered,
        turns: voices.turns.as_deref().unwrap_or(measured.turns),
        finder: &recipe.turns,
        delay: recipe.filter.delay(measured.clip.rate()),
        weights: &voices.weights,
        apart: measured.clip.clock(recipe.rate).frames_in_koma(),
        contacts,
    }
}

/// A column under the name of its layer. A layer that is the whole body need not name its joints.
fn named(mut spaced: Spaced, part: &Part, skeleton: &Skeleton) -> Spaced {
    spaced.layer.name.clone_from(&part.name);
    if !part.is_whole(skeleton) {
        let name = |joint: &crate::motion::JointId| skeleton.joints[joint.0].name.clone();
        spaced.layer.joints = part.joints.iter().map(name).collect();
    }
    spaced
}

/// How much each joint counts when keys are chosen.
#[derive(Debug)]
struct Voices {
    /// What a person says of each joint times what hangs on it: the weight of its vote.
    weights: Vec<f64>,
    /// The turns without those of joints that have no say; none where all have.
    turns: Option<Vec<Vec<Turn>>>,
}

impl Voices {
    fn of(clip: &Clip, motion: &PartMotion, turns: &[Vec<Turn>]) -> Self {
        let (weights, own) = (keys::weights(clip), &motion.heard);
        let weights = weights.iter().zip(own).map(|(by_bones, own)| by_bones * own).collect();
        let heard = |(turns, own): (&Vec<Turn>, &f64)| {
            if *own > 0.0 { turns.clone() } else { Vec::new() }
        };
        let some_are_mute = own.contains(&0.0);
        let turns = some_are_mute.then(|| turns.iter().zip(own).map(heard).collect());
        Self { weights, turns }
    }
}
