//! The cost of rerunning after one turned knob, as items (frames × joints) a second:
//! `cargo bench -p genga-benches --bench knobs`.

use divan::Bencher;
use divan::counter::ItemsCount;
use genga::edits::Edits;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

#[path = "common/body.rs"]
mod body;

use body::{JOINTS, swinging};

const FRAMES: [usize; 3] = [129, 5_000, 100_000];

fn main() {
    divan::main();
}

/// Reruns an engine with one of two values of a knob in turn.
fn turned(bencher: Bencher<'_, '_>, frames: usize, knob: &str, values: [&str; 2]) {
    let mut engine = Engine::new(swinging(frames)).expect("a clip with motion");
    let recipes = values.map(|value| {
        let mut recipe = Recipe::default();
        recipe.set(knob, value).expect("a value of the knob");
        recipe
    });
    let mut turn = 0;
    bencher.counter(ItemsCount::new(frames * JOINTS)).bench_local(|| {
        turn += 1;
        let breakdown = engine.run(&recipes[turn % 2], &Edits::default()).expect("it runs");
        breakdown.sheet.length()
    });
}

/// Reruns from the filter on: filter, turns, keys, spacing, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn filter_width_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "filter.width", ["0.1s", "0.11s"]);
}

/// Reruns from the choice of keys on: prices, spacing, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn min_price_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "keys.min_price", ["3", "3.1"]);
}

/// Reruns from spacing on: spacing, positions of the drawings, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn spacing_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "spacing.weight", ["0.3", "0.31"]);
}

/// Reruns omission alone.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn omission_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "omission.koma_dori", ["30%", "31%"]);
}
