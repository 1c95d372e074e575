//! Rests (止め): stretches in which the whole body practically stands still. Both ends of a rest are keys whatever they
//! save: an animator draws them to hold them, and a slow settling loses so little that no price would find them.

use std::ops::RangeInclusive;

use crate::keys::Chords;
use crate::keys::postures::{Postures, apart};
use crate::keys::stillness::{LEAST, SMOOTH, runs, smoothed, steps};
use crate::knob::choices;
use crate::time::Frame;

/// How the begin and the end of a rest are treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AtRests {
    /// As keys whatever they save; no other key looks like the key before it.
    #[default]
    Keys,
    /// As moments like all others, like those within the rest: a key may look like the one before. Drawings on the
    /// sheet still hold.
    Off,
}

choices!(AtRests { Keys: "keys", Off: "off" });

/// Distance from the held posture that counts as held, beyond the body's unrest, in % of body height.
const NEAR: f64 = 0.2;

/// Returns the rests from first to last frame, both included. A rest that reaches the sheet's first or last koma begins
/// or ends there.
pub(crate) fn rest_frames(
    chords: &Chords,
    rests: &[RangeInclusive<usize>],
) -> Vec<RangeInclusive<Frame>> {
    let frames =
        |rest: &RangeInclusive<usize>| chords.frame(*rest.start())..=chords.frame(*rest.end());
    rests.iter().map(frames).collect()
}

/// Returns the frames on which rests begin and end. A rest that reaches the sheet's first koma only ends, one that
/// reaches the last only begins.
pub(super) fn rest_ends(chords: &Chords, rests: &[RangeInclusive<usize>]) -> Vec<Frame> {
    let last = chords.len().saturating_sub(1);
    let ends = rests.iter().flat_map(|rest| [*rest.start(), *rest.end()]);
    let inner = ends.filter(|end| (1..last).contains(end));
    let mut ends: Vec<Frame> = inner.map(|end| chords.frame(end)).collect();
    // Two rests that are separated by a short movement may hold nearly the same posture, and share ends.
    ends.sort_unstable();
    ends.dedup();
    ends
}

/// Finds the rests from first to last instant: the posture changes by less than `speed`, in % of body height a second,
/// for at least half a second, and no part of the body acts.
pub(crate) fn rests(chords: &Chords, speed: f64) -> Vec<RangeInclusive<usize>> {
    let steps = |seconds| steps(seconds, chords.clock().koma_rate);
    let postures = chords.postures();
    let speeds = smoothed(&postures.speeds(chords.clock().koma_rate), steps(SMOOTH));
    let is_still = |at: usize| speeds[at] < speed && !postures.acting().goes_on(at);
    let stills = runs(speeds.len(), is_still).into_iter();
    // Speeds belong to the step into an instant: a run of steps spans one instant more.
    let stills = stills.filter(|still| still.len() >= steps(LEAST));
    stills.map(|still| held(postures, still.start, still.end, steps(SMOOTH))).collect()
}

/// Finds from when until when a still body keeps its posture, as still as it is well within the rest. Judged by speed
/// alone, a rest that is reached slowly would begin before its posture, and one after a quick move would begin late. At
/// an end of the clip the rest lasts.
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

/// Returns the mean of the postures from one instant to another.
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
