//! Movement as seen by a camera (画面): through the library on synthetic and real clips, and through the program.

use std::fs;

use genga::edits::Edits;
use genga::motion::{Axis, Channel, Clip, Joint, Screen, SeenFrom, Skeleton};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Role, Sheet};
use genga::signal::{Measure, Speed};
use genga::time::{Frame, FrameRate};
use genga::timing::{Amount, Omission, Stills};
use glam::DVec3;
use serde_json::json;

use crate::clips;
use crate::program::{Place, text};

/// A point that moves through the given places, one a koma.
fn point(places: impl Iterator<Item = DVec3>) -> Clip {
    let joint = Joint {
        name: "point".into(),
        parent: None,
        offset: DVec3::ZERO,
        channels: [Axis::X, Axis::Y, Axis::Z].map(Channel::Position).to_vec(),
        first_channel: 0,
        end_sites: vec![],
    };
    let rows: Vec<f64> = places.flat_map(|place| place.to_array()).collect();
    let rate = FrameRate::new(24.0).unwrap();
    let skeleton = Skeleton { joints: vec![joint] };
    Clip::new(skeleton, rate, Frame(0), rows.len() / 3, rows).unwrap()
}

/// Moves there and back within two seconds along each of the given ways in turn.
fn there_and_back(ways: &[DVec3]) -> Clip {
    let there = |at: u32| 0.5 - 0.5 * (f64::from(at) / 48.0 * std::f64::consts::TAU).cos();
    point(ways.iter().flat_map(move |way| (0..48).map(move |at| there(at) * *way)))
}

fn recipe(settings: &[(&str, &str)]) -> Recipe {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    recipe
}

fn sheet(clip: &Clip, settings: &[(&str, &str)]) -> Sheet {
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run(&recipe(settings), &Edits::default()).unwrap().sheet.clone()
}

/// The source places of the genga.
fn genga(sheet: &Sheet) -> Vec<f64> {
    let drawings = sheet.layers[0].drawings.iter();
    drawings.filter(|drawing| drawing.role == Role::Genga).map(|one| one.source.place()).collect()
}

fn screen(seen_from: &str, clip: &Clip) -> Screen {
    Screen::new(seen_from.parse().unwrap(), clip)
}

#[test]
fn what_comes_straight_at_us_has_no_key_and_what_crosses_the_screen_has() {
    let clip = there_and_back(&[DVec3::Z]);
    let genga = |seen_from: &str| genga(&sheet(&clip, &[("seen_from", seen_from)])).len();
    assert!(genga("world") > 0 && genga("side") == genga("world"));
    assert_eq!(genga("front"), 0);
    assert_eq!(genga("0,0,1e9:0,0,0"), 0, "from far in front");
    assert!(genga("0.5,0.5,3:0.5,0.5,0") > 0, "beside a near eye it goes outwards as it comes");
}

#[test]
fn from_far_off_keys_are_those_of_the_side_it_looks_from() {
    let clip = there_and_back(&[DVec3::Z, DVec3::new(0.6, 0.0, 0.6), DVec3::X]);
    let genga = |seen_from: &str| genga(&sheet(&clip, &[("seen_from", seen_from)]));
    assert_eq!(genga("front"), genga("0,0,1e7:0,0,0"));
    assert_eq!(genga("front"), genga("0,0,-1e7:0,0,0"), "a mirror image moves alike");
    assert_eq!(genga("side"), genga("-1e7,0,0:0,0,0"));
    assert_ne!(genga("front"), genga("side"));
}

#[test]
fn left_out_is_what_is_fastest_on_the_screen() {
    // Fast towards the camera, then less fast to the right.
    let clip = there_and_back(&[2.0 * DVec3::Z, DVec3::X]);
    let ones = Sheet::on_ones(clip.clock(24.0), clip.len());
    let left_out = |screen: &Screen| {
        let stills = Stills::on(&clip, &ones.layers[0], screen);
        let settings = Omission {
            naka_nashi: Amount::Count(4),
            koma_dori: Amount::Count(0),
            ..Omission::default()
        };
        let layer = settings.apply(&ones.layers[0], &stills, 1).unwrap().layer;
        let kept: Vec<f64> = layer.drawings.iter().map(|one| one.source.place()).collect();
        let gone = (0..clip.len()).map(|place| place as f64).filter(|at| !kept.contains(at));
        gone.collect::<Vec<f64>>()
    };
    let [world, side, front] =
        ["world", "side", "front"].map(|from| left_out(&screen(from, &clip)));
    assert_eq!(world.len(), 4);
    assert!(world.iter().all(|place| *place < 48.0), "{world:?}");
    assert_eq!(side, world, "the way to us is seen in full from the side");
    assert_eq!(front.len(), 4);
    assert!(front.iter().all(|place| *place >= 48.0), "{front:?}");
}

