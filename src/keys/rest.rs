//! Rests (止め): stretches in which the whole body practically stands still. Both ends of a rest are
//! keys whatever they save: an animator draws them to hold them, and a slow settling costs so little
//! that no price would find them.

use std::ops::RangeInclusive;

use crate::keys::Chords;
use crate::keys::postures::{Postures, apart};
use crate::keys::stillness::{LEAST, SMOOTH, runs, smoothed, steps};
use crate::knob::choices;
use crate::time::Frame;

/// What the begin and the end of a rest are to the keys of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtRests {
    /// Keys whatever they save, and nothing that looks like the key before.
    #[default]
    Keys,
    /// Moments like all others, as those within are: a key may look like the one before. On the sheet drawings hold all the
    /// same.
    Off,
}

choices!(AtRests { Keys: "keys", Off: "off" });

/// How far the body may be from the posture that it holds, beside its unrest, in % of its height.
const NEAR: f64 = 0.2;

/// Rests by the frames of their begins and ends, both included. One that reaches the sheet's first or last
/// koma begins or ends there.
pub(crate) fn rest_frames(
    chords: &Chords,
    rests: &[RangeInclusive<usize>],
) -> Vec<RangeInclusive<Frame>> {
    let frames =
        |rest: &RangeInclusive<usize>| chords.frame(*rest.start())..=chords.frame(*rest.end());
    rests.iter().map(frames).collect()
}

/// The frames on which rests begin and end. A rest that reaches the sheet's first or last koma only
/// ends or only begins.
pub(super) fn rest_ends(chords: &Chords, rests: &[RangeInclusive<usize>]) -> Vec<Frame> {
    let last = chords.len().saturating_sub(1);
    let ends = rests.iter().flat_map(|rest| [*rest.start(), *rest.end()]);
    let inner = ends.filter(|end| (1..last).contains(end));
    let mut ends: Vec<Frame> = inner.map(|end| chords.frame(end)).collect();
    // A short movement may part two rests that are held in nearly one posture.
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// The instants from the first to the last of each rest: the posture changes by less than `speed`, in %
/// of the body's height a second, for at least half a second, and no part of the body acts.
pub(crate) fn rests(chords: &Chords, speed: f64) -> Vec<RangeInclusive<usize>> {
    let steps = |seconds| steps(seconds, chords.clock().koma_rate);
    let postures = chords.postures();
    let speeds = smoothed(&postures.speeds(chords.clock().koma_rate), steps(SMOOTH));
    let is_still = |at: usize| speeds[at] < speed && !postures.acting().goes_on(at);
    let stills = runs(speeds.len(), is_still).into_iter();
    // The speed of an instant is that of the step into it: a run of steps joins one instant more.
    let stills = stills.filter(|still| still.len() >= steps(LEAST));
    stills.map(|still| held(postures, still.start, still.end, steps(SMOOTH))).collect()
}

/// From when until when a body that is still keeps to the posture that it holds, itself as still as it is
/// well within the rest: by its speed alone a rest that is come to slowly would begin before its posture
/// is reached, and one after a quick move later. At an end of the clip it lasts.
fn held(postures: &Postures, begin: usize, end: usize, margin: usize) -> RangeInclusive<usize> {
    let (first, last) = (begin + margin, end - margin);
    let posture = mean(postures, first, last);
    let off = |at: usize| apart(postures.row(at), &posture);
    let unrest = (first..=last).map(off).fold(0.0, f64::max);
    let is_held = |at: &usize| off(*at) <= unrest + NEAR;
    let from = (0..first).rev().take_while(is_held).last().unwrap_or(first);
    let to = (last + 1..postures.len()).take_while(is_held).last().unwrap_or(last);
    let is_last = end + 1 == postures.len();
    (if begin == 0 { 0 } else { from })..=(if is_last { end } else { to })
}

/// The mean of the postures from one instant to another.
fn mean(postures: &Postures, first: usize, last: usize) -> Vec<f64> {
    let count = (last + 1 - first) as f64;
    let mut mean = vec![0.0; postures.row(first).len()];
    for at in first..=last {
        for (mean, own) in mean.iter_mut().zip(postures.row(at)) {
            *mean += own / count;
        }
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::tests::{self, swing};
    use crate::motion::Clip;

    fn ends(clip: &Clip, speed: f64) -> Vec<Frame> {
        let chords = tests::chords(clip, 2.0);
        rest_ends(&chords, &rests(&chords, speed))
    }

    #[test]
    fn a_pause_of_more_than_half_a_second_is_a_rest_and_a_shorter_one_is_not() {
        let mut angles = Vec::new();
        let mut angle = 0.0;
        for (frames, step) in [(12, 5.0), (20, 0.0), (12, 5.0), (8, 0.0), (12, 5.0)] {
            for _ in 0..frames {
                angle += step;
                angles.push(angle);
            }
        }
        let clip = swing(&angles);
        assert_eq!(ends(&clip, 15.0), [Frame(11), Frame(31)], "as long as it is held");
        assert!(ends(&clip, 0.0).is_empty(), "0 is no rest at all");
    }

    #[test]
    fn a_rest_at_an_end_of_the_sheet_has_one_end_of_its_own() {
        let ends = |angles: &[f64]| ends(&swing(angles), 15.0);
        let swings = (0..12).map(|frame| 5.0 * f64::from(frame));
        let last: Vec<f64> = swings.chain([55.0; 20]).collect();
        assert_eq!(ends(&last), [Frame(11)], "it only begins");
        let first: Vec<f64> = last.iter().rev().copied().collect();
        assert_eq!(ends(&first), [Frame(20)], "it only ends");
        assert!(ends(&[30.0; 30]).is_empty(), "a body that never moves has no end of a rest");
        assert!(ends(&[30.0; 5]).is_empty());
    }
}
