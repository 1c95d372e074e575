use proptest::prelude::*;

use super::*;

/// A list of these worths in the order of their falling rank.
fn ranking(worths: &[f64], rank: Rank, seconds: f64) -> Ranking {
    let found = worths.iter().enumerate();
    let found = found.map(|(at, worth)| Ranked { frame: Frame(10 * at + 5), worth: *worth });
    Ranking { staying: vec![], found: found.collect(), rank, seconds }
}

/// How many the settings leave of the list: the cheapest goes until the next costs enough and no more
/// than the limit are left, as keys are priced.
fn left(ranking: &Ranking, settings: &Choose) -> usize {
    let most = (settings.per_second * ranking.seconds).floor() as usize;
    let mut left = ranking.found.len();
    while left > 0 {
        let stays =
            ranking.rank == Rank::Strength || ranking.found[left - 1].worth >= settings.min_price;
        if stays && left <= most {
            break;
        }
        left -= 1;
    }
    left
}

#[test]
fn a_price_of_few_digits_parts_the_kept_from_the_others() {
    let ranking = ranking(&[9.0, 4.5678, 2.3123, 2.2, 0.7], Rank::Price, 4.0);
    let price = |count| {
        let settings = ranking.keeping(count, &Choose::default());
        assert_eq!(settings.per_second, f64::INFINITY);
        settings.min_price
    };
    assert_eq!([0, 1, 2, 3, 4, 5].map(price), [19.0, 9.0, 4.0, 2.3, 2.0, 0.0]);
}

#[test]
fn where_prices_do_not_part_them_a_limit_does() {
    // Three cost the same, and the last but one is dearer than the one above it.
    let ranking = ranking(&[9.0, 3.0, 3.0, 3.0, 2.0, 2.5], Rank::Price, 4.0);
    for count in 0..=6 {
        let settings = ranking.keeping(count, &Choose::default());
        assert_eq!(left(&ranking, &settings), count, "{settings:?}");
    }
    let tied = ranking.keeping(2, &Choose::default());
    assert_eq!((tied.min_price, tied.per_second), (3.0, 0.6));
}

proptest! {
    #[test]
    fn any_count_can_be_kept(
        worths in prop::collection::vec(prop_oneof![0.0..9.0, Just(0.0), Just(1.5)], 0..40),
        seconds in prop_oneof![Just(1.0 / 24.0), 0.1..500.0],
        by_strength in any::<bool>(),
    ) {
        let rank = if by_strength { Rank::Strength } else { Rank::Price };
        let ranking = ranking(&worths, rank, seconds);
        for count in 0..=worths.len() + 2 {
            let settings = ranking.keeping(count, &Choose { rank, ..Choose::default() });
            prop_assert!(settings.validate().is_ok(), "{:?}", settings);
            prop_assert_eq!(left(&ranking, &settings), count.min(worths.len()), "{:?}", settings);
        }
    }
}
