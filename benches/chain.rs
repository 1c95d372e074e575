//! The chain, stage by stage and as a whole, on a synthetic body: `cargo bench --bench chain`.
//! Read the items a second as frames × joints a second.

use divan::Bencher;
use divan::counter::ItemsCount;
use genga::edits::Edits;
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};
use glam::DVec3;

const JOINTS: usize = 31;
const FRAMES: [usize; 3] = [129, 5_000, 100_000];

fn main() {
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

/// From the clip to the sheet, nothing kept from before.
#[divan::bench(args = FRAMES, sample_count = 5)]
fn whole(bencher: Bencher<'_, '_>, frames: usize) {
    let clip = clip(frames);
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .with_inputs(|| Engine::new(clip.clone()).expect("a clip with motion"))
        .bench_local_values(|mut engine| {
            let breakdown =
                engine.run(&Recipe::default(), &Edits::default()).expect("defaults run");
            breakdown.sheet.length()
        });
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
