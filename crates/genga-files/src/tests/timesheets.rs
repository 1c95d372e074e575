//! Every timesheet format agrees with the sheet koma by koma, as read by independent readers that follow the published
//! rules.

use encoding_rs::SHIFT_JIS;
use serde_json::Value;

use crate::xdts::tests::sheets::{cut_of_24, layer, sheet};
use crate::xdts::{self, Tdts};
use crate::{Cut, Remap, columns_csv, remap_csv, sheet_csv, sts, time_remap};
use genga::sheet::{Blank, Layer, Sheet};
use genga::time::Clock;

/// Sheets with difficult cases: a drawing shown again, one that continues over two exposures, layers of unequal length.
fn sheets() -> Vec<Sheet> {
    let body = layer("A", "eigie", &[(0, 3), (1, 2), (1, 1), (2, 4), (0, 2), (4, 2)]);
    let arm = layer("腕", "eie", &[(0, 5), (1, 1), (2, 3)]);
    vec![cut_of_24(), sheet(vec![body.clone()]), sheet(vec![body, arm])]
}

/// Number of the drawing on each koma, or 0 if there is none.
fn douga(layer: &Layer, length: usize) -> Vec<usize> {
    let mut numbers: Vec<usize> = layer.koma().map(|drawing| drawing + 1).collect();
    numbers.resize(length, 0);
    numbers
}

/// Number of the last genga begun by each koma, or 0 if there is none.
fn genga(layer: &Layer, length: usize) -> Vec<usize> {
    let numbers = layer.genga_places();
    let mut last = 0;
    let mut shown: Vec<usize> = layer
        .koma()
        .map(|drawing| {
            last = numbers[drawing].unwrap_or(last);
            last
        })
        .collect();
    shown.resize(length, 0);
    shown
}

/// Koma on which an inbetween begins.
fn marks(layer: &Layer) -> Vec<usize> {
    let koma: Vec<usize> = layer.koma().collect();
    let begins = |at: &usize| *at == 0 || koma[at - 1] != koma[*at];
    let is_between = |at: &usize| !layer.drawings[koma[*at]].role.is_kept();
    (0..koma.len()).filter(begins).filter(is_between).collect()
}

/// Spreads numbers over the koma, each holding until the next.
fn held(length: usize, numbers: impl Iterator<Item = (usize, usize)>) -> Vec<usize> {
    let mut koma = vec![0; length];
    for (begin, number) in numbers {
        koma[begin..].fill(number);
    }
    koma
}

/// A track of a TDTS file: its numbers, and the koma with marks.
fn track(frames: &Value, length: usize) -> (Vec<usize>, Vec<usize>) {
    let frames = frames.as_array().unwrap();
    let koma = |entry: &Value| entry["frame"].as_u64().unwrap() as usize;
    let value = |entry: &Value| entry["data"][0]["values"][0].as_str().unwrap().to_owned();
    let ascend = frames.windows(2).all(|pair| koma(&pair[0]) < koma(&pair[1]));
    assert!(ascend, "some readers refuse frames that do not ascend");
    let within = || frames.iter().filter(|entry| koma(entry) < length);
    let number = |entry: &Value| match &value(entry)[..] {
        "SYMBOL_NULL_CELL" => Some((koma(entry), 0)),
        "SYMBOL_TICK_1" => None,
        number => Some((koma(entry), number.parse().unwrap())),
    };
    let marks = within().filter(|entry| value(entry) == "SYMBOL_TICK_1").map(koma).collect();
    (held(length, within().filter_map(number)), marks)
}

#[test]
fn tdts_has_both_columns_in_one_file() {
    for (sheet, version) in sheets().iter().flat_map(|sheet| [(sheet, 5), (sheet, 11)]) {
        let text = Tdts { version, marks: true }.write(sheet, "s03_c012").unwrap();
        let json: Value = text
            .split_once('\n')
            .map(|(signature, json)| {
                assert_eq!(signature, "toeiDigitalTimeSheet Save Data");
                serde_json::from_str(json).unwrap()
            })
            .unwrap();
        assert_eq!(json["version"], version);
        let root = if version < 7 { &json } else { &json["timeSheets"][0] };
        assert_eq!(root["header"], serde_json::json!({ "cut": "12", "scene": "3" }));
        let table = &root["timeTables"][0];
        let length = table["duration"].as_u64().unwrap() as usize;
        assert_eq!(length, sheet.length());
        for (track_no, layer) in sheet.layers.iter().enumerate() {
            let of = |field: usize| &table["fields"][field]["tracks"][track_no];
            assert_eq!(table["fields"][0]["fieldId"], 0);
            assert_eq!(table["fields"][1]["fieldId"], 4);
            let expected = (genga(layer, length), marks(layer));
            assert_eq!(track(&of(0)["frames"], length), expected);
            assert_eq!(track(&of(1)["frames"], length), (douga(layer, length), vec![]));
            assert_eq!(table["timeTableHeaders"][1]["names"][track_no], layer.name);
        }
    }
}

