//! Settings of layers and passages (打ち分け): where they hold, and what they leave as it is.

use super::*;
use crate::sheet::Drawing;

const NONE: fn() -> Edits = Edits::default;

/// Returns the first koma and the number of koma of each drawing of a layer.
fn timing(sheet: &Sheet, layer: usize) -> Vec<(usize, usize)> {
    sheet.layers[layer].timed().map(|(begin, shown)| (begin, shown.koma)).collect()
}

/// Returns the drawing of each exposure with its first koma.
fn drawn(sheet: &Sheet, layer: usize) -> Vec<(usize, Drawing)> {
    let layer = &sheet.layers[layer];
    layer.timed().map(|(begin, shown)| (begin, layer.drawings[shown.drawing].clone())).collect()
}

#[test]
fn a_layer_with_settings_of_its_own_is_timed_as_if_all_had_them() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    for (knob, value) in
        [("spacing.on", "3"), ("omission.naka_nashi", "0"), ("keys.min_price", "30")]
    {
        let own = recipe(&[("layers", "limbs"), (&format!("C/{knob}"), value)]);
        let all = run(&mut engine, &recipe(&[("layers", "limbs"), (knob, value)]), &NONE());
        let none = run(&mut engine, &recipe(&[("layers", "limbs")]), &NONE());
        let made = run(&mut engine, &own, &NONE());
        assert!(made == fresh(&clip, &own, &NONE()), "{knob}: a used engine");
        for layer in 0..5 {
            let expected = if layer == 2 { &all } else { &none };
            assert_eq!(
                made.sheets[1].layers[layer], expected.sheets[1].layers[layer],
                "{knob} {layer}"
            );
            assert!(made.layers[layer] == expected.layers[layer], "{knob} {layer}");
        }
        assert!(all.sheets[1].layers[2] != none.sheets[1].layers[2], "{knob} changes something");
    }
}

#[test]
fn a_passage_of_the_whole_clip_is_the_recipe() {
    for clip in [pitch(), walking::clip()] {
        let mut engine = Engine::new(clip).unwrap();
        for (knob, value) in [
            ("spacing.on", "3"),
            ("spacing.weight", "0.8"),
            ("spacing.inbetweens", "2"),
            ("spacing.source", "blend"),
            ("omission.naka_nashi", "3"),
            ("omission.koma_dori", "100%"),
            ("omission.keep_length", "false"),
            ("omission.max_hold", "12"),
        ] {
            let whole = run(&mut engine, &recipe(&[(&format!("0..:{knob}"), value)]), &NONE());
            assert!(whole == run(&mut engine, &recipe(&[(knob, value)]), &NONE()), "{knob}");
        }
    }
}

#[test]
fn a_passage_with_a_price_of_its_own_changes_the_keys_in_it() {
    let clip = pitch();
    let mut engine = Engine::new(clip.clone()).unwrap();
    let mut keys = |settings: &[(&str, &str)]| {
        let made = run(&mut engine, &recipe(settings), &NONE());
        assert!(made == fresh(&clip, &recipe(settings), &NONE()), "{settings:?}: a used engine");
        made.keys.keys.iter().map(|key| key.frame.0).collect::<Vec<_>>()
    };
    let split = |keys: Vec<usize>| -> (Vec<usize>, Vec<usize>) {
        keys.into_iter().partition(|frame| (60..100).contains(frame))
    };
    let (usual, around) = split(keys(&[]));
    let (few, beside) = split(keys(&[("60..100:keys.min_price", "60")]));
    let (many, nearby) = split(keys(&[("60..100:keys.min_price", "1")]));
    assert!(few.len() < usual.len() && usual.len() < many.len(), "{few:?} {usual:?} {many:?}");
    // A key more or less at an end of the passage may shift the one next to it.
    let last = |keys: &[usize]| keys.iter().rev().take(2).copied().collect::<Vec<_>>();
    assert_eq!([last(&beside), last(&nearby)], [last(&around), last(&around)]);
    let dear = [("keys.min_price", "30")];
    for price in ["keys.min_price", "20..:keys.min_price", "A/20..:keys.min_price"] {
        assert_eq!(keys(&[(price, "30")]), keys(&dear), "{price}");
        assert_eq!(keys(&[("keys.min_price", "0"), (price, "30")]), keys(&dear), "{price}");
    }
    // The limit picks among keys without a price; which price it tries first decides between equals.
    let none =
        [("keys.min_price", "0"), ("20..:keys.min_price", "0")].map(|own| keys(&[own]).len());
    assert_eq!(none[0], none[1], "keys without a price");
    let later = [("60..100:keys.min_price", "1"), ("20..:keys.min_price", "30")];
    assert_eq!(keys(&later), keys(&dear), "the later over the earlier");
    let limit = ("keys.per_second", "2");
    let limited = keys(&[("keys.min_price", "0"), ("60..100:keys.min_price", "3"), limit]);
    assert!(limited.len() <= 8 + 4, "the limit holds: {limited:?}");
}

