//! Finds keys and walls of one joint: where its speed turns [KT11 §3.3, §3.4].

mod drawn;
mod event;
mod literal;
mod run_lengths;
mod steady;

use std::cmp::Ordering;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::JointId;
use crate::motion::lanes::{LANES, Lanes, wide};
use crate::signal::Signals;
use crate::time::{Frame, Span};

pub use drawn::Drawn;
use run_lengths::Persistence;
pub use steady::Steady;

/// Share of the clip's largest filtered speed below which a change is rounding. Without it a Fourier filter makes turns
/// on joints that do not move.
const DUST: f64 = 1e-9;

/// The kind of a turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TurnKind {
    /// Key (原画): a movement starts or ends, or is slowest.
    Key,
    /// Wall (壁フレーム): the joint stops accelerating.
    Wall,
}

/// A key or wall of one joint.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Turn {
    /// The source frame, by its number in the file; never the clip's first or last.
    pub frame: Frame,
    /// Key or wall.
    pub kind: TurnKind,
    /// The largest persistence M, in frames, at which it is still confirmed; 0 if at none. A turn of
    /// the `event` reading that is confirmed as far as the clip reaches has the clip's length.
    pub confirmed_for: usize,
}

/// How the paper's rule for keys is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Reading {
    /// By whole valleys and hills of the speed, with the filter's delay undone: ends of movements
    /// (動き終わり) count as much as starts.
    #[default]
    Event,
    /// By the paper's words: the signs around one frame, and the M frames after it. Drops most ends of movements; for
    /// studies of Table 1.
    Literal,
}

choices!(Reading { Event: "event", Literal: "literal" });

/// The frames that confirm a candidate of the `literal` reading; `event` ignores this setting.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// The M frames after a key are all faster than it (a wall: slower): the words of [KT11 §3.3].
    #[default]
    After,
    /// The M frames after and the M frames before.
    Both,
    /// Each of the M steps after a key is faster than the last ([KT11 §4]: "consecutive frames in
    /// which the speed increases").
    Rising,
}

choices!(Side { After: "after", Both: "both", Rising: "rising" });

/// Finds the keys (原画) and walls (壁フレーム) of every joint in its filtered speed
/// [KT11 §3.3, §3.4].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TurnFinder {
    /// How the rule is read; `event` by default.
    pub reading: Reading,
    /// Largest acceleration that counts as a steady speed; 100 °/s² by default. Raised, slow starts and ends go, and
    /// gentle motion has no keys at all.
    pub steady: Steady,
    /// The paper's M: how long a turn must last, in source frames or seconds; 0.1 s by default, at least one frame.
    /// Raised, short pauses and quick back-and-forth movements go.
    pub persistence: Span,
    /// The frames that confirm a candidate of the `literal` reading; `after` by default.
    pub side: Side,
    /// How much of the clip is drawn: turns of the body are then found with a narrower filter and a shorter
    /// persistence. `auto` by default. Turns of single joints ignore it.
    pub drawn: Drawn,
}

impl Default for TurnFinder {
    fn default() -> Self {
        Self {
            reading: Reading::Event,
            steady: Steady::Acceleration(100.0),
            persistence: Span::Seconds(0.1),
            side: Side::After,
            drawn: Drawn::Auto,
        }
    }
}

