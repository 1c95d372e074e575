//! The stages of one layer (セル), from the turns of its joints to its column of the sheet.

use std::ops::{Deref, Range, RangeInclusive};

use super::moving::Moving;
use super::stage::{Before, Of, Stage};
use super::voters::{Voices, joints};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{
    self, Alike, BodySpeeds, BodyTurns, Candidates, Choice, Choose, Chords, Chosen, JointWeights,
    Judges, Key, LayerClip, LayerJoints, LayerKeys, LayerMotion, Picked, Picks, Reconstruction,
    Reference, Tracks, Word,
};
use crate::motion::{Gait, Screen, Skeleton};
use crate::recipe::{LayerTiming, Recipe};
use crate::sheet::Layer;
use crate::signal::{Drawn, LowPass, Signals, Turn};
use crate::time::Frame;
use crate::timing::{
    self, ByPassage, Course, Omission, OmissionReport, Omitted, Pace, Spaced, Spacing, Stills,
};

/// The whole moving body with the measurements of its joints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured<'a> {
    pub(super) moving: Moving<'a>,
    pub(super) filtered: Of<'a, Signals>,
    pub(super) turns: Of<'a, Vec<Vec<Turn>>>,
}

impl<'a> Deref for Measured<'a> {
    type Target = Moving<'a>;

    fn deref(&self) -> &Moving<'a> {
        &self.moving
    }
}

/// The stages of one layer, each with its last output.
#[derive(Debug, Clone, Default)]
pub(super) struct LayerStages {
    /// The motion of the layer's joints, and the weight of each.
    motion: Stage<(LayerJoints, JointWeights), LayerClip>,
    /// The yardstick for the layer: rate, height of the body, screen.
    reference: Stage<(f64, Option<f64>, Screen), Reference>,
    /// The loss between any two koma, up to a span in seconds.
    chords: Stage<f64, Chords>,
    /// Which poses look the same on the sheet, given how far the body may get from a drawing.
    alike: Stage<f64, Alike>,
    /// The first and last instant of each rest.
    rests: Stage<f64, Vec<RangeInclusive<usize>>>,
    /// The turns of the joints that vote, and the weight of each vote.
    voices: Stage<(), Voices>,
    /// The layer's gaits, if their steps are to share the same phases, at a rate in koma per second.
    gaits: Stage<(bool, f64), Vec<Gait>>,
    /// The frames at which the layer's feet and hands land or leave, if contacts count.
    contacts: Stage<(keys::AtContacts, f64), Vec<Frame>>,
    /// How the layer's moving parts move, and the stages made from it: crispness, how much of it counts as drawn,
    /// speeds, and (in `body`) the turns of the layer as a whole.
    tracks: Stage<Screen, Tracks>,
    crispness: Stage<(), f64>,
    drawn: Stage<(Drawn, Option<f64>), f64>,
    speeds: Stage<LowPass, BodySpeeds>,
    /// The persistence and the least distance between two turns, in frames.
    body: Stage<(f64, f64), BodyTurns>,
    /// The candidates for keys, at least that many frames apart; then (`free`, `around`) the choice without and with corrections.
    candidates: Stage<(Choose, f64), Candidates>,
    free: Choosing,
    around: Choosing,
    /// The keys without and with corrections, each correction in its own neighbourhood or all keys chosen again; before
    /// any key is moved.
    corrected: Stage<(Choose, Edits, f64, f64), [Chosen; 2]>,
    /// The settings include the clip's first and last frame.
    keys: Stage<(Choose, Edits, f64, (Frame, Frame)), LayerKeys>,
    /// The settings include the koma that are timed; the others show the source.
    spaced: Stage<(ByPassage<Spacing>, ByPassage<bool>, LayerJoints), Spaced>,
    stills: Stage<(), Stills>,
    omitted: Stage<(ByPassage<Omission>, Course), Omitted>,
}

