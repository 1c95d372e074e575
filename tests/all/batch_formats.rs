//! A batch that names no formats writes again those that the folder has.

use std::fs;

use crate::batch::{code, numbered, results};
use crate::clips::here;
use crate::program::{Place, column};

const BATCH: &str = "batch data/kick.bvh data/pitch.bvh --out out";
const AGAIN: &str = "note        written again, as the folder has them: ";

/// Repeats a batch of two clips, checks how many of them were done already, and returns what it says.
fn repeated(place: &Place, args: &str, resumed: usize) -> String {
    let (exit, said) = code(place, &format!("{BATCH} {args}"));
    assert_eq!(exit, 0, "{said}");
    let all = format!("{resumed} clips done already");
    assert_eq!(said.contains("done already"), resumed > 0, "{args}: {said}");
    assert!(resumed == 0 || said.contains(&all), "{args}: {said}");
    said
}

#[test]
fn a_batch_that_names_no_formats_writes_again_those_that_the_folder_has() {
    let place = Place::new();
    let said = repeated(&place, "", 0);
    assert!(!said.contains(AGAIN), "nothing is to be said of the default: {said}");
    assert!(!repeated(&place, "", 2).contains(AGAIN));
    assert!(!repeated(&place, "--deliver json,xdts", 0).contains("note"));
    let first = results(&place, "out");
    let said = repeated(&place, "", 2);
    assert!(said.contains(&format!("{AGAIN}json, xdts (--deliver names others)\n")), "{said}");
    assert_eq!(results(&place, "out"), first);
    // Other settings do not change the formats.
    repeated(&place, "--set spacing.on=3", 0);
    let files: Vec<String> = numbered(&place, "out").into_keys().collect();
    assert_eq!(files, first.keys().cloned().collect::<Vec<_>>());
    let said = repeated(&place, "--deliver json --set spacing.on=3", 0);
    assert!(said.contains("note        no longer written, and removed: xdts\n"), "{said}");
    assert!(!results(&place, "out").keys().any(|file| file.ends_with(".xdts")));
    assert!(!repeated(&place, "--set spacing.on=3", 2).contains("note        no longer"));
}

#[test]
fn formats_stay_with_their_settings_and_however_they_were_asked_for() {
    for asked in [
        "--deliver json,strip --with strip.width=900 --camera side",
        "--deliver xdts --bvh stepped",
        "--deliver all --trim 0..24",
        "--deliver json,xdts --pack",
    ] {
        let place = Place::new();
        let own = |option| if asked.contains(option) { option } else { "" };
        let again = format!("{} {}", own("--trim 0..24"), own("--pack"));
        let (_, said) = code(&place, &format!("{BATCH} {asked}"));
        let first = results(&place, "out");
        assert!(first.len() > 2, "{asked}: {said}");
        let said = repeated(&place, &again, 2);
        assert!(said.contains(AGAIN), "{asked}: {said}");
        let is_set =
            said.contains("settings of formats, as the folder has them (--deliver goes without): ");
        assert_eq!(is_set, asked.contains("--with"), "{said}");
        assert_eq!(results(&place, "out"), first, "{asked}");
    }
}

#[test]
fn each_part_of_a_list_keeps_its_formats() {
    let place = Place::new();
    for part in ["1/2", "2/2"] {
        place.done(&format!("{BATCH} --shard {part} --deliver json,xdts"));
    }
    for part in ["1/2", "2/2"] {
        let said = place.said(&format!("{BATCH} --shard {part}"));
        assert!(said.contains(&format!("{AGAIN}json, xdts")), "{said}");
        assert!(said.contains("1 clip done already"), "{said}");
    }
    place.done("batch --join out --out out");
}

#[test]
fn a_journal_that_does_not_tell_its_formats_is_read() {
    let place = Place::new();
    place.done(BATCH);
    let journal = place.path("out/batch.jsonl");
    let text = fs::read_to_string(&journal).unwrap();
    let (header, lines) = text.split_once('\n').unwrap();
    let mut header: serde_json::Value = serde_json::from_str(header).unwrap();
    let fields = header.as_object_mut().unwrap();
    fields.remove("deliver");
    fields.remove("with");
    fs::write(&journal, format!("{header}\n{lines}")).unwrap();
    assert!(!repeated(&place, "", 2).contains(AGAIN));
    // Neither does one of formats that this version does not know.
    header["deliver"] = serde_json::json!(["xdts", "hologram"]);
    fs::write(&journal, format!("{header}\n{lines}")).unwrap();
    assert!(repeated(&place, "", 0).contains(&format!("{AGAIN}xdts (")));
}

#[test]
fn what_was_not_done_as_asked_is_in_the_row_and_told() {
    let place = Place::new();
    let table = format!(
        "clip,move,keys\n{0}/kick.bvh,12:80,\n{0}/pitch.bvh,,500\n{0}/tennis.bvh,,\n",
        here("data").display()
    );
    fs::write(place.path("t.csv"), table).unwrap();
    let said = place.said("batch @t.csv --out o");
    let missed = "pitch.bvh: 500 genga were asked for";
    let idle = "kick.bvh: no key is found at frame 12 ";
    assert!(said.contains(missed) && said.contains(idle), "{said}");
    let rows = fs::read_to_string(place.path("o/summary.csv")).unwrap();
    let messages = column(&rows, "message");
    assert!(messages[0].starts_with("no key is found at frame 12"), "{rows}");
    assert!(messages[1].contains("500 genga were asked for") && messages[2].is_empty(), "{rows}");
    assert_eq!(column(&rows, "warnings")[..2], ["W_NOTED", "W_NOTED"]);
    // A batch that goes on says it again.
    assert!(place.said("batch @t.csv --out o").contains(missed));
}

#[test]
fn what_an_earlier_batch_left_is_told() {
    let place = Place::new();
    fs::create_dir_all(place.path("shots")).unwrap();
    let take =
        |clip: &str| fs::copy(here("data").join(clip), place.path("shots/shot01.bvh")).unwrap();
    take("kick.bvh");
    let told = "1 clip with another motion than before, whose files are replaced: shot01.bvh";
    assert!(!place.said("batch shots --out o").contains("another motion"));
    take("pitch.bvh");
    assert!(place.said("batch shots --out o").contains(told));
    assert!(!place.said("batch shots --out o").contains("another motion"));
    let said = place.said("batch shots --pack --out o");
    assert!(said.contains("o/clips is of an earlier batch, and stays as it was"), "{said}");
    let said = place.said("batch shots --set spacing.on=3 --out o");
    assert!(said.contains("o/clips.zip is of an earlier batch, and stays as it was"), "{said}");
    let said = place.refused(2, "batch shots --out shots");
    assert!(said.contains("shots: is the folder of --out, whose files are left out"), "{said}");
    fs::write(place.path("t.csv"), "clip\nshots/shot01.bvh\n").unwrap();
    let said = place.refused(2, "batch t.csv --out p");
    assert!(said.contains("is a list of clips and no motion; @t.csv takes"), "{said}");
    assert!(!place.path("p").exists());
}
