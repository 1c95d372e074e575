//! Measures how long it takes to draw a hundred figures into one SVG, as mannequins and as sticks.
//!
//! `cargo bench -p genga-benches --bench figures`
#![allow(missing_docs)]

use divan::Bencher;
use genga::motion::{Clip, bvh};
use genga::sheet::Role;
use genga_plot::{FigureBody, PoseRow};

const FIGURES: usize = 100;

fn main() {
    divan::main();
}

fn kick() -> Clip {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../data/kick.bvh");
    bvh::open(path.as_ref()).expect("the sample is there").clip
}

#[divan::bench(args = [FigureBody::Mannequin, FigureBody::Sticks])]
fn a_hundred(bencher: Bencher<'_, '_>, body: FigureBody) {
    let clip = kick();
    let last = (clip.len() - 1) as f64;
    let place = |figure: usize| last * figure as f64 / (FIGURES - 1) as f64;
    let frames: Vec<(f64, String, Role)> =
        (0..FIGURES).map(|figure| (place(figure), figure.to_string(), Role::Genga)).collect();
    let row = PoseRow { body, most: FIGURES, ..PoseRow::default() };
    bencher.bench(|| row.draw(&clip, &frames).expect("the kick can be drawn"));
}
