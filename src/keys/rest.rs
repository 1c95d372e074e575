//! Rests (止め): stretches in which the whole body practically stands still. Both ends of a rest are
//! keys whatever they save: an animator draws them to hold them, and a slow settling costs so little
//! that no price would find them.

use crate::keys::reference::Reference;
use crate::time::Frame;

/// Seconds that a stillness must last to be a rest.
const LEAST: f64 = 0.5;

/// Koma over which the speed is averaged, so that one tremble does not cut a rest in two.
const SMOOTH: usize = 3;

/// The first and the last frame of each rest: the body is slower than `speed`, in % of its height a
/// second (root mean square over the joints' ways through the world), for at least half a second.
pub(super) fn rests(reference: &Reference<'_>, speed: f64) -> Vec<[Frame; 2]> {
    let clock = reference.clock();
    let speeds = smoothed(&reference.speeds());
    let least = (LEAST * clock.koma_rate).round() as usize;
    let frame = |koma: usize| Frame(clock.place_from_koma(koma).round() as usize);
    let mut rests = Vec::new();
    let mut begin = 0;
    for still in speeds.chunk_by(|a, b| (*a < speed) == (*b < speed)) {
        let end = begin + still.len();
        // The speed of a koma is that of the step into it: a run of steps joins one koma more.
        if still[0] < speed && still.len() >= least {
            rests.push([frame(begin), frame(end)]);
        }
        begin = end;
    }
    rests
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
        assert_eq!(rests(&reference, 15.0), [[Frame(12), Frame(30)]], "a koma of smoothing inside");
        assert!(rests(&reference, 0.0).is_empty(), "0 is no rest at all");
    }

    #[test]
    fn a_body_that_never_moves_rests_from_first_to_last() {
        let clip = swing(&[30.0; 30]);
        let reference = Reference::of(&clip, clip.clock(24.0));
        assert_eq!(rests(&reference, 15.0), [[Frame(0), Frame(29)]]);
        let short = swing(&[30.0; 5]);
        assert!(rests(&Reference::of(&short, short.clock(24.0)), 15.0).is_empty());
    }
}
