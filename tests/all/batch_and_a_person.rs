//! What a person puts or changes in the folders of a batch stays, and disturbs no clip.

use std::fs;

use crate::batch::{code, numbered, results};
use crate::clips::here;
use crate::kept_numbers::{check, numbers};
use crate::program::{Place, column, text};

const BATCH: &str = "batch data/kick.bvh data/pitch.bvh --deliver json,bars --out out";
const SHEET: &str = "out/clips/kick.bvh/sheet.json";

fn summary(place: &Place, of: &str) -> Vec<String> {
    column(&text(&results(place, "out")["summary.csv"]), of)
}

fn read(place: &Place, name: &str) -> String {
    fs::read_to_string(place.path(name)).unwrap()
}

#[test]
fn files_that_no_batch_wrote_are_left_alone() {
    let place = Place::new();
    place.done(BATCH);
    let own = ["my.ma", "notes.txt", ".DS_Store", "Thumbs.db", "ref.png", "images/rough.png"];
    let at = |name: &str| format!("out/clips/kick.bvh/{name}");
    fs::create_dir(place.path(&at("images"))).unwrap();
    own.iter().for_each(|name| fs::write(place.path(&at(name)), name).unwrap());
    for more in ["--set spacing.on=3", "--set spacing.on=4 --force", "--deliver xdts --force"] {
        let (exit, said) = code(&place, &format!("{BATCH} {more}"));
        assert_eq!(exit, 0, "{more}: {said}");
        assert!(!said.contains("kept"), "{more}: {said}");
        own.iter().for_each(|name| assert_eq!(read(&place, &at(name)), *name, "{more}"));
        assert_eq!(summary(&place, "warnings"), ["", ""], "{more}");
    }
    // Also if the clip is lost, whose results then go.
    fs::create_dir(place.path("lib")).unwrap();
    fs::copy(here("data/kick.bvh"), place.path("lib/kick.bvh")).unwrap();
    place.done("batch lib/kick.bvh --out lost");
    fs::write(place.path("lost/clips/kick.bvh/notes.txt"), "mine").unwrap();
    fs::write(place.path("lib/kick.bvh"), "no motion").unwrap();
    place.refused(1, "batch lib/kick.bvh --out lost --force");
    assert_eq!(read(&place, "lost/clips/kick.bvh/notes.txt"), "mine");
    assert!(!place.path("lost/clips/kick.bvh/sheet.json").exists());
}

#[test]
fn a_run_leaves_the_folders_of_a_batch_alone() {
    let place = Place::new();
    place.done(BATCH);
    let before = results(&place, "out");
    for more in ["", " --force"] {
        let said =
            place.refused(2, &format!("run data/kick.bvh --pin 20 --out out/clips/kick.bvh{more}"));
        assert!(said.contains("correct it by a table of the batch"), "{said}");
    }
    assert_eq!(results(&place, "out"), before);
    // Another folder of that name is no batch.
    fs::create_dir_all(place.path("mine/clips")).unwrap();
    place.done("run data/kick.bvh --out mine/clips/kick");
}

#[cfg(unix)]
#[test]
fn links_that_a_person_made_are_left_alone() {
    let place = Place::new();
    place.done(BATCH);
    fs::write(place.path("film.mov"), "a film").unwrap();
    let link = place.path("out/clips/kick.bvh/film.mov");
    std::os::unix::fs::symlink("../../../film.mov", &link).unwrap();
    place.done(&format!("{BATCH} --set spacing.on=3 --force"));
    assert!(link.is_symlink());
    assert_eq!(fs::read_to_string(link).unwrap(), "a film");
}

#[test]
fn a_file_in_the_way_of_a_result_is_protected() {
    let place = Place::new();
    for (file, is_folder) in [("sheet.json", false), ("sheet.json", true), ("images", false)] {
        let out = format!("{}-{is_folder}", file.replace('.', "-"));
        let at = format!("{out}/clips/kick.bvh/{file}");
        let folder = place.path(&at).parent().unwrap().to_owned();
        fs::create_dir_all(folder).unwrap();
        match is_folder {
            true => fs::create_dir(place.path(&at)).unwrap(),
            false => fs::write(place.path(&at), "mine").unwrap(),
        }
        let (exit, said) =
            code(&place, &format!("batch data/kick.bvh --deliver json,images --out {out}"));
        assert_eq!(exit, 1, "{file}: {said}");
        assert!(said.contains(&format!("1 of 1 failed: {at}: ")), "{file}: {said}");
        assert!(said.contains("would be lost") || said.contains("in the way"), "{said}");
        assert_eq!(place.path(&at).is_dir(), is_folder);
        assert!(is_folder || read(&place, &at) == "mine");
    }
}

