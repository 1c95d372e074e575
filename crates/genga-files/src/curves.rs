//! The take as few keys with smooth curves between them (キーとカーブ): the other half of a stepped sheet.

mod channels;
mod distance;
mod fit;
mod samples;
mod spline;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use genga::error::{Error, Warning};
use genga::knob::{knob, knobs};
use genga::motion::Clip;
use genga::sheet::Sheet;
use genga::time::Frame;

pub use channels::tangents;
pub use distance::distances;
pub(crate) use fit::{GIRTH, Key, KeyedTake, Track, body_height, keys_of, turn_between};
pub(crate) use samples::Path;
pub(crate) use spline::Shape;

/// Keys at the genga of a sheet, with smooth curves between them that stay close to the take.
///
/// Keys have the times of the take; holds and omission change stepped motion only. If the genga are too few for the
/// allowed error, keys are added where the curves are furthest off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Curves {
    /// Largest distance between the curves' body and the take's, as a share of body height, 0.0001 to 1; default 0.01.
    /// It holds for each joint, each tip, and the skin about a joint, which turns with it.
    pub error: f64,
}

/// How close the motion between some keys is to the take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveErrors {
    /// Number of keys, on all layers.
    pub keys: usize,
    /// Number of keys that were added to the genga.
    pub added: usize,
    /// Largest distance of a joint, a tip or skin, as a share of body height.
    pub largest: f64,
    /// Mean distance of the joints and tips over all frames, as a share of body height.
    pub mean: f64,
}

impl CurveErrors {
    /// Measures motion that goes straight from key to key, by slerp, as other programs do between sparse keys. `keys` are
    /// two or more frames of the clip in order of time.
    pub fn from_lines(clip: &Clip, keys: &[Frame]) -> Self {
        Self::new(&KeyedTake::from_lines(clip, keys))
    }

    fn new(keyed: &KeyedTake) -> Self {
        let (keys, added) = (keyed.keys(), keyed.added());
        Self { keys, added, largest: keyed.largest, mean: keyed.mean }
    }
}

/// The reason why there are no curves.
pub(crate) const TOO_FEW: &str = "a curve needs two genga, and the sheet has fewer";

impl Default for Curves {
    fn default() -> Self {
        Self { error: 0.01 }
    }
}

knobs!(curves::Curves {
    error: knob(
        "カーブの誤差",
        "Largest distance between the motion of keys with curves and the take, as a share of body height. Keys are \
         added to the genga where it is exceeded.",
        "カーブ付きキーの動きと素材との差の上限。身長に対する割合。超える所では原画にキーを足す。",
    )
    .unit("of body height")
    .at_least(0.0001)
    .at_most(1.0),
});

impl Curves {
    /// Measures how close the curves come to the take.
    ///
    /// # Errors
    /// [`Error::Sheet`] if fewer than two genga are on screen, or a layer names a joint that the clip lacks.
    pub fn errors(&self, clip: &Clip, sheet: &Sheet) -> Result<CurveErrors, Error> {
        Ok(CurveErrors::new(&self.fit(clip, sheet)?))
    }

    /// Finds the keys and the curves between them.
    pub(crate) fn fit(&self, clip: &Clip, sheet: &Sheet) -> Result<KeyedTake, Error> {
        KeyedTake::new(clip, sheet, self.error)
    }

    /// Says how many keys the curves need beside the genga.
    pub(crate) fn notes(&self, clip: &Clip, sheet: &Sheet) -> Result<Vec<Warning>, Error> {
        let keyed = self.fit(clip, sheet)?;
        Ok(self
            .note("keys-glb", keyed.keys(), keyed.added(), keyed.error_of_genga)
            .into_iter()
            .collect())
    }

    /// Says how many of the keys of a format are no genga, and why they are there.
    pub(crate) fn note(
        &self,
        format: &str,
        keys: usize,
        added: usize,
        error_of_genga: f64,
    ) -> Option<Warning> {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        let message = format!(
            "{format}: keys on {keys} frames, {added} beside the {genga} genga. With those alone, the curves are up to {} of \
             body height off the take; curves.error allows {}, and needs fewer keys if it allows more",
            percent(error_of_genga),
            percent(self.error),
            genga = keys - added,
        );
        (added > 0).then(|| Warning::new("W_KEYS_ADDED", message))
    }
}
