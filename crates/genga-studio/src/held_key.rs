//! What is being dragged (つまんだもの): a genga over the curves, or a genga or the end of a hold along the sheet.

use super::column::KeyedCell;
use super::corrections::Correction;
use super::view_state::Shown;
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

/// What is dragged along the koma of a sheet.
#[derive(Debug, Clone)]
pub(super) enum Held {
    /// A key.
    Key(HeldKey),
    /// The end of a hold: the drawing's frame, the koma on which it begins, and the length last asked for.
    End { frame: Frame, begin: usize, koma: usize },
}

impl Held {
    /// Grabs a key.
    pub(super) fn key(key: &Key) -> Self {
        Self::Key(HeldKey::take(key))
    }

    /// Grabs the end of a drawing's hold.
    pub(super) fn end_of(cell: &KeyedCell<'_>, shown: &Shown<'_>) -> Self {
        let frame = cell.hold_frame(&shown.wanted.edits);
        Self::End { frame, begin: cell.koma, koma: cell.held }
    }

    pub(super) fn is_end(&self) -> bool {
        matches!(self, Self::End { .. })
    }

    /// The correction that brings a key to a koma, or the end of a hold to the line before a koma, if it was not there
    /// already.
    pub(super) fn carry(
        &mut self,
        at: usize,
        line: usize,
        shown: &Shown<'_>,
    ) -> Option<Correction> {
        match self {
            Self::Key(key) => key.carry(shown.frame_of_koma(at)),
            Self::End { frame, begin, koma } => {
                let wanted = line.saturating_sub(*begin).max(1);
                let is_new = std::mem::replace(koma, wanted) != wanted;
                is_new.then_some(Correction::Hold(*frame, wanted))
            }
        }
    }
}
