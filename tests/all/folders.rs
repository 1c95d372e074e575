//! A results folder is one run: a person's files stay, outdated ones go, and new ones come together.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use genga_files::Manifest;

use crate::cases::is_full;
use crate::clips::here;
use crate::program::{Place, column, text};

/// Every file of a folder and its subfolders, by path.
pub(crate) fn all(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            let inside = all(&path).into_iter();
            found.extend(inside.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            found.insert(name, fs::read(path).unwrap());
        }
    }
    found
}

fn change(place: &Place, name: &str) -> Vec<u8> {
    // A comment in a recipe, which is read again.
    let changed = [fs::read(place.path(name)).unwrap(), b"# mine".to_vec()].concat();
    fs::write(place.path(name), &changed).unwrap();
    changed
}

/// Checks that the manifest of a folder lists exactly the files that are there, byte by byte.
fn check_manifest(place: &Place, folder: &str) {
    let mut files = all(&place.path(folder));
    let text = String::from_utf8(files.remove("manifest.json").unwrap()).unwrap();
    let manifest = Manifest::read(&text).unwrap();
    let there: BTreeMap<_, _> =
        files.iter().map(|(name, bytes)| (name.clone(), Manifest::digest(bytes))).collect();
    assert_eq!(manifest.files, there);
}

#[test]
fn what_a_run_does_not_write_again_is_gone() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts,images --out a");
    check_manifest(&place, "a");
    assert!(place.path("a/kick_genga_ts.xdts").is_file() && place.path("a/images").is_dir());
    let said = place.said("run data/kick.bvh --keys 8 --fresh --out a");
    assert!(said.contains("of an earlier run, removed: "), "{said}");
    assert!(
        ["kick_genga_ts.xdts", "images/A_0001.png"].iter().all(|file| said.contains(file)),
        "{said}"
    );
    place.done("run data/kick.bvh --keys 8 --out fresh");
    assert_eq!(all(&place.path("a")), all(&place.path("fresh")), "as if nothing had been there");
    assert!(!place.path("a/images").exists(), "no empty folder either");
    check_manifest(&place, "a");
    let rows = column(&text(&place.files("a")["keys.csv"]), "genga_no").len();
    assert_eq!(rows, 8);
}

/// The formats of a folder would keep the old timing otherwise, or be gone.
#[test]
fn a_run_that_names_no_format_writes_those_of_its_folder_again() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts,glb --out a");
    let before = all(&place.path("a"));
    let said = place.said("run data/kick.bvh --pin 61 --out a");
    assert!(said.contains("as the folder has them: glb, xdts ("), "{said}");
    place.done("run data/kick.bvh --out b");
    place.done("run data/kick.bvh --pin 61 --deliver xdts,glb --out b");
    let (again, asked) = (all(&place.path("a")), all(&place.path("b")));
    let file = "kick_genga_ts.xdts";
    assert!(again[file] == asked[file] && again[file] != before[file]);
    assert_eq!(again.keys().collect::<Vec<_>>(), asked.keys().collect::<Vec<_>>());
    check_manifest(&place, "a");
    // Named formats are those of the folder from there on, and a BVH is one too.
    let said = place.said("run data/kick.bvh --bvh keys --out a");
    assert!(said.contains("removed: ") && said.contains("limited.glb"), "{said}");
    let said = place.said("run data/kick.bvh --keys 8 --out a");
    assert!(said.contains("as the folder has them: bvh-keys ("), "{said}");
    assert!(!place.said("run data/kick.bvh --fresh --out a").contains("as the folder has"));
    // A marked timesheet is read, and not written over.
    place.done("run data/kick.bvh --deliver xdts --out d");
    let said = place.said("run data/kick.bvh --pin-from d/kick_genga_ts.xdts --out d");
    let told =
        "xdts is not written again, because this run reads d/kick_genga_ts.xdts; --deliver xdts ";
    assert!(said.contains(told), "{said}");
    // A format that is read from its own place would be lost.
    place.done("run data/kick.bvh --bvh stepped --out c");
    let said = place.refused(2, "run c/limited.bvh --out c");
    assert!(said.contains("c/limited.bvh") || said.contains("another clip"), "{said}");
}

