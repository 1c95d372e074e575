//! Settings of layers and passages (打ち分け), through the program and on real clips.

use std::fs;

use genga::edits::Edits;
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Layer, Sheet};
use genga::time::Frame;
use genga_files::limited_bvh;

use crate::clips;
use crate::program::{Place, text};

/// The sheet of a clip with the default recipe and some changed settings.
fn sheet(clip: &Clip, settings: &[(&str, &str)]) -> Sheet {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run_once(&recipe, &Edits::default()).unwrap().sheet.clone()
}

/// The sheet in the folder of a run.
fn of_run(place: &Place, folder: &str) -> Sheet {
    let text = fs::read(place.path(&format!("{folder}/sheet.json"))).unwrap();
    genga_files::sheet_json::read(&text).unwrap().sheet
}

/// The first koma and the number of koma of each exposure.
fn timing(layer: &Layer) -> Vec<(usize, usize)> {
    layer.timed().map(|(begin, shown)| (begin, shown.koma)).collect()
}

/// Settings that leave out and hold nothing.
const PLAIN: [(&str, &str); 3] =
    [("omission.naka_nashi", "0"), ("omission.koma_dori", "0"), ("spacing.on", "2")];

#[test]
fn a_kick_is_on_ones_within_twos() {
    let place = Place::new();
    place.done(
        "run data/kick.bvh --out a --set omission.naka_nashi=0 --set omission.koma_dori=0 --set spacing.on=2 \
         --within 30..60:spacing.on=1 --within 30..60:spacing.drift=0",
    );
    let (within, outside): (Vec<_>, Vec<_>) = timing(&of_run(&place, "a").layers[0])
        .into_iter()
        .partition(|(begin, _)| (30..60).contains(begin));
    assert!(within.iter().filter(|(_, koma)| *koma == 1).count() >= 25, "{within:?}");
    assert!(outside.iter().all(|(_, koma)| *koma >= 2), "{outside:?}");
    let plain = sheet(&clips::sample("kick.bvh"), &PLAIN);
    let begins = |layer: &Layer| {
        let begins = timing(layer).into_iter().map(|(begin, _)| begin);
        begins.filter(|begin| *begin < 30).collect::<Vec<_>>()
    };
    assert_eq!(begins(&of_run(&place, "a").layers[0]), begins(&plain.layers[0]));
}

#[test]
fn a_run_says_what_omission_took_of_a_passage() {
    let place = Place::new();
    let within = "--within 30..60:spacing.on=1";
    let said =
        |more: &str| text(&place.genga(&format!("run data/kick.bvh {within} {more}")).stderr);
    let lines = |said: &str| {
        said.lines()
            .filter(|line| line.starts_with("passage "))
            .map(String::from)
            .collect::<Vec<_>>()
    };
    let taken = lines(&said("--out a"));
    assert_eq!(taken.len(), 1, "{taken:?}");
    assert!(taken[0].starts_with("passage     区間       30..60: "), "{taken:?}");
    assert!(taken[0].contains("--within 30..60:omission.koma_dori=0 keep them"), "{taken:?}");
    let kept = "--within 30..60:omission.naka_nashi=0 --within 30..60:omission.koma_dori=0 --out b";
    assert_eq!(lines(&said(kept)), ["passage     区間       30..60: 29 drawings on 29 koma"]);
    assert_eq!(lines(&said("--layers limbs --out c")).len(), 5, "one a layer");
    assert!(lines(&text(&place.genga("run data/kick.bvh --fresh --out d").stderr)).is_empty());
}

#[test]
fn a_limb_is_on_threes_beside_a_body_on_twos() {
    let place = Place::new();
    let plain = "--set omission.naka_nashi=0 --set omission.koma_dori=0 --set spacing.drift=0 --set spacing.on=2";
    place.done(&format!("run data/kick.bvh --out a --layers limbs {plain} --set C/spacing.on=3"));
    place.done(&format!("run data/kick.bvh --out b --layers limbs {plain}"));
    let [own, all] = ["a", "b"].map(|folder| of_run(&place, folder));
    for (layer, (own, all)) in own.layers.iter().zip(&all.layers).enumerate() {
        assert_eq!(own == all, layer != 2, "{}", own.name);
    }
    assert!(own.layers[2].drawings.len() < all.layers[2].drawings.len());
    assert!(timing(&own.layers[2]).iter().filter(|(_, koma)| *koma == 3).count() > 10);
}

