//! Two versions of a take: side by side for a director (`genga preview`), and as conditions of a trial.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::clips;
use crate::program::Place;

fn read(place: &Place, file: &str) -> String {
    fs::read_to_string(place.path(file)).unwrap()
}

/// The data of a flip-book.
fn take(page: &str) -> Value {
    let (_, rest) = page.split_once("<script type=\"application/json\" id=\"take\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

/// The source frame on each koma, by the table of the run.
fn frames(place: &Place, folder: &str) -> Vec<f64> {
    let mut table = csv::Reader::from_path(place.path(&format!("{folder}/sheet.csv"))).unwrap();
    let at = table.headers().unwrap().iter().position(|name| name == "source_frame").unwrap();
    table.records().map(|row| row.unwrap()[at].parse().unwrap()).collect()
}

/// The koma of a page on which its versions differ.
fn different(take: &Value) -> Vec<usize> {
    let runs = take["differences"].as_array().into_iter().flatten();
    let run = |run: &Value| (run[0].as_u64().unwrap() as usize, run[1].as_u64().unwrap() as usize);
    runs.map(run).flat_map(|(from, koma)| from..from + koma).collect()
}

#[test]
fn two_results_of_a_clip_are_side_by_side_in_step() {
    let place = Place::new();
    fs::copy(clips::here("data/kick.bvh"), place.path("kick.bvh")).unwrap();
    place.done("run kick.bvh -q");
    place.done("run kick.bvh --set spacing.on=2 --within 30..60:spacing.on=1 --out kick-ones -q");
    let made = place.genga("preview kick-genga kick-ones");
    let said = String::from_utf8(made.stderr).unwrap();
    assert!(made.status.success() && made.stdout.is_empty(), "{said}");
    assert!(
        said.contains("kick-genga: 92 koma, 26 drawings") && said.contains("kick-ones: 92"),
        "{said}"
    );
    assert!(said.contains("files       kick-genga-kick-ones.html"), "{said}");
    let take = take(&read(&place, "kick-genga-kick-ones.html"));
    assert_eq!(take["cut"], "kick");
    assert_eq!(
        [0, 1].map(|at| take["sheets"][at]["name"].as_str().unwrap()),
        ["kick-genga", "kick-ones"]
    );
    // The kick moves wherever the sheets show other frames of it.
    let [one, other] = ["kick-genga", "kick-ones"].map(|folder| frames(&place, folder));
    let found = different(&take);
    assert!(
        said.contains(&format!("{} of 92 koma show different drawings", found.len())),
        "{said}"
    );
    let others: Vec<usize> = (0..92).filter(|koma| one[*koma] != other[*koma]).collect();
    assert_eq!(found, others);
    assert!(found.len() > 20 && found.len() < 92, "{found:?}");
    // The sheet beside the motion, by its file or its folder, is the same; and so are the bytes.
    place.done("preview kick-genga/sheet.json kick-ones --out again.html -q");
    assert_eq!(read(&place, "again.html"), read(&place, "kick-genga-kick-ones.html"));
}

#[test]
fn a_timesheet_that_somebody_edited_is_a_version_too() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out kick -q");
    place.done("preview kick kick/kick_douga_ts.xdts --clip data/kick.bvh --names ours,theirs --out a.html -q");
    let page = take(&read(&place, "a.html"));
    assert_eq!(page["sheets"][1]["name"], "theirs");
    assert_eq!(page["sheets"][0]["cells"], page["sheets"][1]["cells"]);
    assert_eq!(different(&page), [0; 0]);
    let (head, json) = read(&place, "kick/kick_douga_ts.xdts")
        .split_once('\n')
        .map(|(a, b)| (a.to_owned(), b.to_owned()))
        .unwrap();
    let mut sheet: Value = serde_json::from_str(&json).unwrap();
    let frames = sheet["timeTables"][0]["fields"][0]["tracks"][0]["frames"].as_array_mut().unwrap();
    frames.retain(|frame| frame["data"][0]["values"][0] != "9");
    fs::write(place.path("kick/theirs.xdts"), format!("{head}\n{sheet}")).unwrap();
    place.done("preview kick kick/theirs.xdts --clip data/kick.bvh --out b.html -q");
    let page = take(&read(&place, "b.html"));
    assert_eq!(page["sheets"][1]["name"], "theirs");
    let ninth = page["sheets"][0]["cells"].as_array().unwrap()[8].clone();
    let own = |at: usize| ninth[at].as_u64().unwrap() as usize;
    assert!(different(&page).iter().all(|koma| (own(1)..own(1) + own(2)).contains(koma)));
    assert!(!different(&page).is_empty(), "drawing 9 is gone on its koma alone");
}

#[test]
fn the_shorter_version_holds_its_end_and_it_is_said() {
    let place = Place::new();
    place.done("run data/kick.bvh --out whole -q");
    place.done("run data/kick.bvh --trim 0..60 --out part -q");
    let made = place.genga("preview part whole --clip data/kick.bvh --out a.html");
    let said = String::from_utf8(made.stderr).unwrap();
    assert!(said.contains("length      尺         part is shorter, and holds its end"), "{said}");
    let take = take(&read(&place, "a.html"));
    assert_eq!((&take["koma"], &take["sheets"][0]["koma"]), (&92.into(), &60.into()));
    assert!(different(&take).iter().filter(|koma| **koma >= 60).count() > 20);
}

#[test]
fn a_film_is_chosen_by_its_ending() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a -q");
    place.done("run data/kick.bvh --set spacing.on=3 --out b -q");
    let preview = "preview a b --clip data/kick.bvh --out";
    if cfg!(feature = "pictures") {
        place.done(&format!("{preview} kick.gif --with preview.most=12 --camera front -q"));
        let gif = fs::read(place.path("kick.gif")).unwrap();
        assert!(gif.starts_with(b"GIF89a") && gif.len() > 5000, "{} bytes", gif.len());
        let said = place.refused(2, &format!("{preview} kick.mp4 --with mp4.ffmpeg=nowhere"));
        assert!(said.contains("apt install ffmpeg"), "{said}");
    } else {
        assert!(
            place.refused(2, &format!("{preview} kick.gif")).contains("the feature `pictures`")
        );
    }
    let said =
        String::from_utf8(place.genga(&format!("{preview} a.html --with flipbook.most=10")).stderr)
            .unwrap();
    assert!(said.contains("flipbook shows the first 10 of 92 koma"), "{said}");
}

