//! The chain, stage by stage and as a whole, on a synthetic body: `cargo bench -p genga-benches --bench chain`.
//!
//! Prints a Markdown table: CPU time in ns per frame·joint, median of the rounds. `-- 5000` measures only that number
//! of frames.

#![allow(clippy::print_stdout, reason = "it prints a table")]

use std::time::Instant;

use genga::edits::Edits;
use genga::keys::{self, Alike, BodyTurns, Chords, JointTurns, Judges, Reference};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::signal::Spectrum;
use genga::timing::{Pace, Stills};

#[path = "common/body.rs"]
mod body;
#[path = "common/cpu.rs"]
mod cpu;

use body::{JOINTS, swinging};

const FRAMES: [usize; 4] = [129, 1_000, 5_000, 100_000];

fn main() {
    let mut asked: Vec<usize> = std::env::args().filter_map(|frames| frames.parse().ok()).collect();
    if asked.is_empty() {
        asked = FRAMES.to_vec();
    }
    let columns: Vec<Vec<(&str, f64)>> = asked.iter().map(|frames| medians(*frames)).collect();
    let header: Vec<String> = asked.iter().map(usize::to_string).collect();
    println!("| ns per frame·joint | {} frames |", header.join(" | "));
    println!("| --- |{}", " ---: |".repeat(asked.len()));
    for (stage, (name, _)) in columns[0].iter().enumerate() {
        let cells: Vec<String> =
            columns.iter().map(|column| format!("{:.1}", column[stage].1)).collect();
        println!("| {name} | {} |", cells.join(" | "));
    }
}

/// The median time of each stage over many rounds.
fn medians(frames: usize) -> Vec<(&'static str, f64)> {
    let clip = swinging(frames);
    let count = (1_000_000 / frames).clamp(9, 500);
    let rounds: Vec<_> = (0..count).map(|_| timed(&clip)).collect();
    let median = |stage: usize| {
        let mut times: Vec<f64> = rounds.iter().map(|round| round[stage].1).collect();
        times.sort_by(f64::total_cmp);
        (rounds[0][stage].0, times[count / 2] / (frames * JOINTS) as f64)
    };
    (0..rounds[0].len()).map(median).collect()
}

/// The times of one run of the chain, stage by stage.
struct Stopwatch {
    begin: Instant,
    last: f64,
    laps: Vec<(&'static str, f64)>,
}

impl Stopwatch {
    fn start() -> Self {
        let begin = Instant::now();
        Self { begin, last: cpu::nanos(begin), laps: Vec::new() }
    }

    fn lap(&mut self, stage: &'static str) {
        let time = cpu::nanos(self.begin);
        self.laps.push((stage, time - self.last));
        self.last = cpu::nanos(self.begin);
    }
}

/// Runs each stage on a clip by itself, and then the whole chain with the engine.
fn timed(clip: &Clip) -> Vec<(&'static str, f64)> {
    let recipe = Recipe::default();
    let mut watch = Stopwatch::start();
    let speed = recipe.speed.measure(clip).expect("a clip with motion");
    watch.lap("speeds");
    let spectrum = Spectrum::new(&speed);
    watch.lap("spectrum");
    let filtered = recipe.filter.apply(&spectrum);
    watch.lap("filter");
    let delay = recipe.filter.delay(clip.rate());
    let turns = recipe.turns.find(&filtered, delay);
    watch.lap("turns");
    let clock = clip.clock(recipe.rate);
    let reference = Reference::new(clip, clock);
    watch.lap("reference");
    let body = BodyTurns::new(clip, &reference, &recipe.filter, &recipe.turns);
    watch.lap("turns of the body");
    let joints = JointTurns {
        filtered: &filtered,
        turns: &turns,
        weights: &keys::weights(clip),
        apart: clock.frames_in_koma(),
        contacts: &[],
        body: &body,
    };
    let candidates = recipe.keys.candidates(&joints);
    watch.lap("candidates");
    let own = vec![1.0; clip.skeleton().len()];
    let chords = Chords::new(clip, &reference, &own, recipe.keys.span());
    watch.lap("chords");
    let judges = Judges { reference: &reference, chords: &chords, alike: &Alike::default() };
    let keys = recipe.keys.choose(clip, judges, &candidates, &joints, &Edits::default());
    watch.lap("rests, keys");
    let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
    let spaced = recipe.spacing.place(&keys, clip.skeleton(), clock, koma, &Pace::default());
    watch.lap("spacing");
    let stills = Stills::from_layer(clip, &spaced.layer);
    watch.lap("stills");
    let omitted = recipe.omission.apply(&spaced.layer, &stills, recipe.spacing.on.most);
    watch.lap("omission");
    drop(omitted);
    let mut engine = Engine::new(clip.clone()).expect("a clip with motion");
    watch.last = cpu::nanos(watch.begin);
    engine.run(&recipe, &Edits::default()).expect("defaults run");
    watch.lap("whole");
    watch.laps
}
