//! Trouble with large libraries: odd lists and names, a full disk, clips that come and go, two batches in one folder.

use std::fs;

use crate::batch::{code, library, results};
use crate::cases::is_full;
use crate::clips::here;
use crate::program::{Place, column, text};

fn kick() -> Vec<u8> {
    fs::read(here("data/kick.bvh")).unwrap()
}

#[test]
fn a_list_of_another_system_is_read() {
    let place = Place::new();
    fs::create_dir(place.path("lib")).unwrap();
    for name in ["a b.bvh", "歩き.bvh"] {
        fs::write(place.path("lib").join(name), kick()).unwrap();
    }
    let list = "\u{feff}lib/a b.bvh\r\n\r\nlib/歩き.bvh\r\n";
    fs::write(place.path("list.txt"), list).unwrap();
    place.done("batch @list.txt --out listed");
    assert_eq!(place.fed("batch - --out fed", list.as_bytes()).status.code(), Some(0));
    let table = "\u{feff}{\"clip\": \"lib/a b.bvh\"}\r\n{\"clip\": \"lib/歩き.bvh\"}\r\n";
    fs::write(place.path("list.jsonl"), table).unwrap();
    place.done("batch @list.jsonl --out table");
    place.done("batch lib --out walked");
    for folder in ["listed", "fed", "table"] {
        assert_eq!(results(&place, folder), results(&place, "walked"), "{folder}");
    }
    fs::write(place.path("none.txt"), "\u{feff}# nothing\r\n\r\n").unwrap();
    let said = place.refused(2, "batch @none.txt --out o");
    assert!(said.contains("there is no clip in @none.txt"), "{said}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_no_text_is_listed_and_found_again() {
    use std::os::unix::ffi::OsStrExt;
    let place = Place::new();
    fs::create_dir(place.path("lib")).unwrap();
    for name in [&b"walk\xff.bvh"[..], b"walk\xfe.bvh", b"run.bvh"] {
        fs::write(place.path("lib").join(std::ffi::OsStr::from_bytes(name)), kick()).unwrap();
    }
    let listed = place.genga("batch lib --out out --list").stdout;
    assert_eq!(listed, b"lib/run.bvh\nlib/walk\xfe.bvh\nlib/walk\xff.bvh\n");
    fs::write(place.path("list.txt"), listed).unwrap();
    place.done("batch @list.txt --out out");
    let files = results(&place, "out");
    for name in ["walk\u{fffd}.bvh", "walk\u{fffd}.bvh~2", "run.bvh"] {
        assert!(files.contains_key(&format!("clips/{name}/sheet.json")), "{name}");
    }
}

#[test]
fn names_that_differ_in_capitals_alone_have_folders_of_their_own() {
    let place = Place::new();
    for folder in ["a", "b"] {
        fs::create_dir(place.path(folder)).unwrap();
    }
    fs::write(place.path("a/Walk.bvh"), kick()).unwrap();
    fs::write(place.path("b/walk.bvh"), kick()).unwrap();
    fs::create_dir(place.path("lib")).unwrap();
    fs::write(place.path("list.txt"), "lib/Walk.bvh\nlib/walk.bvh\n").unwrap();
    fs::copy(place.path("a/Walk.bvh"), place.path("lib/Walk.bvh")).unwrap();
    fs::copy(place.path("b/walk.bvh"), place.path("lib/walk.bvh")).unwrap();
    place.done("batch @list.txt --out out");
    let files = results(&place, "out");
    assert!(files.contains_key("clips/Walk.bvh/sheet.json"));
    assert!(files.contains_key("clips/walk.bvh~2/sheet.json"), "{:?}", files.keys());
}

#[cfg(unix)]
#[test]
fn a_name_too_long_to_write_is_a_row_and_the_others_are_done() {
    let place = Place::new();
    fs::create_dir(place.path("lib")).unwrap();
    // The clip has 255 bytes in its name; CUT_genga_ts.xdts has more.
    let long = "x".repeat(251);
    for name in [&*long, "run"] {
        fs::write(place.path("lib").join(format!("{name}.bvh")), kick()).unwrap();
    }
    for again in ["", " again"] {
        let (exit, said) = code(&place, "batch lib --out out --deliver json,xdts");
        assert_eq!(exit, 1, "{said}{again}");
        assert!(said.contains("1 of 2 failed: "), "{said}{again}");
        assert!(place.path("out/clips/run.bvh/sheet.json").is_file());
    }
    let table = fs::read_to_string(place.path("out/summary.csv")).unwrap();
    assert!(table.contains("too long"), "{table}");
}

#[test]
fn a_journal_that_was_changed_is_not_believed() {
    let place = Place::new();
    fs::create_dir(place.path("lib")).unwrap();
    for name in ["a.bvh", "b.bvh"] {
        fs::write(place.path("lib").join(name), kick()).unwrap();
    }
    place.done("batch lib --out out");
    let first = results(&place, "out");
    let journal = place.path("out/batch.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    assert_eq!(text.matches("\"genga\":13").count(), 2, "{text}");
    fs::write(&journal, text.replacen("\"genga\":13", "\"genga\":99", 1)).unwrap();
    let said = place.refused(1, "batch --join out --out joined");
    assert!(said.contains("batch.jsonl: 1 line not as a batch wrote it"), "{said}");
    assert!(said.contains("1 of 2 clips not in these folders"), "{said}");
    let (exit, said) = code(&place, "batch lib --out out");
    assert_eq!(exit, 0, "{said}");
    assert!(said.contains("1 line not as a batch wrote it"), "{said}");
    assert_eq!(results(&place, "out"), first, "the clip was done again");
}