#[test]
fn what_is_no_pair_of_versions_is_refused_with_the_way_out() {
    let place = Place::new();
    for (name, args) in
        [("kick", ""), ("kick-25", "--set rate=25"), ("kick-late", "--trim 10..92"), ("swing", "")]
    {
        let clip = name.split('-').next().unwrap();
        place.done(&format!("run data/{clip}.bvh {args} --out {name} -q"));
    }
    fs::create_dir(place.path("empty")).unwrap();
    for (args, said) in [
        ("kick", "<B>"),
        ("kick kick kick", "unexpected argument"),
        ("kick empty", "empty: there is no sheet.json in this folder"),
        (
            "kick swing --clip data/kick.bvh",
            "made of kick.bvh and swing of swing.bvh, with another motion",
        ),
        ("kick kick-25 --clip data/kick.bvh", "kick has 24 koma a second and kick-25 has 25"),
        (
            "kick kick-late --clip data/kick.bvh",
            "kick begins with source frame 0 and kick-late with 10",
        ),
        (
            "kick kick-25",
            "the motion kick.bvh is neither beside the sheets nor here: name it, as in --clip data/kick.bvh",
        ),
        ("kick kick-25 --names one --clip data/kick.bvh", "expected one name for each sheet"),
        ("kick kick-25 --out a.svg --clip data/kick.bvh", "--out: a film is .html, .gif or .mp4"),
        ("kick kick-25 --out - --clip data/kick.bvh", "--out: a film is .html, .gif or .mp4"),
        ("- kick --clip - --out a.html", "only one of the sheets and the clip can come from stdin"),
    ] {
        let found = place.refused(2, &format!("preview {args}"));
        assert!(found.contains(said), "{args}: {found}");
    }
    fs::copy(place.path("kick/sheet.json"), place.path("kick.html")).unwrap();
    let said = place.refused(2, "preview kick.html kick --clip data/kick.bvh --out kick.html");
    assert!(said.contains("this is the sheet itself"), "{said}");
}

