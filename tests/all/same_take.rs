//! A take in another format has the same keys.

use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga_files::{Vmd, VmdBones, limited_bvh};
use genga_read as file;

use crate::clips;

/// Takes of half a minute at most, of every dialect at hand except the one whose spine is elsewhere.
const TAKES: [&str; 10] = [
    "cmu-02_04-jump-balance",
    "cmu-05_11-dance-pirouette",
    "cmu-06_15-dribble-shoot",
    "cmu-07_01-walk",
    "cmu-09_01-run",
    "cmu-10_03-soccer-kick",
    "cmu-11_01-soccer-kick",
    "cmu-131_03-start-hop-stop",
    "cmu-135_04-front-kick",
    "threejs-pirouette",
];

/// Koma of each genga, counted from the beginning.
fn keys(clip: Clip) -> Vec<f64> {
    let (first, in_koma) = (clip.first().0 as f64, 24.0 / clip.rate().fps());
    let mut engine = Engine::new(clip).unwrap();
    let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
    let drawings = breakdown.sheet.layers[0].drawings.iter();
    let kept = drawings.filter(|drawing| drawing.role.is_kept());
    kept.map(|drawing| (drawing.source.place() - first) * in_koma).collect()
}

/// F1 of two sorted lists, matching members one to one within a koma.
fn f1(a: &[f64], b: &[f64]) -> f64 {
    let (mut at, mut other, mut both) = (0, 0, 0);
    while let (Some(x), Some(y)) = (a.get(at), b.get(other)) {
        if (x - y).abs() <= 1.0 {
            (at, other, both) = (at + 1, other + 1, both + 1);
        } else if x < y {
            at += 1;
        } else {
            other += 1;
        }
    }
    2.0 * f64::from(both) / (a.len() + b.len()) as f64
}

/// A sheet with every frame of MMD, 30 per second.
fn on_thirties(clip: &Clip) -> Sheet {
    let frames = (clip.seconds() * 30.0).floor() as usize + 1;
    Sheet::on_ones(clip.clock(30.0), frames)
}

/// Converts a clip to VMD for a model with the semi-standard bones, and reads it again without the model.
fn through_vmd(clip: &Clip) -> Clip {
    let vmd = Vmd { bones: VmdBones::Semi, ..Vmd::default() };
    let bytes = vmd.make(clip, &on_thirties(clip)).unwrap().motion.bytes().unwrap();
    file::Options::default().read(&bytes).unwrap().clip
}

/// Converts a clip to BVH and reads it again.
fn through_bvh(clip: &Clip) -> Clip {
    let text = limited_bvh(clip, &on_thirties(clip)).unwrap();
    file::Options::default().read(text.as_bytes()).unwrap().clip
}

/// MMD has 30 frames per second. That alone moves some keys of a take at 120, so the VMD is compared with the BVH of
/// the same frames. The total loss of both is printed too.
#[test]
fn a_take_as_vmd_has_the_keys_of_its_bvh() {
    clips::with(TAKES, |paths| have_the_keys_of_their_bvh(&paths));
}

#[allow(clippy::print_stderr, reason = "the figures that the documentation states")]
fn have_the_keys_of_their_bvh(paths: &[PathBuf]) {
    let mut found = Vec::new();
    for path in paths {
        let (name, clip) = (clips::name(path), clips::read(path));
        let (own, bvh) = (keys(clip.clone()), keys(through_bvh(&clip)));
        let vmd = keys(through_vmd(&clip));
        let (same, both) = (f1(&bvh, &vmd), f1(&own, &vmd));
        eprintln!("{name}: {same:.3} beside 30 frames a second, {both:.3} beside the file");
        assert!(same > 0.8, "{name}: {bvh:?}\n{vmd:?}");
        found.push(same);
    }
    let mean = found.iter().sum::<f64>() / found.len() as f64;
    assert!(mean >= 0.93, "{mean}");
}
