//! Chooses the keys of a layer: the candidates that together save most for their price.

use std::iter::once;
use std::ops::{Range, RangeInclusive};

use serde::{Deserialize, Serialize};

use crate::edits::Edits;
use crate::error::Error;
use crate::keys::cheapest::Entry;
use crate::keys::correct::{corrected, moved};
use crate::keys::local_corrections::{Chosen, Word};
use crate::keys::selection::{By, Choice};
use crate::keys::voters::voters;
use crate::keys::walk::{Drawable, Walks};
use crate::keys::{
    Alike, AtContacts, AtGaits, AtRests, Candidates, Chords, JointTurns, JointWeights, Key,
    LayerKeys, Origin, Reference, Wall, rest,
};
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::{Clip, Gait};
use crate::signal::Turn;
use crate::time::{Frame, Span};

/// With at least `MANY` keys a second and a price of at most `CHEAP`, neighbouring keys are at most `FAR` seconds
/// apart.
const MANY: f64 = 2.0;
const CHEAP: f64 = 10.0;
const FAR: f64 = 2.0;

/// Discount on a key that is fully a turn, as a share of the price.
const DISCOUNT: f64 = 0.9;

/// Least cost of a key, as a share of the price.
const LEAST_COST: f64 = 0.05;

/// Least share of the price that a passage's own price may be: a key without any price would stay however far the price
/// rises for the limit.
const LEAST_SHARE: f64 = 1e-6;

/// The source of a layer's key candidates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Merge {
    /// The turns of the body.
    #[default]
    Body,
    /// Every joint votes, weighted by its reach; keys are the maxima of the vote.
    Vote,
    /// A turn of any joint is a key [KT11 §3.3].
    Union,
}

choices!(Merge { Body: "body", Union: "union", Vote: "vote" });

/// Whether moments that are no turn may be keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fill {
    /// Allowed where the body would go astray without them.
    #[default]
    On,
    /// Not allowed: only turns, rests and pins, as in the paper.
    Off,
}

choices!(Fill { On: "on", Off: "off" });

/// How keys are ranked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rank {
    /// By what they save: the set of keys that loses least, each key at a price.
    #[default]
    Price,
    /// By their strength.
    Strength,
}

choices!(Rank { Price: "price", Strength: "strength" });

/// Chooses the keys (原画) of a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choose {
    /// Source of the key candidates. Default: the turns of the `body`.
    pub merge: Merge,
    /// Whether moments that are no turn may be keys, where the body would go astray without them (補い). Default `on`;
    /// `off` leaves only turns, rests and pins. Used with `body`.
    pub fill: Fill,
    /// Reach of a joint's vote, in frames or seconds. Default 0.08 s. Raised, it joins turns that lie further apart
    /// into one key, and quick double actions become one.
    pub reach: Span,
    /// How keys are ranked. Default: `price`.
    pub rank: Rank,
    /// Price of a key that is no turn, in % of body height: the key must save an error of that size for an eighth of a
    /// second. A full turn costs a tenth of that. 0 or more, default 7.5. Raised, small gestures lose their keys first.
    /// Used if ranked by price.
    pub min_price: f64,
    /// Prices that hold in ranges of source frames in place of `min_price`, the later over the earlier. Default: none. A
    /// recipe has them in its passages, and [`Recipe::of_layer`](crate::recipe::Recipe::of_layer) puts them here.
    #[serde(skip)]
    pub prices_within: Vec<(Range<Frame>, f64)>,
    /// Speed below which the whole body rests, in % of body height a second (the posture's speed: pelvis, heading, and
    /// root mean square over the other points). 0 or more, default 25; 0 for no rests. Both ends of a rest of half a
    /// second or more are keys whatever they save. Raised, slow gestures count as rests.
    pub rest: f64,
    /// How the begin and the end of a rest are treated: as `keys` (default) whatever they save, or `off`, as moments
    /// like all others. With `off` a key may also look like the one before, so a requested number of genga can be met.
    pub at_rests: AtRests,
    /// How the genga of a gait (歩き・走り) are chosen: `steps` (default), the same phases for the same time left and right,
    /// or `off`, by what is worth a drawing. Used with `body`, in a layer with both legs.
    pub gaits: AtGaits,
    /// How the begin and the end of a contact (接地) are treated. A contact is a foot on the ground or a hand that stays
    /// in place. `off` (default): as moments like all others; `candidates`: also where no joint turns; `keys`: whatever
    /// they save. With `keys` a walk has a key at every step, and more keys in all.
    pub contacts: AtContacts,
    /// Least strength of a key, 0 or more, default 0; with `body` the strength of its turn, 0 to 1. Raised, moments
    /// that are hardly a turn are no keys.
    pub min_strength: f64,
    /// Most found keys a second. Pins, ends of rests, and ends of contacts if these are keys come on top. Above 0,
    /// default 6, `inf` for no limit. If more would be worth it, the price is raised until they fit. Lowered, the keys
    /// that save least go first.
    pub per_second: f64,
    /// Weights of joints on top of their bones, used in the votes, the price and pace of the body, and its rests.
    /// Default: 1 for every joint. With 0 a joint's turns are no candidates.
    #[serde(skip_serializing_if = "JointWeights::is_empty")]
    pub weights: JointWeights,
}

