//! The omission stages, compared with a version that recomputes every distance in every round.
//!
//! `cargo bench -p genga-benches --bench omission`
#![allow(missing_docs)]

use std::f64::consts::TAU;

use divan::Bencher;
use divan::counter::ItemsCount;
use genga::motion::{Axis, Channel, Clip, Joint, JointId, Skeleton};
use genga::sheet::{Layer, Sheet};
use genga::time::{Frame, FrameRate};
use genga::timing::{Amount, Omission, Stills};
use glam::DVec3;

const JOINTS: usize = 31;
/// The first length is that of "Pitch" in Table 1 of KKMFT.
const LENGTHS: [usize; 4] = [129, 1_000, 10_000, 100_000];

fn main() {
    divan::main();
}

/// Four limbs that swing at different rates, on a root that walks.
fn clip(frames: usize) -> Clip {
    let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
    let position = Channel::Position(Axis::X);
    let joint = |joint: usize| Joint {
        name: format!("joint {joint}"),
        parent: joint.checked_sub(4).map(JointId).or((joint > 0).then_some(JointId(0))),
        offset: DVec3::new(1.0, 10.0, 0.0),
        channels: if joint == 0 { vec![position] } else { rotations.to_vec() },
        first_channel: if joint == 0 { 0 } else { 3 * joint - 2 },
        end_sites: vec![],
    };
    let skeleton = Skeleton { joints: (0..JOINTS).map(joint).collect() };
    let channels = skeleton.channels();
    let value = |at: usize| {
        let (frame, channel) = ((at / channels) as f64, at % channels);
        let period = 24.0 + 7.3 * (channel % 11) as f64;
        40.0 * libm::sin(TAU * frame / period + channel as f64) * libm::cos(frame / 97.0)
    };
    let values = (0..frames * channels).map(value).collect();
    let rate = FrameRate::new(24.0).expect("24 is a rate");
    Clip::new(skeleton, rate, Frame(0), frames, values).expect("the table has its shape")
}

fn laid_out(frames: usize) -> (Layer, Stills) {
    let clip = clip(frames);
    let layer = Sheet::on_ones(clip.clock(24.0), frames).layers.remove(0);
    let stills = Stills::from_layer(&clip, &layer);
    (layer, stills)
}

/// The paper's counts for a pitch, as shares of the length: 4 and 33 of 129.
fn counts(frames: usize) -> (usize, usize) {
    (frames * 4 / 129, frames * 33 / 129)
}

fn items(frames: usize) -> ItemsCount {
    ItemsCount::new(frames * JOINTS)
}

#[divan::bench(args = LENGTHS)]
fn a_positions(bencher: Bencher, frames: usize) {
    let clip = clip(frames);
    let layer = Sheet::on_ones(clip.clock(24.0), frames).layers.remove(0);
    bencher.counter(items(frames)).bench(|| Stills::from_layer(&clip, &layer));
}

#[divan::bench(args = LENGTHS)]
fn b_distances_once(bencher: Bencher, frames: usize) {
    let (_, stills) = laid_out(frames);
    let sum = || (1..frames).map(|drawing| stills.ssd(drawing - 1, drawing)).sum::<f64>();
    bencher.counter(items(frames)).bench(sum);
}

/// The fixed cost of every run: distances once, linking, and building the resulting layer.
#[divan::bench(args = LENGTHS)]
fn c_nothing_left_out(bencher: Bencher, frames: usize) {
    stages(bencher, frames, 0, 0);
}

#[divan::bench(args = LENGTHS)]
fn d_naka_nashi(bencher: Bencher, frames: usize) {
    stages(bencher, frames, counts(frames).0, 0);
}

#[divan::bench(args = LENGTHS)]
fn e_koma_dori(bencher: Bencher, frames: usize) {
    stages(bencher, frames, 0, counts(frames).1);
}

#[divan::bench(args = LENGTHS)]
fn f_both(bencher: Bencher, frames: usize) {
    stages(bencher, frames, counts(frames).0, counts(frames).1);
}

fn stages(bencher: Bencher, frames: usize, naka_nashi: usize, koma_dori: usize) {
    let (layer, stills) = laid_out(frames);
    let settings = Omission {
        naka_nashi: Amount::Count(naka_nashi),
        koma_dori: Amount::Count(koma_dori),
        ..Omission::default()
    };
    bencher.counter(items(frames)).bench(|| settings.apply(&layer, &stills, 1));
}

#[divan::bench(args = &LENGTHS[..2])]
fn g_both_straight(bencher: Bencher, frames: usize) {
    let (_, stills) = laid_out(frames);
    let (naka_nashi, koma_dori) = counts(frames);
    bencher.counter(items(frames)).bench(|| straight(&stills, naka_nashi, koma_dori));
}

/// Algorithms 1 and 2 on a list of frames, with every distance recomputed in every round.
fn straight(stills: &Stills, naka_nashi: usize, koma_dori: usize) -> Vec<usize> {
    let mut frames: Vec<usize> = (0..stills.len()).collect();
    let mut duplicated = vec![0; stills.len()];
    let mut held = vec![1; stills.len()];
    let by_ssd = |frames: &[usize]| {
        let ssd = |pair: &[usize]| stills.ssd(pair[0], pair[1]);
        frames.windows(2).map(ssd).collect::<Vec<f64>>()
    };
    for _ in 0..naka_nashi {
        let ssd = by_ssd(&frames);
        let inner = 0..ssd.len() - 1;
        let fastest = inner.rev().max_by(|&a, &b| ssd[a].total_cmp(&ssd[b])).expect("a frame");
        held[frames.remove(fastest + 1)] -= 1;
        let ssd = by_ssd(&frames);
        let free = (0..ssd.len()).filter(|&k| duplicated[frames[k]] < 3);
        let slowest = free.min_by(|&a, &b| ssd[a].total_cmp(&ssd[b])).expect("a frame");
        duplicated[frames[slowest]] += 1;
        held[frames[slowest]] += 1;
        frames.insert(slowest, frames[slowest]);
    }
    for _ in 0..koma_dori {
        let ssd = by_ssd(&frames);
        let single = |&k: &usize| {
            let (before, own) = (frames[k], frames[k + 1]);
            before != own && held[own] == 1 && duplicated[own] == 0 && held[before] < 4
        };
        let free = (0..ssd.len() - 1).filter(single);
        let slowest = free.min_by(|&a, &b| ssd[a].total_cmp(&ssd[b])).expect("a frame");
        held[frames[slowest + 1]] -= 1;
        held[frames[slowest]] += 1;
        frames[slowest + 1] = frames[slowest];
    }
    frames
}
