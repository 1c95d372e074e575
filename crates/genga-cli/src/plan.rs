//! The plan of a run: the motion, the recipe with a person's corrections, and the targets of the sheet.

use std::path::Path;

use clap::Args;

use super::clip::ClipArgs;
use super::console::Words;
use super::corrections::Corrections;
use super::earlier_settings::EarlierSettings;
use super::failure::Failure;
use super::found_settings::{self, Found};
use super::paths::named;
use super::{camera_args, files, freeze_args, pin_args, sheets, whose_corrections};
use genga::edits::Edits;
use genga::error::{Error, Warning};
use genga::motion::Description;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga::target::{self, Met, Target};
use genga_files::ClipMark;

/// Arguments for a clip, its corrections and its targets.
#[derive(Debug, Clone, Args)]
pub(super) struct PlanArgs {
    #[command(flatten)]
    targets: TargetArgs,
    #[command(flatten)]
    pub(super) corrections: Corrections,
    #[command(flatten)]
    pub(super) clip: ClipArgs,
}

/// Properties that the sheet must reach; a search finds the settings.
#[derive(Debug, Clone, Args)]
pub(super) struct TargetArgs {
    /// Number of genga, the first and the last drawing included.
    ///
    /// Pins and fixed keys (ends of rests) count too. Overrides keys.min_price and keys.per_second.
    #[arg(long, value_name = "N", value_parser = genga, allow_negative_numbers = true)]
    keys: Option<usize>,
    /// As few keys as stay within this error: 5% of body height.
    ///
    /// The body is slerped from key to key, and the worst koma counts. Overrides keys.min_price and keys.per_second.
    #[arg(long, value_name = "P%", value_parser = percent, allow_negative_numbers = true, conflicts_with = "keys")]
    max_error: Option<f64>,
    /// Number of drawings per second.
    ///
    /// It is reached with koma-dori, then spacing.on, naka-nashi and, unless it is given, the number of keys.
    #[arg(long, value_name = "X", value_parser = drawings, allow_negative_numbers = true)]
    drawings_per_second: Option<f64>,
}

/// Parses a share of body height. A number below 1 without % is refused, since it might be a fraction.
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

/// The settings and corrections of a run.
pub(super) struct Plan<'a> {
    args: &'a PlanArgs,
    pub(super) recipe: Recipe,
    pub(super) edits: Edits,
    /// The corrections of the recipe that was read, without those of the command line.
    pub(super) read: Edits,
    /// Names of the settings that the recipe changes, without those of the command line.
    set: Vec<String>,
    /// Settings that stay from an earlier run.
    pub(super) earlier: EarlierSettings,
    /// Settings that the targets of this run found.
    pub(super) found: Found,
}

impl PlanArgs {
    /// Combines the arguments for a clip.
    pub(super) fn new(clip: ClipArgs, corrections: Corrections, targets: TargetArgs) -> Self {
        Self { clip, corrections, targets }
    }

    /// Returns the plan for another clip.
    pub(super) fn for_clip(&self, path: &Path) -> Self {
        let mut other = self.clone();
        other.clip.path = path.into();
        other
    }

    /// The path of the clip.
    pub(super) fn clip(&self) -> &Path {
        &self.clip.path
    }

    /// Text of all options that a sheet depends on besides recipe and corrections. It is the same wherever their files
    /// lie: a file counts by its contents.
    pub(super) fn fingerprint(&self) -> Result<String, Failure> {
        let Corrections { freeze, pin_from, seen, .. } = &self.corrections;
        let digest = |path: Option<&Path>| path.map(files::digest).transpose();
        let sheet = freeze.as_deref().map(sheets::file_of).transpose()?;
        let (frozen, marked) = (digest(sheet.as_deref())?, digest(pin_from.as_deref())?);
        let (seen, part) = (camera_args::fingerprint(seen)?, self.clip.part.fingerprint()?);
        Ok(format!("{:?}\n{frozen:?} {marked:?} {seen:?}\n{part}", self.targets))
    }
}

impl<'a> Plan<'a> {
    /// Builds a plan from a recipe and corrections already read.
    pub(super) fn with(args: &'a PlanArgs, recipe: Recipe, edits: Edits) -> Self {
        let (earlier, found) = Default::default();
        Self { args, recipe, edits, read: Edits::default(), set: vec![], earlier, found }
    }

    /// Reads the recipe, and refuses what is impossible whatever the motion is.
    pub(super) fn from_args(args: &'a PlanArgs) -> Result<Self, Failure> {
        args.targets.check(&args.corrections)?;
        let read = args.corrections.settings.read(Recipe::default())?;
        let (set, of_recipe) = (args.corrections.settings.changed(&read.0), read.1.clone());
        let (recipe, edits) = args.corrections.put_over(read)?;
        let (earlier, found) = Default::default();
        Ok(Self { args, recipe, edits, read: of_recipe, set, earlier, found })
    }

