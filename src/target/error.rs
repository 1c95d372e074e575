//! The target of a largest error: few keys that keep the body's error below it.

use super::{Outcome, Shortfall, Target, key_count_search, reasons};
use crate::edits::{Edits, Forbidden};
use crate::error::Error;
use crate::keys::{Fill, Merge, Rank};
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::time::Frame;

/// The highest price tried, in % of body height.
const HIGHEST: f64 = 100.0;

/// Ratio of neighbouring prices, and of neighbouring numbers of keys.
const STEP: f64 = 1.09;

/// Finds settings with few keys that keep the error at or below `most`, in % of body height. If there are none, returns
/// those with the fewest keys among those with the fewest koma beyond it.
///
/// The error is not monotonic: one more key may increase it somewhere, so bisection is unsafe. Settings are tried in
/// even steps from few keys to many, and the first that suffices is returned.
pub(super) fn meet(
    engine: &mut Engine,
    recipe: &Recipe,
    edits: &Edits,
    most: f64,
) -> Result<(Recipe, Outcome), Error> {
    let mut best: Option<(usize, Recipe)> = None;
    for rung in rungs(engine, recipe, edits)? {
        let errors = engine.reconstruction(&rung, edits)?.errors;
        let beyond = errors.iter().filter(|error| **error > most).count();
        if best.as_ref().is_none_or(|(least, _)| beyond < *least) {
            best = Some((beyond, rung));
        }
        if beyond == 0 {
            break;
        }
    }
    let mut recipe = recipe.clone();
    if let Some((_, best)) = best
        && keys(engine, &best, edits)? != keys(engine, &recipe, edits)?
    {
        recipe = best;
    }
    let rebuilt = engine.reconstruction(&recipe, edits)?;
    let reached = rebuilt.worst();
    let shortfall = (reached > most).then(|| {
        let koma = rebuilt.errors.iter().position(|error| *error == reached).unwrap_or(0);
        let worst = engine.clip().clock(recipe.rate).frame_from_koma(koma);
        let beyond = rebuilt.errors.iter().filter(|error| **error > most).count();
        let all = rebuilt.errors.len();
        let why = too_far(&recipe, edits, worst);
        Shortfall::new(
            format!("on {beyond} of {all} koma {why}"),
            format!("{all}コマ中{beyond}コマで{}", why.japanese()),
        )
    });
    Ok((recipe, Outcome { target: Target::MaxError(most), reached, shortfall }))
}

/// Returns the prices to try, down to 0.
pub(super) fn prices() -> impl Iterator<Item = f64> {
    let prices = std::iter::successors(Some(HIGHEST), |price| Some(price / STEP));
    // Three decimals tell two rungs apart and stay readable.
    let rounded = prices.map(|price| (1000.0 * price).round() / 1000.0);
    rounded.take_while(|price| *price > 0.05).chain([0.0])
}

/// Returns the settings from few keys to all.
fn rungs(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Result<Vec<Recipe>, Error> {
    let mut all = recipe.clone();
    all.keys.per_second = f64::INFINITY;
    if recipe.keys.rank == Rank::Price {
        let priced = |min_price| {
            let mut rung = all.clone();
            rung.keys.min_price = min_price;
            rung
        };
        return Ok(prices().map(priced).collect());
    }
    let most = key_count_search::count_found(engine, &all, edits)?;
    let more = |count: &usize| Some((count + 1).max((*count as f64 * STEP) as usize));
    let counts = std::iter::successors(Some(0), more).take_while(|count| *count < most);
    let rungs: Result<Vec<_>, _> =
        counts.map(|count| key_count_search::with_found(engine, recipe, edits, count)).collect();
    Ok(rungs?.into_iter().chain([all]).collect())
}

fn keys(engine: &mut Engine, recipe: &Recipe, edits: &Edits) -> Result<Vec<Frame>, Error> {
    Ok(engine.find_keys(recipe, edits)?.keys.keys.iter().map(|key| key.frame).collect())
}

/// Explains why some koma exceed the error, names the worst frame, and suggests a remedy.
fn too_far(recipe: &Recipe, edits: &Edits, worst: Frame) -> Shortfall {
    let (why, japanese) = if let Some(why) = reasons::settled(edits) {
        (format!("it is further off: {why}"), format!("超える。{}", why.japanese()))
    } else {
        let limits = reasons::limits(recipe, edits);
        let within = limits.japanese();
        match (recipe.keys.merge, recipe.keys.fill) {
            (Merge::Body, Fill::On) => (
                format!("no keys a koma apart{limits} come nearer"),
                format!("超える。{within}毎コマ原画にしても近づかない"),
            ),
            (Merge::Body, Fill::Off) => (
                format!("no turn of the body{limits} comes nearer"),
                format!("超える。{within}ほかの全身の変わり目でも近づかない"),
            ),
            _ => (
                format!("no key where a joint turns{limits} comes nearer"),
                format!("超える。{within}ほかの部位の変わり目でも近づかない"),
            ),
        }
    };
    let (way, helps) = match edits.forbidden.contains(&Forbidden::one(worst)) {
        true => (", which is forbidden", "、そこは禁止"),
        false => (": a pin there helps", "、そこを固定すると減る"),
    };
    Shortfall::new(
        format!("{why}; the worst is near frame {worst}{way}"),
        format!("{japanese}。最大はフレーム{worst}付近{helps}"),
    )
}
