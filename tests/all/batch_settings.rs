//! A clip is done again if its settings change, and not if they are only spelled in another way.

use std::fs;

use crate::batch::{code, results};
use crate::program::{Place, column, text};

/// The digest of the settings in the summary of a batch, after it is repeated, and whether the clip was done again.
fn after(place: &Place, args: &str) -> (String, bool) {
    let sheet = place.path("out/clips/kick.bvh/sheet.json");
    let made = || fs::metadata(&sheet).and_then(|about| about.modified()).ok();
    let before = made();
    place.done(&format!("batch data/kick.bvh --out out {args}"));
    let digests = column(&text(&results(place, "out")["summary.csv"]), "recipe");
    (digests[0].clone(), made() != before)
}

#[test]
fn a_digest_is_of_settings_and_not_of_how_their_files_are_called() {
    let place = Place::new();
    fs::create_dir_all(place.path("repo/deep")).unwrap();
    fs::write(place.path("repo/house.toml"), "[spacing]\non = 3\n").unwrap();
    fs::copy(place.path("repo/house.toml"), place.path("repo/deep/own.toml")).unwrap();
    place.done("run data/kick.bvh --out first");
    fs::create_dir(place.path("other")).unwrap();
    fs::copy(place.path("first/sheet.json"), place.path("other/sheet.json")).unwrap();
    fs::copy(place.path("first/keys.csv"), place.path("other/marked.csv")).unwrap();
    for spelled in [
        &[
            "--recipe repo/house.toml",
            "--recipe ./repo/house.toml",
            "--recipe repo/deep/own.toml",
            "--set spacing.on=3",
            "--set spacing.on=3 --memory 4",
            "--set spacing.on=3 --force",
        ][..],
        &["--freeze first", "--freeze first/sheet.json", "--freeze other/sheet.json"],
        &["--pin-from first/keys.csv", "--pin-from other/marked.csv"],
        &["--pin 55", "--pin 55 --deliver json"],
    ] {
        let (first, is_done) = after(&place, spelled[0]);
        assert!(is_done, "{}", spelled[0]);
        for other in &spelled[1..] {
            assert_eq!(after(&place, other), (first.clone(), false), "{other}");
        }
    }
}

#[test]
fn a_digest_sees_what_changes_results() {
    let place = Place::new();
    place.done("run data/kick.bvh --out first");
    let mut seen = Vec::new();
    let mut is_new = |args: &str| {
        let (digest, is_done) = after(&place, args);
        assert!(is_done && !seen.contains(&digest), "{args}");
        seen.push(digest);
    };
    is_new("");
    for args in [
        "--trim 0..80",
        "--fps 30",
        "--keys 12",
        "--max-error 5%",
        "--drawings-per-second 8",
        "--seen-from side",
        "--keep-glitches",
        "--up z",
        "--pin 55",
        "--title Kick",
        "--deliver json,strip --with strip.width=900",
        "--freeze first",
    ] {
        is_new(args);
    }
    // Another sheet in the same folder.
    place.done("run data/kick.bvh --out first --set keys.min_price=30 --force");
    is_new("--freeze first");
}

#[test]
fn parts_of_different_settings_are_not_joined() {
    let place = Place::new();
    let batch = "batch data/kick.bvh data/pitch.bvh --out out --shard";
    fs::write(place.path("house.toml"), "[spacing]\non = 3\n").unwrap();
    place.done(&format!("{batch} 1/2 --recipe house.toml"));
    place.done(&format!("{batch} 2/2"));
    let said = place.refused(2, "batch --join out --out out");
    assert!(said.contains("part 2 of 2 was done with other settings than part 1"), "{said}");
    assert!(!place.path("out/summary.csv").exists());
    place.done(&format!("{batch} 2/2 --recipe ./house.toml"));
    let (exit, said) = code(&place, "batch --join out --out out");
    assert_eq!(exit, 0, "{said}");
}