#[test]
fn settings_of_formats_stay_with_them() {
    let place = Place::new();
    let with = "--with remap.pictures=shot_%04d.png --with csv.bom=true --camera front";
    place.done(&format!("run data/kick.bvh --deliver contact {with} --out a"));
    let said = place.said("run data/kick.bvh --pin 61 --out a");
    let kept = "--camera front --with csv.bom=true --with remap.pictures=shot_%04d.png\n";
    assert!(said.contains(kept), "{said}");
    place.done("run data/kick.bvh --out b");
    place.done(&format!("run data/kick.bvh --pin 61 --deliver contact {with} --out b"));
    assert_eq!(all(&place.path("a")), all(&place.path("b")));
    // One that is given goes over it, for a delivery too.
    place.done("deliver a data/kick.bvh --to remap --with remap.pictures=%04d.png --out a");
    let list = text(&place.files("a")["remap.ffconcat"]);
    assert!(!list.contains("shot_"), "{list}");
    // What a delivery sets back to the default stays so.
    place.done("run data/kick.bvh --pin 62 --out a");
    let list = text(&place.files("a")["remap.ffconcat"]);
    assert!(!list.contains("shot_"), "{list}");
    place.done("run data/kick.bvh --fresh --out a");
    place.done("run data/kick.bvh --out c");
    assert_eq!(all(&place.path("a")), all(&place.path("c")));
}

#[test]
fn a_changed_file_of_an_earlier_sheet_is_named_by_every_run() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out a");
    change(&place, "a/kick_genga_ts.xdts");
    let told = "not of this sheet, kept because they were changed since: kick_genga_ts.xdts";
    for args in ["--pin 61 --deliver json", "--pin 62"] {
        let said = place.said(&format!("run data/kick.bvh {args} --out a"));
        assert!(said.contains(told), "{args}: {said}");
    }
}

/// A line is deleted to take a correction back. Later runs write the recipe again.
#[test]
fn a_recipe_from_which_a_line_was_deleted_is_not_in_the_way() {
    let place = Place::new();
    place.done("run data/kick.bvh --pin 61 --forbid 20 --out a");
    let recipe = text(&place.files("a")["recipe.toml"]);
    let lines: Vec<&str> = recipe.lines().filter(|line| !line.starts_with("forbidden")).collect();
    assert!(lines.len() < recipe.lines().count());
    fs::write(place.path("a/recipe.toml"), lines.join("\n") + "\n").unwrap();
    place.done("run data/kick.bvh --recipe a/recipe.toml --out a");
    let said = place.said("run data/kick.bvh --pin 42 --out a");
    assert!(
        said.contains("pin 42") && said.contains("pin 61") && !said.contains("forbid"),
        "{said}"
    );
    // Also the last correction.
    place.done("run data/kick.bvh --pin 61 --out b");
    let recipe = text(&place.files("b")["recipe.toml"]).replace("[[edits.pins]]\nframe = 61\n", "");
    fs::write(place.path("b/recipe.toml"), recipe).unwrap();
    place.done("run data/kick.bvh --recipe b/recipe.toml --out b");
    let said = place.said("run data/kick.bvh --pin 42 --out b");
    assert!(said.contains("pin 42") && !said.contains("pin 61"), "{said}");
    // A person's own comment stays, also one that is part of a comment of genga's.
    for comment in ["# for the director", "# keys"] {
        let noted = format!("{}{comment}\n", text(&place.files("a")["recipe.toml"]));
        fs::write(place.path("a/recipe.toml"), &noted).unwrap();
        place.done("run data/kick.bvh --recipe a/recipe.toml --out a");
        assert!(text(&place.files("a")["recipe.toml"]) == noted, "{comment}");
    }
}

