//! Many clips at once: whatever happens on the way, the result is that of one undisturbed batch.

use std::collections::BTreeMap;
use std::fs;

use crate::folders::all;
use crate::program::{Place, column, text};

/// Makes a library: the sample clips, folders with clips of the same name, broken clips, and files that are no clips.
/// Returns the number of clips.
pub(crate) fn library(place: &Place) -> usize {
    let samples = ["kick", "tennis", "pitch"];
    let mut count = 0;
    let mut put = |name: &str, bytes: &[u8]| {
        let path = place.path("lib").join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
        count += usize::from(name.ends_with("bvh"));
    };
    for folder in ["a", "b/deep", "c"] {
        for sample in samples {
            let bytes = fs::read(crate::clips::here(&format!("data/{sample}.bvh"))).unwrap();
            put(&format!("{folder}/{sample}.bvh"), &bytes);
        }
        put(
            &format!("{folder}/walk, \"2\".bvh"),
            &fs::read(crate::clips::here("data/kick.bvh")).unwrap(),
        );
    }
    put("broken/empty.bvh", b"");
    put("broken/words.bvh", b"HIERARCHY\nROOT a\n{\n OFFSET 0 0 zero\n");
    put("notes.txt", b"no clip");
    count
}

/// The files that must not depend on when and in which order they are made.
pub(crate) fn results(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let mut files = all(&place.path(folder));
    files.retain(|name, _| name != "times.csv" && !name.ends_with(".jsonl"));
    files
}

/// The same without the tables of old and new numbers, which a first batch has not.
pub(crate) fn numbered(place: &Place, folder: &str) -> BTreeMap<String, Vec<u8>> {
    let mut files = results(place, folder);
    files.retain(|name, _| !name.ends_with("/numbers.csv"));
    files
}

pub(crate) fn code(place: &Place, args: &str) -> (i32, String) {
    let output = place.genga(args);
    (output.status.code().unwrap_or(-1), text(&output.stderr))
}

#[test]
fn a_format_that_cannot_be_made_is_said_in_the_clips_row_and_stops_no_other() {
    let place = Place::new();
    let batch = "batch data/kick.bvh data/pitch.bvh --deliver json,vmd --set rate=60 --out out";
    // The second time it is tried again, and still said.
    for _ in 0..2 {
        let (code, said) = code(&place, batch);
        assert_eq!(code, 1, "{said}");
        assert!(said.contains("2 of 2 lack a format: kick.bvh: vmd is not made: "), "{said}");
    }
    let summary = text(&results(&place, "out")["summary.csv"]);
    assert_eq!(column(&summary, "status"), ["done", "done"]);
    assert!(column(&summary, "message")[0].starts_with("vmd is not made: vmd.fps: 60 koma"));
    assert_eq!(column(&summary, "warnings")[0], "W_NOT_MADE");
    assert!(place.path("out/clips/kick.bvh/sheet.json").exists());
    let (code, said) = self::code(&place, &format!("{batch} --allow-failures"));
    assert_eq!(code, 0, "{said}");
}

#[test]
fn results_of_genga_are_no_clips_and_it_is_said() {
    let place = Place::new();
    fs::create_dir(place.path("lib")).unwrap();
    for sample in ["kick", "pitch"] {
        let from = crate::clips::here(&format!("data/{sample}.bvh"));
        fs::copy(from, place.path(&format!("lib/{sample}.bvh"))).unwrap();
    }
    place.done("run lib/kick.bvh --out lib/kick-genga");
    place.done("batch lib/pitch.bvh --deliver bvh --out lib/before");
    let note = "note        results of genga, not taken for clips: ";
    let (code, said) = code(&place, "batch lib --out lib/now");
    assert_eq!(code, 0, "{said}");
    assert!(said.contains(&format!("{note}lib/before lib/kick-genga\n")), "{said}");
    let clips = |out: &str| column(&text(&results(&place, out)["summary.csv"]), "clip");
    assert_eq!(clips("lib/now"), ["kick.bvh", "pitch.bvh"]);
    // A pattern finds no more than the folder does.
    place.done("batch lib/**/*.bvh --out lib/matched");
    assert_eq!(clips("lib/matched"), ["kick.bvh", "pitch.bvh"]);
    // A folder of clips that a run wrote into is still one of clips.
    place.done("run lib/pitch.bvh --out lib");
    place.done("batch lib --out flat");
    assert_eq!(clips("flat"), ["kick.bvh", "pitch.bvh"]);
    let (code, said) = self::code(&place, "batch lib/kick-genga --out none");
    assert_eq!(code, 2, "{said}");
    assert!(said.contains("no clip in lib/kick-genga, only results of genga"), "{said}");
}