#[test]
fn corrections_of_frames_in_a_recipe_are_of_one_clip() {
    let place = Place::new();
    place.done("run data/kick.bvh --pin 42:contact --forbid 50 --cut 12 --out a");
    let said =
        place.refused(2, "batch data/kick.bvh data/pitch.bvh --recipe a/recipe.toml --out b");
    assert!(said.contains("a/recipe.toml: has corrections of frames"), "{said}");
    assert!(said.contains("2 clips are to have them: pin 42, forbid 50; "), "{said}");
    assert!(!place.path("b").exists());
    // One clip, however often, has them, and so has each clip that a table names them for.
    place.done("batch data/kick.bvh data/kick.bvh --recipe a/recipe.toml --out b");
    let table = "clip,recipe\ndata/kick.bvh,a/recipe.toml\ndata/pitch.bvh,\n";
    let (exit, said) = of_table(&place, "t.csv", table);
    assert_eq!(exit, 0, "{said}");
    place.done("run data/kick.bvh --cut 12 --set spacing.on=3 --out slate");
    place.done("batch data/kick.bvh data/pitch.bvh --recipe slate/recipe.toml --out c");
}

#[test]
fn corrections_of_frames_on_the_command_line_are_of_one_clip() {
    let place = Place::new();
    place.done("run data/kick.bvh --out first");
    for (given, column) in [
        ("--pin 12,40:hit", "pin"),
        ("--forbid 50", "forbid"),
        ("--move 41:42", "move"),
        ("--hold 42:4", "hold"),
        ("--split 30", "split"),
        ("--say 10..20:a", "say"),
        ("--pin-from first/keys.csv", "pin-from"),
        ("--freeze first", "freeze"),
    ] {
        let said = place.refused(2, &format!("batch data/kick.bvh data/pitch.bvh {given} --out b"));
        assert!(
            said.contains(&format!("{given}: is of the frames of one clip, and 2 clips")),
            "{said}"
        );
        assert!(said.contains(&format!("a table with a column {column}")), "{said}");
        assert!(!place.path("b").exists());
    }
    // A clip with a pin of its own does not take that of all; switches and the slate are of every clip.
    place.done("batch data/kick.bvh data/kick.bvh --pin 42 --out b");
    let data = crate::clips::here("data").to_string_lossy().into_owned();
    let table = format!("clip,pin\n{data}/kick.bvh,\n{data}/pitch.bvh,30\n");
    fs::write(place.path("pins.csv"), table).unwrap();
    place.done("batch @pins.csv --pin 42 --out c");
    place.done("batch data/kick.bvh data/pitch.bvh --cut 12 --again --out d");
}

/// Runs a batch of a table, `data/` in which is the repository's.
fn of_table(place: &Place, name: &str, table: &str) -> (i32, String) {
    let data = crate::clips::here("data").to_string_lossy().into_owned() + "/";
    fs::write(place.path(name), table.replace("data/", &data)).unwrap();
    fs::remove_dir_all(place.path("out")).ok();
    code(place, &format!("batch @{name} --out out"))
}

fn sheet(place: &Place) -> Vec<u8> {
    fs::read(place.path("out/clips/kick.bvh/sheet.json")).unwrap()
}

#[test]
fn a_table_may_have_semicolons_and_its_switches_yes_and_no() {
    let place = Place::new();
    assert_eq!(of_table(&place, "a.csv", "clip,trim\ndata/kick.bvh,0..60\n").0, 0);
    let trimmed = sheet(&place);
    let (exit, said) =
        of_table(&place, "b.csv", "clip;trim;set.spacing.on\n data/kick.bvh ;0..60;\n");
    assert!(exit == 0 && sheet(&place) == trimmed, "{said}");
    assert_eq!(of_table(&place, "c.csv", "clip,pin\ndata/kick.bvh,30\n").0, 0);
    let pinned = sheet(&place);
    for (word, is_on) in [("no", false), ("FALSE", false), ("0", false), ("Yes", true)] {
        let table = format!("clip,strict,only-pins,pin\ndata/kick.bvh,{word},{word},30\n");
        let (exit, said) = of_table(&place, "c.csv", &table);
        assert_eq!(exit, 0, "{word}: {said}");
        assert_eq!(sheet(&place) != pinned, is_on, "{word}");
    }
    let (exit, said) =
        of_table(&place, "c.csv", "clip,keep-lead-in\ndata/pitch.bvh,\ndata/kick.bvh,maybe\n");
    assert_eq!(exit, 2, "{said}");
    assert!(said.contains("c.csv:3: ") && said.contains("kick.bvh: keep-lead-in: "), "{said}");
    assert!(said.contains("expected yes or no, found \"maybe\""), "{said}");
}

