//! Computes the map (調査): a study of both settings of the smoothing.

use std::sync::Arc;

use genga::motion::Clip;
use genga::pipeline::Budget;
use genga::recipe::Recipe;
use genga::time::FrameRate;
use genga_lab::study::{Axis, Grid, Measure, Study};

/// Settings on the axes, those of Table 1 [KT11 §4].
pub(super) const WIDTH: &str = "filter.width";
pub(super) const PERSISTENCE: &str = "turns.persistence";

/// Number of values on an axis.
const STEPS: usize = 10;
/// Step between two values in seconds. The axes include the values of the paper: 10, 20, 30 and 5, 10 frames at 100
/// fps.
const WIDTH_STEP: f64 = 0.05;
const PERSISTENCE_STEP: f64 = 0.025;

/// The study around a recipe, in the units that the recipe uses. `None` if an axis cannot be built.
///
/// The study is the same for every width and persistence of the recipe, and for all settings that do not affect the
/// count. Changing those requires no new map.
pub(super) fn study(recipe: &Recipe, rate: FrameRate, measure: Measure) -> Option<Study> {
    let axis = |name: &str, step: f64| {
        let is_seconds = recipe.get(name).ok()?.ends_with('s');
        Axis::new(name, &values(step, is_seconds, rate)).ok()
    };
    let (x, y) = (axis(WIDTH, WIDTH_STEP)?, axis(PERSISTENCE, PERSISTENCE_STEP)?);
    let mut base = match measure {
        Measure::Union | Measure::Total => Recipe {
            speed: recipe.speed.clone(),
            filter: recipe.filter.clone(),
            turns: recipe.turns.clone(),
            ..Recipe::default()
        },
        Measure::Turns => Recipe {
            filter: recipe.filter.clone(),
            turns: recipe.turns.clone(),
            layers: recipe.layers.clone(),
            seen_from: recipe.seen_from,
            exaggerate: recipe.exaggerate.clone(),
            rate: recipe.rate,
            ..Recipe::default()
        },
        _ => recipe.clone(),
    };
    base.filter.width = Recipe::default().filter.width;
    base.turns.persistence = Recipe::default().turns.persistence;
    Some(Study {
        recipe: base,
        x,
        y: Some(y),
        measures: vec![measure],
        keep_keys: false,
        budget: Budget::default(),
    })
}

/// The values of an axis, separated by commas.
fn values(step: f64, is_seconds: bool, rate: FrameRate) -> String {
    let value = |at: usize| match is_seconds {
        true => format!("{}s", (at as f64 * step * 1000.0).round() / 1000.0),
        false => (at as f64 * (step * rate.fps()).round().max(1.0)).to_string(),
    };
    (1..=STEPS).map(value).collect::<Vec<_>>().join(",")
}

/// Measures one cell per step, without parallelism, since the other cores are for the window.
pub(super) fn steps(
    study: Study,
    clip: Arc<Clip>,
) -> impl FnMut() -> Option<Result<Grid, String>> + Send {
    let mut walk = study.begin(clip);
    move || {
        let step = walk
            .as_mut()
            .map_err(|error| error.to_string())
            .and_then(|walk| walk.step().map_err(|error| error.to_string()));
        step.transpose()
    }
}

/// Position of a value on an axis: 0 for the first value, 1 for the second. Values beyond the ends are clamped.
pub(super) fn place(axis: &Axis, value: &str) -> Option<f64> {
    let (values, unit) = axis.scale()?;
    let value: f64 = value.strip_suffix(unit)?.parse().ok()?;
    let after = values.partition_point(|own| *own < value);
    let (Some(before), Some(next)) = (after.checked_sub(1), values.get(after)) else {
        return Some(after.min(values.len() - 1) as f64);
    };
    Some(before as f64 + (value - values[before]) / (next - values[before]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rate(fps: f64) -> FrameRate {
        FrameRate::new(fps).unwrap()
    }

    #[test]
    fn the_papers_values_are_on_the_axes_in_either_unit() {
        assert!(values(WIDTH_STEP, true, rate(30.0)).starts_with("0.05s,0.1s,0.15s,0.2s,"));
        assert_eq!(values(WIDTH_STEP, false, rate(100.0)), "5,10,15,20,25,30,35,40,45,50");
        assert!(values(PERSISTENCE_STEP, false, rate(100.0)).starts_with("3,6,"));
        assert!(values(PERSISTENCE_STEP, false, rate(24.0)).starts_with("1,2,3,"));
    }

    #[test]
    fn a_map_is_the_same_wherever_in_it_the_recipe_stands() {
        let of = |settings: &[(&str, &str)], measure| {
            let mut recipe = Recipe::default();
            settings.iter().for_each(|(knob, value)| recipe.set(knob, value).unwrap());
            study(&recipe, rate(120.0), measure).unwrap()
        };
        let here = of(&[], Measure::Union);
        assert_eq!(of(&[(WIDTH, "0.4s"), (PERSISTENCE, "0.2s")], Measure::Union), here);
        assert_eq!(of(&[("spacing.on", "3")], Measure::Union), here, "turns know no spacing");
        assert_ne!(of(&[("spacing.on", "3")], Measure::Drawings), of(&[], Measure::Drawings));
        assert_ne!(of(&[("filter.kind", "gaussian")], Measure::Union), here);
        assert_ne!(of(&[(WIDTH, "12")], Measure::Union), here, "in frames");
    }

    #[test]
    fn a_value_stands_between_its_neighbours_and_at_the_ends_of_the_axis() {
        let axis = Axis::new(WIDTH, "0.1s,0.2s,0.4s").unwrap();
        for (value, at) in
            [("0.1s", 0.0), ("0.3s", 1.5), ("0.4s", 2.0), ("0.01s", 0.0), ("9s", 2.0)]
        {
            assert!((place(&axis, value).unwrap() - at).abs() < 1e-9, "{value}");
        }
        assert_eq!(place(&axis, "12"), None, "frames are no seconds");
    }
}
