//! The stages of one layer (セル): from the turns of its joints to its column of the sheet.

use std::ops::RangeInclusive;
use std::sync::Arc;

use super::stage::{Made, Stage};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{
    self, BodySpeeds, BodyTurns, Candidates, Choice, Chords, JointTurns, JointWeights, Judges,
    LayerKeys, LayerMotion, Part, PartMotion, Picked, Reconstruction, Reference, Tracks,
};
use crate::motion::{Build, Clip, Screen, Skeleton};
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
    /// The build of the body.
    pub(super) build: &'a Build,
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
    /// How all that moves in the layer moves, how fast that is, and when it turns as a whole.
    tracks: Stage<(Screen, f64), Tracks>,
    speeds: Stage<LowPass, BodySpeeds>,
    body: Stage<(f64, f64), BodyTurns>,
    candidates: Stage<CandidateSettings, Candidates>,
    reference: Stage<(f64, Option<f64>, Screen), Reference>,
    chords: Stage<f64, Chords>,
    /// The instants from begin to end of each rest.
    rests: Stage<f64, Vec<RangeInclusive<usize>>>,
    /// What was picked: not made again where all that changed is how strong its keys are.
    picked: Stage<Choice, Picked>,
    keys: Stage<KeySettings, LayerKeys>,
    spaced: Stage<(Spacing, f64, Part), Spaced>,
    stills: Stage<Screen, Stills>,
    omitted: Stage<(Omission, usize, Vec<usize>), Omitted>,
}

type CandidateSettings = (keys::Choose, (TurnFinder, LowPass, f64), Made);

/// At the end the rate, how long drawings stay and how far the body may go in a rest.
type KeySettings = (keys::Choose, Edits, Screen, (f64, usize, f64));

/// What was found and decided for one layer.
#[derive(Debug, Clone, Copy)]
pub struct LayerBreakdown<'a> {
    /// When it turns as a whole.
    pub body: &'a BodyTurns,
    /// What may be a key, before it was asked what it is worth.
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
        self.compare(measured, recipe);
        let turns_made = self.turn(measured, recipe);
        let made = self.merge(measured, recipe, (made, turns_made));
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

    /// The turns of the layer as a whole.
    fn turn(&mut self, measured: &Measured<'_>, recipe: &Recipe) -> Made {
        let PartMotion { clip, judged, heard } = self.motion.output();
        let Measured { build, screen, .. } = measured;
        let height = self.reference.output().height();
        let motion = LayerMotion { clip, build, heard, judged, screen, height };
        let settings = (*screen, recipe.rate);
        let made = self.tracks.renew(self.motion.made, &settings, || Tracks::of(&motion));
        let (filter, tracks) = (&recipe.filter, self.tracks.output());
        let made = self.speeds.renew(made, filter, || BodySpeeds::of(tracks, filter));
        let persistence = recipe.turns.persistence.frames(clip.rate());
        let apart = clip.clock(recipe.rate).frames_in_koma();
        let speeds = self.speeds.output();
        self.body.renew(made, &(persistence, apart), || speeds.turns(persistence, apart))
    }

    /// The candidates for keys.
    fn merge(&mut self, measured: &Measured<'_>, recipe: &Recipe, made: (Made, Made)) -> Made {
        // Price, rests and limit choose among candidates and do not change them.
        let merging = keys::Choose {
            min_price: 0.0,
            rest: 0.0,
            per_second: f64::INFINITY,
            ..recipe.keys.clone()
        };
        let (voices_made, turns_made) = made;
        let finding = (recipe.turns.clone(), recipe.filter.clone(), recipe.rate);
        let settings = (merging, finding, turns_made);
        let joints = joints(
            self.voices.output(),
            self.body.output(),
            self.contacts.output(),
            measured,
            recipe,
        );
        self.candidates.renew(voices_made, &settings, || recipe.keys.candidates(&joints))
    }

    /// What the layer is judged beside.
    fn refer(&mut self, measured: &Measured<'_>, recipe: &Recipe) -> Made {
        let PartMotion { clip, judged, .. } = self.motion.output();
        let settings = (recipe.rate, measured.height, measured.screen);
        self.reference.renew(self.motion.made, &settings, || {
            let own =
                Reference::weighted(clip, clip.clock(recipe.rate), judged).on(measured.screen);
            match measured.height {
                None => own,
                Some(height) => own.beside(height),
            }
        })
    }

    /// What is lost from any koma to another.
    fn compare(&mut self, measured: &Measured<'_>, recipe: &Recipe) {
        let made = self.refer(measured, recipe);
        let PartMotion { clip, judged, .. } = self.motion.output();
        let reference = self.reference.output();
        let span = recipe.keys.span();
        self.chords
            .renew(made, &span, || Chords::of_part(clip, measured.build, reference, judged, span));
        let (chords, rest) = (&self.chords, recipe.keys.rest);
        self.rests.renew(chords.made, &rest, || keys::rests(chords.output(), rest));
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
        let sheet = (recipe.rate, stay, recipe.spacing.drift);
        let settings = (recipe.keys.clone(), edits.clone(), measured.screen, sheet);
        let reference = self.reference.output();
        let judges = Judges { reference, chords: self.chords.output() };
        let candidates = self.candidates.output();
        let joints = joints(
            self.voices.output(),
            self.body.output(),
            self.contacts.output(),
            measured,
            recipe,
        );
        let (clip, keys, spacing) = (measured.clip, &recipe.keys, &recipe.spacing);
        let (picked, rests) = (&mut self.picked, self.rests.output());
        let chords_made = self.chords.made;
        self.keys.renew(candidates_made, &settings, || {
            let still = (judges.chords, rests.as_slice());
            let mut eligible = keys.eligible(clip, still, candidates, &joints, edits);
            let held = keys::rest_frames(judges.chords, rests);
            let pace = Pace::of(reference);
            let room = spacing.room(&held, reference.clock(), reference.koma(), &pace);
            eligible.retain(|key| !key.origin.is_found() || room(key.frame));
            let choice = keys.choice(clip, judges, &eligible, stay as f64 * joints.apart);
            picked.renew(chords_made, &choice, || choice.pick(judges.chords));
            keys.drawn(still, eligible, picked.output(), candidates, &joints, edits)
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
        self.tracks.forget();
        self.speeds.forget();
        self.stills.forget();
    }

    pub(super) fn breakdown(&self) -> LayerBreakdown<'_> {
        let (spaced, omitted) = (self.spaced.output(), self.omitted.output());
        LayerBreakdown {
            body: self.body.output(),
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

    /// Its turns as a whole, and its keys.
    pub(super) fn keys(&self) -> (&BodyTurns, &LayerKeys) {
        (self.body.output(), self.keys.output())
    }

    /// Runs its stages up to its turns as a whole.
    pub(super) fn find_body_turns(&mut self, measured: &Measured<'_>, recipe: &Recipe) {
        self.refer(measured, recipe);
        self.turn(measured, recipe);
    }

    /// Its turns as a whole.
    pub(super) fn body_turns(&self) -> &BodyTurns {
        self.body.output()
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
    body: &'a BodyTurns,
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
        body,
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
