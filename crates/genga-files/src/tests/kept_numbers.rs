//! Numbers that come from an earlier sheet, in every format that writes the numbers of drawings.

use serde_json::Value;

use crate::sheet_json::{self, SheetFile};
use crate::xdts::tests::sheets::{layer, sheet};
use crate::xdts::{Mark, Tdts, Xdts, read, read_cells, retimed};
use crate::{
    Cut, Drawings, Format, Rows, Settings, columns_csv, numbers_csv, sheet_csv, sts, time_remap,
};
use genga::sheet::{Gone, Numbers, Sheet, Source};

/// A sheet whose second drawing came later, and whose fourth went.
fn named() -> Sheet {
    let shown = [(0, 3), (1, 2), (2, 1), (0, 1), (3, 2), (4, 2)];
    let mut named = sheet(vec![layer("A", "egige", &shown)]);
    let own = [("1", "1"), ("1a", "1a"), ("2", ""), ("3", "2"), ("5", "4")];
    for (drawing, (number, genga)) in named.layers[0].drawings.iter_mut().zip(own) {
        let (drawing_number, genga) = (number.parse().ok(), genga.parse().ok());
        drawing.numbers = Numbers { drawing: drawing_number, genga };
    }
    let gone = Gone { drawing: 4_usize.into(), genga: Some(3_usize.into()), place: 20.5 };
    named.layers[0].gone.push(gone);
    named
}