/// A choice of keys, with or without a person's corrections.
#[derive(Debug, Clone, Default)]
struct Choosing {
    /// The eligible keys, by frame.
    eligible: Stage<(Choose, Edits, Spacing, f64), Vec<Key>>,
    /// The picked keys; not made again if only the strength of keys changed.
    picked: Stage<Choice, Picked>,
    chosen: Stage<(), Chosen>,
}

/// Results for one layer.
#[derive(Debug, Clone, Copy)]
pub struct LayerBreakdown<'a> {
    /// How abruptly the layer changes its velocities, from 0 (like captured motion) to 1 (kinks only).
    pub crispness: f64,
    /// How much of the layer counts as drawn, 0 to 1: derived from its crispness, or set by the recipe.
    pub drawn: f64,
    /// The turns of the layer as a whole.
    pub body: &'a BodyTurns,
    /// The candidates for keys, before they are valued.
    pub candidates: &'a Candidates,
    /// Keys and walls.
    pub keys: &'a LayerKeys,
    /// The keys that corrections apply to: those found without any correction, or the frozen ones. They have no phases of
    /// gaits, as [`LayerKeys::without_corrections`] has.
    pub uncorrected: &'a [Key],
    /// Number of requested inbetweens that did not fit.
    pub did_not_fit: usize,
    /// The koma of the layer's gaits, from first to last contact. Omission leaves them alone.
    pub gaits: &'a [Range<usize>],
    /// The layer before omission.
    pub spaced: &'a Layer,
    /// Positions of all joints in its drawings; `None` after [`Engine::run_once`](super::Engine::run_once),
    /// which drops them.
    pub stills: Option<&'a Stills>,
    /// The layer on the sheet.
    pub layer: &'a Layer,
    /// The drawings left out, and those that could not be.
    pub omission: &'a OmissionReport,
}

impl LayerStages {
    /// Sets the joints of the layer.
    pub(super) fn take(
        &mut self,
        moving: &Moving<'_>,
        joints: &LayerJoints,
        weights: &JointWeights,
    ) -> Result<(), Error> {
        let settings = (joints.clone(), weights.clone());
        let inputs = (moving.clip, moving.build);
        self.motion.try_make(inputs, settings, |(clip, build), (joints, weights)| {
            LayerClip::new(&clip, joints, &build.members, weights)
        })
    }

    /// Runs the stages of the key search that do not need single joints' turns. If joints have no vote, that is
    /// everything but the list of joints that turn.
    pub(super) fn find_alone(&mut self, moving: &Moving<'_>, recipe: &Recipe, edits: &Edits) {
        self.compare(moving, recipe);
        self.touch(moving, recipe);
        self.turn(moving, recipe);
        if !recipe.keys.hears_joints() {
            self.gather(moving, None, recipe);
            self.correct(moving, recipe, edits, moving.apart(recipe));
        }
    }

    /// Finds the keys and walls of the layer.
    pub(super) fn find(&mut self, measured: &Measured<'_>, recipe: &Recipe, edits: &Edits) {
        self.find_alone(measured, recipe, edits);
        self.hear(measured);
        if recipe.keys.hears_joints() {
            self.gather(measured, Some(measured), recipe);
            self.correct(measured, recipe, edits, measured.apart(recipe));
        }
        self.draw(measured, recipe, edits);
    }

    /// Builds the yardstick for the layer.
    fn refer(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        let settings = (recipe.rate, moving.height, moving.screen);
        let inputs = (self.motion.output(), moving.build);
        self.reference.make(inputs, settings, |(motion, build), settings| {
            let (rate, height, screen) = *settings;
            let LayerClip { clip, judged, .. } = motion.value();
            let own = Reference::of_build(clip, &build, clip.clock(rate), judged).on(screen);
            match height {
                None => own,
                Some(height) => own.beside(height),
            }
        });
    }

