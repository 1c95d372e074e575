//! What a person wants, through the program: targets, pins, forbidden and moved keys, joint weights.

use std::fs;

use crate::program::{Place, column, text};

/// Rows of a key table that are genga.
fn genga(table: &str) -> usize {
    column(table, "role").iter().filter(|role| *role == "genga").count()
}

fn report(place: &Place, folder: &str) -> serde_json::Value {
    let bytes = fs::read(place.path(&format!("{folder}/report.json"))).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

#[test]
fn as_many_genga_and_drawings_as_asked_for() {
    let place = Place::new();
    let said = place.genga("run data/kick.bvh --out a --keys 12 --drawings-per-second 6");
    assert!(said.status.success());
    let said = text(&said.stderr);
    assert!(said.contains("found       keys.min_price="), "{said}");
    assert!(
        said.contains("12 and both ends") && said.contains(", 23 drawings, 6.0 a second"),
        "{said}"
    );
    assert_eq!(report(&place, "a")["notes"], serde_json::json!([]));
    assert_eq!(genga(&place.done("keys data/kick.bvh --keys 12")), 12);
}

#[test]
fn the_recipe_of_a_target_gives_the_same_bytes_without_it() {
    let place = Place::new();
    for targets in ["--keys 24", "--drawings-per-second 10.5", "--keys 7 --drawings-per-second 4"] {
        place.done(&format!("run data/tennis.bvh --out a {targets}"));
        place.done("run data/tennis.bvh --out b --recipe a/recipe.toml");
        let (a, b) = (place.files("a"), place.files("b"));
        assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
        for (file, bytes) in a {
            assert!(b[&file] == bytes, "{targets}: {file} came out different");
        }
    }
}

#[test]
fn what_could_not_be_met_is_a_note() {
    let place = Place::new();
    let said = text(&place.genga("run data/kick.bvh --out a --keys 900 --pin 42").stderr);
    let note = "900 genga were asked for, and there are ";
    assert!(said.contains(&format!("note        {note}")), "{said}");
    let notes = report(&place, "a")["notes"].clone();
    assert!(notes[0].as_str().unwrap().starts_with(note), "{notes}");
    let said = text(&place.genga("keys data/kick.bvh --keys 900").stderr);
    assert!(said.starts_with("found       ") && said.contains(&format!("\n{note}")), "{said}");
}

#[test]
fn a_target_that_can_never_be_met_is_refused_before_the_work() {
    let place = Place::new();
    for (args, wanted) in [
        (
            "run data/kick.bvh --drawings-per-second 25",
            "--drawings-per-second: must be above 0 and at most 24",
        ),
        ("run data/kick.bvh --drawings-per-second 0", "--drawings-per-second: must be above 0"),
        ("run data/kick.bvh --drawings-per-second nan", "--drawings-per-second: must be above 0"),
        ("keys data/kick.bvh --keys=-1", "--keys"),
        ("keys data/kick.bvh --keys many", "--keys"),
        ("keys data/kick.bvh --keys 3 --keys 4", "--keys"),
        ("keys data/kick.bvh --keys 3 --per-joint", "--per-joint"),
        ("keys data/kick.bvh --keys 3 --set keys.rest=-1", "keys.rest: must be"),
    ] {
        let said = place.refused(2, args);
        assert!(said.contains(wanted), "{args}: {said}");
        assert!(!place.path("kick-genga").exists(), "{args}");
    }
}
