//! A stage of the chain: its last output, with the inputs and settings that made it.
//!
//! A stage is made by a function that captures nothing. It sees only the outputs of other stages and its settings,
//! which are exactly what the cached output is keyed by, so no input can be forgotten.

use std::ops::Deref;
use std::sync::Arc;

use crate::error::Error;

/// The generation of a stage's output, by which a later stage knows whether it has already used it. A run may end after
/// any stage, so a flag "made in this run" would not suffice.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Made(u64);

/// The output of a stage with its generation.
#[derive(Debug)]
pub(super) struct Of<'a, T> {
    made: Made,
    value: &'a T,
}

impl<'a, T> Of<'a, T> {
    /// Wraps a value that never changes.
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

/// The outputs that a stage takes as inputs.
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

/// One input per layer.
impl<T: Inputs> Inputs for Vec<T> {
    fn made(&self) -> Vec<Made> {
        self.iter().flat_map(Inputs::made).collect()
    }
}

/// An input, and one per layer.
impl<A, T: Inputs> Inputs for (Of<'_, A>, Vec<T>) {
    fn made(&self) -> Vec<Made> {
        std::iter::once(self.0.made).chain(self.1.made()).collect()
    }
}

/// The last output of a stage, with the inputs and the settings that made it.
#[derive(Debug)]
pub(super) struct Stage<Settings, Output> {
    last: Option<Arc<Last<Settings, Output>>>,
    made: Made,
}

/// The previous output of a stage, to be reused for the next one.
pub(super) struct Before<Output> {
    pub(super) output: Output,
    /// For each input, whether it is unchanged since.
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
    /// Makes the output again if the inputs or settings changed.
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

    /// Like [`Stage::make`], for a large output: `make` receives the previous one to overwrite or reuse, unless it is
    /// shared.
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

    /// Like [`Stage::make`], for a function that can fail.
    pub(super) fn try_make<I: Inputs>(
        &mut self,
        inputs: I,
        settings: Settings,
        make: fn(I, &Settings) -> Result<Output, Error>,
    ) -> Result<(), Error> {
        let made = inputs.made();
        if !self.is_fresh(&made, &settings) {
            // Drops the old output first: if `make` fails, a later run must not mistake it for the new one.
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

    /// Drops the output; the next run makes it again.
    pub(super) fn forget(&mut self) {
        self.last = None;
    }

    /// Returns the last output; `None` if it was dropped or never made.
    pub(super) fn last(&self) -> Option<&Output> {
        self.last.as_deref().map(|last| &last.output)
    }

    /// Returns the last output.
    ///
    /// # Panics
    /// Panics if the stage was not made.
    pub(super) fn output(&self) -> Of<'_, Output> {
        let last = self.last.as_deref().expect("the stage was made before its output is asked for");
        Of { made: self.made, value: &last.output }
    }
}