    /// Computes the loss between any two koma, and where there is none.
    pub(super) fn compare(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.refer(moving, recipe);
        let inputs = (self.motion.output(), moving.build, self.reference.output());
        self.chords.make(inputs, recipe.keys.span(), |(motion, build, reference), span| {
            Chords::of_layer(&motion.clip, &build, &reference, &motion.judged, *span)
        });
        let inputs = (self.reference.output(), self.chords.output());
        self.alike.make(inputs, recipe.spacing.drift, |(reference, chords), drift| {
            let pace = Pace::new(&reference).with_acting(&chords);
            timing::alike(&pace, *drift)
        });
        let chords = (self.chords.output(),);
        self.rests.make(chords, recipe.keys.rest, |(chords,), rest| keys::rests(&chords, *rest));
    }

    /// Determines which joints vote.
    fn hear(&mut self, measured: &Measured<'_>) {
        let motion = self.motion.output();
        self.voices.make((measured.clip, motion, measured.turns), (), |inputs, ()| {
            let (clip, motion, turns) = inputs;
            Voices::new(&clip, &motion, &turns)
        });
    }

    /// Finds the ends of contacts, unless they do not count.
    fn touch(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        let motion = self.motion.output();
        let settings = (recipe.keys.contacts, recipe.rate);
        self.contacts.make((moving.clip, motion), settings, |(clip, motion), settings| {
            match *settings {
                (keys::AtContacts::Off, _) => Vec::new(),
                (_, rate) => keys::contact_ends(&clip, clip.clock(rate), &motion.heard),
            }
        });
    }

    /// Computes how the moving parts of the layer move.
    pub(super) fn follow(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.compare(moving, recipe);
        let (reference, chords) = (self.reference.output(), self.chords.output());
        let inputs = (self.motion.output(), moving.build, reference, chords);
        self.tracks.make(inputs, moving.screen, |(motion, build, reference, chords), screen| {
            let LayerClip { clip, judged, heard, .. } = motion.value();
            let (height, acting) = (reference.height(), chords.value().acting());
            let build = build.value();
            Tracks::new(&LayerMotion { clip, build, heard, judged, screen, height, acting })
        });
    }

    /// Finds the turns of the layer as a whole.
    fn turn(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.follow(moving, recipe);
        let (tracks, rate) = ((self.tracks.output(),), moving.clip.rate());
        self.crispness.make(tracks, (), |(tracks,), ()| tracks.crispness());
        let crispness = (self.crispness.output(),);
        let settings = (recipe.turns.drawn, moving.crispness);
        self.drawn.make(crispness, settings, |(own,), (drawn, whole)| {
            // The body's crispness is the upper bound, since a toe or a finger may be still and leap in any capture.
            let crispness = whole.map_or(*own, |whole| own.min(whole));
            drawn.share(keys::drawn(crispness))
        });
        let drawn = *self.drawn.output();
        let (filter, persistence) = recipe.turns.of_body(&recipe.filter, drawn, rate);
        self.speeds.make_over(tracks, filter, |(tracks,), filter, before| {
            BodySpeeds::over(before.map(|before| before.output), &tracks, filter)
        });
        let settings = (persistence, moving.apart(recipe));
        self.body.make((self.speeds.output(),), settings, |(speeds,), settings| {
            speeds.turns(settings.0, settings.1)
        });
    }

    /// Gathers the candidates for keys; `heard` are the joints, if they vote.
    fn gather(&mut self, moving: &Moving<'_>, heard: Option<&Measured<'_>>, recipe: &Recipe) {
        let apart = moving.apart(recipe);
        // Price, rests and limit only choose among the candidates, so they are neutralised here.
        let merging = Choose {
            min_price: 0.0,
            prices_within: Vec::new(),
            rest: 0.0,
            at_rests: keys::AtRests::Off,
            gaits: keys::AtGaits::Off,
            per_second: f64::INFINITY,
            ..recipe.keys.clone()
        };
        let (body, settings) = (self.body.output(), (merging, apart));
        let Some(Measured { filtered, turns, .. }) = heard else {
            return self
                .candidates
                .make((body,), settings, |(body,), (choose, apart)| choose.moments(&body, *apart));
        };
        let known = (*filtered, *turns, self.voices.output(), body, self.contacts.output());
        self.candidates.make(known, settings, |known, (choose, apart)| {
            choose.candidates(&joints(known, *apart))
        });
    }