#[cfg(unix)]
#[test]
fn a_device_is_no_folder_of_results() {
    let place = Place::new();
    for command in ["run data/kick.bvh", "batch data/kick.bvh", "split data/kick.bvh"] {
        let said = place.refused(2, &format!("{command} --out /dev/null"));
        assert!(said.contains("writes a folder of files, not to /dev/null"), "{said}");
        let said = place.genga(&format!("{command} --out /dev/null/deep"));
        assert_eq!(text(&said.stderr), "genga: /dev/null: is a file; name a folder\n", "{command}");
    }
}

#[cfg(unix)]
#[test]
fn links_in_a_circle_end() {
    let place = Place::new();
    fs::create_dir_all(place.path("lib/a/b")).unwrap();
    fs::write(place.path("lib/a/kick.bvh"), kick()).unwrap();
    std::os::unix::fs::symlink("../..", place.path("lib/a/b/up")).unwrap();
    std::os::unix::fs::symlink("self", place.path("lib/self")).unwrap();
    std::os::unix::fs::symlink("gone.bvh", place.path("lib/dangling.bvh")).unwrap();
    let listed = text(&place.genga("batch lib --out out --list").stdout);
    assert_eq!(listed, "lib/a/kick.bvh\nlib/dangling.bvh\n");
    let (exit, said) = code(&place, "batch lib --out out");
    assert!(exit == 1 && said.contains("1 of 2 failed: lib/dangling.bvh: "), "{said}");
}

#[test]
fn two_batches_do_not_write_into_one_folder_at_once() {
    let place = Place::new();
    library(&place);
    code(&place, "batch lib/a --out out");
    let before = results(&place, "out");
    let other = fs::OpenOptions::new().append(true).open(place.path("out/batch.jsonl")).unwrap();
    other.lock().unwrap();
    let said = place.refused(1, "batch lib/a --out out --set spacing.on=3");
    assert!(said.contains("batch.jsonl: another batch is at work on this"), "{said}");
    drop(other);
    assert_eq!(results(&place, "out"), before);
    place.done("batch lib/a --out out --set spacing.on=3");
}

