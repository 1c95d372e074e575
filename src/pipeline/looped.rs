//! Loops (リピート): the chain runs over rounds of a cycle laid end to end, and the middle one is cut out. So the seam is
//! treated like any moment in the midst of the motion.

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use super::laid::{ROUNDS, Round};
use super::layer::LayerBreakdown;
use crate::edits::{CameraCue, Edits, Speech};
use crate::error::Error;
use crate::keys::{
    Actions, BodyTurns, Candidate, Candidates, Key, LayerKeys, Origin, Taken, Walk, Wall,
};
use crate::motion::{Clip, middle_round};
use crate::recipe::Recipe;
use crate::sheet::{CameraWork, Exposure, Layer, Role, Sheet, Source, SpokenLine};
use crate::signal::{Signals, Turn};
use crate::time::{Clock, Frame};
use crate::timing::{Gone, OmissionReport, StageReport};

impl Round {
    /// Returns the actions of the rounds: those found if the middle round has any, or else every round is one.
    pub(super) fn actions(&self, found: &Actions) -> Vec<Frame> {
        let middle = self.middle();
        let splits: Vec<Frame> = found.splits().iter().map(|split| split.frame).collect();
        if splits.iter().any(|frame| middle.contains(&frame.0)) {
            return splits;
        }
        vec![Frame(middle.start), Frame(middle.end)]
    }

    /// Frames of the middle round, without its last.
    fn middle(&self) -> Range<usize> {
        let first = self.first.0 + self.repeat.frames;
        first..first + self.repeat.frames
    }

    /// Returns a frame of the middle round as a frame of the clip; `None` for one of another round.
    fn own(&self, frame: Frame) -> Option<Frame> {
        let is_own = self.middle().contains(&frame.0);
        is_own.then(|| Frame(frame.0 - self.repeat.frames))
    }

    /// Returns a place in any round as one in the clip.
    fn wrapped(&self, place: f64) -> f64 {
        place - self.rounds_before(place) * self.repeat.frames as f64
    }

    /// Returns a frame of any round as one of the clip.
    pub(super) fn frame_in_clip(&self, frame: Frame) -> Frame {
        Frame(self.wrapped(frame.0 as f64).round() as usize)
    }

    fn rounds_before(&self, place: f64) -> f64 {
        ((place - self.first.0 as f64) / self.repeat.frames as f64).floor()
    }

    /// Returns a source in any round as one in the clip. A blend over the seam becomes the pose of the take at its place.
    fn wrapped_source(&self, source: Source) -> Source {
        match source {
            Source::Between { from, to, .. }
                if self.rounds_before(from) == self.rounds_before(to) =>
            {
                source.later(self.wrapped(from) - from)
            }
            source => Source::At(self.wrapped(source.place())),
        }
    }

    fn frames_in_koma(&self) -> f64 {
        self.repeat.frames as f64 / self.repeat.koma as f64
    }
}

/// The results that a loop shows of a run over laid rounds. Frames are those of the clip.
#[derive(Debug, Clone)]
pub(super) struct Looped {
    pub(super) clip: Arc<Clip>,
    pub(super) clock: Clock,
    pub(super) speed: Signals,
    pub(super) filtered: Signals,
    pub(super) turns: Vec<Vec<Turn>>,
    pub(super) actions: Actions,
    pub(super) spaced: Sheet,
    pub(super) sheet: Sheet,
    pub(super) layers: Vec<LoopedLayer>,
}

/// The results of a run over laid rounds.
pub(super) struct Rounded<'a> {
    pub(super) source: &'a Arc<Clip>,
    pub(super) drawn: &'a Arc<Clip>,
    pub(super) speed: &'a Signals,
    pub(super) filtered: &'a Signals,
    pub(super) turns: &'a [Vec<Turn>],
    pub(super) sheets: &'a [Sheet; 2],
    pub(super) layers: Vec<LayerBreakdown<'a>>,
}