#[test]
fn a_passage_is_timed_by_itself_and_nothing_else_changes() {
    let clip = pitch();
    let usual = fresh(
        &clip,
        &recipe(&[("omission.koma_dori", "0"), ("omission.naka_nashi", "0")]),
        &NONE(),
    );
    let ones = recipe(&[
        ("omission.koma_dori", "0"),
        ("omission.naka_nashi", "0"),
        ("60..90:spacing.on", "1"),
        ("60..90:spacing.drift", "0"),
    ]);
    let made = fresh(&clip, &ones, &NONE());
    assert_eq!(made.keys, usual.keys);
    // Frame 20 is koma 0.
    let (within, outside): (Vec<_>, Vec<_>) =
        timing(&made.sheets[1], 0).into_iter().partition(|(begin, _)| (40..70).contains(begin));
    assert!(within.iter().filter(|(_, koma)| *koma == 1).count() > 15, "{within:?}");
    assert!(outside.iter().all(|(_, koma)| *koma >= 2), "{outside:?}");
    let begins = |sheet: &Sheet| {
        let begins = timing(sheet, 0).into_iter().map(|(begin, _)| begin);
        begins.filter(|begin| *begin < 40).collect::<Vec<_>>()
    };
    assert_eq!(begins(&made.sheets[1]), begins(&usual.sheets[1]));
}

#[test]
fn a_later_passage_goes_over_an_earlier_one_and_both_over_the_layer() {
    let clip = pitch();
    let stacked = recipe(&[
        ("spacing.on", "2"),
        ("A/spacing.on", "4"),
        ("30..90:spacing.on", "3"),
        ("60..120:spacing.on", "2"),
    ]);
    let timing = stacked.timing_of("A", (clip.clock(24.0), clip.last()), 100);
    let on = |koma: usize| timing.spacing.at(koma).on.most;
    assert_eq!([0, 9, 10, 39, 40, 99].map(on), [4, 4, 3, 3, 2, 2]);
    let other = stacked.timing_of("B", (clip.clock(24.0), clip.last()), 100);
    assert_eq!(other.spacing.at(0).on.most, 2);
    let own = recipe(&[("B/30..90:spacing.on", "1")]);
    let on =
        |layer| own.timing_of(layer, (clip.clock(24.0), clip.last()), 100).spacing.at(20).on.most;
    assert_eq!(["A", "B"].map(on), [3, 1]);
}

#[test]
fn another_passage_does_not_choose_keys_again() {
    let mut engine = Engine::new(pitch()).unwrap();
    let mut settings = Recipe::default();
    let keys = |engine: &mut Engine, recipe: &Recipe| {
        std::ptr::from_ref(engine.run(recipe, &NONE()).unwrap().first_layer().keys)
    };
    let before = keys(&mut engine, &settings);
    for (name, value) in [
        ("60..90:spacing.on", "1"),
        ("60..90:spacing.on", "3"),
        ("60..90:omission.koma_dori", "0"),
        ("outside", "source"),
    ] {
        settings.set(name, value).unwrap();
        assert_eq!(keys(&mut engine, &settings), before, "{name}");
        assert!(
            run(&mut engine, &settings, &NONE()) == fresh(&pitch(), &settings, &NONE()),
            "{name}"
        );
    }
    settings.set("A/spacing.on", "1").unwrap();
    assert_ne!(keys(&mut engine, &settings), before, "keys may stand closer on ones");
}

