//! Each genga has a single number, the same in every format, however a person edited the sheet.

use serde_json::Value;

use super::*;
use crate::{Format, Settings};
use genga::sheet::{Drawing, Exposure, Layer, Role, Sheet, Source, Why};

/// Number of drawings before the first genga, so that drawing numbers and genga numbers never coincide.
const INBETWEENS: usize = 300;
/// Genga numbers in the order shown, too high to be koma. Most genga are never shown, one is shown twice, and one
/// comes before those that it follows in the source.
const SHOWN: [usize; 5] = [220, 240, 220, 260, 230];

/// An edited sheet: an inbetween after the first genga, and every genga exposed for 6 koma.
fn edited(clip: &Clip) -> Sheet {
    let drawing = |at: usize| {
        let role = if at < INBETWEENS { Role::Inbetween } else { Role::Genga };
        Drawing::new(Source::At(4.0 + at as f64 / 10.0), role, Why::default())
    };
    let mut shown: Vec<usize> = SHOWN.iter().map(|number| INBETWEENS + number - 1).collect();
    shown.insert(1, 7);
    let layer = Layer {
        name: "A".into(),
        joints: vec![],
        drawings: (0..INBETWEENS + 300).map(drawing).collect(),
        exposures: shown.into_iter().map(|drawing| Exposure { drawing, koma: 6 }).collect(),
        gone: vec![],
    };
    Sheet::new(clip.clock(24.0), vec![layer])
}

fn cut<'a>(clip: &'a Clip, sheet: &'a Sheet) -> Cut<'a> {
    Cut {
        name: "wave",
        clip_file: "wave.bvh",
        clip,
        exaggerated: None,
        sheet,
        spaced: None,
        splits: &[],
        made_with: None,
    }
}

/// The first text file of a format.
fn file(cut: &Cut<'_>, format: &str) -> String {
    let mut files = Vec::new();
    let mut put = |_: &str, bytes: &[u8]| {
        files.push(String::from_utf8_lossy(bytes).into_owned());
        Ok(())
    };
    Format::find(format).unwrap().write(cut, &Settings::default(), &mut put).unwrap();
    files.remove(0)
}

/// The genga numbers that begin the texts of a picture, from left to right and top to bottom.
fn circled(picture: &str) -> Vec<usize> {
    let texts = picture.split('<').filter_map(|tag| tag.split_once('>')).map(|(_, text)| text);
    let number = |text: &str| text.split_whitespace().next()?.parse().ok();
    texts.filter_map(number).filter(|number| (200..300).contains(number)).collect()
}

fn json(text: &str, begin: &str) -> Value {
    let at = text.find(begin).unwrap();
    serde_json::Deserializer::from_str(&text[at..]).into_iter().next().unwrap().unwrap()
}

#[test]
fn drawings_that_are_never_shown_are_counted_nowhere() {
    let clip = wave();
    let sheet = edited(&clip);
    for (format, words) in [
        ("bars", ["A:  36 koma (1.5 s)  ·  5 drawings  ·  4 genga"].as_slice()),
        ("xsheet", &["原画 genga 4 (0 ends", "動画 drawings 5, inbetweens 中割り 1 "]),
        ("contact", &["genga 原画 4 · 5 drawings 動画"]),
    ] {
        let file = file(&cut(&clip, &sheet), format);
        words.iter().for_each(|words| assert!(file.contains(words), "{format}: {words}"));
    }
}

#[test]
fn a_genga_has_one_number_in_every_format() {
    let clip = wave();
    let sheet = edited(&clip);
    let file = |format: &str| file(&cut(&clip, &sheet), format);
    let number = |value: &Value| value.as_u64().map(|number| number as usize);

    let keys = file("csv");
    let keys = csv::Reader::from_reader(keys.as_bytes()).into_records();
    let keys: Vec<usize> = keys.map(|row| row.unwrap()[4].parse().unwrap()).collect();
    assert_eq!(keys, SHOWN, "keys.csv");

    let xdts = json(&file("xdts"), "{\"");
    let entries = xdts["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array().unwrap();
    let values = entries.iter().map(|entry| entry["data"][0]["values"][0].as_str().unwrap());
    let xdts: Vec<usize> = values.filter_map(|value| value.parse().ok()).collect();
    assert_eq!(xdts, SHOWN, "XDTS");

    let glb = json(&file("glb"), "{\"");
    for animation in glb["animations"].as_array().unwrap() {
        let keys = animation["extras"]["keys"].as_array().unwrap();
        let glb: Vec<_> = keys.iter().filter_map(|key| number(&key["genga_no"])).collect();
        assert_eq!(glb, SHOWN, "GLB, {}", animation["name"]);
    }

    let book = json(&file("flipbook"), "{\"cut\"");
    let book = &book["sheets"][0];
    let cells = book["cells"].as_array().unwrap().iter();
    let genga = cells.map(|cell| &book["drawings"][number(&cell[0]).unwrap()]["genga"]);
    assert_eq!(genga.filter_map(number).collect::<Vec<_>>(), SHOWN, "flip-book");

    for picture in ["bars", "poses", "strip", "contact"] {
        assert_eq!(circled(&file(picture)), SHOWN, "{picture}");
    }
    let ways: Vec<usize> = SHOWN.windows(2).flatten().copied().collect();
    assert_eq!(circled(&file("onion")), ways, "onion skin: from each to the next");
    let paper = circled(&file("xsheet"));
    assert_eq!(paper[..SHOWN.len()], SHOWN, "ACTION of the X-sheet");
    assert!(paper.iter().all(|number| SHOWN.contains(number)), "its gauges: {paper:?}");
}
