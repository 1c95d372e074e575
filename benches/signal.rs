//! Speeds, filters and turns on clips of three sizes.
//!
//! `cargo bench -p genga-benches --bench signal`; one item is one joint at one frame.
#![allow(missing_docs)]

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use genga::motion::{Axis, Channel, Clip, Joint, JointId, Skeleton};
use genga::signal::{FilterKind, LowPass, Signals, Spectrum, Speed, TurnFinder};
use genga::time::{Frame, FrameRate};

const JOINTS: usize = 31;
const FRAMES: [usize; 3] = [129, 5_000, 100_000];

fn main() {
    divan::main();
}

/// A chain of joints, each with three rotations, the first with a position as well.
fn skeleton() -> Skeleton {
    let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
    let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let joint = |at: usize| Joint {
        name: format!("joint {at}"),
        parent: at.checked_sub(1).map(JointId),
        offset: glam::DVec3::Y,
        channels: if at == 0 { [positions, rotations].concat() } else { rotations.to_vec() },
        first_channel: if at == 0 { 0 } else { 3 * (at + 1) },
        end_sites: vec![],
    };
    Skeleton { joints: (0..JOINTS).map(joint).collect() }
}

/// A clip at 120 frames per second in which every channel swings at its own pace.
fn clip(frames: usize) -> Clip {
    let skeleton = skeleton();
    let channels = skeleton.channels();
    let swing = |frame: usize, channel: usize| {
        let (time, pace) = (frame as f64 / 120.0, 1.0 + 0.37 * channel as f64 / channels as f64);
        30.0 * libm::sin(3.0 * pace * time + channel as f64) + 5.0 * libm::sin(17.0 * pace * time)
    };
    let values = (0..frames * channels).map(|at| swing(at / channels, at % channels)).collect();
    let rate = FrameRate::new(120.0).expect("120 is a rate");
    Clip::new(skeleton, rate, Frame(0), frames, values).expect("the table has the shape")
}

fn speeds(frames: usize) -> Signals {
    Speed::default().measure(&clip(frames)).expect("the speeds are finite")
}

#[divan::bench(args = FRAMES)]
fn speed(bencher: Bencher, frames: usize) {
    let clip = clip(frames);
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .bench(|| Speed::default().measure(black_box(&clip)));
}

#[divan::bench(args = FRAMES)]
fn spectrum(bencher: Bencher, frames: usize) {
    let speeds = speeds(frames);
    bencher.counter(ItemsCount::new(frames * JOINTS)).bench(|| Spectrum::new(black_box(&speeds)));
}

#[divan::bench(args = FRAMES)]
fn apply(bencher: Bencher, frames: usize) {
    let spectrum = Spectrum::new(&speeds(frames));
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .bench(|| LowPass::default().apply(black_box(&spectrum)));
}

/// A filter that is not a running sum: first with the forward transform, then the way back alone.
#[divan::bench(args = FRAMES)]
fn gaussian_once(bencher: Bencher, frames: usize) {
    let signals = speeds(frames);
    let gaussian = LowPass { kind: FilterKind::Gaussian, ..LowPass::default() };
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .bench(|| gaussian.apply(&Spectrum::new(black_box(&signals))));
}

#[divan::bench(args = FRAMES)]
fn gaussian_again(bencher: Bencher, frames: usize) {
    let spectrum = Spectrum::new(&speeds(frames));
    let gaussian = LowPass { kind: FilterKind::Gaussian, ..LowPass::default() };
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .bench(|| gaussian.apply(black_box(&spectrum)));
}

#[divan::bench(args = FRAMES)]
fn find(bencher: Bencher, frames: usize) {
    let speeds = speeds(frames);
    let filter = LowPass::default();
    let filtered = filter.apply(&Spectrum::new(&speeds));
    let delay = filter.delay(speeds.rate);
    bencher
        .counter(ItemsCount::new(frames * JOINTS))
        .bench(|| TurnFinder::default().find(black_box(&filtered), delay));
}
