//! Spacing (詰め): inbetweens between keys, even in time, crowded towards the keys in what they show
//! [KT11 §3.4].

mod interval;
mod row;
mod station;
mod steps;
mod still;

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use self::interval::Interval;
use self::row::Rules;
use self::station::{Station, koma_before, stations};
use self::steps::Steps;
use self::still::Still;
pub(crate) use self::still::alike;
use crate::error::Error;
use crate::keys::LayerKeys;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::Skeleton;
use crate::sheet::{Exposure, Layer, Reason, Role};
use crate::time::{Clock, Frame};
use crate::timing::on::{On, Pace, STAY};

/// What an inbetween shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum InbetweenSource {
    /// The source at the inbetween's place: the performer's own arc.
    #[default]
    Sample,
    /// A slerp of the two key poses alone, as an inbetweener would draw it.
    Blend,
}

choices!(InbetweenSource { Sample: "sample", Blend: "blend" });

/// Puts inbetweens (中割り) between keys.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Spacing {
    /// For how many koma a drawing stays, 1 or more, or the fewest and the most: each drawing then stays for as many as
    /// `step` lets it. Default `2-3`, on twos and threes (2〜3コマ打ち); `1-3` has ones where the body is fast. Raised, fast arcs turn into straight jumps.
    pub on: On,
    /// Where `on` is a range: how far the body may go while a drawing stays, in % of its height (root mean square over its
    /// bones); above 0, default 9. Raised, more of the motion is on threes.
    pub step: f64,
    /// How unlike a drawing the body may get before another is drawn, in % of its height (root mean square over its bones,
    /// or 0.4 of the way of what goes furthest); 0 or more, default 3.3. Up to there a genga holds (止め). In a take
    /// whose poses are all nearer to each other than eight times as much, it is an eighth of that, 0.8 at the least. 0 holds
    /// nothing. Raised, small gestures are lost in holds.
    pub drift: f64,
    /// A fixed number of inbetweens between two keys instead; default none. An interval too short for
    /// them takes as many as fit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inbetweens: Option<usize>,
    /// How far inbetweens are drawn towards their key, 0 ≤ w < 1, default 0.3; 0 is even spacing
    /// (均等割り). A key may have a weight of its own. Raised, the middle of a movement becomes a jump.
    pub weight: f64,
    /// How far a place may move from its own koma, in koma; 0 or more, default 2. Raised, the jump over
    /// the middle grows with the distance of the keys.
    pub max_shift: f64,
    /// What an inbetween shows. Default: `sample`.
    pub source: InbetweenSource,
}

impl Default for Spacing {
    fn default() -> Self {
        Self {
            on: On { least: 2, most: 3 },
            step: 9.0,
            drift: 3.3,
            inbetweens: None,
            weight: 0.3,
            max_shift: 2.0,
            source: InbetweenSource::Sample,
        }
    }
}

/// A layer on the sheet, before anything is left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Spaced {
    /// Drawings and exposures, one exposure a drawing.
    pub layer: Layer,
    /// Inbetweens asked for that did not fit between their keys.
    pub did_not_fit: usize,
    /// Koma from the first contact to the last of gaits (歩き), in which every step has the same drawings.
    pub gaits: Vec<Range<usize>>,
}

/// What a hand asks for that pulls an inbetween towards a key or away from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The key on whose side the inbetween stands.
    pub key: Frame,
    /// The spacing weight of that key with which the inbetween is where the hand is; 0 to 0.95.
    pub weight: f64,
}

