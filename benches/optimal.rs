//! The optimal keys of every count, starting from the clip: `cargo bench -p genga-benches --bench optimal`.

use std::path::Path;
use std::sync::Arc;

use divan::Bencher;
use genga::keys::Reference;
use genga::motion::{Clip, bvh};
use genga::time::Frame;
use genga_lab::quality::KomaFrames;
use genga_lab::quality::baselines::{Objective, Optimal, Segments};

#[path = "common/body.rs"]
mod body;

use body::swinging;

fn main() {
    divan::main();
}

/// Measures every segment between any two frames of a clip, sampling the error `per_second` times a second, and then
/// finds the best keys of every count for the mean error and for the worst.
fn every_count(bencher: Bencher<'_, '_>, clip: Clip, per_second: f64) {
    let reference = Reference::new(&clip, clip.clock(per_second));
    let frames = (clip.first().0..=clip.last().0).map(Frame).collect();
    let grid = KomaFrames { clip: Arc::new(clip), reference, frames };
    bencher.bench_local(|| {
        let segments = Segments::new(&grid);
        let [mean, worst] = [Objective::Mean, Objective::Worst]
            .map(|objective| Optimal::new(&segments, objective, usize::MAX));
        mean.cost(8) + worst.cost(8)
    });
}

/// The sample of 496 frames and 23 joints: with the error at each koma, as everywhere in this program, and at each of
/// its frames.
#[divan::bench(args = [24.0, 100.0], sample_count = 7)]
fn kuroda_pitch(bencher: Bencher<'_, '_>, per_second: f64) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../data/kuroda-pitch.bvh");
    let bytes = std::fs::read(path).expect("the sample is part of the repository");
    every_count(bencher, bvh::read(&bytes).expect("a clip").clip, per_second);
}

/// A body of 31 joints at 120 frames per second, with the error at each koma.
#[divan::bench(args = [240, 496, 1_000], sample_count = 5)]
fn swinging_body(bencher: Bencher<'_, '_>, frames: usize) {
    every_count(bencher, swinging(frames), 24.0);
}
