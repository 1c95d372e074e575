//! Rests (止め): stretches in which the whole body practically stands still. Both ends of a rest are
//! keys whatever they save: an animator draws them to hold them, and a slow settling costs so little
//! that no price would find them.

use crate::keys::Reference;
use crate::time::Frame;

/// Seconds that a stillness must last to be a rest.
const LEAST: f64 = 0.5;

/// Koma over which the speed is averaged, so that one tremble does not cut a rest in two.
const SMOOTH: usize = 3;

/// The frames on which rests begin and end: the body is slower than `speed`, in % of its height a
/// second (root mean square over its points' ways through the world), for at least half a second. A
/// rest that reaches the sheet's first or last koma only ends or only begins.
pub(super) fn rest_ends(reference: &Reference, speed: f64) -> Vec<Frame> {
    let clock = reference.clock();
    let speeds = smoothed(&reference.speeds());
    let least = (LEAST * clock.koma_rate).round() as usize;
    let frame = |koma: usize| Frame(clock.place_from_koma(koma).round() as usize);
    let mut ends = Vec::new();
    let mut begin = 0;
    for still in speeds.chunk_by(|a, b| (*a < speed) == (*b < speed)) {
        let end = begin + still.len();
        // The speed of a koma is that of the step into it: a run of steps joins one koma more.
        if still[0] < speed && still.len() >= least {
            ends.extend((begin > 0).then(|| frame(begin)));
            ends.extend((end < speeds.len()).then(|| frame(end)));
        }
        begin = end;
    }
    ends
}

/// A centred mean over [`SMOOTH`] values, over fewer at the ends.
fn smoothed(values: &[f64]) -> Vec<f64> {
    let mean = |at: usize| {
        let near = &values[at.saturating_sub(SMOOTH / 2)..(at + SMOOTH / 2 + 1).min(values.len())];
        near.iter().sum::<f64>() / near.len() as f64
    };
    (0..values.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keys::price::tests::swing;

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
        let reference = Reference::of(&clip, clip.clock(24.0));
        assert_eq!(
            rest_ends(&reference, 15.0),
            [Frame(12), Frame(30)],
            "a koma of smoothing inside"
        );
        assert!(rest_ends(&reference, 0.0).is_empty(), "0 is no rest at all");
    }

    #[test]
    fn a_rest_at_an_end_of_the_sheet_has_one_end_of_its_own() {
        let ends = |angles: &[f64]| {
            let clip = swing(angles);
            rest_ends(&Reference::of(&clip, clip.clock(24.0)), 15.0)
        };
        let swings = (0..12).map(|frame| 5.0 * f64::from(frame));
        let last: Vec<f64> = swings.chain([55.0; 20]).collect();
        assert_eq!(ends(&last), [Frame(12)], "it only begins");
        let first: Vec<f64> = last.iter().rev().copied().collect();
        assert_eq!(ends(&first), [Frame(19)], "it only ends");
        assert!(ends(&[30.0; 30]).is_empty(), "a body that never moves has no end of a rest");
        assert!(ends(&[30.0; 5]).is_empty());
    }
}
