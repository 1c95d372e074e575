//! The cut of 24 koma as both files, member by member as in the format's description.

use serde_json::Value;

use super::sheets::{cut_of_24, spelled};
use crate::xdts::{Xdts, read};
use genga::sheet::Sheet;
use genga::slate::Slate;

const GENGA: &str = include_str!("genga.xdts");

/// The example with a line of dialogue that a person added.
const DOUGA: &str = include_str!("douga.xdts");

const GENGA_KOMA: &str = "1 1 1 1 1 1 1o 1 1o 1 2 2 2 3 3 3 3o 3 3 4 4 4 4 4";
const DOUGA_KOMA: &str = "1 1 1 1 1 1 2 2 3 3 4 4 4 5 5 5 6 6 6 7 7 7 7 7";

fn json(file: &str) -> Value {
    serde_json::from_str(file.split_once('\n').unwrap().1).unwrap()
}

/// The file reduced to its cels.
fn cels_alone(file: &str) -> Value {
    let mut file = json(file);
    for list in ["fields", "timeTableHeaders"] {
        let items = file["timeTables"][0][list].as_array_mut().unwrap();
        items.retain(|item| item["fieldId"] == 0);
    }
    file
}

#[test]
fn both_examples_are_made_again_from_their_sheet() {
    let slate = Slate::from_name("s1_c1");
    let made = Xdts::default().write(&Sheet { slate, ..cut_of_24() }, "c001").unwrap();
    assert_eq!(json(&made.genga), json(GENGA));
    assert_eq!(json(&made.douga), cels_alone(DOUGA));
}

#[test]
fn both_examples_read_koma_by_koma_as_their_page_says() {
    for (file, koma) in [(GENGA, GENGA_KOMA), (DOUGA, DOUGA_KOMA)] {
        let read = read(file.as_bytes()).unwrap();
        assert_eq!((read.length, read.columns.len()), (24, 1));
        assert_eq!((read.cut.as_deref(), read.scene.as_deref()), (Some("1"), Some("1")));
        assert_eq!(spelled(&read.columns[0], read.length), koma);
    }
}

#[test]
fn circled_keys_are_marked_in_the_douga_file_when_asked_for() {
    let plain = Xdts::default().write(&cut_of_24(), "c001").unwrap();
    let made = Xdts { circled: true }.write(&cut_of_24(), "c001").unwrap();
    assert_eq!(made.genga, plain.genga);
    let file = json(&made.douga);
    assert_eq!(file["subversion"], "p1");
    let frames = file["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array().unwrap();
    let circled = frames
        .iter()
        .filter(|entry| entry["data"][0]["options"] == serde_json::json!(["OPTION_KEYFRAME"]));
    let circled: Vec<_> = circled.map(|entry| entry["frame"].as_u64().unwrap()).collect();
    assert_eq!(circled, [0, 10, 13, 19]);
    assert!(!plain.douga.contains("OPTION") && !plain.douga.contains("subversion"));
}
