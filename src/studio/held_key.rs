//! A genga in the hand (つまんだ原画), over the curves or on the sheet.

use super::corrections::Correction;
use crate::keys::Key;
use crate::time::Frame;

/// A key that a hand holds, and the frame that it was last over.
#[derive(Debug, Clone)]
pub(super) struct HeldKey {
    key: Key,
    over: Frame,
}

impl HeldKey {
    /// A key that is taken where it stands.
    pub(super) fn take(key: &Key) -> Self {
        Self { key: key.clone(), over: key.frame }
    }

    /// What moves it to a frame, when that is another than the last.
    pub(super) fn carry(&mut self, to: Frame) -> Option<Correction> {
        let is_new = std::mem::replace(&mut self.over, to) != to;
        is_new.then(|| Correction::Move(self.key.clone(), to))
    }
}
