//! Gaits and the phases of their steps, and clips without gaits.

use std::collections::BTreeMap;
use std::fs;

use genga::edits::{Edits, Forbidden, Move, Pin};
use genga::keys::{AtGaits, Choose, Origin, WalkStep};
use genga::motion::{Clip, Gait, Step};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Exposure, Layer, Reason, Role};
use genga::time::Frame;
use genga_lab::study::Noise;

use crate::clips;
use crate::one_motion::every_other_frame;
use crate::rerig::Rerig;

const WALKS: [&str; 2] = ["cmu-07_01-walk", "cmu-09_01-run"];

/// Largest distance in koma between the phases of clips of one motion.
const NEAR: f64 = 0.5;

fn gaits(clip: &Clip) -> Vec<Gait> {
    Gait::find(clip, clip.clock(24.0))
}

/// The phases of a step by name.
fn phases(step: &Step) -> [(&'static str, f64); 4] {
    let Step { contact, down, passing, up, .. } = *step;
    [("contact", contact), ("down", down), ("passing", passing), ("up", up)]
}

/// Distances in koma of a gait's phases from the marks of `docs/lab/evidence/events.csv`, made by eye.
fn off_marks(name: &str, clip: &Clip) -> Vec<f64> {
    let marks = fs::read_to_string(clips::here("docs/lab/evidence/events.csv")).unwrap();
    let marks = marks.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let marks = marks.filter(|mark| mark[..2] == [name, "gait"]);
    let gaits = gaits(clip);
    let steps = || gaits.iter().flat_map(|gait| &gait.steps);
    let frames = clip.rate().fps() / 24.0;
    let off = |mark: Vec<&str>| {
        let [from, to] = [2, 3].map(|at| mark[at].parse::<f64>().unwrap());
        let of_kind = steps().flat_map(phases).filter(|(kind, _)| *kind == mark[4]);
        let off = of_kind.map(|(_, koma)| {
            let frame = clip.first().0 as f64 + koma * frames;
            (from - frame).max(frame - to).max(0.0) / frames
        });
        off.fold(f64::INFINITY, f64::min)
    };
    marks.map(off).collect()
}

#[test]
fn phases_are_where_an_eye_sees_them() {
    clips::with(WALKS, |paths| {
        for path in paths {
            let name = clips::name(&path);
            let off = off_marks(&name, &clips::read(&path));
            assert!(off.len() >= 14 && off.iter().all(|off| *off <= 1.0), "{name}: {off:?}");
        }
    });
}

#[test]
fn who_walks_or_runs_has_a_gait_and_nobody_else() {
    clips::with_all(|paths| {
        for path in paths {
            let name = clips::name(&path);
            let found = gaits(&clips::read(&path));
            let steps: Vec<usize> = found.iter().map(|gait| gait.steps.len()).collect();
            match &name[..] {
                "cmu-07_01-walk" => assert_eq!(steps, [5]),
                "cmu-09_01-run" => assert_eq!(steps, [4]),
                "cmu-01_06-playground-long" => assert!((2..=5).contains(&steps.len()), "{steps:?}"),
                _ => assert!(steps.is_empty(), "{name}: {found:?}"),
            }
        }
    });
    for name in ["kick.bvh", "kuroda-pitch.bvh", "pitch.bvh", "swing.bvh", "tennis.bvh"] {
        assert!(gaits(&clips::sample(name)).is_empty(), "{name}");
    }
}

/// Checks that the phases of walk and run agree with those of clips made from them, which are `later` koma late.
fn agree(later: f64, made: impl Fn(&Clip) -> Clip) {
    clips::with(WALKS, |paths| {
        for path in paths {
            let clip = clips::read(&path);
            let [one, other] = [&clip, &made(&clip)].map(gaits);
            let steps: Vec<&Step> = one.iter().flat_map(|gait| &gait.steps).collect();
            let others: Vec<&Step> = other.iter().flat_map(|gait| &gait.steps).collect();
            assert!(!others.is_empty() && others.len() + later as usize >= steps.len());
            // Ignores a step that is cut off, whose contact is a guess.
            for step in others.iter().filter(|step| step.contact > 0.0) {
                let near = |own: &&&Step| (own.passing - step.passing - later).abs() <= NEAR;
                let own = steps.iter().find(near).expect("it is a step of both");
                let off = phases(own).into_iter().zip(phases(step));
                let off: Vec<f64> = off.map(|(a, b)| (a.1 - b.1 - later).abs()).collect();
                assert!(own.foot == step.foot && off.iter().all(|off| *off <= NEAR), "{off:?}");
            }
        }
    });
}

#[test]
fn another_rate_noise_and_another_rig_move_no_phase() {
    agree(0.0, every_other_frame);
    agree(0.0, |clip| Noise { degrees: 0.1, seed: 1 }.on(clip));
    let rerig = Rerig { first_order: 4, other_axes: true, scale: 2.54 };
    agree(0.0, |clip| rerig.apply(clip));
}

#[test]
fn a_clip_that_begins_a_koma_later_has_its_phases_a_koma_earlier() {
    agree(1.0, |clip| {
        let begin = clip.first().0 + (clip.rate().fps() / 24.0).round() as usize;
        clip.clone().trimmed(Frame(begin), Frame(clip.first().0 + clip.len())).unwrap()
    });
}

/// Clips with gaits: a walk, a run, and walks among much else.
const GAITS: [&str; 3] = ["cmu-07_01-walk", "cmu-09_01-run", "cmu-01_06-playground-long"];

/// A sheet and its whole steps.
struct Walked {
    layer: Layer,
    /// Per gait, the koma from contact to contact.
    steps: Vec<Vec<(usize, usize)>>,
}

fn walked(clip: Clip, edits: &Edits) -> Walked {
    let mut engine = Engine::new(clip).unwrap();
    let breakdown = engine.run(&Recipe::default(), edits).unwrap();
    let first = breakdown.first_layer();
    let koma = |frame: Frame| {
        let shows = |drawing: usize| first.layer.drawings[drawing].source.place() == frame.0 as f64;
        first.layer.timed().find(|(_, exposure)| shows(exposure.drawing)).map(|(begin, _)| begin)
    };
    let whole = |step: &WalkStep| {
        let [contact, next] =
            [step.frames.first(), step.frames.last()].map(|frame| koma((*frame?)?));
        Some((contact?, next?))
    };
    let steps = first.keys.gaits.iter().map(|walk| walk.regular().filter_map(whole).collect());
    Walked { layer: first.layer.clone(), steps: steps.collect() }
}

/// Koma of each exposure that begins within a range.
fn exposures(layer: &Layer, (from, to): (usize, usize)) -> Vec<usize> {
    let inside = layer.timed().filter(|(begin, _)| (from..to).contains(begin));
    inside.map(|(_, exposure)| exposure.koma).collect()
}

/// Koma of each phase within a range, inbetweens included.
fn phases_shown(layer: &Layer, (from, to): (usize, usize)) -> Vec<usize> {
    let is_step = |drawing: usize| layer.drawings[drawing].why.reason == Some(Reason::Step);
    let steps = layer.timed().filter(|(_, exposure)| is_step(exposure.drawing));
    let mut begins: Vec<usize> =
        steps.map(|(begin, _)| begin).filter(|begin| (from..to).contains(begin)).collect();
    begins.push(to);
    begins.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

#[test]
fn steps_as_long_as_each_other_have_the_same_exposures() {
    clips::with(GAITS, |paths| {
        for path in paths {
            let name = clips::name(&path);
            let Walked { layer, steps } = walked(clips::read(&path), &Edits::default());
            assert!(!steps.is_empty(), "{name}");
            for steps in steps {
                let mut of_length: BTreeMap<usize, (Vec<usize>, Vec<usize>)> = BTreeMap::new();
                for step in steps {
                    let now = (exposures(&layer, step), phases_shown(&layer, step));
                    assert_eq!(now.0.iter().sum::<usize>(), step.1 - step.0, "{name}: {step:?}");
                    // The run passes too soon for a *down* before it.
                    let phases = if name == "cmu-09_01-run" { 3 } else { 4 };
                    assert_eq!(now.1.len(), phases, "{name}: {step:?}");
                    assert!(now.0.iter().all(|koma| *koma >= 2), "{name}: {step:?} {now:?}");
                    let like = of_length.entry(step.1 - step.0).or_insert_with(|| now.clone());
                    assert_eq!(*like, now, "{name}: {step:?}");
                }
                let lengths: Vec<_> = of_length.into_iter().collect();
                for pair in lengths.windows(2).filter(|pair| pair[0].0 + 1 == pair[1].0) {
                    let apart = pair[0].1.1.iter().zip(&pair[1].1.1).map(|(a, b)| b - a);
                    assert_eq!(apart.filter(|koma| *koma > 0).count(), 1, "{name}: {pair:?}");
                }
            }
        }
    });
}

#[test]
fn a_run_shows_its_phases_when_they_are() {
    clips::with(["cmu-09_01-run"], |[path]| {
        let clip = clips::read(&path);
        let mut engine = Engine::new(clip).unwrap();
        let sheet = engine.run(&Recipe::default(), &Edits::default()).unwrap().sheet.clone();
        let layer = &sheet.layers[0];
        for (koma, shown) in layer.timed() {
            let drawing = &layer.drawings[shown.drawing];
            let place = drawing.source.place() - sheet.clock.place_from_koma(0);
            let late = koma as f64 - place / sheet.clock.frames_in_koma();
            let is_phase = drawing.role == Role::Genga;
            assert!(!is_phase || late.abs() <= 1.25, "koma {}: {late} koma late", koma + 1);
        }
    });
}

#[test]
fn passings_are_drawn() {
    clips::with(["cmu-07_01-walk"], |[path]| {
        let clip = clips::read(&path);
        let koma = clip.rate().fps() / 24.0;
        let mut engine = Engine::new(clip).unwrap();
        let breakdown = engine.run(&Recipe::default(), &Edits::default()).unwrap();
        let layer = &breakdown.sheet.layers[0];
        let genga = layer.drawings.iter().filter(|drawing| drawing.role.is_kept());
        let places: Vec<f64> = genga.map(|drawing| drawing.source.place()).collect();
        let marks = fs::read_to_string(clips::here("docs/lab/evidence/events.csv")).unwrap();
        let is_passing = |mark: &Vec<&str>| {
            mark[0] == "cmu-07_01-walk"
                && ["gait", "second-eye"].contains(&mark[1])
                && mark[4] == "passing"
        };
        let marks = marks.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let marks: Vec<_> = marks.filter(is_passing).collect();
        let hit = |mark: &&Vec<&str>| {
            let [from, to] = [2, 3].map(|at| mark[at].parse::<f64>().unwrap());
            places.iter().any(|place| from - koma <= *place && *place <= to + koma)
        };
        let hits = marks.iter().filter(hit).count();
        assert!(marks.len() >= 10 && hits * 5 >= marks.len() * 4, "{hits} of {}", marks.len());
    });
}

#[test]
fn a_pin_or_a_move_takes_the_phases_near_it_and_leaves_all_others() {
    clips::with(["cmu-07_01-walk"], |[path]| {
        let clip = clips::read(&path);
        let koma = clip.rate().fps() / 24.0;
        let before = walked(clip.clone(), &Edits::default());
        let genga = |layer: &Layer| -> Vec<(usize, f64)> {
            let all = layer.timed().map(|(koma, shown)| (koma, &layer.drawings[shown.drawing]));
            let genga = all.filter(|(_, drawing)| drawing.role == Role::Genga);
            genga.map(|(koma, drawing)| (koma, drawing.source.place())).collect()
        };
        let phases = genga(&before.layer);
        let check = |edits: &Edits, from: Option<f64>, to: f64| {
            let after = walked(clip.clone(), edits);
            assert_eq!(after.steps.len(), before.steps.len(), "{to}");
            let away = |place: f64| (place - to).abs();
            let nearest = phases.iter().map(|(_, place)| *place);
            let nearest = nearest.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap();
            // Within a koma of a phase it takes that place, and its koma; else it takes all that are near.
            let takes = |place: f64| match away(nearest) < koma {
                true => place == nearest || away(place) < koma,
                false => away(place) < 2.0 * koma,
            };
            let is_far = |(_, place): &&(usize, f64)| !takes(*place) && Some(*place) != from;
            let stay: Vec<_> = phases.iter().filter(is_far).collect();
            let now = genga(&after.layer);
            let own: Vec<_> = now.iter().filter(|(_, place)| *place != to).collect();
            assert_eq!(own, stay, "{from:?} {to}");
            let (there, _) = now.iter().find(|(_, place)| *place == to).unwrap();
            let own = phases.iter().find(|(_, place)| *place == nearest && away(nearest) < koma);
            assert!(own.is_none_or(|(koma, _)| koma == there), "{to}: {now:?}");
        };
        for pair in phases.windows(2) {
            let [from, next] = [pair[0].1, pair[1].1];
            for share in [0.1, 0.5, 0.9] {
                let to = (from + share * (next - from)).round();
                let pin = Pin::parse(&to.to_string()).unwrap();
                check(&Edits { pins: vec![pin], ..Edits::default() }, None, to);
                let ends = [from, to].map(|place| Frame(place as usize));
                let moved = Move { from: ends[0], to: ends[1], name: None, weight: None };
                check(&Edits { moves: vec![moved], ..Edits::default() }, Some(from), to);
            }
        }
    });
}

#[test]
fn a_forbidden_phase_becomes_an_inbetween_and_all_else_stays() {
    clips::with(["cmu-07_01-walk"], |[path]| {
        let clip = clips::read(&path);
        let sheet = |forbidden: Vec<Forbidden>| {
            let mut engine = Engine::new(clip.clone()).unwrap();
            let edits = Edits { forbidden, ..Edits::default() };
            let breakdown = engine.run(&Recipe::default(), &edits).unwrap();
            let layer = &breakdown.sheet.layers[0];
            let drawing = |(koma, shown): (usize, Exposure)| {
                let drawing = &layer.drawings[shown.drawing];
                (koma, drawing.source.place(), drawing.role)
            };
            layer.timed().map(drawing).collect::<Vec<_>>()
        };
        let before = sheet(vec![]);
        let is_genga = |(_, _, role): &(usize, f64, Role)| *role == Role::Genga;
        let genga = || before.iter().filter(|drawing| is_genga(drawing));
        assert!(genga().count() > 16);
        for (koma, place, _) in genga().copied() {
            let after = sheet(vec![Forbidden::one(Frame(place as usize))]);
            assert_eq!(before.len(), after.len(), "{place}");
            let (now, then) = (after.iter().filter(|drawing| is_genga(drawing)), genga());
            let then = then.filter(|drawing| drawing.0 != koma);
            assert!(now.eq(then), "{place}: {after:?}");
            let there = after.iter().find(|drawing| drawing.0 == koma).unwrap();
            assert_eq!(there.2, Role::Inbetween, "{place}");
        }
    });
}

#[test]
fn clips_without_gaits_are_what_they_were() {
    clips::with_all(|paths| {
        for path in paths {
            let mut engine = Engine::new(clips::read(&path)).unwrap();
            let mut sheet = |gaits| {
                let keys = Choose { gaits, ..Choose::default() };
                let recipe = Recipe { keys, ..Recipe::default() };
                let breakdown = engine.run(&recipe, &Edits::default()).unwrap();
                let keys = &breakdown.first_layer().keys.keys;
                let has_steps = keys.iter().any(|key| key.origin == Origin::Step);
                (breakdown.sheet.layers.clone(), has_steps)
            };
            let ([steps, off], name) =
                ([AtGaits::Steps, AtGaits::Off].map(&mut sheet), clips::name(&path));
            assert!(!off.1, "{name}");
            assert_eq!(steps.0 != off.0, GAITS.contains(&&name[..]), "{name}");
        }
    });
}