/// Small moves may carry a number far from the pose that was painted.
#[test]
fn a_painted_picture_of_an_older_pose_is_told_by_every_run() {
    let place = Place::new();
    let images = "--deliver images --with images.width=160 --with images.height=90";
    place.done(&format!("run data/kuroda-pitch.bvh {images} --out a"));
    let table = text(&place.files("a")["keys.csv"]);
    let frame: usize = column(&table, "source_frame")[3].parse().unwrap();
    let name = format!("images/A_{:0>4}.png", column(&table, "drawing")[3]);
    change(&place, &format!("a/{name}"));
    let told = format!(
        "but would be drawn otherwise now, in pose or framing (--overwrite NAME does): {name}"
    );
    let same = place.said("run data/kuroda-pitch.bvh --out a");
    assert!(same.contains(&format!("not written again (--overwrite NAME does): {name}")), "{same}");
    for args in [format!("--move {frame}:{}", frame + 1), String::new()] {
        let said = place.said(&format!("run data/kuroda-pitch.bvh {args} --out a"));
        assert!(said.contains(&told), "{said}");
    }
    let said = place.said(&format!("run data/kuroda-pitch.bvh --overwrite {name} --out a"));
    assert!(!said.contains("painted"), "{said}");
}

#[test]
fn a_file_that_a_run_reads_is_not_removed() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out a");
    let said = place.said("run data/kick.bvh --pin-from a/kick_genga_ts.xdts --out a");
    let told = "not of this sheet, kept because this run reads it: kick_genga_ts.xdts";
    assert!(said.contains(told), "{said}");
    assert!(place.path("a/kick_genga_ts.xdts").is_file());
}

#[test]
fn settings_that_stay_and_do_not_fit_name_their_recipe() {
    let place = Place::new();
    place.done("run data/kick.bvh --layers limbs --set B/spacing.on=3 --out a");
    place.done("run data/kick.bvh --within 20..40:spacing.on=1 --out b");
    for (args, says) in [
        ("run data/kick.bvh --layers body --out a", "there is no layer B to set"),
        ("run data/kick.bvh --trim 50..80 --out b", "is not in the clip"),
    ] {
        let said = place.refused(2, args);
        let from = format!(
            "settings stay from {}/recipe.toml, and --fresh goes without them",
            &args[args.len() - 1..]
        );
        assert!(said.contains(says) && said.contains(&from), "{said}");
    }
}

/// Of an edited sheet only what is delivered has the new timing.
#[test]
fn a_delivery_of_an_edited_sheet_says_what_keeps_the_old_timing() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts,glb --out a");
    assert!(!place.said("deliver a data/kick.bvh --to xdts").contains("edited"));
    let sheet = text(&place.files("a")["sheet.json"]);
    let longer = sheet.replace("{\"drawing\": 1, \"koma\": 10}", "{\"drawing\": 1, \"koma\": 12}");
    assert!(longer != sheet);
    fs::write(place.path("a/sheet.json"), longer).unwrap();
    let said = place.said("deliver a data/kick.bvh --to xdts");
    let way = said.lines().find(|line| line.contains("the sheet was edited")).unwrap();
    assert!(way.contains("csv,glb,") && !way.contains("xdts"), "{said}");
}

#[test]
fn what_a_person_changed_is_kept_and_named() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts,images --out a");
    let painted = change(&place, "a/images/A_0003.png");
    fs::write(place.path("a/images/sketch.png"), "mine").unwrap();
    let said = place.said("run data/kick.bvh --keys 8 --deliver json --out a");
    assert!(said.contains("kept because they were changed since: images/A_0003.png"), "{said}");
    assert!(!place.path("a/images/A_0001.png").exists());
    assert_eq!(fs::read(place.path("a/images/A_0003.png")).unwrap(), painted);
    assert_eq!(fs::read(place.path("a/images/sketch.png")).unwrap(), b"mine");
}

/// A folder may come from anyone: its manifest must not reach into another folder.
#[cfg(unix)]
#[test]
fn what_a_link_leads_to_is_not_removed() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver images --out a");
    fs::rename(place.path("a/images"), place.path("elsewhere")).unwrap();
    std::os::unix::fs::symlink("../elsewhere", place.path("a/images")).unwrap();
    let before = all(&place.path("elsewhere"));
    let said = place.said("run data/kick.bvh --deliver json --out a");
    assert!(said.contains("kept because a link leads to them: images/A_0001.png"), "{said}");
    assert_eq!(all(&place.path("elsewhere")), before);
}

