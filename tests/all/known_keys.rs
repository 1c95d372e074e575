//! Keys are found again in clips with a pose on every frame that were made from a few known keys.

mod made;

use genga::edits::Edits;
use genga::keys::Matching;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::target::{Target, meet};
use genga::time::Frame;

use crate::clips;
use made::{FRAMES, keyed, made, noise_of};

/// Agreement (F1, within a koma) of the keys found with those that the clip was made from.
fn found_again(clip: &Clip, keys: &[Frame], recipe: &Recipe) -> f64 {
    let mut engine = Engine::new(clip.clone()).unwrap();
    let edits = Edits::default();
    let met = meet(&mut engine, recipe, &edits, &[Target::Keys(keys.len() + 2)]).unwrap();
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
            found_again(&dense, &keys, &Recipe::default())
        });
        shares.push((of_clip.iter().sum::<f64>() / 4.0, clips::name(&path)));
    }
    shares.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mean = shares.iter().map(|(share, _)| share).sum::<f64>() / shares.len() as f64;
    // Noise hides some keys of a clip that is recognized as drawn, and smoothed less.
    assert!(mean >= 0.86, "{mean:.3}: {shares:.2?}");
}

#[test]
fn keys_with_straight_inbetweens_are_known_as_drawn_and_found() {
    let mut paths = clips::all();
    paths.push(clips::here("data/kick.bvh"));
    let mut smoothing = Recipe::default();
    smoothing.set("turns.drawn", "0").unwrap();
    let recipes = [Recipe::default(), smoothing];
    let mut sums = [0.0; 2];
    for path in &paths {
        let (clip, keys) = keyed(&clips::read(path), 5);
        let mut engine = Engine::new(clip.clone()).unwrap();
        let drawn = engine.run(&Recipe::default(), &Edits::default()).unwrap().first_layer().drawn;
        assert!(drawn > 0.9, "{}: {drawn}", clips::name(path));
        let found = recipes.each_ref().map(|recipe| found_again(&clip, &keys, recipe));
        sums.iter_mut().zip(found).for_each(|(sum, own)| *sum += own);
    }
    let [own, smoothed] = sums.map(|sum| sum / paths.len() as f64);
    assert!(own >= 0.86 && own >= smoothed + 0.05, "{own:.3}, smoothed {smoothed:.3}");
}
