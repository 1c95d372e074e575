//! The cut that a sheet belongs to: its slate, late entries, and other people's timesheets.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::clips::here;

/// A folder with the kick under the name of a cut.
fn place(name: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(here("data/kick.bvh"), folder.path().join(name)).unwrap();
    folder
}

/// Runs the program, and returns whether it worked and what it said.
fn genga(folder: &Path, args: &str) -> (bool, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_genga"));
    let args = args.split_whitespace();
    let output = command.current_dir(folder).args(args).stdin(Stdio::null()).output().unwrap();
    let said = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8(said).unwrap())
}

pub(crate) fn made(folder: &Path, args: &str) -> String {
    let (is_made, said) = genga(folder, args);
    assert!(is_made, "{args}: {said}");
    said
}

pub(crate) fn refused(folder: &Path, args: &str) -> String {
    let (is_made, said) = genga(folder, args);
    assert!(!is_made, "{args}: {said}");
    said
}

fn text(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

pub(crate) fn timesheet(folder: &Path, name: &str) -> Value {
    serde_json::from_str(text(folder, name).split_once('\n').unwrap().1).unwrap()
}

#[test]
fn the_numbers_of_a_file_s_name_are_on_every_sheet_and_options_go_over_them() {
    let folder = place("ep03_s12_c045_t2.bvh");
    let folder = folder.path();
    let said = made(folder, "run ep03_s12_c045_t2.bvh --deliver xdts,tdts,xsheet --out a");
    assert!(
        said.contains("episode 03, scene 12, cut 045, take 2 (numbers not given: from"),
        "{said}"
    );
    let header = &timesheet(folder, "a/ep03_s12_c045_t2_douga_ts.xdts")["header"];
    assert_eq!(*header, json!({ "cut": "45", "scene": "12" }));
    let header = &timesheet(folder, "a/ep03_s12_c045_t2.tdts")["timeSheets"][0]["header"];
    assert_eq!(*header, json!({ "cut": "45", "scene": "12", "episode": "03" }));
    let paper = text(folder, "a/xsheet/0001.svg");
    for word in ["045  take 2", ">03<", ">12<"] {
        assert!(paper.contains(word), "{word}");
    }
    assert!(!text(folder, "a/sheet.json").contains("\"slate\""), "the name is enough");
    made(folder, "run ep03_s12_c045_t2.bvh --deliver xdts,xsheet --out a --cut 46 --animator アキ");
    let name = "a/ep03_s12_c045_t2_genga_ts.xdts";
    assert_eq!(timesheet(folder, name)["header"], json!({ "cut": "46", "scene": "12" }));
    let paper = text(folder, "a/xsheet/0001.svg");
    assert!(paper.contains(">46  take 2<") && paper.contains("アキ"));
    let said = made(folder, "run ep03_s12_c045_t2.bvh --deliver xdts --out a --scene 13");
    assert!(
        said.contains("kept from a/recipe.toml (--fresh goes without): cut 46, animator アキ"),
        "{said}"
    );
    assert_eq!(timesheet(folder, name)["header"], json!({ "cut": "46", "scene": "13" }));
    let sheet: Value = serde_json::from_str(&text(folder, "a/sheet.json")).unwrap();
    assert_eq!(sheet["slate"], json!({ "scene": "13", "cut": "46", "animator": "アキ" }));
    made(
        folder,
        "deliver a/sheet.json ep03_s12_c045_t2.bvh --to xdts --out b --title 作品 --cut 47a",
    );
    let name = "b/ep03_s12_c045_t2_genga_ts.xdts";
    assert_eq!(timesheet(folder, name)["header"], json!({ "cut": "47", "scene": "13" }));
    made(folder, "run ep03_s12_c045_t2.bvh --deliver xdts --out a --fresh");
    let name = "a/ep03_s12_c045_t2_genga_ts.xdts";
    assert_eq!(timesheet(folder, name)["header"]["cut"], "45");
}

#[test]
fn a_batch_takes_each_cut_from_its_file_or_its_row() {
    let folder = place("s1_c2.bvh");
    let folder = folder.path();
    fs::copy(here("data/kick.bvh"), folder.join("walk.bvh")).unwrap();
    fs::write(folder.join("list.csv"), "clip,cut,scene,at\ns1_c2.bvh,,,\nwalk.bvh,7,3,25\n")
        .unwrap();
    made(folder, "batch @list.csv --deliver xdts --animator Aki --out out");
    let header =
        |clip: &str| timesheet(folder, &format!("out/clips/{clip}.bvh/{clip}_douga_ts.xdts"));
    assert_eq!(header("s1_c2")["header"], json!({ "cut": "2", "scene": "1" }));
    let walk = header("walk");
    assert_eq!(walk["header"], json!({ "cut": "7", "scene": "3" }));
    assert_eq!(walk["timeTables"][0]["duration"], 24 + 92);
}

#[test]
fn a_drawing_enters_late_and_leaves_early_in_every_format() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    made(folder, "run kick.bvh --deliver xdts,columns,ae --out plain");
    let said = made(
        folder,
        "run kick.bvh --deliver xdts,tdts,sts,columns,ae,xsheet,vmd,glb,vrma --out a --at 25 --length 130",
    );
    let blank =
        "koma 1 to 24 and 117 to 130 of 130; a motion stands in its first or last pose there";
    assert!(said.contains(blank), "{said}");
    for name in ["kick_genga_ts.xdts", "kick_douga_ts.xdts"] {
        let table = &timesheet(folder, &format!("a/{name}"))["timeTables"][0];
        assert_eq!(table["duration"], 130);
        let frames = table["fields"][0]["tracks"][0]["frames"].as_array().unwrap();
        let entry =
            |at: usize| (frames[at]["frame"].clone(), frames[at]["data"][0]["values"][0].clone());
        assert_eq!(entry(0), (json!(0), json!("SYMBOL_NULL_CELL")));
        assert_eq!(entry(1), (json!(24), json!("1")));
        assert_eq!(entry(frames.len() - 1), (json!(116), json!("SYMBOL_NULL_CELL")));
    }
    let rows = |name: &str| -> Vec<String> {
        text(folder, name).lines().skip(2).map(String::from).collect()
    };
    let (late, plain) = (rows("a/kick_timesheet.csv"), rows("plain/kick_timesheet.csv"));
    assert_eq!(late.len(), 130);
    let cells = |row: &String| row.split_once(',').unwrap().1.to_owned();
    assert_eq!(
        late[24..116].iter().map(cells).collect::<Vec<_>>(),
        plain.iter().map(cells).collect::<Vec<_>>()
    );
    assert_eq!(
        (late[0].as_str(), late[116].as_str()),
        ("\"1\",\"×\",\"×\"", "\"117\",\"×\",\"×\"")
    );
    assert!(text(folder, "a/ae/A.txt").contains("Transform\tOpacity\n"));
    assert!(!text(folder, "plain/ae/A.txt").contains("Opacity"));
    let frames = |name: &str| {
        text(folder, name).lines().find(|line| line.starts_with("Frames:")).unwrap().to_owned()
    };
    assert_eq!(frames("a/limited.bvh"), "Frames: 130");
    assert_eq!(frames("plain/limited.bvh"), "Frames: 92");
    let sheet: Value = serde_json::from_str(&text(folder, "a/sheet.json")).unwrap();
    assert_eq!((&sheet["at"], &sheet["length"]), (&json!(25), &json!(130)));
    // The cut stays where it is, with another length now, until --fresh.
    let said = made(folder, "run kick.bvh --out a --length 120");
    assert!(said.contains("kept from a/recipe.toml (--fresh goes without): at 25"), "{said}");
    assert!(said.contains("koma 1 to 24 and 117 to 120 of 120"), "{said}");
    assert!(!made(folder, "run kick.bvh --out a --fresh").contains("blank  "));
}