knobs!(turns::TurnFinder {
    reading: knob(
        "読み方",
        "How turns are defined. event: the end and the start of every rest and slowing. literal: \
         the first paper word for word, which loses the ends of movements.",
        "動きの変わり目の定義。eventは、止まりや減速ごとに終わりと始まりを取る。\
         literalは第一論文の文言どおりで、動き終わりが失われる。",
    )
    .for_studies(),
    steady: knob(
        "定速とみなす加速度",
        "Largest acceleration of a joint that counts as steady speed. Higher values find fewer \
         turns of slow joints. Turns of the whole body ignore this setting.",
        "等速とみなす部位の加速度の上限。上げると、ゆっくりした部位の変わり目がなくなる。\
         全身の変わり目には効かない。",
    )
    .unit("°/s², or a share of the joint's own 95th percentile (\"5%\")")
    .for_studies(),
    persistence: knob(
        "連続フレーム数",
        "How long the body must be faster before and after a turn. As a rule, longer values find \
         fewer turns: short pauses and quick back-and-forth movements disappear.",
        "変わり目の前後で、体がより速い状態が続くべき長さ。長いほど変わり目は減り、\
         短い間や素早い往復は消える。",
    ),
    side: knob(
        "連続を見る側",
        "Frames that the literal reading checks for persistence: after the turn (after), on both \
         sides of it (both), or after it with every step faster than the last (rising).",
        "literalで連続を確かめる側。変わり目の後（after）、前後の両方（both）、\
         または後で毎フレーム速くなり続けること（rising）。",
    )
    .for_studies(),
    drawn: knob(
        "手付けの度合い",
        "How much of the motion was keyed by hand with straight inbetweens: from 0 for a capture, \
         whose speeds are smoothed, to 1 for hand-made keys, whose turns are sharp. auto measures \
         how sharp the turns are. Turns of joints ignore this setting.",
        "手付けで直線的に補間された動きの度合い。0はキャプチャーで、速さをならす。1は手付けで、\
         鋭い変わり目をそのまま使う。autoは変わり目の鋭さから決める。部位の変わり目には効かない。",
    )
    .at_most(1.0),
});

impl TurnFinder {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] named `turns.steady` or `turns.persistence`, if a value is not finite or below 0, or a share
    /// is above 100 %.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Finds the confirmed turns, one list a joint (a column), by frame.
    ///
    /// `delay` is [`LowPass::delay`](crate::signal::LowPass::delay) of the filter the signals went
    /// through, in frames; the `event` reading undoes it.
    ///
    /// ```
    /// use genga::signal::{LowPass, Spectrum, Speed, TurnFinder};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let filter = LowPass::default();
    /// let smooth = filter.apply(&Spectrum::new(&Speed::default().measure(&clip)?));
    /// let turns = TurnFinder::default().find(&smooth, filter.delay(clip.rate()));
    /// assert_eq!(turns.len(), clip.skeleton().len(), "a list a joint");
    /// assert_eq!(turns[0][0].frame.0, 12, "the first turn of the hips");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn find(&self, filtered: &Signals, delay: f64) -> Vec<Vec<Turn>> {
        self.confirmed(&self.candidates(filtered, delay), filtered)
    }

    /// Keeps those [`candidates`](Self::candidates) that M confirms: the result of [`find`](Self::find) without a new
    /// search.
    pub fn confirmed(&self, candidates: &[Vec<Turn>], filtered: &Signals) -> Vec<Vec<Turn>> {
        let persistence = self.persistence_frames(filtered);
        let is_confirmed = |turn: &&Turn| turn.confirmed_for >= persistence;
        let of_joint = |turns: &Vec<Turn>| turns.iter().filter(is_confirmed).copied().collect();
        candidates.iter().map(of_joint).collect()
    }

    /// Finds every turn, whatever M. `find` keeps those with `confirmed_for` of at least
    /// [`persistence_frames`](Self::persistence_frames), so that another M needs no new search.
    pub fn candidates(&self, filtered: &Signals, delay: f64) -> Vec<Vec<Turn>> {
        let frames = filtered.frames();
        if frames < 3 {
            return vec![vec![]; filtered.joints()];
        }
        let mut scan = Scan::new(self, filtered, delay);
        let joints = filtered.values.as_slice().chunks_exact(frames);
        let turns = |speeds| {
            wide(
                #[inline(always)]
                || scan.turns(speeds),
            )
        };
        joints.map(turns).collect()
    }

    /// Returns whether each step of some joints, from its row to the next, is steady (等速): no acceleration beyond the
    /// dead band. One list a joint, one step fewer than there are frames.
    pub fn steady_steps(&self, filtered: &Signals, joints: &[JointId]) -> Vec<Vec<bool>> {
        if filtered.frames() < 2 || joints.is_empty() {
            return vec![vec![]; joints.len()];
        }
        let mut scan = Scan::new(self, filtered, 0.0);
        let steps = |joint: &JointId| {
            scan.read_signs(filtered.joint(*joint));
            scan.signs.iter().map(|sign| sign.is_eq()).collect()
        };
        joints.iter().map(steps).collect()
    }

    /// Returns M in whole frames. In the `event` reading it is at most the clip's length, as frames beyond the clip do
    /// not count against a turn.
    pub fn persistence_frames(&self, filtered: &Signals) -> usize {
        let persistence = self.persistence.whole_frames(filtered.rate);
        match self.reading {
            Reading::Event => persistence.min(filtered.frames()),
            Reading::Literal => persistence,
        }
    }
}

