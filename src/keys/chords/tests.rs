use proptest::prelude::*;

use super::*;
use crate::keys::tests::{self, swing};
use crate::time::FrameRate;

fn chords(angles: &[f64], fps: f64) -> Chords {
    let clip = swing(angles).with_rate(FrameRate::new(fps).unwrap());
    tests::chords(&clip, f64::INFINITY)
}

proptest! {
    #[test]
    fn running_sums_are_what_each_instant_says(
        angles in prop::collection::vec(-170.0..170.0, 2..60),
        fps in prop_oneof![Just(24.0), Just(30.0), Just(120.0)],
    ) {
        let chords = chords(&angles, fps);
        for from in 0..chords.koma {
            for to in from + 1..chords.koma.min(from + 1 + chords.reach) {
                let (known, slow) = (f64::from(chords.known(from)[to - from]), chords.far(from, to));
                prop_assert!((known - slow).abs() < 1e-6 * (1.0 + slow), "{} {}", known, slow);
            }
        }
    }
}

#[test]
fn beyond_its_reach_a_chord_is_summed_instant_by_instant() {
    let angles: Vec<f64> = (0..4000).map(|at| 40.0 * (f64::from(at) * 0.1).sin()).collect();
    let chords = chords(&angles, 24.0);
    assert_eq!(chords.reach, PAIRS / chords.koma);
    let (reach, from) = (chords.reach, 17);
    let [last, next] = [reach, reach + 1].map(|reach| chords.loss(from, from + reach));
    assert!((last - chords.far(from, from + reach)).abs() < 1e-6 * last);
    assert!((last..1.1 * last).contains(&next), "{last} {next}");
    let sampled = chords.loss(0, 5 * LOOKS);
    let all: f64 = (1..5 * LOOKS).map(|at| chords.off(0, at, 5 * LOOKS)).sum();
    assert!((sampled - all).abs() < 0.01 * all, "{sampled} {all}");
    assert_eq!(chords.loss(5, 5), 0.0);
    assert_eq!(chords.loss(5, 6), 0.0, "nothing stands between them");
}

#[test]
fn an_even_way_loses_next_to_nothing_and_a_turn_on_it_its_height() {
    // Small angles: the hand of an arm of one bone goes nearly straight.
    let even: Vec<f64> = (0..25).map(|at| 0.01 * f64::from(at)).collect();
    let chords_of_even = chords(&even, 24.0);
    let turn: Vec<f64> = (0..25).map(|at: i32| 0.01 * f64::from(12 - (at - 12).abs())).collect();
    let turned = chords(&turn, 24.0);
    let even = chords_of_even.loss(0, 24);
    assert!(turned.loss(0, 12) < even && turned.loss(12, 24) < even);
    assert!(turned.loss(0, 24) > 1000.0 * even);
}
