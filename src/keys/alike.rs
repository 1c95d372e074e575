//! Poses that look alike (同じポーズ): of two keys that show one pose, only one is drawn.

/// Last koma up to which the body keeps the pose of each koma without a break.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Alike {
    last: Vec<usize>,
}

impl Alike {
    /// Takes the last koma up to which each koma's pose holds: itself or a later one.
    pub fn from_last(last: Vec<usize>) -> Self {
        Self { last }
    }

    /// Returns the last koma up to which a koma's pose holds; the koma itself if nothing is known.
    pub(super) fn last(&self, koma: usize) -> usize {
        self.last.get(koma).map_or(koma, |last| koma.max(*last))
    }
}