    /// Returns a function that adds a file's path to an error: that of the recipe if the fault is in it, else the
    /// clip's.
    pub(super) fn fault_of(&self, engine: &Engine) -> impl Fn(Error) -> Failure + use<> {
        let (clip, recipe) = (engine.clip(), self.args.corrections.settings.recipe.clone());
        let wrong = self.read.validate(clip.first(), clip.last()).err();
        let wrong = wrong.map(|error| error.to_string());
        let is_corrected_there = !self.read.is_empty() && self.edits == self.read;
        let (path, set) = (self.args.clip.path.clone(), self.set.clone());
        let earlier = self.earlier.clone();
        move |error| {
            let is_there = match &error {
                Error::Edits { .. } => is_corrected_there || wrong == Some(error.to_string()),
                Error::Setting { name, .. } => set.iter().any(|own| is_within(own, name)),
                _ => false,
            };
            match recipe.as_deref().filter(|_| is_there) {
                Some(recipe) => {
                    Failure::AskedWrongly(format!("{}: {error}", named(recipe).display()))
                }
                None => earlier.fault_among(error, &path),
            }
        }
    }

    /// Says whose corrections the recipe has, if they are of another motion.
    pub(super) fn of_another(&self, clip: &ClipMark) -> Option<String> {
        let recipe = self.args.corrections.settings.recipe.as_deref()?;
        whose_corrections::of_another(recipe, &self.read, clip)
    }

    /// Reads the motion and the camera. Warnings go to `note`. Also returns the mark that identifies the motion.
    pub(super) fn read(
        &mut self,
        note: &mut dyn FnMut(&Warning),
    ) -> Result<(Engine, ClipMark), Failure> {
        let source = self.args.clip.read()?;
        let (seen_from, notes) = camera_args::asked(&self.args.corrections.seen, &source.clip)?;
        self.recipe.seen_from = seen_from.unwrap_or(self.recipe.seen_from);
        let body = Description::notes(&source.clip);
        source.notes.iter().chain(&notes).chain(&body).for_each(note);
        let engine = Engine::new(source.clip)?.with_budget(self.args.clip.budget());
        Ok((engine, source.of))
    }

    /// Lays the settings of the command line over those of an earlier run, whose recipe is `from`, unless a recipe is
    /// named. A target begins without the settings that one before it found.
    pub(super) fn stay_on(
        &mut self,
        earlier: &Recipe,
        found: &Found,
        from: &Path,
    ) -> Result<(), Failure> {
        let corrections = &self.args.corrections;
        if corrections.settings.recipe.is_some() {
            return Ok(());
        }
        let start = match self.args.targets.targets().is_empty() {
            true => earlier.clone(),
            false => found_settings::taken_back(earlier, found)?,
        };
        let seen_from = self.recipe.seen_from;
        (self.recipe, self.edits) =
            corrections.put_over(corrections.settings.read(start.clone())?)?;
        if camera_args::is_asked(&corrections.seen) {
            self.recipe.seen_from = seen_from;
        }
        self.earlier = EarlierSettings::new(from, earlier, &start, &self.recipe);
        Ok(())
    }

    /// Returns the corrections over those of an earlier run. A number of keys that is asked for now overrules switches
    /// that leave none to find.
    pub(super) fn over(&self, earlier: Edits) -> Edits {
        let earlier = match self.args.targets.of_keys() {
            None => earlier,
            Some(_) => Edits { only_pins: false, ..earlier.without_frozen() },
        };
        self.args.corrections.over(self.edits.clone(), earlier)
    }

    /// Adds the keys that are marked in a file, and finds the settings that meet the targets.
    pub(super) fn settle(
        &mut self,
        engine: &mut Engine,
        words: &Words,
        note: &mut dyn FnMut(String),
    ) -> Result<(), Failure> {
        let fault = self.fault_of(engine);
        let Self { args, recipe, edits, found, .. } = self;
        freeze_args::freeze(&args.corrections, engine, recipe, edits)?
            .into_iter()
            .for_each(&mut *note);
        let met = match &args.corrections.pin_from {
            None => args.meet(engine, (recipe, edits), &fault)?,
            Some(file) => args.pin_marked(file, engine, (recipe, edits), (&fault, note))?,
        };
        args.tell(&met, recipe, words)?.into_iter().for_each(&mut *note);
        *found = found_settings::between(recipe, &met.recipe)?.into_iter().collect();
        *recipe = met.recipe;
        recipe.doubts(engine.clip()).into_iter().for_each(note);
        Ok(())
    }
}

