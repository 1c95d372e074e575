//! The chain, stage by stage and as a whole, on a synthetic body: `cargo bench --bench chain`.
//!
//! First a table: the time of each stage in ns per frame·joint, in CPU time where the system tells it.
//! Then what is run again when one knob is turned, as items (frames ×
//! joints) a second.

#![allow(clippy::print_stdout)]

use std::time::Instant;

use divan::Bencher;
use divan::counter::ItemsCount;
use genga::edits::Edits;
use genga::keys::{self, JointTurns, Reference};
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::signal::Spectrum;
use genga::time::{Frame, FrameRate};
use genga::timing::Stills;
use glam::DVec3;

const JOINTS: usize = 31;
const FRAMES: [usize; 4] = [129, 1_000, 5_000, 100_000];

fn main() {
    if std::env::args().all(|argument| argument != "--test" && argument != "--list") {
        print_shares();
    }
    divan::main();
}

/// Five limbs that swing at rates of their own, at 120 frames a second.
fn clip(frames: usize) -> Clip {
    let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
    let joint = |joint: usize| Joint {
        name: format!("joint_{joint}"),
        parent: (joint > 0).then(|| JointId(if joint % 6 == 1 { 0 } else { joint - 1 })),
        offset: DVec3::new(0.0, 20.0, 3.0),
        channels: rotations.to_vec(),
        first_channel: 3 * joint,
        end_sites: if joint.is_multiple_of(6) {
            vec![EndSite { name: "Site".into(), offset: DVec3::Y }]
        } else {
            vec![]
        },
    };
    let skeleton = Skeleton { joints: (0..JOINTS).map(joint).collect() };
    let angle = |frame: usize, channel: usize| {
        let time = frame as f64 / 120.0;
        let rate = 0.4 + 0.07 * channel as f64;
        30.0 * (std::f64::consts::TAU * rate * time).sin() * (0.3 * time + channel as f64).cos()
    };
    let values = (0..frames)
        .flat_map(|frame| (0..3 * JOINTS).map(move |channel| angle(frame, channel)))
        .collect();
    let rate = FrameRate::new(120.0).expect("a rate");
    Clip::new(skeleton, rate, Frame(0), frames, values).expect("a whole table")
}

/// Nanoseconds that this thread has run; those on the clock where the system does not tell.
fn now(begin: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let ran = told.as_deref().and_then(|text| text.split(' ').next()?.parse().ok());
    ran.unwrap_or_else(|| begin.elapsed().as_nanos() as f64)
}

/// The times of one run of the chain, stage after stage.
struct Stopwatch {
    begin: Instant,
    last: f64,
    laps: Vec<(&'static str, f64)>,
}

impl Stopwatch {
    fn start() -> Self {
        let begin = Instant::now();
        Self { begin, last: now(begin), laps: Vec::new() }
    }

    fn lap(&mut self, stage: &'static str) {
        let time = now(self.begin);
        self.laps.push((stage, time - self.last));
        self.last = now(self.begin);
    }
}

/// One run over a clip, each stage by itself, and the whole by the engine.
fn timed(clip: &Clip) -> Vec<(&'static str, f64)> {
    let recipe = Recipe::default();
    let mut watch = Stopwatch::start();
    let speed = recipe.speed.measure(clip).expect("a clip with motion");
    watch.lap("speeds");
    let spectrum = Spectrum::of(&speed);
    watch.lap("spectrum");
    let filtered = recipe.filter.apply(&spectrum);
    watch.lap("filter");
    let delay = recipe.filter.delay(clip.rate());
    let turns = recipe.turns.find(&filtered, delay);
    watch.lap("turns");
    let clock = clip.clock(recipe.rate);
    let joints = JointTurns {
        filtered: &filtered,
        turns: &turns,
        finder: &recipe.turns,
        delay,
        weights: &keys::weights(clip),
        apart: clock.frames_in_koma(),
    };
    let candidates = recipe.keys.candidates(&joints);
    watch.lap("merge");
    let reference = Reference::of(clip, clock);
    watch.lap("reference");
    let keys = recipe.keys.choose(clip, &reference, &candidates, &joints, &Edits::default());
    watch.lap("rests, prices");
    let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
    let spaced = recipe.spacing.place(&keys, clip.skeleton(), clock, koma);
    watch.lap("spacing");
    let stills = Stills::of(clip, &spaced.layer);
    watch.lap("stills");
    let omitted = recipe.omission.apply(&spaced.layer, &stills, recipe.spacing.on);
    watch.lap("omission");
    drop(omitted);
    let mut engine = Engine::new(clip.clone()).expect("a clip with motion");
    watch.last = now(watch.begin);
    engine.run(&recipe, &Edits::default()).expect("defaults run");
    watch.lap("whole");
    watch.laps
}

/// The table of shares: a row a stage, a column a length of clip.
fn print_shares() {
    let columns: Vec<Vec<(&str, f64)>> = FRAMES.iter().map(|frames| means(*frames)).collect();
    print!("{:<16}", "ns/frame·joint");
    FRAMES.iter().for_each(|frames| print!("{frames:>10}"));
    println!();
    for stage in 0..columns[0].len() {
        print!("{:<16}", columns[0][stage].0);
        columns.iter().for_each(|column| print!("{:>10.2}", column[stage].1));
        println!();
    }
    println!();
}

/// The mean of many rounds for each stage: the system counts a thread's time in steps of some
/// milliseconds, and a mean over steps is exact where a median is not.
fn means(frames: usize) -> Vec<(&'static str, f64)> {
    let clip = clip(frames);
    let count = (1_000_000 / frames).clamp(8, 2000);
    let rounds: Vec<_> = (0..count).map(|_| timed(&clip)).collect();
    let mean = |stage: usize| {
        let sum: f64 = rounds.iter().map(|round| round[stage].1).sum();
        (rounds[0][stage].0, sum / (count * frames * JOINTS) as f64)
    };
    (0..rounds[0].len()).map(mean).collect()
}

/// What is run again when one knob was turned on an engine that ran before.
fn turned(bencher: Bencher<'_, '_>, frames: usize, knob: &str, values: [&str; 2]) {
    let mut engine = Engine::new(clip(frames)).expect("a clip with motion");
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

/// From the smoothing on: filter, turns, keys, spacing, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn filter_width_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "filter.width", ["0.1s", "0.11s"]);
}

/// From the choice of keys on: prices, spacing, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn min_price_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "keys.min_price", ["3", "3.1"]);
}

/// From spacing on: spacing, positions of the drawings, omission.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn spacing_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "spacing.weight", ["0.3", "0.31"]);
}

/// Omission alone.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn omission_turned(bencher: Bencher<'_, '_>, frames: usize) {
    turned(bencher, frames, "omission.koma_dori", ["30%", "31%"]);
}
