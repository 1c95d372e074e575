//! A written sheet reads back identically, and mistakes are reported with their place.

mod fits;
mod laws;
mod mistakes;

use super::*;
use crate::Cut;
use crate::tests::{edits, recipe, wave};
use genga::pipeline::Engine;
use genga::sheet::{Role, Source, SpokenLine};

/// The sheet of the wave.
fn file() -> SheetFile {
    let (recipe, edits) = (recipe(), edits());
    let mut engine = Engine::new(wave()).unwrap();
    let breakdown = engine.run(&recipe, &edits).unwrap();
    let cut = Cut {
        name: "波 \"wave\"",
        clip_file: "wave.bvh",
        clip: breakdown.clip,
        exaggerated: None,
        sheet: breakdown.sheet,
        spaced: None,
        splits: &[],
        made_with: Some(&MadeWith::new(&recipe, &edits, breakdown.sheet)),
    };
    SheetFile::new(&cut)
}

/// The wave's sheet as text.
fn text() -> String {
    file().write().unwrap()
}

#[test]
fn the_sheet_looks_as_it_did() {
    insta::assert_snapshot!(text());
}

#[test]
fn what_is_written_reads_back() {
    let again = read(text().as_bytes()).unwrap();
    assert_eq!(again, file());
    assert_eq!(again.write().unwrap(), text());
}

/// The wave's sheet with a spoken line.
fn spoken() -> SheetFile {
    let mut file = file();
    let line = SpokenLine { begin: 3, koma: 5, speaker: "Aki".into(), words: "Ready?".into() };
    file.sheet.lines = vec![line];
    file
}

#[test]
fn drawings_and_koma_count_from_1_as_in_the_tables() {
    let text = spoken().write().unwrap();
    let written: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&written["schema"], &written["lines"][0]["begin"]), (&SCHEMA.into(), &4.into()));
    let layer = &written["layers"][0];
    let numbers = |list: &str| -> Vec<u64> {
        let items = layer[list].as_array().unwrap().iter();
        items.map(|item| item["drawing"].as_u64().unwrap()).collect()
    };
    assert_eq!(numbers("drawings"), (1..=17).collect::<Vec<_>>());
    let shown = &file().sheet.layers[0].exposures;
    let shown: Vec<u64> = shown.iter().map(|shown| shown.drawing as u64 + 1).collect();
    assert_eq!(numbers("exposures"), shown);
    assert_eq!(read(text.as_bytes()).unwrap(), spoken());
    let early = text.replacen("\"begin\": 4", "\"begin\": 0", 1);
    let error = read(early.as_bytes()).unwrap_err().to_string();
    assert!(error.contains("begins on koma 0; koma count from 1"), "{error}");
}

#[test]
fn a_file_of_the_first_version_counts_from_0() {
    let text = spoken().write().unwrap().replacen(SCHEMA, SCHEMA_FROM_0, 1);
    let old = text.lines().map(|line| match line.split_once("{\"drawing\": ") {
        Some((head, rest)) => {
            let (number, rest) = rest.split_once(',').unwrap();
            format!("{head}{{\"drawing\": {},{rest}\n", number.parse::<usize>().unwrap() - 1)
        }
        None => format!("{}\n", line.replace("\"begin\": 4", "\"begin\": 3")),
    });
    let read = read(old.collect::<String>().as_bytes()).unwrap();
    assert_eq!(read, spoken());
    assert_eq!(read.sheet.lines[0].begin, 3);
}

#[test]
fn a_drawing_and_an_exposure_are_a_line_each() {
    let (file, text) = (file(), text());
    let layer = &file.sheet.layers[0];
    let lines = |what: &str| text.lines().filter(|line| line.contains(what)).count();
    assert_eq!(lines("{\"drawing\": "), layer.drawings.len() + layer.exposures.len());
    assert_eq!(lines("{\"drawing\": 3, \"role\": "), 1);
    assert_eq!(lines("{\"drawing\": 3, \"koma\": "), 1);
}

#[test]
fn the_recipe_that_made_it_makes_it_again() {
    let made = read(text().as_bytes()).unwrap().made_with.unwrap();
    assert_eq!(made.recipe().unwrap(), recipe());
    assert_eq!(made.edits, edits());
    let mut endless = recipe();
    endless.set("keys.per_second", "inf").unwrap();
    assert_eq!(MadeWith::new(&endless, &edits(), &file().sheet).recipe().unwrap(), endless);
    // Settings that no longer exist are kept in the record.
    let text = text().replace("\"keys.rest\"", "\"keys.of_old\"");
    let made = read(text.as_bytes()).unwrap().made_with.unwrap();
    assert!(made.recipe().unwrap_err().to_string().starts_with("keys.of_old: "));
}

