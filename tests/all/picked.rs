//! Filter and persistence pick the genga: turned, they change them on every clip.

use genga::edits::Edits;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, Span};

use crate::clips;

/// The samples and the real clips.
fn all() -> Vec<(String, Clip)> {
    let samples = ["kick.bvh", "tennis.bvh", "pitch.bvh", "swing.bvh"]
        .map(|name| clips::here("data").join(name));
    let paths = samples.into_iter().chain(clips::real());
    paths.map(|path| (clips::name(&path), clips::read(&path))).collect()
}

/// The frames of the genga by each value of a setting, one recipe after the other.
fn genga(clip: Clip, values: &[f64], set: fn(&mut Recipe, Span)) -> Vec<Vec<Frame>> {
    let mut engine = Engine::new(clip).unwrap();
    let mut by = |seconds: &f64| {
        let mut recipe = Recipe::default();
        set(&mut recipe, Span::Seconds(*seconds));
        let made = engine.run(&recipe, &Edits::default()).unwrap();
        made.layers().next().unwrap().keys.keys.iter().map(|key| key.frame).collect()
    };
    values.iter().map(&mut by).collect()
}

#[test]
fn another_filter_width_picks_other_genga_on_every_clip() {
    for (name, clip) in all() {
        let picked = genga(clip, &[0.05, 0.15, 0.4], |recipe, width| recipe.filter.width = width);
        assert!(picked[0] != picked[1] && picked[1] != picked[2], "{name}: {picked:?}");
    }
}

#[test]
fn another_persistence_picks_other_genga_on_every_clip() {
    for (name, clip) in all() {
        let set = |recipe: &mut Recipe, span| recipe.turns.persistence = span;
        let picked = genga(clip, &[0.04, 0.1, 0.25], set);
        assert!(picked[0] != picked[1] && picked[1] != picked[2], "{name}: {picked:?}");
    }
}
