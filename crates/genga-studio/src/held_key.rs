//! A genga being dragged (つまんだ原画), over the curves or on the sheet.

use super::corrections::Correction;
use genga::keys::Key;
use genga::time::Frame;

/// A key being dragged, and the frame that it was last over.
#[derive(Debug, Clone)]
pub(super) struct HeldKey {
    key: Key,
    over: Frame,
}

impl HeldKey {
    /// Grabs a key.
    pub(super) fn take(key: &Key) -> Self {
        Self { key: key.clone(), over: key.frame }
    }

    /// The correction that moves the key to a frame, if it was not there already.
    pub(super) fn carry(&mut self, to: Frame) -> Option<Correction> {
        let is_new = std::mem::replace(&mut self.over, to) != to;
        is_new.then(|| Correction::Move(self.key.clone(), to))
    }
}
