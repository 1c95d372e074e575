//! A person's wishes, through the program: targets, pins, forbidden and moved keys, joint weights.

use std::fs;

use crate::clips::with;
use crate::program::{Place, column, text, without_found};

/// Number of genga rows in a key table.
fn genga(table: &str) -> usize {
    column(table, "role").iter().filter(|role| *role != "inbetween").count()
}

fn report(place: &Place, folder: &str) -> serde_json::Value {
    let bytes = fs::read(place.path(&format!("{folder}/report.json"))).unwrap();
    serde_json::from_slice(&bytes).unwrap()
}

#[test]
fn as_many_genga_and_drawings_as_asked_for() {
    let place = Place::new();
    let said = place.genga("run data/kick.bvh --out a --keys 16 --drawings-per-second 6");
    assert!(said.status.success());
    let said = text(&said.stderr);
    assert!(said.contains("found       keys.min_price="), "{said}");
    assert!(
        said.contains("16, first and last drawing among them")
            && said.contains(", 23 drawings, 6.0 a second"),
        "{said}"
    );
    assert_eq!(report(&place, "a")["notes"], serde_json::json!([]));
    assert_eq!(genga(&place.done("keys data/kick.bvh --keys 16")), 16);
}

#[test]
fn the_recipe_of_a_target_gives_the_same_bytes_without_it() {
    let place = Place::new();
    for targets in [
        "--keys 24",
        "--max-error 8%",
        "--drawings-per-second 10.5",
        "--keys 7 --drawings-per-second 4",
    ] {
        place.done(&format!("run data/tennis.bvh --out a {targets}"));
        place.done("run data/tennis.bvh --out b --recipe a/recipe.toml");
        let [a, b] = ["a", "b"].map(|folder| without_found(place.files(folder)));
        assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
        for (file, bytes) in a {
            assert!(b[&file] == bytes, "{targets}: {file} came out different");
        }
    }
}

#[test]
fn a_smaller_error_takes_more_keys() {
    let place = Place::new();
    let keys = |error: &str| genga(&place.done(&format!("keys data/kick.bvh --max-error {error}")));
    let counts = ["40%", "12%", "6", "4%"].map(keys);
    assert!(counts.is_sorted_by(|a, b| a < b), "{counts:?}");
    let said = text(&place.genga("run data/kick.bvh --out a --max-error 8%").stderr);
    let found = said.lines().find(|line| line.starts_with("found       ")).unwrap();
    let (settings, reached) = found.split_once("; furthest off ").expect(found);
    assert!(settings.starts_with("found       keys."), "{found}");
    let reached: f64 = reached.strip_suffix(" %").unwrap().parse().unwrap();
    assert!(reached > 2.0 && reached <= 8.0, "{found}");
    let again = "keys data/kick.bvh --recipe a/recipe.toml --max-error 8%";
    let said = text(&place.genga(again).stderr);
    assert_eq!(said, format!("found       nothing to change; furthest off {reached:.2} %\n"));
    let said =
        text(&place.genga("keys data/kick.bvh --max-error 0.1% --set keys.merge=union").stderr);
    assert!(
        said.contains("the body was to be 0.1 % of its height off at the most, and it is "),
        "{said}"
    );
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
        ("keys data/kick.bvh --max-error 0", "--max-error: must be above 0"),
        (
            "keys data/kick.bvh --max-error much",
            "expected a share of body height (5%), found \"much\"",
        ),
        ("keys data/kick.bvh --max-error 5% --keys 9", "--max-error"),
        (
            "keys data/kick.bvh --only-pins --pin 3 --keys 9",
            "--keys: cannot be asked for together with --only-pins, which wants no keys but your own",
        ),
        (
            "run data/kick.bvh --only-pins --pin 3 --max-error 9%",
            "--max-error: cannot be asked for together with --only-pins",
        ),
        (
            "keys data/kick.bvh --max-error 5%%",
            "expected a share of body height (5%), found \"5%%\"",
        ),
        (
            "keys data/kick.bvh --max-error 0.07",
            "0.07 may mean 0.07% or 7% of the body's height; write the one you mean with its %",
        ),
        ("keys data/kick.bvh --max-error -1", "--max-error: must be above 0"),
        (
            "keys data/kick.bvh --keys=-1",
            "expected a whole number of genga, 0 or more, as in 24, found \"-1\"",
        ),
        (
            "keys data/kick.bvh --keys -1",
            "expected a whole number of genga, 0 or more, as in 24, found \"-1\"",
        ),
        (
            "keys data/kick.bvh --keys 24.5",
            "expected a whole number of genga, 0 or more, as in 24, found \"24.5\"",
        ),
        ("keys data/kick.bvh --keys many", "for '--keys <N>': expected a whole number of genga"),
        (
            "run data/kick.bvh --drawings-per-second x",
            "expected drawings a second, above 0, as in 8 or 6.5, found \"x\"",
        ),
        ("run data/kick.bvh --drawings-per-second -8", "--drawings-per-second: must be above 0"),
        ("keys data/kick.bvh --keys 3 --keys 4", "--keys"),
        ("keys data/kick.bvh --keys 3 --per-joint", "--per-joint"),
        (
            "keys data/kick.bvh --keys 3 --set keys.rest=-1",
            "keys.rest: expected % of body height a second, 0 or more",
        ),
    ] {
        let said = place.refused(2, args);
        assert!(said.contains(wanted), "{args}: {said}");
        assert!(!place.path("kick-genga").exists(), "{args}");
    }
}

