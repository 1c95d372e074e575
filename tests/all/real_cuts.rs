//! Cuts of real clips: late entries, repeats, camera work and somebody else's timesheet, in the files that say so.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};
use tempfile::TempDir;

use crate::clips::{here, name, with};
use crate::cut::{DIRECTORS, made, timesheet};

const CLIPS: [&str; 4] =
    ["cmu-02_05-punch-strike", "cmu-07_01-walk", "cmu-135_04-front-kick", "threejs-pirouette"];

/// A folder with a real clip as `take.bvh`.
fn place(path: &Path) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(path, folder.path().join("take.bvh")).unwrap();
    folder
}

/// Checks each real clip, by its name, in a folder of its own.
fn each(check: impl Fn(&str, &Path)) {
    with(CLIPS, |paths| paths.iter().for_each(|path| check(&name(path), place(path).path())));
}

fn sheet(folder: &Path, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.join(name)).unwrap()).unwrap()
}

/// The first column of a field of a timesheet, a word a koma; a word stays until the next.
fn column(folder: &Path, name: &str, field: u64) -> Vec<String> {
    let file = timesheet(folder, name);
    let table = &file["timeTables"][0];
    let fields = table["fields"].as_array().unwrap();
    let field = fields.iter().find(|own| own["fieldId"] == field).unwrap();
    let mut koma = vec![String::new(); table["duration"].as_u64().unwrap() as usize];
    for frame in field["tracks"][0]["frames"].as_array().unwrap() {
        let word = frame["data"][0]["values"][0].as_str().unwrap();
        koma[frame["frame"].as_u64().unwrap() as usize..].fill(word.into());
    }
    koma
}

#[test]
fn a_real_cut_enters_late_leaves_early_and_comes_back() {
    each(|name, folder| {
        made(folder, "run take.bvh --deliver xdts --out plain");
        let plain = column(folder, "plain/take_douga_ts.xdts", 0);
        let (begin, end) = (24, 24 + plain.len());
        let length = end + 14;
        made(folder, &format!("run take.bvh --deliver xdts --out a --at 25 --length {length}"));
        let late = column(folder, "a/take_douga_ts.xdts", 0);
        assert_eq!(late.len(), length, "{name}");
        assert_eq!(late[begin..end], plain, "{name}: the same drawings, 24 koma later");
        let blank = |koma: &[String]| koma.iter().all(|word| word == "SYMBOL_NULL_CELL");
        assert!(blank(&late[..begin]) && blank(&late[end..]), "{name}: {late:?}");
        made(folder, "deliver a/take_douga_ts.xdts take.bvh --to json --out back");
        let (there, back) = (sheet(folder, "a/sheet.json"), sheet(folder, "back/sheet.json"));
        for part in ["layers", "at", "length"] {
            assert_eq!(there[part], back[part], "{name}: {part}");
        }
    });
}

#[test]
fn rounds_of_a_real_walk_are_the_same_in_the_timesheet() {
    with(["cmu-07_01-walk"], |[path]| {
        let place = place(&path);
        let folder = place.path();
        let table = made(folder, "split take.bvh --cycles --quiet");
        let range = table.split_whitespace().find(|word| word.contains("..")).unwrap();
        let run = "--loop --cycles 3 --deliver xdts,xsheet --out a";
        made(folder, &format!("run take.bvh --trim {range} {run}"));
        let shown = column(folder, "a/take_douga_ts.xdts", 0);
        let round = sheet(folder, "a/sheet.json")["loop"]["koma"].as_u64().unwrap() as usize;
        assert_eq!(shown.len(), 3 * round);
        assert_eq!(shown[0], "1");
        assert_eq!(
            [&shown[..round], &shown[..round]],
            [&shown[round..2 * round], &shown[2 * round..]]
        );
        let paper = fs::read_to_string(folder.join("a/take_xsheet.html")).unwrap();
        assert_eq!(paper.matches(">ピ<").count(), 2, "リピート once in ACTION, once in CELL");
    });
}

#[test]
fn a_camera_over_a_real_cut_fills_its_column_and_a_word_of_a_person_goes_over_it() {
    each(|name, folder| {
        fs::copy(here("data/kick-camera.json"), folder.join("camera.json")).unwrap();
        let run = "run take.bvh --deliver xdts --camera-work camera.json";
        let said = made(folder, &format!("{run} --out a"));
        assert!(said.contains("guessed from the camera's motion"), "{name}: {said}");
        let work = sheet(folder, "a/sheet.json")["camera"].as_array().unwrap().clone();
        let column = column(folder, "a/take_douga_ts.xdts", 5);
        for own in &work {
            let [begin, koma] = ["begin", "koma"].map(|part| own[part].as_u64().unwrap() as usize);
            assert_eq!(column[begin - 1], own["words"].as_str().unwrap(), "{name}: {own}");
            let rest = &column[begin..begin - 1 + koma];
            assert!(rest.iter().all(|word| word == "SYMBOL_HYPHEN"), "{name}: {rest:?}");
        }
        let first = sheet(folder, "a/report.json")["first_frame"].as_u64().unwrap();
        let own = format!("[[edits.camera]]\nframes = [{first}, {}]\ntext = \"FIX\"\n", first + 20);
        fs::write(folder.join("own.toml"), own).unwrap();
        made(folder, &format!("{run} --recipe own.toml --out b"));
        let begin = &sheet(folder, "b/sheet.json")["camera"][0];
        assert_eq!((&begin["begin"], &begin["words"]), (&json!(1), &json!("FIX")), "{name}");
    });
}

#[test]
fn a_real_column_goes_into_somebody_s_timesheet_and_all_else_of_it_stays() {
    each(|name, folder| {
        made(folder, "run take.bvh --deliver xdts --out a");
        let drawn = column(folder, "a/take_douga_ts.xdts", 0);
        let theirs = DIRECTORS.replacen("130", &drawn.len().to_string(), 1);
        fs::write(folder.join("c045.xdts"), &theirs).unwrap();
        made(folder, "deliver a/sheet.json take.bvh --into c045.xdts --out out");
        let put = fs::read_to_string(folder.join("out/c045.xdts")).unwrap();
        let track = put.find(",{\"frames\":").unwrap();
        let end = track + put[track..].find("\"trackNo\":1}").unwrap() + "\"trackNo\":1}".len();
        assert_eq!([&put[..track], &put[end..]].concat(), theirs, "{name}: byte for byte");
        let own: Value = serde_json::from_str(&put[track + 1..end]).unwrap();
        let frames = own["frames"].as_array().unwrap();
        assert!(frames.len() > 5, "{name}: {own}");
        for frame in frames {
            let at = frame["frame"].as_u64().unwrap() as usize;
            let word = drawn.get(at).map_or("SYMBOL_NULL_CELL", String::as_str);
            assert_eq!(frame["data"][0]["values"][0], word, "{name}: koma {}", at + 1);
        }
    });
}

#[test]
fn the_numbers_of_a_real_file_s_name_are_on_its_sheet() {
    each(|name, folder| {
        fs::rename(folder.join("take.bvh"), folder.join("ep03_s12_c045.bvh")).unwrap();
        made(folder, "run ep03_s12_c045.bvh --deliver xdts --out a");
        let header = &timesheet(folder, "a/ep03_s12_c045_douga_ts.xdts")["header"];
        assert_eq!(*header, json!({ "cut": "45", "scene": "12" }), "{name}");
    });
}