#[test]
fn an_edited_sheet_is_known_and_stays_known_when_it_is_written_again() {
    assert!(read(text().as_bytes()).unwrap().is_as_made());
    // Drawing numbers are only names, and whitespace does not count.
    let same = text().replace("{\"drawing\": 2, ", "{\"drawing\": 900, ").replace("\": ", "\":");
    assert!(read(same.as_bytes()).unwrap().is_as_made());
    for (line, edited) in [
        ("\"koma\": 4", "\"koma\": 5"),
        ("\"role\": \"genga\"", "\"role\": \"inbetween\""),
        ("\"frame\": 22", "\"frame\": 26"),
        ("\"name\": \"A\"", "\"name\": \"B\""),
        ("\n    \"layers\": \"", "\n    \"layers\": \"0"),
        ("\n  \"layers\": [", "\n  \"root\": \"ones\",\n  \"layers\": ["),
        ("\n  \"layers\": [", "\n  \"feet\": \"held\",\n  \"layers\": ["),
        ("\n  \"layers\": [", "\n  \"exaggerate\": {\"ease\": 0.5},\n  \"layers\": ["),
        ("\"name\": \"A\",", "\"name\": \"A\", \"joints\": [\"Hips\"],"),
    ] {
        assert!(text().contains(line), "{line}");
        let file = read(text().replacen(line, edited, 1).as_bytes()).unwrap();
        assert!(!file.is_as_made(), "{edited}");
        assert!(!read(file.write().unwrap().as_bytes()).unwrap().is_as_made(), "{edited}");
    }
}

#[test]
fn a_person_may_write_it_otherwise() {
    let text = text();
    let other = format!("\u{feff}{}", text.replace('\n', "\r\n").replace("\": ", "\":"));
    assert_eq!(read(other.as_bytes()).unwrap(), file());
    // Drawing numbers are only names; the order is that of the list.
    let renamed = text
        .replace("{\"drawing\": 2, ", "{\"drawing\": 900, ")
        .replace("{\"drawing\": 1, ", "{\"drawing\": 2, ");
    assert_eq!(read(renamed.as_bytes()).unwrap(), file());
    // A drawing may be shown again, or never.
    let again = text.replace("{\"drawing\": 3, \"koma\"", "{\"drawing\": 6, \"koma\"");
    assert_eq!(read(again.as_bytes()).unwrap().sheet.layers[0].exposures[2].drawing, 5);
    // Leave out the optional fields.
    let (head, tail) = text.split_once("  \"made_with\"").unwrap();
    let (_, tail) = tail.split_once("\n  \"layers\"").unwrap();
    let bare = format!("{head}  \"layers\"{tail}").replace("  \"genga\": \"0.1.0\",\n", "");
    let read = read(bare.as_bytes()).unwrap();
    assert!(!read.is_as_made(), "nobody knows");
    assert_eq!((read.made_with, read.genga.as_str()), (None, ""));
}

#[test]
fn a_blend_is_written_as_two_frames_and_a_share() {
    let mut file = file();
    file.sheet.layers[0].drawings[7].source = Source::Between { from: 4.0, to: 23.5, share: 0.1 };
    let text = file.write().unwrap();
    let line = "{\"drawing\": 8, \"role\": \"inbetween\", \"between\": [4, 23.5], \"share\": 0.1}";
    assert!(text.contains(line), "{text}");
    assert_eq!(read(text.as_bytes()).unwrap(), file);
}

#[test]
fn a_sheet_that_no_reader_would_take_is_not_written() {
    type Spoil = fn(&mut SheetFile);
    let spoilt: [(&str, Spoil); 8] = [
        ("koma 0 shows frame 5, but", |file| file.sheet.clock.first.0 = 5),
        ("it is made for 50 frames a second, the clip has 60", |file| file.clip.frame_rate = 60.0),
        ("fps is 0; ", |file| file.sheet.clock.koma_rate = 0.0),
        ("layer A: frame NaN is not in", |file| {
            file.sheet.layers[0].drawings[0].source = Source::At(f64::NAN);
        }),
        ("layer A: frame 104.5 is not in the clip, which has frames 4 to 104", |file| {
            file.sheet.layers[0].drawings[0].source = Source::At(104.5);
        }),
        ("layer A shows drawing 17 but has 17", |file| {
            file.sheet.layers[0].exposures[0].drawing = 17;
        }),
        ("layer A: an exposure of 0 koma", |file| file.sheet.layers[0].exposures[0].koma = 0),
        ("layer A: a strength or price", |file| {
            file.sheet.layers[0].drawings[3].why.price = Some(f64::INFINITY);
        }),
    ];
    for (words, spoil) in spoilt {
        let mut file = file();
        spoil(&mut file);
        let error = file.write().unwrap_err().to_string();
        assert!(error.starts_with(words), "{words}: {error}");
    }
}

#[test]
fn the_smallest_sheets_are_sheets() {
    let mut file = file();
    file.sheet.layers[0].drawings.truncate(1);
    file.sheet.layers[0].exposures.truncate(1);
    assert_eq!(file.sheet.layers[0].drawings[0].role, Role::End);
    assert_eq!(read(file.write().unwrap().as_bytes()).unwrap(), file);
    file.sheet.layers[0].exposures.clear();
    file.sheet.layers[0].drawings.clear();
    assert_eq!(read(file.write().unwrap().as_bytes()).unwrap(), file);
    file.sheet.layers.clear();
    assert_eq!(read(file.write().unwrap().as_bytes()).unwrap(), file);
}