/// Source frame and note of every genga in a key table.
fn keys(table: &str) -> Vec<(String, String)> {
    let rows = column(table, "source_frame").into_iter().zip(column(table, "note"));
    let roles = column(table, "role").into_iter();
    rows.zip(roles).filter(|(_, role)| role == "genga").map(|(row, _)| row).collect()
}

fn frames(table: &str) -> Vec<String> {
    keys(table).into_iter().map(|(frame, _)| frame).collect()
}

#[test]
fn keys_are_pinned_forbidden_moved_and_named_and_the_recipe_keeps_it_all() {
    let place = Place::new();
    let corrections = "--pin 42:contact@0.7 --forbid 60,10..16 --move 71:75:land@0.1 --hold 0:6";
    let before = frames(&place.done("keys data/kick.bvh"));
    assert!(["41", "71"].iter().all(|frame| before.contains(&(*frame).to_owned())), "{before:?}");
    place.done(&format!("run data/kick.bvh --out a {corrections}"));
    let table = fs::read_to_string(place.path("a/keys.csv")).unwrap();
    let note = |frame: &str| {
        let key = keys(&table).into_iter().find(|(own, _)| own == frame);
        key.unwrap_or_else(|| panic!("no {frame} in {table}")).1
    };
    assert!(note("42").starts_with("pinned: contact"));
    assert!(note("75").starts_with("pinned: land; moved from frame 71"), "{}", note("75"));
    for frame in frames(&table) {
        let frame: usize = frame.parse().unwrap();
        assert!(frame != 71 && frame != 60 && !(10..16).contains(&frame), "{frame} in {table}");
    }
    let recipe = fs::read_to_string(place.path("a/recipe.toml")).unwrap();
    for line in [
        "[edits]\nforbidden = [60, \"10..16\"]",
        "[[edits.pins]]\nframe = 42\nname = \"contact\"\nweight = 0.7",
        "[[edits.moves]]\nfrom = 71\nto = 75\nname = \"land\"\nweight = 0.1",
        "[[edits.holds]]\nframe = 0\nkoma = 6",
        "# 原画の選び方",
    ] {
        assert!(recipe.contains(line), "{line} is not in\n{recipe}");
    }
    place.done("run data/kick.bvh --out b --recipe a/recipe.toml");
    let (a, b) = (place.files("a"), place.files("b"));
    assert!(a == b, "the recipe alone gives the same bytes");
    // A new search with other settings keeps the pins.
    let table = place.done("keys data/kick.bvh --recipe a/recipe.toml --keys 9");
    assert_eq!(genga(&table), 9);
    assert!(frames(&table).contains(&"42".to_owned()), "{table}");
    let table = place.done("keys data/kick.bvh --pin 20,30:top --only-pins");
    assert_eq!(frames(&table), ["20", "30"]);
    place.done("run data/kick.bvh --out c --pin 20,30:top --only-pins");
    let back = place.genga("keys data/kick.bvh --recipe c/recipe.toml --keys 9");
    assert!(text(&back.stderr).contains(": only_pins wants no keys but pins"), "{back:?}");
    let back = place.done("keys data/kick.bvh --recipe c/recipe.toml --keys 9 --only-pins=false");
    assert_eq!(genga(&back), 9);
}

