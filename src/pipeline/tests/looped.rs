//! Loops: the sheet of a cycle repeats, wherever the clip begins.

use super::walking::{ROUND, walk};
use super::*;
use crate::motion::{Poser, played_out};
use crate::sheet::Layer;

/// Koma of a round.
const KOMA: usize = 26;

fn looped() -> Recipe {
    Recipe { r#loop: true, ..Recipe::default() }
}

fn engine(phase: f64) -> Engine {
    Engine::new(walk(phase, ROUND + 1, 0.0)).unwrap()
}

/// Returns the places of the drawings of a layer that are genga.
fn genga(layer: &Layer) -> Vec<f64> {
    let kept = layer.drawings.iter().filter(|drawing| drawing.role == Role::Genga);
    kept.map(|drawing| drawing.source.place()).collect()
}

#[test]
fn a_round_has_every_drawing_once_and_none_at_an_end() {
    let mut engine = engine(0.3);
    let Breakdown { sheet, spaced, clip, source, .. } =
        engine.run(&looped(), &Edits::default()).unwrap();
    assert_eq!((sheet.length(), spaced.length()), (KOMA, KOMA));
    assert_eq!(sheet.repeat.unwrap().frames, ROUND);
    assert_eq!(clip, source);
    let layer = &sheet.layers[0];
    let shown: Vec<usize> = layer.exposures.iter().map(|shown| shown.drawing).collect();
    assert_eq!(shown, (0..layer.drawings.len()).collect::<Vec<_>>());
    assert!(layer.drawings.iter().all(|drawing| drawing.role != Role::End));
    assert!(layer.drawings[0].role == Role::Genga, "the round begins with a genga");
    let places: Vec<f64> = layer.drawings.iter().map(|drawing| drawing.source.place()).collect();
    assert!(places.iter().all(|place| (0.0..ROUND as f64).contains(place)), "{places:?}");
    let falls = places.windows(2).filter(|pair| pair[1] <= pair[0]).count();
    assert!(falls <= 1, "time goes on, but for the seam: {places:?}");
    // The step over the seam is a step like the others.
    let gap = (places[0] - places[places.len() - 1]).rem_euclid(ROUND as f64);
    let held = layer.exposures[layer.exposures.len() - 1].koma as f64;
    assert!((gap / 2.0 - held).abs() <= 2.0, "{gap} frames in {held} koma");
}

#[test]
fn a_cycle_has_the_same_genga_wherever_the_clip_begins() {
    let at = |phase: f64| -> Vec<f64> {
        let mut engine = engine(phase);
        let run = engine.run(&looped(), &Edits::default()).unwrap();
        let own = genga(&run.sheet.layers[0]);
        let mut instants: Vec<f64> = own
            .iter()
            .map(|place| (place + phase * ROUND as f64).rem_euclid(ROUND as f64))
            .collect();
        instants.sort_by(f64::total_cmp);
        instants
    };
    let one = at(0.3);
    assert!(one.len() >= 4, "{one:?}");
    for phase in [0.05, 0.42, 0.6, 0.81] {
        let other = at(phase);
        let away = |instant: &f64| {
            let way = |place: &f64| (place - instant).rem_euclid(ROUND as f64);
            other.iter().map(|place| way(place).min(ROUND as f64 - way(place))).fold(99.0, f64::min)
        };
        assert_eq!(one.len(), other.len(), "{phase}: {one:?} {other:?}");
        assert!(one.iter().all(|instant| away(instant) <= 2.0), "{phase}: {one:?} {other:?}");
    }
}

#[test]
fn a_round_lasts_whole_koma_and_is_repeated_as_often_as_asked() {
    let clip = walk(0.3, ROUND + 1, 0.0).with_rate(crate::time::FrameRate::new(50.0).unwrap());
    let mut engine = Engine::new(clip).unwrap();
    let once = engine.run(&looped(), &Edits::default()).unwrap().sheet.clone();
    assert_eq!(once.length(), 25, "24.96");
    assert_eq!(once.clock.frame_rate.fps(), 50.0);
    let recipe = Recipe { cycles: 3, ..looped() };
    let thrice = engine.run(&recipe, &Edits::default()).unwrap().sheet.clone();
    assert_eq!((thrice.length(), thrice.rounds()), (75, 3));
    assert_eq!(thrice.layers[0].drawings, once.layers[0].drawings);
    assert_eq!(*thrice.first_round(), once);
}

#[test]
fn corrections_act_in_the_loop_and_over_the_seam() {
    let mut engine = engine(0.3);
    let plain = engine.run(&looped(), &Edits::default()).unwrap();
    let plain = genga(&plain.sheet.layers[0]);
    let has = |places: &[f64], frame: f64| places.iter().any(|place| (place - frame).abs() < 1.0);
    let free =
        (6..ROUND - 6).find(|frame| (-2..=2).all(|by| !has(&plain, *frame as f64 + f64::from(by))));
    let free = free.unwrap();
    let away = |place: &f64| (place - free as f64).abs().min(*place).min(ROUND as f64 - place);
    let gone = *plain.iter().max_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
    let edits = Edits {
        pins: vec![Pin::parse(&format!("{free}:mine")).unwrap(), Pin::parse("52").unwrap()],
        forbidden: not(&[gone as usize]),
        ..Edits::default()
    };
    let run = engine.run(&looped(), &edits).unwrap();
    let now = genga(&run.sheet.layers[0]);
    assert!(has(&now, free as f64) && has(&now, 0.0), "{now:?}: frame 52 is frame 0");
    assert!(away(&gone) > 4.0 && !has(&now, gone), "{gone}: {now:?}");
    let keys = &run.first_layer().keys.keys;
    assert!(keys.iter().any(|key| key.frame == Frame(free)), "{keys:?}");
    // An inbetween gives way to the hold before it.
    let ones = Recipe { r#loop: true, ..recipe(&[("spacing.on", "1")]) };
    let plain = engine.run(&ones, &Edits::default()).unwrap().sheet.layers[0].clone();
    let is = |at: usize, role: Role| plain.drawings[plain.exposures[at].drawing].role == role;
    let mut pairs = 1..plain.exposures.len();
    let last = pairs.rfind(|at| is(at - 1, Role::Genga) && is(*at, Role::Inbetween)).unwrap() - 1;
    let (place, koma) = (plain.drawings[last].source.place(), plain.exposures[last].koma + 1);
    let holds = vec![Hold { frame: Frame(place as usize), koma }];
    let held = engine.run(&ones, &Edits { holds, ..Edits::default() }).unwrap();
    let layer = &held.sheet.layers[0];
    let is_held = |shown: &&crate::sheet::Exposure| {
        (layer.drawings[shown.drawing].source.place() - place).abs() < 1e-9
    };
    assert_eq!(layer.exposures.iter().find(is_held).unwrap().koma, koma);
    assert_eq!(held.sheet.length(), KOMA);
}

#[test]
fn the_body_travels_on_from_round_to_round() {
    let mut engine = Engine::new(walk(0.3, ROUND + 1, 2.0)).unwrap();
    for root in ["ones", "drawings"] {
        let mut recipe = Recipe { cycles: 3, ..looped() };
        recipe.set("root", root).unwrap();
        let run = engine.run(&recipe, &Edits::default()).unwrap();
        let (clip, sheet) = played_out(run.clip, run.sheet);
        let mut poser = Poser::new(&clip);
        let layer = &sheet.layers[0];
        let mut far = |place: f64| poser.place(place).translations[0].z;
        let steps: Vec<f64> = match root {
            "ones" => layer.source_places(sheet.clock).into_iter().map(&mut far).collect(),
            _ => layer.koma().map(|at| far(layer.drawings[at].source.place())).collect(),
        };
        assert_eq!(steps.len(), 3 * KOMA);
        assert!(steps.is_sorted(), "{root}: {steps:?}");
        // 4 units a koma; a drawing stays for at most six koma.
        let whole = steps[3 * KOMA - 1] - steps[0];
        assert!((whole - 4.0 * (3 * KOMA - 1) as f64).abs() <= 24.0, "{root}: {whole}");
        let most = steps.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(most <= if root == "ones" { 4.5 } else { 26.0 }, "{root}: {most}");
    }
}

#[test]
fn pins_that_meet_at_the_seam_are_told_by_frames_of_the_clip() {
    let mut engine = engine(0.3);
    let pins = |frames: [usize; 2]| {
        let pin = |frame| Pin { frame: Frame(frame), name: None, weight: None };
        Edits { pins: frames.map(pin).into(), ..Edits::default() }
    };
    // At 12 koma a second, a koma has four frames.
    let recipe = Recipe { rate: 12.0, ..looped() };
    let mut refused =
        |edits: &Edits| engine.run(&recipe, edits).err().map(|error| error.to_string());
    let expected = format!(
        "edits: frames 1 and {}, pinned or moved to, fall on one koma: take one of them away",
        ROUND - 1
    );
    assert_eq!(refused(&pins([1, ROUND - 1])), Some(expected));
    let moves = vec![Move::parse(&format!("30:{ROUND}")).unwrap()];
    let twice = Edits { moves, ..pins([0, 20]) };
    let expected = "edits: frame 0 is pinned or moved to twice: once is enough";
    assert_eq!(refused(&twice).as_deref(), Some(expected));
}

#[test]
fn what_is_no_loop_is_refused_with_the_way_out() {
    let mut engine = Engine::new(walk(0.3, ROUND / 4 + 1, 0.0)).unwrap();
    let error = engine.run(&looped(), &Edits::default()).err().unwrap().to_string();
    assert!(error.starts_with("loop: the last pose is not the first: they are "), "{error}");
    assert!(error.contains("genga split --cycles") && error.contains("--trim A..B"), "{error}");
    let recipe = Recipe { cycles: 3, ..Recipe::default() };
    let error = engine.run(&recipe, &Edits::default()).err().unwrap().to_string();
    assert!(error.starts_with("cycles: only a loop has several rounds; --loop"), "{error}");
    let mut short = Engine::new(walk(0.3, 3, 0.0)).unwrap();
    let error = short.run(&looped(), &Edits::default()).err().unwrap().to_string();
    assert!(error.starts_with("loop: 3 frames are too few"), "{error}");
}

#[test]
fn a_used_engine_loops_and_runs_on_as_a_fresh_one_does() {
    let clip = walk(0.3, ROUND + 1, 1.0);
    let mut engine = Engine::new(clip.clone()).unwrap();
    let (plain, none) = (Recipe::default(), Edits::default());
    let settings = [
        vec![("layers", "limbs")],
        vec![("exaggerate.cartoon", "0.5")],
        vec![("rate", "12")],
        vec![("omission.keep_length", "false"), ("spacing.on", "1")],
        vec![("spacing.source", "blend")],
    ];
    for settings in settings {
        let looped = Recipe { r#loop: true, cycles: 2, ..recipe(&settings) };
        let used = run(&mut engine, &looped, &none);
        assert!(used == fresh(&clip, &looped, &none), "{settings:?}");
        used.sheets[1].check().unwrap();
        assert_eq!(used.clip.len(), clip.len());
        assert_eq!(used.speed.frames(), clip.len());
        let layers = &used.sheets[1].layers;
        assert!(layers.iter().all(|layer| layer.length() == layers[0].length()), "{settings:?}");
        assert!(run(&mut engine, &plain, &none) == fresh(&clip, &plain, &none));
    }
}

#[test]
fn the_rounds_of_a_loop_stand_together_in_a_cut_of_the_length_that_is_asked_for() {
    let mut engine = engine(0.3);
    let placed = |engine: &mut Engine, cycles: usize, at: Option<usize>, length: Option<usize>| {
        let recipe = Recipe { cycles, ..looped() };
        let camera = vec![CameraCue { frames: [Frame(0), Frame(8)], text: "PAN".into() }];
        let edits = Edits { at, length, camera, ..Edits::default() };
        engine.run(&recipe, &edits).map(|breakdown| breakdown.sheet.clone())
    };
    for cycles in [1, 2, 5] {
        let plain = placed(&mut engine, cycles, None, None).unwrap();
        assert_eq!(plain.cut_length(), cycles * KOMA);
        let late = placed(&mut engine, cycles, Some(25), Some(200)).unwrap();
        assert_eq!((late.cut_length(), late.length()), (200, cycles * KOMA));
        assert_eq!(late.layers, plain.layers);
        let begins = |sheet: &Sheet| sheet.camera.iter().map(|work| work.begin).collect::<Vec<_>>();
        assert_eq!(begins(&plain).len(), 1);
        assert_eq!(begins(&late), [begins(&plain)[0] + 24]);
    }
    let error = placed(&mut engine, 6, None, Some(100)).unwrap_err().to_string();
    assert!(
        error.contains("the drawings stand on koma 1 to 156, and the cut is to have 100"),
        "{error}"
    );
    assert!(placed(&mut engine, 1, None, Some(40)).is_ok());
}
