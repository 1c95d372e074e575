//! Commands that take several clips (何本かの動き): a broken one does not end the work on the others.

use super::console::{Words, counted};
use super::failure::Failure;

/// Counts the clips that failed.
pub(super) struct Several<'a> {
    words: &'a Words,
    clips: usize,
    failed: usize,
}

impl<'a> Several<'a> {
    pub(super) fn new(clips: usize, words: &'a Words) -> Self {
        Self { words, clips, failed: 0 }
    }

    /// Returns what was made of a clip, or `None` after the reason why it failed was told. The failure ends the command
    /// if there is no other clip to work on, or if the command line is wrong, which no other clip would mend.
    pub(super) fn keep<T>(&mut self, made: Result<T, Failure>) -> Result<Option<T>, Failure> {
        let reason = match made {
            Ok(made) => return Ok(Some(made)),
            Err(Failure::CouldNot(reason)) if self.failed + 1 < self.clips => reason,
            Err(failure) => return Err(failure),
        };
        self.failed += 1;
        self.words.error(reason);
        Ok(None)
    }

    /// Fails, after all else is written, if clips failed.
    pub(super) fn end(self) -> Result<(), Failure> {
        match self.failed {
            0 => Ok(()),
            failed => Err(Failure::CouldNot(format!(
                "{failed} of {} failed, as said above; all is written of the others",
                counted(self.clips, "clip")
            ))),
        }
    }
}