#[test]
fn displacements_are_of_the_screen_and_rotations_are_not() {
    let clip = there_and_back(&[DVec3::Z, DVec3::X]);
    let speeds = |measure, from: &str| {
        let signals = Speed { measure }.measure_on(&clip, &screen(from, &clip)).unwrap();
        signals.values.column(0).iter().copied().collect::<Vec<f64>>()
    };
    let world = speeds(Measure::Displacement, "world");
    let front = speeds(Measure::Displacement, "front");
    assert!(front[..48].iter().all(|speed| *speed == 0.0) && world[12] > 1.0);
    assert_eq!(front[49..], world[49..]);
    let kick = clips::sample("kick.bvh");
    for (measure, is_seen) in [
        (Measure::Rotation, false),
        (Measure::Displacement, true),
        (Measure::Combined, true),
        (Measure::Angle, false),
    ] {
        let in_world = Speed { measure }.measure(&kick).unwrap();
        let seen = Speed { measure }.measure_on(&kick, &screen("front", &kick)).unwrap();
        assert_eq!(seen != in_world, is_seen, "{measure:?}");
        assert_eq!(measure.is_seen(), is_seen);
    }
}

#[test]
fn on_ones_to_threes_what_comes_straight_at_us_is_on_threes() {
    let clip = there_and_back(&[DVec3::Z, DVec3::X]);
    let early = |from: &str| {
        let sheet = sheet(&clip, &[("spacing.on", "1-3"), ("seen_from", from)]);
        let exposures = sheet.layers[0].timed().filter(|(begin, _)| *begin < 44);
        exposures.count()
    };
    let (front, side) = (early("front"), early("side"));
    assert!(front <= 44_usize.div_ceil(3) && side > front + 3, "{front} {side}");
}

#[test]
fn an_engine_that_looks_from_here_and_there_gives_what_a_fresh_one_gives() {
    let clip = clips::sample("kick.bvh");
    let mut engine = Engine::new(clip.clone()).unwrap();
    for others in [
        vec![],
        vec![("speed.measure", "displacement"), ("keys.merge", "union")],
        vec![("spacing.on", "1-3"), ("layers", "limbs")],
    ] {
        let mut sheets = Vec::new();
        for from in ["world", "front", "100,90,300:0,90,0", "front", "world", "side"] {
            let settings = [&others[..], &[("seen_from", from)]].concat();
            let used = engine.run(&recipe(&settings), &Edits::default()).unwrap();
            let (used, speed) = (used.sheet.clone(), used.speed.clone());
            let mut fresh = Engine::new(clip.clone()).unwrap();
            let fresh = fresh.run(&recipe(&settings), &Edits::default()).unwrap();
            assert!(&used == fresh.sheet && &speed == fresh.speed, "{settings:?}");
            sheets.push(used);
        }
        assert!(sheets[0] == sheets[4] && sheets[1] == sheets[3]);
        assert!(sheets[0] != sheets[1] && sheets[1] != sheets[2] && sheets[1] != sheets[5]);
    }
}

#[test]
fn real_clips_have_a_whole_sheet_from_every_side() {
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let mut engine = Engine::new(clip).unwrap();
        let mut sheets = Vec::new();
        for from in ["world", "front", "side", "auto"] {
            let breakdown = engine.run(&recipe(&[("seen_from", from)]), &Edits::default()).unwrap();
            let layer = &breakdown.sheet.layers[0];
            assert_eq!(layer.length(), breakdown.spaced.length(), "{name} from {from}");
            assert!(layer.count(Role::Genga) > 0, "{name} from {from}");
            sheets.push(breakdown.sheet.clone());
        }
        assert!(sheets[0] != sheets[1] || sheets[0] != sheets[2], "{name}: nothing changes");
    }
}

#[test]
fn a_place_that_cannot_see_is_refused() {
    let place = DVec3::ONE;
    let nowhere = SeenFrom::Eye(genga::motion::Eye { at: place, target: place });
    let recipe = Recipe { seen_from: nowhere, ..Recipe::default() };
    let message = recipe.validate().unwrap_err().to_string();
    assert!(message.starts_with("seen_from: expected world | auto | front | "), "{message}");
    assert!(message.ends_with("found \"1,1,1:1,1,1\""), "{message}");
    let error = Recipe::parse("seen_from = \"top\"\n").unwrap_err().to_string();
    assert!(
        error.contains("1:13: seen_from: expected world | auto | front | side | three-quarter"),
        "{error}"
    );
}

