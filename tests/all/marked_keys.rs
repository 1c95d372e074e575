//! Files with marked keys that come back: unedited they change nothing, and another key changes its neighbourhood.

use std::fs;

use crate::clips::with;
use crate::program::{Place, column, text};

/// Recipes, with the columns of their sheets that are given back.
const RECIPES: [(&str, &[&str]); 7] = [
    ("", &["A"]),
    ("--set spacing.on=1", &["A"]),
    ("--set spacing.on=3", &["A"]),
    ("--set omission.koma_dori=30% --set keys.merge=union", &["A"]),
    ("--layers limbs", &["A", "C"]),
    ("--keys 9", &["A"]),
    ("--at 25 --length 400 --hold 0:3", &["A"]),
];

/// Files of a run that keys are marked in.
fn marked_files(place: &Place) -> Vec<String> {
    let files = place.files("a").into_keys();
    let is_marked = |file: &String| {
        file.ends_with("_genga_ts.xdts")
            || ["keys.csv", "drawings.csv", "sheet.csv", "sheet.json"].contains(&file.as_str())
    };
    let files: Vec<_> = files.filter(is_marked).collect();
    assert_eq!(files.len(), 5, "{files:?}");
    files
}

fn read(place: &Place, file: &str) -> String {
    fs::read_to_string(place.path(file)).unwrap()
}

/// The frames of a column's genga in a folder.
fn genga(place: &Place, folder: &str, name: &str) -> Vec<usize> {
    let table = read(place, &format!("{folder}/keys.csv"));
    let rows = column(&table, "source_frame").into_iter().zip(column(&table, "role"));
    let rows = rows.zip(column(&table, "column"));
    let own = rows.filter(|((_, role), column)| role == "genga" && column == name);
    own.map(|((frame, _), _)| frame.parse().unwrap()).collect()
}

/// Checks that each unedited file of a run gives the same sheet without a correction.
fn check_unedited(clip: &str, recipes: &[(&str, &[&str])]) {
    for (recipe, columns) in recipes {
        let place = Place::new();
        place.done(&format!("run {clip} {recipe} --deliver xdts --out a"));
        for file in marked_files(&place) {
            for name in *columns {
                let again = format!(
                    "run {clip} {recipe} --fresh --pin-from a/{file} --pin-column {name} --deliver xdts --out b"
                );
                let said = place.said(&again);
                assert!(
                    said.contains(&format!("nothing to pin from a/{file}: ")),
                    "{again}: {said}"
                );
                let (a, b) = (place.files("a"), place.files("b"));
                for (own, bytes) in &a {
                    let is_said = ["report.json", "manifest.json"].contains(&own.as_str());
                    assert!(is_said || b[own] == *bytes, "{again}: {own}");
                }
            }
        }
    }
}

#[test]
fn an_unedited_file_gives_the_same_sheet_and_no_correction() {
    for clip in ["data/kick.bvh", "data/pitch.bvh", "data/swing.bvh"] {
        check_unedited(clip, &RECIPES);
    }
    check_unedited("data/kick.bvh", &[("--loop --cycles 2", &["A"]), ("--trim 10..80", &["A"])]);
}

#[test]
fn an_unedited_file_of_a_real_clip_gives_the_same_sheet() {
    with(["cmu-07_01-walk", "cmu-05_11-dance-pirouette"], |clips| {
        for clip in clips {
            check_unedited(clip.to_str().unwrap(), &[("", &["A"]), ("--layers limbs", &["B"])]);
        }
    });
}

/// Adds a row for a key to the table of a run, and runs again with it. Returns what the program says.
fn with_another(
    place: &Place,
    (clip, recipe): (&str, &str),
    (name, frame): (&str, usize),
) -> String {
    let table = read(place, "a/keys.csv");
    let head = table.lines().next().unwrap();
    let cell = |header: &str| match header {
        "column" => name.to_owned(),
        "source_frame" => frame.to_string(),
        _ => String::new(),
    };
    let row: Vec<_> = head.split(',').map(cell).collect();
    fs::write(place.path("edited.csv"), format!("{table}{}\n", row.join(","))).unwrap();
    let again = "--fresh --pin-from edited.csv --out b";
    place.said(&format!("run {clip} {recipe} {again} --pin-column {name}"))
}

