//! The stages of one layer (セル): from the turns of its joints to its column of the sheet.

use std::ops::{Deref, Range, RangeInclusive};

use super::moving::Moving;
use super::stage::{Before, Of, Stage};
use super::voices::{Finding, Voices, joints};
use crate::edits::Edits;
use crate::error::Error;
use crate::keys::{
    self, Alike, BodySpeeds, BodyTurns, Candidates, Choice, Choose, Chords, Chosen, JointWeights,
    Judges, Key, LayerClip, LayerJoints, LayerKeys, LayerMotion, Picked, Picks, Reconstruction,
    Reference, Tracks, Word,
};
use crate::motion::{Gait, Screen, Skeleton};
use crate::recipe::Recipe;
use crate::sheet::Layer;
use crate::signal::{Drawn, LowPass, Signals, Turn};
use crate::time::Frame;
use crate::timing::{
    self, Course, Omission, OmissionReport, Omitted, Pace, Spaced, Spacing, Stills,
};

/// The whole body that moves, with what was measured of its joints.
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
    /// The motion of its joints, and how much each counts.
    motion: Stage<(LayerJoints, JointWeights), LayerClip>,
    /// What the layer is judged beside: rate, height of the body, screen.
    reference: Stage<(f64, Option<f64>, Screen), Reference>,
    /// What is lost from any koma to another, up to a span in seconds.
    chords: Stage<f64, Chords>,
    /// Which poses are one on the sheet, by how far the body may get from a drawing.
    alike: Stage<f64, Alike>,
    /// The instants from begin to end of each rest.
    rests: Stage<f64, Vec<RangeInclusive<usize>>>,
    /// The turns of joints that have a say, and the weight of each one's vote.
    voices: Stage<(), Voices>,
    /// Its gaits, where their steps are to have the same phases, at koma a second.
    gaits: Stage<(bool, f64), Vec<Gait>>,
    /// When feet and hands of the layer come down or leave, where that counts.
    contacts: Stage<(keys::AtContacts, f64), Vec<Frame>>,
    /// How all that moves in the layer moves, how suddenly it changes that and how much of it is drawn, how fast it is,
    /// and when it turns as a whole.
    tracks: Stage<Screen, Tracks>,
    crispness: Stage<(), f64>,
    drawn: Stage<(Drawn, Option<f64>), f64>,
    speeds: Stage<LowPass, BodySpeeds>,
    /// Persistence and the least distance of two turns, in frames.
    body: Stage<(f64, f64), BodyTurns>,
    /// What may be a key, before a person and the sheet have their say, and after.
    candidates: Stage<(Choose, Finding), Candidates>,
    free: Choosing,
    around: Choosing,
    /// The keys with corrections, each in its own neighbourhood or all chosen again; before any is moved.
    corrected: Stage<(Choose, Edits, f64, f64), [Chosen; 2]>,
    /// The clip's ends are a setting of it.
    keys: Stage<(Choose, Edits, Finding, (Frame, Frame)), LayerKeys>,
    spaced: Stage<(Spacing, LayerJoints), Spaced>,
    stills: Stage<(), Stills>,
    omitted: Stage<(Omission, Course), Omitted>,
}

/// A choice of keys, before a person has a say or after.
#[derive(Debug, Clone, Default)]
struct Choosing {
    /// What may be a key, by frame.
    eligible: Stage<(Choose, Edits, Spacing, f64), Vec<Key>>,
    /// What was picked: not made again where all that changed is how strong its keys are.
    picked: Stage<Choice, Picked>,
    chosen: Stage<(), Chosen>,
}

/// What was found and decided for one layer.
#[derive(Debug, Clone, Copy)]
pub struct LayerBreakdown<'a> {
    /// How suddenly it changes its velocities, 0 as a capture does to 1 for nothing but kinks.
    pub crispness: f64,
    /// How much of it counts as drawn, 0 to 1: by its crispness, or as the recipe says.
    pub drawn: f64,
    /// When it turns as a whole.
    pub body: &'a BodyTurns,
    /// What may be a key, before it was asked what it is worth.
    pub candidates: &'a Candidates,
    /// Keys and walls.
    pub keys: &'a LayerKeys,
    /// The keys that a person corrects: those that are found without any correction, or that are frozen.
    pub uncorrected: &'a [Key],
    /// Inbetweens that were asked for and did not fit.
    pub did_not_fit: usize,
    /// The koma of its gaits, from the first contact to the last, in which nothing is left out.
    pub gaits: &'a [Range<usize>],
    /// The layer before anything was left out.
    pub spaced: &'a Layer,
    /// Where all joints stand in its drawings; none after [`Engine::run_once`](super::Engine::run_once), which forgets it.
    pub stills: Option<&'a Stills>,
    /// The layer on the sheet.
    pub layer: &'a Layer,
    /// What was left out, and what could not be.
    pub omission: &'a OmissionReport,
}

