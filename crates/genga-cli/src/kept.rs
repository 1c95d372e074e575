//! What stays from run to run (前の修正): the corrections in the recipe of the results folder, unless `--fresh` or a recipe
//! with others, and its settings, unless `--fresh` or another recipe.

use std::path::Path;

use super::failure::Failure;
use super::files;
use super::found_settings::Found;
use super::listed::{list, shortened_list};
use super::plan::Plan;
use genga::edits::Edits;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_files::Run;

/// Lays a run's settings and corrections over those of the previous run in the same folder, of whose settings targets found
/// some. Returns notes on what was kept and dropped.
pub(super) fn keep(
    plan: &mut Plan<'_>,
    (folder, found): (&Path, &Found),
    engine: &Engine,
) -> Result<Vec<String>, Failure> {
    let path = folder.join(Run::RECIPE);
    let Ok(text) = std::fs::read_to_string(&path) else { return Ok(vec![]) };
    let (settings, before) =
        Recipe::parse(&text).map_err(files::fault_of(&path)).map_err(|failure| {
            Failure::AskedWrongly(format!(
                "{failure}; its corrections cannot be kept: --fresh goes without"
            ))
        })?;
    plan.stay_on(&settings, found, &path)?;
    let (listed, from) = (list(&before), path.display());
    let usable = usable(before, &plan.recipe, engine)?;
    let has_place = list(&usable);
    let lost: Vec<String> = listed.iter().filter(|one| !has_place.contains(one)).cloned().collect();
    if !lost.is_empty() {
        return Err(Failure::AskedWrongly(format!(
            "{from} has corrections of frames or layers that this run does not have, and would lose them: {}; --trim and \
             --layers as before keep them, --out gives this run a folder of its own, --fresh goes without",
            shortened_list(lost)
        )));
    }
    plan.edits = plan.over(usable);
    let now = list(&plan.edits);
    let (kept, gone): (Vec<_>, Vec<_>) = listed.into_iter().partition(|one| now.contains(one));
    if !kept.is_empty() {
        plan.earlier.keep_corrections(&path);
    }
    let said = [
        (kept, format!("kept from {from} (--fresh goes without)")),
        (gone, format!("of {from}, replaced")),
    ];
    let said = said.into_iter().filter(|(which, _)| !which.is_empty());
    Ok(said.map(|(which, what)| format!("{what}: {}", shortened_list(which))).collect())
}

/// Says which corrections of the previous run in a folder a recipe with others leaves out.
pub(super) fn left_out(folder: &Path, edits: &Edits) -> Option<String> {
    let path = folder.join(Run::RECIPE);
    let (_, before) = Recipe::parse(&std::fs::read_to_string(&path).ok()?).ok()?;
    let now = list(edits);
    let gone: Vec<String> = list(&before).into_iter().filter(|one| !now.contains(one)).collect();
    (!gone.is_empty()).then(|| {
        format!(
            "the recipe has corrections of its own, without these of {}: {}",
            path.display(),
            shortened_list(gone)
        )
    })
}

/// Leaves out what this part of the clip, or these layers, do not have.
fn usable(before: Edits, recipe: &Recipe, engine: &Engine) -> Result<Edits, Failure> {
    let clip = engine.clip();
    let layers = recipe.layers.split(clip)?;
    let mut before = before.within(clip.first(), clip.last());
    before.layers.retain(|name, _| layers.iter().any(|layer| layer.name == *name));
    Ok(before)
}
