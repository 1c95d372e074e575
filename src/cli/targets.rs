//! `--keys`, `--max-error` and `--drawings-per-second`: settings by what is wanted of the sheet.

use super::args::{Corrections, TargetArgs};
use super::failure::Failure;
use super::words::Words;
use crate::edits::Edits;
use crate::error::Error;
use crate::pipeline::Engine;
use crate::recipe::{KNOBS, Recipe};
use crate::target::{self, Met, Target};

/// Refuses a target for the number of keys where none are to be found.
pub(super) fn check(args: &TargetArgs, corrections: &Corrections) -> Result<(), Failure> {
    let of_keys = |target: &&Target| !matches!(target, Target::DrawingsPerSecond(_));
    match targets(args).iter().find(of_keys) {
        Some(target) if corrections.only_pins == Some(true) => Err(Failure::AskedWrongly(format!(
            "--{}: cannot be asked for together with --only-pins, which wants no keys but your own; leave one of \
                 them out",
            target.name()
        ))),
        _ => Ok(()),
    }
}

/// Puts the settings that were found into the recipe, and says which. Gives what a person should know: a
/// sentence for each target that could not be met.
pub(super) fn meet(
    args: &TargetArgs,
    engine: &mut Engine,
    recipe: &mut Recipe,
    edits: &Edits,
    words: &Words,
) -> Result<Vec<String>, Failure> {
    let targets = targets(args);
    if targets.is_empty() {
        return Ok(vec![]);
    }
    let met = target::meet(engine, recipe, edits, &targets).map_err(|error| match error {
        // A target's own mistake, by its option; one of the recipe by its setting.
        Error::Setting { name, message } if targets.iter().any(|target| target.name() == name) => {
            Failure::AskedWrongly(format!("--{name}: {message}"))
        }
        other => other.into(),
    })?;
    let changed = changes(recipe, &met.recipe)?.join(" ");
    let settings = if changed.is_empty() { "nothing to change" } else { &changed };
    match furthest_off(&met) {
        Some(error) => {
            words.say(format_args!("found       {settings}; furthest off {error:.2} %"));
        }
        None if changed.is_empty() => {}
        None => words.say(format_args!("found       {settings}")),
    }
    *recipe = met.recipe;
    let short = met.outcomes.iter().filter(|outcome| outcome.shortfall.is_some());
    Ok(short.map(ToString::to_string).collect())
}

/// The largest error, where one was asked for and reached: nothing else on a screen says it.
fn furthest_off(met: &Met) -> Option<f64> {
    let mut met_ones = met.outcomes.iter().filter(|outcome| outcome.shortfall.is_none());
    let of_error = met_ones.find(|outcome| matches!(outcome.target, Target::MaxError(_)));
    of_error.map(|outcome| outcome.reached)
}

fn targets(args: &TargetArgs) -> Vec<Target> {
    let keys = args.keys.map(Target::Keys);
    let drawings = args.drawings_per_second.map(Target::DrawingsPerSecond);
    let error = args.max_error.map(Target::MaxError);
    keys.into_iter().chain(error).chain(drawings).collect()
}

/// The settings that are no longer what they were, as `--set` takes them.
fn changes(before: &Recipe, after: &Recipe) -> Result<Vec<String>, Error> {
    let mut changed = Vec::new();
    for knob in KNOBS {
        let now = after.get(knob.name)?;
        if before.get(knob.name)? != now {
            changed.push(format!("{}={now}", knob.name));
        }
    }
    Ok(changed)
}