#[test]
fn a_library_is_a_row_and_a_folder_a_clip_and_the_broken_do_not_end_it() {
    let place = Place::new();
    let clips = library(&place);
    let (code, said) = code(&place, "batch lib --out out --deliver json,xdts");
    assert_eq!(code, 1, "{said}");
    assert!(said.contains(&format!("2 of {clips} failed: ")), "{said}");
    assert!(said.contains("words.bvh:4:13: "), "with the place of its mistake: {said}");
    let files = results(&place, "out");
    let summary = text(&files["summary.csv"]);
    assert_eq!(summary.lines().count(), clips + 1);
    let named: Vec<String> = csv::Reader::from_reader(summary.as_bytes())
        .records()
        .map(|row| row.unwrap()[0].to_owned())
        .collect();
    assert!(named.is_sorted() && named.contains(&"b/deep/walk, \"2\".bvh".to_owned()), "{named:?}");
    assert!(
        files.contains_key("clips/a/kick.bvh/sheet.json")
            && files.contains_key("clips/c/kick.bvh/kick_genga_ts.xdts")
    );
    assert!(!files.keys().any(|name| name.contains("broken") || name.contains("notes")));
    // A clip of a batch is identical to a run of it.
    place.done("run data/kick.bvh --out one");
    assert_eq!(files["clips/a/kick.bvh/sheet.json"], place.files("one")["sheet.json"]);
    let own = text(&place.files("one")["keys.csv"]);
    let keys = text(&files["keys.csv"]);
    assert_eq!(keys.lines().next().unwrap(), format!("clip,{}", own.lines().next().unwrap()));
    let of_kick: Vec<&str> =
        keys.lines().filter_map(|line| line.strip_prefix("a/kick.bvh,")).collect();
    assert_eq!(of_kick, own.lines().skip(1).collect::<Vec<_>>());
}

#[test]
fn what_is_finished_is_not_done_again_and_what_changed_is() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out out");
    let first = results(&place, "out");
    let sheet = place.path("out/clips/a/kick.bvh/sheet.json");
    let made = |path: &std::path::Path| fs::metadata(path).unwrap().modified().unwrap();
    let before = made(&sheet);
    let said = place.genga("batch lib --out out").stderr;
    let said = String::from_utf8_lossy(&said);
    let done = results(&place, "out")["summary.csv"].clone();
    let done = column(&text(&done), "status").iter().filter(|status| *status == "done").count();
    assert!(said.contains(&format!("{done} clips done already, not processed again")), "{said}");
    assert_eq!(results(&place, "out"), first);
    assert_eq!(made(&sheet), before, "not written again");
    // Another setting, and another motion in one file.
    code(&place, "batch lib --out out --set spacing.on=3 --renumber");
    assert_ne!(
        results(&place, "out")["clips/a/kick.bvh/sheet.json"],
        first["clips/a/kick.bvh/sheet.json"]
    );
    code(&place, "batch lib --out fresh --set spacing.on=3");
    assert_eq!(numbered(&place, "out"), numbered(&place, "fresh"));
    fs::copy(crate::clips::here("data/kick.bvh"), place.path("lib/broken/empty.bvh")).unwrap();
    code(&place, "batch lib --out out");
    assert!(place.path("out/clips/broken/empty.bvh/sheet.json").exists());
    // With another list, known clips stay known.
    fs::remove_file(place.path("lib/a/kick.bvh")).unwrap();
    code(&place, "batch lib --out out");
    code(&place, "batch lib --out again");
    assert_eq!(results(&place, "out")["summary.csv"], results(&place, "again")["summary.csv"]);
}

#[test]
fn what_a_person_changed_is_kept_and_is_a_row() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib/a --out out");
    let sheet = place.path("out/clips/kick.bvh/sheet.json");
    fs::write(&sheet, "mine").unwrap();
    let (exit, said) = code(&place, "batch lib/a --out out --set spacing.on=3");
    assert_eq!(exit, 1, "{said}");
    assert!(
        said.contains("sheet.json: this file is not as a batch wrote it") && said.contains("1 of"),
        "{said}"
    );
    assert_eq!(fs::read_to_string(&sheet).unwrap(), "mine");
    let (exit, said) = code(&place, "batch lib/a --out out --set spacing.on=3 --force");
    assert_eq!(exit, 0, "{said}");
    assert_ne!(fs::read_to_string(&sheet).unwrap(), "mine");
}

