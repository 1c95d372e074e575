//! The CAMERA column of a camera that moves, and what stands beside the body in the files of its own format.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use crate::clips::here;
use crate::cut::{made, refused, timesheet};
use crate::stage::stage;

fn place() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for name in ["kick.bvh", "kick-camera.json"] {
        fs::copy(here("data").join(name), folder.path().join(name)).unwrap();
    }
    fs::write(folder.path().join("stage.glb"), stage().glb()).unwrap();
    folder
}

fn sheet(folder: &Path, name: &str) -> Value {
    serde_json::from_slice(&fs::read(folder.join(name)).unwrap()).unwrap()
}

/// The CAMERA column of a timesheet: first koma from 0, koma, words.
fn camera_column(folder: &Path, name: &str) -> Vec<(u64, u64, String)> {
    let file = timesheet(folder, name);
    let table = file["timeTables"].as_array().or(file["timeSheets"][0]["timeTables"].as_array());
    let fields = table.unwrap()[0]["fields"].as_array().unwrap();
    let camera = fields.iter().find(|field| field["fieldId"] == 5).unwrap();
    let mut column: Vec<(u64, u64, String)> = Vec::new();
    for frame in camera["tracks"][0]["frames"].as_array().unwrap() {
        let (at, word) = (frame["frame"].as_u64().unwrap(), &frame["data"][0]["values"][0]);
        match (word.as_str().unwrap(), column.last_mut()) {
            ("SYMBOL_HYPHEN", Some((begin, koma, _))) => *koma = at - *begin + 1,
            ("SYMBOL_NULL_CELL", _) => {}
            (words, _) => column.push((at, 1, words.into())),
        }
    }
    column
}

#[test]
fn a_camera_that_moves_fills_the_camera_column_and_the_summary_says_that_it_is_a_guess() {
    let folder = place();
    let folder = folder.path();
    let said = made(
        folder,
        "run kick.bvh --camera-work kick-camera.json --deliver xdts,tdts,xsheet --out a",
    );
    let line = said.lines().find(|line| line.starts_with("camera")).unwrap();
    assert_eq!(
        line,
        "camera      カメラ     PAN koma 13 to 48, T.U koma 61 to 84: guessed from the camera's motion; \
         [[edits.camera]] goes over it"
    );
    let camera = &sheet(folder, "a/sheet.json")["camera"];
    let work = |begin: u64, koma: u64, words: &str| json!({ "begin": begin, "koma": koma, "words": words, "guess": true });
    assert_eq!(*camera, json!([work(13, 36, "PAN"), work(61, 24, "T.U")]));
    let column = [(12, 36, "PAN".to_owned()), (60, 24, "T.U".to_owned())];
    for name in ["kick_genga_ts.xdts", "kick_douga_ts.xdts", "kick.tdts"] {
        assert_eq!(camera_column(folder, &format!("a/{name}")), column, "{name}");
    }
    let paper = fs::read_to_string(folder.join("a/xsheet/0001.svg")).unwrap();
    assert!(paper.contains(">PAN<") && paper.contains(">T.U<"));

    // A person's word wins, the sheet keeps its guesses when it is delivered, and a late entry takes them along.
    let recipe = "[[edits.camera]]\nframes = [24, 36]\ntext = \"FIX\"\n";
    fs::write(folder.join("own.toml"), recipe).unwrap();
    let said = made(
        folder,
        "run kick.bvh --camera-work kick-camera.json --recipe own.toml --at 11 --out b",
    );
    assert!(said.contains("PAN koma 23 to 34, PAN koma 47 to 58, T.U koma 71 to 94"), "{said}");
    made(folder, "deliver b/sheet.json kick.bvh --to xdts --out c");
    let words: Vec<_> = camera_column(folder, "c/kick_douga_ts.xdts");
    let words: Vec<_> =
        words.iter().map(|(at, koma, words)| (*at, *koma, words.as_str())).collect();
    assert_eq!(words, [(22, 12, "PAN"), (34, 12, "FIX"), (46, 12, "PAN"), (70, 24, "T.U")]);

    let said = made(folder, "run kick.bvh --out d");
    assert!(!said.contains("camera  "), "{said}");
    assert!(sheet(folder, "d/sheet.json")["camera"].is_null());
}

#[test]
fn the_camera_of_the_motion_s_own_file_fills_the_column_too() {
    let folder = place();
    let folder = folder.path();
    let said = made(folder, "run stage.glb --fps 24 --deliver xdts,glb,vmd --out a");
    assert!(said.contains("PAN koma 25 to 49: guessed"), "{said}");
    assert!(said.contains("beside the body: cameras (1), shapes (2), nodes that move"), "{said}");
    assert!(
        said.contains("vmd: not in it is what the file holds beside the body: cameras (1)"),
        "{said}"
    );
    assert_eq!(camera_column(folder, "a/stage_douga_ts.xdts"), [(24, 25, "PAN".to_owned())]);
    let read = genga_read::open(&folder.join("a/limited.glb")).unwrap().clip;
    assert!(read.beside().unwrap().camera.as_ref().unwrap().moves());
    let again = made(folder, "run a/limited.glb --fps 24 --out b");
    assert!(again.contains("PAN koma 25 to 48: guessed"), "it rests on the last koma: {again}");
}

#[test]
fn the_camera_of_a_vmd_is_written_beside_the_motion_and_never_over_its_own_file() {
    let folder = place();
    let folder = folder.path();
    made(folder, "run kick.bvh --deliver vmd --out a");
    let file = camera_vmd(&[(0, 0.0), (30, 0.0), (60, 20.0), (110, 20.0)]);
    fs::write(folder.join("kick-camera.vmd"), &file).unwrap();
    let run = "run a/kick.vmd --camera-work kick-camera.vmd --deliver vmd,xdts";
    let said = made(folder, &format!("{run} --out b"));
    assert!(said.contains("PAN koma 25 to 48: guessed"), "{said}");
    let written = fs::read(folder.join("b/kick-camera.vmd")).unwrap();
    assert_eq!(written[50..], file[50..], "the time is kept, and so is every key");
    let said = refused(folder, &format!("{run} --out ."));
    assert!(said.contains("kick-camera.vmd"), "{said}");
    let said = refused(folder, "run kick-camera.vmd");
    assert!(said.contains("--camera-work"), "{said}");
}

/// A camera that slides to the right: frame and x of the point that it looks at.
fn camera_vmd(keys: &[(u32, f32)]) -> Vec<u8> {
    let mut file = b"Vocaloid Motion Data 0002".to_vec();
    file.resize(30 + 20, 0);
    file.extend([0; 8]);
    file.extend((keys.len() as u32).to_le_bytes());
    for (frame, x) in keys {
        file.extend(frame.to_le_bytes());
        for number in [-45.0, *x, 10.0, 0.0, 0.0, 0.0, 0.0_f32] {
            file.extend(number.to_le_bytes());
        }
        file.extend([20, 107, 20, 107].repeat(6));
        file.extend(30_u32.to_le_bytes());
        file.push(0);
    }
    file.extend([0; 12]);
    file
}
