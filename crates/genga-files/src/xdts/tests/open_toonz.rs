//! OpenToonz's reading of XDTS, reimplemented from the description of its reader and independent of
//! ours. It indexes without bounds checks, as OpenToonz does.

use serde_json::Value;

use genga::sheet::{Role, Sheet};

/// A level on the sheet: its name, the drawing on each row (`None` if empty), and the rows with a mark or a key.
pub(super) struct Level {
    pub(super) name: String,
    pub(super) rows: Vec<Option<u64>>,
    pub(super) ticks: Vec<usize>,
    pub(super) keys: Vec<usize>,
}

pub(super) fn import(file: &[u8]) -> Vec<Level> {
    // The file starts with the signature; the rest is JSON.
    let json = file.strip_prefix(b"exchangeDigitalTimeSheet Save Data").unwrap();
    let root: Value = serde_json::from_slice(json).unwrap();
    // OpenToonz reads only the first table, and of it only the field and header of cels.
    let table = &root["timeTables"].as_array().unwrap()[0];
    let cels = |list: &str| {
        let items = table[list].as_array().unwrap();
        items.iter().rfind(|item| item["fieldId"].as_f64().unwrap().round() == 0.0).unwrap()
    };
    let names = cels("timeTableHeaders")["names"].as_array().unwrap();
    let tracks = cels("fields")["tracks"].as_array().unwrap();
    let occupied = tracks.iter().filter(|track| !track["frames"].as_array().unwrap().is_empty());
    occupied
        .map(|track| {
            let column = track["trackNo"].as_u64().unwrap() as usize;
            level(names[column].as_str().unwrap(), track)
        })
        .collect()
}

fn level(name: &str, track: &Value) -> Level {
    let mut frames: Vec<_> = track["frames"].as_array().unwrap().iter().collect();
    frames.sort_by_key(|frame| frame["frame"].as_i64().unwrap());
    let mut level = Level { name: name.into(), rows: vec![], ticks: vec![], keys: vec![] };
    for frame in frames {
        let begin = frame["frame"].as_i64().unwrap() as usize;
        while level.rows.len() < begin {
            level.rows.push(level.rows.last().copied().flatten());
        }
        let datum = &frame["data"].as_array().unwrap()[0];
        let before = level.rows.last().copied().flatten();
        match datum["values"].as_array().unwrap()[0].as_str().unwrap() {
            "SYMBOL_NULL_CELL" => level.rows.push(None),
            "SYMBOL_HYPHEN" => level.rows.push(before),
            "SYMBOL_TICK_1" | "SYMBOL_TICK_2" => {
                level.ticks.push(begin);
                level.rows.push(before);
            }
            number => level.rows.push(Some(number.parse().unwrap())),
        }
        let options = datum["options"].as_array();
        if options.is_some_and(|all| all.iter().any(|option| option == "OPTION_KEYFRAME")) {
            level.keys.push(begin);
        }
    }
    level
}

/// Asserts that both files, as OpenToonz reads them, match the sheet koma by koma.
pub(super) fn agrees(sheet: &Sheet, genga: &str, douga: &str) {
    let (genga, douga) = (import(genga.as_bytes()), import(douga.as_bytes()));
    assert_eq!((genga.len(), douga.len()), (sheet.layers.len(), sheet.layers.len()));
    for (layer, (genga, douga)) in sheet.layers.iter().zip(genga.iter().zip(&douga)) {
        assert_eq!(genga.name, douga.name);
        // Numbers of kept drawings, counted independently of the writer.
        let kept = |drawing: usize| {
            let before = &layer.drawings[..=drawing];
            before.iter().filter(|drawing| drawing.role != Role::Inbetween).count() as u64
        };
        let (shown, before): (Vec<usize>, usize) = (layer.koma().collect(), sheet.blank.before);
        let mut key = None;
        for (koma, &drawing) in shown.iter().enumerate() {
            let begins = koma == 0 || shown[koma - 1] != drawing;
            let is_key = layer.drawings[drawing].role != Role::Inbetween;
            if is_key {
                key = Some(kept(drawing));
            }
            let koma = before + koma;
            assert_eq!(genga.rows[koma], key, "genga, koma {koma}");
            assert_eq!(douga.rows[koma], Some(drawing as u64 + 1), "douga, koma {koma}");
            assert_eq!(genga.ticks.contains(&koma), begins && !is_key, "tick, koma {koma}");
            assert_eq!(douga.keys.contains(&koma), begins && is_key, "circle, koma {koma}");
        }
        for level in [genga, douga] {
            let (first, end) = (before.min(level.rows.len()), before + shown.len());
            assert!(level.rows[..first].iter().all(Option::is_none), "nothing before it enters");
            assert_eq!(level.rows.len(), end + 1, "one row after the last");
            assert_eq!(level.rows[end], None, "which is empty");
        }
    }
}
