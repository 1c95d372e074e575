//! What a run writes into its folder.

use super::failure::Failure;
use super::files;
use super::folder::{Folder, Left, MANIFEST, Made};
use super::formats::{Formats, Tell};
use super::staging::Bundle;
use super::words::is_loss;
use crate::deliver::sheet_json::MadeWith;
use crate::deliver::{ClipMark, Cut, Manifest, Report};
use crate::edits::Edits;
use crate::error::Warning;
use crate::pipeline::Breakdown;
use crate::plot::SpeedPlot;
use crate::recipe::Recipe;
use crate::time::Frame;

/// The formats that are written whether or not they are asked for.
pub(super) const ALWAYS: [&str; 6] = ["json", "csv", "remap", "bvh", "bars", "poses"];
/// Files that are no format.
pub(super) const OWN: [&str; 4] = ["speed.svg", RECIPE, "report.json", MANIFEST];
/// The settings and corrections of the run.
pub(super) const RECIPE: &str = "recipe.toml";

/// The results of a run, to be written.
pub(super) struct Results<'a> {
    pub(super) name: &'a str,
    /// The motion, by which the folder knows it.
    pub(super) clip: ClipMark,
    pub(super) breakdown: &'a Breakdown<'a>,
    pub(super) recipe: &'a Recipe,
    pub(super) edits: &'a Edits,
    /// What a person should know.
    pub(super) notes: Vec<String>,
    /// Whether the recipe in the folder is the one that was given, so that it may be written again.
    pub(super) is_own_recipe: bool,
    /// Why the recipe in the folder stays as it is; none where it is written.
    pub(super) kept: Option<&'static str>,
    /// Who is told what is being written, and may stop it.
    pub(super) tell: Tell<'a>,
}

/// What came of it.
pub(super) struct Outcome {
    pub(super) report: Report,
    /// The files, for a person to read.
    pub(super) files: Vec<String>,
    /// What else is in the folder.
    pub(super) left: Left,
}

impl Results<'_> {
    /// Does something with the cut that a clip gave.
    pub(super) fn of_cut<T>(
        name: &str,
        clip: &ClipMark,
        breakdown: &Breakdown<'_>,
        (recipe, edits): (&Recipe, &Edits),
        work: impl FnOnce(&Cut<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let exaggerated = !recipe.exaggerate.is_off();
        work(&Cut {
            name,
            clip_file: &clip.file,
            clip: breakdown.clip,
            exaggerated: exaggerated.then_some((breakdown.source, &recipe.exaggerate)),
            sheet: breakdown.sheet,
            spaced: Some(breakdown.spaced),
            splits: &breakdown.actions.koma(breakdown.clock),
            made_with: Some(&MadeWith::of(recipe, edits, breakdown.sheet)),
        })
    }

    /// Writes them with what else is asked for: all files, or none.
    pub(super) fn write(
        self,
        formats: &mut Formats,
        folder: Folder<'_>,
    ) -> Result<Outcome, Failure> {
        let Self { breakdown, recipe, edits, .. } = self;
        folder.check(&self.clip)?;
        let mut report = Report::of(breakdown, self.notes);
        let mut bundle = Bundle::begin(folder.path())?;
        let of = (recipe, edits);
        let mut written = Self::of_cut(self.name, &self.clip, breakdown, of, |cut| {
            let (losses, notes): (Vec<Warning>, _) =
                formats.settle(cut)?.into_iter().partition(is_loss);
            report.losses.extend(losses.iter().map(ToString::to_string));
            report.notes.extend(notes.iter().map(ToString::to_string));
            report.notes.extend(self.kept.map(str::to_owned));
            formats.write(cut, &mut bundle, self.tell)
        })?;
        (self.tell)("speed.svg")?;
        bundle.add("speed.svg", speeds(self.name, breakdown)?)?;
        let settings = recipe.write(edits);
        let digest = Manifest::digest(settings.as_bytes());
        if self.kept.is_none() {
            bundle.add(RECIPE, settings)?;
        }
        bundle.add("report.json", files::json(&"report.json", &report)?)?;
        let made = Made {
            clip: self.clip.clone(),
            recipe: Some(digest),
            stale: written.stale,
            adds: false,
            given: self.is_own_recipe.then_some(RECIPE),
        };
        let left = folder.finish(bundle, made)?;
        written.files.extend(OWN.map(str::to_owned));
        Ok(Outcome { report, files: written.files, left })
    }
}

/// Speeds before and after the filter with keys and walls, of the joints that move most.
fn speeds(clip: &str, breakdown: &Breakdown<'_>) -> Result<String, Failure> {
    let names: Vec<&str> =
        breakdown.clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
    // The kept drawings of the sheet, so that their numbers are those of the key table.
    let kept = breakdown.sheet.layers[0].drawings.iter().filter(|drawing| drawing.role.is_kept());
    let keys: Vec<Frame> =
        kept.map(|drawing| Frame(drawing.source.place().round() as usize)).collect();
    let Breakdown { speed, filtered, turns, .. } = breakdown;
    let order = filtered.movers_first(breakdown.clip.skeleton());
    let splits = breakdown.actions.splits().iter().map(|split| split.frame).collect();
    let plot = SpeedPlot { clip: clip.to_owned(), splits, ..SpeedPlot::default() };
    Ok(plot.draw(&names, speed, filtered, turns, &keys, &order)?)
}