impl Default for Choose {
    fn default() -> Self {
        Self {
            merge: Merge::Body,
            fill: Fill::On,
            reach: Span::Seconds(0.08),
            rank: Rank::Price,
            min_price: 7.5,
            prices_within: Vec::new(),
            rest: 25.0,
            at_rests: AtRests::default(),
            gaits: AtGaits::default(),
            contacts: AtContacts::default(),
            min_strength: 0.0,
            per_second: 6.0,
            weights: JointWeights::default(),
        }
    }
}

/// The data that keys are judged by.
#[derive(Debug, Clone, Copy)]
pub struct Judges<'a> {
    /// The source motion at every koma.
    pub reference: &'a Reference,
    /// The loss between any two instants.
    pub chords: &'a Chords,
    /// Which poses count as one on the sheet.
    pub alike: &'a Alike,
}

/// The drawn keys, walls and gaits of a layer before a person moves keys.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Picks<'a> {
    /// The keys that are worth a drawing before a person's corrections.
    pub(crate) found: &'a Chosen,
    /// The keys after them.
    pub(crate) chosen: &'a Chosen,
    pub(crate) walls: &'a [Wall],
    /// The gaits whose steps are to have the same phases.
    pub(crate) gaits: &'a [Gait],
}

knobs!(keys::Choose {
    merge: knob(
        "原画の候補",
        "Source of the key candidates. body: turns of the whole body. For studies, union: a turn \
         of any joint; vote: the maxima of a vote of all joints, weighted by the length of the \
         bones below them.",
        "原画の候補。bodyは全身の変わり目。研究用に、unionはいずれかの部位の変わり目、\
         voteは先につながる骨の長さで重み付けした部位の投票の極大。",
    )
    .for_studies(),
    fill: knob(
        "補いの原画",
        "Whether moments that are not turns become keys where the body would stray from the source \
         without them.",
        "変わり目でない瞬間も、ないと動きが崩れるところでは原画にするか。",
    ),
    reach: knob(
        "票の届く範囲",
        "How far in time a joint's vote counts. Longer values join more distant turns into one \
         key. With union, it decides which of two turns closer than a koma stays.",
        "部位の票が届く時間の範囲。長いほど離れた変わり目が一枚の原画にまとまる。unionでは、\
         1コマより近い二つの変わり目のどちらを残すかを決める。",
    )
    .for_studies(),
    rank: knob(
        "原画の選び方",
        "How keys are ranked. price: by the error that the set of keys saves, at a price per \
         drawing. strength: by the strength of each turn.",
        "原画の選び方。priceは一枚の値段に対して全体で減る誤差、\
         strengthは変わり目としての強さで選ぶ。",
    )
    .for_studies(),
    min_price: knob(
        "最低の価値",
        "Price of a key that is not a turn: it must save an error of this size for an eighth of a \
         second. A clear turn costs a tenth. Higher values keep fewer keys; small gestures go \
         first.",
        "変わり目でない原画一枚の値段。この大きさの誤差を8分の1秒のあいだ減らすものだけが残る。\
         はっきりした変わり目は十分の一の値段。上げると原画は減り、小さな芝居から消える。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    rest: knob(
        "止めとみなす速さ",
        "Speed below which the whole body rests, if it lasts half a second. Both ends of a rest \
         are keys.",
        "全身がこれより遅い状態が半秒続けば止めとみなし、その両端を原画にする。",
    )
    .unit("% of body height a second")
    .slider(0.0, 60.0),
    at_rests: knob(
        "止めの両端を原画に",
        "How both ends of a rest are treated: always as keys (keys), or like all other moments \
         (off).",
        "止めの両端の扱い。必ず原画にする（keys）、特別扱いしない（off）。",
    ),
    gaits: knob(
        "歩きを揃える",
        "How the genga of a walk or run are chosen. steps: the same phases for the same time, left \
         and right. off: like all others, by the error they save.",
        "歩き・走りの一歩ごとの原画。左右とも同じ局面を同じコマ数で描く（steps）、\
         ほかと同じく減る誤差で選ぶ（off）。",
    ),
    contacts: knob(
        "接地を原画に",
        "How the moments are treated when a foot or a hand comes down or leaves: like all others \
         (off), as candidates even if no joint turns (candidates), or always as keys (keys).",
        "足や手が着く瞬間と離れる瞬間の扱い。特別扱いしない（off）、\
         部位が変わらなくても候補にする（candidates）、必ず原画にする（keys）。",
    ),
    min_strength: knob(
        "最低の強さ",
        "Least strength of a key: for body the strength of its turn, 0 to 1; for vote and union \
         the share of all votes.",
        "原画に最低限必要な強さ。bodyでは変わり目の強さ（0〜1）、voteとunionでは全票に占める割合。",
    )
    .unit("strength")
    .slider(0.0, 1.0)
    .for_studies(),
    per_second: knob(
        "毎秒の原画数",
        "Most keys found per second. Pins, ends of rests, and contacts that are keys are not \
         counted. If more are worth it, the price rises until they fit.",
        "見つける原画の毎秒の上限。固定した原画、止めの両端、原画にした接地は別に数える。\
         超えるときは収まるまで値段が上がる。",
    )
    .unit("keys a second")
    .above(0.0)
    .or_inf()
    .slider(0.1, 12.0),
    ..prices_within, weights
});

