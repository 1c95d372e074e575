//! Any motion that the reader accepts: the chain refuses it, or returns a sheet of its length and keeps within its
//! budget.

use genga::edits::Edits;
use genga::motion::bvh;
use genga::motion::clean::Cleaning;
use genga::pipeline::{Breakdown, Budget, Engine};
use genga::recipe::Recipe;

use super::measure::{self, Bound};

/// Bytes of memory for a run. Thousands of joints or of koma fit.
const BUDGET: usize = 24 << 20;

/// Most numbers of a limited motion that is written and read again.
const MOST_WRITTEN: usize = 40_000;

/// Panics if the check fails.
pub(super) fn check(bytes: &[u8]) {
    let Ok(read) = bvh::read(bytes) else { return };
    let (clip, _) = Cleaning::default().apply(read.clip).expect("all frames are asked for");
    let recipe = Recipe::default();
    let budget = Budget { bytes: Some(BUDGET as f64) };
    let Ok(engine) = Engine::new(clip) else { return };
    let mut engine = engine.with_budget(budget);
    measure::measured(bytes.len(), Bound { most: BUDGET, unit: BUDGET }, || {
        if let Ok(breakdown) = engine.run(&recipe, &Edits::default()) {
            check_sheet(&breakdown, &recipe);
        }
    });
    if let Ok(breakdown) = engine.run(&recipe, &Edits::default()) {
        check_limited(&breakdown);
    }
}

fn check_sheet(breakdown: &Breakdown, recipe: &Recipe) {
    let clip = breakdown.clip;
    let koma = clip.rate().koma_from_frames(clip.len(), recipe.rate);
    assert_eq!(breakdown.spaced.length(), koma, "the spaced sheet");
    if recipe.omission.keep_length {
        assert_eq!(breakdown.sheet.length(), koma, "the sheet");
    }
}

fn check_limited(breakdown: &Breakdown) {
    let koma = breakdown.sheet.length();
    if koma * (1 + breakdown.clip.skeleton().channels()) > MOST_WRITTEN {
        return;
    }
    let text =
        genga_files::limited_bvh(breakdown.clip, breakdown.sheet).expect("the limited motion");
    let limited = bvh::read(text.as_bytes()).expect("the limited motion reads").clip;
    assert_eq!(limited.len(), koma, "rows of the limited motion");
}