#[test]
fn own_sheets_of_any_kind_are_conditions_alone_or_beside_the_others() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out kick -q");
    place.done("run data/kick.bvh --set spacing.on=3 --out threes -q");
    let own = "--sheet ours=kick/kick_douga_ts.xdts --sheet theirs=threes";
    place.done(&format!("trial data/kick.bvh {own} --conditions none --out page -q"));
    let plan: Value = serde_json::from_str(&read(&place, "page/trial.json")).unwrap();
    let names = |plan: &Value| -> Vec<String> {
        let conditions = plan["conditions"].as_array().unwrap().iter();
        conditions.map(|one| one["name"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(names(&plan), ["ours", "theirs"]);
    let drawings = &plan["clips"][0]["drawings"];
    assert_eq!(drawings["ours"], 26);
    assert_ne!(drawings["theirs"], 26);
    place.done(&format!("trial data/kick.bvh {own} --conditions source,uniform --out page -q"));
    let plan: Value = serde_json::from_str(&read(&place, "page/trial.json")).unwrap();
    assert_eq!(names(&plan), ["source", "uniform", "ours", "theirs"]);
    let said = place.refused(2, "trial data/kick.bvh --conditions none --sheet a=kick --out none");
    assert!(said.contains("a pair needs two"), "{said}");
    let said = place.refused(1, "trial data/kick.bvh --sheet a=nowhere --out none");
    assert!(said.contains("nowhere"), "{said}");
    let said = place.refused(2, "trial data/kick.bvh --sheet genga=kick --out none");
    assert!(said.contains("there is a condition genga already"), "{said}");
    fs::write(place.path("alone.xdts"), fs::read(place.path("kick/kick_douga_ts.xdts")).unwrap())
        .unwrap();
    let said = place.refused(2, "trial data/kick.bvh --sheet a=alone.xdts --out none");
    assert!(said.contains("put it into the results folder that it came from"), "{said}");
    assert!(!place.path("none").exists());
}

#[test]
fn a_real_punch_on_ones_and_on_threes_differs_where_their_tables_do() {
    clips::with(["cmu-02_05-punch-strike"], |[clip]| compare_punch(&clip));
}

fn compare_punch(clip: &Path) {
    let place = Place::new();
    fs::copy(clip, place.path("punch.bvh")).unwrap();
    place.done("run punch.bvh --trim 0..600 -q");
    place.done("run punch.bvh --trim 0..600 --set spacing.on=3 --out punch-threes -q");
    place.done("preview punch-genga punch-threes --out a.html -q");
    let take = take(&read(&place, "a.html"));
    let [one, other] = ["punch-genga", "punch-threes"].map(|folder| frames(&place, folder));
    let found = different(&take);
    for koma in &found {
        assert!(one[*koma] != other[*koma], "koma {koma}: {} is {}", one[*koma], other[*koma]);
    }
    let far = |koma: &usize| (one[*koma] - other[*koma]).abs() >= 10.0;
    let (moved, marked) = (0..one.len())
        .filter(far)
        .fold((0, 0), |(all, marked), koma| (all + 1, marked + usize::from(found.contains(&koma))));
    assert!(moved > 0 && marked * 2 > moved, "{marked} of {moved} koma that are far apart in time");
}
