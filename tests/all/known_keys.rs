//! Clips with a pose on every frame, made from a few known keys: the keys are found again.

mod made;

use genga::edits::Edits;
use genga::keys::Matching;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::target::{Target, meet};
use genga::time::Frame;

use crate::clips;
use made::{FRAMES, made, noise_of};

/// How far the keys that are found agree with those that a clip was made from, within a koma (F1).
fn found_again(clip: &Clip, keys: &[Frame]) -> f64 {
    let mut engine = Engine::new(clip.clone()).unwrap();
    let (recipe, edits) = (Recipe::default(), Edits::default());
    let met = meet(&mut engine, &recipe, &edits, &[Target::Keys(keys.len() + 2)]).unwrap();
    let layer = engine.find_keys(&met.recipe, &edits).unwrap().keys;
    let found: Vec<Frame> = layer.keys.iter().map(|key| key.frame).collect();
    Matching::between(keys, &found, FRAMES as f64).kept()
}

#[test]
fn keys_that_a_clip_was_made_from_are_found_again() {
    let mut paths = clips::all();
    paths.push(clips::here("data/kick.bvh"));
    let mut shares = Vec::new();
    for path in paths {
        let clip = clips::read(&path);
        let noise = noise_of(&clip);
        let of_clip = [0, 1, 2, 3].map(|seed| {
            let (dense, keys) = made(&clip, seed, noise);
            found_again(&dense, &keys)
        });
        shares.push((of_clip.iter().sum::<f64>() / 4.0, clips::name(&path)));
    }
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mean = shares.iter().map(|(share, _)| share).sum::<f64>() / shares.len() as f64;
    assert!(mean >= 0.9, "{mean:.3}: {shares:.2?}");
}
