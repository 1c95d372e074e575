//! Rests are holds (止め), and holds are clean.

use genga::edits::{Edits, Hold, Pin};
use genga::motion::Clip;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Layer, Role};

use crate::{clips, small_gestures};

/// An empty list of koma.
const NONE: [usize; 0] = [];

fn recipe(settings: &[(&str, &str)]) -> Recipe {
    let mut recipe = Recipe::default();
    settings.iter().for_each(|(name, value)| recipe.set(name, value).unwrap());
    recipe
}

fn layer(clip: &Clip, settings: &[(&str, &str)], edits: &Edits) -> Layer {
    let mut engine = Engine::new(clip.clone()).unwrap();
    engine.run(&recipe(settings), edits).unwrap().sheet.layers[0].clone()
}

/// The koma of drawings that last a single koma, and are neither pinned, held by hand, nor just before one that is.
fn twitches(layer: &Layer) -> Vec<usize> {
    let shown: Vec<_> = layer.timed().collect();
    let why = |at: usize| shown.get(at).map(|(_, shown)| &layer.drawings[shown.drawing].why);
    let is_set = |at: usize| why(at).is_some_and(|why| why.pinned.is_some() || why.hold_set);
    let is_twitch = |at: &usize| shown[*at].1.koma == 1 && !is_set(*at) && !is_set(at + 1);
    (0..shown.len()).filter(is_twitch).map(|at| shown[at].0).collect()
}

#[test]
fn on_twos_and_threes_nothing_stays_for_one_koma_on_any_clip() {
    let settings: [&[(&str, &str)]; 8] = [
        &[("spacing.on", "2")],
        &[("spacing.on", "3")],
        &[("spacing.on", "2-4")],
        &[("spacing.on", "2"), ("spacing.inbetweens", "2")],
        &[("spacing.on", "2-3"), ("spacing.drift", "0"), ("omission.koma_dori", "60%")],
        &[("spacing.on", "2"), ("keys.merge", "union"), ("keys.contacts", "keys")],
        &[("spacing.on", "2"), ("keys.rank", "strength"), ("omission.order", "koma_dori_first")],
        &[("spacing.on", "2"), ("layers", "limbs")],
    ];
    let samples = ["kick", "kuroda-pitch", "pitch", "swing", "tennis"];
    let samples = samples.map(|name| clips::here(&format!("data/{name}.bvh")));
    for path in clips::all().into_iter().chain(samples) {
        let clip = clips::read(&path);
        let mut engine = Engine::new(clip.clone()).unwrap();
        for settings in settings {
            let sheet = engine.run(&recipe(settings), &Edits::default()).unwrap().sheet;
            for layer in &sheet.layers {
                let name = format!("{}, {settings:?}, {}", clips::name(&path), layer.name);
                assert_eq!(twitches(layer), NONE, "{name}");
            }
        }
        // A hold set by a person takes koma from inbetweens, and leaves none with a single koma.
        let frames = (clip.first().0..clip.first().0 + clip.len()).step_by(1 + clip.len() / 12);
        let holds = frames.map(|frame| Hold::parse(&format!("{frame}:3")).unwrap()).collect();
        let held = Edits { holds, ..Edits::default() };
        let sheet = engine.run(&recipe(&[("spacing.on", "2")]), &held).unwrap().sheet;
        assert_eq!(twitches(&sheet.layers[0]), NONE, "{}, held", clips::name(&path));
    }
}

#[test]
fn somebody_who_sits_or_stands_is_one_drawing() {
    for name in ["sitting", "standing"] {
        let layer = layer(&small_gestures::clip(name), &[], &Edits::default());
        assert_eq!(layer.drawings.len(), 1, "{name}: breathing is no drawing");
        assert_eq!(layer.longest_hold(), 289);
        let moving =
            self::layer(&small_gestures::clip(name), &[("spacing.drift", "0")], &Edits::default());
        assert!(moving.drawings.len() > 60, "{name}: as everywhere");
    }
}

#[test]
fn somebody_who_talks_is_drawn_where_they_move_and_held_in_between() {
    let layer = layer(&small_gestures::clip("talking"), &[], &Edits::default());
    let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
    assert!(layer.drawings.len() < 24, "{begins:?}");
    assert!(layer.longest_hold() >= 30, "{begins:?}");
    for (begin, seconds) in small_gestures::gestures() {
        let [from, to] = [begin, begin + seconds].map(|time| (24.0 * time).round() as usize);
        let drawn = begins.iter().filter(|koma| (from..=to).contains(koma)).count();
        assert!(drawn >= 2, "{drawn} drawings from koma {from} to {to}: {begins:?}");
    }
}

#[test]
fn a_pin_in_a_rest_is_a_drawing_and_the_hold_goes_on_behind_it() {
    let pins = vec![Pin::parse("600:blink").unwrap()];
    let edits = Edits { pins, ..Edits::default() };
    let layer = layer(&small_gestures::clip("sitting"), &[], &edits);
    let begins: Vec<usize> = layer.timed().map(|(begin, _)| begin).collect();
    assert_eq!(begins, [0, 120], "the pin holds up to the end");
    assert_eq!(layer.drawings[1].role, Role::Genga);
    assert_eq!(layer.drawings[1].why.pinned.as_deref(), Some("blink"));
}

#[test]
fn a_drawing_of_a_rest_may_be_held_for_less_by_hand() {
    let holds = vec![Hold::parse("0:12").unwrap()];
    let clip = small_gestures::clip("sitting");
    let free = layer(&clip, &[], &Edits::default());
    let held = layer(&clip, &[], &Edits { holds, ..Edits::default() });
    assert_eq!(held.exposures, free.exposures, "there is nothing to take its place");
}
