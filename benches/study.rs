//! A study of 50 filter widths and 20 persistences, as cells a second: `cargo bench -p genga-benches --bench study`.

use divan::Bencher;
use divan::counter::ItemsCount;
use genga::pipeline::Budget;
use genga::recipe::Recipe;
use genga_lab::study::{Axis, Measure, Noise, Study, table_1_recipe};

#[path = "common/body.rs"]
mod body;

use body::swinging;

const FRAMES: usize = 5_000;

fn main() {
    divan::main();
}

fn study(bencher: Bencher<'_, '_>, recipe: Recipe, degrees: f64, measures: &[Measure]) {
    let axis = |text: &str| text.parse::<Axis>().expect("an axis");
    let study = Study {
        recipe,
        x: axis("filter.width=2..100:2"),
        y: Some(axis("turns.persistence=1..20:1")),
        measures: measures.to_vec(),
        keep_keys: false,
        budget: Budget::default(),
    };
    // Captures are noisy: without noise there are few turns to count.
    let clip = std::sync::Arc::new(Noise { degrees, seed: 0 }.on(&swinging(FRAMES)));
    bencher.counter(ItemsCount::new(study.len())).bench_local(|| {
        study.run(std::sync::Arc::clone(&clip), || ()).expect("it runs").cells.len()
    });
}

const NOISE: [f64; 2] = [0.0, 0.1];

/// Turns counted over all joints, with the recipe of Table 1.
#[divan::bench(args = NOISE, sample_count = 5)]
fn union_and_total(bencher: Bencher<'_, '_>, degrees: f64) {
    study(bencher, table_1_recipe(), degrees, &[Measure::Union, Measure::Total]);
}

/// Genga counted on the sheet, with the recipe of a run. This also measures the merge and the choice by price.
#[divan::bench(args = NOISE, sample_count = 3)]
fn genga(bencher: Bencher<'_, '_>, degrees: f64) {
    study(bencher, Recipe::default(), degrees, &[Measure::Genga]);
}