#[test]
fn nothing_that_a_person_changed_is_written_over_unless_forced() {
    let place = Place::new();
    let images = "--deliver images --with images.width=160 --with images.height=90";
    place.done(&format!("run data/kick.bvh {images} --out a"));
    let names = ["keys.csv", "sheet.json", "recipe.toml", "sheet.csv"];
    for name in names.into_iter().take(if is_full() { 4 } else { 2 }) {
        let file = format!("a/{name}");
        let written = fs::read(place.path(&file)).unwrap();
        let changed = change(&place, &file);
        let before = all(&place.path("a"));
        for args in [
            format!("run data/kick.bvh {images} --keys 8 --out a"),
            format!("run data/kick.bvh {images} --out a"),
        ] {
            let said = place.refused(2, &args);
            assert!(said.contains(&file) && said.contains("as a run wrote it"), "{said}");
            assert!(said.contains("--out") && said.contains("--force"), "{said}");
            assert_eq!(all(&place.path("a")), before, "{args}");
        }
        place.done(&format!("run data/kick.bvh {images} --out a --force"));
        assert_ne!(fs::read(place.path(&file)).unwrap(), changed);
        assert_eq!(fs::read(place.path(&file)).unwrap(), written);
    }
    // A recipe that cannot be read says how to go without its corrections.
    fs::write(place.path("a/recipe.toml"), "mine").unwrap();
    let said = place.refused(2, "run data/kick.bvh --out a --force");
    assert!(said.contains("a/recipe.toml:1:5") && said.contains("--fresh"), "{said}");
    place.done(&format!("run data/kick.bvh {images} --out a --force --fresh"));
    // Deliver spares changed files as well, and unknown ones too.
    change(&place, "a/keys.csv");
    let said = place.refused(2, "deliver a/sheet.json data/kick.bvh --to csv");
    assert!(said.contains("a/keys.csv") && said.contains("--force"), "{said}");
    fs::create_dir(place.path("b")).unwrap();
    fs::write(place.path("b/keys.csv"), "mine").unwrap();
    assert!(place.refused(2, "run data/kick.bvh --out b").contains("b/keys.csv"));
    assert_eq!(all(&place.path("b")).len(), 1);
}

#[test]
fn a_painted_picture_stays_unless_it_is_named() {
    let place = Place::new();
    let images = "--deliver images --with images.width=160 --with images.height=90";
    place.done(&format!("run data/kick.bvh {images} --out a"));
    let painted = change(&place, "a/images/A_0003.png");
    let chart = change(&place, "a/sheet.svg");
    let stays = || fs::read(place.path("a/images/A_0003.png")).unwrap() == painted;
    let note = |said: &str| {
        let line = said.lines().find(|line| line.contains("painted, kept")).unwrap_or_default();
        line.contains("--overwrite NAME") && line.contains("): images/A_0003.png")
    };
    for args in ["--keys 8 --renumber", "--keys 8 --force", "--renumber"] {
        let said = place.said(&format!("run data/kick.bvh {images} {args} --out a"));
        assert!(note(&said) && stays(), "{args}: {said}");
    }
    let deliver = "deliver a/sheet.json data/kick.bvh --to images --with images.width=200";
    assert!(note(&place.said(deliver)) && stays());
    // A sheet with fewer drawings, then one with more.
    place.done("run data/kick.bvh --pin 20 --only-pins --out a");
    assert!(stays());
    assert!(note(&place.said(&format!("run data/kick.bvh {images} --fresh --out a"))));
    assert!(stays());
    // Its name, in the folder or from here, is the way out; other pictures stay.
    let none = place.refused(2, &format!("run data/kick.bvh {images} --overwrite B_1.png --out a"));
    assert!(none.contains("--overwrite B_1.png: this run writes no such file"), "{none}");
    place.done(&format!("run data/kick.bvh {images} --overwrite a/images --out a"));
    place.done(&format!("run data/kick.bvh {images} --out plain"));
    assert!(!stays());
    assert_eq!(fs::read(place.path("a/sheet.svg")).unwrap(), chart);
    place.done(&format!("run data/kick.bvh {images} --overwrite sheet.svg --out a"));
    assert_eq!(all(&place.path("a")), all(&place.path("plain")));
}

