//! What is asked of a clip: the motion, the recipe with a person's corrections, and what the sheet is to be.

use std::path::Path;

use clap::Args;

use super::clip::ClipArgs;
use super::corrections::Corrections;
use super::failure::Failure;
use super::words::Words;
use super::{files, frozen, pins, seen};
use crate::deliver::ClipMark;
use crate::edits::Edits;
use crate::error::{Error, Warning};
use crate::motion::Description;
use crate::pipeline::Engine;
use crate::recipe::{KNOBS, Recipe};
use crate::target::{self, Met, Target};

/// The motion, and all that is asked of it, whichever clip it is.
#[derive(Debug, Clone, Args)]
pub(super) struct PlanArgs {
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    #[command(flatten)]
    pub(super) corrections: Corrections,
    #[command(flatten)]
    targets: TargetArgs,
}

/// What the sheet is to be, instead of the settings that make it so.
#[derive(Debug, Clone, Args)]
pub(super) struct TargetArgs {
    /// So many genga on the sheet: with pins, what stays by itself (ends of rests), and the first and the last drawing; over
    /// keys.min_price and keys.per_second.
    #[arg(long, value_name = "N", value_parser = genga, allow_negative_numbers = true)]
    keys: Option<usize>,
    /// Few keys with which the body, slerped from key to key, is nowhere further off than that share
    /// of its height: 5%; over keys.min_price and keys.per_second.
    #[arg(long, value_name = "P%", value_parser = percent, allow_negative_numbers = true, conflicts_with = "keys")]
    max_error: Option<f64>,
    /// So many drawings a second: found with koma-dori, then spacing.on, naka-nashi and the number of keys
    /// where that is not asked for.
    #[arg(long, value_name = "X", value_parser = drawings, allow_negative_numbers = true)]
    drawings_per_second: Option<f64>,
}

/// A share of body height. Without its % a number below 1 might be a fraction.
fn percent(text: &str) -> Result<f64, String> {
    let (number, has_sign) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), true),
        None => (text.trim(), false),
    };
    let share: f64 = number
        .parse()
        .map_err(|_| format!("expected a share of body height (5%), found \"{text}\""))?;
    if !has_sign && share > 0.0 && share < 1.0 {
        let hundredfold = (share * 1e8).round() / 1e6;
        return Err(format!(
            "{number} may mean {number}% or {hundredfold}% of the body's height; write the one you mean with its %"
        ));
    }
    Ok(share)
}