#[test]
fn an_own_weight_crowds_the_inbetweens_of_that_key_alone() {
    let place = Place::new();
    let places = |weight: &str| {
        place.done(&format!(
            "run data/kick.bvh --out o --pin 52{weight} --set spacing.on=1 --set spacing.drift=0"
        ));
        column(&fs::read_to_string(place.path("o/drawings.csv")).unwrap(), "source_frame")
    };
    let (plain, own) = (places(""), places("@0.9"));
    assert_ne!(plain, own);
    assert_eq!(plain, places("@0.3"), "the recipe's weight");
}

#[test]
fn a_held_drawing_stays_as_long_as_was_asked_and_genga_on_their_koma() {
    let place = Place::new();
    let sheet = |hold: &str| {
        place.done(&format!("run data/kick.bvh --out o {hold}"));
        let table = |name: &str| fs::read_to_string(place.path(name)).unwrap();
        let genga = column(&table("o/keys.csv"), "koma_first");
        (genga, column(&table("o/drawings.csv"), "koma_count"))
    };
    let (genga, found) = sheet("");
    for koma in ["1", "6"] {
        let (same, held) = sheet(&format!("--hold 0:{koma}"));
        assert_eq!(same, genga);
        assert_eq!(held[0], koma, "{found:?}");
    }
}

#[test]
fn a_spoken_line_is_in_every_timesheet_and_changes_no_drawing() {
    let place = Place::new();
    let formats = "--deliver xdts,tdts,xsheet";
    place.done(&format!("run data/kick.bvh --out silent {formats}"));
    place.done(&format!(
        "run data/kick.bvh --out a --say 11..40:アキ:えい！ --say 80..92:Ha {formats}"
    ));
    place.done(&format!("run data/kick.bvh --out b --recipe a/recipe.toml {formats}"));
    let (silent, a, b) = (place.files("silent"), place.files("a"), place.files("b"));
    for (file, bytes) in &a {
        assert!(b[file] == *bytes, "{file} is another one from the recipe");
    }
    for file in ["limited.bvh", "keys.csv", "drawings.csv", "remap.csv", "sheet.csv"] {
        assert!(silent[file] == a[file], "{file} changed");
    }
    let lines = |file: &str| -> Vec<String> {
        let read = genga_files::xdts::read(&a[file]).unwrap();
        let line = |line: &genga::sheet::SpokenLine| format!("{}+{} {line}", line.begin, line.koma);
        read.lines.iter().map(line).collect()
    };
    for file in ["kick_genga_ts.xdts", "kick_douga_ts.xdts", "kick.tdts"] {
        assert_eq!(lines(file), ["11+29 アキ「えい！」", "80+12 Ha"], "{file}");
    }
    assert!(text(&a["kick_xsheet.html"]).contains(">アキ「えい！」<"));
    // A returned timesheet has the lines, and the sheet is unchanged.
    place.done("deliver a/sheet.json data/kick.bvh --to json --out again");
    assert!(place.files("again")["sheet.json"] == a["sheet.json"]);
}