impl LayerStages {
    /// Takes on the joints of the layer.
    pub(super) fn take(
        &mut self,
        moving: &Moving<'_>,
        joints: &LayerJoints,
        weights: &JointWeights,
    ) -> Result<(), Error> {
        let settings = (joints.clone(), weights.clone());
        let inputs = (moving.clip, moving.build);
        self.motion.try_make(inputs, settings, |(clip, build), (joints, weights)| {
            LayerClip::of(&clip, joints, &build.members, weights)
        })
    }

    /// Finds of the keys what does not wait for the turns of single joints: where those have no say, all but who turns.
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

    /// What the layer is judged beside.
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

    /// What is lost from any koma to another, and where nothing is.
    pub(super) fn compare(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.refer(moving, recipe);
        let inputs = (self.motion.output(), moving.build, self.reference.output());
        self.chords.make(inputs, recipe.keys.span(), |(motion, build, reference), span| {
            Chords::of_layer(&motion.clip, &build, &reference, &motion.judged, *span)
        });
        let inputs = (self.reference.output(), self.chords.output());
        self.alike.make(inputs, recipe.spacing.drift, |(reference, chords), drift| {
            let pace = Pace::of(&reference).with_acting(&chords);
            timing::alike(&pace, *drift)
        });
        let chords = (self.chords.output(),);
        self.rests.make(chords, recipe.keys.rest, |(chords,), rest| keys::rests(&chords, *rest));
    }

    /// Who of the joints has a say.
    fn hear(&mut self, measured: &Measured<'_>) {
        let motion = self.motion.output();
        self.voices.make((measured.clip, motion, measured.turns), (), |inputs, ()| {
            let (clip, motion, turns) = inputs;
            Voices::of(&clip, &motion, &turns)
        });
    }

    /// The ends of contacts, which are not looked for where they do not count.
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

    /// How all that moves in the layer moves.
    pub(super) fn follow(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.compare(moving, recipe);
        let (reference, chords) = (self.reference.output(), self.chords.output());
        let inputs = (self.motion.output(), moving.build, reference, chords);
        self.tracks.make(inputs, moving.screen, |(motion, build, reference, chords), screen| {
            let LayerClip { clip, judged, heard, .. } = motion.value();
            let (height, acting) = (reference.height(), chords.value().acting());
            let build = build.value();
            Tracks::of(&LayerMotion { clip, build, heard, judged, screen, height, acting })
        });
    }

    /// The turns of the layer as a whole.
    fn turn(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.follow(moving, recipe);
        let (tracks, rate) = ((self.tracks.output(),), moving.clip.rate());
        self.crispness.make(tracks, (), |(tracks,), ()| tracks.crispness());
        let crispness = (self.crispness.output(),);
        let settings = (recipe.turns.drawn, moving.crispness);
        self.drawn.make(crispness, settings, |(own,), (drawn, whole)| {
            // A toe or a finger may be still and leap in any capture.
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

    /// What may be a key; `heard` are the joints where they have a say.
    fn gather(&mut self, moving: &Moving<'_>, heard: Option<&Measured<'_>>, recipe: &Recipe) {
        let finding = Finding::of(moving, recipe);
        // Price, rests and limit choose among candidates and do not change them.
        let merging = Choose {
            min_price: 0.0,
            rest: 0.0,
            at_rests: keys::AtRests::Off,
            gaits: keys::AtGaits::Off,
            per_second: f64::INFINITY,
            ..recipe.keys.clone()
        };
        let (body, settings) = (self.body.output(), (merging, finding));
        let Some(Measured { filtered, turns, .. }) = heard else {
            return self.candidates.make((body,), settings, |(body,), (choose, finding)| {
                choose.moments(&body, finding.apart)
            });
        };
        let known = (*filtered, *turns, self.voices.output(), body, self.contacts.output());
        self.candidates.make(known, settings, |known, (choose, finding)| {
            choose.candidates(&joints(known, finding))
        });
    }

    /// The gaits of a layer that has both legs.
    fn walk(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        let inputs = (moving.clip, moving.build, self.motion.output());
        let settings = (recipe.keys.walks(), recipe.rate);
        self.gaits.make(inputs, settings, |(clip, build, motion), (walks, rate)| {
            let legs = build.mannequin.as_ref().map(|body| body.legs().concat());
            let has_legs = |joints: Vec<usize>| joints.iter().all(|joint| motion.moves[*joint]);
            match *walks && legs.is_some_and(has_legs) {
                true => Gait::of(&clip, &build, clip.clock(*rate)),
                false => Vec::new(),
            }
        });
    }

    /// The keys among it, with who turns on each.
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
        let finding = Finding::of(measured, recipe);
        let settings = (recipe.keys.clone(), edits.clone(), finding, ends);
        self.keys.make(inputs, settings, |inputs, (choose, edits, finding, ends)| {
            let (chords, rests, corrected, candidates, turns, voices, gaits) = inputs;
            let heard = (voices.turns(turns.value()), &voices.weights[..]);
            let still = (chords.value(), &rests[..]);
            let picked =
                Picks { chosen: &corrected[1], walls: &candidates.walls, gaits: gaits.value() };
            choose.drawn(still, picked, heard, (*ends, edits, finding.apart))
        });
    }

    /// The keys without corrections, and with them: chosen again in the neighbourhood of each, or all of them.
    fn correct(&mut self, moving: &Moving<'_>, recipe: &Recipe, edits: &Edits, koma: f64) {
        let (pins, forbidden) = (edits.pins.clone(), edits.forbidden.clone());
        // Moves come later: what may be a key does not hang on them.
        let asked = Edits { pins, forbidden, ..Edits::default() };
        let mut free = std::mem::take(&mut self.free);
        self.admit(&mut free, moving, recipe, Edits::default(), koma);
        self.pick(&mut free, moving, recipe, koma);
        self.free = free;
        // Which choice is taken hangs on the corrections alone, by which the result is kept too.
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
                frames => choose.frozen(motion, frames, &free),
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

    /// What may be a key beside what a person asks for and where the sheet has room.
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
        // How long a drawing stays and what still counts as rest is all that keys hang on of spacing.
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
            let pace = Pace::of(&reference).with_acting(&chords);
            let room = spacing.room(&held, reference.clock(), reference.koma(), &pace);
            keys.retain(|key| !key.origin.is_found() || room(key.frame));
            keys
        });
    }

