//! The real clips, each run with the defaults and with the other merges.

use std::fs;

use genga::edits::Edits;
use genga::keys::Actions;
use genga::motion::clean::Cleaning;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Role, Sheet};
use genga_files::Report;

use crate::{Outcome, real};

/// All merges, the default among them.
pub(crate) const MERGES: [&str; 3] = ["vote", "union", "body"];

/// A clip and the chain's results for it.
pub(crate) struct Take {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    /// Frames of a removed lead-in pose.
    pub(crate) lead_in: usize,
    /// One run per merge, with defaults otherwise.
    pub(crate) runs: Vec<Run>,
}

/// The results of one recipe for a clip.
pub(crate) struct Run {
    pub(crate) merge: &'static str,
    pub(crate) report: Report,
    pub(crate) actions: Actions,
    pub(crate) spaced: Sheet,
    pub(crate) sheet: Sheet,
    pub(crate) limited_bvh: String,
    /// Source places of the drawings that naka-nashi left out.
    pub(crate) omitted: Vec<f64>,
}

/// A drawing on the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shown {
    /// First koma on the sheet, from 0.
    pub(crate) koma: usize,
    /// Source place.
    pub(crate) place: f64,
    /// Koma nearest to the source place. A drawing of two koma may begin on the one before.
    pub(crate) moment: usize,
    pub(crate) role: Role,
}

/// Reads and runs all real clips, in order of name. Empty if one of them is missing, because the tables cover all.
pub(crate) fn all() -> Outcome<Vec<Take>> {
    let folder = real::folder();
    let paths = real::NAMES.map(|name| folder.join(name).with_extension("bvh"));
    if !paths.iter().all(|path| path.is_file()) {
        return Ok(Vec::new());
    }
    let take = |path: &std::path::PathBuf| {
        let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = fs::read(path).map_err(|error| failed(&error))?;
        Take::new(name, &bytes).map_err(|error| failed(&error).into())
    };
    paths.iter().map(take).collect()
}

/// Finds a clip by name.
pub(crate) fn named<'a>(takes: &'a [Take], name: &str) -> Outcome<&'a Take> {
    let found = takes.iter().find(|take| take.name == name);
    found.ok_or_else(|| format!("{name} is not in the list of clips").into())
}

impl Take {
    fn new(name: String, bytes: &[u8]) -> Outcome<Self> {
        let read = bvh::read(bytes)?.clip;
        let (clip, _) = Cleaning::default().apply(read)?;
        let lead_in = clip.first().0;
        let mut engine = Engine::new(clip.clone())?;
        let run = |merge| Run::new(&mut engine, merge);
        let runs = MERGES.into_iter().map(run).collect::<Outcome<_>>()?;
        Ok(Self { name, clip, lead_in, runs })
    }

    /// The run with the defaults.
    pub(crate) fn default(&self) -> &Run {
        let merge = Recipe::default().get("keys.merge").expect("it is a knob");
        self.merged(&merge)
    }

    /// The run with the given merge.
    pub(crate) fn merged(&self, merge: &str) -> &Run {
        self.runs.iter().find(|run| run.merge == merge).expect("all merges were run")
    }
}

impl Run {
    fn new(engine: &mut Engine, merge: &'static str) -> Outcome<Self> {
        let mut recipe = Recipe::default();
        recipe.set("keys.merge", merge)?;
        if merge != Recipe::default().get("keys.merge")? {
            // This merge has no cheaper turns; the price gives about as many keys as the default.
            recipe.set("keys.min_price", "3")?;
        }
        let breakdown = engine.run(&recipe, &Edits::default())?;
        Ok(Self {
            merge,
            report: Report::new(&breakdown, Vec::new()),
            actions: breakdown.actions.clone(),
            spaced: breakdown.spaced.clone(),
            sheet: breakdown.sheet.clone(),
            limited_bvh: genga_files::limited_bvh(breakdown.clip, breakdown.sheet)?,
            omitted: breakdown
                .first_layer()
                .omission
                .naka_nashi
                .gone
                .iter()
                .map(|gone| gone.place)
                .collect(),
        })
    }

    /// The genga of the sheet, without the ends.
    pub(crate) fn genga(&self) -> Vec<Shown> {
        let mut genga = kept(&self.sheet);
        genga.retain(|shown| shown.role == Role::Genga);
        genga
    }
}

/// The genga and ends of a sheet.
pub(crate) fn kept(sheet: &Sheet) -> Vec<Shown> {
    let layer = &sheet.layers[0];
    let shown = layer.timed().map(|(koma, exposure)| {
        let drawing = &layer.drawings[exposure.drawing];
        let place = drawing.source.place();
        Shown { koma, place, moment: sheet.clock.koma_from_place(place), role: drawing.role }
    });
    shown.filter(|shown| shown.role.is_kept()).collect()
}