#[test]
fn the_recipe_of_a_run_has_the_settings_of_layers_and_passages() {
    let place = Place::new();
    fs::write(
        place.path("legs.toml"),
        "[[layers]]\nname = \"A\"\njoints = [\"Hips\"]\n\n[[layers]]\nname = \"足\"\njoints = [\"*Leg\", \"*Foot\", \"*ToeBase\"]\n[layers.spacing]\non = 3\nweight = 0.5\n",
    )
    .unwrap();
    let asked = "run data/kick.bvh --layers legs.toml --set 足/spacing.weight=0.2 \
                 --within 20..50:spacing.on=1 --within 足/40..:omission.koma_dori=0 --within 60..70";
    place.done(&format!("{asked} --out a"));
    let recipe = fs::read_to_string(place.path("a/recipe.toml")).unwrap();
    let (read, _) = Recipe::parse(&recipe).unwrap();
    let own = read.of_layer("足").spacing;
    assert_eq!(
        (own.on.most, own.weight),
        (3, 0.2),
        "the command line goes over the file of layers"
    );
    let end = "[layer.\"足\"]\nspacing.on = 3\nspacing.weight = 0.2\n";
    assert!(recipe.contains(end), "{recipe}");
    let passages = "[[passages]]\nframes = [20, 50]\nspacing.on = 1\n\n[[passages]]\nframes = \"40..\"\n\
                    layer = \"足\"\nomission.koma_dori = 0\n\n[[passages]]\nframes = [60, 70]\n";
    assert!(recipe.contains(passages), "{recipe}");
    place.done("run data/kick.bvh --out b --recipe a/recipe.toml");
    assert_eq!(place.files("a"), place.files("b"));
    place.done(&format!("{asked} --outside source --out c"));
    place.done("run data/kick.bvh --out d --recipe c/recipe.toml");
    assert_eq!(place.files("c"), place.files("d"));
    assert!(place.files("a")["sheet.json"] != place.files("c")["sheet.json"]);
    // A sheet records its recipe.
    place.done("deliver c/sheet.json data/kick.bvh --to bvh --out e");
    assert_eq!(place.files("e")["limited.bvh"], place.files("c")["limited.bvh"]);
}

#[test]
fn what_a_layer_or_passage_cannot_have_is_refused() {
    let place = Place::new();
    for (asked, answer) in [
        ("--set hair/spacing.on=3", "there is no layer hair to set; there is A (see --layers)"),
        (
            "--layers limbs --set B/rate=12",
            "B/rate: holds for the whole sheet; a layer has settings of its own in",
        ),
        (
            "--within 30..60:rate=12",
            "30..60:rate: holds for the whole take; a passage has its own keys.min_price",
        ),
        ("--within 30..60:keys.rest=3", "keys are found over the whole take"),
        (
            "--within 300..600:spacing.on=1",
            "300..600: is not in the clip, which has frames 0 to 91",
        ),
        ("--within spacing.on=1", "--within: expected [LAYER/]A..B[:KEY=VALUE]"),
        ("--within F/3..9:spacing.on=1", "there is no layer F to set"),
        ("--outside source", "there is no passage: name one with --within"),
        (
            "--outside nothing --within 3..9",
            "outside: expected one of timed, source, found \"nothing\"",
        ),
    ] {
        let said = place.genga(&format!("run data/kick.bvh --out a {asked}"));
        assert!(!said.status.success(), "{asked}");
        let said = text(&said.stderr);
        assert!(said.contains(answer), "{asked}: {said}");
        assert!(!place.path("a").exists(), "{asked}");
    }
}

/// The poses of a sheet, one row per koma.
fn shown(clip: &Clip, sheet: &Sheet) -> Clip {
    bvh::read(limited_bvh(clip, sheet).unwrap().as_bytes()).unwrap().clip
}

