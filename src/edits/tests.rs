use proptest::prelude::*;

use super::*;
use crate::slate::Slate;

fn pins(texts: &[&str]) -> Vec<Pin> {
    texts.iter().map(|text| Pin::parse(text).unwrap()).collect()
}

fn moves(texts: &[&str]) -> Vec<Move> {
    texts.iter().map(|text| Move::parse(text).unwrap()).collect()
}

fn forbidden(texts: &[&str]) -> Vec<Forbidden> {
    texts.iter().map(|text| text.parse().unwrap()).collect()
}

/// Validates corrections of a clip of frames 5 to 9 and returns the error; empty if there is none.
fn said(edits: Edits) -> String {
    let checked = edits.validate(Frame(5), Frame(9));
    checked.err().map_or_else(String::new, |error| error.to_string())
}

#[test]
fn a_pin_must_lie_in_the_clip_and_not_be_forbidden() {
    let check = |pin: &str, not: &[&str]| {
        said(Edits { pins: pins(&[pin]), forbidden: forbidden(not), ..Edits::default() })
    };
    for (pin, not) in [("5", &[][..]), ("9@0", &["8"]), ("7", &["5..9"]), ("7", &["7..9"])] {
        assert_eq!(check(pin, not), "", "{pin} {not:?}");
    }
    assert!(
        check("4", &[]).ends_with("pinned frame 4 is not in the clip, which has frames 5 to 9")
    );
    assert!(check("10", &[]).contains("frame 10 is not in the clip"));
    assert!(check("7", &["7"]).contains("pinned and forbidden at once"));
    assert!(check("7@1", &[]).contains("weight of pinned frame 7"));
    assert!(check("7@-0.1", &[]).contains("at least 0 and below 1"));
    assert!(check("7@nan", &[]).contains("at least 0 and below 1"));
}

#[test]
fn a_move_is_from_one_frame_of_the_clip_to_another_that_is_free() {
    let check = |texts: &[&str], pin: &[&str], not: &[&str]| {
        let (pins, forbidden) = (pins(pin), forbidden(not));
        said(Edits { moves: moves(texts), pins, forbidden, ..Edits::default() })
    };
    assert_eq!(check(&["5:9", "6:5:top@0.5"], &["7"], &["6", "5..9"]), "");
    assert!(check(&["4:6"], &[], &[]).contains("frame 4 of the move 4:6 is not in the clip"));
    assert!(check(&["6:10"], &[], &[]).contains("frame 10 of the move"));
    assert!(check(&["6:6"], &[], &[]).contains("moved to where it is"));
    assert!(check(&["6:7", "6:8"], &[], &[]).contains("moved twice"));
    assert!(check(&["6:7"], &["6"], &[]).contains("pinned and moved at once: pin 7 instead"));
    assert!(check(&["6:7"], &[], &["7"]).contains("frame 7 is forbidden"));
    assert!(check(&["6:7@1"], &[], &[]).contains("weight of moved-to frame 7"));
}

/// Builds corrections of all layers and of layer B.
fn with_layer_b(all: &[&str], own: LayerEdits) -> Edits {
    Edits { pins: pins(all), layers: [("B".to_owned(), own)].into(), ..Edits::default() }
}

#[test]
fn a_layer_has_the_corrections_of_all_and_its_own() {
    let own = LayerEdits {
        pins: pins(&["8:top"]),
        forbidden: forbidden(&["6"]),
        moves: moves(&["9:5"]),
        frozen: vec![Frame(8)],
    };
    let edits = with_layer_b(&["7"], own);
    let of_b = edits.of_layer("B");
    assert_eq!(of_b.pins, pins(&["7", "8:top"]));
    assert_eq!((of_b.forbidden, of_b.moves), (forbidden(&["6"]), moves(&["9:5"])));
    assert_eq!(of_b.frozen, [Frame(8)]);
    assert_eq!(edits.of_layer("A"), Edits { pins: pins(&["7"]), ..Edits::default() });
    assert!(edits.check_layers(&["A", "B"]).is_ok());
    let error = edits.check_layers(&["A"]).unwrap_err().to_string();
    assert_eq!(error, "edits: there is no layer B to correct; there is A (see --layers)");
}

#[test]
fn what_contradicts_itself_in_one_layer_is_refused() {
    let of_b = |texts: &[&str], not: &[&str]| LayerEdits {
        pins: pins(texts),
        forbidden: forbidden(not),
        ..LayerEdits::default()
    };
    assert_eq!(said(with_layer_b(&[], of_b(&["7"], &["8"]))), "");
    assert!(said(with_layer_b(&["7"], of_b(&[], &["7"]))).contains("pinned and forbidden"));
    assert!(said(with_layer_b(&[], of_b(&["99"], &[]))).contains("frame 99 is not in the clip"));
    let alone = |own| Edits { only_pins: true, ..with_layer_b(&[], own) };
    assert_eq!(said(alone(of_b(&["7"], &[]))), "", "the others have none");
    assert!(said(alone(of_b(&[], &["7"]))).contains("there is no pin"));
}