/// Returns the largest size of a value, 0 if there is none. Lanes run side by side, as each size waits for the last.
fn largest(values: &[f64]) -> f64 {
    let (chunks, rest) = values.as_chunks::<LANES>();
    let size = |values: &[f64; LANES]| Lanes(*values).map(f64::abs);
    let most = chunks.iter().fold(Lanes::ZERO, |most, values| most.max(size(values)));
    most.0.iter().chain(rest).fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// A scan of one joint after another, with shared buffers. Rows count from 0 here.
struct Scan<'a> {
    finder: &'a TurnFinder,
    /// Frames a second.
    fps: f64,
    /// Factor from the signal's unit to the unit of an absolute `steady`.
    for_people: f64,
    /// Largest change that is rounding.
    floor: f64,
    /// The filter's delay in whole frames.
    delay: usize,
    first: Frame,
    frames: usize,
    /// For each step from its row to the next: slowing, steady or speeding.
    signs: Vec<Ordering>,
    persistence: Persistence,
    sizes: Vec<f64>,
}

impl<'a> Scan<'a> {
    fn new(finder: &'a TurnFinder, filtered: &Signals, delay: f64) -> Self {
        let frames = filtered.frames();
        Self {
            finder,
            fps: filtered.rate.fps(),
            for_people: filtered.unit.for_people(),
            floor: DUST * largest(filtered.values.as_slice()),
            delay: (delay.round().max(0.0) as usize).min(frames),
            first: filtered.first,
            frames,
            signs: Vec::with_capacity(frames),
            persistence: Persistence::new(),
            sizes: Vec::with_capacity(frames),
        }
    }

    #[inline(always)]
    fn turns(&mut self, speeds: &[f64]) -> Vec<Turn> {
        self.read_signs(speeds);
        let mut turns = vec![];
        match self.finder.reading {
            Reading::Event => {
                self.persistence.read(speeds, self.floor, Side::Both);
                event::turns(self, speeds, &mut turns);
            }
            Reading::Literal => {
                self.persistence.read(speeds, self.floor, self.finder.side);
                literal::turns(self, &mut turns);
            }
        }
        turns.sort_unstable_by_key(|turn| (turn.frame, turn.kind, usize::MAX - turn.confirmed_for));
        turns.dedup_by_key(|turn| (turn.frame, turn.kind));
        turns
    }

    #[inline(always)]
    fn read_signs(&mut self, speeds: &[f64]) {
        let band = self.finder.steady.step(speeds, self.fps, self.for_people, &mut self.sizes);
        let band = if band > self.floor { band } else { self.floor };
        // Both comparisons are always made, so that no step waits for a branch prediction.
        let sign = |(before, after): (&f64, &f64)| {
            let change = after - before;
            u8::from(change > band).cmp(&u8::from(change < -band))
        };
        self.signs.clear();
        self.signs.extend(speeds.iter().zip(&speeds[1..]).map(sign));
    }

    /// Returns a turn at a row, moved inside the clip's first and last frame.
    fn turn(&self, row: usize, kind: TurnKind, confirmed_for: usize) -> Turn {
        let row = row.clamp(1, self.frames - 2);
        Turn { frame: Frame(self.first.0 + row), kind, confirmed_for }
    }
}

#[cfg(test)]
mod tests;
