//! Each preset does what it is called, on the samples and on real clips.

use std::path::{Path, PathBuf};

use genga::edits::Edits;
use genga::keys::Origin;
use genga::motion::bvh;
use genga::pipeline::{Breakdown, Engine};
use genga::recipe::Recipe;
use genga::sheet::{Layer, Role};

use super::PRESETS;
use crate::real;

/// The recipe of a preset on top of the defaults; that of the defaults for an empty name.
fn recipe(name: &str) -> Recipe {
    let mut recipe = Recipe::default();
    let Some(preset) = PRESETS.iter().find(|preset| preset.english == name) else {
        assert_eq!(name, "", "there is no such preset");
        return recipe;
    };
    for (knob, value) in preset.settings {
        recipe.set(knob, value).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(recipe.get(knob).unwrap(), *value, "{name}");
    }
    recipe
}

/// The figures of a sheet that presets change.
#[derive(Debug, Default)]
struct Figures {
    genga: usize,
    /// Keys that are worth between the price of the preset and the default's.
    cheap: usize,
    drawings: usize,
    /// Number of drawings by koma: on ones, twos and threes.
    on: [usize; 4],
    naka_nashi: usize,
    inbetweens: usize,
    /// Sum over inbetweens before omission: distance in the source to the nearer of their two genga, as a share of the
    /// way from one to the other.
    away: f64,
}

impl Figures {
    fn new(breakdown: &Breakdown<'_>) -> Self {
        let own = breakdown.first_layer();
        let layer = &breakdown.sheet.layers[0];
        let few = recipe("Few genga").keys.min_price;
        let is_cheap = |price: f64, origin: Origin| {
            price < few && matches!(origin, Origin::Turn | Origin::Fill)
        };
        let mut figures = Self {
            genga: layer.genga(),
            cheap: own.keys.keys.iter().filter(|key| is_cheap(key.price, key.origin)).count(),
            drawings: layer.shown().count(),
            naka_nashi: own.omission.naka_nashi.done,
            ..Self::default()
        };
        for exposure in layer.exposures.iter().filter(|exposure| exposure.koma < 4) {
            figures.on[exposure.koma] += 1;
        }
        figures.measure(own.spaced);
        figures
    }

    /// Measures how close inbetweens are to their genga.
    fn measure(&mut self, layer: &Layer) {
        let is_key = |at: &usize| layer.drawings[*at].role != Role::Inbetween;
        let place = |at: usize| layer.drawings[at].source.place();
        let keys: Vec<usize> = (0..layer.drawings.len()).filter(is_key).collect();
        for ends in keys.windows(2) {
            let (from, to) = (place(ends[0]), place(ends[1]));
            for at in ends[0] + 1..ends[1] {
                let share = (place(at) - from) / (to - from);
                self.away += share.min(1.0 - share);
                self.inbetweens += 1;
            }
        }
    }

    fn add(&mut self, other: &Self) {
        self.genga += other.genga;
        self.drawings += other.drawings;
        self.inbetweens += other.inbetweens;
        self.away += other.away;
        (0..4).for_each(|koma| self.on[koma] += other.on[koma]);
    }
}

/// The sample motions, and real clips where they are there.
fn clips() -> Vec<PathBuf> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
    let samples = ["kick", "kuroda-pitch", "pitch", "swing", "tennis"];
    let mut clips: Vec<PathBuf> =
        samples.iter().map(|name| data.join(name).with_extension("bvh")).collect();
    let real = [
        "cmu-02_05-punch-strike",
        "cmu-07_01-walk",
        "cmu-09_01-run",
        "cmu-11_01-soccer-kick",
        "cmu-135_04-front-kick",
    ];
    real::with(real, |paths| clips.extend(paths));
    clips
}

/// Runs a law on each clip, with the figures of the default and of a preset, and returns their sums.
fn compare(preset: &str, other: &str, law: impl Fn(&Path, &Figures, &Figures)) -> [Figures; 2] {
    let mut sums = [Figures::default(), Figures::default()];
    for path in clips() {
        let mut engine = Engine::new(bvh::open(&path).unwrap().clip).unwrap();
        let mut figures =
            |name: &str| Figures::new(&engine.run(&recipe(name), &Edits::default()).unwrap());
        let [one, two] = [figures(preset), figures(other)];
        law(&path, &one, &two);
        sums[0].add(&one);
        sums[1].add(&two);
    }
    sums
}

#[test]
fn few_genga_makes_fewer_wherever_one_could_go() {
    let [few, default] = compare("Few genga", "", |clip, few, default| {
        let could_go = default.cheap > 0;
        let is_right =
            if could_go { few.genga < default.genga } else { few.genga == default.genga };
        assert!(is_right, "{}: {few:?}, by default {default:?}", clip.display());
    });
    assert!(few.genga < default.genga);
}

#[test]
fn twos_and_threes_are_what_they_are_called() {
    let [twos, threes] = compare("On twos", "On threes", |clip, twos, threes| {
        let clip = clip.display();
        assert!(twos.on[1] == 0 && threes.on[1] == 0, "{clip}: {twos:?} {threes:?}");
        assert!(twos.on[2] > twos.on[3], "{clip}: {twos:?}");
        assert!(threes.drawings <= twos.drawings, "{clip}: {twos:?} {threes:?}");
    });
    assert!(threes.on[3] > threes.on[2] && threes.drawings < twos.drawings, "{twos:?} {threes:?}");
    let [ones, both] = compare("Ones to threes", "Twos and threes", |clip, ones, both| {
        assert_eq!(both.on[1], 0, "{}: {both:?}", clip.display());
        assert!(ones.drawings >= both.drawings, "{}: {ones:?} {both:?}", clip.display());
    });
    assert!(ones.on[1..].iter().all(|count| *count > 0), "{ones:?}");
    assert!(both.on[2..].iter().all(|count| *count > 0), "{both:?}");
}

#[test]
fn snappy_crowds_inbetweens_and_soft_spreads_them_and_leaves_none_out() {
    let law = |clip: &Path, snappy: &Figures, soft: &Figures| {
        let clip = clip.display();
        assert_eq!(soft.naka_nashi, 0, "{clip}: {soft:?}");
        // Where all drawings are genga there is no inbetween.
        assert_eq!(snappy.inbetweens, soft.inbetweens, "{clip}");
        assert!(snappy.away <= soft.away, "{clip}: {snappy:?} {soft:?}");
    };
    let [snappy, soft] = compare("Snappy", "Soft", law);
    let [default, _] = compare("", "Soft", law);
    assert!(snappy.away < default.away, "{snappy:?} {default:?}");
    assert!(default.away < soft.away, "{default:?} {soft:?}");
}

#[test]
fn every_preset_is_tested() {
    let source = include_str!("tests.rs");
    for preset in PRESETS {
        assert!(source.contains(&format!("\"{}\"", preset.english)), "{}", preset.english);
    }
}