    /// Which of them are drawn.
    fn pick(&self, choosing: &mut Choosing, moving: &Moving<'_>, recipe: &Recipe, koma: f64) {
        let (chords, reference) = (self.chords.output(), self.reference.output());
        let alike = self.alike.output().value();
        let judges = Judges { reference: reference.value(), chords: chords.value(), alike };
        // Keys stand as far apart as a drawing stays, or the sheet would have no room for both.
        let apart = recipe.spacing.on.stay() as f64 * koma;
        let eligible = choosing.eligible.output();
        let choice = recipe.keys.choice(&moving.clip, judges, &eligible, apart);
        choosing.picked.make((chords,), choice, |(chords,), choice| choice.pick(&chords));
        let inputs = (choosing.eligible.output(), choosing.picked.output());
        choosing.chosen.make(inputs, (), |(keys, picked), ()| Chosen::of(keys.value(), &picked));
    }

    /// The column, before and after omission; `later` are the koma on which actions begin after the first.
    pub(super) fn time(
        &mut self,
        measured: &Measured<'_>,
        joints: &LayerJoints,
        recipe: &Recipe,
        later: &[usize],
    ) -> Result<(), Error> {
        let (reference, chords) = (self.reference.output(), self.chords.output());
        let inputs = (measured.clip, self.keys.output(), reference, chords);
        let settings = (recipe.spacing.clone(), joints.clone());
        self.spaced.make(inputs, settings, |(clip, keys, reference, chords), (spacing, joints)| {
            let (skeleton, pace) = (clip.skeleton(), Pace::of(&reference).with_acting(&chords));
            let koma = clip.rate().koma_from_frames(clip.len(), reference.clock().koma_rate);
            named(spacing.place(&keys, skeleton, reference.clock(), koma, &pace), joints, skeleton)
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
            on: recipe.spacing.on,
            later: later.to_vec(),
            gaits: spaced.gaits.clone(),
            height: self.reference.output().height(),
        };
        let inputs = (spaced, self.stills.output());
        self.omitted.try_make(inputs, (recipe.omission, course), |inputs, settings| {
            let ((spaced, stills), (omission, course)) = (inputs, settings);
            omission.apply_to(&spaced.layer, &stills, course)
        })
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

    /// What is lost from any instant to another.
    pub(super) fn chords(&self) -> Of<'_, Chords> {
        self.chords.output()
    }

    /// Its turns as a whole, its keys, and those before corrections.
    pub(super) fn keys(&self) -> (&BodyTurns, &LayerKeys, &[Key]) {
        let before = &self.corrected.output().value()[0].keys;
        (self.body.output().value(), self.keys.output().value(), before)
    }

    /// The layer before and after omission.
    pub(super) fn timed(&self) -> (Of<'_, Spaced>, Of<'_, Omitted>) {
        (self.spaced.output(), self.omitted.output())
    }

    /// Runs its stages up to its turns as a whole.
    pub(super) fn find_body_turns(&mut self, moving: &Moving<'_>, recipe: &Recipe) {
        self.turn(moving, recipe);
    }

    /// Its turns as a whole.
    pub(super) fn body_turns(&self) -> &BodyTurns {
        self.body.output().value()
    }

    /// How far off the layer is when nothing but its keys is left.
    pub(super) fn reconstruction(&self) -> Reconstruction {
        let keys: Vec<Frame> = self.keys.output().keys.iter().map(|key| key.frame).collect();
        Reconstruction::of(&self.motion.output().clip, &self.reference.output(), &keys)
    }
}

/// A column under the name of its layer. A layer that is the whole body need not name its joints.
fn named(mut spaced: Spaced, joints: &LayerJoints, skeleton: &Skeleton) -> Spaced {
    spaced.layer.name.clone_from(&joints.name);
    if !joints.is_whole(skeleton) {
        let name = |joint: &crate::motion::JointId| skeleton.joints[joint.0].name.clone();
        spaced.layer.joints = joints.joints.iter().map(name).collect();
    }
    spaced
}
