//! Finds where a take is split: in rests and lulls, and where other parts of the body take over.

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::keys::Chords;
use crate::keys::actions::changes::changes;
use crate::keys::actions::division::{Lengths, Place, cheapest};
use crate::keys::actions::lulls::lulls;
use crate::keys::actions::{Actions, Split, SplitReason};
use crate::keys::rest::rests;
use crate::knob::{Knobs, knob, knobs};
use crate::maths;
use crate::motion::Clip;
use crate::time::{Frame, Span};

/// Finds the actions (動作) of a take, which KKMFT §3 cuts by hand: of all divisions, the one with the clearest splits
/// and the most usual lengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ActionFinder {
    /// Whether a take is split at all. Default yes; otherwise it is one action however long.
    pub split: bool,
    /// Usual length of an action, in frames or seconds, above 0. Default 4.4 s, the mean of the clips of KKMFT Table 1.
    /// Raised, single movements join into one action.
    pub length: Span,
    /// Clarity that a split needs, 1 or more; default 4: the body is that many times slower than before and after, or
    /// at most half of its movement goes on in the same parts (a share of one by the root of 4). Less is enough if an
    /// action would be too long. Raised, movements with a short pause between them are one action.
    pub contrast: f64,
    /// Least length of an action, in frames or seconds. Default 1 s. A person's own splits may be closer. Raised, short
    /// movements join their neighbours.
    pub shortest: Span,
}

impl Default for ActionFinder {
    fn default() -> Self {
        Self {
            split: true,
            length: Span::Seconds(4.4),
            contrast: 4.0,
            shortest: Span::Seconds(1.0),
        }
    }
}

/// A place where a take may be split, with ln of how clear it is.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    split: Split,
    clear: f64,
}

knobs!(actions::ActionFinder {
    split: knob(
        "動作に分ける",
        "Whether a long take is split into actions. Left-out drawings are then counted per action.",
        "長いテイクを動作に分けるか。分けると、抜く枚数を動作ごとに数える。",
    ),
    length: knob(
        "動作の普通の長さ",
        "Usual length of an action; 4.4 s in the second paper. Longer values give fewer actions.",
        "一つの動作の普通の長さ（第二の論文では4.4秒）。長くすると動作の数が減る。",
    )
    .above(0.0),
    contrast: knob(
        "区切りの明瞭さ",
        "How clear a split must be: how many times slower the body is than before and after. At 4, \
         half of the movement passing to other parts is as clear. Less is enough where an action \
         would be too long.",
        "区切りに必要な明瞭さ。体が前後の何分の一まで遅くなるか。4のとき、\
         動きの半分がほかの部位へ移れば同じ明瞭さとみなす。動作が長すぎるときは、\
         もっと弱くても区切る。",
    )
    .unit("times")
    .at_least(1.0)
    .slider(1.0, 20.0),
    shortest: knob(
        "最短の動作",
        "Shortest length of an action. Longer values join short movements to their neighbours.",
        "動作の最短の長さ。長くすると短い動きは隣の動作に入る。",
    ),
});

impl ActionFinder {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Finds the actions of a clip: between a person's splits if there are any, otherwise between found ones.
    ///
    /// ```
    /// use genga::keys::{ActionFinder, Chords, Reference};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let reference = Reference::new(&clip, clip.clock(24.0));
    /// let own = vec![1.0; clip.skeleton().len()];
    /// let chords = Chords::new(&clip, &reference, &own, f64::INFINITY);
    /// let actions = ActionFinder::default().find(&clip, &chords, &[]);
    /// assert_eq!(actions.iter().count(), 1, "a kick is one action");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn find(&self, clip: &Clip, chords: &Chords, asked: &[Frame]) -> Actions {
        if !asked.is_empty() {
            let asked = asked.iter().map(|frame| Split { frame: *frame, why: SplitReason::Asked });
            return Actions::split(clip, asked.collect());
        }
        let splits = if self.split { self.found(clip, &candidates(chords)) } else { Vec::new() };
        Actions::split(clip, splits)
    }

    /// Finds the splits with which the take costs least.
    fn found(&self, clip: &Clip, candidates: &[Candidate]) -> Vec<Split> {
        let fps = clip.rate().fps();
        let place = |candidate: &Candidate| Place {
            at: (candidate.split.frame.0 - clip.first().0) as f64 / fps,
            price: maths::ln(self.contrast) - candidate.clear,
        };
        let places: Vec<Place> = candidates.iter().map(place).collect();
        let seconds = |span: Span| span.frames(clip.rate()) / fps;
        let lengths = Lengths { usual: seconds(self.length), shortest: seconds(self.shortest) };
        let chosen = cheapest(&places, clip.len() as f64 / fps, lengths);
        chosen.into_iter().map(|at| candidates[at].split).collect()
    }
}

/// Speed below which a body rests between two actions, in % of body height a second: slower than what a drawing holds.
const RESTS: f64 = 15.0;

/// Finds every place where a take may be split, by time.
fn candidates(chords: &Chords) -> Vec<Candidate> {
    let candidate = |instant, why, clear| {
        let split = Split { frame: chords.frame(instant), why };
        Candidate { split, clear }
    };
    let rests = rests(chords, RESTS);
    let lulls = lulls(chords, &rests).into_iter().map(|lull| {
        let why = if lull.is_rest { SplitReason::Rest } else { SplitReason::Lull };
        candidate(lull.instant, why, lull.depth)
    });
    let changes = changes(chords, &rests).into_iter();
    let changes = changes.map(|(instant, clear)| candidate(instant, SplitReason::Change, clear));
    let mut all: Vec<Candidate> = lulls.chain(changes).collect();
    all.sort_by_key(|candidate| candidate.split.frame);
    all
}
