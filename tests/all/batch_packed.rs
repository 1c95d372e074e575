//! One archive instead of a folder per clip: the same files, and the same bytes whatever happens on the way.

use std::fs;

#[cfg(unix)]
use crate::batch::killed_again_and_again;
use crate::batch::{code, library, results};
use crate::folders::all;
use crate::program::{Place, text};

#[test]
fn an_archive_has_the_files_that_folders_have() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out folders --deliver json,xdts");
    let (exit, said) = code(&place, "batch lib --out out --deliver json,xdts --pack");
    assert_eq!(exit, 1, "the broken are broken: {said}");
    let files = results(&place, "out");
    let names: Vec<&str> = files.keys().map(String::as_str).collect();
    assert_eq!(names, ["clips.zip", "keys.csv", "summary.csv"]);
    let unpacked = std::process::Command::new("python3")
        .args(["-m", "zipfile", "-e", "clips.zip", "."])
        .current_dir(place.path("out"))
        .output();
    let Ok(output) = unpacked else {
        return crate::clips::without("python3");
    };
    assert!(output.status.success(), "{}", text(&output.stderr));
    let mut unpacked = results(&place, "out");
    unpacked.remove("clips.zip");
    assert_eq!(unpacked, results(&place, "folders"));
}

#[test]
fn what_is_packed_is_not_done_again_and_what_changed_is() {
    let place = Place::new();
    library(&place);
    let args = "batch lib --out out --pack";
    code(&place, args);
    let first = results(&place, "out");
    let lines = || fs::read_to_string(place.path("out/batch.jsonl")).unwrap().lines().count();
    let before = lines();
    code(&place, args);
    // The two broken clips are tried again.
    assert_eq!((results(&place, "out"), lines()), (first.clone(), before + 2));
    fs::copy(place.path("lib/a/tennis.bvh"), place.path("lib/a/kick.bvh")).unwrap();
    code(&place, args);
    assert_eq!(lines(), before + 5);
    code(&place, "batch lib --out fresh --pack");
    assert_eq!(results(&place, "out"), results(&place, "fresh"));
    assert_ne!(results(&place, "out")["clips.zip"], first["clips.zip"]);
    // Without its archive a clip is done again.
    fs::remove_file(place.path("out/clips.zip")).unwrap();
    code(&place, args);
    assert_eq!(results(&place, "out"), results(&place, "fresh"));
}

#[test]
fn an_archive_that_no_batch_wrote_is_kept() {
    let place = Place::new();
    library(&place);
    fs::create_dir(place.path("out")).unwrap();
    fs::write(place.path("out/clips.zip"), "PK, but a person's own archive of something").unwrap();
    let said = place.refused(2, "batch lib/a --out out --pack");
    assert!(said.contains("clips.zip: this archive is not as a batch wrote it"), "{said}");
    place.done("batch lib/a --out out --pack --force");
    place.done("batch lib/a --out fresh --pack --force");
    assert_eq!(results(&place, "out"), results(&place, "fresh"));
}

#[cfg(unix)]
#[test]
fn killed_at_any_time_and_begun_again_it_is_the_same_archive() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out whole --deliver json,bars --pack");
    let args = "batch lib --out killed --deliver json,bars --pack";
    killed_again_and_again(&place, args, || {
        fs::remove_file(place.path("killed/clips.zip")).ok();
        // Leaves half an entry, as a crash does.
        let spool = place.path("killed/clips.spool");
        if let Ok(bytes) = fs::read(&spool) {
            fs::write(&spool, &bytes[..bytes.len() * 2 / 3]).unwrap();
        }
    });
    code(&place, args);
    assert_eq!(results(&place, "killed"), results(&place, "whole"));
}

#[test]
fn archives_of_parts_are_joined_to_that_of_one_machine() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib --out whole --pack");
    for part in 1..=3 {
        code(&place, &format!("batch lib --out parts --pack --shard {part}/3"));
        assert!(place.path(&format!("parts/clips-{part}-of-3.zip")).exists());
    }
    code(&place, "batch --join parts --out joined");
    assert_eq!(all(&place.path("joined"))["clips.zip"], results(&place, "whole")["clips.zip"]);
    fs::remove_file(place.path("parts/clips-2-of-3.zip")).unwrap();
    let said = place.refused(1, "batch --join parts --out again");
    assert!(said.contains("is in no archive of these parts; do them again with --pack"), "{said}");
}
