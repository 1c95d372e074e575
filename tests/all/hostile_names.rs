//! Names of joints, cuts and files that a spreadsheet would run or a terminal would obey.

use std::fs;
use std::path::{Path, PathBuf};

use crate::program::Place;

const RUN: &str = "=cmd|'/C-calc'!A0";
const TURNED: &str = "+\u{202e}gnorts\u{1b}[2J";

/// The kick with two joints of such names, in a file of such a name.
fn clip(place: &Place) -> String {
    let kick = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("data/kick.bvh"));
    let text = kick.unwrap().replace("JOINT LeftArm\n", &format!("JOINT {RUN}\n"));
    let text = text.replace("JOINT RightArm\n", &format!("JOINT {TURNED}\n"));
    assert!(text.contains(RUN) && text.contains(TURNED));
    let name = "=1+1\u{202e}.bvh";
    fs::write(place.path(name), text).unwrap();
    name.into()
}

fn is_hidden(letter: char) -> bool {
    letter != '\n' && (letter.is_control() || ('\u{202a}'..='\u{202e}').contains(&letter))
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect()
}

#[test]
fn tables_hold_no_formula_and_names_of_files_nothing_hidden() {
    let place = Place::new();
    let clip = clip(&place);
    let out = place.genga(&format!("run {clip} --deliver all --out a"));
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    place.genga(&format!("keys {clip} --per-joint --out a/joints.csv"));
    place.genga(&format!("batch {clip} --out a/library --deliver csv"));
    assert!(place.path("a/library/summary.csv").is_file());
    let files = files(&place.path("a"));
    assert!(files.iter().all(|file| !file.to_str().unwrap().contains(is_hidden)));
    let (mut tables, mut named) = (0, 0);
    for file in files.iter().filter(|file| file.extension().is_some_and(|ending| ending == "csv")) {
        let text = fs::read_to_string(file).unwrap();
        assert!(!text.contains(is_hidden), "{}", file.display());
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        for record in reader.records() {
            for cell in record.unwrap().iter() {
                let is_safe =
                    !cell.starts_with(['=', '+', '-', '@']) || cell.parse::<f64>().is_ok();
                assert!(is_safe, "{}: {cell}", file.display());
                named += usize::from(cell.contains("calc") || cell.contains("\\u{202e}gnorts"));
            }
        }
        tables += 1;
    }
    assert!(tables >= 5 && named >= 2, "{tables} {named}");
}

#[test]
fn a_terminal_is_told_nothing_hidden() {
    let place = Place::new();
    let clip = clip(&place);
    for args in [
        "inspect",
        "run --split",
        "split --at 40",
        "keys --set turns.nothing=1",
        "keys --root nobody",
    ] {
        let (command, rest) = args.split_once(' ').unwrap_or((args, ""));
        let out = place.genga(&format!("{command} {clip} {rest}"));
        for said in [&out.stdout, &out.stderr] {
            let said = String::from_utf8_lossy(said);
            assert!(!said.contains(is_hidden), "{args}: {said:?}");
        }
        assert!(!out.stdout.is_empty() || !out.stderr.is_empty());
    }
    let inspected = String::from_utf8(place.genga(&format!("inspect {clip}")).stdout).unwrap();
    assert!(inspected.contains("\\u{202e}gnorts\\u{1b}[2J"), "{inspected}");
}