#[test]
fn a_clip_that_fails_is_named() {
    let place = Place::new();
    for name in ["kick.bvh", "pitch.bvh"] {
        fs::copy(crate::clips::here(&format!("data/{name}")), place.path(name)).unwrap();
    }
    for asked in [
        "kick.bvh --pin 900",
        "kick.bvh pitch.bvh --trim 900..1000",
        "kick.bvh pitch.bvh --set keys.weights.Hipps=0",
    ] {
        let (exit, said) = code(&place, &format!("batch {asked} --out out"));
        assert_eq!(exit, 1, "{asked}: {said}");
        let of = asked.matches(".bvh").count();
        assert!(said.contains(&format!("{of} of {of} failed: kick.bvh: ")), "{asked}: {said}");
        let messages = column(&text(&results(&place, "out")["summary.csv"]), "message");
        for (message, clip) in messages.iter().zip(["kick.bvh: ", "pitch.bvh: "]) {
            assert!(message.starts_with(clip), "{asked}: {message}");
            assert_eq!(message.matches(clip).count(), 1, "{asked}: {message}");
        }
    }
}

#[test]
fn a_clip_that_is_lost_is_a_row_and_comes_back() {
    let place = Place::new();
    library(&place);
    let (kick, tennis) = (place.path("lib/a/kick.bvh"), place.path("lib/a/tennis.bvh"));
    let list = place.genga("batch lib/a --out out --list").stdout;
    fs::write(place.path("list.txt"), list).unwrap();
    code(&place, "batch @list.txt --out whole");
    // One clip disappears between the list and its turn, one becomes another motion, and then both are back.
    let (moved, good) = (place.path("moved.bvh"), fs::read(&tennis).unwrap());
    fs::rename(&kick, &moved).unwrap();
    fs::copy(&moved, &tennis).unwrap();
    let (exit, said) = code(&place, "batch @list.txt --out out");
    assert!(exit == 1 && said.contains("1 of 4 failed: lib/a/kick.bvh: "), "{said}");
    assert!(text(&results(&place, "out")["summary.csv"]).contains("kick.bvh,failed,"));
    fs::rename(&moved, &kick).unwrap();
    fs::write(&tennis, good).unwrap();
    let (exit, said) = code(&place, "batch @list.txt --out out");
    assert_eq!(exit, 0, "{said}");
    assert_eq!(results(&place, "out"), results(&place, "whole"));
}

/// A file size limit acts as a full disk for the largest file: the journal, the archive, or a model.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_stops_a_batch_and_the_next_ends_as_if_undisturbed() {
    let place = Place::new();
    library(&place);
    for more in ["", " --deliver json,xdts,bars", " --deliver glb", " --pack"] {
        code(&place, &format!("batch lib --out whole{more}"));
        let blocks: &[usize] = if is_full() { &[0, 1, 8, 16, 32] } else { &[0, 8, 32] };
        for blocks in blocks {
            let command = format!(
                "trap '' XFSZ; ulimit -f {blocks}; exec '{}' batch lib --out full{more} --jobs 2",
                env!("CARGO_BIN_EXE_genga")
            );
            let output = std::process::Command::new("sh")
                .args(["-c", &command])
                .current_dir(place.path("."))
                .output()
                .unwrap();
            let said = text(&output.stderr);
            assert_eq!(output.status.code(), Some(1), "{blocks}: {said}");
            assert!(said.contains("File too large"), "{blocks}: {said}");
            assert!(!said.contains("genga failed on this clip"), "{said}");
            assert!(!said.contains(" failed: "), "it is no fault of a clip: {said}");
        }
        code(&place, &format!("batch lib --out full{more}"));
        assert_eq!(results(&place, "full"), results(&place, "whole"));
    }
}

#[test]
fn a_batch_that_cannot_begin_leaves_no_folder_behind() {
    let place = Place::new();
    fs::create_dir(place.path("empty")).unwrap();
    for args in [
        "batch none.bvh",
        "batch empty",
        "batch @none.txt",
        "batch data/kick.bvh --deliver none",
        "batch data/kick.bvh --set none=1",
        "batch data/kick.bvh --bones none.toml",
        "batch --join none",
    ] {
        let output = place.genga(&format!("{args} --out new/deep"));
        assert_ne!(output.status.code(), Some(0), "{args}");
        assert!(!place.path("new").exists(), "{args}: {}", text(&output.stderr));
    }
}

