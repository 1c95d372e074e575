//! The ladder of spacing: the next settings with more drawings or with fewer.

use crate::timing::{On, Spacing};

/// The slowest rung before keys go: on threes. A hold lasts up to two drawings' time, and one of eight koma, as on
/// fours, would stop a movement.
const SLOWEST: usize = 3;

/// The largest number of inbetweens between two keys that the ladder tries.
const MOST_INBETWEENS: usize = 24;

/// Koma between drawings at which the ladder ends.
const LONGEST: usize = 1000;

/// Returns the spacing with more drawings: the upper end of a range comes down to the lower, and from twos the range
/// opens to ones where the body is fast. A fixed number of inbetweens grows by one. `None` if there is a drawing on
/// every koma.
pub(super) fn denser(spacing: &Spacing) -> Option<Spacing> {
    let Spacing { on, inbetweens, .. } = *spacing;
    let (on, inbetweens) = match inbetweens {
        Some(count) if count < MOST_INBETWEENS => (on, Some(count + 1)),
        Some(_) => (On::every(1), None),
        None if on.least < on.most => (On { most: on.most - 1, ..on }, None),
        None if on.most > 1 => (On { least: on.most - 1, ..on }, None),
        None => return None,
    };
    Some(Spacing { on, inbetweens, ..spacing.clone() })
}

/// Returns the spacing with fewer drawings: the lower end of a range goes up to the upper, and up to threes the range
/// opens to slower ones. A fixed number of inbetweens shrinks by one. `None` if no more can go.
pub(super) fn sparser(spacing: &Spacing) -> Option<Spacing> {
    let Spacing { on, inbetweens, .. } = *spacing;
    let (on, inbetweens) = match inbetweens {
        Some(count) => (on, Some(count.checked_sub(1)?)),
        None if on.least < on.most => (On { least: on.least + 1, ..on }, None),
        None if on.most < SLOWEST => (On { most: on.most + 1, ..on }, None),
        // By a quarter at a time: a hold lasts up to two drawings' time, so the counts that koma-dori reaches on
        // neighbouring rungs overlap.
        None if on.most < LONGEST => {
            (On::every((on.most + (on.most / 4).max(1)).min(LONGEST)), None)
        }
        None => return None,
    };
    Some(Spacing { on, inbetweens, ..spacing.clone() })
}

/// Like [`sparser`], but stops at threes.
pub(super) fn sparser_to_threes(spacing: &Spacing) -> Option<Spacing> {
    sparser(spacing).filter(|next| next.inbetweens.is_some() || next.on.most <= SLOWEST)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spacing(on: &str, inbetweens: Option<usize>) -> Spacing {
        Spacing { on: on.parse().unwrap(), inbetweens, ..Spacing::default() }
    }

    /// Returns all rungs that follow a spacing.
    fn rungs(from: Spacing, next: fn(&Spacing) -> Option<Spacing>) -> Vec<String> {
        let rungs = std::iter::successors(Some(from), next);
        let words = rungs.map(|rung| match rung.inbetweens {
            None => rung.on.to_string(),
            Some(count) => format!("{count} between"),
        });
        words.collect()
    }

    #[test]
    fn a_range_closes_before_it_moves_and_opens_between_two_rungs() {
        assert_eq!(rungs(spacing("1-3", None), denser), ["1-3", "1-2", "1"]);
        assert_eq!(rungs(spacing("3", None), denser), ["3", "2-3", "2", "1-2", "1"]);
        assert_eq!(rungs(spacing("1", None), sparser_to_threes), ["1", "1-2", "2", "2-3", "3"]);
        assert_eq!(rungs(spacing("1-3", None), sparser_to_threes), ["1-3", "2-3", "3"]);
        assert_eq!(rungs(spacing("6", None), sparser_to_threes), ["6"]);
    }

    #[test]
    fn a_fixed_number_of_inbetweens_goes_by_ones_and_gives_way_to_ones() {
        let up = rungs(spacing("2", Some(22)), denser);
        assert_eq!(up, ["22 between", "23 between", "24 between", "1"]);
        let down = rungs(spacing("9", Some(2)), sparser_to_threes);
        assert_eq!(down, ["2 between", "1 between", "0 between"]);
    }

    #[test]
    fn the_ladder_has_an_end() {
        let rungs = rungs(spacing("4", None), sparser);
        assert_eq!(rungs[..5], ["4", "5", "6", "7", "8"]);
        assert_eq!(rungs.last().unwrap(), "1000");
        assert!(rungs.len() < 40, "{rungs:?}");
    }
}