    /// Finds the gaits of a layer that contains both legs.
    fn walk(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        let inputs = (moving.clip, moving.build, self.motion.output());
        let settings = (recipe.keys.walks(), recipe.rate);
        self.gaits.make(inputs, settings, |(clip, build, motion), (walks, rate)| {
            let legs = build.mannequin.as_ref().map(|body| body.legs().concat());
            let has_legs = |joints: Vec<usize>| joints.iter().all(|joint| motion.moves[*joint]);
            match *walks && legs.is_some_and(has_legs) {
                true => Gait::find_all(&clip, &build, clip.clock(*rate)),
                false => Vec::new(),
            }
        });
    }

    /// Selects the keys among the candidates, each with the joints that turn there.
    fn draw(&mut self, measured: &Measured<'_>, recipe: &Recipe, edits: &Edits) {
        self.walk(measured, recipe);
        let turns = measured.turns;
        let inputs = (
            self.chords.output(),
            self.rests.output(),
            self.corrected.output(),
            self.candidates.output(),
            turns,
            self.voices.output(),
            self.gaits.output(),
        );
        let ends = (measured.clip.first(), measured.clip.last());
        let apart = measured.apart(recipe);
        let settings = (recipe.keys.clone(), edits.clone(), apart, ends);
        self.keys.make(inputs, settings, |inputs, (choose, edits, apart, ends)| {
            let (chords, rests, corrected, candidates, turns, voices, gaits) = inputs;
            let heard = (voices.turns(turns.value()), &voices.weights[..]);
            let still = (chords.value(), &rests[..]);
            let [found, chosen] = &*corrected;
            let (walls, gaits) = (&candidates.walls, gaits.value());
            let picked = Picks { found, chosen, walls, gaits };
            choose.drawn(still, picked, heard, (*ends, edits, *apart))
        });
    }

    /// Chooses the keys without corrections and with them: anew around each correction, or all of them.
    fn correct(&mut self, moving: &Moving<'_>, recipe: &Recipe, edits: &Edits, koma: f64) {
        let (pins, forbidden) = (edits.pins.clone(), edits.forbidden.clone());
        // Moves are applied later; eligibility does not depend on them.
        let asked = Edits { pins, forbidden, ..Edits::default() };
        let mut free = std::mem::take(&mut self.free);
        self.admit(&mut free, moving, recipe, Edits::default(), koma);
        self.pick(&mut free, moving, recipe, koma);
        self.free = free;
        // The choice depends only on the corrections, which are part of the key of the cached result.
        let is_other = !asked.is_empty();
        if is_other {
            let mut around = std::mem::take(&mut self.around);
            self.admit(&mut around, moving, recipe, asked, koma);
            if edits.again {
                self.pick(&mut around, moving, recipe, koma);
            }
            self.around = around;
        }
        let may_be_now = if is_other { &self.around } else { &self.free };
        let last = if is_other && edits.again { &self.around } else { &self.free };
        let may_be = (self.free.eligible.output(), may_be_now.eligible.output());
        let chosen = (self.free.chosen.output(), last.chosen.output());
        let chords = self.chords.output();
        let alike = self.alike.output();
        let inputs = (moving.clip, chords, alike, may_be.0, may_be.1, chosen.0, chosen.1);
        let apart = recipe.spacing.on.stay() as f64 * koma;
        let edits = Edits { moves: Vec::new(), ..edits.clone() };
        let settings = (recipe.keys.clone(), edits, koma, apart);
        self.corrected.make(inputs, settings, |inputs, (choose, edits, koma, apart)| {
            let (clip, chords, alike, free, around, before, last) = inputs;
            let motion = (&**clip.value(), chords.value());
            let before = match edits.frozen.as_slice() {
                [] => before.value().clone(),
                frames => choose.frozen(motion, &alike, frames, &free),
            };
            let word = Word { edits, koma: *koma, apart: *apart, alike: &alike };
            let is_bare = edits.pins.is_empty() && edits.forbidden.is_empty();
            let corrected = match edits.again {
                true => last.value().clone(),
                false if is_bare => before.clone(),
                false => choose.correct(motion, &before, &around, word),
            };
            [before, corrected]
        });
    }

