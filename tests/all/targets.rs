//! Targets on every real clip: met exactly, or within one drawing.

use genga::edits::Edits;
use genga::keys::Choose;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Role;
use genga::target::{Met, Target, meet};

use crate::clips;

/// Every real clip, and those of `data/` where there are no others.
fn each(look: impl Fn(&str, &mut Engine)) {
    let mut paths = clips::real();
    paths.extend(["kick", "pitch"].map(|name| clips::here(&format!("data/{name}.bvh"))));
    for path in paths {
        look(&clips::name(&path), &mut Engine::new(clips::read(&path)).unwrap());
    }
}

fn met(engine: &mut Engine, targets: &[Target]) -> Met {
    meet(engine, &Recipe::default(), &Edits::default(), targets).unwrap()
}

/// Genga and drawings on the sheet of a recipe, and its seconds.
fn figures(engine: &mut Engine, recipe: &Recipe) -> (usize, usize, f64) {
    let breakdown = engine.run(recipe, &Edits::default()).unwrap();
    let layer = &breakdown.sheet.layers[0];
    (layer.count(Role::Genga), layer.shown().count(), layer.length() as f64 / 24.0)
}

#[test]
fn genga_are_as_many_as_asked_for() {
    each(|name, engine| {
        let bound = |min_price, per_second| Recipe {
            keys: Choose { min_price, per_second, ..Choose::default() },
            ..Recipe::default()
        };
        let fewest = figures(engine, &bound(1e9, 1e-9)).0;
        let (most, _, seconds) = figures(engine, &bound(0.0, f64::INFINITY));
        assert!(most as f64 > 10.0 * seconds, "{name}: {most} keys fit");
        let some = (0..12).map(|step| fewest + (most - fewest) * step / 11);
        for count in some.chain([24]).filter(|count| (fewest..=most).contains(count)) {
            let met = met(engine, &[Target::Keys(count)]);
            assert_eq!(figures(engine, &met.recipe).0, count, "{name}");
            assert_eq!(met.outcomes[0].shortfall, None, "{name}");
        }
        let beyond = met(engine, &[Target::Keys(most + 1)]);
        assert_eq!(figures(engine, &beyond.recipe).0, most, "{name}");
        assert!(beyond.outcomes[0].shortfall.is_some(), "{name}");
    });
}

#[test]
fn drawings_are_within_one_of_those_asked_for() {
    each(|name, engine| {
        for rate in [24.0, 20.0, 16.0, 12.0, 10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0, 2.5] {
            let met = met(engine, &[Target::DrawingsPerSecond(rate)]);
            let (_, drawings, seconds) = figures(engine, &met.recipe);
            let wanted = rate * seconds;
            let far = (drawings as f64 - wanted).abs();
            assert!(far <= 1.0, "{name}: {drawings} of {wanted:.1} at {rate} a second");
            assert!(far <= 0.5 || rate < 4.0, "{name}: {drawings} of {wanted:.1}");
            assert_eq!(met.outcomes[0].shortfall, None, "{name}");
        }
    });
}

#[test]
fn the_body_is_nowhere_further_off_than_asked_for() {
    each(|name, engine| {
        let edits = Edits::default();
        let mut fewest = 0;
        for most in [20.0, 10.0, 5.0, 2.0] {
            let met = met(engine, &[Target::MaxError(most)]);
            let rebuilt = engine.reconstruction(&met.recipe, &edits).unwrap();
            let left = rebuilt.errors.iter().filter(|error| **error > most).count();
            assert!(left == 0 || most < 5.0, "{name}: {left} koma beyond {most}");
            assert_eq!(met.outcomes[0].shortfall.is_some(), left > 0, "{name}: {most}");
            let found = engine.run(&met.recipe, &edits).unwrap().keys.keys.iter();
            let found = found.filter(|key| key.origin.is_found()).count();
            assert!(found >= fewest, "{name}: {found} keys for {most} %, and {fewest} for more");
            fewest = found;
            let mut cheaper = met.recipe.clone();
            cheaper.keys.min_price = 1.2 * cheaper.keys.min_price + 0.06;
            let errors = engine.reconstruction(&cheaper, &edits).unwrap().errors;
            let same = met.recipe == Recipe::default();
            let fewer = engine.find_keys(&cheaper, &edits).unwrap().keys.keys.len() < found;
            let beyond = errors.iter().filter(|error| **error > most).count();
            assert!(beyond > left || same || !fewer, "{name}: {most} at a higher price");
        }
    });
}

#[test]
fn keys_and_drawings_are_met_together() {
    each(|name, engine| {
        let seconds = figures(engine, &Recipe::default()).2;
        let count = (4.0 * seconds).round() as usize;
        let met = met(engine, &[Target::Keys(count), Target::DrawingsPerSecond(8.0)]);
        let (genga, drawings, seconds) = figures(engine, &met.recipe);
        assert_eq!(genga, count, "{name}");
        assert!((drawings as f64 - 8.0 * seconds).abs() <= 1.0, "{name}: {drawings}");
    });
}