#[test]
fn a_hold_that_could_not_be_done_is_said() {
    let place = Place::new();
    let notes = |args: &str| {
        let said = text(&place.genga(&format!("run data/kick.bvh --out o {args}")).stderr);
        let notes = report(&place, "o")["notes"].clone();
        notes
            .as_array()
            .unwrap()
            .iter()
            .for_each(|note| assert!(said.contains(note.as_str().unwrap())));
        notes
    };
    let found = frames(
        &fs::read_to_string({
            notes("");
            place.path("o/keys.csv")
        })
        .unwrap(),
    );
    let genga = &found[found.len() / 2];
    let note = notes(&format!("--hold {genga}:30"));
    let begin = format!("the drawing of frame {genga} was to stay for 30 koma and stays for ");
    assert!(note[0].as_str().unwrap().starts_with(&begin), "{note}");
    assert_eq!(notes("--hold 0:2 --fresh"), serde_json::json!([]), "what was done is not told");
}

#[test]
fn a_move_changes_the_key_that_is_moved_and_no_other() {
    let place = Place::new();
    let before = frames(&place.done("keys data/kick.bvh"));
    assert!(before.contains(&"71".to_owned()), "{before:?}");
    let moved = frames(&place.done("keys data/kick.bvh --move 71:74"));
    let expected = before.iter().map(|frame| if frame == "71" { "74" } else { frame });
    assert_eq!(moved, expected.collect::<Vec<_>>());
    // There is no key beside it, though single joints may turn there. A key found at the target frame of the move makes
    // no difference.
    for beside in ["70:75", "70:71", "12:71"] {
        let output = place.genga(&format!("keys data/kick.bvh --move {beside}"));
        assert_eq!(frames(&text(&output.stdout)), before, "{beside}");
        let said = text(&output.stderr);
        assert!(
            said.contains("no key is found at frame") && said.contains("(the nearest "),
            "{said}"
        );
    }
    let said = place.refused(2, "keys data/kick.bvh --pin 20 --move 71:20");
    assert!(said.contains("frame 20 is pinned or moved to twice: once is enough"), "{said}");
}

#[test]
fn a_move_that_finds_nothing_is_said() {
    let place = Place::new();
    let forbidden = "--forbid 30..36 --move 3:33";
    let output = place.genga(&format!("run data/kick.bvh --out a {forbidden}"));
    let said = text(&output.stderr);
    let note = "no key is found at frame 3 (the nearest is at 10), so none was moved to 33; a pin at 33 makes one there";
    assert!(output.status.success() && said.contains(note), "{said}");
    assert_eq!(report(&place, "a")["notes"], serde_json::json!([note]));
    assert!(text(&place.genga(&format!("keys data/kick.bvh {forbidden}")).stderr).contains(note));
}

/// The frames of the kick's genga with some options.
fn genga_frames(place: &Place, options: &str) -> Vec<usize> {
    let table = place.done(&format!("keys data/kick.bvh {options}"));
    let roles = column(&table, "role");
    let rows = column(&table, "source_frame").into_iter().zip(roles);
    rows.filter(|(_, role)| role == "genga").map(|(frame, _)| frame.parse().unwrap()).collect()
}

#[test]
fn a_correction_changes_its_neighbourhood_or_all_if_asked() {
    let place = Place::new();
    let free = genga_frames(&place, "");
    let outside = |keys: &[usize]| {
        keys.iter().copied().filter(|key| !(37 < *key && *key < 48)).collect::<Vec<_>>()
    };
    let near = genga_frames(&place, "--forbid 41");
    assert_eq!(outside(&near), outside(&free));
    let again = genga_frames(&place, "--forbid 41 --again");
    assert_ne!(outside(&again), outside(&free));
    place.done("run data/kick.bvh --forbid 41 --again --out a");
    let recipe = fs::read_to_string(place.path("a/recipe.toml")).unwrap();
    assert!(recipe.contains("again = true"), "{recipe}");
    assert_eq!(genga_frames(&place, "--recipe a/recipe.toml"), again);
    assert_eq!(genga_frames(&place, "--recipe a/recipe.toml --again=false"), near);
}

