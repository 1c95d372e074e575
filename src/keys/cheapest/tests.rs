use proptest::prelude::*;

use super::*;
use crate::cases::cases;
use crate::keys::tests::{self, swing};

/// An arm that swings to and fro ever faster.
fn chords(koma: usize) -> Chords {
    let angle = |at: usize| 50.0 * (at as f64 * at as f64 * 0.004).sin() + at as f64;
    let clip = swing(&(0..koma).map(angle).collect::<Vec<_>>());
    tests::chords(&clip, f64::INFINITY)
}

/// One entry a frame of 24 fps, every third of them a turn.
fn entries(count: usize, staying: &[usize]) -> Vec<Entry> {
    several(count, staying, 1)
}

/// Returns `count` entries, one a frame and `a_koma` a koma.
fn several(count: usize, staying: &[usize], a_koma: usize) -> Vec<Entry> {
    let entry = |frame: usize| Entry {
        frame: Frame(frame),
        koma: frame / a_koma,
        stays: frame == 0 || frame + 1 == count || staying.contains(&frame),
        cost: if frame.is_multiple_of(3) { 0.1 } else { 1.0 },
        holds: frame / a_koma,
    };
    (0..count).map(entry).collect()
}

/// Returns the loss of a set plus its cost.
fn cost(cheapest: &Cheapest<'_>, kept: &[usize], price: f64) -> f64 {
    let lost: f64 = kept.windows(2).map(|ends| cheapest.loss(ends[0], ends[1])).sum();
    let found = kept.iter().map(|at| cheapest.entries[*at]).filter(|entry| !entry.stays);
    lost + price * found.map(|entry| entry.cost).sum::<f64>()
}

/// Returns every possible set: the ends and the entries that stay are in it, the others a distance apart.
fn every_set(cheapest: &Cheapest<'_>) -> Vec<Vec<usize>> {
    let entries = cheapest.entries;
    let may_be = |set: &Vec<usize>| {
        let all_stay = (0..entries.len()).all(|at| !entries[at].stays || set.contains(&at));
        all_stay && set.windows(2).all(|ends| cheapest.are_apart(ends[0], ends[1]))
    };
    let set = |bits: usize| (0..entries.len()).filter(|at| bits >> at & 1 == 1).collect();
    (0..1usize << entries.len()).map(set).filter(may_be).collect()
}

proptest! {
    #![proptest_config(cases(8, 48))]

    #[test]
    fn no_set_at_all_is_cheaper(
        count in 3usize..12,
        staying in prop::collection::vec(0usize..12, 0..3),
        apart in prop::sample::select(&[1.0, 1.5, 3.0][..]),
        price in 0.01..400.0,
        a_koma in 1usize..4,
        holds in prop::collection::vec(0usize..3, 12),
    ) {
        let (chords, mut entries) = (chords(count), several(count, &staying, a_koma));
        entries.iter_mut().zip(holds).for_each(|(entry, more)| entry.holds += more);
        let cheapest = Cheapest::among(&entries, &chords, apart);
        let set = cheapest.set(price, usize::MAX);
        let found = cost(&cheapest, &set.kept, price);
        let least = every_set(&cheapest).iter().map(|set| cost(&cheapest, set, price)).fold(f64::INFINITY, f64::min);
        prop_assert!(found <= least + 1e-9, "{} {}", found, least);
        prop_assert!(every_set(&cheapest).contains(&set.kept));
        prop_assert_eq!(set.over_limit, 0);
    }

    #[test]
    fn a_limit_is_met_exactly_and_the_rest_is_counted(
        count in 12usize..80,
        most in 0usize..30,
        price in prop_oneof![Just(0.0), 0.01..60.0],
    ) {
        let (chords, entries) = (chords(count), entries(count, &[7, 10]));
        let cheapest = Cheapest::among(&entries, &chords, 1.5);
        let free = cheapest.found(&cheapest.set(price, usize::MAX).kept);
        let set = cheapest.set(price, most);
        prop_assert_eq!(cheapest.found(&set.kept), most.min(free));
        let worth_more = if price > 0.0 { free.saturating_sub(most) } else { 0 };
        prop_assert_eq!(set.over_limit, worth_more);
        prop_assert!([0, 7, 10, count - 1].iter().all(|stays| set.kept.contains(stays)));
        let pairs = set.kept.windows(2);
        prop_assert!(pairs.clone().all(|ends| cheapest.are_apart(ends[0], ends[1])));
    }
}

