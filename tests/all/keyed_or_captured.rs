//! Keyed motion and captures are told apart: no capture counts as drawn, however it was sampled.

use genga::edits::Edits;
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};

use crate::clips;

/// Longest part of a clip that is examined, in seconds.
const LONGEST: f64 = 12.0;

type Rows = Vec<Vec<f64>>;

/// Makes a clip of these rows.
fn clip(of: &Clip, fps: f64, rows: &Rows) -> Clip {
    let rate = FrameRate::new(fps).unwrap();
    Clip::new(of.skeleton().clone(), rate, Frame(0), rows.len(), rows.concat()).unwrap()
}

/// Interpolates linearly from each row to the next in `by` steps. Angles go the short way round.
fn straight(rows: &Rows, by: usize) -> Rows {
    let between = |pair: &[Vec<f64>], at: usize| {
        let share = at as f64 / by as f64;
        let value = |(channel, (from, to)): (usize, (&f64, &f64))| {
            let way = to - from;
            let turns = if channel < 3 { 0.0 } else { (way / 360.0).round() };
            from + share * (way - 360.0 * turns)
        };
        pair[0].iter().zip(&pair[1]).enumerate().map(value).collect()
    };
    rows.windows(2).flat_map(|pair| (0..by).map(move |at| between(pair, at))).collect()
}

/// Repeats each row `times` times.
fn repeated(rows: &Rows, times: usize) -> Rows {
    rows.iter().flat_map(|row| vec![row.clone(); times]).collect()
}

/// Rounds angles to multiples of `to`.
fn rounded(rows: &Rows, to: f64) -> Rows {
    let round = |row: &Vec<f64>| {
        let value = |(channel, value): (usize, &f64)| match channel {
            0..3 => *value,
            _ => (value / to).round() * to,
        };
        row.iter().enumerate().map(value).collect()
    };
    rows.iter().map(round).collect()
}

#[test]
fn no_capture_counts_as_drawn_however_it_was_sampled() {
    let mut paths = clips::all();
    paths.push(clips::here("data/kick.bvh"));
    let mut wrong = Vec::new();
    for path in paths {
        let own = clips::read(&path);
        let fps = own.rate().fps();
        let rows: Rows = own.rows().take((LONGEST * fps) as usize).map(<[f64]>::to_vec).collect();
        let every = (fps / 30.0).round().max(1.0);
        let (low, few): (f64, Rows) =
            (fps / every, rows.iter().step_by(every as usize).cloned().collect());
        let on_twos = rows.iter().step_by(2 * every as usize).cloned().collect();
        for (what, fps, rows) in [
            ("as it is", fps, rows.clone()),
            ("half as many", fps / 2.0, rows.iter().step_by(2).cloned().collect()),
            ("in whole degrees", fps, rounded(&rows, 1.0)),
            ("in tenths of a degree", fps, rounded(&rows, 0.1)),
            ("twice as many, straight", 2.0 * low, straight(&few, 2)),
            ("four times, straight", 4.0 * low, straight(&few, 4)),
            ("twice", 2.0 * low, repeated(&few, 2)),
            ("on twos", low, repeated(&on_twos, 2)),
        ] {
            let mut engine = Engine::new(clip(&own, fps, &rows)).unwrap();
            let run = engine.run(&Recipe::default(), &Edits::default()).unwrap();
            let layer = run.first_layer();
            if layer.drawn > 0.0 {
                wrong.push(format!("{}, {what}: {:.3}", clips::name(&path), layer.crispness));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_joint_of_a_capture_counts_as_drawn_as_a_layer() {
    let mut paths = clips::all();
    paths.truncate(4);
    paths.push(clips::here("data/kick.bvh"));
    let mut recipe = Recipe::default();
    recipe.set("layers", "joints").unwrap();
    for path in paths {
        let own = clips::read(&path);
        let fps = own.rate().fps();
        let rows: Rows = own.rows().take((4.0 * fps) as usize).map(<[f64]>::to_vec).collect();
        let mut engine = Engine::new(clip(&own, fps, &rows)).unwrap();
        let run = engine.run(&recipe, &Edits::default()).unwrap();
        assert!(run.layers().all(|layer| layer.drawn == 0.0), "{}", clips::name(&path));
    }
}
