//! The results that every run hands over (一回の結果), whatever formats are requested.

use super::sheet_json::MadeWith;
use super::{ClipMark, Cut};
use genga::edits::Edits;
use genga::error::Error;
use genga::pipeline::Breakdown;
use genga::recipe::Recipe;
use genga::time::Frame;
use genga_plot::SpeedPlot;

/// A run: a clip, its recipe and corrections, and the result.
#[derive(Debug, Clone, Copy)]
pub struct Run<'a> {
    /// The name of the cut.
    pub name: &'a str,
    /// The identity of the motion.
    pub clip: &'a ClipMark,
    /// All results of the pipeline.
    pub breakdown: &'a Breakdown<'a>,
    /// The settings of the run.
    pub recipe: &'a Recipe,
    /// The corrections of the run.
    pub edits: &'a Edits,
}

impl Run<'_> {
    /// The formats that every run writes.
    pub const FORMATS: [&'static str; 6] = ["json", "csv", "remap", "bvh", "bars", "poses"];
    /// The file with settings and corrections.
    pub const RECIPE: &'static str = "recipe.toml";
    /// The table of numbers that come from the run before, if there is anything to say: see
    /// [`numbers_csv`](super::numbers_csv).
    pub const NUMBERS: &'static str = "numbers.csv";
    /// The picture of [`Run::speeds`].
    pub const SPEEDS: &'static str = "speed.svg";
    /// The file of its [`Report`](super::Report).
    pub const REPORT: &'static str = "report.json";
    /// The file of its [`Manifest`](super::Manifest), which lists all others.
    pub const MANIFEST: &'static str = "manifest.json";

    /// Calls `work` with the run's cut.
    pub fn with_cut<T>(&self, work: impl FnOnce(&Cut<'_>) -> T) -> T {
        let Self { breakdown, recipe, edits, .. } = self;
        let exaggerated = !recipe.exaggerate.is_off();
        work(&Cut {
            name: self.name,
            clip_file: &self.clip.file,
            clip: breakdown.clip,
            exaggerated: exaggerated.then_some((breakdown.source, &recipe.exaggerate)),
            sheet: breakdown.sheet,
            spaced: Some(breakdown.spaced),
            splits: &breakdown.actions.koma(breakdown.clock),
            made_with: Some(&MadeWith::new(recipe, edits, breakdown.sheet)),
        })
    }

    /// Draws the speeds of the joints that move most, before and after the filter, with keys and walls.
    ///
    /// # Errors
    /// The errors of [`SpeedPlot::draw`].
    pub fn speeds(&self) -> Result<String, Error> {
        let Breakdown { speed, filtered, turns, clip, sheet, actions, .. } = self.breakdown;
        let names: Vec<&str> =
            clip.skeleton().joints.iter().map(|joint| joint.name.as_str()).collect();
        // Take the sheet's kept drawings, so that the numbers match those of the key table.
        let layer = &sheet.layers[0];
        let kept = layer.drawings.iter().filter(|drawing| drawing.role.is_kept());
        let numbers = layer.genga_numbers().into_iter().flatten().collect();
        let keys: Vec<Frame> =
            kept.map(|drawing| Frame(drawing.source.place().round() as usize)).collect();
        let order = filtered.movers_first(clip.skeleton());
        let splits = actions.splits().iter().map(|split| split.frame).collect();
        let clip = self.name.to_owned();
        let plot = SpeedPlot { clip, splits, numbers, ..SpeedPlot::default() };
        plot.draw(&names, speed, filtered, turns, &keys, &order)
    }
}
