//! Which candidates are keys of the layer: those that together save most for their price.

use std::iter::once;
use std::ops::RangeInclusive;

use serde::{Deserialize, Serialize};

use crate::edits::Edits;
use crate::error::Error;
use crate::keys::cheapest::Entry;
use crate::keys::choice::{By, Choice};
use crate::keys::correct::{corrected, moved};
use crate::keys::local::{Chosen, Word};
use crate::keys::voters::voters;
use crate::keys::walk::{Choosable, Walks};
use crate::keys::{
    Alike, AtContacts, AtGaits, AtRests, Candidates, Chords, JointTurns, JointWeights, Key,
    LayerKeys, Origin, Reference, Wall, rest,
};
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::{Clip, Gait};
use crate::signal::Turn;
use crate::time::{Frame, Span};

/// Where keys are as many a second and as cheap as these two, none is further from the next than so many seconds.
const MANY: f64 = 2.0;
const CHEAP: f64 = 10.0;
const FAR: f64 = 2.0;

/// How much cheaper a key is that is a turn through and through.
const DISCOUNT: f64 = 0.9;

/// What a key costs at the least, as a share of the price.
const LEAST_COST: f64 = 0.05;

/// What may be a key of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Merge {
    /// The turns of the body.
    #[default]
    Body,
    /// Every joint votes with the weight of what hangs on it; keys are the maxima of the vote.
    Vote,
    /// The joints' speeds are added first; keys are the valleys of the sum.
    Sum,
    /// A turn of any joint is a key [KT11 §3.3].
    Union,
}

choices!(Merge { Body: "body", Union: "union", Vote: "vote", Sum: "sum" });

/// Whether moments that are no turn may be keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fill {
    /// Where the body would go astray without them.
    #[default]
    On,
    /// Never: turns, rests and pins alone, the paper's picks and nothing else.
    Off,
}

choices!(Fill { On: "on", Off: "off" });

/// By what the keys are ranked.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Rank {
    /// By what they save: of all sets of keys the one that loses least, each key at a price.
    #[default]
    Price,
    /// By how strong it is.
    Strength,
}

choices!(Rank { Price: "price", Strength: "strength" });

/// Chooses the keys (原画) of a layer.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choose {
    /// What picks the keys. Default: the turns of the `body`.
    pub merge: Merge,
    /// Whether moments that are no turn may be keys, where the body would go astray without them (補い). Default `on`;
    /// `off` leaves turns, rests and pins alone. It counts with `body`.
    pub fill: Fill,
    /// How far a joint's vote carries, frames or seconds. Default 0.08 s. Raised, it joins turns that
    /// lie further apart into one key, and quick double actions become one.
    pub reach: Span,
    /// By what keys are ranked. Default: `price`.
    pub rank: Rank,
    /// What a key costs that is no turn, in % of body height: it must save an error so large for an eighth of a
    /// second; a turn through and through costs a tenth of that. 0 or more, default 7.5. Raised, small gestures lose
    /// their keys first. It counts when ranked by price.
    pub min_price: f64,
    /// The speed below which the whole body rests, in % of its height a second (the posture's: pelvis,
    /// heading, and root mean square over the other points); 0 or more, default 25, 0 for no rests.
    /// Both ends of a rest of half a second or more are keys whatever they save. Raised, slow gestures
    /// count as rests.
    pub rest: f64,
    /// What the begin and the end of a rest are: `keys` (default) whatever they save, or `off`, moments like all others.
    /// With `off` there may also be keys that look like the one before. A number of genga that is asked for is met so.
    pub at_rests: AtRests,
    /// What the steps of a gait (歩き・走り) have for genga: `steps` (default) the same phases, each for as long left and
    /// right, or `off`, what is worth a drawing. It counts with `body`, in a layer with both legs.
    pub gaits: AtGaits,
    /// What the begin and the end of a contact (接地) are, of a foot that comes down or leaves the ground and
    /// of a hand that stays somewhere: `off` (default) moments like all others, `candidates` also where no
    /// joint turns, `keys` whatever they save. With `keys` a walk has a key at every step, and more of them.
    pub contacts: AtContacts,
    /// The least strength of a key, 0 or more, default 0; with `body` how much of a turn it is, 0 to 1. Raised,
    /// moments that are hardly a turn are no keys.
    pub min_strength: f64,
    /// Found keys a second at the most; pins and the ends of rests, and of contacts
    /// where these are keys, come on top. Above 0, default 6,
    /// `inf` for no limit. Where more would be worth it the price is raised until they fit: lowered, it
    /// takes those that save least.
    pub per_second: f64,
    /// How much joints count beside what they weigh by their bones: in the votes, in the price and the
    /// pace of the body, and in its rests. Default: all the same. With 0 a joint's turns are no candidates.
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