#[test]
fn an_option_of_the_whole_batch_is_no_column_and_it_is_said() {
    let place = Place::new();
    for option in ["deliver", "jobs", "shard"] {
        let (exit, said) = of_table(&place, "t.csv", &format!("clip,{option}\ndata/kick.bvh,1\n"));
        let says = format!("{option}: is an option of the whole batch, not of a clip: --{option}");
        assert!(exit == 2 && said.contains(&says), "{said}");
    }
}

#[test]
fn a_column_that_is_no_option_is_found_before_any_work() {
    let place = Place::new();
    for (name, table, wanted) in [
        ("t.csv", "clip,trimm\ndata/kick.bvh,0..60\n", "t.csv:1: trimm: "),
        ("t.csv", "clip,trimm\ndata/kick.bvh,\n", "t.csv:1: trimm: "),
        ("t.csv", "clip,set.spacing.onn\ndata/kick.bvh,3\n", "t.csv:1: set.spacing.onn: "),
        (
            "t.jsonl",
            "{\"clip\":\"data/kick.bvh\"}\n{\"clip\":\"data/kick.bvh\",\"trimm\":1}\n",
            "t.jsonl:2: ",
        ),
    ] {
        let (exit, said) = of_table(&place, name, table);
        assert_eq!(exit, 2, "{said}");
        let meant = if wanted.contains("set.") { "spacing.on?" } else { "trim?" };
        assert!(said.contains(wanted) && said.contains(&format!("did you mean {meant}")), "{said}");
        assert!(!place.path("out").exists(), "{said}");
    }
    let (exit, said) = of_table(&place, "t.csv", "path,trim\ndata/kick.bvh,0..60\n");
    assert!(exit == 2 && said.contains("t.csv:1: ") && said.contains("column clip"), "{said}");
}

#[test]
fn a_wrong_value_of_a_table_names_its_line_its_clip_and_its_column() {
    let place = Place::new();
    for (table, column) in [
        ("clip,trim\ndata/pitch.bvh,\ndata/kick.bvh,x..y\n", "trim"),
        ("clip,set.spacing.on\ndata/pitch.bvh,\ndata/kick.bvh,x\n", "spacing.on"),
        ("clip,pin\ndata/pitch.bvh,\ndata/kick.bvh,x\n", "pin"),
    ] {
        let (exit, said) = of_table(&place, "t.csv", table);
        assert_eq!(exit, 1, "{said}");
        assert!(said.contains("1 of 2 failed: t.csv:3: "), "{said}");
        assert!(said.contains("kick.bvh: ") && said.contains(column), "{said}");
    }
}

#[test]
fn settings_of_an_object_are_an_object() {
    let place = Place::new();
    place.done("run data/kick.bvh --set spacing.on=3 --set seen_from=side --out one");
    let wanted = &place.files("one")["sheet.json"];
    for settings in [
        "\"set\":{\"spacing.on\":3,\"seen_from\":\"side\"}",
        "\"set\":{\"spacing\":{\"on\":3},\"seen_from\":\"side\"}",
        "\"set.spacing.on\":3,\"set\":\"seen_from=side\"",
    ] {
        let line = format!("{{\"clip\":\"data/kick.bvh\",{settings}}}\n");
        let (exit, said) = of_table(&place, "t.jsonl", &line);
        assert_eq!(exit, 0, "{said}");
        assert!(sheet(&place) == *wanted, "{settings}");
    }
}