#[test]
fn a_painted_picture_stays_in_a_batch_unless_it_is_named() {
    let place = Place::new();
    let batch = "batch data/kick.bvh data/pitch.bvh --deliver json,bars --out out";
    place.done(batch);
    let picture = place.path("out/clips/kick.bvh/sheet.svg");
    fs::write(&picture, "mine").unwrap();
    for args in ["--set spacing.on=3", "--set spacing.on=3 --force --with csv.bom=true"] {
        place.done(&format!("{batch} {args}"));
        assert_eq!(fs::read_to_string(&picture).unwrap(), "mine", "{args}");
        let warnings = column(&text(&results(&place, "out")["summary.csv"]), "warnings");
        assert_eq!(warnings, ["W_PAINTED", ""]);
    }
    place.done(&format!(
        "{batch} --set spacing.on=3 --force --with csv.bom=true --overwrite sheet.svg"
    ));
    assert_ne!(fs::read_to_string(&picture).unwrap(), "mine");
}

/// Begins a batch twenty times and kills it. Every fifth time, `lose` removes something as well.
#[cfg(unix)]
pub(crate) fn killed_again_and_again(place: &Place, args: &str, lose: impl Fn()) {
    for at in 0..20_u64 {
        let mut child = place.begun(args);
        std::thread::sleep(std::time::Duration::from_millis((at * 37) % 190));
        let signal = ["KILL", "INT", "KILL", "TERM"][at as usize % 4];
        std::process::Command::new("kill")
            .args(["-s", signal, &child.id().to_string()])
            .status()
            .unwrap();
        child.wait().unwrap();
        if at % 5 == 4 {
            lose();
        }
    }
}

#[cfg(unix)]
#[test]
fn killed_at_any_time_and_begun_again_it_ends_as_if_undisturbed() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out whole --deliver json,bars");
    let whole = results(&place, "whole");
    let args = "batch lib --out killed --deliver json,bars";
    killed_again_and_again(&place, args, || {
        fs::remove_dir_all(place.path("killed/clips")).ok();
    });
    code(&place, args);
    assert_eq!(results(&place, "killed"), whole);
}

#[test]
fn parts_on_several_machines_are_joined_to_what_one_gives() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out whole");
    let whole = results(&place, "whole");
    for part in 1..=3 {
        let folder = if part == 3 { "other" } else { "parts" };
        code(&place, &format!("batch lib --out {folder} --shard {part}/3 --jobs 1"));
        assert!(!place.path("parts/summary.csv").exists(), "of a part there is none");
        if part == 2 {
            let said = place.refused(2, "batch --join parts --out joined");
            assert!(said.contains("part 3 of 3 is missing: genga batch … --shard 3/3"), "{said}");
        }
    }
    let (exit, said) = code(&place, "batch --join parts other --out joined");
    assert_eq!(exit, 1, "the broken are broken: {said}");
    let joined = results(&place, "joined");
    for table in ["summary.csv", "keys.csv"] {
        assert_eq!(text(&joined[table]), text(&whole[table]), "{table}");
    }
    let mut parts = results(&place, "parts");
    parts.extend(results(&place, "other"));
    parts.extend(joined);
    assert_eq!(parts, whole);
    let said = place.refused(2, "batch --join parts whole --out joined");
    assert!(said.contains("different lists"), "{said}");
    for again in ["parts parts other", "parts other parts/../other"] {
        let said = place.refused(2, &format!("batch --join {again} --out joined"));
        assert!(said.contains("of 3 is there twice: ") && said.contains("name it once"), "{said}");
    }
}

#[test]
fn a_table_asks_of_each_clip_its_own() {
    let place = Place::new();
    library(&place);
    let table = "clip,trim,set.spacing.on,pin\nlib/a/kick.bvh,10..60,3,\nlib/a/kick.bvh,,,55\nlib/a/kick.bvh,,,x\nlib/none.bvh,,,\n";
    fs::write(place.path("list.csv"), table).unwrap();
    let (exit, said) = code(&place, "batch @list.csv --out out --set keys.min_price=9");
    assert_eq!(exit, 1, "{said}");
    assert!(said.contains("2 of 4 failed"), "{said}");
    place.done(
        "run lib/a/kick.bvh --trim 10..60 --set keys.min_price=9 --set spacing.on=3 --out one",
    );
    place.done("run lib/a/kick.bvh --pin 55 --set keys.min_price=9 --out two");
    let files = results(&place, "out");
    for (clip, run) in [("kick.bvh", "one"), ("kick.bvh~2", "two")] {
        assert_eq!(
            files[&format!("clips/a/{clip}/sheet.json")],
            place.files(run)["sheet.json"],
            "{clip}"
        );
    }
    let listed = place.fed("batch - --out listed", b"# two\nlib/a/kick.bvh\nlib/c/kick.bvh\n");
    assert_eq!(listed.status.code(), Some(0));
    assert!(place.path("listed/clips/c/kick.bvh/sheet.json").exists());
}

