//! Targets on every real clip: met exactly, or within one drawing.

use genga::edits::Edits;
use genga::keys::{AtGaits, AtRests, Choose, Key, Reference};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Exposure, Role};
use genga::target::{Met, Target, meet};

use crate::clips;

/// Passes every real clip and some of `data/`, so that there are clips in any case.
fn each(look: impl Fn(&str, &mut Engine)) {
    let mut paths = clips::all();
    paths.extend(["kick", "pitch"].map(|name| clips::here(&format!("data/{name}.bvh"))));
    for path in paths {
        look(&clips::name(&path), &mut Engine::new(clips::read(&path)).unwrap());
    }
}

fn met(engine: &mut Engine, targets: &[Target]) -> Met {
    meet(engine, &Recipe::default(), &Edits::default(), targets).unwrap()
}

/// The default recipe with other exposures: on ones, keys may be a koma apart.
fn on(koma: &str) -> Recipe {
    let mut recipe = Recipe::default();
    recipe.set("spacing.on", koma).unwrap();
    recipe
}

/// Number of genga with both ends, number of drawings on the sheet, and its seconds.
fn figures(engine: &mut Engine, recipe: &Recipe) -> (usize, usize, f64) {
    let breakdown = engine.run(recipe, &Edits::default()).unwrap();
    let layer = &breakdown.sheet.layers[0];
    (layer.genga(), layer.shown().count(), layer.length() as f64 / 24.0)
}

#[test]
fn genga_are_as_many_as_asked_for() {
    each(|name, engine| ["1", "2"].iter().for_each(|koma| genga_are_met(name, engine, koma)));
}

fn genga_are_met(name: &str, engine: &mut Engine, koma: &str) {
    let recipe = on(koma);
    let bound = |min_price, per_second| Recipe {
        keys: Choose {
            min_price,
            per_second,
            at_rests: AtRests::Off,
            gaits: AtGaits::Off,
            ..Choose::default()
        },
        ..recipe.clone()
    };
    let fewest = figures(engine, &bound(1e9, 1e-9)).0;
    let (most, _, seconds) = figures(engine, &bound(0.0, f64::INFINITY));
    let fit = if koma == "1" { 10.0 } else { 6.0 };
    assert!(most as f64 > fit * seconds, "{name}: {most} keys fit");
    let mut met = |count| meet(engine, &recipe, &Edits::default(), &[Target::Keys(count)]).unwrap();
    let some = (0..12).map(|step| fewest + (most - fewest) * step / 11);
    let some: Vec<Met> =
        some.chain([24]).filter(|count| (fewest..=most).contains(count)).map(&mut met).collect();
    let beyond = met(most + 1);
    for met in some {
        assert_eq!(met.outcomes[0].target, Target::Keys(figures(engine, &met.recipe).0), "{name}");
        assert_eq!(met.outcomes[0].shortfall, None, "{name}");
    }
    assert_eq!(figures(engine, &beyond.recipe).0, most, "{name}");
    assert!(beyond.outcomes[0].shortfall.is_some(), "{name}");
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
        for most in [16.0, 8.0, 4.0, 1.6] {
            let met = meet(engine, &on("1"), &edits, &[Target::MaxError(most)]).unwrap();
            let rebuilt = engine.reconstruction(&met.recipe, &edits).unwrap();
            let left = rebuilt.errors.iter().filter(|error| **error > most).count();
            // A turn is drawn on its own frame and leaves no room for a key on the koma beside it.
            assert!(left < 2 || most < 4.0, "{name}: {left} koma beyond {most}");
            assert_eq!(met.outcomes[0].shortfall.is_some(), left > 0, "{name}: {most}");
            let keys = engine.run(&met.recipe, &edits).unwrap().first_layer().keys.keys.clone();
            let all = keys.len();
            assert!(all >= fewest, "{name}: {all} keys for {most} %, and {fewest} for more");
            fewest = all;
            let found = keys.iter().filter(|key| key.origin.is_found()).count();
            let mut cheaper = met.recipe.clone();
            cheaper.keys.min_price = 1.2 * cheaper.keys.min_price + 0.06;
            let errors = engine.reconstruction(&cheaper, &edits).unwrap().errors;
            let same = met.recipe == on("1");
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

#[test]
fn genga_go_before_anything_that_moves_is_held_for_eight_koma() {
    each(|name, engine| {
        for rate in [8.0, 7.0, 6.0] {
            let met = met(engine, &[Target::DrawingsPerSecond(rate)]);
            let breakdown = engine.run(&met.recipe, &Edits::default()).unwrap();
            let layer = &breakdown.sheet.layers[0];
            let reference = Reference::new(breakdown.clip, breakdown.clock);
            let moving = |(begin, shown): (usize, Exposure)| {
                let place = layer.drawings[shown.drawing].source.place();
                let own = breakdown.clock.koma_from_place(place).min(reference.koma() - 1);
                let is_elsewhere = |koma: &usize| reference.unlike(own, *koma) >= 3.3;
                (begin..begin + shown.koma).filter(is_elsewhere).count()
            };
            let longest = layer.timed().map(moving).max().unwrap_or(0);
            assert!(longest < 8, "{name}: {longest} koma at {rate} a second");
            let is_found = |key: &&Key| key.origin.is_found();
            let found = breakdown.first_layer().keys.keys.iter().filter(is_found).count();
            let (genga, drawings) = (layer.count(Role::Genga), layer.shown().count());
            let is_mixed = genga as f64 <= 0.75 * drawings as f64 + 1.0;
            assert!(is_mixed || found == 0, "{name}: {genga} of {drawings} at {rate} a second");
        }
    });
}