    /// Finds the eligible keys, given a person's corrections and the room on the sheet.
    fn admit(
        &self,
        choosing: &mut Choosing,
        moving: &Moving<'_>,
        recipe: &Recipe,
        edits: Edits,
        koma: f64,
    ) {
        let (chords, rests) = (self.chords.output(), self.rests.output());
        let (candidates, contacts) = (self.candidates.output(), self.contacts.output());
        let reference = self.reference.output();
        let inputs = (moving.clip, chords, rests, candidates, contacts, reference);
        // Of the spacing, keys depend only on how long a drawing stays and what counts as rest.
        let Spacing { on, drift, .. } = recipe.spacing;
        let room = Spacing { on, drift, ..Spacing::default() };
        let settings = (recipe.keys.clone(), edits, room, koma);
        choosing.eligible.make(inputs, settings, |inputs, (choose, edits, spacing, koma)| {
            let (clip, chords, rests, candidates, contacts, reference) = inputs;
            let still = (chords.value(), &rests[..]);
            let mut keys = choose.eligible(&clip, still, &candidates, &contacts, (edits, *koma));
            let held = match choose.at_rests {
                keys::AtRests::Keys => keys::rest_frames(&chords, &rests),
                keys::AtRests::Off => Vec::new(),
            };
            let pace = Pace::new(&reference).with_acting(&chords);
            let room = spacing.room(&held, reference.clock(), reference.koma(), &pace);
            keys.retain(|key| !key.origin.is_found() || room(key.frame));
            keys
        });
    }

    /// Picks the keys among the eligible ones.
    fn pick(&self, choosing: &mut Choosing, moving: &Moving<'_>, recipe: &Recipe, koma: f64) {
        let (chords, reference) = (self.chords.output(), self.reference.output());
        let alike = self.alike.output().value();
        let judges = Judges { reference: reference.value(), chords: chords.value(), alike };
        // Keys are at least as far apart as a drawing stays, or the sheet would lack room for both.
        let apart = recipe.spacing.on.stay() as f64 * koma;
        let eligible = choosing.eligible.output();
        let choice = recipe.keys.choice(&moving.clip, judges, &eligible, apart);
        choosing.picked.make((chords,), choice, |(chords,), choice| choice.pick(&chords));
        let inputs = (choosing.eligible.output(), choosing.picked.output());
        choosing.chosen.make(inputs, (), |(keys, picked), ()| Chosen::new(keys.value(), &picked));
    }