#[test]
fn tdts_is_read_back_and_its_marks_can_be_left_out() {
    let sheet = cut_of_24();
    let text = Tdts::default().write(&sheet, "walk").unwrap();
    let read = xdts::read(text.as_bytes()).unwrap();
    assert_eq!((read.cut.as_deref(), read.length), (Some("walk"), 24));
    assert_eq!(read.columns[0].name, "A");
    let plain = Tdts { marks: false, ..Tdts::default() }.write(&sheet, "walk").unwrap();
    assert!(text.contains("SYMBOL_TICK_1") && !plain.contains("SYMBOL_TICK_1"));
    let wrong = Tdts { version: 4, ..Tdts::default() }.write(&sheet, "walk");
    assert!(wrong.unwrap_err().to_string().contains("version"));
}

#[test]
fn sts_has_a_number_on_every_koma() {
    for sheet in sheets() {
        let bytes = sts(&sheet).unwrap();
        assert_eq!(&bytes[..18], b"\x11ShiraheiTimeSheet");
        let (layers, length) =
            (usize::from(bytes[18]), usize::from(u16::from_le_bytes([bytes[19], bytes[20]])));
        assert_eq!((layers, length), (sheet.layers.len(), sheet.length()));
        let (numbers, mut names) = bytes[23..].split_at(2 * layers * length);
        let numbers: Vec<usize> = numbers
            .chunks(2)
            .map(|pair| usize::from(u16::from_le_bytes([pair[0], pair[1]])))
            .collect();
        for (layer, numbers) in sheet.layers.iter().zip(numbers.chunks(length)) {
            assert_eq!(numbers, douga(layer, length));
            let (name, rest) = names[1..].split_at(usize::from(names[0]));
            assert_eq!(SHIFT_JIS.decode(name).0, layer.name);
            names = rest;
        }
        assert!(names.is_empty());
    }
}

#[test]
fn names_that_sts_cannot_hold_lose_letters_and_not_halves_of_letters() {
    let long = layer(&"腕".repeat(200), "ee", &[(0, 1), (1, 1)]);
    let bytes = sts(&sheet(vec![long, layer("é", "ee", &[(0, 1), (1, 1)])])).unwrap();
    let names = &bytes[23 + 2 * 2 * 2..];
    assert_eq!(names[0], 254);
    assert_eq!(SHIFT_JIS.decode(&names[1..255]).0, "腕".repeat(127));
    assert_eq!(&names[255..], b"\x01_");
}

#[test]
fn sts_refuses_what_it_has_no_room_for() {
    let long = layer("A", "ee", &[(0, 65_535), (1, 1)]);
    let many = vec![layer("A", "ee", &[(0, 1), (1, 1)]); 256];
    for sheet in [sheet(vec![long]), sheet(many), sheet(vec![])] {
        assert!(sts(&sheet).unwrap_err().to_string().contains("65535"));
    }
}

#[test]
fn a_table_of_columns_has_a_row_a_koma() {
    for sheet in sheets() {
        let text = columns_csv(&sheet).unwrap();
        assert!(text.lines().flat_map(|line| line.split(',')).all(|cell| cell.starts_with('"')));
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
        let rows: Vec<Vec<String>> =
            reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
        let layers = sheet.layers.len();
        assert_eq!(
            (&rows[0][0][..], &rows[0][1][..], &rows[0][1 + layers][..]),
            ("Frame", "原画", "動画")
        );
        assert_eq!(rows.len(), 2 + sheet.length());
        assert!(rows[2..].iter().enumerate().all(|(koma, row)| row[0] == (koma + 1).to_string()));
        let column = |at: usize| rows[2..].iter().map(move |row| &row[at][..]).enumerate();
        let numbers = |at| {
            let number = |(koma, cell): (usize, &str)| match cell {
                "" | "○" => None,
                "×" => Some((koma, 0)),
                number => Some((koma, number.parse().unwrap())),
            };
            held(sheet.length(), column(at).filter_map(number))
        };
        for (at, layer) in sheet.layers.iter().enumerate() {
            assert_eq!((&rows[1][1 + at], &rows[1][1 + layers + at]), (&layer.name, &layer.name));
            assert_eq!(numbers(1 + at), genga(layer, sheet.length()));
            assert_eq!(numbers(1 + layers + at), douga(layer, sheet.length()));
            let found: Vec<usize> =
                column(1 + at).filter(|(_, cell)| *cell == "○").map(|(koma, _)| koma).collect();
            assert_eq!(found, marks(layer));
        }
    }
}

