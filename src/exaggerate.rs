//! **Exaggerate** (誇張): anticipation and follow-through, slow-in and slow-out, before anything is drawn.
//!
//! Off unless it is asked for. The result is a clip like any other: what comes after it need not know.

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
    /// How strong anticipation (予備動作) and follow-through (後追い) are, 0 (none) to 3; default 0. With 1 a
    /// sudden turn goes back by 36 % of itself before and beyond by as much after, and a swing in the
    /// period that is met best is twice as wide. Raised, limbs go through the body and joints beyond what
    /// they can.
    pub cartoon: f64,
    /// The time from the furthest back to the furthest beyond of a sudden movement, frames or seconds, 0 or
    /// more; 0.25 s by default. A swing of 2.4 times that period gains most. Raised, slow movements are
    /// exaggerated as well; more than the clip's length counts as that.
    pub cartoon_width: Span,
    /// What of the body the cartoon filter moves. Default: what no foot hangs on.
    pub cartoon_parts: CartoonParts,
    /// How far poses gather round the slow ones beside them (slow-in, slow-out; スローイン・スローアウト), 0 (not
    /// at all) to 1; default 0. The way of every joint stays what it was, and the movement between is faster.
    pub ease: f64,
    /// How far in time poses draw one another, as a standard deviation, frames or seconds, 0 or more; 0.1 s by
    /// default. Raised, short movements are drawn to the rests beside them.
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
         filter), before keys are chosen. 1 goes back and beyond by 36 % of a sudden movement. \
         More breaks joints.",
        "原画を選ぶ前に、\
         動きの前の予備動作と後の後追いを強める（カートゥーン・アニメーション・フィルタ）。1で、\
         急な動きの36％だけ逆へ引き、行き過ぎる。強すぎると関節が壊れる。",
    )
    .unit("strength (0 is off)")
    .at_most(3.0) // three times the swing is beyond what a body can be read in
    .slider(0.0, 2.0),
    cartoon_width: knob(
        "予備動作から後追いまで",
        "The time from the anticipation of a sudden movement to its follow-through. Longer \
         exaggerates slow movements too.",
        "急な動きの予備動作から後追いまでの時間。長いほど、ゆっくりした動きも誇張される。",
    ),
    cartoon_parts: knob(
        "誇張する部位",
        "What is exaggerated so: all that no foot hangs on, so that feet stand where they stood \
         (upper), or legs and the way of the body too (body): feet slide a little then.",
        "誇張する部位。足につながらない部位だけで、接地した足は動かない（upper）か、\
         脚と体の移動も含む全身（body）で、足は少し滑る。",
    ),
    ease: knob(
        "スローイン・スローアウト",
        "Slow-in and slow-out: poses gather round rests and turning points, and the movement \
         between is faster. No pose is changed, only its time.",
        "止まりや折り返しの近くに時間を集め、あいだの動きを速くする。ポーズは変わらず、\
         時刻だけが変わる。",
    )
    .unit("strength (0 is off)")
    .at_most(1.0),
    ease_reach: knob(
        "時間を集める範囲",
        "How far in time poses are drawn to the slow ones beside them. Longer draws short \
         movements to the rests beside them.",
        "近くの遅いポーズに引き寄せる時間の範囲。長いほど、短い動きは隣の止めに引き寄せられる。",
    ),
});

impl Exaggerate {
    /// Whether the settings can be used.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Whether nothing is exaggerated.
    pub fn is_off(&self) -> bool {
        self.cartoon == 0.0 && self.ease == 0.0
    }

    /// The exaggerated clip: same joints, rate and frames. First the poses, then their times, so that what the
    /// first makes is eased as well. The first and the last frame stay as they are.
    ///
    /// # Errors
    /// Those of [`Exaggerate::validate`], and [`Error::Clip`] where a position would grow beyond 10¹².
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

    /// Anticipation and follow-through; none where there is nothing to do.
    fn posed(&self, clip: &Clip) -> Option<Clip> {
        let width = self.cartoon_width.frames(clip.rate()).min(clip.len() as f64);
        let filter = cartoon::Filter::of(self.cartoon, 0.5 * width)?;
        Some(filter.apply(clip, &self.cartoon_parts.joints(clip)))
    }

    /// The same poses at other times; none where there is nothing to do.
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