/// Hands over a cut of a sheet, which fits any clip of some frames.
fn cut(sheet: &Sheet, work: impl FnOnce(&Cut<'_>)) {
    let clip = super::wave();
    let sheet = &Sheet { clock: clip.clock(24.0), ..sheet.clone() };
    work(&Cut {
        name: "c012",
        clip_file: "wave.bvh",
        clip: &clip,
        exaggerated: None,
        sheet,
        spaced: None,
        splits: &[],
        made_with: None,
    });
}

/// The notes of a format on a sheet.
fn notes(format: &str, sheet: &Sheet) -> Vec<String> {
    let mut said = Vec::new();
    cut(sheet, |cut| {
        let notes = Format::find(format).unwrap().notes(cut, &Settings::default()).unwrap();
        said = notes.into_iter().map(|note| note.message).collect();
    });
    said
}

fn cells(table: &str, column: usize) -> Vec<&str> {
    table.lines().skip(1).map(|row| row.split(',').nth(column).unwrap()).collect()
}

#[test]
fn tables_have_the_numbers() {
    let named = named();
    let table = sheet_csv(&named).unwrap();
    assert_eq!(cells(&table, 2), ["1", "1", "1", "1a", "1a", "2", "1", "3", "3", "5", "5"]);
    let columns = columns_csv(&named).unwrap();
    let filled = |at: usize| -> Vec<String> {
        let cells = cells(&columns, at).into_iter().skip(1).map(|cell| cell.replace('"', ""));
        cells.filter(|cell| !cell.is_empty()).collect()
    };
    assert_eq!(filled(1), ["1", "1a", "○", "1", "2", "4"]);
    assert_eq!(filled(2), ["1", "1a", "2", "1", "3", "5"]);
    cut(&named, |cut| {
        let drawings = Drawings { cut: "c012".into(), rows: Rows::All };
        let table = drawings.write(cut.clip, cut.sheet).unwrap();
        assert_eq!(cells(&table, 2), ["1", "1a", "2", "1", "3", "5"]);
        assert_eq!(cells(&table, 4), ["1", "1a", "", "1", "2", "4"]);
    });
}

#[test]
fn timesheets_have_the_numbers_and_find_the_drawings_again() {
    let named = named();
    let numbers = |read: &crate::xdts::Exchange| -> Vec<String> {
        let changes = read.columns[0].changes.iter();
        let drawn = changes.filter_map(|change| match &change.mark {
            Mark::Drawing(number) => Some(number.clone()),
            _ => None,
        });
        drawn.collect()
    };
    let pair = Xdts::default().write(&named, "c012").unwrap();
    assert_eq!(numbers(&read(pair.genga.as_bytes()).unwrap()), ["1", "1a", "1", "2", "4"]);
    let tdts = Tdts::default().write(&named, "c012").unwrap();
    for text in [&pair.douga, &tdts] {
        let cells = read_cells(text.as_bytes()).unwrap();
        assert_eq!(numbers(&cells), ["1", "1a", "2", "1", "3", "5"]);
        assert_eq!(retimed(&cells, &named).unwrap(), named);
    }
    // Programs may write the number in another way.
    let other = pair.douga.replace("\"1a\"", "\"0001A\"");
    assert_eq!(retimed(&read_cells(other.as_bytes()).unwrap(), &named).unwrap(), named);
    for unknown in ["4", "1b", "6"] {
        let wrong = pair.douga.replace("\"1a\"", &format!("\"{unknown}\""));
        let said = retimed(&read_cells(wrong.as_bytes()).unwrap(), &named).unwrap_err().to_string();
        assert!(said.contains(&format!("no drawing {unknown}, it has 1 to 5")), "{said}");
    }
}

#[test]
fn whole_numbers_alone_go_into_sts_and_what_they_mean_is_said() {
    let mut named = named();
    let numbers = |sheet: &Sheet| -> Vec<u16> {
        let bytes = sts(sheet).unwrap();
        let numbers = bytes[23..23 + 22].chunks(2);
        numbers.map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect()
    };
    assert_eq!(numbers(&named), [1, 1, 1, 6, 6, 2, 1, 3, 3, 5, 5]);
    assert_eq!(notes("sts", &named), ["STS holds whole numbers alone: of A 1a is 6"]);
    named.layers[0].gone[0].drawing = 9_usize.into();
    assert_eq!(
        notes("sts", &named),
        ["STS holds whole numbers alone: of A 1a is 10"],
        "9 is not used again"
    );
    assert!(notes("sts", &crate::xdts::tests::sheets::cut_of_24()).is_empty());
}

#[test]
fn pictures_in_after_effects_are_in_the_order_of_their_names() {
    let mut named = named();
    let times = |sheet: &Sheet| -> Vec<f64> {
        let text = time_remap(&sheet.layers[0], 1.0);
        let (_, keys) = text.split_once("Frame\tseconds\n").unwrap();
        keys.lines().map_while(|line| line.rsplit('\t').next()?.parse().ok()).collect()
    };
    assert_eq!(times(&named), [0.0, 1.0, 2.0, 0.0, 3.0, 4.0]);
    // 1za stands before 1a on the sheet and behind it in a folder.
    named.layers[0].drawings[1].numbers.drawing = "1za".parse().ok();
    named.layers[0].drawings[2].numbers.drawing = "1a".parse().ok();
    assert_eq!(times(&named), [0.0, 2.0, 1.0, 0.0, 3.0, 4.0]);
    assert!(notes("ae", &named)[0].contains("Force alphabetical order"));
    assert!(notes("xdts", &named)[0].starts_with("OpenToonz reads 1za only if"));
}

#[test]
fn the_sheet_itself_keeps_them() {
    cut(&named(), |cut| {
        let text = sheet_json::write(cut).unwrap();
        assert!(
            text.contains("{\"drawing\": 2, \"name\": \"1a\", \"genga_no\": \"1a\", "),
            "{text}"
        );
        assert!(
            text.contains("\n        {\"name\": 4, \"genga_no\": 3, \"frame\": 20.5}\n"),
            "{text}"
        );
        let read = sheet_json::read(text.as_bytes()).unwrap();
        assert_eq!(read, SheetFile::new(cut));
        let json: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["layers"][0]["exposures"][1]["drawing"], 2, "exposures count drawings");
        for (from, to, said) in [
            ("\"name\": \"1a\", ", "", "layer A: drawing 2 has no name"),
            ("\"name\": \"1a\"", "\"name\": 3", "layer A: number 3 stands before 2"),
            ("\"name\": \"1a\"", "\"name\": \"1z\"", "not ending in z, found \"1z\""),
            ("\"name\": \"1a\"", "\"name\": -1", "the number of a drawing, as 3 or"),
        ] {
            let wrong = text.replacen(from, to, 1);
            let error = sheet_json::read(wrong.as_bytes()).unwrap_err().to_string();
            assert!(error.contains(said), "{to}: {error}");
        }
    });
}

#[test]
fn a_table_tells_old_from_new() {
    let placed = |roles: &str, places: &[f64]| {
        let mut sheet = sheet(vec![layer("A", roles, &[])]);
        let drawings = sheet.layers[0].drawings.iter_mut().zip(places);
        drawings.for_each(|(drawing, place)| drawing.source = Source::At(*place));
        sheet
    };
    let before = placed("egige", &[10.0, 20.0, 30.0, 40.0, 50.0]);
    let mut now = placed("egig", &[10.0, 30.0, 35.5, 41.0]);
    now.keep_numbers(&before);
    let expected = "column,old,new,genga_old,genga_new,source_frame\n\
        A,1,1,1,1,10\nA,2,,2,,20\nA,3,3,,2a,30\nA,,3a,,,35.5\nA,4,4,3,3,41\nA,5,,4,,50\n";
    let table = numbers_csv(&now.compare_numbers(&before)).unwrap();
    assert_eq!(table, expected);
}