#[test]
fn the_genga_of_an_earlier_run_are_frozen_and_corrected() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let free = genga_frames(&place, "");
    let fewer = "--set keys.min_price=40";
    assert!(genga_frames(&place, fewer).len() < free.len());
    assert_eq!(genga_frames(&place, &format!("{fewer} --freeze a")), free);
    let pinned = genga_frames(&place, &format!("{fewer} --freeze a/sheet.json --pin 52"));
    assert_eq!(pinned.iter().copied().filter(|key| *key != 52).collect::<Vec<_>>(), free);
    assert_eq!(pinned.len(), free.len() + 1);
    let said = place.genga(&format!("run data/kick.bvh {fewer} --freeze a --out a"));
    assert!(
        said.status.success() && text(&said.stderr).contains("frozen from a/sheet.json: 11 keys")
    );
    assert_eq!(genga_frames(&place, "--recipe a/recipe.toml"), free, "the recipe keeps them");
    assert!(place.refused(2, "run data/kick.bvh --freeze a --again").contains("--again"));
    assert!(
        place
            .refused(2, "keys data/kick.bvh --freeze a --keys 9")
            .contains("together with --freeze")
    );
    let other = place.refused(1, "keys data/kick.bvh --freeze a --trim 0..20");
    assert!(other.contains("is not in the clip, which has frames 0 to"), "{other}");
}

#[test]
fn frozen_keys_hold_rests_as_long_as_before() {
    for recipe in ["", "--set spacing.on=1", "--pin 20,42 --forbid 55"] {
        let place = Place::new();
        place.done(&format!("run data/kick.bvh {recipe} --out a"));
        place.done(&format!("run data/kick.bvh {recipe} --freeze a --out b"));
        let (a, b) = (place.files("a"), place.files("b"));
        for file in ["sheet.csv", "drawings.csv", "limited.bvh"] {
            assert!(a[file] == b[file], "{recipe}: {file}");
        }
    }
}

#[test]
fn the_steps_of_a_frozen_gait_stay_steps_on_their_koma() {
    with(["cmu-07_01-walk", "cmu-09_01-run"], |clips| {
        for clip in clips {
            let (place, clip) = (Place::new(), clip.display());
            place.done(&format!("run {clip} --out a"));
            place.done(&format!("run {clip} --freeze a --out b"));
            let drawn = |folder: &str| {
                let table = fs::read_to_string(place.path(&format!("{folder}/keys.csv"))).unwrap();
                ["role", "reason", "koma_first", "source_frame"].map(|name| column(&table, name))
            };
            assert_eq!(drawn("a"), drawn("b"), "{clip}");
        }
    });
}

#[test]
fn the_keys_of_an_edited_table_or_sheet_come_back_alone_or_with_others() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --pin 42:contact");
    let table = fs::read_to_string(place.path("a/keys.csv")).unwrap();
    let own = frames(&table);
    for file in ["keys.csv", "drawings.csv", "sheet.csv", "sheet.json"] {
        let back = format!("keys data/kick.bvh --pin-from a/{file} --only-pins");
        let output = place.genga(&back);
        let back = text(&output.stdout);
        assert_eq!(frames(&back), own, "{file}");
        assert!(back.contains("pinned: contact"), "{file}: {back}");
        let said = text(&output.stderr);
        let count = own.len();
        assert!(
            said.contains(&format!("pinned from a/{file}: {count} keys of column A")),
            "{said}"
        );
    }
    // One row is deleted, one changed.
    let edited: Vec<&str> = table.lines().filter(|line| !line.contains(",genga,4,")).collect();
    let edited = edited.join("\n").replace(",42,1.75,", ",43,1.75,");
    fs::write(place.path("edited.csv"), &edited).unwrap();
    let back = place.done("keys data/kick.bvh --pin-from edited.csv --only-pins");
    let mut wanted: Vec<_> = own.iter().map(|frame| frame.replace("42", "43")).collect();
    wanted.remove(2);
    assert_eq!(frames(&back), wanted, "{edited}");
    let found = place.done("keys data/kick.bvh --pin-from edited.csv");
    assert!(frames(&found).len() >= wanted.len());
    assert!(wanted.iter().all(|frame| frames(&found).contains(frame)), "{found}");
    // A run takes the marked keys too, and its recipe contains them.
    place.done("run data/kick.bvh --out b --pin-from edited.csv --only-pins");
    place.done("run data/kick.bvh --out c --recipe b/recipe.toml");
    let (mut b, mut c) = (place.files("b"), place.files("c"));
    // The report states the origin of the keys, and the manifest has each file's digest.
    for file in ["report.json", "manifest.json"] {
        assert_ne!(b.remove(file), c.remove(file));
    }
    assert!(b == c);
    // On stdin the kind is known by the first bytes.
    for file in ["a/keys.csv", "a/sheet.json"] {
        let bytes = fs::read(place.path(file)).unwrap();
        let output = place.fed("keys data/kick.bvh --pin-from - --only-pins", &bytes);
        assert_eq!(frames(&text(&output.stdout)), own, "{file}");
    }
}

