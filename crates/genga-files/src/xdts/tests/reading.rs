//! Deviations that the reader must tolerate, and input that it rejects.

use super::sheets::spelled;
use crate::xdts::{Exchange, read};
use genga::error::Error;

const SIGNATURE: &str = "exchangeDigitalTimeSheet Save Data";

/// A file of six koma with the given entries as (frame, value).
fn file(entries: &[(i64, &str)]) -> String {
    let entries: Vec<_> = entries
        .iter()
        .map(|(frame, value)| {
            format!(r#"{{"data":[{{"id":0,"values":["{value}"]}}],"frame":{frame}}}"#)
        })
        .collect();
    format!(
        r#"{SIGNATURE}
{{"timeTables":[{{"duration":6,"fields":[{{"fieldId":0,"tracks":[{{"frames":[{}],"trackNo":0}}]}}],"name":"c1","timeTableHeaders":[{{"fieldId":0,"names":["A"]}}]}}],"version":5}}"#,
        entries.join(",\n")
    )
}

fn koma(file: &str) -> String {
    let read = read(file.as_bytes()).unwrap();
    spelled(&read.columns[0], read.length)
}

const PLAIN: [(i64, &str); 4] = [(0, "1"), (2, "SYMBOL_TICK_1"), (4, "2"), (6, "SYMBOL_NULL_CELL")];
const PLAIN_KOMA: &str = "1 1 1o 1 2 2";

#[test]
fn line_ends_and_a_byte_order_mark_do_not_matter() {
    let plain = file(&PLAIN);
    for file in [
        plain.clone(),
        plain.replace('\n', "\r\n"),
        plain.replacen('\n', "", 1),
        format!("\u{feff}{plain}"),
        format!("{plain}\n\n"),
    ] {
        assert_eq!(koma(&file), PLAIN_KOMA, "{file}");
    }
}

#[test]
fn entries_come_in_any_order() {
    let mut turned = PLAIN;
    turned.reverse();
    assert_eq!(koma(&file(&turned)), PLAIN_KOMA);
}

#[test]
fn the_last_entry_before_the_cut_stands_on_its_first_koma() {
    assert_eq!(koma(&file(&[(-9, "7"), (-3, "1"), (4, "2")])), "1 1 1 1 2 2");
    assert_eq!(koma(&file(&[(-3, "7"), (0, "1"), (4, "2")])), "1 1 1 1 2 2");
}

#[test]
fn the_end_may_be_missing_or_far_away() {
    for end in [&PLAIN[..3], &[&PLAIN[..3], &[(120, "SYMBOL_NULL_CELL")]].concat()] {
        assert_eq!(koma(&file(end)), PLAIN_KOMA);
    }
    assert_eq!(koma(&file(&[(0, "1"), (3, "SYMBOL_NULL_CELL")])), "1 1 1 x x x");
    assert_eq!(koma(&file(&[(2, "1")])), "x x 1 1 1 1", "nothing before the first entry");
    assert_eq!(koma(&file(&[])), "x x x x x x");
}

#[test]
fn what_is_written_out_koma_by_koma_is_a_hold() {
    let every = [(0, "1"), (1, "1"), (2, "SYMBOL_HYPHEN"), (3, "1"), (4, "12a"), (5, "12a")];
    let read = read(file(&every).as_bytes()).unwrap();
    assert_eq!(spelled(&read.columns[0], 6), "1 1 1 1 12a 12a");
    assert_eq!(read.columns[0].changes.len(), 2);
    assert_eq!(koma(&file(&[(0, "1"), (3, "2"), (3, "4")])), "1 1 1 4 4 4", "the later one");
}

#[test]
fn unknown_members_and_fields_are_passed_over() {
    let douga = r#"{"data":[{"id":0,"values":["9"]}],"frame":0}"#;
    let douga = format!(r#"{{"fieldId":4,"tracks":[{{"frames":[{douga}],"trackNo":0}}]}}"#);
    let odd = file(&PLAIN)
        .replace(r#""duration":6"#, r#""frameRate":24,"duration":6,"color":0"#)
        .replace(r#""version":5"#, r#""subversion":"p1","version":10"#)
        .replace(r#"[{"fieldId":0,"tracks""#, &format!(r#"[{douga},{{"fieldId":0,"tracks""#));
    assert_eq!(koma(&odd), PLAIN_KOMA);
    let without_names = file(&PLAIN).replace(r#"[{"fieldId":0,"names":["A"]}]"#, "[]");
    assert_eq!(read(without_names.as_bytes()).unwrap().columns[0].name, "A");
}

#[test]
fn tdts_is_read_from_its_action_column() {
    let signature = "toeiDigitalTimeSheet Save Data";
    let old = file(&PLAIN).replace(SIGNATURE, signature);
    assert_eq!(koma(&old), PLAIN_KOMA);
    let (_, json) = old.split_once('\n').unwrap();
    let new = format!("{signature}\n{{\"timeSheets\":[{json}],\"version\":11}}");
    assert_eq!(koma(&new), PLAIN_KOMA);
}

fn refused(file: &[u8]) -> (usize, usize, String) {
    match read(file) {
        Err(Error::Sheet { place: Some((line, column)), message, .. }) => (line, column, message),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_wrong_signature_names_both_right_ones() {
    for wrong in ["", "{}", "HIERARCHY\nROOT Hips", "exchangeDigitalTimesheet Save Data\n{}"] {
        let (line, column, message) = refused(wrong.as_bytes());
        assert_eq!((line, column), (1, 1));
        for signature in [SIGNATURE, "toeiDigitalTimeSheet Save Data", "export the sheet as XDTS"] {
            assert!(message.contains(signature), "{message}");
        }
        assert!(message.contains(&format!("found \"{}\"", wrong.lines().next().unwrap_or(""))));
    }
}

#[test]
fn what_is_wrong_is_shown_by_line_and_column() {
    let plain = file(&PLAIN);
    let broken = |from: &str, to: &str| refused(plain.replacen(from, to, 1).as_bytes());
    let at = |from: &str, after: usize| {
        let before = &plain[..plain.find(from).unwrap() + after];
        (before.matches('\n').count() + 1, before.len() - before.rfind('\n').unwrap() - 1)
    };
    let (line, column, message) = broken(r#""frame":2"#, r#""frame":x"#);
    assert_eq!((line, column), at(r#""frame":2"#, r#""frame":2"#.len()));
    assert!(message.starts_with("expected value; "), "{message}");
    let (line, _, message) = broken(r#""frame":4"#, r#""fame":4"#);
    assert_eq!(line, 4);
    assert!(message.starts_with("missing field `frame`; "), "{message}");
    let (line, _, message) = broken(r#"["SYMBOL_TICK_1"]"#, "[]");
    assert_eq!(line, 3);
    assert!(message.starts_with("an entry needs a value, and this list is empty; "), "{message}");
    for wrong in ["0", "-6", "1000001"] {
        let (line, _, message) = broken(r#""duration":6"#, &format!(r#""duration":{wrong}"#));
        assert_eq!(line, 2);
        assert!(message.contains(&format!("this one is {wrong}")), "{message}");
    }
    let (line, column, _) = refused(format!("{SIGNATURE}{{").as_bytes());
    assert_eq!((line, column), (1, SIGNATURE.len() + 1));
    assert!(refused(format!("{SIGNATURE}\n{{\"version\":5}}").as_bytes()).2.contains("timeTables"));
    let (line, column, message) =
        refused(b"exchangeDigitalTimeSheet Save Data\n{\"a\":\"\x83\x41\"}");
    assert_eq!((line, column), (2, 7));
    assert!(message.contains("UTF-8"), "{message}");
}

#[test]
fn many_columns_come_by_track() {
    let track = |number: usize| format!(r#"{{"frames":[],"trackNo":{number}}}"#);
    let file = format!(
        r#"{SIGNATURE}{{"timeTables":[{{"duration":1,"fields":[{{"fieldId":0,"tracks":[{},{}]}}],"name":"","timeTableHeaders":[{{"fieldId":3,"names":["no"]}},{{"fieldId":0,"names":["A"]}}]}}],"version":5}}"#,
        track(27),
        track(0)
    );
    let Exchange { columns, name, cut, .. } = read(file.as_bytes()).unwrap();
    let columns: Vec<_> = columns.iter().map(|column| (column.track, &*column.name)).collect();
    assert_eq!(columns, [(0, "A"), (27, "AB")]);
    assert_eq!((&*name, cut), ("", None));
}
