//! A new run into a folder keeps the numbers of the drawings that it shares with the sheet before.

use std::collections::BTreeMap;
use std::fs;

use genga::sheet::Number;

use crate::clips::with;
use crate::folders::all;
use crate::program::{Place, column, text};

/// The number of each drawing by its layer and the source frame that it shows, as the table of drawings has it.
pub(crate) fn numbers(place: &Place, folder: &str) -> BTreeMap<(String, String), String> {
    let table = text(&place.files(folder)["drawings.csv"]);
    let [layers, frames, numbers] =
        ["column", "source_frame", "drawing"].map(|name| column(&table, name));
    layers.into_iter().zip(frames).zip(numbers).collect()
}

/// Checks that the numbers of each layer ascend, and that those of the earlier sheet are still those of its drawings.
pub(crate) fn check(place: &Place, folder: &str, before: &BTreeMap<(String, String), String>) {
    let table = text(&place.files(folder)["drawings.csv"]);
    for series in ["drawing", "genga_no"] {
        let rows = column(&table, "column").into_iter().zip(column(&table, series));
        let numbers = rows.filter(|(_, number)| !number.is_empty());
        let numbers: Vec<(String, Number)> =
            numbers.map(|(layer, number)| (layer, number.parse().unwrap())).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{series}: {numbers:?}");
    }
    let now = numbers(place, folder);
    let stayed = before.iter().filter(|(drawing, _)| now.contains_key(drawing));
    let changed: Vec<_> =
        stayed.clone().filter(|(drawing, number)| now[drawing] != **number).collect();
    assert!(changed.is_empty() && stayed.count() > 1, "{changed:?}");
}

#[test]
fn drawings_that_stay_keep_their_numbers_and_a_table_tells_old_from_new() {
    let place = Place::new();
    let run = "run data/kick.bvh --deliver xdts,tdts,columns,glb --out a";
    place.done(run);
    let first = numbers(&place, "a");
    let second_said = place.said(&format!("{run} --pin 42:contact,55"));
    check(&place, "a", &first);
    let second = numbers(&place, "a");
    assert!(second.values().any(|number| number.ends_with('a')), "{second:?}");
    let table = text(&place.files("a")["numbers.csv"]);
    let (old, new) = (column(&table, "old"), column(&table, "new"));
    let both = || old.iter().zip(&new);
    let count = |is: fn(&(&String, &String)) -> bool| both().filter(is).count();
    let kept = count(|(old, new)| old == new);
    let (gone, came) = (count(|(_, new)| new.is_empty()), count(|(old, _)| old.is_empty()));
    assert_eq!((kept + gone, kept + came), (first.len(), second.len()));
    let gone = if gone > 0 { format!(", {gone} gone") } else { String::new() };
    let line = format!(
        "numbers     番号       {kept} kept{gone}, {came} new (numbers.csv has old and new; --renumber begins at 1)\n"
    );
    assert!(second_said.contains(&line) && second_said.contains(" numbers.csv "), "{second_said}");
    // The same run again changes nothing more but the table, where all are kept now.
    let before = place.files("a");
    place.done(run);
    let again = place.files("a");
    assert!(
        ["sheet.json", "drawings.csv", "kick.tdts"]
            .iter()
            .all(|file| again[*file] == before[*file])
    );
    let table = text(&again["numbers.csv"]);
    assert_eq!(column(&table, "old"), column(&table, "new"));
    // What is delivered from the sheet has its numbers, and a timesheet that comes back finds them.
    place.done("deliver a/sheet.json data/kick.bvh --to xdts,csv --out b");
    for file in ["kick_genga_ts.xdts", "kick_douga_ts.xdts", "drawings.csv"] {
        assert!(place.files("b")[file] == place.files("a")[file], "{file}");
    }
    place.done("deliver a/kick_douga_ts.xdts data/kick.bvh --to csv --out c");
    assert!(place.files("c")["drawings.csv"] == place.files("a")["drawings.csv"]);
    // Drawings that come back have their numbers again.
    place.done(&format!("{run} --forbid 42,55"));
    check(&place, "a", &second);
    check(&place, "a", &first);
}

