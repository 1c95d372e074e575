//! Poses that are alike (同じポーズ): of two keys that show one pose only one is drawn.

/// Up to which koma the pose of each is still that of the body, all the way.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Alike {
    last: Vec<usize>,
}

impl Alike {
    /// Koma by koma the last up to which its pose holds: itself or a later one.
    pub fn from_last(last: Vec<usize>) -> Self {
        Self { last }
    }

    /// The last koma up to which the pose of one holds; itself where nothing is known of it.
    pub(super) fn last(&self, koma: usize) -> usize {
        self.last.get(koma).map_or(koma, |last| koma.max(*last))
    }
}