#[test]
fn a_layer_stands_before_a_stroke() {
    assert_eq!(layer_of("B/150:top@0.5"), (Some("B"), "150:top@0.5"));
    assert_eq!(layer_of("腕 /120..140"), (Some("腕"), "120..140"));
    for plain in ["150", "150:a/b", "150@1/2", "41:42:x/7"] {
        assert_eq!(layer_of(plain), (None, plain));
    }
}

#[test]
fn a_hold_is_of_a_frame_of_the_clip_for_a_koma_at_least() {
    let check = |texts: &[&str]| {
        let holds = texts.iter().map(|text| Hold::parse(text).unwrap()).collect();
        said(Edits { holds, ..Edits::default() })
    };
    assert_eq!(check(&["5:1", "9: 40"]), "");
    assert!(check(&["4:2"]).contains("held frame 4 is not in the clip, which has frames 5 to 9"));
    assert!(check(&["10:2"]).contains("held frame 10"));
    assert!(check(&["6:0"]).contains("frame 6 is held for 0 koma: 1 at the least"));
    assert!(check(&["6:2", "6:3"]).contains("frame 6 is held twice"));
    for wrong in ["", "6", "6:", ":2", "6:two", "6:-1", "6:2:3"] {
        let said = Hold::parse(wrong).unwrap_err().to_string();
        assert!(said.contains("FRAME:KOMA"), "{wrong}: {said}");
    }
}

#[test]
fn what_is_forbidden_must_reach_into_the_clip() {
    let check = |not: &str| said(Edits { forbidden: forbidden(&[not]), ..Edits::default() });
    for not in ["5", "9", "0..6", "9..40", "0..", "..6"] {
        assert_eq!(check(not), "", "{not}");
    }
    assert!(check("4").contains("forbidden frame 4 is not in the clip, which has frames 5 to 9"));
    assert!(check("0..5").contains("forbidden range 0..5 is not in the clip"));
    assert!(check("10..").contains("forbidden range 10.. is not in the clip"));
    let empty = Forbidden { from: Frame(7), past: Frame(7) };
    assert!(said(Edits { forbidden: vec![empty], ..Edits::default() }).contains("no frame in it"));
}

#[test]
fn only_pins_asks_for_a_pin() {
    let only = Edits { only_pins: true, ..Edits::default() };
    assert!(said(only.clone()).contains("there is no pin"));
    assert_eq!(said(Edits { pins: pins(&["7"]), ..only.clone() }), "");
    assert_eq!(said(Edits { moves: moves(&["7:8"]), ..only }), "");
}

#[test]
fn an_action_begins_inside_the_clip() {
    let check = |splits: &[usize]| {
        said(Edits { splits: splits.iter().copied().map(Frame).collect(), ..Edits::default() })
    };
    assert_eq!(check(&[9, 6, 6]), "", "in any order, and twice is once");
    assert!(check(&[5]).contains("begins at frame 5 anyway"));
    for outside in [4, 10] {
        assert!(check(&[7, outside]).contains("is not in the clip, which has frames 5 to 9"));
    }
}

#[test]
fn a_pin_is_written_as_frame_name_and_weight() {
    let pin = |text: &str| Pin::parse(text).map(|pin| (pin.frame.0, pin.name, pin.weight));
    let top = Some("left-wrist-top".to_owned());
    assert_eq!(pin("150: left-wrist-top").unwrap(), (150, top.clone(), None));
    assert_eq!(pin("150:left-wrist-top@0.5").unwrap(), (150, top, Some(0.5)));
    assert_eq!(pin("12").unwrap(), (12, None, None));
    assert_eq!(pin("12: ").unwrap(), (12, None, None), "an empty name is none");
    assert_eq!(pin("12@0").unwrap(), (12, None, Some(0.0)));
    for wrong in ["twelve", "", ":top", "-1", "1.5"] {
        assert!(pin(wrong).unwrap_err().to_string().contains("FRAME:NAME@WEIGHT"), "{wrong}");
    }
    for wrong in ["12:me@home", "12@", "12@half"] {
        assert!(pin(wrong).unwrap_err().to_string().contains("recipe file"), "{wrong}");
    }
}

#[test]
fn a_move_is_written_as_two_frames_and_what_a_pin_has() {
    let expected =
        Move { from: Frame(41), to: Frame(42), name: Some("hit".into()), weight: Some(0.2) };
    assert_eq!(Move::parse("41:42:hit@0.2").unwrap(), expected);
    assert_eq!(Move::parse("41:42@0.2").unwrap(), Move { name: None, ..expected });
    for wrong in ["41", "41:", ":42", "a:42", "41:b", "41-42", ""] {
        let error = Move::parse(wrong).unwrap_err().to_string();
        assert!(error.contains("expected FROM:TO, two frame numbers"), "{wrong}: {error}");
    }
}

