//! Properties of any sheet: written, read and written again, it is the same to the last byte.

use proptest::prelude::*;

use super::*;
use genga::edits::{CameraCue, Edits, Forbidden, Hold, LayerEdits, Move, Pin, Speech};
use genga::exaggerate::{CartoonParts, Exaggerate};
use genga::sheet::{
    Blank, Drawing, Exposure, Feet, Gone, Layer, Numbers, Reason, RootMotion, Sheet, SpokenLine,
    Why,
};
use genga::slate::Slate;
use genga::time::{Clock, Frame, FrameRate, Span};

const FIRST: usize = 7;
const LAST: usize = 5000;

/// A place with all its digits.
fn place() -> impl Strategy<Value = f64> {
    prop_oneof![(FIRST..=LAST).prop_map(|frame| frame as f64), FIRST as f64..=LAST as f64]
}

fn source() -> impl Strategy<Value = Source> {
    let share = prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0];
    prop_oneof![
        place().prop_map(Source::At),
        (place(), place(), share).prop_map(|(from, to, share)| Source::Between { from, to, share }),
    ]
}

fn why() -> impl Strategy<Value = Why> {
    let words = prop::collection::vec(any::<String>(), 0..3);
    let value = || prop::option::of(prop_oneof![Just(0.0), -1e300..1e300, 0.0..1e-300, 0.0..100.0]);
    let counts = prop::array::uniform3(0..4usize);
    let reason = prop::option::of(prop::sample::select(&Reason::ALL[..]));
    let said = (reason, any::<bool>());
    let pinned = prop::option::of(any::<String>());
    let moved = prop::option::of(0..999usize);
    (words, pinned, moved, said, value(), value(), counts).prop_map(
        |(voters, pinned, moved_from, (reason, hold_set), strength, price, counts)| Why {
            voters: voters.into_iter().collect(),
            pinned,
            moved_from,
            reason,
            strength,
            price,
            lengthened: counts[0],
            omitted_before: counts[1],
            held_for: counts[2],
            hold_set,
        },
    )
}

fn drawing() -> impl Strategy<Value = Drawing> {
    let role = prop::sample::select(vec![Role::Genga, Role::Inbetween, Role::End]);
    (source(), role, why()).prop_map(|(source, role, why)| Drawing::new(source, role, why))
}

fn layer() -> impl Strategy<Value = Layer> {
    let drawings = prop::collection::vec(drawing(), 0..6);
    let shown = prop::collection::vec((any::<prop::sample::Index>(), 1..200usize), 0..9);
    let is_named = any::<bool>();
    (any::<String>(), drawings, shown, is_named).prop_map(
        |(name, mut drawings, shown, is_named)| {
            let number = |at: usize| format!("{at}a").parse().ok();
            let mut gone = vec![];
            if is_named {
                for (at, drawing) in drawings.iter_mut().enumerate() {
                    drawing.numbers = Numbers { drawing: number(at), genga: number(at) };
                }
                gone.push(Gone { drawing: 7_usize.into(), genga: number(7), place: 0.25 });
            }
            let exposure = |(drawing, koma): (prop::sample::Index, usize)| {
                (!drawings.is_empty())
                    .then(|| Exposure { drawing: drawing.index(drawings.len()), koma })
            };
            let exposures = shown.into_iter().filter_map(exposure).collect();
            Layer { name, joints: vec![], drawings, exposures, gone }
        },
    )
}

fn range(from: u32, more: u16) -> Forbidden {
    let from = from as usize;
    Forbidden { from: Frame(from), past: Frame(from + 1 + more as usize) }
}

fn moved((from, to): (u32, u32)) -> Move {
    Move { from: Frame(from as usize), to: Frame(to as usize), name: None, weight: None }
}

fn made_with() -> impl Strategy<Value = MadeWith> {
    let recipe = prop::collection::btree_map(any::<String>(), any::<String>(), 0..3);
    let pin = (any::<u32>(), prop::option::of(any::<String>()), prop::option::of(0.0..1.0))
        .prop_map(|(frame, name, weight)| Pin { frame: Frame(frame as usize), name, weight });
    let forbidden =
        prop::collection::vec(any::<(u32, u16)>().prop_map(|(from, more)| range(from, more)), 0..3);
    let moves = prop::collection::vec(any::<(u32, u32)>().prop_map(moved), 0..3);
    let pins = prop::collection::vec(pin, 0..3);
    let hold =
        |(frame, koma): (u32, u32)| Hold { frame: Frame(frame as usize), koma: koma as usize };
    let holds = prop::collection::vec(any::<(u32, u32)>().prop_map(hold), 0..3);
    let splits = prop::collection::vec(any::<u32>().prop_map(|at| Frame(at as usize)), 0..3);
    (recipe, pins, forbidden, moves, holds, any::<bool>(), splits).prop_map(
        |(recipe, pins, forbidden, moves, holds, only_pins, splits)| {
            let digest = "7".repeat(pins.len());
            let own = LayerEdits {
                pins: pins.clone(),
                forbidden: forbidden.clone(),
                moves: moves.clone(),
                frozen: splits.clone(),
            };
            let own = Some(own).filter(|own| only_pins && *own != LayerEdits::default());
            let layers = own.map(|own| ("B".to_owned(), own)).into_iter().collect();
            let speech = vec![Speech::parse("3..9:アキ:a").unwrap()];
            let (again, frozen) = (!only_pins, splits.clone());
            let edits = Edits {
                pins,
                forbidden,
                moves,
                holds,
                only_pins,
                again,
                frozen,
                splits,
                speech,
                camera: vec![CameraCue { frames: [Frame(3), Frame(9)], text: "PAN".into() }],
                at: Some(1 + digest.len()),
                length: None,
                slate: Slate::from_name("s1_c2"),
                layers,
            };
            MadeWith { recipe, layers: digest, edits }
        },
    )
}