/// Checks that one more key in a gap of at least `room` frames changes nothing outside of the gap.
fn check_another(clip: &str, recipes: &[(&str, &[&str])], room: usize) {
    for (recipe, columns) in recipes {
        let (place, name) = (Place::new(), columns.last().unwrap());
        place.done(&format!("run {clip} {recipe} --out a"));
        let own = genga(&place, "a", name);
        let gaps: Vec<_> = own.windows(2).filter(|pair| pair[1] - pair[0] >= room).collect();
        assert!(!gaps.is_empty(), "{own:?}");
        for gap in gaps {
            let frame = usize::midpoint(gap[0], gap[1]);
            let said = with_another(&place, (clip, recipe), (name, frame));
            let now = genga(&place, "b", name);
            let context = format!("{clip} {recipe} {frame}: {own:?} {now:?} {said}");
            assert!(said.contains(&format!("of column {name}; ")), "{context}");
            assert!(own.iter().chain([&frame]).all(|frame| now.contains(frame)), "{context}");
            let is_outside = |frame: &&usize| **frame <= gap[0] || **frame >= gap[1];
            assert!(now.iter().filter(is_outside).eq(&own), "{context}");
        }
    }
}

#[test]
fn one_more_key_changes_only_what_is_between_its_neighbours() {
    for clip in ["data/kick.bvh", "data/pitch.bvh", "data/swing.bvh"] {
        check_another(clip, &RECIPES[..5], 4);
    }
    with(["cmu-05_11-dance-pirouette"], |[clip]| {
        check_another(clip.to_str().unwrap(), &RECIPES[..1], 20);
    });
}

#[test]
fn a_key_pushed_out_by_another_is_pinned_too() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let own = genga(&place, "a", "A");
    let beside = own[3] + 1;
    let said = with_another(&place, ("data/kick.bvh", ""), ("A", beside));
    let now = genga(&place, "b", "A");
    assert!(said.contains("2 keys of column A; 10 others are genga already"), "{said}");
    assert!(now.contains(&own[3]) && now.contains(&beside), "{own:?} {now:?}");
}

/// The genga sheet of a run with the key on one koma, from 0, copied to another or moved there.
fn edit_timesheet(place: &Place, (from, to): (u64, u64), is_move: bool) {
    let file = read(place, "a/kick_genga_ts.xdts");
    let (signature, json) = file.split_once('\n').unwrap();
    let mut file: serde_json::Value = serde_json::from_str(json).unwrap();
    let frames = file["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array_mut().unwrap();
    let mut key = frames.iter().find(|key| key["frame"] == from).unwrap().clone();
    key["frame"] = to.into();
    frames.retain(|key| key["frame"] != to && (key["frame"] != from || !is_move));
    frames.push(key);
    fs::write(place.path("a/edited_genga_ts.xdts"), format!("{signature}\n{file}")).unwrap();
}

#[test]
fn a_number_written_on_another_koma_of_a_timesheet_is_a_key_there() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out a");
    let table = read(&place, "a/keys.csv");
    let koma = |table: &str, frame: &str| {
        let at = column(table, "source_frame").iter().position(|own| own == frame).unwrap();
        column(table, "koma_first")[at].parse::<u64>().unwrap() - 1
    };
    // Frame 71 is drawn before its own koma.
    let (early, own) = (koma(&table, "71"), 71);
    assert!(early < own, "{table}");
    let again = "keys data/kick.bvh --pin-from a/edited_genga_ts.xdts";
    edit_timesheet(&place, (early, own), true);
    assert_eq!(koma(&place.done(again), "71"), own);
    edit_timesheet(&place, (0, 25), false);
    let output = place.genga(again);
    let (table, said) = (text(&output.stdout), text(&output.stderr));
    assert!(said.contains(": 1 key of column A; 13 others are genga already"), "{said}");
    assert_eq!(koma(&table, "25"), 25);
    assert_eq!(koma(&table, "71"), early);
}

#[test]
fn names_weights_and_moves_that_a_run_has_are_no_new_pins() {
    let place = Place::new();
    let run = "run data/kick.bvh --pin 42:contact@0.7,52 --move 71:75:land";
    place.done(&format!("{run} --out a"));
    for file in ["keys.csv", "sheet.json"] {
        let again = format!("{run} --pin-from a/{file} --fresh --out b");
        assert!(place.said(&again).contains("nothing to pin"), "{file}");
        assert!(place.files("a")["recipe.toml"] == place.files("b")["recipe.toml"], "{file}");
        let alone = place.said(&format!("run data/kick.bvh --pin-from a/{file} --fresh --out b"));
        assert!(alone.contains(": 3 keys of column A; "), "{file}: {alone}");
        let recipe = read(&place, "b/recipe.toml");
        assert!(recipe.contains("name = \"contact\"") && recipe.contains("\"land\""), "{recipe}");
        assert_eq!(recipe.contains("weight = 0.7"), file == "sheet.json", "{recipe}");
    }
    // A move that came later than the table wins.
    place.done("run data/kick.bvh --out a");
    let said = place.said("run data/kick.bvh --move 71:75 --pin-from a/keys.csv --fresh --out b");
    assert!(said.contains("1 other marked there gave way to pins or moves"), "{said}");
    assert!(genga(&place, "b", "A").contains(&75) && !genga(&place, "b", "A").contains(&71));
}

