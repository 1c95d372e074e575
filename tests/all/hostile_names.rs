//! Names of joints, cuts and files that a spreadsheet would run as a formula or a terminal would obey.

use std::fs;

use crate::clips::here;
use crate::folders::all;
use crate::program::{Place, text};

const RUN: &str = "=cmd|'/C-calc'!A0";
const TURNED: &str = "+\u{202e}gnorts\u{1b}[2J";

/// The kick with two joints of hostile names, in a file with one.
fn clip(place: &Place) -> String {
    let kick = fs::read_to_string(here("data/kick.bvh")).unwrap();
    let text = kick.replace("JOINT LeftArm\n", &format!("JOINT {RUN}\n"));
    let text = text.replace("JOINT RightArm\n", &format!("JOINT {TURNED}\n"));
    assert!(text.contains(RUN) && text.contains(TURNED));
    let name = "=1+1\u{202e}.bvh";
    fs::write(place.path(name), text).unwrap();
    name.into()
}

fn is_hidden(letter: char) -> bool {
    letter != '\n' && (letter.is_control() || ('\u{202a}'..='\u{202e}').contains(&letter))
}

#[test]
fn tables_hold_no_formula_and_names_of_files_nothing_hidden() {
    let place = Place::new();
    let clip = clip(&place);
    let out = place.genga(&format!("run {clip} --trim 0..12 --deliver all --out a"));
    assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
    place.genga(&format!("keys {clip} --per-joint --out a/joints.csv"));
    place.genga(&format!("batch {clip} --out a/library --deliver csv"));
    assert!(place.path("a/library/summary.csv").is_file());
    let files = all(&place.path("a"));
    assert!(files.keys().all(|file| !file.contains(is_hidden)));
    let (mut tables, mut named) = (0, 0);
    for (file, bytes) in files.iter().filter(|(file, _)| file.ends_with(".csv")) {
        let text = text(bytes);
        assert!(!text.contains(is_hidden), "{file}");
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        for record in reader.records() {
            for cell in record.unwrap().iter() {
                let is_safe =
                    !cell.starts_with(['=', '+', '-', '@']) || cell.parse::<f64>().is_ok();
                assert!(is_safe, "{file}: {cell}");
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
