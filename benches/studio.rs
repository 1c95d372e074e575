//! The cost of a frame of the studio, and of a turned knob until the picture has changed, without a window:
//! `cargo bench -p genga-benches --features studio --bench studio`.
//!
//! One round is the chain from that knob on, and the frame that shows the result with its triangles, in a window of
//! 1440 × 900. A frame at 60 Hz has 16.7 ms.

use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use divan::Bencher;
use egui::{Context, Pos2, RawInput, Rect, vec2};
use genga_studio::{ClipsAlone, Language, Studio};

#[path = "common/body.rs"]
mod body;

const FRAMES: [usize; 3] = [129, 5_000, 20_000];

fn main() {
    divan::main();
}

/// Draws a frame and returns the number of tessellated primitives.
fn frame(context: &Context, studio: &mut Studio) -> usize {
    let screen = Rect::from_min_size(Pos2::ZERO, vec2(1440.0, 900.0));
    let input = RawInput { screen_rect: Some(screen), ..RawInput::default() };
    let mut output = context.run_ui(input, |ui| studio.ui(ui));
    output.textures_delta.clear();
    let drawn = context.tessellate(output.shapes, output.pixels_per_point);
    drawn.len()
}

/// A studio with a swinging body of so many frames on the table.
fn opened(frames: usize) -> (Context, Studio) {
    let context = Context::default();
    let desk = ClipsAlone(move |_: &Path| Ok(body::swinging(frames)));
    let mut studio = Studio::new(Arc::new(desk), Language::English);
    studio.open(Path::new("made.bvh"), None);
    while studio.document().is_none() {
        frame(&context, &mut studio);
        thread::sleep(Duration::from_millis(5));
    }
    // The panels arrive one by one.
    for _ in 0..10 {
        frame(&context, &mut studio);
    }
    (context, studio)
}

/// Turns a knob back and forth between two values.
fn turned(bencher: Bencher<'_, '_>, frames: usize, knob: &str, values: [&str; 2]) {
    let (context, mut studio) = opened(frames);
    let mut turn = 0;
    bencher.bench_local(|| {
        turn += 1;
        studio.turn(knob, values[turn % 2]).expect("a value of the knob");
        frame(&context, &mut studio)
    });
}

/// Draws the window again with nothing changed: the strip of genga over the whole take, views and sheet.
#[divan::bench(args = FRAMES, sample_count = 40)]
fn window_drawn(bencher: Bencher<'_, '_>, frames: usize) {
    let (context, mut studio) = opened(frames);
    bencher.bench_local(|| frame(&context, &mut studio));
}

/// Reruns from the filter on, the longest path.
#[divan::bench(args = FRAMES, sample_count = 40)]
fn filter_width_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "filter.width", ["0.1s", "0.11s"]);
}

/// Reruns from the choice of keys on.
#[divan::bench(args = FRAMES, sample_count = 40)]
fn min_price_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "keys.min_price", ["3", "3.1"]);
}

/// Reruns from spacing on.
#[divan::bench(args = FRAMES, sample_count = 40)]
fn spacing_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "spacing.weight", ["0.3", "0.31"]);
}