#[test]
fn keys_of_another_recipe_are_pinned_where_this_one_lacks_them() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out a");
    let own = genga(&place, "a", "A");
    for file in ["keys.csv", "kick_genga_ts.xdts"] {
        let fewer = "run data/kick.bvh --set keys.min_price=40 --fresh --out b";
        let said = place.said(&format!("{fewer} --pin-from a/{file}"));
        assert!(
            said.contains("pinned from a/") && said.contains(" others are genga already\n"),
            "{said}"
        );
        assert!(own.iter().all(|frame| genga(&place, "b", "A").contains(frame)), "{said}");
    }
}

#[test]
fn a_number_that_was_taken_out_is_named_where_its_genga_comes_back() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let table = read(&place, "a/keys.csv");
    let frames = genga(&place, "a", "A");
    let gone = frames[2];
    let rows = table.lines().filter(|row| !row.contains(&format!(",{gone},")));
    let rows: Vec<&str> = rows.collect();
    assert_eq!(rows.len() + 1, table.lines().count());
    fs::write(place.path("edited.csv"), rows.join("\n")).unwrap();
    let said = place.said("run data/kick.bvh --pin-from edited.csv --out b");
    let named = format!("(frame {gone}); --forbid {gone} takes one away, --only-pins all");
    assert!(said.contains(&named), "{said}");
    assert_eq!(genga(&place, "b", "A"), frames);
    let said = place.said("run data/kick.bvh --pin-from edited.csv --only-pins --out c");
    assert!(!said.contains("takes one away"), "{said}");
}

/// A koma begins between two frames of most rates, and a loop between two koma of its source.
#[test]
fn a_mark_stands_on_its_koma_or_is_told() {
    for (run, rounds) in [
        ("data/kick.bvh --fps 30", 1),
        ("data/kick.bvh --fps 100", 1),
        ("data/tennis.bvh --loop --trim 7..60", 1),
        ("data/kick.bvh --loop --cycles 2 --trim 6..85", 2),
    ] {
        let place = Place::new();
        place.done(&format!("run {run} --deliver xdts --out a"));
        let name = if run.contains("tennis") { "tennis" } else { "kick" };
        let file = read(&place, &format!("a/{name}_genga_ts.xdts"));
        let (head, body) = file.split_once('\n').unwrap();
        let sheet: serde_json::Value = serde_json::from_str(body).unwrap();
        let koma = sheet["timeTables"][0]["duration"].as_u64().unwrap();
        let (mut met, mut told) = (0, 0);
        for at in (1..koma).step_by(3) {
            let mut marked = sheet.clone();
            mark(&mut marked, at);
            fs::write(place.path("a/marked.xdts"), format!("{head}\n{marked}")).unwrap();
            let said = place.said(&format!("run {run} --pin-from a/marked.xdts --fresh --out b"));
            let keys = column(&read(&place, "b/keys.csv"), "koma_first");
            let own = at % (koma / rounds) + 1;
            let stands = keys.contains(&own.to_string());
            let elsewhere = "to stand on its own koma: koma ";
            assert_eq!(stands, !said.contains(elsewhere), "{run} {at}: {said}");
            if stands { met += 1 } else { told += 1 }
        }
        assert!(met > 5 * told, "{run}: {met} {told}");
    }
}

/// Writes a number on a koma of a timesheet's first column.
fn mark(sheet: &mut serde_json::Value, koma: u64) {
    let frames = sheet["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array_mut().unwrap();
    let data = serde_json::json!([{ "id": 0, "values": ["99"] }]);
    match frames.iter_mut().find(|frame| frame["frame"] == koma) {
        Some(frame) => frame["data"] = data,
        None => frames.push(serde_json::json!({ "frame": koma, "data": data })),
    }
    frames.sort_by_key(|frame| frame["frame"].as_u64());
}