#[test]
fn after_effects_plays_each_picture_on_its_koma() {
    let rates = [(24.0, "24"), (25.0, "25"), (30.0, "30"), (23.976, "23.976")];
    let sheets = sheets();
    let layers = sheets.iter().flat_map(|sheet| &sheet.layers);
    for ((rate, written), layer) in layers.flat_map(|layer| rates.map(|rate| (rate, layer))) {
        let text = time_remap(layer, rate);
        let (head, keys) = text.split_once("Time Remap\n\tFrame\tseconds\n").unwrap();
        let expected =
            format!("Adobe After Effects 9.0 Keyframe Data\n\n\tUnits Per Second\t{written}\n");
        assert!(head.starts_with(&expected), "{head}");
        let keys = keys.strip_suffix("\n\nEnd of Keyframe Data\n").unwrap();
        let key = |line: &str| {
            let (koma, seconds) = line.strip_prefix('\t').unwrap().split_once('\t').unwrap();
            // A picture is shown from its own start time.
            let seconds: f64 = seconds.parse().unwrap();
            (koma.parse().unwrap(), (rate * seconds).round() as usize + 1)
        };
        let length = layer.length();
        assert_eq!(held(length, keys.lines().map(key)), douga(layer, length));
    }
}

/// The number on each koma by every timesheet that has one: 0 if it is blank.
fn by_each_timesheet(sheet: &Sheet) -> Vec<(&'static str, Vec<usize>)> {
    let length = sheet.cut_length();
    let bytes = sts(sheet).unwrap();
    let words = bytes[23..23 + 2 * length].chunks(2);
    let sts = words.map(|pair| usize::from(u16::from_le_bytes([pair[0], pair[1]]))).collect();
    let table = columns_csv(sheet).unwrap();
    let mut above = 0;
    let cell = |line: &str| {
        let cell = line.rsplit(',').next().unwrap().trim_matches('"').to_owned();
        above = if cell == "×" { 0 } else { cell.parse().unwrap_or(above) };
        above
    };
    let columns = table.lines().skip(2).map(cell).collect();
    let mut by_koma = vec![0; length];
    for row in sheet_csv(sheet).unwrap().lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        by_koma[cells[0].parse::<usize>().unwrap() - 1] = cells[2].parse().unwrap();
    }
    let places = remap_csv(sheet).unwrap();
    let mut remapped = vec![0; length];
    for row in places.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let place: f64 = cells[1].parse().unwrap();
        let is_it = |drawing: &genga::sheet::Drawing| drawing.source.place() == place;
        let drawing = sheet.layers[0].drawings.iter().position(is_it).unwrap();
        remapped[cells[0].parse::<usize>().unwrap() - 1] = drawing + 1;
    }
    vec![("sts", sts), ("columns", columns), ("csv", by_koma), ("remap", remapped)]
}

#[test]
fn blank_koma_are_blank_in_every_timesheet() {
    let sheet = cut_of_24();
    for (before, after) in [(24, 12), (1, 0), (0, 1)] {
        let late = sheet.clone().with_blank(Blank { before, after });
        let found = by_each_timesheet(&late);
        for ((name, whole), (_, numbers)) in found.iter().zip(by_each_timesheet(&sheet)) {
            assert_eq!(whole, &[vec![0; before], numbers, vec![0; after]].concat(), "{name}");
        }
    }
}

#[test]
fn after_effects_hides_a_column_on_blank_koma() {
    let late = cut_of_24().with_blank(Blank { before: 24, after: 12 });
    let mut text = String::new();
    super::after_effects::write(&late, &mut |_, bytes| {
        text = String::from_utf8_lossy(bytes).into_owned();
        Ok(())
    })
    .unwrap();
    assert!(text.contains("seconds\n\t24\t0\n\t30\t"), "{text}");
    let opacity =
        "\nTransform\tOpacity\n\tFrame\tpercent\n\t23\t0\n\t24\t100\n\t47\t100\n\t48\t0\n\nEnd";
    assert!(text.contains(opacity), "{text}");
}

#[test]
fn a_list_of_pictures_says_how_long_nothing_is_shown() {
    let late = cut_of_24().with_blank(Blank { before: 24, after: 12 });
    let list = |sheet: &Sheet| {
        Remap::default().ffconcat(sheet, &sheet.layers[0], genga::time::Frame(99)).unwrap()
    };
    let said = list(&late);
    let added = said.lines().find(|line| line.contains("tpad")).unwrap();
    assert!(
        added.ends_with("tpad=start_duration=1.000000:stop_duration=0.500000 adds them black"),
        "{added}"
    );
    assert_eq!(said.replace(&format!("{added}\n"), ""), list(&cut_of_24()));
}

#[test]
fn a_file_a_column_even_if_two_have_one_name() {
    let twins = sheet(vec![
        layer("A", "ee", &[(0, 1), (1, 1)]),
        layer("a", "ee", &[(0, 1), (1, 1)]),
        layer("a/b", "ee", &[(0, 1), (1, 1)]),
    ]);
    let mut names = Vec::new();
    let at_25 = Clock { koma_rate: 25.0, ..twins.clock };
    super::after_effects::write(&Sheet { clock: at_25, ..twins }, &mut |name, bytes| {
        names.push(name.to_owned());
        assert!(String::from_utf8_lossy(bytes).contains("Units Per Second\t25\n"));
        Ok(())
    })
    .unwrap();
    assert_eq!(names, ["ae/A.txt", "ae/a~2.txt", "ae/a_b.txt"]);
    assert_eq!(Cut::file_of("", "CUT"), "cut");
}
