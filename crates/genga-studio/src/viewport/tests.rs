//! Tests that the screen shows at every koma the pose that `limited.bvh` has in that row.

use std::path::Path;

use egui::{Context, Painter, Pos2, RawInput, Rect, Shape, Theme, pos2, vec2};
use glam::DVec3;

use super::{Viewport, body};
use crate::column::Column;
use crate::command::Seen;
use crate::composite_poses::OnScreen;
use crate::host::{ClipsAlone, Host};
use crate::open_take::{Results, Take};
use crate::opening_steps::Step;
use crate::theme::Look;
use crate::view_state::Shown;
use crate::words::Words;
use genga::motion::bvh;
use genga::sheet::Source;
use genga_files::limited_bvh;
use genga_plot::parts::Posing;

/// Opens a take with some knobs set.
fn take(clip: &str, knobs: &[(&str, &str)]) -> Take {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data").join(clip);
    let samples =
        ClipsAlone(|path: &Path| Ok(bvh::open(path).map_err(|error| error.to_string())?.clip));
    let mut take = Take::new(samples.open(&path).unwrap(), &samples, &path, None).unwrap();
    Step::ALL.iter().for_each(|step| take.run(*step).unwrap());
    knobs.iter().for_each(|(knob, value)| take.wanted.recipe.set(knob, value).unwrap());
    take.renew(false).unwrap();
    take
}

/// Collects the points of everything painted, shape by shape.
fn painted(paint: impl FnOnce(&Painter)) -> Vec<Vec<Pos2>> {
    let mut paint = Some(paint);
    let mut output = Context::default().run_ui(RawInput::default(), |ui| {
        let all = Rect::from_min_size(Pos2::ZERO, vec2(2000.0, 2000.0));
        if let Some(paint) = paint.take() {
            paint(&ui.painter().with_clip_rect(all));
        }
    });
    // Nothing is shown, so the font textures are dropped on purpose.
    output.textures_delta.clear();
    let mut points = Vec::new();
    output.shapes.iter().for_each(|clipped| collect(&clipped.shape, &mut points));
    points
}

fn collect(shape: &Shape, points: &mut Vec<Vec<Pos2>>) {
    match shape {
        Shape::Vec(shapes) => shapes.iter().for_each(|shape| collect(shape, points)),
        Shape::Path(path) => points.push(path.points.clone()),
        Shape::LineSegment { points: ends, .. } => points.push(ends.to_vec()),
        Shape::Circle(circle) => points.push(vec![circle.center]),
        _ => {}
    }
}

/// Whether all shapes of a figure occur among others, one directly after another.
fn stands_in(figure: &[Vec<Pos2>], all: &[Vec<Pos2>]) -> bool {
    let is_near = |(a, b): (&Pos2, &Pos2)| a.distance(*b) < 0.05;
    let is_same =
        |(a, b): (&Vec<Pos2>, &Vec<Pos2>)| a.len() == b.len() && a.iter().zip(b).all(is_near);
    all.windows(figure.len()).any(|part| figure.iter().zip(part).all(is_same))
}

/// Number of koma on which the window shows the pose in the file, and number of all koma.
fn same_koma(clip: &str, knobs: &[(&str, &str)]) -> (usize, usize) {
    let mut take = take(clip, knobs);
    let Results { breakdown, cels, scene, wanted } = take.results();
    let file = limited_bvh(breakdown.clip, breakdown.sheet).unwrap();
    let file = bvh::read(file.as_bytes()).unwrap().clip;
    let rect = Rect::from_min_size(pos2(40.0, 30.0), vec2(800.0, 700.0));
    let viewport = Viewport { onion: false, trails: false, ..Viewport::default() };
    let stage = viewport.orbit.stage(scene, rect, DVec3::ZERO);
    let mut shown = Shown {
        breakdown,
        on_screen: OnScreen::new(breakdown.clip, cels),
        columns: Column::all(&breakdown),
        chosen: 0,
        scene,
        wanted,
        taken: &[],
        joints: &[],
        at: 0,
        counts_frames: false,
        beside: crate::view_state::Beside::default(),
        look: Look::from_theme(Theme::Light),
        words: Words { language: Default::default(), has_japanese: false },
    };
    let mut posing = Posing::new(&file, scene.figure.marks());
    let mut is_same = |koma: usize| {
        shown.at = koma;
        let row = posing.points(Source::At((file.first().0 + koma) as f64));
        let figure = painted(|painter| {
            body::draw(painter, &stage.draw(&row), body::Inks::Sides, &shown.look);
        });
        let window =
            painted(|painter| viewport.draw(painter, rect, Seen::Result, DVec3::ZERO, &shown));
        assert!(!figure.is_empty() && window.len() > figure.len(), "{koma}");
        stands_in(&figure, &window)
    };
    let same = (0..file.len()).filter(|koma| is_same(*koma)).count();
    (same, file.len())
}

#[test]
fn at_every_koma_the_window_shows_what_limited_bvh_has_in_that_row() {
    let layers = ("layers", "limbs");
    let (root, feet) = (("root", "ones"), ("feet", "held"));
    let smear = ("exaggerate.cartoon", "0.5");
    for (clip, knobs) in [
        ("kick.bvh", &[][..]),
        ("kick.bvh", &[layers]),
        ("kick.bvh", &[root]),
        ("kick.bvh", &[root, feet]),
        ("kick.bvh", &[layers, root, feet, smear]),
        ("pitch.bvh", &[layers, ("spacing.source", "blend")]),
    ] {
        let (same, koma) = same_koma(clip, knobs);
        assert_eq!(same, koma, "{clip} {knobs:?}");
        assert!(koma > 60);
    }
}

#[test]
fn feet_are_looked_for_again_in_another_motion_alone() {
    let mut take = take("kick.bvh", &[("feet", "held"), ("root", "ones")]);
    for (knob, value) in [("spacing.on", "3"), ("exaggerate.cartoon", "0.5"), ("feet", "free")] {
        take.wanted.recipe.set(knob, value).unwrap();
        take.renew(false).unwrap();
        let Results { breakdown, cels, .. } = take.results();
        let fresh = genga_plot::parts::Cels::new(breakdown.clip, breakdown.sheet).unwrap();
        assert_eq!(format!("{cels:?}"), format!("{fresh:?}"), "after {knob}");
    }
}