impl Round {
    /// Cuts the middle round out of the results of a run, repeats its exposures, and places them in the cut.
    ///
    /// # Errors
    /// Those of [`Sheet::placed`].
    pub(super) fn cut(
        &self,
        all: &Rounded<'_>,
        recipe: &Recipe,
        edits: &Edits,
    ) -> Result<Looped, Error> {
        let is_drawn = !recipe.exaggerate.is_off();
        let frames = self.repeat.frames;
        let drawn = || middle_round(all.drawn).with_rate(all.source.rate());
        let round = || Arc::new(drawn().with_beside_of(all.source));
        let clip = if is_drawn { round() } else { Arc::clone(all.source) };
        let clock = all.source.clock(recipe.rate);
        let signals = |signals: &Signals| Signals {
            values: signals.values.rows(frames, frames + 1).into_owned(),
            first: self.first,
            ..signals.clone()
        };
        let turn = |turn: &Turn| Some(Turn { frame: self.own(turn.frame)?, ..*turn });
        let turns = all.turns.iter().map(|turns| turns.iter().filter_map(turn).collect());
        let [spaced, sheet] = all.sheets;
        let root = &clip.skeleton().joints[0].name;
        let carries = |layer: &Layer| layer.joints.contains(root);
        let root = sheet.layers.iter().position(carries).unwrap_or(0);
        let start = self.start(&sheet.layers[root]);
        let [mut spaced, mut sheet] = [(spaced, true), (sheet, recipe.omission.keep_length)]
            .map(|(all, keeps)| self.sheet(all, (root, keeps), start, clock));
        let speech = edits.speech.iter().cloned();
        sheet.lines = self.lines(speech, (clock, start), sheet.length());
        let cues = edits.camera.iter().map(CameraCue::speech);
        let camera = self.lines(cues, (clock, start), sheet.length());
        let camera = camera.into_iter().map(CameraWork::from_line).collect();
        let guesses = std::mem::take(&mut sheet.camera);
        sheet.camera = CameraWork::with_guesses(camera, guesses);
        let cut = all.layers.iter().zip(&spaced.layers).zip(&sheet.layers);
        let layers = cut.map(|((layer, spaced), sheet)| self.layer(layer, spaced, sheet)).collect();
        for sheet in [&mut spaced, &mut sheet] {
            sheet.repeat = Some(self.repeat);
            let layers = sheet.layers.iter_mut();
            layers.for_each(|layer| layer.exposures = layer.exposures.repeat(recipe.cycles));
        }
        let [spaced, sheet] = [spaced, sheet].map(|sheet| sheet.placed(edits.at, edits.length));
        let (spaced, sheet) = (spaced?, sheet?);
        Ok(Looped {
            actions: Actions::whole(&clip),
            clip,
            clock,
            speed: signals(all.speed),
            filtered: signals(all.filtered),
            turns: turns.collect(),
            spaced,
            sheet,
            layers,
        })
    }

    /// Returns the place of the drawing with which the round begins: the first genga of the middle round that the next
    /// round has as well, or else the first drawing.
    fn start(&self, layer: &Layer) -> f64 {
        let shown: Vec<_> = layer.shown().collect();
        let (middle, near) = (self.middle(), 0.75 * self.frames_in_koma());
        let (begin, end) = (middle.start as f64 - near, middle.end as f64 - near);
        let inside = |place: f64| begin <= place && place < end;
        let own = || shown.iter().filter(|drawing| inside(drawing.source.place()));
        let comes_again = |place: f64| {
            let again = place + self.repeat.frames as f64;
            shown.iter().any(|other| (other.source.place() - again).abs() < near)
        };
        let genga = || own().filter(|drawing| drawing.role == Role::Genga);
        let first = genga().find(|drawing| comes_again(drawing.source.place()));
        let first = first.or_else(|| genga().next()).or_else(|| own().next());
        first.map_or(middle.start as f64, |drawing| drawing.source.place())
    }

    /// Cuts a round out of a sheet, from the drawing at `start` of a layer, `root`, on. If the sheet does not keep the
    /// time of the take, the round ends where that drawing comes again.
    fn sheet(&self, all: &Sheet, (root, keeps): (usize, bool), start: f64, clock: Clock) -> Sheet {
        let layer = &all.layers[root];
        let begin = self.koma_of(layer, start).unwrap_or_else(|| {
            let koma = (start - self.first.0 as f64) / self.frames_in_koma();
            (koma.round() as usize).min(layer.length().saturating_sub(1))
        });
        let again = self.koma_of(layer, start + self.repeat.frames as f64);
        let end = again.filter(|end| !keeps && *end > begin);
        let end = end.unwrap_or(begin + self.repeat.koma);
        let layers = all.layers.iter().map(|layer| self.column(layer, begin..end)).collect();
        let camera = all.camera.iter().filter(|work| work.is_guess);
        let camera = camera.filter_map(|work| within(work, &(begin..end))).collect();
        Sheet { clock, layers, lines: Vec::new(), camera, ..all.clone() }
    }

