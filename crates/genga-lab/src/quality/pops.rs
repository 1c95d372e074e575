//! Pops (飛び): movement held back by a hold that comes all at once.

use serde::Serialize;

/// A step out of a hold is a pop if it is at least this many times what the surrounding speed gives.
const TIMES: f64 = 2.0;

/// A pop is also at least this far, in % of body height, so that a jerk of a finger does not count.
const FAR: f64 = 0.8;

/// Speed below which a body stands still, in % of body height per koma; single-precision floats tremble that much.
const STANDS: f64 = 1e-3;

/// Longest exposure in koma that is not a hold, as in the table of drawings.
const HOLD: usize = 3;

/// Seconds before and after a step within which it is compared with other steps.
const ROUND: f64 = 0.5;

/// A conspicuous step out of a hold.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pop {
    /// The koma that shows the drawing after the hold, from 0.
    pub koma: usize,
    /// How far the body goes there, in % of its height (root mean square over its points).
    pub step: f64,
    /// The ratio of that distance to how far the body goes in the time of the hold at the median surrounding speed;
    /// infinite, in JSON `null`, if the body stands still around it.
    pub times: f64,
}

/// The pops of a layer.
///
/// A hold stores up movement, and when it ends the body covers all of it in one koma. At an even speed that distance is
/// right, however long the hold. So the step out of every hold, a drawing on screen for more than three koma, is
/// compared with how far the body goes in that time at the median of the speeds in half a second before and after, each
/// step taken over the exposure before it. A step is a pop from twice that distance and 0.8 % of body height on.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Pops {
    /// Number of held drawings that are followed by another.
    pub holds: usize,
    /// The pops by koma.
    pub pops: Vec<Pop>,
}

impl Pops {
    /// Examines the exposures of a layer in koma, and how far the body goes from each to the next, in % of its height:
    /// one step fewer than exposures.
    pub fn new(exposures: &[usize], steps: &[f64], koma_rate: f64) -> Self {
        debug_assert_eq!(steps.len() + 1, exposures.len().max(1));
        let mut koma = 0;
        let ends: Vec<usize> = exposures
            .iter()
            .map(|exposure| {
                koma += exposure;
                koma
            })
            .collect();
        let speed = |at: usize| steps[at] / exposures[at].max(1) as f64;
        let mut found = Self::default();
        for (at, step) in steps.iter().enumerate().filter(|(at, _)| exposures[*at] > HOLD) {
            found.holds += 1;
            let near = |other: &usize| {
                *other != at && ends[*other].abs_diff(ends[at]) as f64 <= ROUND * koma_rate
            };
            let Some(round) = middle((0..steps.len()).filter(near).map(speed)) else {
                continue;
            };
            let even = round * exposures[at] as f64;
            let times = if round > STANDS { step / even } else { f64::INFINITY };
            if times >= TIMES && *step >= FAR {
                found.pops.push(Pop { koma: ends[at], step: *step, times });
            }
        }
        found
    }

    /// Returns the most conspicuous pop, of those out of stillness the furthest; `None` if there is none.
    pub fn worst(&self) -> Option<Pop> {
        let outdoes = |b: &Pop, a: &Pop| (b.times, b.step) > (a.times, a.step);
        self.pops.iter().copied().reduce(|a, b| if outdoes(&b, &a) { b } else { a })
    }
}

/// Returns the median, the lower one of an even number; `None` if there are no values.
fn middle(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len().saturating_sub(1) / 2).copied()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_jump_out_of_a_hold_among_small_steps_is_a_pop() {
        let exposures = [2, 2, 4, 2, 2, 2];
        let pops = Pops::new(&exposures, &[2.0, 2.0, 12.0, 2.0, 2.0], 24.0);
        assert_eq!(pops.holds, 1);
        assert_eq!(pops.pops, [Pop { koma: 8, step: 12.0, times: 3.0 }]);
        assert_eq!(pops.worst().unwrap().koma, 8);
        let stillness = Pops::new(&exposures, &[0.0, 1e-9, 12.0, 1e-12, 0.0], 24.0);
        assert_eq!(stillness.pops, [Pop { koma: 8, step: 12.0, times: f64::INFINITY }]);
        let dust = Pops {
            holds: 2,
            pops: [3.0, 9.0].map(|step| Pop { step, ..stillness.pops[0] }).into(),
        };
        assert_eq!(dust.worst().unwrap().step, 9.0, "the furthest of those out of stillness");
        assert!(Pops::new(&exposures, &[5.0; 5], 24.0).pops.is_empty(), "slower than all round it");
        assert!(Pops::new(&exposures, &[0.2, 0.2, 0.7, 0.2, 0.2], 24.0).pops.is_empty(), "dust");
    }

    proptest! {
        #[test]
        fn what_goes_on_at_an_even_speed_never_pops(
            exposures in prop::collection::vec(1usize..20, 2..20),
            speed in 0.01..30.0,
        ) {
            let steps: Vec<f64> =
                exposures[1..].iter().zip(&exposures).map(|(_, koma)| speed * *koma as f64).collect();
            prop_assert!(Pops::new(&exposures, &steps, 24.0).pops.is_empty());
        }
    }

    #[test]
    fn a_step_that_follows_no_hold_is_none() {
        let pops = Pops::new(&[2, 2, 2, 2], &[1.0, 9.0, 1.0], 24.0);
        assert_eq!(pops, Pops::default());
    }

    #[test]
    fn only_what_is_near_is_compared() {
        // Fast steps lie more than half a second away.
        let exposures = [1, 1, 30, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2];
        let steps = [20.0, 20.0, 60.0, 1.0, 1.0, 1.0, 20.0, 20.0, 20.0, 20.0, 20.0, 20.0];
        let pops = Pops::new(&exposures, &steps, 12.0);
        assert_eq!(pops.pops.len(), 1, "{pops:?}");
        assert_eq!(pops.pops[0].times, 4.0);
    }

    #[test]
    fn without_drawings_nothing_pops() {
        assert_eq!(Pops::new(&[], &[], 24.0), Pops::default());
        assert_eq!(Pops::new(&[5], &[], 24.0), Pops::default());
    }
}