#[test]
fn progress_is_lines_for_programs() {
    let place = Place::new();
    library(&place);
    let batch = "batch lib/*/kick.bvh lib/broken --out out --deliver json,vmd --set rate=60";
    // The second time says the same.
    for _ in 0..2 {
        let output = place.genga(&format!("{batch} --progress json --jobs 1"));
        let lines: Vec<serde_json::Value> =
            text(&output.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let [mut done, mut failed] = [0, 0];
        for line in &lines {
            let (clip, message) = (line["clip"].as_str().unwrap(), line["message"].as_str());
            let (status, reason) = match clip.contains("broken") {
                true => ("failed", "broken/"),
                false => ("done", "vmd is not made: "),
            };
            done += usize::from(status == "done");
            failed += usize::from(status == "failed");
            assert_eq!(line["status"], status, "{line}");
            assert!(message.unwrap().contains(reason), "{line}");
            assert_eq!((&line["done"], &line["failed"]), (&done.into(), &failed.into()), "{line}");
            assert_eq!(line["of"], lines.len());
            assert_eq!(line.as_object().unwrap().len(), 6, "{line}");
        }
        assert_eq!((done, failed), (2, 2));
    }
    let said = text(&place.genga("batch lib/broken --out farm --progress openjd").stdout);
    assert!(
        said.contains("openjd_progress: 50.0") && said.contains("openjd_fail: 2 of 2 failed"),
        "{said}"
    );
    let said = place.refused(1, "batch lib --out fast --fail-fast --jobs 1 -q");
    assert!(said.contains("failed"), "{said}");
}

#[test]
fn what_there_is_no_clip_of_is_said() {
    let place = Place::new();
    library(&place);
    fs::create_dir(place.path("none")).unwrap();
    for (args, code, reason) in [
        ("batch none --out o", 2, "there is no clip in none"),
        ("batch nowhere.bvh --out o", 1, "nowhere.bvh: there is no such file"),
        ("batch lib/*.mp4 --out o", 1, "lib/*.mp4: no motion file matches"),
        ("batch lib --out o --shard 5/4", 2, "expected a part"),
    ] {
        let said = place.refused(code, args);
        assert!(said.contains(reason), "{args}: {said}");
    }
}

#[test]
fn a_clip_that_ends_in_the_middle_is_done_and_the_last_lines_say_so() {
    let place = Place::new();
    let whole = fs::read(crate::clips::here("data/tennis.bvh")).unwrap();
    fs::create_dir(place.path("lib")).unwrap();
    fs::write(place.path("lib/half.bvh"), &whole[..30_000]).unwrap();
    fs::copy(crate::clips::here("data/kick.bvh"), place.path("lib/kick.bvh")).unwrap();
    let said = place.said("batch lib --out out");
    let named = "(--strict refuses damaged ones): W_FRAMES_MISMATCH 1 (half.bvh)\n";
    assert!(said.contains(named), "{said}");
    let (code, said) = code(&place, "batch lib --strict --out strict");
    assert!(code == 1 && said.contains("half.bvh"), "{said}");
}

#[test]
fn a_clip_without_its_only_format_is_done_but_for_it_and_is_tried_again() {
    let place = Place::new();
    place.done("batch data/kick.bvh --set rate=60 --out whole");
    let batch = "batch data/kick.bvh --deliver vmd --set rate=60 --out out";
    for _ in 0..2 {
        let said = place.refused(1, batch);
        assert!(said.contains("1 of 1 lack a format: kick.bvh: vmd is not made: "), "{said}");
        assert!(!said.contains("done already"), "{said}");
        let files = results(&place, "out");
        let summary = text(&files["summary.csv"]);
        assert_eq!(column(&summary, "status"), ["done"]);
        assert_eq!(column(&summary, "warnings"), ["W_NOT_MADE"]);
        assert_eq!(files["keys.csv"], results(&place, "whole")["keys.csv"]);
    }
}