#[test]
fn a_manifest_that_was_changed_vouches_for_nothing() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    change(&place, "a/manifest.json");
    let said = place.refused(2, "run data/kick.bvh --keys 8 --out a");
    assert!(said.contains("manifest.json") && said.contains("--force"), "{said}");
    // Which pictures were painted is not known any more, so that all of another sheet stay.
    let forced = place.said("run data/kick.bvh --keys 8 --out a --force");
    assert!(forced.contains("NAME does): poses.svg sheet.svg speed.svg"), "{forced}");
    place.done("run data/kick.bvh --keys 8 --out a --overwrite a");
    check_manifest(&place, "a");
}

#[test]
fn a_folder_of_another_clip_is_refused() {
    let place = Place::new();
    for (folder, clip) in [("a", "kick"), ("b", "pitch")] {
        fs::create_dir(place.path(folder)).unwrap();
        let walk = place.path(folder).join("walk.bvh");
        fs::copy(here("data").join(clip).with_extension("bvh"), walk).unwrap();
    }
    place.done("run a/walk.bvh");
    let before = all(&place.path("walk-genga"));
    let said = place.refused(2, "run b/walk.bvh");
    assert!(said.contains("walk-genga: this folder is of another walk.bvh"), "{said}");
    assert!(said.contains("--out") && said.contains("--force"), "{said}");
    let said = place.refused(2, "run data/swing.bvh --out walk-genga");
    assert!(said.contains("is of another clip, walk.bvh"), "{said}");
    let said = place.refused(2, "deliver walk-genga/sheet.json data/pitch.bvh --to csv");
    assert!(said.contains("is of another clip, walk.bvh"), "{said}");
    assert_eq!(all(&place.path("walk-genga")), before);
    // A part of the clip belongs to the same clip.
    place.done("run a/walk.bvh --trim 10..60");
    place.done("run b/walk.bvh --force");
    check_manifest(&place, "walk-genga");
}

#[test]
fn a_manifest_is_the_same_on_every_machine() {
    let (one, other) = (Place::new(), Place::new());
    one.done("run data/kick.bvh --deliver images --out a");
    other.done("run data/kick.bvh --out somewhere/else");
    fs::copy(here("data/kick.bvh"), other.path("kick.bvh")).unwrap();
    other.done("run kick.bvh --deliver images --out somewhere/else");
    assert_eq!(all(&one.path("a")), all(&other.path("somewhere/else")));
}

#[test]
fn a_delivery_adds_to_the_run() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    place.done("deliver a/sheet.json data/kick.bvh --to xdts,images");
    check_manifest(&place, "a");
    // The next run knows the files that were delivered.
    place.done("run data/kick.bvh --keys 8 --deliver json --out a");
    assert!(!place.path("a/kick_genga_ts.xdts").exists());
    check_manifest(&place, "a");
}

#[test]
fn a_clip_that_ends_in_the_middle_of_a_row_says_so_when_quiet_too() {
    let place = Place::new();
    let kick = fs::read(here("data/kick.bvh")).unwrap();
    fs::write(place.path("cut.bvh"), &kick[..kick.len() - 20]).unwrap();
    let lost = "the file says 92 frames and has 91 complete frames and";
    for args in [
        "run cut.bvh --out a -q",
        "keys cut.bvh -q",
        "deliver a/sheet.json cut.bvh --to csv --out b -q",
    ] {
        let said = place.said(args);
        assert!(said.contains(lost), "{args}: {said}");
        assert_eq!(said.lines().count(), 1, "{said}");
    }
    assert!(text(&place.files("a")["report.json"]).contains(lost));
}