#[test]
fn a_sheet_with_blank_koma_comes_back_from_another_program() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    made(folder, "run kick.bvh --deliver xdts --out a --at 25 --length 130");
    made(folder, "deliver a/kick_douga_ts.xdts kick.bvh --to json,columns --out back");
    let sheet = |name: &str| -> Value { serde_json::from_str(&text(folder, name)).unwrap() };
    let (there, back) = (sheet("a/sheet.json"), sheet("back/sheet.json"));
    assert_eq!(
        (&there["layers"], &back["at"], &back["length"]),
        (&back["layers"], &json!(25), &json!(130))
    );
    // Its marked keys are those of the take, whatever koma they stand on.
    let keys = |args: &str| -> Vec<String> {
        let table = made(folder, args);
        let rows = table.lines().filter(|row| row.starts_with("kick,A,"));
        rows.map(|row| row.split(',').nth(9).unwrap().to_owned()).collect()
    };
    let own = keys("--quiet keys kick.bvh");
    let marked = keys(
        "--quiet keys kick.bvh --at 25 --length 130 --pin-from a/kick_genga_ts.xdts --only-pins",
    );
    assert_eq!(marked.len(), own.len());
    // The sheet beside it knows its koma; without one they are those of this run.
    let beside = "--quiet keys kick.bvh --length 130 --pin-from a/kick_genga_ts.xdts --only-pins";
    assert_eq!(keys(beside), marked);
    fs::rename(folder.join("a/kick_genga_ts.xdts"), folder.join("kick_genga_ts.xdts")).unwrap();
    let said = refused(folder, "keys kick.bvh --length 130 --pin-from kick_genga_ts.xdts");
    assert!(said.contains("column A has a key on koma 94"), "{said}");
}

