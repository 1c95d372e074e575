//! The real clips, each run with the defaults and with the other merges.

use std::fs;

use genga::deliver::{self, Report};
use genga::edits::Edits;
use genga::keys::Actions;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Role, Sheet};

use crate::{Outcome, real};

/// All merges, the default among them.
pub(crate) const MERGES: [&str; 4] = ["vote", "sum", "union", "body"];

/// A clip and what the chain makes of it.
pub(crate) struct Take {
    pub(crate) name: String,
    pub(crate) clip: Clip,
    /// Frames of an inserted pose that were left out.
    pub(crate) lead_in: usize,
    /// One of each merge, everything else as it is by default.
    pub(crate) runs: Vec<Run>,
}

/// What one recipe makes of a clip.
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
    /// Koma, from 0.
    pub(crate) koma: usize,
    /// Source place.
    pub(crate) place: f64,
    /// The koma nearest to its place: a drawing of two koma may begin on the one before.
    pub(crate) moment: usize,
    pub(crate) role: Role,
}

/// The real clips, by name; none where one of them is missing, for tables are of all.
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
        Take::of(name, &bytes).map_err(|error| failed(&error).into())
    };
    paths.iter().map(take).collect()
}

/// The clip of that name.
pub(crate) fn named<'a>(takes: &'a [Take], name: &str) -> Outcome<&'a Take> {
    let found = takes.iter().find(|take| take.name == name);
    found.ok_or_else(|| format!("{name} is not in the list of clips").into())
}

impl Take {
    fn of(name: String, bytes: &[u8]) -> Outcome<Self> {
        let read = bvh::read(bytes)?.clip;
        let (clip, _) = bvh::Cleaning::default().of(read)?;
        let lead_in = clip.first().0;
        let mut engine = Engine::new(clip.clone())?;
        let run = |merge| Run::of(&mut engine, merge);
        let runs = MERGES.into_iter().map(run).collect::<Outcome<_>>()?;
        Ok(Self { name, clip, lead_in, runs })
    }

    /// The run with the defaults.
    pub(crate) fn default(&self) -> &Run {
        let merge = Recipe::default().get("keys.merge").expect("it is a knob");
        self.merged(&merge)
    }

    /// The run with that merge.
    pub(crate) fn merged(&self, merge: &str) -> &Run {
        self.runs.iter().find(|run| run.merge == merge).expect("all merges were run")
    }
}

impl Run {
    fn of(engine: &mut Engine, merge: &'static str) -> Outcome<Self> {
        let mut recipe = Recipe::default();
        recipe.set("keys.merge", merge)?;
        if merge != Recipe::default().get("keys.merge")? {
            // No turn is cheaper there: about as many keys as the default has.
            recipe.set("keys.min_price", "3")?;
        }
        let breakdown = engine.run(&recipe, &Edits::default())?;
        Ok(Self {
            merge,
            report: Report::of(&breakdown, Vec::new()),
            actions: breakdown.actions.clone(),
            spaced: breakdown.spaced.clone(),
            sheet: breakdown.sheet.clone(),
            limited_bvh: deliver::limited_bvh(breakdown.clip, breakdown.sheet)?,
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
