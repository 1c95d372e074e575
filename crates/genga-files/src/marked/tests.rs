use super::*;
use crate::sheet_json::{self, MadeWith};
use crate::{Cut, Drawings, Rows, sheet_csv};
use genga::edits::{Edits, Move};
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

/// Frame, name and weight.
type Row = (usize, Option<String>, Option<f64>);

fn table(text: &str) -> Result<Vec<Row>, String> {
    let (pins, _) = pins_from_table(text.as_bytes(), None).map_err(|error| error.to_string())?;
    Ok(pins.into_iter().map(|pin| (pin.frame.0, pin.name, pin.weight)).collect())
}

fn frames(text: &str) -> Vec<usize> {
    table(text).unwrap().into_iter().map(|(frame, ..)| frame).collect()
}

/// The kick's pins (one of them a moved key), its tables and its sheet.
fn kick() -> (Vec<Pin>, [String; 4]) {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/kick.bvh");
    let clip = bvh::read(&std::fs::read(path).unwrap()).unwrap().clip;
    let mut engine = Engine::new(clip).unwrap();
    let recipe = Recipe::default();
    let edits = Edits {
        pins: vec![Pin::parse("42:contact, the \"ball\"@0.7").unwrap(), Pin::parse("60").unwrap()],
        moves: vec![Move::parse("71:75:land@0.1").unwrap()],
        ..Edits::default()
    };
    let made = engine.run(&recipe, &edits).unwrap();
    let (clip, sheet) = (made.clip, made.sheet);
    let drawings = |rows| Drawings { cut: "kick".into(), rows }.write(clip, sheet).unwrap();
    let cut = Cut {
        name: "kick",
        clip_file: "kick.bvh",
        clip,
        exaggerated: None,
        sheet,
        spaced: None,
        splits: &[],
        made_with: Some(&MadeWith::new(&recipe, &edits, sheet)),
    };
    let files = [
        drawings(Rows::Keys),
        drawings(Rows::All),
        sheet_csv(sheet).unwrap(),
        sheet_json::write(&cut).unwrap(),
    ];
    let genga = sheet.layers[0].drawings.iter().filter(|drawing| drawing.role == Role::Genga);
    let pin = |drawing: &Drawing| {
        let frame = Frame(drawing.source.place() as usize);
        let mut wanted = edits.pins.iter().cloned().chain(edits.moves.iter().map(Move::pin));
        wanted.find(|pin| pin.frame == frame).unwrap_or(Pin { frame, name: None, weight: None })
    };
    (genga.map(pin).collect(), files)
}

#[test]
fn the_genga_of_every_table_and_of_the_sheet_come_back_by_their_names() {
    let (keys, [keys_csv, drawings_csv, sheet_csv, sheet]) = kick();
    let named: Vec<_> = keys.iter().filter_map(|pin| pin.name.as_deref()).collect();
    assert_eq!(named, ["contact, the \"ball\"", "land"]);
    let file = sheet_json::read(sheet.as_bytes()).unwrap();
    assert_eq!(pins_from_sheet(&file, None).unwrap(), (keys.clone(), "A".into()));
    // A table has no weights unless a person adds them.
    let unweighted: Vec<Pin> =
        keys.iter().cloned().map(|pin| Pin { weight: None, ..pin }).collect();
    for table in [keys_csv, drawings_csv, sheet_csv] {
        let (pins, column) = pins_from_table(table.as_bytes(), None).unwrap();
        assert_eq!((pins, column.as_str()), (unweighted.clone(), "A"));
        let marked = format!("\u{feff}{}", table.replace('\n', "\r\n"));
        assert_eq!(pins_from_table(marked.as_bytes(), Some("A")).unwrap().0, unweighted);
    }
}

#[test]
fn a_row_that_a_person_adds_needs_no_more_than_a_frame() {
    assert_eq!(frames("source_frame\n12\n150\n"), [12, 150]);
    assert_eq!(frames("\u{feff}source_frame\r\n12\r\n150\r\n"), [12, 150]);
    assert_eq!(frames("role;source_frame\n;7\ngenga; 47.6\nend;90\ninbetween;50\n;\n"), [7, 48]);
    let rows = table(
        "source_frame\tname\tweight\tnote\n5\ttop\t0.5\tpinned: old\n6\t\t\tpinned: old; Hips turns\n",
    );
    let name = |name: &str| Some(name.to_owned());
    assert_eq!(rows.unwrap(), [(5, name("top"), Some(0.5)), (6, name("old"), None)]);
}

#[test]
fn a_held_genga_of_a_sheet_is_one_pin() {
    let text = "koma,layer,drawing,role,source_frame,why\n1,A,1,genga,4,pinned\n2,A,1,genga,4,pinned\n3,A,2,genga,5,\n";
    assert_eq!(table(text).unwrap(), [(4, None, None), (5, None, None)]);
}

#[test]
fn of_several_columns_one_is_taken() {
    let text = "column,source_frame\nB,3\nA,5\nB,9\n";
    assert_eq!(frames(text), [5]);
    let of = |column| pins_from_table(text.as_bytes(), Some(column));
    assert_eq!(of("B").unwrap().0.len(), 2);
    assert!(of("C").unwrap_err().to_string().contains("no genga in a column C; there are A, B"));
    let error = table("column,source_frame\nB,3\nC,5\n").unwrap_err();
    assert!(error.contains("--pin-column takes one of B, C"), "{error}");
}

#[test]
fn what_is_wrong_has_its_line() {
    for (text, wanted) in [
        ("frame,role\n3,genga\n", "line 1: there is no column source_frame"),
        ("", "line 1: there is no column source_frame"),
        (
            "source_frame,role\n3,genga\n4,gnega\n",
            "line 3: role: expected genga, inbetween or end, found \"gnega\"",
        ),
        (
            "source_frame,role\nthree,genga\n",
            "line 2: source_frame: expected a frame number of the clip, found \"three\"",
        ),
        ("source_frame,role\n-3,genga\n", "line 2: source_frame"),
        ("source_frame,role\nnan,genga\n", "line 2: source_frame"),
        ("source_frame,role\n,genga\n", "line 2: source_frame"),
        ("source_frame,weight\n3,half\n", "line 2: weight: expected a spacing weight"),
        ("source_frame,role\n3,end\n", "there is no genga in it"),
    ] {
        let error = table(text).unwrap_err();
        assert!(error.starts_with(wanted), "{text:?}: {error}");
    }
    let error = pins_from_table(&[b'a', 0xff], None).unwrap_err().to_string();
    assert!(error.contains("UTF-8"), "{error}");
}

#[test]
fn the_place_of_what_is_wrong_is_data() {
    let place = |text: &str| pins_from_table(text.as_bytes(), None).unwrap_err().position();
    assert_eq!(place("source_frame,role\n3,genga\n4,gnega\n"), Some((3, 2)));
    assert_eq!(place("role,weight,source_frame\ngenga,,3\ngenga,,three\n"), Some((3, 3)));
    assert_eq!(place("weight,source_frame\nhalf,3\n"), Some((2, 1)));
    assert_eq!(place("frame,role\n3,genga\n"), Some((1, 1)));
    let error = pins_from_table(&[b'a', 0xff], None).unwrap_err();
    assert!(std::error::Error::source(&error).is_some(), "{error}");
}
