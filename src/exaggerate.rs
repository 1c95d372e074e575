//! **Exaggerate** (誇張): anticipation and follow-through, slow-in and slow-out, applied before anything is drawn.
//!
//! Off by default. The result is an ordinary clip; later stages need not know.

mod cartoon;
mod ease;
mod parts;
mod smooth;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Knobs, knob, knobs};
use crate::motion::{Clip, RowWriter};
use crate::sheet::Source;
use crate::time::Span;

pub use parts::CartoonParts;

/// Exaggeration (誇張) of a motion: the cartoon filter of Wang, Drucker, Agrawala and Cohen 2006, then
/// slow-in and slow-out by a bilateral filter after Kwon and Lee 2011. Both are off by default.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Exaggerate {
    /// Strength of anticipation (予備動作) and follow-through (後追い), 0 (none) to 3; default 0. At 1, a sudden turn goes
    /// back by 36 % of itself before and overshoots by as much after, and a swing of the period that gains most is
    /// twice as wide. Higher values push limbs through the body and joints beyond their limits.
    pub cartoon: f64,
    /// The time from the furthest anticipation to the furthest follow-through of a sudden movement, in frames or
    /// seconds, 0 or more; default 0.25 s. A swing of 2.4 times that period gains most. Higher values exaggerate slow
    /// movements as well. Values beyond the clip's length count as that length.
    pub cartoon_width: Span,
    /// The parts of the body that the cartoon filter moves. Default: those that carry no foot.
    pub cartoon_parts: CartoonParts,
    /// How far poses gather around the slow ones beside them (slow-in, slow-out; スローイン・スローアウト), 0 (not at all) to 1;
    /// default 0. The path of every joint stays the same, and the movement in between gets faster.
    pub ease: f64,
    /// How far apart in time poses attract one another, as a standard deviation in frames or seconds, 0 or more;
    /// default 0.1 s. Higher values pull short movements towards the rests beside them.
    pub ease_reach: Span,
}

impl Default for Exaggerate {
    fn default() -> Self {
        Self {
            cartoon: 0.0,
            cartoon_width: Span::Seconds(0.25),
            cartoon_parts: CartoonParts::default(),
            ease: 0.0,
            ease_reach: Span::Seconds(0.1),
        }
    }
}

knobs!(exaggerate::Exaggerate {
    cartoon: knob(
        "誇張",
        "Anticipation before movements and follow-through after them (the cartoon animation \
         filter), added before keys are chosen. At 1, each is 36 % of a sudden movement. Higher \
         values break joints.",
        "原画を選ぶ前に、\
         動きの前の予備動作と後の後追いを強める（カートゥーン・アニメーション・フィルタ）。1で、\
         急な動きの36％だけ逆へ引き、行き過ぎる。強すぎると関節が壊れる。",
    )
    .unit("strength (0 is off)")
    .at_most(3.0) // a body is unreadable beyond three times the swing
    .slider(0.0, 2.0),
    cartoon_width: knob(
        "予備動作から後追いまで",
        "Time from the anticipation of a sudden movement to its follow-through. Longer values \
         exaggerate slow movements too.",
        "急な動きの予備動作から後追いまでの時間。長いほど、ゆっくりした動きも誇張される。",
    ),
    cartoon_parts: knob(
        "誇張する部位",
        "Body parts that are exaggerated. upper: those that carry no foot, so standing feet stay \
         in place. body: also the legs and the travel of the body, so feet slide a little.",
        "誇張する部位。upperは足につながらない部位だけで、接地した足は動かない。\
         bodyは脚と体の移動も含む全身で、足が少し滑る。",
    ),
    ease: knob(
        "スローイン・スローアウト",
        "Slow-in and slow-out: poses gather around rests and turning points, and the movement \
         between is faster. Only the time of a pose changes.",
        "止まりや折り返しの近くに時間を集め、あいだの動きを速くする。ポーズは変わらず、\
         時刻だけが変わる。",
    )
    .unit("strength (0 is off)")
    .at_most(1.0),
    ease_reach: knob(
        "時間を集める範囲",
        "How far apart in time poses move towards the slow ones beside them. Longer values pull \
         short movements towards the rests beside them.",
        "近くの遅いポーズに引き寄せる時間の範囲。長いほど、短い動きが隣の止めに引き寄せられる。",
    ),
});

impl Exaggerate {
    /// Checks that the settings can be used.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first setting that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Whether the exaggeration changes nothing.
    pub fn is_off(&self) -> bool {
        self.cartoon == 0.0 && self.ease == 0.0
    }

    /// Returns the exaggerated clip, with the same joints, rate and frames. The poses are exaggerated before their
    /// times, so that the result is eased as well. The first and the last frame stay unchanged.
    ///
    /// # Errors
    /// As for [`Exaggerate::validate`], and [`Error::Clip`] if a position would grow beyond 10¹².
    ///
    /// ```
    /// use genga::exaggerate::Exaggerate;
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// let cartoon = Exaggerate { cartoon: 0.5, ..Exaggerate::default() };
    /// let exaggerated = cartoon.apply(&clip)?;
    /// assert_eq!(exaggerated.len(), clip.len());
    /// assert_ne!(exaggerated, clip);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn apply(&self, clip: &Clip) -> Result<Clip, Error> {
        self.validate()?;
        let posed = self.posed(clip);
        let eased = self.eased(posed.as_ref().unwrap_or(clip));
        let exaggerated = eased.or(posed).unwrap_or_else(|| clip.clone());
        exaggerated.check_size()?;
        Ok(exaggerated)
    }

    /// Adds anticipation and follow-through; `None` if that has no effect.
    fn posed(&self, clip: &Clip) -> Option<Clip> {
        let width = self.cartoon_width.frames(clip.rate()).min(clip.len() as f64);
        let filter = cartoon::Filter::new(self.cartoon, 0.5 * width)?;
        Some(filter.apply(clip, &self.cartoon_parts.joints(clip)))
    }

    /// Shows the same poses at other times; `None` if that has no effect.
    fn eased(&self, clip: &Clip) -> Option<Clip> {
        let reach = self.ease_reach.frames(clip.rate()).min(clip.len() as f64);
        let places = ease::places(clip, self.ease, reach)?;
        let channels = clip.skeleton().channels();
        let mut values = vec![0.0; clip.len() * channels];
        let mut writer = RowWriter::new(clip);
        for (row, place) in values.chunks_exact_mut(channels).zip(places) {
            writer.write(Source::At(clip.first().0 as f64 + place), row);
        }
        Some(clip.with_values(values))
    }
}