#[test]
fn the_keys_of_a_timesheet_are_the_frames_that_its_own_sheet_shows() {
    let place = Place::new();
    let run = "run data/pitch.bvh --keys 8 --set spacing.weight=0.9 --deliver xdts --out a";
    place.done(run);
    let own = frames(&fs::read_to_string(place.path("a/keys.csv")).unwrap());
    let marked = "a/pitch_genga_ts.xdts";
    let back = place.genga(&format!("keys data/pitch.bvh --pin-from {marked} --only-pins"));
    assert_eq!(frames(&text(&back.stdout)), own);
    let said = text(&back.stderr);
    assert!(
        said.contains("its marks are read as koma of a/sheet.json, the sheet beside it"),
        "{said}"
    );
    // Without that sheet, its koma are those of the default recipe.
    fs::rename(place.path(marked), place.path("pitch_genga_ts.xdts")).unwrap();
    let alone = "keys data/pitch.bvh --pin-from pitch_genga_ts.xdts --only-pins";
    assert_ne!(frames(&place.done(alone)), own);
    let same = format!("{alone} --recipe a/recipe.toml");
    assert_eq!(frames(&place.done(&same)), own);
}

/// A table as Excel saves it: with a byte order mark and Windows line ends.
#[test]
fn a_table_written_for_excel_comes_back_as_keys() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --with csv.bom=true");
    let own = frames(&fs::read_to_string(place.path("a/keys.csv")).unwrap());
    assert!(own.len() > 5, "{own:?}");
    for file in ["keys.csv", "drawings.csv", "sheet.csv"] {
        let table = fs::read_to_string(place.path(&format!("a/{file}"))).unwrap();
        assert!(table.starts_with('\u{feff}'), "{file}");
        let saved = table.replace('\n', "\r\n");
        fs::write(place.path("saved.csv"), &saved).unwrap();
        for marked in [&*format!("a/{file}"), "saved.csv"] {
            let back = place.done(&format!("keys data/kick.bvh --pin-from {marked} --only-pins"));
            assert_eq!(frames(&back), own, "{marked} of {file}");
        }
        let output = place.fed("keys data/kick.bvh --pin-from - --only-pins", saved.as_bytes());
        assert_eq!(frames(&text(&output.stdout)), own, "{file} from stdin");
    }
    // The byte order mark precedes the column name that is looked for.
    fs::write(place.path("frames.csv"), "\u{feff}source_frame\r\n12\r\n50\r\n").unwrap();
    let back = frames(&place.done("keys data/kick.bvh --pin-from frames.csv --only-pins"));
    assert!(back.contains(&"12".into()) && back.contains(&"50".into()), "{back:?}");
}

