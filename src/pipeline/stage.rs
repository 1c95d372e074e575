//! A stage of the chain: its last output, and what it was made of.

use std::sync::Arc;

use crate::error::Error;

/// Which of its outputs a stage holds, so that the next stage knows whether it has used that one. A
/// run may end after any stage: whether a stage did something *in this run* would not tell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Made(u64);

impl Made {
    /// The clip as it was given never changes.
    pub(super) const CLIP: Self = Self(0);
}

/// A stage's last output with the input and the settings that made it.
#[derive(Debug)]
pub(super) struct Stage<Settings, Output> {
    last: Option<Arc<(Made, Settings, Output)>>,
    pub(super) made: Made,
}

impl<Settings, Output> Clone for Stage<Settings, Output> {
    fn clone(&self) -> Self {
        Self { last: self.last.clone(), made: self.made }
    }
}

impl<Settings, Output> Default for Stage<Settings, Output> {
    fn default() -> Self {
        Self { last: None, made: Made::default() }
    }
}

impl<Settings: Clone + PartialEq, Output> Stage<Settings, Output> {
    /// Makes the output again if its input or its settings changed. Says which output it holds now.
    pub(super) fn refresh(
        &mut self,
        input: Made,
        settings: &Settings,
        make: impl FnOnce() -> Result<Output, Error>,
    ) -> Result<Made, Error> {
        let is_fresh =
            self.last.as_deref().is_some_and(|(from, with, _)| *from == input && with == settings);
        if !is_fresh {
            // Forgotten first: should `make` fail, a later run must not take the old output for the new.
            self.last = None;
            self.last = Some(Arc::new((input, settings.clone(), make()?)));
            self.made = Made(self.made.0 + 1);
        }
        Ok(self.made)
    }

    /// [`Stage::refresh`] for a stage that cannot fail.
    pub(super) fn renew(
        &mut self,
        input: Made,
        settings: &Settings,
        make: impl FnOnce() -> Output,
    ) -> Made {
        self.refresh(input, settings, || Ok(make())).expect("this stage cannot fail")
    }

    /// Drops the output; asked for again, it is made again.
    pub(super) fn forget(&mut self) {
        self.last = None;
    }

    pub(super) fn output(&self) -> &Output {
        &self.last.as_ref().expect("the stage was run before its output is asked for").2
    }
}