#[test]
fn what_is_forbidden_is_written_as_a_frame_or_a_range() {
    for text in ["150", "120..140", "120..", "0..140"] {
        assert_eq!(text.parse::<Forbidden>().unwrap().to_string(), text);
    }
    assert_eq!("..140".parse(), "0..140".parse::<Forbidden>());
    assert_eq!("7..8".parse(), Ok(Forbidden::one(Frame(7))));
    for wrong in ["", "a", "1..b", "140..120", "7..7", "-3", "1.5"] {
        assert!(wrong.parse::<Forbidden>().is_err(), "{wrong}");
    }
}

proptest! {
    #[test]
    fn a_forbidden_range_is_as_near_as_the_nearest_of_its_frames(
        from in 0..40usize,
        length in 1..20usize,
        frame in 0..80usize,
    ) {
        let range = Forbidden { from: Frame(from), past: Frame(from + length) };
        let nearest = (from..from + length).map(|other| other.abs_diff(frame)).min();
        prop_assert_eq!(Some(range.distance(Frame(frame))), nearest);
    }

    #[test]
    fn between_two_keys_that_stay_every_other_is_banned_and_they_are_not(
        (before, gap, at) in (0..99usize, 2..40usize, 0.0..1.0f64),
        koma in prop::sample::select(vec![1.0, 1.25, 2.5, 5.0]),
    ) {
        let after = before + gap;
        let frame = before + 1 + (at * (gap - 1) as f64) as usize;
        let ban = Forbidden::between(Frame(before), Frame(frame), Frame(after), koma);
        let banned = |frame: usize| ban.reaches(Frame(frame), koma);
        if ban.is_one() && ban.from == Frame(frame) {
            // Nearer than two koma on both sides there is no ban that spares both.
            prop_assert!(banned(frame) && gap as f64 <= 4.0 * koma + 2.0);
        } else {
            prop_assert!((before + 1..after).all(banned) && !banned(before) && !banned(after), "{}", ban);
        }
    }

    #[test]
    fn corrections_read_back_as_written(
        pins in prop::collection::vec((0..99usize, prop::option::of("[a-z]{1,5}"), prop::option::of(0.0..1.0)), 0..4),
        ranges in prop::collection::vec((0..99usize, 1..9usize), 0..4),
        moves in prop::collection::vec((0..99usize, 0..99usize, prop::option::of("[a-z]{1,5}")), 0..4),
        holds in prop::collection::vec((0..99usize, 1..9usize), 0..4),
        (only_pins, again) in any::<(bool, bool)>(),
        frozen in prop::collection::vec((0..99usize).prop_map(Frame), 0..4),
        splits in prop::collection::vec((0..99usize).prop_map(Frame), 0..4),
        (at, length, cut) in (prop::option::of(1..99usize), prop::option::of(1..99usize), "[a-z0-9]{0,4}"),
        speech in prop::collection::vec((0..99usize, 1..9usize, "[a-z]{0,3}", "[a-z あ\"]{1,5}"), 0..4),
    ) {
        let hold = |(frame, koma)| Hold { frame: Frame(frame), koma };
        let pin = |(frame, name, weight)| Pin { frame: Frame(frame), name, weight };
        let range = |(from, length)| Forbidden { from: Frame(from), past: Frame(from + length) };
        let moved = |(from, to, name)| Move { from: Frame(from), to: Frame(to), name, weight: None };
        let said = |(from, length, speaker, words)| Speech {
            from: Frame(from),
            past: Frame(from + length),
            speaker,
            words,
        };
        let cue = |from, length, words: &str| CameraCue {
            frames: [Frame(from), Frame(from + length)],
            text: words.into(),
        };
        let edits = Edits {
            pins: pins.into_iter().map(pin).collect(),
            forbidden: ranges.into_iter().map(range).collect(),
            moves: moves.into_iter().map(moved).collect(),
            holds: holds.into_iter().map(hold).collect(),
            only_pins,
            again,
            frozen,
            layers: BTreeMap::new(),
            splits,
            camera: speech.iter().map(|(from, length, _, words)| cue(*from, *length, words)).collect(),
            speech: speech.into_iter().map(said).collect(),
            at,
            length,
            slate: Slate { cut, ..Slate::default() },
        };
        let own = LayerEdits {
            pins: edits.pins.clone(),
            forbidden: edits.forbidden.clone(),
            moves: edits.moves.clone(),
            frozen: edits.frozen.clone(),
        };
        let own = Some(own).filter(|own| *own != LayerEdits::default());
        let edits = Edits { layers: own.map(|own| ("B".into(), own)).into_iter().collect(), ..edits };
        let text = toml::to_string(&edits).unwrap();
        prop_assert_eq!(&toml::from_str::<Edits>(&text).unwrap(), &edits, "{}", text);
        let json = serde_json::to_string(&edits).unwrap();
        prop_assert_eq!(serde_json::from_str::<Edits>(&json).unwrap(), edits, "{}", json);
    }
}