#[test]
fn a_clip_whose_sheet_a_person_edited_stays_done() {
    let place = Place::new();
    place.done(BATCH);
    let before = results(&place, "out");
    fs::write(place.path(SHEET), "mine").unwrap();
    let is_kept = |args: &str| {
        let (exit, said) = code(&place, args);
        assert_eq!(exit, 0, "{args}: {said}");
        assert!(said.contains("kept, as changed by a person: kick.bvh: sheet.json"), "{said}");
        assert_eq!(read(&place, SHEET), "mine", "{args}");
        assert_eq!(summary(&place, "status"), ["done", "done"], "{args}");
        assert_eq!(summary(&place, "warnings"), ["W_EDITED", ""], "{args}");
        assert!(summary(&place, "message")[0].contains("sheet.json"), "{args}");
        assert!(results(&place, "out")["keys.csv"] == before["keys.csv"], "{args}");
    };
    let journal = || read(&place, "out/batch.jsonl").lines().count();
    is_kept(BATCH);
    let lines = journal();
    is_kept(BATCH);
    assert_eq!(journal(), lines, "nothing new is known");
    // A format more writes the same sheet again, and so nothing over the edited one.
    is_kept(&format!("{BATCH} --deliver xdts"));
    assert!(place.path("out/clips/kick.bvh/kick_genga_ts.xdts").is_file());
    is_kept(BATCH);
    // With other settings the sheet would be lost.
    let other = format!("{BATCH} --set spacing.on=3");
    for _ in 0..2 {
        let (exit, said) = code(&place, &other);
        assert_eq!(exit, 1, "{said}");
        assert!(said.contains("1 of 2 failed: ") && said.contains(&format!("{SHEET}: ")), "{said}");
        assert!(said.contains(&format!("--overwrite {SHEET}")), "{said}");
        assert!(!said.contains("--force"), "{said}");
    }
    is_kept(BATCH);
    // The way out that was named is of this clip alone.
    let pitch = place.path("out/clips/pitch.bvh/sheet.json");
    let made = || fs::metadata(&pitch).unwrap().modified().unwrap();
    let at = made();
    place.done(&format!("{BATCH} --overwrite {SHEET}"));
    assert_eq!(made(), at, "the other clip is not done again");
    assert_eq!(read(&place, SHEET).as_bytes(), before["clips/kick.bvh/sheet.json"]);
    fs::write(place.path(SHEET), "mine").unwrap();
    place.done(&format!("{BATCH} --set spacing.on=3 --renumber --overwrite {SHEET}"));
    place.done(&other.replace("--out out", "--out fresh"));
    assert!(numbered(&place, "out") == numbered(&place, "fresh"));
}

#[test]
fn an_edited_file_that_is_no_longer_asked_for_stays() {
    let place = Place::new();
    place.done(BATCH);
    fs::write(place.path(SHEET), "mine").unwrap();
    for more in ["", " --force"] {
        place.done(&format!("batch data/kick.bvh data/pitch.bvh --deliver xdts --out out{more}"));
        assert_eq!(read(&place, SHEET), "mine");
        assert_eq!(summary(&place, "warnings"), ["W_EDITED", ""]);
        assert!(!place.path("out/clips/kick.bvh/sheet.svg").exists());
        assert!(!place.path("out/clips/pitch.bvh/sheet.json").exists());
    }
}

#[test]
fn force_writes_over_an_edited_sheet_with_the_same_settings_too() {
    let place = Place::new();
    place.done(BATCH);
    let before = results(&place, "out");
    fs::write(place.path(SHEET), "mine").unwrap();
    place.done(&format!("{BATCH} --force"));
    assert!(results(&place, "out") == before);
}

#[test]
fn a_table_that_no_batch_wrote_is_protected() {
    let place = Place::new();
    place.done("run data/kick.bvh --out out");
    let keys = read(&place, "out/keys.csv");
    let said = place.refused(2, BATCH);
    assert!(said.contains("out/keys.csv: this table is not as a batch wrote it"), "{said}");
    assert_eq!(read(&place, "out/keys.csv"), keys);
    place.done(&format!("{BATCH} --force"));
    for table in ["keys.csv", "times.csv", "summary.csv"] {
        let path = place.path("out").join(table);
        let (before, at) = (fs::read(&path).unwrap(), format!("out/{table}: "));
        fs::write(&path, "my own,table\n1,2\n").unwrap();
        for args in [BATCH, "batch --join out --out out"] {
            let said = place.refused(2, args);
            assert!(said.contains(&at), "{args}: {said}");
        }
        fs::write(&path, before).unwrap();
        place.done(BATCH);
    }
    // A batch whose clips all failed has no keys.
    fs::write(place.path("bad.bvh"), "no motion").unwrap();
    for _ in 0..2 {
        place.refused(1, "batch bad.bvh --out bad");
    }
    assert_eq!(read(&place, "bad/keys.csv"), "");
}

const DRAWN: &str = "batch data/kick.bvh --deliver json,csv,images --out out";
const CLIP: &str = "out/clips/kick.bvh";

/// Paints on a drawing of a clip, of which the batch before has one more or less in front of it.
fn paint(place: &Place, folder: &str) -> String {
    let painted = format!("{folder}/clips/kick.bvh/images/A_0020.png");
    assert!(place.path(&painted).is_file());
    fs::write(place.path(&painted), "painted").unwrap();
    painted
}