    /// Times the column before and after omission; `later` are the koma at which all actions but the first begin.
    pub(super) fn time(
        &mut self,
        measured: &Measured<'_>,
        joints: &LayerJoints,
        timing: LayerTiming,
        later: &[usize],
    ) -> Result<(), Error> {
        let (reference, chords) = (self.reference.output(), self.chords.output());
        let inputs = (measured.clip, self.keys.output(), reference, chords);
        let LayerTiming { spacing, omission, timed } = timing;
        let on = spacing.map(|own| own.on);
        let settings = (spacing, timed, joints.clone());
        self.spaced.make(inputs, settings, |(clip, keys, reference, chords), settings| {
            let (spacing, timed, joints) = settings;
            let (skeleton, pace) = (clip.skeleton(), Pace::new(&reference).with_acting(&chords));
            let koma = clip.rate().koma_from_frames(clip.len(), reference.clock().koma_rate);
            let clock = reference.clock();
            let spaced = spacing.place_within(timed, &keys, skeleton, clock, koma, &pace);
            named(spaced, joints, skeleton)
        });
        let spaced = self.spaced.output();
        let inputs = (measured.clip, self.reference.output(), spaced);
        self.stills.make_over(inputs, (), |(clip, reference, spaced), (), before| {
            let (layer, screen) = (&spaced.layer, reference.screen());
            match before {
                Some(Before { output, same }) if same[..2] == [true; 2] => {
                    output.again(&clip, layer, screen)
                }
                _ => Stills::on(&clip, layer, screen),
            }
        });
        let course = Course {
            on,
            later: later.to_vec(),
            kept: spaced.gaits.iter().chain(&spaced.source).cloned().collect(),
            height: self.reference.output().height(),
        };
        let inputs = (spaced, self.stills.output());
        self.omitted.try_make(inputs, (omission, course), |inputs, settings| {
            let ((spaced, stills), (omission, course)) = (inputs, settings);
            omission.apply_to(&spaced.layer, &stills, course)
        })
    }

    /// Drops large outputs and those that only a further run would use.
    pub(super) fn forget(&mut self) {
        self.motion.forget();
        self.reference.forget();
        self.chords.forget();
        self.tracks.forget();
        self.speeds.forget();
        self.stills.forget();
    }

    pub(super) fn breakdown(&self) -> LayerBreakdown<'_> {
        let (spaced, omitted) = (self.spaced.output().value(), self.omitted.output().value());
        LayerBreakdown {
            crispness: *self.crispness.output(),
            drawn: *self.drawn.output(),
            body: self.body.output().value(),
            candidates: self.candidates.output().value(),
            keys: self.keys.output().value(),
            uncorrected: &self.corrected.output().value()[0].keys,
            did_not_fit: spaced.did_not_fit,
            gaits: &spaced.gaits,
            spaced: &spaced.layer,
            stills: self.stills.last(),
            layer: &omitted.layer,
            omission: &omitted.report,
        }
    }

    /// Returns the loss between any two instants.
    pub(super) fn chords(&self) -> Of<'_, Chords> {
        self.chords.output()
    }

    /// Returns the turns of the layer as a whole, its keys, and the keys before corrections.
    pub(super) fn keys(&self) -> (&BodyTurns, &LayerKeys, &[Key]) {
        let before = &self.corrected.output().value()[0].keys;
        (self.body.output().value(), self.keys.output().value(), before)
    }

    /// Returns the layer before and after omission.
    pub(super) fn timed(&self) -> (Of<'_, Spaced>, Of<'_, Omitted>) {
        (self.spaced.output(), self.omitted.output())
    }

    /// Runs the stages up to the turns of the layer as a whole.
    pub(super) fn find_body_turns(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.turn(moving, recipe);
    }

    /// Returns the turns of the layer as a whole.
    pub(super) fn body_turns(&self) -> &BodyTurns {
        self.body.output().value()
    }

    /// Measures how far the layer deviates if only its keys remain.
    pub(super) fn reconstruction(&self) -> Reconstruction {
        let keys: Vec<Frame> = self.keys.output().keys.iter().map(|key| key.frame).collect();
        Reconstruction::new(&self.motion.output().clip, &self.reference.output(), &keys)
    }
}

/// Names a column after its layer. A layer that is the whole body need not list its joints.
fn named(mut spaced: Spaced, joints: &LayerJoints, skeleton: &Skeleton) -> Spaced {
    spaced.layer.name.clone_from(&joints.name);
    if !joints.is_whole(skeleton) {
        let name = |joint: &crate::motion::JointId| skeleton.joints[joint.0].name.clone();
        spaced.layer.joints = joints.joints.iter().map(name).collect();
    }
    spaced
}