    /// Returns the koma on which the drawing at a place comes on screen; `None` if there is none within a koma.
    fn koma_of(&self, layer: &Layer, place: f64) -> Option<usize> {
        let away = |shown: &(usize, Exposure)| {
            (layer.drawings[shown.1.drawing].source.place() - place).abs()
        };
        let nearest = layer.timed().min_by(|a, b| away(a).total_cmp(&away(b)));
        nearest.filter(|shown| away(shown) < self.frames_in_koma()).map(|(begin, _)| begin)
    }

    /// Cuts some koma out of a layer. A drawing that comes again at the end is the one of the begin.
    fn column(&self, layer: &Layer, koma: Range<usize>) -> Layer {
        let mut column = Layer { drawings: Vec::new(), exposures: Vec::new(), ..layer.clone() };
        let mut first = None;
        for (begin, shown) in layer.timed() {
            let (from, to) = (begin.max(koma.start), (begin + shown.koma).min(koma.end));
            if from >= to {
                continue;
            }
            let drawing = &layer.drawings[shown.drawing];
            let place = drawing.source.place();
            let again = *first.get_or_insert(place) + self.repeat.frames as f64;
            let at = if (place - again).abs() < 0.5 * self.frames_in_koma() || place > again {
                0
            } else {
                let mut drawing = drawing.clone();
                drawing.source = self.wrapped_source(drawing.source);
                if let Some(from) = &mut drawing.why.moved_from {
                    *from = self.wrapped(*from as f64).round() as usize;
                }
                column.drawings.push(drawing);
                column.drawings.len() - 1
            };
            column.exposures.push(Exposure { drawing: at, koma: to - from });
        }
        column
    }

    /// Returns the lines of the first round, on the koma after its first drawing.
    fn lines(
        &self,
        speech: impl Iterator<Item = Speech>,
        (clock, start): (Clock, f64),
        length: usize,
    ) -> Vec<SpokenLine> {
        let (koma, last) = (self.repeat.koma, Frame(self.first.0 + self.repeat.frames));
        let phase = clock.koma_from_place(self.wrapped(start));
        let line = |line: SpokenLine| {
            let begin = ((line.begin + 2 * koma - phase) % koma).min(length.saturating_sub(1));
            SpokenLine { begin, koma: line.koma.min(length - begin), ..line }
        };
        let lines = speech.filter_map(|own| own.on_sheet(clock, last, koma));
        let mut lines: Vec<SpokenLine> = lines.map(line).collect();
        lines.sort_by_key(|line| line.begin);
        lines
    }
}

/// The part of some camera work that falls on some koma, counted from the first of them.
fn within(work: &CameraWork, koma: &Range<usize>) -> Option<CameraWork> {
    let (begin, past) = (work.begin.max(koma.start), work.past().min(koma.end));
    let own = past.checked_sub(begin).filter(|own| *own > 0)?;
    Some(CameraWork { begin: begin - koma.start, koma: own, ..work.clone() })
}

/// The results of a layer for one round.
#[derive(Debug, Clone)]
pub(super) struct LoopedLayer {
    crispness: f64,
    drawn: f64,
    body: BodyTurns,
    candidates: Candidates,
    keys: LayerKeys,
    uncorrected: Vec<Key>,
    did_not_fit: usize,
    gaits: Vec<Range<usize>>,
    spaced: Layer,
    layer: Layer,
    omission: OmissionReport,
}

impl LoopedLayer {
    pub(super) fn breakdown(&self) -> LayerBreakdown<'_> {
        LayerBreakdown {
            crispness: self.crispness,
            drawn: self.drawn,
            body: &self.body,
            candidates: &self.candidates,
            keys: &self.keys,
            uncorrected: &self.uncorrected,
            did_not_fit: self.did_not_fit,
            gaits: &self.gaits,
            spaced: &self.spaced,
            stills: None,
            layer: &self.layer,
            omission: &self.omission,
        }
    }
}