knobs!(spacing::Spacing {
    on: knob(
        "何コマ打ち",
        "For how many koma a drawing stays: 1 is on ones, 2 on twos, 3 on threes. 2-3 chooses for \
         each drawing: fast on twos, slow on threes (打ち分け); 1-3 has ones too.",
        "一枚を何コマ見せるか。1は1コマ打ち、2は2コマ打ち、3は3コマ打ち。2-3 \
         は一枚ごとに選び、速いところは2コマ、遅いところは3コマ（打ち分け）。1-3は1コマも使う。",
    )
    .unit("koma, 1 (ones) to 1000, or the fewest and the most (\"2-3\")"),
    step: knob(
        "一枚で動く量",
        "Where spacing.on is a range: how far the body may go while a drawing stays. More puts more \
         of the motion on threes.",
        "spacing.on が範囲のとき、一枚を見せるあいだに体が動いてよい量。大きいほど3コマ打ちが増える。",
    )
    .unit("% of body height")
    .above(0.0)
    .slider(0.1, 50.0),
    drift: knob(
        "止めのずれ",
        "How unlike a drawing the body may get before another is drawn: up to there a genga holds. 0 \
         holds nothing. More loses small gestures.",
        "体が今の絵からどこまで離れるまで、原画を止めておくか。\
         0なら何も止めない。大きいほど小さな芝居が消える。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    inbetweens: knob(
        "中割り枚数",
        "A fixed number of inbetweens between two keys instead.",
        "コマ打ちの代わりに、原画のあいだの中割りを決まった枚数にする。",
    )
    .unit("drawings")
    .at_most(1000.0)
    .slider(0.0, 12.0),
    weight: knob(
        "詰めの重み",
        "How far inbetweens crowd towards their key (spacing, 詰め). More makes the middle of a \
         movement snap.",
        "中割りを近い原画にどれだけ寄せるか（詰め）。大きいほど動きの真ん中が飛び、\
         メリハリが出る。",
    )
    .unit("weight (0 is even)")
    .below(1.0)
    .slider(0.0, 0.95),
    max_shift: knob(
        "詰めの上限",
        "How far an inbetween may be taken from its own time.",
        "中割りを本来の時刻からどれだけずらしてよいか。",
    )
    .unit("koma")
    .slider(0.0, 6.0),
    source: knob(
        "中割りの元",
        "What an inbetween shows: the performer's own arc, or a blend of the two keys alone.",
        "中割りに何を描くか。演者の実際の軌道 (sample) か、前後の原画だけを混ぜたもの (blend) か。",
    ),
});

impl Spacing {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first knob that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Places the keys of a layer and the inbetweens between them on a sheet of `koma` koma.
    ///
    /// The first and the last koma show an `end`; a key that falls on one gives way to it and hands over its
    /// voters. Of keys that stand too near for a drawing to stay, the dearer stays. A genga holds until the body has gone
    /// further from it than `drift`, and what would show it again is not drawn; a body that never moves has one drawing.
    /// Where `on` is a range the pace decides. In a gait every step has the same drawings for as long.
    ///
    /// ```
    /// # use genga::{edits::Edits, keys::Reference, pipeline::Engine, recipe::Recipe};
    /// use genga::timing::{On, Pace, Spacing};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// # let (clock, koma) = (clip.clock(24.0), clip.len());
    /// # let mut engine = Engine::new(clip.clone())?;
    /// # let (recipe, edits) = (Recipe::default(), Edits::default());
    /// let keys = engine.find_keys(&recipe, &edits)?.keys;
    /// let reference = Reference::of(&clip, clock);
    /// let on_threes = Spacing { on: On::every(3), ..Spacing::default() };
    /// let spaced = on_threes.place(keys, clip.skeleton(), clock, koma, &Pace::of(&reference));
    /// assert_eq!((spaced.layer.length(), spaced.layer.drawings.len()), (92, 22));
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn place(
        &self,
        layer: &LayerKeys,
        skeleton: &Skeleton,
        clock: Clock,
        koma: usize,
        pace: &Pace<'_>,
    ) -> Spaced {
        let still = Still::of(&layer.rests, clock, self.drift, pace);
        let least = |koma: usize| self.least(koma, pace);
        let steps = Steps::of(&layer.gaits, koma, self, pace);
        let stations = stations(&layer.keys, &steps, (clock, koma), least);
        let names: Vec<Arc<str>> =
            skeleton.joints.iter().map(|joint| joint.name.as_str().into()).collect();
        let (walls, holds_end) = (&layer.walls[..], layer.holds_end);
        let rules = Rules { spacing: self, clock, walls, holds_end, pace, still, steps };
        rules.lay_out(&stations, koma, &names)
    }