/// A glTF document with one camera 4 m in front of the kick, at the height of the hips, whose parent is animated.
fn camera() -> serde_json::Value {
    json!({
        "asset": { "version": "2.0" },
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.5, "znear": 0.1 } }],
        "nodes": [{ "children": [1] }, { "name": "Cut 12", "camera": 0, "translation": [0, 1, 4] }],
        "animations": [{ "channels": [{ "target": { "node": 0, "path": "translation" } }] }],
    })
}

#[test]
fn a_run_tells_from_where_it_measured_and_its_recipe_gives_the_same_sheet() {
    let place = Place::new();
    place.done("run data/kick.bvh --out world");
    let said = text(&place.genga("run data/kick.bvh --out front --seen-from front").stderr);
    assert!(said.contains("seen from   画面       front"), "{said}");
    let (world, front) = (place.files("world"), place.files("front"));
    assert!(text(&front["recipe.toml"]).contains("\nseen_from = \"front\"\n"));
    assert!(text(&front["report.json"]).contains("\"seen_from\": \"front\""));
    assert!(text(&front["sheet.json"]).contains("\"seen_from\": \"front\""));
    assert!(text(&front["sheet.svg"]).contains("画面"));
    assert_ne!(front["sheet.csv"], world["sheet.csv"]);
    assert!(!text(&world["report.json"]).contains("seen_from"));
    assert!(!text(&world["sheet.svg"]).contains("画面"));
    place.done("run data/kick.bvh --out again --recipe front/recipe.toml");
    assert_eq!(place.files("again"), front);
    place.done("deliver front/sheet.json data/kick.bvh --to bars --out bars");
    assert!(text(&place.files("bars")["sheet.svg"]).contains("画面"), "the sheet says it too");
    place.done("run data/kick.bvh --out back --recipe front/recipe.toml --seen-from world");
    assert_eq!(place.files("back")["sheet.csv"], world["sheet.csv"]);
}

#[test]
fn a_camera_of_a_file_becomes_a_place_in_the_recipe() {
    let place = Place::new();
    fs::write(place.path("cut.gltf"), camera().to_string()).unwrap();
    let said = text(&place.genga("run data/kick.bvh --out a --seen-from cut.gltf").stderr);
    assert!(said.contains("camera Cut 12 of cut.gltf moves"), "{said}");
    assert!(said.contains("[W_CAMERA_MOVES]"), "{said}");
    let recipe = text(&place.files("a")["recipe.toml"]);
    let line = recipe.lines().find(|line| line.starts_with("seen_from")).unwrap();
    assert!(line.starts_with("seen_from = \"0,100,400:0,100,"), "{line}");
    let from = line.split('"').nth(1).unwrap();
    place.done(&format!("run data/kick.bvh --out b --seen-from {from}"));
    assert_eq!(place.files("a")["sheet.csv"], place.files("b")["sheet.csv"]);
    let keys = |from: &str| place.done(&format!("keys data/kick.bvh --seen-from {from}"));
    assert_eq!(keys("cut.gltf"), keys(from));
}

#[test]
fn omission_alone_looks_from_there_too() {
    let place = Place::new();
    place.done("omit data/kick.bvh --out w.bvh --plot w.svg");
    let said = place.genga("omit data/kick.bvh --out f.bvh --plot f.svg --seen-from front").stderr;
    assert!(text(&said).contains("seen from   画面       front"));
    let files = place.files(".");
    assert_ne!(files["w.bvh"], files["f.bvh"]);
    assert!(text(&files["f.svg"]).contains("画面での動きの大きさ"));
    assert!(!text(&files["w.svg"]).contains("画面"));
}

#[test]
fn what_is_no_camera_is_refused_by_whose_fault_it_is() {
    let place = Place::new();
    let said = place.refused(2, "keys data/kick.bvh --seen-from top");
    assert!(said.contains("--seen-from: \"top\" is nowhere to look from"), "{said}");
    assert!(said.contains("or a .glb or .gltf file with a camera"), "{said}");
    let said = place.refused(1, "keys data/kick.bvh --seen-from none.glb");
    assert!(said.contains("none.glb"), "{said}");
    fs::write(place.path("cut.gltf"), camera().to_string()).unwrap();
    let said = place.refused(1, "keys data/kick.bvh --seen-from cut.gltf:Top");
    assert!(said.contains("cut.gltf: there is no camera Top; there is Cut 12"), "{said}");
    place.done("run data/kick.bvh --out made --deliver glb -q");
    let said = place.refused(1, "keys data/kick.bvh --seen-from made/limited.glb");
    assert!(said.contains("it has no camera that stands in its scene"), "{said}");
    let before = fs::read(place.path("cut.gltf")).unwrap();
    let said = place.refused(2, "keys data/kick.bvh --seen-from cut.gltf --out cut.gltf");
    assert!(said.contains("camera"), "{said}");
    assert_eq!(fs::read(place.path("cut.gltf")).unwrap(), before);
}