impl Choose {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.weights.validate()
    }

    /// Returns the longest chord that must be weighed, in seconds. With many keys a second, longer chords are never
    /// chosen; otherwise it is infinite.
    pub fn span(&self) -> f64 {
        let are_many = self.per_second >= MANY && self.highest_price() <= CHEAP;
        if are_many { FAR } else { f64::INFINITY }
    }

    /// Returns the price of a key on a frame, in % of body height.
    fn price_at(&self, frame: Frame) -> f64 {
        let within = self.prices_within.iter().rfind(|(frames, _)| frames.contains(&frame));
        within.map_or(self.min_price, |(_, price)| *price)
    }

    /// Returns the highest price of any frame.
    fn highest_price(&self) -> f64 {
        self.prices_within.iter().map(|(_, price)| *price).fold(self.min_price, f64::max)
    }

    /// Chooses the keys that are worth a drawing, with their voters; a person's pins are included.
    ///
    /// ```
    /// # use genga::edits::Edits;
    /// # use genga::keys::{Alike, BodyTurns, Choose, Chords, JointTurns, Judges, Reference, weights};
    /// # use genga::signal::{LowPass, Spectrum, Speed, TurnFinder};
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// # let (clock, filter, finder) = (clip.clock(24.0), LowPass::default(), TurnFinder::default());
    /// # let filtered = filter.apply(&Spectrum::new(&Speed::default().measure(&clip)?));
    /// # let delay = filter.delay(clip.rate());
    /// # let turns = finder.find(&filtered, delay);
    /// # let reference = Reference::new(&clip, clock);
    /// # let body = BodyTurns::new(&clip, &reference, &filter, &finder);
    /// # let own = vec![1.0; clip.skeleton().len()];
    /// # let joints = JointTurns {
    /// #     filtered: &filtered,
    /// #     turns: &turns,
    /// #     weights: &weights(&clip),
    /// #     apart: clock.frames_in_koma(),
    /// #     body: &body,
    /// #     contacts: &[],
    /// # };
    /// let keys = Choose::default();
    /// let chords = Chords::new(&clip, &reference, &own, keys.span());
    /// let judges = Judges { reference: &reference, chords: &chords, alike: &Alike::default() };
    /// let candidates = keys.candidates(&joints);
    /// let chosen = keys.choose(&clip, judges, &candidates, &joints, &Edits::default());
    /// assert_eq!((candidates.keys.len(), chosen.keys.len()), (90, 13));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn choose(
        &self,
        clip: &Clip,
        judges: Judges<'_>,
        candidates: &Candidates,
        joints: &JointTurns<'_>,
        edits: &Edits,
    ) -> LayerKeys {
        let rests = rest::rests(judges.chords, self.rest);
        let (chords, apart) = (judges.chords, joints.apart);
        let still = (chords, &rests[..]);
        let may_be =
            |edits| self.eligible(clip, still, candidates, joints.contacts, (edits, apart));
        let pick =
            |keys: &[Key]| Chosen::new(keys, &self.choice(clip, judges, keys, apart).pick(chords));
        let corrected = may_be(edits);
        let free = may_be(&Edits::default());
        let found = match edits.frozen.as_slice() {
            [] => pick(&free),
            frames => self.frozen((clip, chords), judges.alike, frames, &free),
        };
        let chosen = if edits.again {
            pick(&corrected)
        } else {
            self.correct(
                (clip, chords),
                &found,
                &corrected,
                Word { edits, koma: apart, apart, alike: judges.alike },
            )
        };
        let heard = (joints.turns, joints.weights);
        let gaits = match self.walks() {
            true => Gait::find(clip, clip.clock(clip.rate().fps() / apart)),
            false => Vec::new(),
        };
        let walls = &candidates.walls;
        let picked = Picks { found: &found, chosen: &chosen, walls, gaits: &gaits };
        self.drawn(still, picked, heard, ((clip.first(), clip.last()), edits, apart))
    }

    /// Whether the steps of a gait get the same phases.
    pub(crate) fn walks(&self) -> bool {
        self.gaits == AtGaits::Steps && self.merge == Merge::Body
    }

    /// Returns all moments that may become keys: candidates, ends of rests and contacts, and pins.
    pub(crate) fn eligible(
        &self,
        clip: &Clip,
        (chords, rests): (&Chords, &[RangeInclusive<usize>]),
        candidates: &Candidates,
        contacts: &[Frame],
        (edits, apart): (&Edits, f64),
    ) -> Vec<Key> {
        let rests = rest::rest_ends(chords, rests);
        let contacts = if self.contacts == AtContacts::Keys { contacts } else { &[] };
        let mut keys = corrected(candidates, (&rests, contacts), edits, clip, apart);
        if self.at_rests == AtRests::Off {
            // The body comes to rest or sets out here, (−, 0) and (0, +): turns like any other, which may be left out.
            let ends = keys.iter_mut().filter(|key| key.origin == Origin::Rest);
            ends.for_each(|end| end.origin = Origin::Turn);
        }
        keys
    }

    /// Builds the choice among some keys: its entries and its rules.
    pub(crate) fn choice(
        &self,
        clip: &Clip,
        judges: Judges<'_>,
        keys: &[Key],
        apart: f64,
    ) -> Choice {
        let Judges { reference, chords, alike } = judges;
        let most = (self.per_second * reference.seconds() + 1e-9).floor() as usize;
        self.choice_among((chords, alike), (clip.first(), clip.last()), keys, (apart, most))
    }

    /// Builds a [`choice`](Self::choice) between two frames that stay, with at most `most` found keys.
    pub(super) fn choice_among(
        &self,
        (chords, alike): (&Chords, &Alike),
        (first, last): (Frame, Frame),
        keys: &[Key],
        (apart, most): (f64, usize),
    ) -> Choice {
        let entry = |frame, stays, cost| {
            let koma = chords.koma_of(frame);
            let holds = match self.at_rests {
                AtRests::Keys => alike.last(koma),
                AtRests::Off => koma,
            };
            Entry { frame, koma, stays, cost, holds }
        };
        let price = if self.min_price > 0.0 { self.min_price } else { self.highest_price() };
        let share = |frame| match price {
            0.0 => 1.0,
            _ => (self.price_at(frame) / price).powi(2).max(LEAST_SHARE),
        };
        let cost = |key: &Key| match self.merge {
            Merge::Body => share(key.frame) * (1.0 - DISCOUNT * key.strength).max(LEAST_COST),
            Merge::Union | Merge::Vote => share(key.frame),
        };
        let inner = keys.iter().map(|key| entry(key.frame, !key.origin.is_found(), cost(key)));
        let first = once(entry(first, true, 1.0));
        let by = match self.rank {
            Rank::Price => By::Price(price),
            Rank::Strength => {
                let inner = keys.iter().map(|key| key.strength);
                By::Strength(once(0.0).chain(inner).chain([0.0]).collect())
            }
        };
        Choice {
            entries: first.chain(inner).chain([entry(last, true, 1.0)]).collect(),
            apart,
            most,
            by,
        }
    }

    /// Returns the chosen keys, moved to where a person wants them, with their voters. Gaits get the phases of their
    /// steps.
    pub(crate) fn drawn(
        &self,
        (chords, rests): (&Chords, &[RangeInclusive<usize>]),
        Picks { found, chosen, walls, gaits }: Picks<'_>,
        (turns, weights): (&[Vec<Turn>], &[f64]),
        (ends, edits, apart): ((Frame, Frame), &Edits, f64),
    ) -> LayerKeys {
        let walks =
            |edits| Walks::new(gaits, Drawable { found: &found.keys, edits, koma: apart, ends });
        let mut without_corrections = found.keys.clone();
        let bare = Edits { frozen: edits.frozen.clone(), ..Edits::default() };
        walks(&bare).lay(&mut without_corrections, &found.keys, &bare, apart);
        let walks = walks(edits);
        let mut keys = chosen.keys.clone();
        walks.give(&mut keys, edits, apart);
        moved(&mut keys, edits, apart);
        walks.lay(&mut keys, &found.keys, edits, apart);
        let reach = self.reach.frames(chords.clock().frame_rate).max(apart);
        let frames: Vec<Frame> = keys.iter().map(|key| key.frame).collect();
        let voters = voters(turns, weights, &frames, reach);
        keys.iter_mut().zip(voters).for_each(|(key, voters)| key.voters = voters);
        let over_limit = if edits.only_pins { 0 } else { chosen.over_limit };
        let rests = rest::rest_frames(chords, rests);
        let holds_end = self.at_rests == AtRests::Keys;
        let (walls, gaits) = (walls.to_vec(), walks.into_regular());
        LayerKeys { keys, without_corrections, walls, rests, holds_end, gaits, over_limit }
    }
}