/// The default, which does nothing, or an exaggeration with an effect.
fn exaggerate() -> impl Strategy<Value = Exaggerate> {
    let span =
        || prop_oneof![(0.0..1e9).prop_map(Span::Frames), (0.0..9.0).prop_map(Span::Seconds)];
    let parts = prop::sample::select(vec![CartoonParts::Upper, CartoonParts::Body]);
    let some = (1e-300..3.0, span(), parts, 0.0..=1.0, span()).prop_map(
        |(cartoon, cartoon_width, cartoon_parts, ease, ease_reach)| Exaggerate {
            cartoon,
            cartoon_width,
            cartoon_parts,
            ease,
            ease_reach,
        },
    );
    prop_oneof![Just(Exaggerate::default()), some]
}

/// Lines ordered by first koma.
fn spoken() -> impl Strategy<Value = Vec<SpokenLine>> {
    let line = (0_usize..30, 1_usize..20, any::<String>(), "[a-z\"あ\\n]{1,9}x");
    let line =
        line.prop_map(|(begin, koma, speaker, words)| SpokenLine { begin, koma, speaker, words });
    prop::collection::vec(line, 0..4).prop_map(|mut lines| {
        lines.sort_by_key(|line| line.begin);
        lines
    })
}

fn sheet_file() -> impl Strategy<Value = SheetFile> {
    let rates = (0.01..1000.0, prop_oneof![Just(24.0), 2.0..1000.0]);
    let layers = prop::collection::vec(layer(), 0..4);
    let joints = prop::collection::btree_set(any::<String>(), 0..4);
    let joints = joints.prop_map(|joints| joints.into_iter().collect::<Vec<_>>());
    let words = prop::array::uniform2(any::<String>());
    let root = prop::sample::select(vec![RootMotion::Drawings, RootMotion::Ones]);
    let feet = prop::sample::select(vec![Feet::Free, Feet::Held]);
    let blank = (0..30_usize, 0..30_usize).prop_map(|(before, after)| Blank { before, after });
    let slate = "[a-zア 0-9]{0,5}".prop_map(|cut| Slate { cut, ..Slate::default() });
    let root = (root, exaggerate(), spoken(), blank, slate);
    (rates, (layers, root, feet), joints, words, prop::option::of(made_with())).prop_map(
        |(
            (frame_rate, koma_rate),
            (layers, (root, exaggerate, lines, blank, slate), feet),
            joints,
            [cut, file],
            made_with,
        )| {
            SheetFile {
                cut,
                genga: "0.1.0".into(),
                made_with,
                exaggerate,
                sheet: Sheet {
                    clock: Clock {
                        first: Frame(FIRST),
                        frame_rate: FrameRate::new(frame_rate).unwrap(),
                        koma_rate,
                    },
                    layers: with_joints(layers, &joints),
                    root,
                    feet,
                    lines: vec![],
                    camera: vec![],
                    blank,
                    slate,
                    repeat: None,
                }
                .with_lines(&lines),
                clip: MadeOf {
                    file,
                    frame_rate,
                    first_frame: FIRST,
                    frames: LAST - FIRST + 1,
                    motion: "0".into(),
                    skeleton: "1".into(),
                    joints,
                },
            }
        },
    )
}

/// The layers with one joint each, as far as there are joints.
fn with_joints(mut layers: Vec<Layer>, joints: &[String]) -> Vec<Layer> {
    for (layer, joint) in layers.iter_mut().zip(joints) {
        layer.joints = vec![joint.clone()];
    }
    layers
}

proptest! {
    #[test]
    fn any_sheet_written_reads_back_and_is_written_the_same(file in sheet_file()) {
        let text = file.write().unwrap();
        let again = read(text.as_bytes()).unwrap();
        prop_assert_eq!(&again, &file);
        prop_assert_eq!(again.write().unwrap(), text);
    }

    #[test]
    fn no_bytes_make_the_reader_panic(at in any::<prop::sample::Index>(), byte in any::<u8>(), cut in any::<bool>()) {
        let mut bytes = text().into_bytes();
        let at = at.index(bytes.len());
        bytes[at] = byte;
        if cut {
            bytes.truncate(at);
        }
        if let Ok(file) = read(&bytes) {
            prop_assert!(file.write().is_ok());
        }
    }
}