/// Runs the program as a user whom permissions bind, which they do not the root of a machine.
#[cfg(target_os = "linux")]
fn bound(place: &Place, args: &str) -> (i32, String) {
    let data = here("data").to_string_lossy().into_owned() + "/";
    let (genga, args) = (env!("CARGO_BIN_EXE_genga"), args.replace("data/", &data));
    let less = "[ $(id -u) != 0 ] || less='setpriv --bounding-set -dac_override --'";
    let command = format!("{less}; exec $less '{genga}' {args}");
    let mut shell = std::process::Command::new("sh");
    let output = shell.args(["-c", &command]).current_dir(place.path(".")).output().unwrap();
    (output.status.code().unwrap_or(-1), text(&output.stderr))
}

#[cfg(target_os = "linux")]
fn permit(place: &Place, folder: &str, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(place.path(folder), fs::Permissions::from_mode(mode)).unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn a_clip_whose_folder_cannot_be_written_is_a_row_and_the_others_are_done() {
    let place = Place::new();
    let batch = "batch data/kick.bvh data/pitch.bvh data/swing.bvh --out out --jobs 1";
    place.done(batch);
    let before = results(&place, "out");
    permit(&place, "out/clips/pitch.bvh", 0o555);
    let other = format!("{batch} --set spacing.on=3");
    for _ in 0..2 {
        let (exit, said) = bound(&place, &other);
        assert_eq!(exit, 1, "{said}");
        let refused = "1 of 3 failed: out/clips/pitch.bvh/sheet.json: access is denied; ";
        assert!(said.contains(refused) && !said.contains(".genga-"), "{said}");
        let now = results(&place, "out");
        let summary = text(&now["summary.csv"]);
        assert_eq!(crate::program::column(&summary, "status"), ["done", "failed", "done"]);
        assert!(!summary.contains(".genga-"), "{summary}");
        for (clip, is_same) in [("kick", false), ("pitch", true), ("swing", false)] {
            let sheet = format!("clips/{clip}.bvh/sheet.json");
            assert_eq!(now[&sheet] == before[&sheet], is_same, "{clip}");
        }
    }
    permit(&place, "out/clips/pitch.bvh", 0o755);
    place.done(&other);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_is_named_as_it_was_given() {
    let place = Place::new();
    fs::create_dir(place.path("ro")).unwrap();
    permit(&place, "ro", 0o555);
    for command in ["run data/kick.bvh", "batch data/kick.bvh"] {
        for out in ["ro", "ro/new"] {
            let (exit, said) = bound(&place, &format!("{command} --out {out}"));
            assert_eq!(exit, 1, "{said}");
            let refused = format!("genga: {out}: access is denied; change the permissions, ");
            assert!(said.contains(&refused) && !said.contains(".genga-"), "{said}");
        }
    }
    permit(&place, "ro", 0o755);
}

#[test]
fn a_motion_is_no_list() {
    let place = Place::new();
    fs::write(place.path("kick.bvh"), kick()).unwrap();
    let output = place.fed("batch - --out out", &kick());
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    let says = "stdin: begins as a motion (BVH) and is no list of files; genga run - takes it";
    assert!(said.contains(says), "{said}");
    let said = place.refused(2, "batch @kick.bvh --out out");
    assert!(said.contains("no list of files; genga run kick.bvh takes it"), "{said}");
    assert!(!place.path("out").exists());
    // A list may begin with a file of that name, and with JSON that is no glTF.
    fs::write(place.path("hierarchy"), kick()).unwrap();
    assert_eq!(place.fed("batch - --out out", b"hierarchy\nkick.bvh\n").status.code(), Some(0));
    let said = text(&place.fed("batch - --out out", b"{\"clip\": \"kick.bvh\"}\n").stderr);
    assert!(!said.contains("begins as a motion"), "{said}");
}
