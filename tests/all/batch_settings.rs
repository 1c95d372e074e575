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