#[test]
fn a_batch_keeps_the_numbers_of_drawings_as_a_run_does() {
    let place = Place::new();
    place.done(DRAWN);
    let first = numbers(&place, CLIP);
    let painted = paint(&place, "out");
    let other = format!("{DRAWN} --set spacing.on=2");
    place.done(&other);
    check(&place, CLIP, &first);
    assert_eq!(read(&place, &painted), "painted");
    let table = read(&place, &format!("{CLIP}/numbers.csv"));
    let [old, new] = ["old", "new"].map(|name| column(&table, name));
    let kept = old.iter().zip(&new).filter(|(old, new)| !old.is_empty() && !new.is_empty());
    assert!(kept.clone().count() > 1 && kept.clone().all(|(old, new)| old == new), "{table}");
    // Nothing is left to do, and a clip that failed in between has its numbers again.
    let second = numbers(&place, CLIP);
    let done = fs::metadata(place.path(&format!("{CLIP}/drawings.csv"))).unwrap().modified();
    place.done(&other);
    let again = fs::metadata(place.path(&format!("{CLIP}/drawings.csv"))).unwrap().modified();
    assert_eq!(done.unwrap(), again.unwrap());
    fs::write(place.path(&format!("{CLIP}/drawings.csv")), "mine").unwrap();
    place.refused(1, DRAWN);
    fs::remove_file(place.path(&format!("{CLIP}/drawings.csv"))).unwrap();
    place.done(DRAWN);
    check(&place, CLIP, &second);
    check(&place, CLIP, &first);
}

#[test]
fn numbers_begin_at_1_if_that_is_asked_for_and_no_picture_is_lost() {
    let place = Place::new();
    let other = format!("{DRAWN} --set spacing.on=2");
    place.done(&other.replace("--out out", "--out fresh"));
    place.done(DRAWN);
    place.done(&other);
    let painted = paint(&place, "out");
    for _ in 0..2 {
        let said = place.refused(1, &format!("{other} --renumber"));
        assert!(said.contains(&format!("{painted}: ")), "{said}");
        assert!(said.contains(&format!("--overwrite {painted}")), "{said}");
        assert_eq!(read(&place, &painted), "painted");
    }
    place.done(&format!("{other} --renumber --overwrite {painted}"));
    let mut files = place.files(CLIP);
    files.remove("numbers.csv");
    assert!(files == place.files("fresh/clips/kick.bvh"));
    let before = place.files(CLIP);
    place.done(&other);
    assert!(place.files(CLIP) == before, "they stay so");
}

#[test]
fn a_painted_picture_whose_number_cannot_be_kept_fails_its_clip() {
    let place = Place::new();
    let batch = "batch data/kick.bvh data/pitch.bvh --deliver images --out out";
    place.done(batch);
    let painted = paint(&place, "out");
    let other = format!("{batch} --set spacing.on=2");
    for _ in 0..2 {
        let said = place.refused(1, &other);
        assert!(said.contains(&format!("1 of 2 failed: {painted}: ")), "{said}");
        assert!(said.contains(&format!("--overwrite {painted}")), "{said}");
        assert_eq!(read(&place, &painted), "painted");
    }
    assert_eq!(summary(&place, "status"), ["failed", "done"]);
    place.done(batch);
    assert_eq!(summary(&place, "warnings"), ["W_PAINTED", ""]);
    place.done(&format!("{other} --overwrite {painted}"));
    place.done(&other.replace("--out out", "--out fresh"));
    assert!(results(&place, "out") == results(&place, "fresh"));
}

#[test]
fn folders_of_no_clip_of_the_batch_stay_and_are_told() {
    let place = Place::new();
    for name in ["a/kick.bvh", "a/Pitch.bvh", "b/kick.bvh", "b/swing.bvh"] {
        let from = name[2..].to_lowercase();
        fs::create_dir_all(place.path("lib").join(&name[..1])).unwrap();
        let path = place.path("lib").join(name);
        fs::copy(crate::clips::here(&format!("data/{from}")), path).unwrap();
    }
    let batch = "batch lib --deliver json,cut --out out";
    assert!(!place.said(batch).contains("of no clip"));
    assert!(!place.said(batch).contains("of no clip"));
    fs::remove_file(place.path("lib/b/swing.bvh")).unwrap();
    fs::rename(place.path("lib/a/Pitch.bvh"), place.path("lib/a/pitch.bvh")).unwrap();
    let said = place.said(batch);
    let says =
        "2 folders in out/clips of no clip of this batch, which stay: a/Pitch.bvh b/swing.bvh\n";
    assert!(said.contains(says), "{said}");
    // Of one folder alone, the clips have other names.
    let said = place.said("batch lib/b --out out");
    let says = "2 folders in out/clips of no clip of this batch, which stay: a b\n";
    assert!(said.contains(says), "{said}");
    let said = place.said("batch lib --out out --shard 1/2");
    assert!(!said.contains("of no clip"), "{said}");
    assert!(place.path("out/clips/b/swing.bvh/sheet.json").exists());
}