    /// The weight of a key that takes the inbetween of a koma to a place, or as near as `max_shift` lets it.
    ///
    /// `spaced` is the layer before anything was left out, and `koma` counts on it. None where no inbetween can
    /// stand, in the very middle of its interval, and on the side of an end of the clip that is no key.
    pub fn pulled(
        &self,
        layer: &LayerKeys,
        spaced: &Layer,
        clock: Clock,
        koma: usize,
        place: f64,
    ) -> Option<Pull> {
        let shown = |(begin, shown): (usize, Exposure)| {
            (begin, shown.koma, &spaced.drawings[shown.drawing])
        };
        let all: Vec<_> = spaced.timed().map(shown).collect();
        let own = all.partition_point(|(begin, ..)| *begin <= koma).checked_sub(1)?;
        let kept = |at: &usize| all[*at].2.role.is_kept();
        let [from, to] = [(0..own).rev().find(kept)?, (own..all.len()).find(kept)?];
        if to == own {
            return None;
        }
        let station = |at: usize| {
            let (koma, _, drawing) = all[at];
            let place = drawing.source.place();
            let key = layer.keys.iter().find(|key| key.frame.0 as f64 == place);
            // One at which the body arrived before is timed by its own frame.
            let own = match drawing.role {
                _ if drawing.why.reason == Some(Reason::Step) => koma,
                Role::Genga => koma_before(clock, place),
                Role::End if at > 0 => (koma_before(clock, place) + 1).saturating_sub(STAY),
                Role::End | Role::Inbetween => koma,
            };
            Station { koma: koma.max(own), place, role: drawing.role, key }
        };
        let [from, to] = [from, to].map(station);
        let interval = Interval::new(self, &from, &to, &layer.walls, clock);
        let (side, weight) = interval.weight_at(koma, all[own].1, place)?;
        let key = [from, to][side].key?;
        Some(Pull { key: key.frame, weight })
    }

    /// Which frames are worth a found key on a sheet of so many koma: not those on which it would give way to the
    /// drawing of the sheet's end, and not those within a rest that show nothing new.
    pub(crate) fn room<'a>(
        &self,
        rests: &[RangeInclusive<Frame>],
        clock: Clock,
        koma: usize,
        pace: &'a Pace<'a>,
    ) -> impl Fn(Frame) -> bool + use<'a> {
        let still = Still::of(rests, clock, self.drift, pace);
        let stay = self.on.stay();
        // Koma on which one would stand too near to the end.
        let past = if stay > 1 { (koma + 1).saturating_sub(2 * stay) } else { koma };
        move |frame| {
            let place = frame.0 as f64;
            place < clock.place_from_koma(past) && !still.covers(clock.koma_from_place(place))
        }
    }

    /// For how many koma the drawing of a koma stays.
    fn stay(&self, koma: usize, pace: &Pace<'_>) -> usize {
        self.on.from(koma, pace, self.step)
    }

    /// The same at the least.
    fn least(&self, koma: usize, pace: &Pace<'_>) -> usize {
        self.stay(koma, pace).min(STAY)
    }

    /// The koma of so many inbetweens between two koma, or of as many as fit.
    fn evenly(&self, asked: usize, koma: Range<usize>, pace: &Pace<'_>) -> Vec<usize> {
        let least = koma.clone().map(|koma| self.least(koma, pace)).max().unwrap_or(STAY);
        let count = asked.min((koma.len() / least).saturating_sub(1));
        let place = |at: usize| (at * koma.len()) as f64 / (count + 1) as f64;
        (1..=count).map(|at| koma.start + place(at).round() as usize).collect()
    }
}

#[cfg(test)]
mod tests;