proptest! {
    #![proptest_config(cases(8, 48))]

    #[test]
    fn a_limit_lets_in_as_many_as_slow_halving_finds(
        count in 12usize..160,
        most in 0usize..40,
        low in prop_oneof![Just(price::LOWEST), 0.01..60.0],
        a_koma in 1usize..3,
    ) {
        let (chords, entries) = (chords(count), several(count, &[7, 10], a_koma));
        let cheapest = Cheapest::among(&entries, &chords, 2.0);
        let many = cheapest.at(low);
        prop_assume!(cheapest.found(&many) > most);
        let (mut under, mut over) = (low, 1e12);
        for _ in 0..200 {
            let middle = (under * over).sqrt();
            let is_few = cheapest.found(&cheapest.at(middle)) <= most;
            *if is_few { &mut over } else { &mut under } = middle;
        }
        let (slow, quick) = (cheapest.at(over), cheapest.limited(low, many, most));
        prop_assert_eq!(cheapest.found(&quick), cheapest.found(&slow));
    }
}

#[test]
fn a_chord_out_of_reach_is_taken_where_nothing_nearer_may_be_a_key() {
    let clip = swing(&(0..3000).map(|at: i32| f64::from((at - 2900).max(0))).collect::<Vec<_>>());
    let chords = tests::chords(&clip, f64::INFINITY);
    let far = [0, 10, 2900, 2999].map(|frame| Entry {
        holds: frame,
        frame: Frame(frame),
        koma: frame,
        stays: frame == 0 || frame == 2999,
        cost: 1.0,
    });
    assert!(2500 > chords.reach);
    let cheapest = Cheapest::among(&far, &chords, 1.0);
    let kept = cheapest.set(1.0, usize::MAX).kept;
    assert_eq!(kept, [0, 2, 3], "what comes after the gap is worth it");
    let none = cheapest.set(1.0, 0);
    assert_eq!(none.kept, [0, 3], "so few that no known chord is long enough");
}

#[test]
fn a_body_that_hardly_moves_for_longer_than_any_chord_has_no_key() {
    let clip = swing(&(0..500).map(|at| 0.01 * f64::from(at)).collect::<Vec<_>>());
    let (chords, entries) = (tests::chords(&clip, 2.0), entries(500, &[]));
    assert!(chords.reach < 500, "some chords are not known");
    let cheapest = Cheapest::among(&entries, &chords, 1.0);
    assert_eq!(cheapest.set(27.0, usize::MAX).kept, [0, 499], "the default price");
}

#[test]
fn what_a_key_saves_is_what_is_lost_without_it() {
    let (chords, entries) = (chords(40), entries(40, &[20]));
    let cheapest = Cheapest::among(&entries, &chords, 1.0);
    let kept = [0, 9, 20, 31, 39];
    let saves = cheapest.saves(&kept);
    assert_eq!([saves[0], saves[2], saves[4]], [f64::INFINITY; 3], "they stay");
    let all = cost(&cheapest, &kept, 0.0);
    assert!((saves[1] - (cost(&cheapest, &[0, 20, 31, 39], 0.0) - all)).abs() < 1e-9);
    assert!((saves[3] - (cost(&cheapest, &[0, 9, 20, 39], 0.0) - all)).abs() < 1e-9);
}

#[test]
fn a_dearer_key_is_worth_more_koma_of_error() {
    let (chords, entries) = (chords(120), entries(120, &[]));
    let cheapest = Cheapest::among(&entries, &chords, 1.0);
    let counts =
        [1.0, 10.0, 100.0, 1e3, 1e4].map(|price| cheapest.set(price, usize::MAX).kept.len());
    assert!(counts.is_sorted_by(|a, b| a > b), "{counts:?}");
}