#[test]
fn what_does_not_fit_into_the_cut_is_refused_with_the_way_out() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    let said = refused(folder, "run kick.bvh --at 25 --length 100 --out a");
    let expected =
        "the drawings stand on koma 25 to 116, and the cut is to have 100: make it longer";
    assert!(said.contains(expected), "{said}");
    assert!(!folder.join("a").exists());
    for (args, words) in [
        (
            "run kick.bvh --at 0",
            "expected a number of koma, 1 or more, as in 25, or seconds and koma, as in 3+0; found \"0\"",
        ),
        ("run kick.bvh --length -3", "found \"-3\""),
        ("deliver kick.bvh kick.bvh --to sts --columns B", "--into"),
    ] {
        let said = refused(folder, args);
        assert!(said.contains(words), "{args}: {said}");
    }
}

#[test]
fn camera_work_of_a_recipe_is_on_every_sheet() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    let cue = "[[edits.camera]]\nframes = [12, 60]\ntext = \"PAN 右\"\n";
    fs::write(folder.join("r.toml"), cue).unwrap();
    made(folder, "run kick.bvh --recipe r.toml --deliver xdts,tdts,xsheet --out a --at 25");
    let sheet: Value = serde_json::from_str(&text(folder, "a/sheet.json")).unwrap();
    assert_eq!(sheet["camera"], json!([{ "begin": 37, "koma": 48, "words": "PAN 右" }]));
    let field = &timesheet(folder, "a/kick_genga_ts.xdts")["timeTables"][0]["fields"][1];
    assert_eq!(field["fieldId"], 5);
    let frames = field["tracks"][0]["frames"].as_array().unwrap();
    assert_eq!(
        (frames.len(), &frames[0]["frame"], &frames[0]["data"][0]["values"]),
        (48, &json!(36), &json!(["PAN 右"]))
    );
    assert!(
        text(folder, "a/kick.tdts").contains("PAN 右")
            && text(folder, "a/xsheet/0001.svg").contains("PAN 右")
    );
    let said = made(folder, "run kick.bvh --deliver json --out a");
    assert!(said.contains("camera 12..60"), "{said}");
    fs::write(folder.join("r.toml"), cue.replacen("60", "12", 1)).unwrap();
    let said = refused(folder, "run kick.bvh --recipe r.toml --out b");
    assert!(said.contains("the camera work 12..12 has no frame in it"), "{said}");
}

/// A timesheet as a director wrote it: a background, camera work and dialogue.
pub(crate) const DIRECTORS: &str = "exchangeDigitalTimeSheet Save Data\n{ \"timeTables\": [ { \"name\": \"c045\", \"duration\": 130,\n\
    \"timeTableHeaders\": [ { \"fieldId\": 0, \"names\": [ \"BG\", \"A\" ] }, { \"fieldId\": 5, \"names\": [ \"CAM\" ] } ],\n\
    \"fields\": [ { \"fieldId\": 5, \"tracks\": [ { \"trackNo\": 0, \"frames\": [\n\
    { \"frame\": 0, \"data\": [ { \"id\": 0, \"values\": [ \"PAN\" ] } ] } ] } ] },\n\
    { \"fieldId\": 0, \"tracks\": [ { \"trackNo\": 0, \"frames\": [\n\
    { \"frame\": 0, \"data\": [ { \"id\": 0, \"values\": [ \"1\" ] } ] } ] } ] } ] } ], \"version\": 5 }\n";

