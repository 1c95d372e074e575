//! Spacing (詰め): inbetweens between keys, evenly spaced in time and showing poses crowded towards the keys [KT11 §3.4].

mod interval;
mod outside;
mod row;
mod station;
mod steps;
mod still;
mod timed;

use std::ops::{Range, RangeInclusive};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use self::interval::Interval;
use self::row::Rules;
use self::station::{Station, koma_before, stations};
use self::steps::Steps;
use self::still::Still;
pub(crate) use self::still::alike;
use self::timed::Timed;
use crate::error::Error;
use crate::keys::LayerKeys;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::Skeleton;
use crate::sheet::{Exposure, Layer, Reason, Role};
use crate::time::{Clock, Frame};
use crate::timing::ByPassage;
use crate::timing::koma_per_drawing::{On, Pace, STAY};

/// The pose that an inbetween shows.
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
    /// Number of koma that a drawing stays, 1 or more, or the fewest and the most: each drawing then stays as long as
    /// `step` allows. Default `2-3`, on twos and threes (2〜3コマ打ち); `1-3` uses ones where the body is fast. Higher
    /// values turn fast arcs into straight jumps.
    pub on: On,
    /// How far the body may go while a drawing stays if `on` is a range, in % of its height (root mean square over its
    /// bones); above 0, default 9. Higher values put more of the motion on threes.
    pub step: f64,
    /// How much the body may differ from a drawing before another is drawn, in % of its height (root mean square over
    /// its bones, or 0.4 of the distance of the part that goes furthest); 0 or more, default 3.3. A genga holds (止め) up
    /// to that difference. In a take whose poses all lie within eight times this value of each other, an eighth of
    /// their range is used instead, at least 0.8. 0 holds nothing. Higher values lose small gestures in holds.
    pub drift: f64,
    /// A fixed number of inbetweens between two keys instead; default none. An interval too short for them takes as
    /// many as fit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inbetweens: Option<usize>,
    /// How far inbetweens are drawn towards their key, 0 ≤ w < 1, default 0.3; 0 is even spacing (均等割り). A key may have
    /// a weight of its own. Higher values turn the middle of a movement into a jump.
    pub weight: f64,
    /// How far an inbetween may be moved from its even place, in koma; 0 or more, default 2. Higher values make the
    /// jump over the middle grow with the distance between the keys.
    pub max_shift: f64,
    /// The pose that an inbetween shows. Default: `sample`.
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

/// A layer on the sheet, before omission.
#[derive(Debug, Clone, PartialEq)]
pub struct Spaced {
    /// Drawings and exposures, one exposure per drawing.
    pub layer: Layer,
    /// Number of requested inbetweens that did not fit between their keys.
    pub did_not_fit: usize,
    /// The koma of gaits (歩き), from first to last contact. Every step in them has the same drawings.
    pub gaits: Vec<Range<usize>>,
    /// The koma outside of passages on which the source is shown as it is.
    pub source: Vec<Range<usize>>,
}

/// The weight that moves an inbetween to where a person drags it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pull {
    /// The key on whose side the inbetween stands.
    pub key: Frame,
    /// The spacing weight of that key which puts the inbetween where it was dragged; 0 to 0.95.
    pub weight: f64,
}

