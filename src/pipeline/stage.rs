//! A stage of the chain: its last output, and what it was made of.
//!
//! A stage is made by a function that captures nothing: all it sees are outputs of other stages and its
//! settings, and those are what its output is kept by. So no input can be forgotten.

use std::ops::Deref;
use std::sync::Arc;

use crate::error::Error;

/// Which of its outputs a stage holds, so that the next stage knows whether it has used that one. A
/// run may end after any stage: whether a stage did something *in this run* would not tell.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Made(u64);

/// The output of a stage, and which one it is.
#[derive(Debug)]
pub(super) struct Of<'a, T> {
    made: Made,
    value: &'a T,
}

impl<'a, T> Of<'a, T> {
    /// What was given and never changes.
    pub(super) fn given(value: &'a T) -> Self {
        Self { made: Made(0), value }
    }

    pub(super) fn value(self) -> &'a T {
        self.value
    }
}

impl<T> Clone for Of<'_, T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Of<'_, T> {}

impl<T> Deref for Of<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        self.value
    }
}

/// Outputs that a stage is made of.
pub(super) trait Inputs {
    fn made(&self) -> Vec<Made>;
}

macro_rules! inputs {
    ($($input:ident)*) => {
        impl<$($input),*> Inputs for ($(Of<'_, $input>,)*) {
            #[allow(non_snake_case, reason = "an input is named by its type")]
            fn made(&self) -> Vec<Made> {
                let ($($input,)*) = *self;
                vec![$($input.made),*]
            }
        }
    };
}

inputs!(A);
inputs!(A B);
inputs!(A B C);
inputs!(A B C D);
inputs!(A B C D E);
inputs!(A B C D E F);
inputs!(A B C D E F G);

/// As many as there are layers.
impl<T: Inputs> Inputs for Vec<T> {
    fn made(&self) -> Vec<Made> {
        self.iter().flat_map(Inputs::made).collect()
    }
}

/// A stage's last output with the inputs and the settings that made it.
#[derive(Debug)]
pub(super) struct Stage<Settings, Output> {
    last: Option<Arc<Last<Settings, Output>>>,
    made: Made,
}

/// What a stage made last, to be used for what it makes now.
pub(super) struct Before<Output> {
    pub(super) output: Output,
    /// Of each input whether it is the one that made it.
    pub(super) same: Vec<bool>,
}

#[derive(Debug)]
struct Last<Settings, Output> {
    inputs: Vec<Made>,
    settings: Settings,
    output: Output,
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

impl<Settings: PartialEq, Output> Stage<Settings, Output> {
    /// Makes the output again if its inputs or its settings changed.
    pub(super) fn make<I: Inputs>(
        &mut self,
        inputs: I,
        settings: Settings,
        make: fn(I, &Settings) -> Output,
    ) {
        let made = inputs.made();
        if !self.is_fresh(&made, &settings) {
            let output = make(inputs, &settings);
            self.keep(made, settings, output);
        }
    }

    /// The same for a stage whose output is large: its last is handed on to be written over or used, if nobody else has
    /// it.
    pub(super) fn make_over<I: Inputs>(
        &mut self,
        inputs: I,
        settings: Settings,
        make: fn(I, &Settings, Option<Before<Output>>) -> Output,
    ) {
        let made = inputs.made();
        if !self.is_fresh(&made, &settings) {
            let last = self.last.take().and_then(Arc::into_inner);
            let before = last.map(|Last { inputs, output, .. }| {
                let same = inputs.iter().zip(&made).map(|(before, now)| before == now);
                Before { output, same: same.collect() }
            });
            let output = make(inputs, &settings, before);
            self.keep(made, settings, output);
        }
    }

    /// The same for a stage that can fail.
    pub(super) fn try_make<I: Inputs>(
        &mut self,
        inputs: I,
        settings: Settings,
        make: fn(I, &Settings) -> Result<Output, Error>,
    ) -> Result<(), Error> {
        let made = inputs.made();
        if !self.is_fresh(&made, &settings) {
            // Forgotten first: should `make` fail, a later run must not take the old output for the new.
            self.last = None;
            let output = make(inputs, &settings)?;
            self.keep(made, settings, output);
        }
        Ok(())
    }

    fn is_fresh(&self, inputs: &[Made], settings: &Settings) -> bool {
        let last = self.last.as_deref();
        last.is_some_and(|last| last.inputs == inputs && last.settings == *settings)
    }

    fn keep(&mut self, inputs: Vec<Made>, settings: Settings, output: Output) {
        self.last = Some(Arc::new(Last { inputs, settings, output }));
        self.made = Made(self.made.0 + 1);
    }

    /// Drops the output; asked for again, it is made again.
    pub(super) fn forget(&mut self) {
        self.last = None;
    }

    /// The last output; none where it was forgotten or never made.
    pub(super) fn last(&self) -> Option<&Output> {
        self.last.as_deref().map(|last| &last.output)
    }

    /// The last output.
    ///
    /// # Panics
    /// Unless the stage was made.
    pub(super) fn output(&self) -> Of<'_, Output> {
        let last = self.last.as_deref().expect("the stage was made before its output is asked for");
        Of { made: self.made, value: &last.output }
    }
}
