use proptest::prelude::*;

use super::*;

const ON_TWOS: Rhythm = Rhythm { on: 2, inbetweens: None };

fn koma(step: &[Exposed]) -> Vec<usize> {
    step.iter().map(|phase| phase.koma).collect()
}

fn drawings(step: &[Exposed]) -> Vec<usize> {
    step.iter().map(|phase| phase.drawings).collect()
}

#[test]
fn a_step_has_exposures_by_its_length_alone() {
    let walk = Exposures::new(&[0.0, 0.22, 0.47, 0.74], 13.2, ON_TWOS);
    let of = |length| koma(&walk.of_step(length));
    assert_eq!(of(13), [3, 3, 4, 3]);
    assert_eq!(of(14), [3, 3, 5, 3], "a koma more goes where drawings are short");
    assert_eq!(of(16), [3, 3, 6, 4]);
    assert_eq!(of(12), [2, 3, 4, 3], "and a koma less comes from where it lacks least");
    assert_eq!(of(9), [2, 2, 3, 2]);
    assert_eq!(of(8), [2; 4]);
    let run = Exposures::new(&[0.0, 0.1, 0.9, 0.95], 8.0, ON_TWOS);
    assert_eq!(koma(&run.of_step(8)), [2; 4], "each stays for two");
    assert_eq!(run.of_step(7).iter().map(|phase| phase.koma).sum::<usize>(), 7);
    assert_eq!(koma(&Exposures::new(&[0.0], 3.1, ON_TWOS).of_step(3)), [3]);
}

/// Returns the koma of each step of a walk.
fn koma_of_steps(
    placing: &Placing,
    walk: &Walk,
    before: &mut Option<(f64, isize)>,
) -> Vec<Range<isize>> {
    let usual = nearest(walk.koma);
    walk.steps.iter().map(|step| placing.koma_of_step(step, usual, before)).collect()
}

#[test]
fn steps_are_equally_long_while_their_contacts_stay_within_a_koma() {
    let walk = |lengths: &[f64]| {
        let mut at = 24.8;
        let step = |length: &f64| {
            let contact = at;
            at += length;
            WalkStep { contact, next: at, frames: vec![], taken: vec![], has_no_phase: false }
        };
        let steps = lengths.iter().map(step).collect();
        Walk { phases: vec![Phase::Contact], shares: vec![0.0], koma: 12.9, steps }
    };
    let placing =
        |comes_early| Placing { exposures: Exposures::new(&[0.0], 12.9, ON_TWOS), comes_early };
    let lengths = |of: &[f64], comes_early| {
        let steps = koma_of_steps(&placing(comes_early), &walk(of), &mut None);
        assert!(steps.windows(2).all(|pair| pair[0].end == pair[1].start));
        let is_near = |(step, koma): (&WalkStep, &Range<isize>)| {
            (koma.end as f64 - step.next).abs() <= if comes_early { 1.5 } else { 1.0 }
        };
        assert!(walk(of).steps.iter().zip(&steps).all(is_near));
        steps.iter().map(Range::len).collect::<Vec<_>>()
    };
    let marched = [13.2, 12.9, 13.2, 12.3, 12.8, 12.7, 13.3, 12.4];
    assert_eq!(lengths(&marched, true), [13; 8]);
    let on_ones = lengths(&marched, false);
    assert_eq!(on_ones.iter().filter(|length| **length == 13).count(), 7, "a koma less once");
    let slows = [12.9, 12.9, 14.9, 12.9];
    assert_eq!(lengths(&slows, true), [13, 13, 15, 13], "a longer step is longer");
}

#[test]
fn a_gait_begins_on_the_koma_on_which_the_one_before_ends() {
    let walk = |from: f64, koma: f64| {
        let step = |at: usize| {
            let contact = from + koma * at as f64;
            WalkStep {
                contact,
                next: contact + koma,
                frames: vec![],
                taken: vec![],
                has_no_phase: false,
            }
        };
        Walk {
            phases: vec![Phase::Contact],
            shares: vec![0.0],
            koma,
            steps: (0..4).map(step).collect(),
        }
    };
    for tenths in 0..10 {
        for comes_early in [true, false] {
            let placing = |koma: f64| Placing {
                exposures: Exposures::new(&[0.0], koma, ON_TWOS),
                comes_early,
            };
            let first = walk(0.1 * f64::from(tenths), 12.7);
            let second = walk(first.steps[3].next, 9.3);
            let mut before = None;
            let slow = koma_of_steps(&placing(12.7), &first, &mut before);
            let quick = koma_of_steps(&placing(9.3), &second, &mut before);
            assert_eq!(slow[3].end, quick[0].start, "{tenths} {comes_early}");
        }
    }
}

#[test]
fn a_drawing_stays_a_koma_longer_rather_than_one_stays_for_one() {
    let drawings =
        |on, inbetweens| [1, 2, 3, 4, 5, 6, 7].map(|koma| Rhythm { on, inbetweens }.drawings(koma));
    assert_eq!(drawings(1, None), [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(drawings(2, None), [1, 1, 1, 2, 2, 3, 3]);
    assert_eq!(drawings(3, None), [1, 1, 1, 1, 2, 2, 2]);
    assert_eq!(drawings(2, Some(1)), [1, 1, 1, 2, 2, 2, 2], "those that fit");
    let cuts = |koma, drawings| Exposed { koma, drawings }.cuts().collect::<Vec<_>>();
    assert_eq!(cuts(5, 2), [(0, 3), (3, 5)], "the longer first");
    assert_eq!(cuts(3, 1), [(0, 3)]);
}

#[test]
fn shorter_steps_keep_their_drawings_as_long_as_each_stays_for_two_koma() {
    let slow = Exposures::new(&[0.0, 0.15, 0.38, 0.54], 13.0, ON_TWOS);
    assert_eq!(
        (koma(&slow.of_step(13)), drawings(&slow.of_step(13))),
        (vec![2, 3, 2, 6], vec![1, 1, 1, 3])
    );
    assert_eq!(
        (koma(&slow.of_step(12)), drawings(&slow.of_step(12))),
        (vec![2, 2, 2, 6], vec![1, 1, 1, 3])
    );
    assert_eq!(
        (koma(&slow.of_step(11)), drawings(&slow.of_step(11))),
        (vec![2, 2, 2, 5], vec![1, 1, 1, 2])
    );
}

proptest! {
    #[test]
    fn a_koma_more_is_a_koma_more_in_one_phase(
        mut shares in prop::collection::vec(0.01..0.99_f64, 3),
        usual in 8.0..40.0_f64,
        count in prop::sample::select(vec![1_usize, 2, 4]),
        on in 1_usize..4,
        off in -40_isize..6,
    ) {
        shares.sort_by(f64::total_cmp);
        let shares = [vec![0.0], shares].concat();
        let exposures = Exposures::new(&shares[..count], usual, Rhythm { on, inbetweens: None });
        let length = (usual.round() as usize).saturating_add_signed(off);
        let [one, more] = [0, 1].map(|more| exposures.of_step(length + more));
        prop_assert!(one.iter().all(|phase| phase.drawings * on.min(2) <= phase.koma.max(2)));
        let [one, more] = [koma(&one), koma(&more)];
        prop_assert_eq!(one.iter().sum::<usize>(), length);
        prop_assert!(length < count || one.iter().all(|koma| *koma >= 1), "{:?}", one);
        prop_assert!(length < 2 * count || one.iter().all(|koma| *koma >= 2), "{:?}", one);
        let apart: usize = one.iter().zip(&more).map(|(a, b)| a.abs_diff(*b)).sum();
        prop_assert_eq!(apart, 1);
    }
}