knobs!(spacing::Spacing {
    on: knob(
        "何コマ打ち",
        "Koma per drawing: 1 is on ones, 2 on twos, 3 on threes, where genga leave room. 2-3 chooses \
         for each drawing: fast movement on twos, slow movement on threes (打ち分け). 1-3 also uses ones.",
        "一枚を何コマ見せるか。1は1コマ打ち、2は2コマ打ち、3は3コマ打ち（原画の間隔が許す所で）。2-3は一枚ごとに選び、\
         速いところは2コマ、遅いところは3コマ（打ち分け）。1-3は1コマも使う。",
    )
    .unit("koma, 1 (ones) to 1000, or the fewest and the most (\"2-3\")"),
    step: knob(
        "一枚で動く量",
        "How far the body may move while a drawing stays, if spacing.on is a range. Higher values \
         put more of the motion on threes.",
        "spacing.on が範囲のとき、一枚を見せるあいだに体が動いてよい量。\
         大きいほど3コマ打ちが増える。",
    )
    .unit("% of body height")
    .above(0.0)
    .slider(0.1, 50.0),
    drift: knob(
        "止めのずれ",
        "How much the body may differ from a genga before the next drawing. Until then, the genga \
         holds. 0 holds nothing. Higher values lose small gestures.",
        "体が今の絵からどこまで離れるまで、原画を止めておくか。0なら止めない。\
         大きいほど小さな芝居が消える。",
    )
    .unit("% of body height")
    .slider(0.0, 20.0),
    inbetweens: knob(
        "中割り枚数",
        "Fixed number of inbetweens between two keys, in place of spacing.on.",
        "コマ打ちの代わりに、原画のあいだの中割りを決まった枚数にする。",
    )
    .unit("drawings")
    .at_most(1000.0)
    .slider(0.0, 12.0),
    weight: knob(
        "詰めの重み",
        "How close inbetweens move to their key (spacing, 詰め). Higher values make the middle of \
         a movement snap.",
        "中割りを近い原画にどれだけ寄せるか（詰め）。大きいほど動きの真ん中が飛び、\
         メリハリが出る。",
    )
    .unit("weight (0 is even)")
    .below(1.0)
    .slider(0.0, 0.95),
    max_shift: knob(
        "詰めの上限",
        "Largest shift of an inbetween from its own time.",
        "中割りを本来の時刻からずらす量の上限。",
    )
    .unit("koma")
    .slider(0.0, 6.0),
    source: knob(
        "中割りの元",
        "Pose of an inbetween: the source, with the performer's own arc (sample), or a blend of \
         the two keys (blend).",
        "中割りのポーズ。演者の実際の軌道（sample）か、前後の原画だけを混ぜたもの（blend）。",
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
    /// The first and the last koma show an `end`. A key that falls on one gives way to it and hands over its voters. If
    /// keys are too close for a drawing to stay between them, the dearer one is kept. A genga holds until the body has
    /// moved further from it than `drift`, and no drawing that would show it again is added; a body that never moves
    /// has one drawing. If `on` is a range, the pace decides. In a gait every step has the same drawings for the same
    /// time.
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
    /// let reference = Reference::new(&clip, clock);
    /// let on_threes = Spacing { on: On::every(3), ..Spacing::default() };
    /// let spaced = on_threes.place(keys, clip.skeleton(), clock, koma, &Pace::new(&reference));
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
        ByPassage::from(self.clone()).place(layer, skeleton, clock, koma, pace)
    }

    /// Finds the key weight that takes the inbetween of a koma to a place, or as near as `max_shift` allows.
    ///
    /// `spaced` is the layer before omission, and `koma` counts on it. `None` if no inbetween can stand there, in the
    /// exact middle of an interval, and on the side of a clip end that is not a key.
    pub fn pulled(
        &self,
        layer: &LayerKeys,
        spaced: &Layer,
        clock: Clock,
        koma: usize,
        place: f64,
    ) -> Option<Pull> {
        ByPassage::from(self.clone()).pulled(layer, spaced, clock, koma, place)
    }

    /// Returns a predicate for frames worth a found key on a sheet of `koma` koma. It rejects frames at which a key
    /// would give way to the drawing of the sheet's end, and those within a rest that show nothing new.
    pub(crate) fn room<'a>(
        &self,
        rests: &[RangeInclusive<Frame>],
        clock: Clock,
        koma: usize,
        pace: &'a Pace<'a>,
    ) -> impl Fn(Frame) -> bool + use<'a> {
        let still = Still::new(rests, clock, self.drift.into(), pace);
        let stay = self.on.stay();
        // From here on a key would stand too close to the end.
        let past = if stay > 1 { (koma + 1).saturating_sub(2 * stay) } else { koma };
        move |frame| {
            let place = frame.0 as f64;
            place < clock.place_from_koma(past) && !still.covers(clock.koma_from_place(place))
        }
    }

    /// Returns how many koma the drawing of a koma stays.
    fn stay(&self, koma: usize, pace: &Pace<'_>) -> usize {
        self.on.from(koma, pace, self.step)
    }
}

