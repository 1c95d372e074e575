//! Each goal and each preset does what it is called, on the samples and on real clips.

use std::path::{Path as File, PathBuf};

use super::presets::{PRESETS, Preset};
use super::stops::{PACE, Path, SNAP, Setting};
use crate::counts::Counts;
use crate::real;
use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Role;

/// The defaults with some settings.
fn with(settings: impl IntoIterator<Item = Setting>) -> Recipe {
    let mut recipe = Recipe::default();
    for (knob, value) in settings {
        recipe.set(knob, value).unwrap();
    }
    recipe
}

/// The sample motions, and real clips where they are there.
fn clips() -> Vec<PathBuf> {
    let data = File::new(env!("CARGO_MANIFEST_DIR")).join("../../data");
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

/// What goals change of a sheet.
#[derive(Debug, Clone)]
struct Figures {
    genga: usize,
    a_second: f64,
    contrast: f64,
    longest_hold: usize,
    left_out: usize,
    /// Average way of an inbetween to its nearer genga, as a share of the way between the two, before any is left out.
    away: f64,
    /// Number of exposures by koma: on ones, twos and threes.
    on: [usize; 4],
}

fn figures(engine: &mut Engine, recipe: &Recipe) -> Figures {
    let breakdown = engine.run(recipe, &Edits::default()).unwrap();
    let (counts, own) = (Counts::new(&breakdown), breakdown.first_layer());
    let drawings = &own.spaced.drawings;
    let place = |at: usize| drawings[at].source.place();
    let keys: Vec<usize> =
        (0..drawings.len()).filter(|at| drawings[*at].role != Role::Inbetween).collect();
    let mut shares = Vec::new();
    for ends in keys.windows(2) {
        let (from, to) = (place(ends[0]), place(ends[1]));
        let share = |at: usize| (place(at) - from) / (to - from);
        shares.extend((ends[0] + 1..ends[1]).map(|at| share(at).min(1.0 - share(at))));
    }
    let mut on = [0; 4];
    for exposure in own.layer.exposures.iter().filter(|exposure| exposure.koma < 4) {
        on[exposure.koma] += 1;
    }
    Figures {
        genga: counts.genga,
        a_second: counts.a_second(counts.drawings),
        contrast: counts.contrast,
        longest_hold: counts.longest_hold,
        left_out: own.omission.naka_nashi.done,
        away: shares.iter().sum::<f64>() / shares.len().max(1) as f64,
        on,
    }
}

/// The figures of each stop of a path, clip by clip.
fn of_stops(path: &Path) -> Vec<(PathBuf, Vec<Figures>)> {
    let of_clip = |clip: PathBuf| {
        let mut engine = Engine::new(bvh::open(&clip).unwrap().clip).unwrap();
        let of_stop =
            |stop: &super::stops::Stop| figures(&mut engine, &with(stop.settings.iter().copied()));
        let figures = path.stops.iter().map(of_stop).collect();
        (clip, figures)
    };
    clips().into_iter().map(of_clip).collect()
}

/// The averages over all clips of a figure, stop by stop.
fn averages(of_stops: &[(PathBuf, Vec<Figures>)], figure: impl Fn(&Figures) -> f64) -> Vec<f64> {
    let stop = |at: usize| of_stops.iter().map(|(_, stops)| figure(&stops[at])).sum::<f64>();
    (0..of_stops[0].1.len()).map(|at| stop(at) / of_stops.len() as f64).collect()
}

#[test]
fn each_stop_of_the_pace_has_more_drawings_a_second_than_the_one_before() {
    let of_stops = of_stops(&PACE);
    let rates = averages(&of_stops, |figures| figures.a_second);
    assert!(rates.windows(2).all(|pair| pair[0] < pair[1]), "{rates:?}");
    for (clip, stops) in &of_stops {
        let rates: Vec<f64> = stops.iter().map(|figures| figures.a_second).collect();
        assert!(rates[0] < rates[5], "{}: {rates:?}", clip.display());
        // A genga more or less where holds are longer is no other pace.
        let is_in_order = rates.windows(2).all(|pair| pair[0] <= 1.06 * pair[1]);
        assert!(is_in_order, "{}: {rates:?}", clip.display());
        assert_eq!(stops[1].on[1], 0, "{}: on threes", clip.display());
        assert!(stops[5].on[2..].iter().sum::<usize>() <= stops[5].on[1], "{}", clip.display());
    }
}

#[test]
fn each_stop_of_the_snap_crowds_inbetweens_more_and_its_fastest_step_is_longer() {
    let of_stops = of_stops(&SNAP);
    let away = averages(&of_stops, |figures| figures.away);
    assert!(away.windows(2).all(|pair| pair[0] > pair[1]), "{away:?}");
    let contrast = averages(&of_stops, |figures| figures.contrast);
    // Exaggeration, at the last stop, makes other genga.
    assert!(contrast[..5].windows(2).all(|pair| pair[0] < pair[1]), "{contrast:?}");
    assert!(contrast[5] > contrast[2], "{contrast:?}");
    for (clip, stops) in &of_stops {
        let clip = clip.display();
        assert!(stops[..2].iter().all(|figures| figures.left_out == 0), "{clip}");
        let ends = [&stops[0], &stops[4]].map(|figures| (figures.contrast, figures.away));
        assert!(ends[0].0 <= ends[1].0 && ends[0].1 >= ends[1].1, "{clip}: {ends:?}");
    }
}

#[test]
fn each_preset_is_what_it_is_called() {
    let of = |name: &str| PRESETS.iter().find(|preset| preset.english == name).unwrap();
    let presets = ["TV action", "TV acting", "Walk and run", "Full"].map(of);
    assert_eq!(presets.len(), PRESETS.len(), "every preset is tested");
    for clip in clips() {
        let mut engine = Engine::new(bvh::open(&clip).unwrap().clip).unwrap();
        let mut of = |preset: &Preset| figures(&mut engine, &with(preset.settings()));
        let [action, acting, steps, full] = presets.map(&mut of);
        let default = figures(&mut engine, &Recipe::default());
        let clip = clip.display();
        assert!(acting.a_second <= action.a_second && acting.genga <= default.genga, "{clip}");
        assert_eq!(acting.on[1] + action.on[1], 0, "{clip}: on twos and threes");
        assert!(action.away <= default.away, "{clip}: {action:?} {default:?}");
        assert!(steps.left_out == 0 && steps.away >= default.away, "{clip}: {steps:?} {default:?}");
        assert!(full.genga >= default.genga && full.a_second > steps.a_second, "{clip}: {full:?}");
        assert!(
            full.a_second > 20.0 && full.longest_hold <= default.longest_hold,
            "{clip}: {full:?}"
        );
    }
}

#[test]
fn a_preset_is_a_point_that_is_recognised() {
    for preset in PRESETS {
        let recipe = with(preset.settings());
        let found: Vec<&str> =
            PRESETS.iter().filter(|other| other.is_in(&recipe)).map(|own| own.english).collect();
        assert_eq!(found, [preset.english]);
        for (knob, value) in preset.settings() {
            assert_eq!(recipe.get(knob).unwrap(), value, "{}", preset.english);
        }
    }
    assert!(!PRESETS.iter().any(|preset| preset.is_in(&Recipe::default())));
}
