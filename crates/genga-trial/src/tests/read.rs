//! Files that are not answers.

use super::made::file;
use crate::{Answer, Crowd};

fn whole() -> String {
    file(1, &Crowd { scores: super::WORTH.into(), spread: 0.0, pairs: 4 }.answers(1, 1)[0])
}

#[test]
fn a_file_with_a_mark_at_its_beginning_and_other_columns_is_read() {
    let plain = Answer::read(whole().as_bytes()).unwrap();
    assert_eq!(plain.len(), 14);
    assert_eq!(plain.iter().filter(|answer| answer.is_catch()).count(), 6);
    assert!(plain.iter().all(|answer| !answer.is_caught()));
    let marked = format!("\u{feff}{}", whole());
    assert_eq!(Answer::read(marked.as_bytes()).unwrap(), plain);
    // A spreadsheet to which a note column was added.
    let noted: String = whole().lines().map(|line| format!("note,{line}\r\n")).collect();
    assert_eq!(Answer::read(noted.as_bytes()).unwrap(), plain);
}

#[test]
fn what_is_wrong_is_said_with_its_line() {
    for (from, to, said) in [
        ("genga-trial-1,t1", "genga-trial-9,t1", "line 2: schema: expected genga-trial-1"),
        (
            ",draws,en,60,",
            ",draws,en,fast,",
            "line 2: hz: expected refreshes a second, found \"fast\"",
        ),
        (",en,60,0,", ",en,60,-1,", "line 2: slow: expected a share"),
        (",en,60,0,", ",en,inf,0,", "line 2: hz: expected refreshes"),
        (",14,1,anime", ",14,0,anime", "line 2: number: expected 1 to 14, found 0"),
        (",14,1,anime", ",14,15,anime", "line 2: number: expected 1 to 14, found 15"),
        (",anime,", ",beauty,", "line 2: question: expected anime or use, found \"beauty\""),
        (",second,0,", ",both,0,", "line 2: chosen: expected first or second, found \"both\""),
        (",184,0,24", ",184,185,24", "line 2: dropped: expected 184 at the most"),
        (",184,0,24", "", "line 2: koma: the row ends before it"),
        ("chosen,", "taken,", "line 1: there is no column chosen"),
        (",00000001,", ",,", "line 2: person: nothing stands there"),
    ] {
        let wrong = whole().replacen(from, to, 1);
        assert_ne!(wrong, whole(), "{from}");
        let error = Answer::read(wrong.as_bytes()).unwrap_err().to_string();
        assert!(error.starts_with(said), "{error}");
    }
    let header = whole().lines().next().unwrap().to_owned();
    let none = Answer::read(header.as_bytes()).unwrap_err().to_string();
    assert!(none.starts_with("there is no answer in it"), "{none}");
    assert!(Answer::read(b"\xff\xfe\x00").is_err() && Answer::read(b"").is_err());
}

#[test]
fn a_film_is_no_pair_with_itself() {
    let line = whole().lines().nth(1).unwrap().to_owned();
    let cells: Vec<&str> = line.split(',').collect();
    let mut same = cells.clone();
    same[13] = cells[12];
    let text = format!("{}\n{}\n", whole().lines().next().unwrap(), same.join(","));
    let error = Answer::read(text.as_bytes()).unwrap_err().to_string();
    assert!(error.starts_with("line 2: second: expected another film"), "{error}");
}