impl ByPassage<Spacing> {
    /// Like [`Spacing::place`]. A drawing is spaced as on its first koma. The pull of a key (`weight`, `max_shift`) and
    /// a fixed number of inbetweens are those of the key's koma.
    pub fn place(
        &self,
        layer: &LayerKeys,
        skeleton: &Skeleton,
        clock: Clock,
        koma: usize,
        pace: &Pace<'_>,
    ) -> Spaced {
        self.place_within(&true.into(), layer, skeleton, clock, koma, pace)
    }

    /// Like [`ByPassage::place`] on the koma that are `timed`; each of the others shows the source.
    pub(crate) fn place_within(
        &self,
        timed: &ByPassage<bool>,
        layer: &LayerKeys,
        skeleton: &Skeleton,
        clock: Clock,
        koma: usize,
        pace: &Pace<'_>,
    ) -> Spaced {
        let timed = Timed { koma: timed, clock, length: koma };
        let still = Still::new(&layer.rests, clock, self.map(|own| own.drift), pace);
        let least = |koma: usize| self.least(koma, pace);
        let steps = Steps::new(&layer.gaits, koma, self, pace);
        let stations = stations(&layer.keys, &steps, timed, least);
        let names: Vec<Arc<str>> =
            skeleton.joints.iter().map(|joint| joint.name.as_str().into()).collect();
        let (walls, holds_end) = (&layer.walls[..], layer.holds_end);
        let rules = Rules { spacing: self, timed, walls, holds_end, pace, still, steps };
        rules.lay_out(&stations, &names)
    }

    /// Like [`Spacing::pulled`].
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
            // A key at which the body arrives before its own koma is timed by its own frame.
            let own = match drawing.role {
                _ if drawing.why.reason == Some(Reason::Step) => koma,
                Role::Genga => koma_before(clock, place),
                Role::End if at > 0 => (koma_before(clock, place) + 1).saturating_sub(STAY),
                Role::End | Role::Inbetween => koma,
            };
            Station { koma: koma.max(own), place, role: drawing.role, key, is_border: false }
        };
        let [from, to] = [from, to].map(station);
        let interval = Interval::new(self, &from, &to, &layer.walls, clock);
        let (side, weight) = interval.weight_at(koma, all[own].1, place)?;
        let key = [from, to][side].key?;
        Some(Pull { key: key.frame, weight })
    }

    /// Returns how many koma the drawing of a koma stays.
    fn stay(&self, koma: usize, pace: &Pace<'_>) -> usize {
        self.at(koma).stay(koma, pace)
    }

    /// Returns how many koma it stays at least.
    fn least(&self, koma: usize, pace: &Pace<'_>) -> usize {
        self.stay(koma, pace).min(STAY)
    }

    /// Returns the koma of `asked` inbetweens between two koma, or of as many as fit.
    fn evenly(&self, asked: usize, koma: Range<usize>, pace: &Pace<'_>) -> Vec<usize> {
        let least = koma.clone().map(|koma| self.least(koma, pace)).max().unwrap_or(STAY);
        let count = asked.min((koma.len() / least).saturating_sub(1));
        let place = |at: usize| (at * koma.len()) as f64 / (count + 1) as f64;
        (1..=count).map(|at| koma.start + place(at).round() as usize).collect()
    }
}

#[cfg(test)]
mod tests;