#[test]
fn a_forbidden_frame_without_a_key_near_it_is_said() {
    let place = Place::new();
    let said = place.said("run data/kick.bvh --forbid 3,55,60..66 --out a");
    let note = "no key is found near frame 3, so there was none to forbid";
    assert!(said.contains(note), "{said}");
    assert_eq!(said.matches("none to forbid").count(), 1, "{said}");
    assert!(text(&place.files("a")["report.json"]).contains(note));
    let said = text(&place.genga("keys data/kick.bvh --forbid 3").stderr);
    assert!(said.contains(note), "{said}");
}

/// Names in a folder, hidden ones too.
#[cfg(unix)]
fn names(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap();
    names.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect()
}

#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_leaves_the_old_files_or_the_new_and_nothing_else() {
    use std::process::Command;
    use std::time::Duration;

    let place = Place::new();
    place.done("run data/kick.bvh --out old");
    let run = "run data/kick.bvh --deliver images,strip --with images.width=640 --with images.height=360 --keys 8 --fresh --out";
    place.done(&format!("{run} new"));
    let (times, wait) = if is_full() { (18, 40) } else { (6, 120) };
    let (old, new) = (all(&place.path("old")), all(&place.path("new")));
    for (at, signal) in ["INT", "TERM", "KILL"].into_iter().cycle().take(times).enumerate() {
        let folder = if at % 2 == 0 { "a" } else { "fresh" };
        fs::remove_dir_all(place.path(folder)).ok();
        if folder == "a" {
            place.done("run data/kick.bvh --out a");
        }
        let mut child = place.begun(&format!("{run} {folder}"));
        std::thread::sleep(Duration::from_millis(at as u64 * wait));
        let pid = child.id().to_string();
        Command::new("kill").args(["-s", signal, &pid]).status().unwrap();
        child.wait().unwrap();
        let is_half = |name: &String| name.ends_with(".tmp");
        if signal == "KILL" {
            // The next run cleans up after a killed one.
            place.done(&format!("{run} {folder}"));
        }
        let top = names(&place.path("."));
        assert!(!top.iter().any(is_half), "{signal} {at}: {top:?}");
        if place.path(folder).exists() {
            let there = all(&place.path(folder));
            assert!(
                there == old && folder == "a" || there == new,
                "{signal} {at}: {:?}",
                there.keys()
            );
        }
    }
}

#[cfg(unix)]
#[test]
fn a_run_into_a_folder_that_another_run_writes_meanwhile_says_so() {
    let place = Place::new();
    place.done("run data/kick.bvh --out marked");
    let (keys, pipe) = (fs::read(place.path("marked/keys.csv")).unwrap(), place.path("marked.csv"));
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    for is_new in [true, false] {
        let genga = std::process::Command::new(env!("CARGO_BIN_EXE_genga"))
            .current_dir(place.path("."))
            .args(["run", &here("data/kick.bvh").to_string_lossy(), "--out", "two"])
            .args(["--pin-from", "marked.csv", "--set", "keys.min_price=9"])
            .stderr(std::process::Stdio::piped())
            .spawn()
            .unwrap();
        // While it waits for the marked keys, another run comes and goes.
        let mut marked = fs::OpenOptions::new().write(true).open(&pipe).unwrap();
        place.done("run data/kick.bvh --out two --set spacing.on=3 --force");
        std::io::Write::write_all(&mut marked, &keys).unwrap();
        drop(marked);
        let output = genga.wait_with_output().unwrap();
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{is_new}: {said}");
        assert!(said.contains("two: another run is at work in this folder"), "{is_new}: {said}");
        assert!(!said.contains("--force"), "{said}");
        let recipe = fs::read_to_string(place.path("two/recipe.toml")).unwrap();
        assert!(!recipe.contains("min_price = 9\n"), "that of the other run: {recipe}");
        place.done("run data/kick.bvh --out two --set spacing.on=4");
    }
    assert!(!names(&place.path(".")).iter().any(|name| name.ends_with(".tmp")));
}