#[test]
fn outside_of_passages_the_take_stays_as_it_is() {
    let clip = pitch();
    let clock = clip.clock(24.0);
    for settings in [
        vec![("60..90:spacing.on", "2"), ("outside", "source")],
        vec![
            ("20..50:spacing.weight", "0.9"),
            ("80..:omission.keep_length", "false"),
            ("outside", "source"),
        ],
        vec![("30..34:spacing.on", "1"), ("61..62:spacing.on", "3"), ("outside", "source")],
        vec![("118..:spacing.on", "3"), ("outside", "source"), ("60..119:spacing.on", "3")],
    ] {
        let made = fresh(&clip, &recipe(&settings), &NONE());
        let timed = recipe(&settings).timing_of("A", (clock, clip.last()), 100).timed;
        let sheet = &made.sheets[1];
        for (koma, drawing) in sheet.layers[0].koma().enumerate() {
            if sheet.length() == 100 && !timed.at(koma) {
                let place = sheet.layers[0].drawings[drawing].source.place();
                assert_eq!(place, clock.place_from_koma(koma), "{settings:?}");
            }
        }
        let places: Vec<f64> = drawn(sheet, 0).iter().map(|(_, own)| own.source.place()).collect();
        assert!(places.is_sorted(), "{settings:?}: {places:?}");
        let twitches = timing(sheet, 0).into_iter().filter(|(begin, koma)| {
            *koma == 1 && *timed.at(*begin) && *begin < 99 && *timed.at(begin + 1)
        });
        let on_ones = settings.iter().any(|(name, value)| name.ends_with("on") && *value == "1");
        assert!(on_ones || twitches.count() == 0, "{settings:?}: {:?}", timing(sheet, 0));
    }
}

#[test]
fn a_passage_beside_the_take_begins_and_ends_with_its_poses() {
    let clip = pitch();
    let settings = recipe(&[
        ("60..90:spacing.weight", "0.9"),
        ("60..90:spacing.max_shift", "6"),
        ("outside", "source"),
    ]);
    let made = fresh(&clip, &settings, &NONE());
    let drawn = drawn(&made.sheets[1], 0);
    for koma in [40, 70] {
        let (_, drawing) = drawn.iter().find(|(begin, _)| *begin == koma).unwrap();
        assert_eq!((drawing.role, drawing.source), (Role::End, Source::At(20.0 + koma as f64)));
    }
    assert!(drawn.iter().filter(|(begin, _)| (40..70).contains(begin)).count() < 20);
    let mut pinned = NONE();
    pinned.pins.push(Pin::parse("30:here").unwrap());
    let named = fresh(&clip, &settings, &pinned);
    let drawing = &named.sheets[1].layers[0].drawings[10];
    assert_eq!(drawing.why.pinned.as_deref(), Some("here"), "a person's pin is not lost");
}

#[test]
fn what_a_layer_or_a_passage_cannot_have_is_refused_with_a_reason() {
    let error = |settings: &[(&str, &str)]| {
        Engine::new(pitch()).unwrap().run(&recipe(settings), &NONE()).unwrap_err().to_string()
    };
    assert_eq!(
        error(&[("layers", "limbs"), ("hair/spacing.on", "3")]),
        "layers: there is no layer hair to set; there is A, B, C, D, E (see --layers)"
    );
    assert_eq!(
        error(&[("F/30..40:spacing.on", "3")]),
        "layers: there is no layer F to set; there is A (see --layers)"
    );
    assert_eq!(
        error(&[("120..140:spacing.on", "3")]),
        "120..140: is not in the clip, which has frames 20 to 119"
    );
    assert!(
        error(&[("outside", "source")]).contains("there is no passage: name one with --within")
    );
    let source = ("outside", "source");
    let passage = ("30..40:spacing.on", "3");
    assert!(error(&[passage, source, ("feet", "held")]).contains("feet = held moves its feet"));
    assert!(error(&[passage, source, ("exaggerate.ease", "1")]).contains("exaggerate changes it"));
}

proptest! {
    #![proptest_config(cases(12, 60))]

    #[test]
    fn passages_that_come_and_go_give_what_a_fresh_engine_gives(
        passages in prop::collection::vec((20..118usize, 1..60usize, 0..6usize), 1..4),
        source: bool,
    ) {
        let clip = pitch();
        let mut engine = Engine::new(clip.clone()).unwrap();
        let mut settings = Recipe::default();
        for (from, frames, which) in passages {
            let (knob, value) = [
                ("spacing.on", "1"), ("spacing.on", "3"), ("spacing.drift", "0"), ("spacing.weight", "0.7"),
                ("omission.koma_dori", "100%"), ("omission.naka_nashi", "3"),
            ][which];
            settings.set(&format!("{from}..{}:{knob}", from + frames), value).unwrap();
            settings.set("outside", if source { "source" } else { "timed" }).unwrap();
            let used = run(&mut engine, &settings, &NONE());
            prop_assert!(used == fresh(&clip, &settings, &NONE()));
            let places: Vec<f64> = drawn(&used.sheets[1], 0).iter().map(|(_, own)| own.source.place()).collect();
            prop_assert!(places.is_sorted(), "{:?}", places);
            prop_assert_eq!(used.sheets[1].length(), 100);
        }
    }
}