/// What keys are judged by.
#[derive(Debug, Clone, Copy)]
pub struct Judges<'a> {
    /// The source koma after koma.
    pub reference: &'a Reference,
    /// What is lost from any instant to another.
    pub chords: &'a Chords,
    /// Which poses are one on the sheet.
    pub alike: &'a Alike,
}

/// What is drawn of a layer before a person moves keys.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Picks<'a> {
    /// The keys that are worth a drawing.
    pub(crate) chosen: &'a Chosen,
    pub(crate) walls: &'a [Wall],
    /// The gaits whose steps are to have the same phases.
    pub(crate) gaits: &'a [Gait],
}

knobs!(keys::Choose {
    merge: knob(
        "原画の候補",
        "What picks the keys: turns of the whole body (body). For studies: a turn of any joint \
         (union), what joints elect that vote with the length of what hangs on them, or turns of \
         their speeds added up (sum).",
        "原画を選ぶもの。全身の変わり目 (body)。研究用に、いずれかの部位の変わり目 \
         (union)、先につながる長さを票とする部位の投票 (vote)、速さの合計の変わり目 (sum)。",
    )
    .for_studies(),
    fill: knob(
        "補いの原画",
        "Whether moments that are no turn become keys where the body would go astray without them.",
        "変わり目でない瞬間も、ないと動きが崩れるところでは原画にするか。",
    ),
    reach: knob(
        "票の届く範囲",
        "How far a joint's vote carries: longer joins turns that lie further apart into one key. \
         With union it decides which of two turns nearer than a koma stays.",
        "部位の票が届く範囲。長いほど離れた変わり目が一枚の原画にまとまる。union \
         では、1コマより近い二つの変わり目のどちらを残すかを決める。",
    )
    .for_studies(),
    rank: knob(
        "原画の選び方",
        "What decides between keys: what they save together at a price a drawing, or how much of a \
         turn each is.",
        "原画どうしの選び方。一枚の値段に対して全体で減る誤差か、変わり目としての強さか。",
    )
    .for_studies(),
    min_price: knob(
        "最低の価値",
        "What a key costs that is no turn: it must save an error so large for an eighth of a \
         second. A clear turn costs a tenth. Higher keeps fewer; small gestures go first.",
        "変わり目でない原画一枚の値段。これだけの誤差を8分の1秒のあいだ減らすものだけが残る。\
         はっきりした変わり目は十分の一の値段。上げると原画は減り、小さな芝居から消える。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    rest: knob(
        "止めとみなす速さ",
        "Slower than this for half a second, the whole body rests: both ends of a rest are keys.",
        "全身がこれより遅い状態が半秒続けば止めとみなし、その両端を原画にする。",
    )
    .unit("% of body height a second")
    .slider(0.0, 60.0),
    at_rests: knob(
        "止めの両端を原画に",
        "What both ends of a rest are: keys whatever they save, or moments like all others (off).",
        "止めの両端をどう扱うか。必ず原画にする（keys）、特別扱いしない（off）。",
    ),
    gaits: knob(
        "歩きを揃える",
        "What the steps of a walk or a run have for genga: the same phases for as long, left and \
         right (steps), or what is worth a drawing (off).",
        "歩き・走りの一歩ごとの原画。左右とも同じ局面を同じコマ数で描く（steps）、\
         ほかと同じく価値で選ぶ（off）。",
    ),
    contacts: knob(
        "接地を原画に",
        "What the moments are at which a foot or a hand comes down or leaves: like all others \
         (off), candidates even where no joint turns, or keys whatever they save.",
        "足や手が着く瞬間と離れる瞬間をどう扱うか。特別扱いしない（off）、\
         部位が変わらなくても候補にする（candidates）、必ず原画にする（keys）。",
    ),
    min_strength: knob(
        "最低の強さ",
        "How strong a key must be at the least: for body how much of a turn it is, 0 to 1; for \
         vote and union the share of all votes; for sum the depth of the valley.",
        "原画に最低限必要な強さ。",
    )
    .unit("strength")
    .slider(0.0, 1.0)
    .for_studies(),
    per_second: knob(
        "毎秒の原画数",
        "That many found keys at the most; pins, ends of rests and contacts that are keys come on \
         top. Where more are worth it the price rises until they fit.",
        "見つける原画の毎秒の上限。固定した原画、止めの両端、原画にした接地は別に数える。\
         超えるときは収まるまで値段が上がる。",
    )
    .unit("keys a second")
    .above(0.0)
    .or_inf()
    .slider(0.1, 12.0),
    ..weights
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

    /// How far keys may be apart, in seconds, and still be weighed against all others: where there are
    /// many it is no use to know the loss of long chords.
    pub fn span(&self) -> f64 {
        let are_many = self.per_second >= MANY && self.min_price <= CHEAP;
        if are_many { FAR } else { f64::INFINITY }
    }

    /// The keys that are worth a drawing, with who voted for them; a person's pins among them.
    ///
    /// ```
    /// # use genga::edits::Edits;
    /// # use genga::keys::{Alike, BodyTurns, Choose, Chords, JointTurns, Judges, Reference, weights};
    /// # use genga::signal::{LowPass, Spectrum, Speed, TurnFinder};
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// # let (clock, filter, finder) = (clip.clock(24.0), LowPass::default(), TurnFinder::default());
    /// # let filtered = filter.apply(&Spectrum::of(&Speed::default().measure(&clip)?));
    /// # let delay = filter.delay(clip.rate());
    /// # let turns = finder.find(&filtered, delay);
    /// # let reference = Reference::of(&clip, clock);
    /// # let body = BodyTurns::of(&clip, &reference, &filter, &finder);
    /// # let own = vec![1.0; clip.skeleton().len()];
    /// # let joints = JointTurns {
    /// #     filtered: &filtered,
    /// #     turns: &turns,
    /// #     finder: &finder,
    /// #     delay,
    /// #     weights: &weights(&clip),
    /// #     apart: clock.frames_in_koma(),
    /// #     body: &body,
    /// #     contacts: &[],
    /// # };
    /// let keys = Choose::default();
    /// let chords = Chords::of(&clip, &reference, &own, keys.span());
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
            |keys: &[Key]| Chosen::of(keys, &self.choice(clip, judges, keys, apart).pick(chords));
        let corrected = may_be(edits);
        let chosen = if edits.again {
            pick(&corrected)
        } else {
            let free = may_be(&Edits::default());
            let before = match edits.frozen.as_slice() {
                [] => pick(&free),
                frames => self.frozen((clip, chords), frames, &free),
            };
            self.correct(
                (clip, chords),
                &before,
                &corrected,
                Word { edits, koma: apart, apart, alike: judges.alike },
            )
        };
        let heard = (joints.turns, joints.weights);
        let gaits = match self.walks() {
            true => Gait::find(clip, clip.clock(clip.rate().fps() / apart)),
            false => Vec::new(),
        };
        let picked = Picks { chosen: &chosen, walls: &candidates.walls, gaits: &gaits };
        self.drawn(still, picked, heard, ((clip.first(), clip.last()), edits, apart))
    }

    /// Whether the steps of gaits have the same phases.
    pub(crate) fn walks(&self) -> bool {
        self.gaits == AtGaits::Steps && self.merge == Merge::Body
    }

    /// All that may become keys: candidates, the ends of rests and of contacts, and pins.
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
            // There the body comes to rest or sets out, (−, 0) and (0, +): turns like others, that need not stay.
            let ends = keys.iter_mut().filter(|key| key.origin == Origin::Rest);
            ends.for_each(|end| end.origin = Origin::Turn);
        }
        keys
    }

    /// On what it hangs which of some keys are picked.
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

    /// The same between two frames that stay, with so many at the most.
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
        let cost = |key: &Key| match self.merge {
            Merge::Body => (1.0 - DISCOUNT * key.strength).max(LEAST_COST),
            Merge::Union | Merge::Vote | Merge::Sum => 1.0,
        };
        let inner = keys.iter().map(|key| entry(key.frame, !key.origin.is_found(), cost(key)));
        let first = once(entry(first, true, 1.0));
        let by = match self.rank {
            Rank::Price => By::Price(self.min_price),
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

    /// The keys that were chosen, moved where a person wants them, with their voters; in gaits the phases of steps.
    pub(crate) fn drawn(
        &self,
        (chords, rests): (&Chords, &[RangeInclusive<usize>]),
        Picks { chosen, walls, gaits }: Picks<'_>,
        (turns, weights): (&[Vec<Turn>], &[f64]),
        (ends, edits, apart): ((Frame, Frame), &Edits, f64),
    ) -> LayerKeys {
        let mut keys = chosen.keys.clone();
        let walks = Walks::of(gaits, Choosable { keys: &keys, edits, koma: apart, ends });
        walks.give(&mut keys, edits, apart);
        moved(&mut keys, edits, apart);
        walks.lay(&mut keys, apart);
        let reach = self.reach.frames(chords.clock().frame_rate).max(apart);
        let frames: Vec<Frame> = keys.iter().map(|key| key.frame).collect();
        let voters = voters(turns, weights, &frames, reach);
        keys.iter_mut().zip(voters).for_each(|(key, voters)| key.voters = voters);
        let over_limit = if edits.only_pins { 0 } else { chosen.over_limit };
        let rests = rest::rest_frames(chords, rests);
        let holds_end = self.at_rests == AtRests::Keys;
        let (walls, gaits) = (walls.to_vec(), walks.regular);
        LayerKeys { keys, walls, rests, holds_end, gaits, over_limit }
    }
}
