//! Splits a list into parts, so that several machines share the work.

use std::fmt;
use std::str::FromStr;

/// Part `index` of `count`, from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    pub(crate) index: usize,
    pub(crate) count: usize,
}

/// The whole list as a single part.
impl Default for Shard {
    fn default() -> Self {
        Self { index: 1, count: 1 }
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parsed = text.split_once('/').and_then(|(index, count)| {
            Some(Self { index: index.trim().parse().ok()?, count: count.trim().parse().ok()? })
        });
        let is_part = |shard: &Self| (1..=shard.count).contains(&shard.index);
        parsed
            .filter(is_part)
            .ok_or_else(|| "expected a part and how many there are, as in 1/4 to 4/4".into())
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl Shard {
    /// Returns the indices of this part's clips, in order. Clips are dealt largest first, each to the part with the
    /// fewest bytes so far, so every machine with the same list gets the same split.
    pub(crate) fn deal(self, sizes: &[u64]) -> Vec<usize> {
        let mut parts = vec![(0, vec![]); self.count];
        for at in largest_first(sizes) {
            let lightest = (0..self.count).min_by_key(|part| (parts[*part].0, *part)).unwrap_or(0);
            // An empty file is work too.
            parts[lightest].0 += sizes[at].max(1);
            parts[lightest].1.push(at);
        }
        let mut own = parts.swap_remove(self.index - 1).1;
        own.sort_unstable();
        own
    }
}

/// Returns the indices of a list, largest item first.
pub(crate) fn largest_first(sizes: &[u64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|at| (std::cmp::Reverse(sizes[*at]), *at));
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn parts_have_each_clip_once_and_no_more_bytes_than_the_largest_beside_their_share(
            sizes in prop::collection::vec(0_u64..1000, 0..60), count in 1_usize..9
        ) {
            let parts: Vec<_> = (1..=count).map(|index| Shard { index, count }.deal(&sizes)).collect();
            let mut all: Vec<usize> = parts.concat();
            all.sort_unstable();
            prop_assert!(all.into_iter().eq(0..sizes.len()));
            let bytes = |part: &Vec<usize>| part.iter().map(|at| sizes[*at].max(1)).sum::<u64>();
            let (most, least) = (parts.iter().map(bytes).max().unwrap(), parts.iter().map(bytes).min().unwrap());
            prop_assert!(most - least <= sizes.iter().copied().max().unwrap_or(0).max(1));
        }
    }

    #[test]
    fn a_part_is_written_with_how_many_there_are() {
        assert_eq!("2/4".parse::<Shard>().unwrap().to_string(), "2/4");
        for wrong in ["0/4", "5/4", "4", "a/b", "1/0"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