impl PlanArgs {
    /// Pins those keys marked in a file that the sheet would not have, and finds the settings that meet the targets with
    /// them.
    fn pin_marked(
        &self,
        file: &Path,
        engine: &mut Engine,
        (recipe, edits): (&Recipe, &mut Edits),
        (fault, note): (&dyn Fn(Error) -> Failure, &mut dyn FnMut(String)),
    ) -> Result<Met, Failure> {
        // The marked keys may be the only ones, so they are compared with a sheet that has others.
        let unmarked = Edits { only_pins: false, ..edits.clone() };
        let mut met = self.meet(engine, (recipe, &unmarked), fault)?;
        let mut sheet = sheet_of(engine, &met.recipe, &unmarked).map_err(fault)?;
        let column = self.corrections.pin_column.as_deref();
        let mut marked = pin_args::read((file, column), engine, &sheet)?;
        let layer = pin_args::layer(&marked.column, engine, recipe)?.map(String::from);
        let mut clock = engine.clip().clock(recipe.rate);
        if let Some(repeat) = sheet.repeat {
            clock.frame_rate = repeat.frame_rate(recipe.rate)?;
        }
        let place = (layer.as_deref(), clock);
        // A pin may take the place of another marked key, which is then pinned too.
        while marked.pin(&sheet, place, edits) {
            met = self.meet(engine, (recipe, edits), fault)?;
            sheet = sheet_of(engine, &met.recipe, edits).map_err(fault)?;
        }
        marked.notes(&sheet, (layer.as_deref(), edits)).into_iter().for_each(note);
        Ok(met)
    }

    /// Finds the settings that meet the targets.
    fn meet(
        &self,
        engine: &mut Engine,
        (recipe, edits): (&Recipe, &Edits),
        fault: &dyn Fn(Error) -> Failure,
    ) -> Result<Met, Failure> {
        let targets = self.targets.targets();
        if targets.is_empty() {
            return Ok(Met { recipe: recipe.clone(), outcomes: vec![] });
        }
        target::meet(engine, recipe, edits, &targets).map_err(|error| match error {
            // An error of a target is reported by its option, one of the recipe by its setting.
            Error::Setting { name, message }
                if targets.iter().any(|target| target.name() == name) =>
            {
                Failure::AskedWrongly(format!("--{name}: {message}"))
            }
            other => fault(other),
        })
    }

    /// Prints the settings that meet the targets, and returns a sentence for each target that could not be met. `recipe` has
    /// the settings before.
    fn tell(&self, met: &Met, recipe: &Recipe, words: &Words) -> Result<Vec<String>, Failure> {
        if met.outcomes.is_empty() {
            return Ok(vec![]);
        }
        let changed = found_settings::between(recipe, &met.recipe)?;
        let changed = changed.iter().map(|(name, [_, is])| format!("{name}={is}"));
        let changed = changed.collect::<Vec<_>>().join(" ");
        let settings = if changed.is_empty() { "nothing to change" } else { &changed };
        match furthest_off(met) {
            Some(error) => {
                words.say(format_args!("found       {settings}; furthest off {error:.2} %"));
            }
            None if changed.is_empty() => {}
            None => words.say(format_args!("found       {settings}")),
        }
        let short = met.outcomes.iter().filter(|outcome| outcome.shortfall.is_some());
        Ok(short.map(ToString::to_string).collect())
    }
}

impl TargetArgs {
    /// Refuses a target for the number of keys together with `--only-pins`, which finds none.
    fn check(&self, corrections: &Corrections) -> Result<(), Failure> {
        match self.of_keys() {
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

    /// The target that decides how many keys there are.
    fn of_keys(&self) -> Option<Target> {
        let of_keys = |target: &Target| !matches!(target, Target::DrawingsPerSecond(_));
        self.targets().into_iter().find(of_keys)
    }

    fn targets(&self) -> Vec<Target> {
        let keys = self.keys.map(Target::Keys);
        let drawings = self.drawings_per_second.map(Target::DrawingsPerSecond);
        let error = self.max_error.map(Target::MaxError);
        keys.into_iter().chain(error).chain(drawings).collect()
    }
}

/// Largest error of a `--max-error` that was reached: no other message prints it.
fn furthest_off(met: &Met) -> Option<f64> {
    let mut met_ones = met.outcomes.iter().filter(|outcome| outcome.shortfall.is_none());
    let of_error = met_ones.find(|outcome| matches!(outcome.target, Target::MaxError(_)));
    of_error.map(|outcome| outcome.reached)
}

/// Whether a setting is of a name or of a table of that name.
fn is_within(setting: &str, name: &str) -> bool {
    setting.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Makes the sheet.
fn sheet_of(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Result<Sheet, Error> {
    engine.run(recipe, edits).map(|breakdown| breakdown.sheet.clone())
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
