//! Where a take is split: in rests and lulls, and where other parts of the body take over.

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

/// Finds the actions (動作) of a take, which KKMFT §3 cuts by hand: of all ways to split it the one with
/// the clearest splits and the most usual lengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ActionFinder {
    /// Whether a take is split at all. Default yes; without it, it is one action however long.
    pub split: bool,
    /// How long an action usually is, frames or seconds, above 0. Default 4.4 s, the mean of the clips
    /// of KKMFT Table 1. Raised, single movements go together into one action.
    pub length: Span,
    /// How clear a split has to be, 1 or more; default 4: the body is so many times slower than before and
    /// after, or no more than half of its movement goes on in the same parts of it (a share of one by the
    /// root of 4). Less will do where an action would be too long. Raised, movements with a short pause
    /// between them are one action.
    pub contrast: f64,
    /// How short an action may be, frames or seconds. Default 1 s. A person's own splits may stand
    /// closer. Raised, short movements go with those beside them.
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
        "Whether a long take is split into actions: what is left out is then counted in each of \
         them.",
        "長いテイクを動作に分けるか。抜く枚数は動作ごとに数える。",
    ),
    length: knob(
        "動作の普通の長さ",
        "How long an action usually is: 4.4 s in the second paper. Longer makes fewer actions.",
        "一つの動作の普通の長さ（第二の論文では4.4秒）。長くすると動作の数が減る。",
    )
    .above(0.0),
    contrast: knob(
        "区切りの明瞭さ",
        "How clear a split has to be: the body so many times slower than before and after (4: or \
         half of the movement goes over to other parts). Less will do where an action would be too \
         long.",
        "区切りがどれほどはっきりしていればよいか。前後の何分の一まで遅くなるか（4）、\
         または動きの半分がほかの部位へ移るか。動作が長すぎるときは、もっと弱くても区切る。",
    )
    .unit("times")
    .at_least(1.0)
    .slider(1.0, 20.0),
    shortest: knob(
        "最短の動作",
        "How short an action may be. Longer joins short movements with those beside them.",
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

    /// The actions of a clip: between a person's splits where there are any, else between those that are
    /// found.
    ///
    /// ```
    /// use genga::keys::{ActionFinder, Chords, Reference};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let reference = Reference::of(&clip, clip.clock(24.0));
    /// let own = vec![1.0; clip.skeleton().len()];
    /// let chords = Chords::of(&clip, &reference, &own, f64::INFINITY);
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

    /// The splits with which the take costs least.
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

/// The speed below which a body rests between two actions, in % of its height a second: slower than what a drawing holds.
const RESTS: f64 = 15.0;

/// Every place where a take may be split, by time.
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