fn genga(text: &str) -> Result<usize, String> {
    let wrong =
        || format!("expected a whole number of genga, 0 or more, as in 24, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

fn drawings(text: &str) -> Result<f64, String> {
    let wrong = || format!("expected drawings a second, above 0, as in 8 or 6.5, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

/// The settings and corrections with which the chain is to run.
pub(super) struct Plan<'a> {
    args: &'a PlanArgs,
    pub(super) recipe: Recipe,
    pub(super) edits: Edits,
}

impl PlanArgs {
    /// What is asked of a clip.
    pub(super) fn of(clip: ClipArgs, corrections: Corrections, targets: TargetArgs) -> Self {
        Self { clip, corrections, targets }
    }

    /// The same of another clip.
    pub(super) fn for_clip(&self, path: &Path) -> Self {
        let mut other = self.clone();
        other.clip.path = path.into();
        other
    }

    /// The clip.
    pub(super) fn clip(&self) -> &Path {
        &self.clip.path
    }

    /// Files that say something of the sheet, besides the recipe.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        let Corrections { freeze, pin_from, seen, .. } = &self.corrections;
        let sheet = freeze.as_deref().filter(|path| path.is_file());
        sheet.into_iter().chain(pin_from.as_deref()).chain(seen::file(seen))
    }
}

impl<'a> Plan<'a> {
    /// A plan of which recipe and corrections are read.
    pub(super) fn with(args: &'a PlanArgs, recipe: Recipe, edits: Edits) -> Self {
        Self { args, recipe, edits }
    }

    /// Reads the recipe, and refuses what cannot be without a look at the motion.
    pub(super) fn of(args: &'a PlanArgs) -> Result<Self, Failure> {
        args.targets.check(&args.corrections)?;
        let (recipe, edits) = args.corrections.read()?;
        Ok(Self { args, recipe, edits })
    }

    /// Reads the motion, and from where it is seen. Whatever a person should know goes to `note`. Gives the mark of the
    /// motion too.
    pub(super) fn read(
        &mut self,
        note: &mut dyn FnMut(&Warning),
    ) -> Result<(Engine, ClipMark), Failure> {
        let source = self.args.clip.read()?;
        let (seen_from, notes) = seen::asked(&self.args.corrections.seen, &source.clip)?;
        self.recipe.seen_from = seen_from.unwrap_or(self.recipe.seen_from);
        let body = Description::notes(&source.clip);
        source.notes.iter().chain(&notes).chain(&body).for_each(note);
        let engine = Engine::new(source.clip)?.with_budget(self.args.clip.budget());
        Ok((engine, source.of))
    }

    /// Adds the keys that are marked in a file, and finds the settings that give what the sheet is to be.
    pub(super) fn settle(
        &mut self,
        engine: &mut Engine,
        words: &Words,
        note: &mut dyn FnMut(String),
    ) -> Result<(), Failure> {
        let Self { args, recipe, edits } = self;
        frozen::freeze(&args.corrections, engine, recipe, edits)?.into_iter().for_each(&mut *note);
        pins::marked(&args.corrections, engine, recipe, edits)?.into_iter().for_each(&mut *note);
        args.meet(engine, recipe, edits, words)?.into_iter().for_each(note);
        Ok(())
    }
}

impl PlanArgs {
    /// Puts the settings that were found into the recipe, and says which. Gives what a person should know: a
    /// sentence for each target that could not be met.
    fn meet(
        &self,
        engine: &mut Engine,
        recipe: &mut Recipe,
        edits: &Edits,
        words: &Words,
    ) -> Result<Vec<String>, Failure> {
        let targets = self.targets.targets();
        if targets.is_empty() {
            return Ok(vec![]);
        }
        let met = target::meet(engine, recipe, edits, &targets).map_err(|error| match error {
            // A target's own mistake, by its option; one of the recipe by its setting.
            Error::Setting { name, message }
                if targets.iter().any(|target| target.name() == name) =>
            {
                Failure::AskedWrongly(format!("--{name}: {message}"))
            }
            other => files::fault_of(&self.clip.path)(other),
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
}

impl TargetArgs {
    /// Refuses a target for the number of keys where none are to be found.
    fn check(&self, corrections: &Corrections) -> Result<(), Failure> {
        let of_keys = |target: &&Target| !matches!(target, Target::DrawingsPerSecond(_));
        match self.targets().iter().find(of_keys) {
            Some(target) if corrections.only_pins == Some(true) => {
                Err(Failure::AskedWrongly(format!(
                    "--{}: cannot be asked for together with --only-pins, which wants no keys but your own; leave one of \
                     them out",
                    target.name()
                )))
            }
            Some(target) if corrections.freeze.is_some() => Err(Failure::AskedWrongly(format!(
                "--{}: cannot be asked for together with --freeze, which keeps the keys of a sheet; leave one of them out",
                target.name()
            ))),
            _ => Ok(()),
        }
    }

    fn targets(&self) -> Vec<Target> {
        let keys = self.keys.map(Target::Keys);
        let drawings = self.drawings_per_second.map(Target::DrawingsPerSecond);
        let error = self.max_error.map(Target::MaxError);
        keys.into_iter().chain(error).chain(drawings).collect()
    }
}

/// The largest error, where one was asked for and reached: nothing else on a screen says it.
fn furthest_off(met: &Met) -> Option<f64> {
    let mut met_ones = met.outcomes.iter().filter(|outcome| outcome.shortfall.is_none());
    let of_error = met_ones.find(|outcome| matches!(outcome.target, Target::MaxError(_)));
    of_error.map(|outcome| outcome.reached)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_of_body_height_has_its_sign_where_it_could_be_a_fraction() {
        for (text, share) in [("5%", 5.0), ("5", 5.0), (" 0.5 % ", 0.5), ("1", 1.0), ("0", 0.0)] {
            assert_eq!(percent(text), Ok(share), "{text}");
        }
        assert!(percent("0.02").unwrap_err().contains("0.02% or 2% of"));
        for wrong in ["2%%", "%", "", "5 %x"] {
            assert!(percent(wrong).unwrap_err().contains("(5%)"), "{wrong}");
        }
    }
}