#[test]
fn columns_go_into_somebody_s_timesheet_and_all_else_of_it_stays() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    fs::write(folder.join("c045.xdts"), DIRECTORS).unwrap();
    made(folder, "run kick.bvh --out a --at 25");
    let said = made(folder, "deliver a/sheet.json kick.bvh --into c045.xdts --out out");
    for words in ["all drawings are numbered (CELL)", "column A in CELL is new", "out: c045.xdts"] {
        assert!(said.contains(words), "{words}: {said}");
    }
    assert_eq!(text(folder, "c045.xdts"), DIRECTORS);
    let put = text(folder, "out/c045.xdts");
    let track = put.find(",{\"frames\":").unwrap();
    let end = track + put[track..].find("\"trackNo\":1}").unwrap() + "\"trackNo\":1}".len();
    assert_eq!([&put[..track], &put[end..]].concat(), DIRECTORS);
    // Again, it has drawings there.
    let said = refused(folder, "deliver a/sheet.json kick.bvh --into out/c045.xdts --out b");
    assert!(said.contains("a column A with drawings: replace it with --replace"), "{said}");
    let said = made(
        folder,
        "deliver a/sheet.json kick.bvh --into out/c045.xdts --replace --as action --out b",
    );
    assert!(said.contains("column A in ACTION is replaced"), "{said}");
    assert!(text(folder, "b/c045.xdts").contains("SYMBOL_TICK_1"));
    let said =
        made(folder, "deliver a/sheet.json kick.bvh --into out/c045.xdts --columns KICK --out c");
    assert!(said.contains("column KICK in CELL is new"), "{said}");
    // It is written over the file itself only if that is said.
    let said = refused(folder, "deliver a/sheet.json kick.bvh --into c045.xdts --out .");
    assert!(said.contains("this is the timesheet itself; write elsewhere"), "{said}");
    assert_eq!(text(folder, "c045.xdts"), DIRECTORS);
    made(folder, "deliver a/sheet.json kick.bvh --into c045.xdts --out . --force");
    assert_eq!(text(folder, "c045.xdts"), put);
}

#[test]
fn a_timesheet_that_does_not_hold_the_rate_says_so() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    let said = made(folder, "run kick.bvh --set rate=30 --deliver xdts,tdts,sts,columns --out a");
    for format in ["xdts", "tdts", "sts"] {
        let note = format!("{format}: the file does not hold the rate of 30 koma a second");
        assert!(said.contains(&note), "{format}: {said}");
    }
    fs::write(folder.join("c045.xdts"), DIRECTORS).unwrap();
    let said = made(folder, "deliver a/sheet.json kick.bvh --into c045.xdts --out out");
    assert!(said.contains("into: the file does not hold the rate of 30 koma a second"), "{said}");
    assert!(!made(folder, "run kick.bvh --deliver xdts --out b").contains("W_RATE_UNSAID"));
}

#[test]
fn what_is_not_understood_of_a_timesheet_is_named() {
    let folder = place("kick.bvh");
    let folder = folder.path();
    made(folder, "run kick.bvh --out a");
    fs::write(folder.join("c045.xdts"), DIRECTORS.replacen("130", "92", 1)).unwrap();
    made(folder, "deliver a/sheet.json kick.bvh --into c045.xdts --out out");
    let said =
        made(folder, "deliver out/c045.xdts kick.bvh --drawings a/sheet.json --to sts --out back");
    let named =
        "of out/c045.xdts, not understood and passed over: CAMERA (camera work), first on koma 1";
    assert!(said.contains(named), "{said}");
    let said = made(folder, "keys kick.bvh --pin-from out/c045.xdts --pin-column A --out keys.csv");
    assert!(said.contains(named), "{said}");
}
