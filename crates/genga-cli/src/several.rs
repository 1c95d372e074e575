//! Commands that take several clips (何本かの動き): a broken one does not end the work on the others.

use std::path::Path;

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

    /// Returns what was made of the clip of a file, or `None` after the reason why it failed was told. The failure ends
    /// the command if no clip is left to work on.
    pub(super) fn keep<T>(
        &mut self,
        path: &Path,
        made: Result<T, Failure>,
    ) -> Result<Option<T>, Failure> {
        let failure = match made {
            Ok(made) => return Ok(Some(made)),
            Err(failure @ (Failure::Stopped(_) | Failure::ClosedPipe)) => return Err(failure),
            Err(failure) if self.failed + 1 == self.clips => return Err(failure),
            Err(failure) => failure.to_string(),
        };
        self.failed += 1;
        let path = path.display().to_string();
        let of = if failure.starts_with(&path) { String::new() } else { format!("{path}: ") };
        self.words.error(format_args!("{of}{failure}"));
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
