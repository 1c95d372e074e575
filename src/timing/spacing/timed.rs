//! The koma of a sheet that are timed; all others show the source.

use std::ops::Range;

use crate::time::Clock;
use crate::timing::ByPassage;

/// The koma on which the sheet is timed. All others show the source.
#[derive(Clone, Copy)]
pub(super) struct Timed<'a> {
    pub(super) koma: &'a ByPassage<bool>,
    pub(super) clock: Clock,
    /// Number of koma of the sheet.
    pub(super) length: usize,
}

impl Timed<'_> {
    /// Whether a koma is timed.
    pub(super) fn has(self, koma: usize) -> bool {
        *self.koma.at(koma)
    }

    /// Returns the koma that show the source.
    pub(super) fn source_koma(self) -> Vec<Range<usize>> {
        let begins = std::iter::once(0).chain(self.koma.changes());
        let ends = self.koma.changes().chain([self.length]);
        let all = begins.zip(ends).map(|(begin, end)| begin..end.min(self.length));
        all.filter(|koma| !koma.is_empty() && !self.has(koma.start)).collect()
    }
}