#[test]
fn numbers_begin_at_1_again_on_request() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    place.done("run data/kick.bvh --pin 42,55 --out a");
    assert!(place.said("run data/kick.bvh --renumber --out a").contains(" changed"));
    place.done("run data/kick.bvh --pin 42,55 --out plain");
    assert_eq!(numbers(&place, "a"), numbers(&place, "plain"), "and the corrections stay");
    let table = text(&place.files("a")["numbers.csv"]);
    let both = column(&table, "old").into_iter().zip(column(&table, "new"));
    assert!(both.clone().any(|(old, new)| old.ends_with('a') && !new.ends_with('a')), "{table}");
    let quiet = place.said("run data/kick.bvh --out a");
    assert!(!quiet.contains("番号"), "{quiet}");
    assert_eq!(all(&place.path("a")), all(&place.path("plain")));
    place.done("run data/kick.bvh --keys 8 --out a");
    place.done("run data/kick.bvh --fresh --out a");
    place.done("run data/kick.bvh --out new");
    assert_eq!(all(&place.path("a")), all(&place.path("new")), "--fresh forgets numbers too");
}

#[test]
fn numbers_of_another_clip_or_other_layers_are_not_kept_and_that_is_said() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let other = place.said("run data/pitch.bvh --out a --force");
    assert!(
        other.contains(
            "note        drawings are numbered from 1: a/sheet.json is not known to be of this clip"
        ),
        "{other}"
    );
    let limbs = place.said("run data/pitch.bvh --layers limbs --out a");
    assert!(
        limbs.contains(
            "note        drawings of A are numbered from 1: the sheet before had other joints there"
        ),
        "{limbs}"
    );
    place.done("run data/pitch.bvh --layers limbs --out limbs");
    assert_eq!(numbers(&place, "a"), numbers(&place, "limbs"));
    let before = numbers(&place, "a");
    place.done("run data/pitch.bvh --layers limbs --pin B/40 --out a");
    check(&place, "a", &before);
}

#[test]
fn a_painted_picture_stays_that_of_its_drawing() {
    let place = Place::new();
    let run = "run data/kick.bvh --deliver images,cut --with images.width=160 --with images.height=90 --out a";
    place.done(run);
    let before = numbers(&place, "a");
    let last = before.values().filter_map(|number| number.parse::<usize>().ok()).max().unwrap();
    let picture = format!("images/A_{last:04}.png");
    let painted = [&fs::read(place.path("a").join(&picture)).unwrap()[..], b"mine"].concat();
    fs::write(place.path("a").join(&picture), &painted).unwrap();
    let said = place.said(&format!("{run} --pin 5"));
    let told = said.lines().find(|line| line.contains("painted, kept")).unwrap();
    assert!(told.ends_with(&picture), "{said}");
    check(&place, "a", &before);
    for number in numbers(&place, "a").values() {
        let number: Number = number.parse().unwrap();
        for folder in ["images", "kick/douga/A"] {
            let picture = place.path("a").join(folder).join(format!("A_{number:04}.png"));
            assert!(picture.is_file(), "{}", picture.display());
        }
    }
    let contents = fs::read_to_string(place.path("a/kick/cut.json")).unwrap();
    let now = numbers(&place, "a");
    let later = now.values().find(|number| number.ends_with('a')).unwrap();
    assert!(contents.contains(&format!("\"{later}\"")), "letters make a text: {contents}");
}

#[test]
fn numbers_of_real_clips_stay_through_corrections_and_settings() {
    with(["cmu-07_01-walk", "cmu-02_05-punch-strike"], |clips| {
        for clip in clips {
            let place = Place::new();
            let run = format!("run {} --out a", clip.display());
            place.done(&run);
            let mut before = numbers(&place, "a");
            for more in [
                "--pin 40,91",
                "--forbid 60..80",
                "--set spacing.on=3",
                "--set keys.min_price=12",
                "--trim 30..",
            ] {
                place.done(&format!("{run} {more}"));
                check(&place, "a", &before);
                before = numbers(&place, "a");
            }
        }
    });
}
