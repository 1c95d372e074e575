//! Omissions are counted in each action separately.

use super::*;
use crate::cases::cases;

/// Builds a take of `koma` koma on ones that speeds up and slows down again.
fn long(koma: i32) -> (Layer, Stills) {
    let places: Vec<i32> = (0..koma).map(|at| at * at % 97).collect();
    on_ones(&places)
}

#[test]
fn a_share_gives_six_an_action_and_not_six_a_take() {
    let (layer, stills) = long(600);
    let asked = |naka_nashi, later: &[usize]| {
        let settings = Omission { naka_nashi, ..Omission::default() };
        settings.apply_to(&layer, &stills, &course(1, later)).unwrap().report.naka_nashi.asked
    };
    let share = Amount::Share(0.04);
    assert_eq!(asked(share, &[]), 6);
    assert_eq!(asked(share, &[200, 400]), 18, "8 of each without the limit");
    assert_eq!(asked(share, &[100]), 4 + 6, "and never more than its share");
    assert_eq!(asked(Amount::Count(4), &[200, 400]), 12, "a count is of each action");
}

#[test]
fn actions_begin_in_order_and_one_without_a_koma_is_none() {
    let (layer, stills) = long(60);
    let apply = |later: &[usize]| counts(3, 0).apply_to(&layer, &stills, &course(1, later));
    let parted = apply(&[25]).unwrap();
    assert_ne!(parted, apply(&[]).unwrap());
    assert_eq!(apply(&[0, 25, 25, 60, 99]).unwrap(), parted);
    assert!(apply(&[25, 24]).unwrap_err().to_string().contains("sort their koma"));
}

fn course(on: usize, later: &[usize]) -> Course {
    Course { on: On::every(on).into(), later: later.to_vec(), ..Course::default() }
}

/// Generates the drawings of an action: one that stays, then inbetweens.
fn action() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec(place(), 2..20).prop_map(|places| {
        let role = |at| if at == 0 { Role::End } else { Role::Inbetween };
        places.into_iter().enumerate().map(|(at, place)| (place, 2, role(at))).collect()
    })
}

proptest! {
    #![proptest_config(cases(200, 1000))]

    #[test]
    fn actions_that_part_at_genga_are_left_out_of_as_if_each_were_alone(
        actions in prop::collection::vec(action(), 1..5),
        naka_nashi in 0..9usize,
        settings in settings(),
    ) {
        let settings = Omission { naka_nashi: Amount::Count(naka_nashi), koma_dori: Amount::Count(0), fast: 0.0, keep_length: false, ..settings };
        let end = ((7, 7), 2, Role::End);
        let whole: Vec<Plan> = actions.iter().flatten().copied().chain([end]).collect();
        let (layer, stills) = laid_out(&whole);
        let begins = actions.iter().scan(0, |koma, action| {
            *koma += 2 * action.len();
            Some(*koma)
        });
        let later: Vec<usize> = begins.take(actions.len() - 1).collect();
        let together = settings.apply_to(&layer, &stills, &course(2, &later)).unwrap();
        let (mut one_by_one, mut done) = (Vec::new(), 0);
        for (at, action) in actions.iter().enumerate() {
            let next = actions.get(at + 1).map_or(end, |next| next[0]);
            let alone: Vec<Plan> = action.iter().copied().chain([next]).collect();
            let (layer, stills) = laid_out(&alone);
            let omitted = settings.apply(&layer, &stills, 2).unwrap();
            let before: usize = actions[..at].iter().map(Vec::len).sum();
            one_by_one.pop();
            one_by_one.extend(left(&omitted.layer).iter().map(|(drawing, koma)| (before + drawing, *koma)));
            done += omitted.report.naka_nashi.done;
        }
        prop_assert_eq!(left(&together.layer), one_by_one);
        prop_assert_eq!(together.report.naka_nashi.done, done);
        adds_up(&layer, &together.layer, &together.report, &settings)?;
    }
}