impl Round {
    fn layer(&self, all: &LayerBreakdown<'_>, spaced: &Layer, layer: &Layer) -> LoopedLayer {
        let LayerBreakdown { crispness, drawn, body, candidates, keys, .. } = *all;
        let frames = self.repeat.frames;
        let walls = |walls: &[Wall]| {
            let own = walls.iter().filter_map(|wall| Some((self.own(wall.frame)?, wall)));
            own.map(|(frame, wall)| Wall { frame, ..*wall }).collect()
        };
        let gait = keys.gaits.iter().filter_map(|gait| self.gait(gait)).collect();
        let round = |all: &[f64]| all.iter().skip(frames).take(frames + 1).copied().collect();
        let rest = |rest: &RangeInclusive<Frame>| {
            let end = rest.end().0.checked_sub(frames)?.min(self.first.0 + frames);
            let begin = rest.start().0.saturating_sub(frames).max(self.first.0);
            (begin < end).then_some(Frame(begin)..=Frame(end))
        };
        let candidate = |candidate: &Candidate| {
            let frame = self.own(candidate.frame)?;
            Some(Candidate { frame, ..*candidate })
        };
        LoopedLayer {
            crispness,
            drawn,
            body: BodyTurns {
                first: self.first,
                dips: round(&body.dips),
                evidence: round(&body.evidence),
                turns: body.turns.iter().filter_map(|frame| self.own(*frame)).collect(),
                walls: walls(&body.walls),
            },
            candidates: Candidates {
                keys: candidates.keys.iter().filter_map(candidate).collect(),
                walls: walls(&candidates.walls),
            },
            keys: LayerKeys {
                keys: self.keys(&keys.keys),
                without_corrections: self.keys(&keys.without_corrections),
                walls: walls(&keys.walls),
                rests: keys.rests.iter().filter_map(rest).collect(),
                holds_end: false,
                gaits: gait,
                over_limit: keys.over_limit.div_ceil(ROUNDS),
            },
            uncorrected: self.keys(all.uncorrected),
            did_not_fit: all.did_not_fit.div_ceil(ROUNDS),
            gaits: all.gaits.iter().take(1).map(|_| 0..layer.length()).collect(),
            omission: OmissionReport {
                naka_nashi: self.stage(&all.omission.naka_nashi, spaced),
                koma_dori: self.stage(&all.omission.koma_dori, spaced),
                lengthened: all.omission.lengthened.div_ceil(ROUNDS),
            },
            spaced: spaced.clone(),
            layer: layer.clone(),
        }
    }

    fn keys(&self, keys: &[Key]) -> Vec<Key> {
        let key = |key: &Key| {
            let frame = self.own(key.frame)?;
            let origin = match key.origin {
                Origin::Moved { from } => {
                    Origin::Moved { from: Frame(from.0.saturating_sub(self.repeat.frames)) }
                }
                origin => origin,
            };
            Some(Key { frame, origin, ..key.clone() })
        };
        keys.iter().filter_map(key).collect()
    }

    /// Returns the steps of a gait that begin in the round; `None` if none does.
    fn gait(&self, gait: &Walk) -> Option<Walk> {
        let koma = self.repeat.koma as f64;
        let mut own = gait.clone();
        own.steps.retain(|step| (koma..2.0 * koma).contains(&(step.contact + 0.5)));
        for step in &mut own.steps {
            (step.contact, step.next) = (step.contact - koma, step.next - koma);
            let set = step.taken.iter_mut().filter_map(|taken| match taken {
                Some(Taken::By(set)) => Some(set),
                _ => None,
            });
            let frames = step.frames.iter_mut().flatten().chain(set);
            frames.for_each(|frame| frame.0 = frame.0.saturating_sub(self.repeat.frames));
        }
        (!own.steps.is_empty()).then_some(own)
    }

    fn stage(&self, all: &StageReport, spaced: &Layer) -> StageReport {
        let own = |gone: &Gone| {
            let middle = self.middle();
            let is_own = (middle.start as f64..middle.end as f64).contains(&gone.place);
            is_own.then(|| self.wrapped(gone.place))
        };
        let gone = |place: f64| {
            let away = |at: &usize| (spaced.drawings[*at].source.place() - place).abs();
            let drawing = (0..spaced.drawings.len()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
            let shown = spaced.timed().find(|(_, shown)| shown.drawing == drawing);
            Some(Gone { drawing, place, koma: shown.map_or(0, |(begin, _)| begin) })
        };
        let gone: Vec<Gone> = all.gone.iter().filter_map(own).filter_map(gone).collect();
        StageReport {
            asked: (all.asked + ROUNDS / 2) / ROUNDS,
            done: gone.len(),
            gone,
            shortfall: all.shortfall,
        }
    }
}
