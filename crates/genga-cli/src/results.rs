//! Writes the results of a run into its folder.

use super::console::is_loss;
use super::failure::Failure;
use super::folder::{Folder, Left, Made};
use super::format_args::{Formats, Tell};
use super::found_settings::Found;
use super::staging::Bundle;
use genga::edits::Edits;
use genga::error::Warning;
use genga::pipeline::Breakdown;
use genga::recipe::Recipe;
use genga::sheet::Renumbered;
use genga_files::{ClipMark, Manifest, Report, Run, numbers_csv};
use std::path::Path;

/// Files of a run that belong to no output format.
pub(super) const OWN: [&str; 4] = [Run::SPEEDS, Run::RECIPE, Run::REPORT, Run::MANIFEST];

/// The results of a run, to be written.
pub(super) struct Results<'a> {
    pub(super) name: &'a str,
    /// Identifies the motion that the folder belongs to.
    pub(super) clip: ClipMark,
    pub(super) breakdown: &'a Breakdown<'a>,
    pub(super) recipe: &'a Recipe,
    pub(super) edits: &'a Edits,
    /// The settings that targets found.
    pub(super) found: Found,
    /// The numbers of the sheet before and of this one; empty if there is nothing to say.
    pub(super) renumbered: &'a [Renumbered],
    /// Notes for the user.
    pub(super) notes: Vec<String>,
    /// Whether `--recipe` names the recipe in the folder, which may then be overwritten.
    pub(super) is_own_recipe: bool,
    /// The files that the run read.
    pub(super) sources: Vec<&'a Path>,
    /// Why the recipe in the folder is kept as it is. `None` if it is written.
    pub(super) kept: Option<&'static str>,
    /// Callback before each file is written, which may stop the writing.
    pub(super) tell: Tell<'a>,
}

/// The outcome of a run.
pub(super) struct Outcome {
    pub(super) report: Report,
    /// The written files, as shown to the user.
    pub(super) files: Vec<String>,
    /// A warning for each format that is not made.
    pub(super) unmade: Vec<Warning>,
    /// Other files in the folder.
    pub(super) left: Left,
}

impl Results<'_> {
    /// Writes the results and the other formats asked for, but those that cannot be made: all files or none.
    pub(super) fn write(self, formats: &Formats, folder: Folder<'_>) -> Result<Outcome, Failure> {
        let Self { name, breakdown, recipe, edits, .. } = self;
        let run = Run { name, clip: &self.clip, breakdown, recipe, edits };
        folder.check(&self.clip)?;
        let mut report = Report::new(breakdown, self.notes);
        let mut bundle = Bundle::begin(folder.path())?;
        let mut written = run.with_cut(|cut| formats.write(cut, &mut bundle, self.tell))?;
        let unmade = written.said.unmade();
        let (losses, notes): (Vec<_>, Vec<_>) = written.said.notes.into_iter().partition(is_loss);
        report.losses.extend(losses.iter().chain(&unmade).map(ToString::to_string));
        report.notes.extend(notes.iter().map(ToString::to_string));
        report.notes.extend(self.kept.map(str::to_owned));
        if !self.renumbered.is_empty() {
            bundle.add(Run::NUMBERS, formats.table(numbers_csv(self.renumbered)?))?;
            written.files.push(Run::NUMBERS.to_owned());
        }
        (self.tell)(Run::SPEEDS)?;
        bundle.add(Run::SPEEDS, run.speeds()?)?;
        let settings = recipe.write(edits);
        let digest = Manifest::digest(settings.as_bytes());
        if self.kept.is_none() {
            bundle.add(Run::RECIPE, settings)?;
        }
        bundle.add(Run::REPORT, report.write()?)?;
        let made = Made {
            clip: self.clip.clone(),
            recipe: Some(digest),
            formats: formats.names(),
            settings: formats.own_settings(),
            found: self.found,
            stale: written.stale,
            adds: false,
            given: self.is_own_recipe.then_some(Run::RECIPE),
            sources: self.sources,
        };
        let left = folder.finish(bundle, made)?;
        written.files.extend(OWN.map(str::to_owned));
        Ok(Outcome { report, files: written.files, unmade, left })
    }
}