#[test]
fn on_real_clips_the_take_stays_as_it_is_outside_of_passages() {
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let (first, frames) = (clip.first().0, clip.len());
        let [from, past] = [first + frames / 3, first + frames / 2];
        let within = format!("{from}..{past}:spacing.on");
        let made = sheet(&clip, &[(within.as_str(), "2-3"), ("outside", "source")]);
        let source = Sheet::on_ones(made.clock, made.length());
        let [result, source] = [&made, &source].map(|sheet| shown(&clip, sheet));
        let koma = [from, past].map(|frame| made.clock.koma_from_frame(Frame(frame)));
        for at in (0..result.len()).filter(|at| !(koma[0]..koma[1]).contains(at)) {
            assert_eq!(result.row(Frame(at)), source.row(Frame(at)), "{name}: koma {}", at + 1);
        }
        assert_eq!(
            result.row(Frame(koma[0])),
            source.row(Frame(koma[0])),
            "{name}: it begins there"
        );
        let twitches = timing(&made.layers[0])
            .into_iter()
            .filter(|(begin, held)| (koma[0]..koma[1]).contains(begin) && *held == 1);
        assert_eq!(twitches.count(), 0, "{name}: {:?}", timing(&made.layers[0]));
        let drawings = made.layers[0].drawings.len();
        assert!(drawings < made.length() && drawings > made.length() / 2, "{name}: {drawings}");
    }
}

#[test]
fn on_a_real_clip_punches_are_on_ones_and_all_else_on_twos() {
    clips::with(["cmu-02_05-punch-strike"], |[path]| {
        let clip = clips::read(&path);
        // Punches, in the third second.
        let plain = sheet(&clip, &PLAIN);
        let first = plain.clock.first.0;
        let frames = |koma: usize| first + (koma as f64 * plain.clock.frames_in_koma()) as usize;
        let [from, past] = [48, 72].map(frames);
        let [on, drift] = ["on", "drift"].map(|knob| format!("{from}..{past}:spacing.{knob}"));
        let settings = [&PLAIN[..], &[(on.as_str(), "1"), (drift.as_str(), "0")]].concat();
        let made = sheet(&clip, &settings);
        let (within, outside): (Vec<_>, Vec<_>) =
            timing(&made.layers[0]).into_iter().partition(|(begin, _)| (48..72).contains(begin));
        assert!(within.iter().filter(|(_, koma)| *koma == 1).count() >= 20, "{within:?}");
        assert!(outside.iter().all(|(_, koma)| *koma >= 2), "{outside:?}");
        let genga = |sheet: &Sheet| sheet.layers[0].genga();
        assert!(genga(&made).abs_diff(genga(&plain)) <= 2, "the keys stay");
    });
}

#[test]
fn on_real_clips_another_price_within_a_passage_changes_the_genga_there_alone() {
    let mut compared = [0; 2];
    for path in clips::all() {
        let (name, clip) = (clips::name(&path), clips::read(&path));
        let clock = sheet(&clip, &[]).clock;
        let [from, past] = [3, 2].map(|part| clip.first().0 + clip.len() / part);
        // The genga before, in and after the passage; those next to its ends may give way.
        let genga = |price: &str| {
            let within = format!("{from}..{past}:keys.min_price");
            let made = sheet(&clip, &[(within.as_str(), price)]);
            let kept = made.layers[0].drawings.iter().filter(|drawing| drawing.role.is_kept());
            let mut parts = [const { Vec::new() }; 3];
            for place in kept.map(|drawing| drawing.source.place()) {
                parts[usize::from(place >= from as f64) + usize::from(place >= past as f64)]
                    .push(place);
            }
            parts
        };
        let [usual, few, many] = ["7.5", "60", "1"].map(genga);
        assert!(few[1].len() <= usual[1].len() && usual[1].len() <= many[1].len(), "{name}");
        compared[0] += usize::from(few[1].len() < usual[1].len());
        compared[1] += usize::from(usual[1].len() < many[1].len());
        let second = 24.0 * clock.frames_in_koma();
        let far = |place: &&f64| **place < from as f64 - second || **place > past as f64 + second;
        let beside =
            |parts: &[Vec<f64>; 3]| parts.iter().flatten().filter(far).copied().collect::<Vec<_>>();
        assert_eq!(beside(&few), beside(&usual), "{name}");
        assert_eq!(beside(&many), beside(&usual), "{name}");
    }
    let real = clips::all().len();
    assert!(compared.iter().all(|changed| 2 * changed >= real), "{compared:?} of {real}");
}