#[test]
fn a_table_or_sheet_with_marked_keys_is_not_written_over() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let before = place.files("a");
    for args in [
        "run data/kick.bvh --out a --pin-from a/keys.csv",
        "run data/kick.bvh --out a --pin-from a/sheet.json",
        "run data/kick.bvh --out a --pin-from a/sheet.csv",
        "keys data/kick.bvh --out a/keys.csv --pin-from a/keys.csv",
    ] {
        let said = place.refused(2, args);
        assert!(said.contains("this is the file with your keys itself; write elsewhere"), "{said}");
        assert!(place.files("a") == before, "{args}");
    }
}

#[test]
fn wrong_corrections_are_refused_with_the_way_out() {
    let place = Place::new();
    fs::write(place.path("no.csv"), "koma,layer\n1,A\n").unwrap();
    fs::write(place.path("gnega.csv"), "source_frame,role\n3,gnega\n").unwrap();
    fs::write(place.path("far.csv"), "source_frame\n300\n").unwrap();
    fs::write(place.path("no.json"), "{}").unwrap();
    fs::write(place.path("r.toml"), "[edits]\nforbidden = [\"9..2\"]\n").unwrap();
    fs::write(place.path("half.toml"), "[edits]\nforbidden = [20.5]\n").unwrap();
    fs::write(place.path("m.toml"), "[[edits.moves]]\nfrom = 4\n").unwrap();
    place.done("run data/kick.bvh --out a");
    for (code, args, wanted) in [
        (
            2,
            "--pin twelve",
            "--pin: expected FRAME, FRAME:NAME or FRAME:NAME@WEIGHT, found \"twelve\"",
        ),
        (2, "--pin 12:me@home", "--pin: expected a spacing weight, 0 to below 1, behind the @"),
        (2, "--pin 12@1", "the weight of pinned frame 12 must be at least 0 and below 1"),
        (2, "--pin 92", "pinned frame 92 is not in the clip, which has frames 0 to 91"),
        (2, "--forbid 9..2", "--forbid: \"9..2\" ends before it begins"),
        (
            2,
            "--forbid many",
            "--forbid: expected a frame (150) or a range (120..140), found \"many\"",
        ),
        (
            2,
            "--forbid 92..99",
            "forbidden range 92..99 is not in the clip, which has frames 0 to 91",
        ),
        (2, "--forbid 42 --pin 42", "frame 42 is pinned and forbidden at once"),
        (2, "--move 41", "--move: expected FROM:TO, two frame numbers, found \"41\""),
        (2, "--move 41:92", "frame 92 of the move 41:92 is not in the clip"),
        (2, "--move 41:41", "moved to where it is"),
        (2, "--move 42:43 --pin 42", "frame 42 is pinned and moved at once: pin 43 instead"),
        (2, "--hold 41", "--hold: expected FRAME:KOMA, two whole numbers, found \"41\""),
        (2, "--hold 41:0", "the drawing of frame 41 is held for 0 koma: 1 at the least"),
        (2, "--hold 92:2", "held frame 92 is not in the clip, which has frames 0 to 91"),
        (2, "--say 12:hello", "--say: expected A..B:SPEAKER:WORDS, with two frame numbers, found"),
        (2, "--say 92..99:a", "the line 92..99 is not in the clip, which has frames 0 to 91"),
        (2, "--say 9..9:a", "the line 9..9 has no frame in it"),
        (2, "--only-pins", "there is no pin: pin a frame"),
        (2, "--recipe r.toml", "\"9..2\" ends before it begins"),
        (2, "--recipe half.toml", "2:13: expected a frame (150) or a range (120..140)"),
        (2, "--recipe m.toml", "missing field `to`"),
        (1, "--pin-from no.csv", "no.csv: line 1: there is no column source_frame"),
        (1, "--pin-from gnega.csv", "gnega.csv: line 2: role: expected genga, inbetween or end"),
        (2, "--pin-from far.csv", "pinned frame 300 is not in the clip"),
        (1, "--pin-from no.json", "no.json: this is no sheet of genga"),
        (1, "--pin-from a/keys.csv --pin-column B", "there is no genga in a column B; there are A"),
        (
            1,
            "--fps 30 --pin-from a/sheet.json",
            "the sheet is for 24 frames a second, the clip has 30",
        ),
    ] {
        let said = place.refused(code, &format!("keys data/kick.bvh {args}"));
        assert!(said.contains(wanted), "{args}: {said}");
    }
}

