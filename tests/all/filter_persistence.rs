//! Filter and persistence pick the genga: turning them changes the genga of every clip.

use genga::edits::Edits;
use genga::motion::Clip;
use genga::pipeline::{Budget, Engine};
use genga::recipe::Recipe;
use genga::time::{Frame, Span};
use genga_lab::study::{self, Axis, Measure, Study};

use crate::clips;

/// The samples and the real clips.
fn all() -> Vec<(String, Clip)> {
    let samples = ["kick.bvh", "tennis.bvh", "pitch.bvh", "swing.bvh"]
        .map(|name| clips::here("data").join(name));
    let paths = samples.into_iter().chain(clips::all());
    paths.map(|path| (clips::name(&path), clips::read(&path))).collect()
}

/// The frames of the genga for each value of a setting.
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

/// Number of frames with a turn of any joint, with the recipe of the first paper's Table 1 and filters of 8 to 24
/// frames.
fn union_by_width(clip: Clip) -> Vec<f64> {
    let study = Study {
        recipe: study::table_1_recipe(),
        x: Axis::new("filter.width", "8..24:1").unwrap(),
        y: None,
        measures: vec![Measure::Union],
        keep_keys: false,
        budget: Budget::default(),
    };
    study.run(clip, || {}).unwrap().values(Measure::Union).unwrap()
}

#[test]
fn a_wider_filter_finds_less_at_odd_widths_and_at_even_ones() {
    clips::with_all(|paths| {
        let counts = paths.iter().map(|path| union_by_width(clips::read(path)));
        wider_finds_less(&counts.collect::<Vec<_>>());
    });
}

fn wider_finds_less(counts: &[Vec<f64>]) {
    let widths = counts[0].len();
    let sums: Vec<f64> = (0..widths).map(|at| counts.iter().map(|count| count[at]).sum()).collect();
    assert!(sums.is_sorted_by(|narrow, wide| narrow > wide), "{sums:?}");
    // Deviation of a width from the mean of its neighbours. For a box filter with parity it would be a fifth of the
    // count.
    let bend = |count: &[f64]| (count[1] - (count[0] + count[2]) / 2.0).abs();
    let bends: f64 = counts.iter().flat_map(|count| count.windows(3).map(bend)).sum();
    let share = bends / sums[1..widths - 1].iter().sum::<f64>();
    assert!(share < 0.03, "{share}");
}
