//! Keys that a person marked come back as pins.

use super::sheets::{cut_of_24, layer, sheet};
use super::writing::sample;
use crate::xdts::{Column, MarkedKey, Numbered, Xdts, marked_keys, pins, read};
use genga::edits::Edits;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Sheet, Source};
use genga::time::Frame;

fn column(file: &str) -> Column {
    read(file.as_bytes()).unwrap().columns.remove(0)
}

fn koma(column: &Column, numbered: Numbered) -> Vec<usize> {
    marked_keys(column, numbered).iter().map(|change| change.koma).collect()
}

#[test]
fn numbers_are_keys_on_a_genga_sheet_and_circles_on_a_douga_sheet() {
    let plain = Xdts::default().write(&cut_of_24(), "c1").unwrap();
    let circled = Xdts { circled: true }.write(&cut_of_24(), "c1").unwrap();
    assert_eq!(koma(&column(&plain.genga), Numbered::Keys), [0, 10, 13, 19]);
    assert_eq!(koma(&column(&circled.douga), Numbered::Drawings), [0, 10, 13, 19]);
    assert_eq!(koma(&column(&circled.douga), Numbered::Keys), [0, 10, 13, 19], "circles decide");
    assert_eq!(koma(&column(&plain.douga), Numbered::Drawings), [0; 0]);
}

#[test]
fn a_key_of_the_sheet_is_pinned_on_its_own_frame_and_another_on_that_of_its_koma() {
    let mut own = sheet(vec![layer("A", "egie", &[(0, 2), (1, 2), (2, 2), (3, 2)])]);
    own.layers[0].drawings[1].source = Source::At(19.0);
    // The person turned the inbetween on koma 4 into a key called 2a.
    let file = Xdts::default().write(&own, "c1").unwrap().genga;
    let file = file.replace("SYMBOL_TICK_1", "2a");
    let pins = pins(&column(&file), Numbered::Keys, &own, (Frame(10), Frame(39))).unwrap();
    let key = |key: &MarkedKey| (key.pin.frame.0, key.pin.name.clone().unwrap(), key.koma);
    let keys: Vec<_> = pins.iter().map(key).collect();
    // At 120 frames per second from frame 10, koma 2 is frame 20 and koma 4 is frame 30.
    let named = |(frame, name, koma): (usize, &str, Option<usize>)| (frame, name.to_owned(), koma);
    let expected = [(10, "A1", None), (19, "A2", None), (30, "A2a", Some(4)), (19, "A3", None)];
    assert_eq!(keys, expected.map(named));
}

#[test]
fn a_key_after_the_sheet_s_end_is_of_another_clip() {
    let long = Xdts::default().write(&cut_of_24(), "c1").unwrap().genga;
    let short = Sheet::on_ones(super::sheets::clock(), 19);
    let error = pins(&column(&long), Numbered::Keys, &short, (Frame(10), Frame(100)));
    let error = error.unwrap_err().to_string();
    assert!(error.contains("column A has a key on koma 20, and the sheet of this clip has 19"));
}

#[test]
fn the_keys_of_a_run_given_back_alone_are_the_same_keys() {
    let mut recipe = Recipe::default();
    recipe.set("keys.min_price", "1000").unwrap();
    for name in ["kick.bvh", "pitch.bvh"] {
        let (clip, own) = sample(name);
        let file = Xdts::default().write(&own, "c1").unwrap().genga;
        let frames = (clip.first(), clip.last());
        let pins = pins(&column(&file), Numbered::Keys, &own, frames).unwrap();
        let kept: Vec<_> = own.layers[0].drawings.iter().filter(|d| d.role.is_kept()).collect();
        assert_eq!(pins.len(), kept.len());
        let pins = pins.into_iter().map(|key| key.pin);
        let edits = Edits { pins: pins.collect(), ..Edits::default() };
        let mut engine = Engine::new(clip).unwrap();
        let again = engine.run(&recipe, &edits).unwrap().sheet;
        let places = |sheet: &Sheet| -> Vec<(usize, f64)> {
            let layer = &sheet.layers[0];
            let kept = layer.timed().filter(|(_, e)| layer.drawings[e.drawing].role.is_kept());
            kept.map(|(koma, e)| (koma, layer.drawings[e.drawing].source.place())).collect()
        };
        // A pin keeps its koma; a found key may be placed when the body has arrived, a fill later.
        for ((pinned, place), (found, own)) in places(again).into_iter().zip(places(&own)) {
            assert_eq!(place, own, "{name}");
            assert!(found.abs_diff(pinned) <= 8, "{name}: {pinned} for {found}");
        }
    }
}