#[test]
fn joints_count_as_much_as_a_person_says() {
    let place = Place::new();
    place.done("run data/kick.bvh --out plain");
    place.done("run data/kick.bvh --out a --set keys.weights.*Hand*=6 --set keys.weights.Hips=0");
    let table =
        |folder: &str| fs::read_to_string(place.path(&format!("{folder}/keys.csv"))).unwrap();
    assert_ne!(frames(&table("a")), frames(&table("plain")));
    assert!(table("plain").contains("Hips") && !table("a").contains("Hips"), "{}", table("a"));
    let recipe = fs::read_to_string(place.path("a/recipe.toml")).unwrap();
    assert!(
        recipe.contains("\n[keys.weights]\n\"*Hand*\" = 6.0\nHips = 0.0\n\n[actions]\n"),
        "{recipe}"
    );
    place.done("run data/kick.bvh --out b --recipe a/recipe.toml");
    assert!(place.files("a") == place.files("b"));
    // The sheet records its settings.
    let sheet = fs::read_to_string(place.path("a/sheet.json")).unwrap();
    assert!(sheet.contains("\"keys.weights.*Hand*\": \"6\""), "{sheet}");
    place.done("run data/kick.bvh --out c --recipe a/recipe.toml --set keys.weights.*Hand*=none --set keys.weights.Hips=1");
    assert_eq!(table("c"), table("plain"));
}

#[test]
fn wrong_joint_weights_are_refused_with_the_nearest_name() {
    let place = Place::new();
    fs::write(place.path("r.toml"), "[keys.weights]\nLeftHnad = 2\n").unwrap();
    fs::write(place.path("w.toml"), "[keys.weights]\nLeftHand = \"much\"\n").unwrap();
    for (args, wanted) in [
        (
            "--recipe r.toml",
            "keys.weights.LeftHnad: the clip has no such joint; did you mean LeftHand?",
        ),
        (
            "--recipe r.toml --keys 5",
            "genga: r.toml: keys.weights.LeftHnad: the clip has no such joint",
        ),
        (
            "--recipe w.toml",
            "w.toml:2:12: keys.weights.LeftHand: expected a number, 0 (no say) or more",
        ),
        ("--set keys.weights.*Tail*=2", "keys.weights.*Tail*: the clip has no such joint\n"),
        (
            "--set keys.weights.Hips=1e308",
            "keys.weights.Hips: expected a number, 0 (no say) or more, at most 1000000; 1 is usual",
        ),
        ("--set keys.weights.Hips=-1", "keys.weights.Hips: expected a number, 0 (no say) or more"),
        ("--set keys.weights.Hips=much", "found \"much\""),
        ("--set keys.weights.*=0", "keys.weights: every joint has 0: leave one that has a say"),
        (
            "--set keys.weights=2",
            "keys.weights: there is no such setting; how much a joint counts is set by keys.weights.JOINT=2",
        ),
        ("--set keys.weight.Head=1", "is set by keys.weights.JOINT=2"),
    ] {
        let said = place.refused(2, &format!("keys data/kick.bvh {args}"));
        assert!(said.contains(wanted), "{args}: {said}");
    }
}

#[test]
fn a_setting_that_another_option_sets_names_that_option() {
    let place = Place::new();
    for (args, wanted) in [
        ("--set images.height=100", "--with images.height=100"),
        ("--set figures.png=true", "--with figures.png=true"),
        ("--with filter.width=0.2", "--set filter.width=0.2"),
    ] {
        let said = place.refused(2, &format!("run data/kick.bvh {args} --out a"));
        assert!(said.contains(wanted), "{args}: {said}");
        assert!(!place.path("a").exists(), "nothing is written");
    }
}
