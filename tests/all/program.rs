//! The built program, as a person or a script uses it.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

use crate::cases::is_full;
use crate::clips::{here, sample};

pub(crate) const SAMPLES: [&str; 5] = ["pitch", "kick", "tennis", "swing", "kuroda-pitch"];

/// The files of a run, and the beginning of each.
const FILES: [(&str, &str); 13] = [
    (
        "drawings.csv",
        "cut,column,drawing,role,genga_no,reason,koma_first,koma_count,time_s,source_frame,source_time_s,on,mark,spacing_pos,spacing_fraction,lead_joint,note\n",
    ),
    (
        "keys.csv",
        "cut,column,drawing,role,genga_no,reason,koma_first,koma_count,time_s,source_frame,source_time_s,on,mark,spacing_pos,spacing_fraction,lead_joint,note\n",
    ),
    ("limited.bvh", "HIERARCHY\nROOT "),
    ("manifest.json", "{\n  \"schema\": \"genga-run-1\",\n"),
    ("poses.svg", "<svg "),
    ("recipe.toml", "# A genga recipe"),
    ("remap.csv", "koma,source_frame,source_time_s,nearest_frame\n"),
    ("remap.ffconcat", "ffconcat version 1.0\n"),
    ("report.json", "{\n  \"frames\": "),
    ("sheet.csv", "koma,layer,drawing,role,source_frame,why\n"),
    ("sheet.json", "{\n  \"schema\": \"genga-sheet-2\",\n"),
    ("sheet.svg", "<svg "),
    ("speed.svg", "<svg "),
];

const SUBCOMMANDS: [&str; 16] = [
    "run",
    "batch",
    "studio",
    "deliver",
    "preview",
    "keys",
    "omit",
    "split",
    "study",
    "eval",
    "compare",
    "trial",
    "inspect",
    "recipe",
    "completions",
    "man",
];

/// A folder for a single test, in which the program runs.
pub(crate) struct Place(TempDir);

impl Place {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> std::path::PathBuf {
        self.0.path().join(name)
    }

    fn command<S: AsRef<OsStr>>(&self, args: &[S]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_genga"));
        command.current_dir(self.0.path()).args(args).stdin(Stdio::null());
        command
    }

    pub(crate) fn genga(&self, args: &str) -> Output {
        self.command(&words(args)).output().unwrap()
    }

    /// Runs the program with bytes on stdin.
    pub(crate) fn fed(&self, args: &str, bytes: &[u8]) -> Output {
        let mut command = self.command(&words(args));
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        child.wait_with_output().unwrap()
    }

    /// Starts the program without waiting, with its output discarded.
    #[cfg(unix)]
    pub(crate) fn begun(&self, args: &str) -> std::process::Child {
        let mut command = self.command(&words(args));
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    }

    /// Runs the program, checks that it succeeds, and returns stdout.
    pub(crate) fn done(&self, args: &str) -> String {
        let output = self.genga(args);
        assert_eq!(output.status.code(), Some(0), "genga {args}: {}", text(&output.stderr));
        text(&output.stdout)
    }

    /// Runs the program, checks that it succeeds, and returns stderr.
    pub(crate) fn said(&self, args: &str) -> String {
        let output = self.genga(args);
        assert_eq!(output.status.code(), Some(0), "genga {args}: {}", text(&output.stderr));
        text(&output.stderr)
    }

    /// Runs the program, checks that it fails with this code and an empty stdout, and returns stderr.
    pub(crate) fn refused(&self, code: i32, args: &str) -> String {
        let output = self.genga(args);
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "genga {args}: {said}");
        assert_eq!(text(&output.stdout), "", "genga {args}");
        said
    }

    /// Every file of a folder, by name.
    pub(crate) fn files(&self, folder: &str) -> BTreeMap<String, Vec<u8>> {
        let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
        let entries = fs::read_dir(self.path(folder)).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path()).filter(|path| path.is_file());
        paths.map(|path| (name(&path), fs::read(&path).unwrap())).collect()
    }
}

/// The files of a folder as they would be if no target had found its settings.
pub(crate) fn without_found(mut files: BTreeMap<String, Vec<u8>>) -> BTreeMap<String, Vec<u8>> {
    let mut manifest: serde_json::Value = serde_json::from_slice(&files["manifest.json"]).unwrap();
    manifest.as_object_mut().unwrap().remove("found");
    files.insert("manifest.json".into(), serde_json::to_vec(&manifest).unwrap());
    files
}

/// Splits a command line into words; `data/` means the repository's.
fn words(args: &str) -> Vec<String> {
    let data = here("data").to_string_lossy().into_owned() + "/";
    let word = |word: &str| match word.strip_prefix("data/") {
        Some(file) => format!("{data}{file}"),
        None => word.to_owned(),
    };
    args.split_whitespace().map(word).collect()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Returns a column of a CSV table.
pub(crate) fn column(table: &str, name: &str) -> Vec<String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let at = reader.headers().unwrap().iter().position(|header| header == name).unwrap();
    reader.records().map(|record| record.unwrap()[at].to_owned()).collect()
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap()
}

/// The pitch with an inserted T-pose: two rows of zeros in front.
fn with_t_pose() -> String {
    let text = read(&here("data/pitch.bvh"));
    let channels = sample("pitch.bvh").skeleton().channels();
    let (head, motion) = text.split_once("Frame Time:").unwrap();
    let (time, rows) = motion.split_once('\n').unwrap();
    let zeros = vec!["0"; channels].join(" ");
    let head = head.replace("Frames: 129", "Frames: 131");
    format!("{head}Frame Time:{time}\n{zeros}\n{zeros}\n{rows}")
}

#[test]
fn a_run_writes_every_file_and_says_what_it_did() {
    let place = Place::new();
    for name in SAMPLES {
        let output = place.genga(&format!("run data/{name}.bvh --out out/{name}"));
        let said = text(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{name}: {said}");
        assert!(output.stdout.is_empty(), "{name}: what is said to a person is on stderr");
        let files = place.files(&format!("out/{name}"));
        let names: Vec<&str> = files.keys().map(String::as_str).collect();
        assert_eq!(names, FILES.map(|(file, _)| file), "{name}");
        for (file, begin) in FILES {
            let made = text(&files[file]);
            assert!(made.starts_with(begin), "{name}/{file} begins {:.90}", made);
            assert!(made.len() > begin.len() && made.ends_with('\n'), "{name}/{file}");
            assert!(said.contains(file), "{name}: {file} is not named in\n{said}");
        }
        for word in [name, "fps", "joints", "genga", "drawings", "longest hold", "naka-nashi"] {
            assert!(said.contains(word), "{name}: no word of {word} in\n{said}");
        }
        let koma = column(&text(&files["sheet.csv"]), "koma").len();
        assert_eq!(column(&text(&files["remap.csv"]), "koma").len(), koma);
        let keys = column(&text(&files["keys.csv"]), "role");
        assert!(keys.len() > 4 && !keys.contains(&"inbetween".into()));
        let report: serde_json::Value = serde_json::from_slice(&files["report.json"]).unwrap();
        assert_eq!(report["koma"], koma);
        assert_eq!(report["genga"], keys.len());
    }
}

#[test]
fn the_folder_is_named_after_the_clip_unless_one_is_given() {
    let place = Place::new();
    place.done("run data/kick.bvh -q");
    assert_eq!(place.files("kick-genga").len(), FILES.len());
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for name in ["pitch", "kuroda-pitch"] {
        let place = Place::new();
        for again in ["a", "b"] {
            place.done(&format!("run data/{name}.bvh --out {again} --set keys.merge=vote"));
            let omit = format!("omit data/{name}.bvh --out {again}/o.bvh --sheet {again}/o.csv");
            let omit = format!("{omit} --plot {again}/o.svg");
            place.done(&omit);
            let study = format!("study data/{name}.bvh --out {again}/s.csv --plot {again}/s.svg");
            place.done(&study);
        }
        let (a, b) = (place.files("a"), place.files("b"));
        assert_eq!(a.len(), FILES.len() + 5);
        for (file, bytes) in a {
            assert!(b[&file] == bytes, "{name}: {file} came out different");
        }
        let keys = format!("keys data/{name}.bvh --per-joint");
        assert_eq!(place.done(&keys), place.done(&keys));
    }
}

#[test]
fn keys_are_a_table_of_the_body_or_of_every_joint() {
    let place = Place::new();
    for name in SAMPLES {
        let table = place.done(&format!("keys data/{name}.bvh"));
        assert!(column(&table, "cut").iter().all(|cut| cut == name));
        let roles = column(&table, "role");
        // If the last genga holds up to the end, there is no other end.
        assert_eq!(roles[0], "end");
        assert!(["end", "genga"].contains(&roles[roles.len() - 1].as_str()), "{roles:?}");
        let joints = place.done(&format!("keys data/{name}.bvh --per-joint"));
        assert!(joints.starts_with("joint,frame,kind,speed_deg_s,confirmed_for\n"));
        let kinds = column(&joints, "kind");
        assert!(kinds.contains(&"key".into()) && kinds.contains(&"wall".into()));
        let skeleton = sample(&format!("{name}.bvh")).skeleton().clone();
        assert!(column(&joints, "joint").iter().all(|joint| skeleton.find(joint).is_some()));
        place.done(&format!("run data/{name}.bvh --out {name}"));
        assert_eq!(table, read(&place.path(&format!("{name}/keys.csv"))), "the same as of a run");
    }
}

#[test]
fn a_pin_given_again_has_its_last_name() {
    let place = Place::new();
    let output = place.genga("keys data/kick.bvh --pin 42,42:contact");
    assert!(output.status.success());
    assert!(text(&output.stdout).contains("pinned: contact"));
}

#[test]
fn omit_does_what_the_second_paper_counts() {
    let place = Place::new();
    for (name, naka_nashi, koma_dori) in
        [("pitch", 4, 33), ("kick", 4, 30), ("tennis", 4, 29), ("swing", 6, 40)]
    {
        let output = place.genga(&format!(
            "omit data/{name}.bvh --naka-nashi {naka_nashi} --koma-dori {koma_dori} --out {name}.bvh --sheet {name}.csv"
        ));
        let said = text(&output.stderr);
        assert!(output.status.success(), "{name}: {said}");
        assert!(said.contains(&format!("{naka_nashi} of {naka_nashi} koma left out")), "{said}");
        assert!(said.contains(&format!("{koma_dori} of {koma_dori} koma held over")), "{said}");
        let drawings = column(&read(&place.path(&format!("{name}.csv"))), "drawing");
        let held = drawings.windows(2).filter(|pair| pair[0] == pair[1]).count();
        assert_eq!(held, naka_nashi + koma_dori, "{name}");
        let made = crate::clips::read(&place.path(&format!("{name}.bvh")));
        assert_eq!(made.len(), sample(&format!("{name}.bvh")).len(), "{name}");
        assert_eq!(made.rate().fps(), 24.0);
    }
}

#[test]
fn omit_prints_a_row_of_the_second_papers_table_1() {
    let place = Place::new();
    let omit = "omit data/kick.bvh --naka-nashi 4 --koma-dori 30";
    let table = place.done(&format!("{omit} --table"));
    for (name, value) in [("clip", "kick"), ("frames", "92"), ("n_io", "4"), ("n_hf", "30")] {
        assert_eq!(column(&table, name), [value], "{table}");
    }
    assert!(column(&table, "time_ms")[0].parse::<f64>().unwrap() > 0.0, "{table}");
    place.done(&format!("{omit} --table=t.csv --out o.bvh"));
    assert_eq!(column(&read(&place.path("t.csv")), "n_hf"), ["30"]);
    assert!(place.path("o.bvh").exists());
    place.refused(2, &format!("{omit} --table --out -"));
    let table = place.done("omit data/kick.bvh data/swing.bvh --table");
    assert_eq!(column(&table, "clip"), ["kick", "swing"], "{table}");
    assert_eq!(column(&table, "n_io"), ["4", "4"], "{table}");
    place.refused(2, "omit data/kick.bvh data/swing.bvh --table --out o.bvh");
    let capped = text(&place.genga("omit data/kick.bvh --naka-nashi 50% --table").stderr);
    assert!(capped.contains("50% are 46 of 92 koma, and a share leaves out at most 6"), "{capped}");
}

#[test]
fn the_flags_of_omit_do_something_each() {
    let place = Place::new();
    let sheet = |flags: &str| {
        place
            .done(&format!("omit data/swing.bvh --naka-nashi 8 --out o.bvh --sheet o.csv {flags}"));
        read(&place.path("o.csv"))
    };
    let plain = sheet("");
    for flags in [
        "--all-at-once",
        "--koma-dori-first",
        "--let-length-change",
        "--max-hold 2",
        "--koma-dori 5",
    ] {
        assert_ne!(sheet(flags), plain, "{flags}");
    }
    assert_eq!(sheet("--koma-dori 33% --max-hold 4"), sheet("--koma-dori 0.33"));
    assert_eq!(column(&sheet("--let-length-change"), "koma").len(), 112);
}

#[test]
fn inspect_names_what_is_in_a_clip() {
    let place = Place::new();
    for name in SAMPLES {
        let clip = sample(&format!("{name}.bvh"));
        let page = place.done(&format!("inspect data/{name}.bvh"));
        for wanted in [
            format!("frames    {}, numbers 0 to {}", clip.len(), clip.last()),
            format!("rate      {} frames a second", clip.rate()),
            format!("joints    23, {} channels", clip.skeleton().channels()),
            "centimetres".into(),
        ] {
            assert!(page.contains(&wanted), "{wanted:?} is not in\n{page}");
        }
        assert!(clip.skeleton().joints.iter().all(|joint| page.contains(&joint.name)));
    }
}

#[test]
fn one_joint_is_not_called_joints() {
    let place = Place::new();
    let frame = |at: usize| format!("{at} {} 0\n", at * at % 7);
    let rows: String = (0..48).map(frame).collect();
    let clip = format!(
        "HIERARCHY\nROOT ball\n{{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\n\
         End Site\n{{\nOFFSET 0 9 0\n}}\n}}\nMOTION\nFrames: 48\nFrame Time: 0.041667\n{rows}"
    );
    fs::write(place.path("ball.bvh"), clip).unwrap();
    assert!(place.said("run ball.bvh").contains("48 frames at 24 fps, 1 joint, 1.96 s"));
    let page = place.done("inspect ball.bvh");
    assert!(!page.contains("1 joints"), "{page}");
}

#[test]
fn inspect_draws_the_skeleton_and_never_over_the_clip() {
    let place = Place::new();
    let page = place.done("inspect data/kick.bvh --plot skeleton.svg");
    assert_eq!(page, place.done("inspect data/kick.bvh"));
    let picture = read(&place.path("skeleton.svg"));
    let clip = sample("kick.bvh");
    for joint in &clip.skeleton().joints {
        assert!(picture.contains(&format!(">{}</text>", joint.name)), "{}", joint.name);
    }
    // A clip may have a picture's name.
    fs::copy(here("data/kick.bvh"), place.path("k.svg")).unwrap();
    place.refused(2, "inspect k.svg --plot k.svg");
    assert_eq!(read(&place.path("k.svg")), fs::read_to_string(here("data/kick.bvh")).unwrap());
    place.refused(2, "inspect k.svg --plot s.svg --warnings");
}

#[test]
fn inspect_says_what_rate_the_file_writes_when_it_is_another() {
    let place = Place::new();
    let rate = |args: &str| {
        let page = place.done(&format!("inspect {args}"));
        page.lines().find(|line| line.starts_with("rate")).unwrap().to_owned()
    };
    let kick = read(&here("data/kick.bvh"));
    let (before, after) = kick.split_once("Frame Time:").unwrap();
    let (_, rows) = after.split_once('\n').unwrap();
    for (time, args, expected) in [
        (
            ".0083333",
            "",
            "120 frames a second (the file writes 0.0083333 s a frame: 120.00048 a second)",
        ),
        ("0.1", "", "10 frames a second"),
        ("0", "--fps 25", "25 frames a second (the file writes 0 s a frame)"),
        ("30", "--fps 30", "30 frames a second (the file writes 30 s a frame: 0.03333 a second)"),
    ] {
        fs::write(place.path("k.bvh"), format!("{before}Frame Time: {time}\n{rows}")).unwrap();
        assert_eq!(rate(&format!("k.bvh {args}")), format!("rate      {expected}"));
    }
    for (args, wrong) in [("", "--fps"), ("--fps 0", "--fps")] {
        let output = place.genga(&format!("inspect k.bvh {args}"));
        assert!(!output.status.success() && text(&output.stderr).contains(wrong));
    }
    assert_eq!(place.done("run data/kick.bvh --out o -q"), "");
    assert!(read(&place.path("o/report.json")).contains("\"notes\": []"));
}

#[test]
fn warnings_are_listed_noted_and_made_errors() {
    let place = Place::new();
    let odd = with_t_pose().replace("Frames: 131", "Frames : 140");
    fs::write(place.path("odd.bvh"), &odd).unwrap();
    let line = odd.lines().position(|line| line.starts_with("Frames")).unwrap() + 1;
    let listed = place.done("inspect odd.bvh --warnings");
    let lines: Vec<&str> = listed.lines().collect();
    let places = [
        format!("W_LABEL_SPACING {line}:7 a blank "),
        format!("W_FRAMES_MISMATCH {line}:10 the file says 140 frames "),
    ];
    assert_eq!(lines.len(), 3, "{listed}");
    assert!(lines[0].starts_with(&places[0]) && lines[1].starts_with(&places[1]), "{listed}");
    assert!(lines[2].starts_with("W_LEAD_IN - frames 0 to 1 are "), "{listed}");
    let noted = text(&place.genga("inspect odd.bvh").stderr);
    assert!(noted.starts_with(&format!("{line}:7: a blank ")), "{noted}");
    assert!(noted.contains("[W_LABEL_SPACING]") && noted.contains("[W_LEAD_IN]"), "{noted}");
    assert_eq!(place.done("inspect data/kick.bvh --warnings"), "");
    for args in [
        "inspect odd.bvh",
        "keys odd.bvh",
        "run odd.bvh --out o",
        "omit odd.bvh --out o.bvh",
        "study odd.bvh",
    ] {
        let said = place.refused(1, &format!("{args} --strict"));
        assert!(said.starts_with(&format!("genga: odd.bvh:{line}:7: ")), "{said}");
        assert!(said.ends_with("[W_LABEL_SPACING]\n"), "{said}");
    }
    fs::write(place.path("t.bvh"), with_t_pose()).unwrap();
    place.done("inspect t.bvh --strict");
}

#[test]
fn a_broken_file_is_repaired_when_asked_for() {
    let place = Place::new();
    let kick = read(&here("data/kick.bvh"));
    let last = kick.trim_end().rfind(' ').unwrap();
    fs::write(place.path("nan.bvh"), format!("{} nan 7\n", &kick[..last])).unwrap();
    let said = place.refused(1, "inspect nan.bvh");
    assert!(said.contains("found \"nan\"; --repair "), "{said}");
    let listed = place.done("inspect nan.bvh --repair --warnings");
    let codes: Vec<&str> = listed.lines().map(|line| line.split(' ').next().unwrap()).collect();
    assert_eq!(codes, ["W_VALUE_HELD", "W_ROW_CUT"]);
    place.done("keys nan.bvh --repair");
    place.refused(2, "inspect nan.bvh --repair --strict");
}

#[test]
fn a_tree_is_chosen_by_its_root() {
    let place = Place::new();
    let sword = "ROOT Sword\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\nMOTION";
    let kick = read(&here("data/kick.bvh"));
    fs::write(place.path("two.bvh"), kick.replacen("MOTION", sword, 1)).unwrap();
    let root = sample("kick.bvh").skeleton().joints[0].name.clone();
    assert!(place.done("inspect two.bvh --warnings").starts_with("W_ROOTS "));
    assert_eq!(place.done(&format!("inspect two.bvh --warnings --root {root}")), "");
    let named = place.done("keys data/kick.bvh").replace("\nkick,", "\ntwo,");
    assert_eq!(place.done(&format!("keys two.bvh --root {root}")), named);
    let said = place.refused(2, "keys two.bvh --root Spear");
    assert!(said.starts_with("genga: --root: no tree is called \"Spear\""), "{said}");
}

#[test]
fn the_axis_that_points_up_is_a_persons_word() {
    let place = Place::new();
    let up = |option: &str| {
        place.done(&format!("run data/kick.bvh --out out --deliver glb{option}"));
        fs::read(place.path("out/limited.glb")).unwrap()
    };
    let stands = up("");
    assert!(up(" --up y") == stands);
    assert!(up(" --up z") != stands, "laid on its back");
    let said = place.refused(2, "inspect data/kick.bvh --up x");
    assert!(said.contains("expected y or z"), "{said}");
}

#[test]
fn a_dash_is_stdin_and_stdout() {
    let place = Place::new();
    let bytes = fs::read(here("data/kick.bvh")).unwrap();
    let output = place.fed("keys -", &bytes);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let named = place.done("keys data/kick.bvh").replace("\nkick,", "\nstdin,");
    assert_eq!(text(&output.stdout), named);
    let output = place.fed("omit - --out -", &bytes);
    place.done("omit data/kick.bvh --out o.bvh");
    assert!(output.stdout == fs::read(place.path("o.bvh")).unwrap());
    let output = place.fed("run - --out piped -q", &bytes);
    assert_eq!(text(&output.stderr), "");
    assert_eq!(place.files("piped").len(), FILES.len());
    let recipe = place.done("recipe");
    fs::write(place.path("k.bvh"), &bytes).unwrap();
    let output = place.fed("keys k.bvh --recipe -", recipe.as_bytes());
    assert_eq!(text(&output.stdout).replace("\nk,", "\nstdin,"), named);
    let output = place.fed("keys -", b"HIERARCHY\nROOT 5 {");
    assert_eq!(output.status.code(), Some(1));
}

#[test]
fn what_cannot_be_done_is_code_1_and_what_is_asked_wrongly_is_code_2() {
    let place = Place::new();
    fs::write(place.path("empty.bvh"), "").unwrap();
    fs::write(place.path("picture.bvh"), b"\x89PNG\r\n\x1a\n\xff\xfe").unwrap();
    fs::write(place.path("wrong.toml"), "rate = \"many\"\n").unwrap();
    for args in [
        "run none.bvh --out o",
        "keys none.bvh",
        "keys empty.bvh",
        "keys picture.bvh",
        "omit data/kick.bvh --out none/o.bvh",
        "study data/kick.bvh --plot none/s.svg",
        "run data/kick.bvh --out empty.bvh",
        "run data/kick.bvh --out empty.bvh/under",
    ] {
        let said = place.refused(1, args);
        assert!(said.starts_with("genga: ") && said.lines().count() == 1, "{args}: {said}");
    }
    for args in [
        "run data/kick.bvh --out o --set spacing.on=0",
        "run data/kick.bvh --out o --set spacing.off=2",
        "run data/kick.bvh --out o --set spacing.on",
        "run data/kick.bvh --out o --pin 92",
        "run data/kick.bvh --out o --pin twelve",
        "run data/kick.bvh --out o --trim 10..200",
        "run data/kick.bvh --out o --trim 50..50",
        "run data/kick.bvh --out o --trim 50..20",
        "run data/kick.bvh --out o --trim 50",
        "run data/kick.bvh --out o --recipe wrong.toml",
        "run data/kick.bvh --out o --recipe picture.bvh",
        "run --out o",
        "omit data/kick.bvh --out o.bvh --koma-dori 4/3",
        "omit data/kick.bvh --out o.bvh --max-hold 0",
        "omit data/kick.bvh",
        "study data/kick.bvh --filter blur",
        "study data/kick.bvh --persistence -3",
        "dance data/kick.bvh",
        "inspect .",
        "completions tcl",
        "",
    ] {
        place.refused(2, args);
    }
    assert!(!place.path("o").exists() && !place.path("o.bvh").exists(), "nothing was written");
    for args in ["--help", "--version", "run --help", "help omit"] {
        assert!(place.done(args).len() > 5, "{args}");
    }
}

#[test]
fn the_help_of_a_run_is_short_and_grouped_and_the_long_one_has_everything() {
    let place = Place::new();
    let (short, long) = (place.done("run --help"), place.done("help run"));
    assert_eq!(short, place.done("run -h"));
    let lines: Vec<&str> = short.lines().collect();
    assert!(lines.len() <= 80, "{} lines:\n{short}", lines.len());
    assert!(lines.iter().all(|line| line.chars().count() <= 100), "{short}");
    let headings: Vec<&str> = lines
        .iter()
        .filter(|line| line.ends_with(':') && !line.starts_with(' '))
        .copied()
        .collect();
    let groups =
        ["Arguments:", "Options:", "Files:", "Sheet:", "Corrections:", "Reading the motion:"];
    assert_eq!(headings[..6], groups, "{short}");
    let first = lines[lines.iter().position(|line| *line == "Options:").unwrap() + 1];
    assert!(first.contains("--out <DIR>"), "{first}");
    for format in genga_files::FORMATS {
        let is_named = |line: &&str| line.split_whitespace().any(|word| word == format.name);
        assert!(lines.iter().any(is_named), "{}", format.name);
    }
    let options = |text: &str| -> std::collections::BTreeSet<String> {
        let names = text.split_whitespace().filter(|word| word.starts_with("--") && word.len() > 2);
        let letter = |letter: char| letter.is_ascii_lowercase() || letter == '-';
        names.map(|word| word.chars().take_while(|at| letter(*at)).collect()).collect()
    };
    let missing: Vec<_> = options(&long).difference(&options(&short)).cloned().collect();
    assert!(missing.is_empty(), "{missing:?}");
    assert!(long.contains("xsheet.gauges") && long.contains("circled ones"), "{long}");
}

#[test]
fn help_in_the_place_of_formats_lists_them() {
    let place = Place::new();
    for args in ["run --deliver help", "batch --deliver json,help", "deliver --to help"] {
        let list = place.done(args);
        assert!(list.starts_with("Formats:\n  json ") && list.contains("xsheet.gauges"), "{list}");
        for format in genga_files::FORMATS {
            assert!(list.contains(format.help), "{args}: {}", format.name);
        }
    }
}

#[test]
fn an_error_names_file_line_and_column() {
    let place = Place::new();
    let kick = read(&here("data/kick.bvh"));
    let lines: Vec<&str> = kick.lines().collect();
    let motion = lines.iter().position(|line| line.starts_with("Frame Time")).unwrap();
    let mut broken: Vec<String> = lines.iter().map(|line| (*line).into()).collect();
    let third = broken[motion + 2].match_indices(' ').nth(1).unwrap().0 + 1;
    broken[motion + 2].replace_range(third..=third, "x");
    fs::write(place.path("broken.bvh"), broken.join("\n")).unwrap();
    for args in ["inspect broken.bvh", "keys broken.bvh", "run broken.bvh --out o"] {
        let said = place.refused(1, args);
        let place = format!("genga: broken.bvh:{}:{}: ", motion + 3, third + 1);
        assert!(said.starts_with(&place), "{said} is not at {place}");
    }
    fs::write(place.path("r.toml"), "rate = 24\n\n[filter]\nwitdh = 3\n").unwrap();
    let said = place.refused(2, "keys data/kick.bvh --recipe r.toml");
    assert!(said.starts_with("genga: r.toml:4:1: ") && said.contains("witdh"), "{said}");
    let said = place.refused(1, "keys none.bvh");
    assert!(said.starts_with("genga: none.bvh: "), "{said}");
}

#[test]
fn an_unknown_setting_is_answered_with_the_nearest() {
    let place = Place::new();
    for (wrong, meant) in [
        ("filter.widht", "filter.width"),
        ("spacing.wieght", "spacing.weight"),
        ("omission.nakanashi", "omission.naka_nashi"),
        ("key.merge", "keys.merge"),
    ] {
        let said = place.refused(2, &format!("keys data/kick.bvh --set {wrong}=1"));
        assert!(said.contains(&format!("did you mean {meant}?")), "{said}");
    }
    let said = place.refused(2, "keys data/kick.bvh --set foo.bar=3");
    assert!(said.contains("`genga recipe` lists them"), "{said}");
    let said = place.refused(2, "keys data/kick.bvh --set filter.kind=blur");
    assert!(said.contains("box, gaussian, ideal, butterworth"), "{said}");
}

#[test]
fn a_trim_counts_frames_as_in_the_file() {
    let place = Place::new();
    place.done("run data/kuroda-pitch.bvh --out all");
    place.done("run data/kuroda-pitch.bvh --out part --trim 120..420");
    let frames = |folder: &str| -> Vec<f64> {
        let remap = read(&place.path(&format!("{folder}/remap.csv")));
        column(&remap, "source_frame").iter().map(|cell| cell.parse().unwrap()).collect()
    };
    let part = frames("part");
    assert_eq!(part[0], 120.0);
    assert!(part.iter().all(|frame| (120.0..420.0).contains(frame)));
    assert_eq!(part.len(), 299 * 24 / 100 + 1);
    assert_eq!(frames("all")[0], 0.0);
    let part = place.done("keys data/kuroda-pitch.bvh --trim 0..496");
    assert_eq!(part, place.done("keys data/kuroda-pitch.bvh"));
}

#[test]
fn an_inserted_t_pose_is_left_out_with_a_note_unless_it_is_to_be_kept() {
    let place = Place::new();
    fs::write(place.path("t.bvh"), with_t_pose()).unwrap();
    let first = |args: &str| {
        let output = place.genga(&format!("keys t.bvh {args}"));
        assert!(output.status.success());
        (column(&text(&output.stdout), "source_frame")[0].clone(), text(&output.stderr))
    };
    let (frame, said) = first("");
    assert_eq!(frame, "2");
    assert!(said.contains("W_LEAD_IN") && said.contains("--keep-lead-in"), "{said}");
    assert_eq!(first("--keep-lead-in"), ("0".into(), String::new()));
    assert_eq!(first("--trim 5..90"), ("5".into(), String::new()));
    for inside in ["--trim 0..90", "--trim 1..90"] {
        let (frame, said) = first(inside);
        assert_eq!(frame, "2", "{inside}: from the beginning of the motion");
        assert!(said.contains("W_LEAD_IN"), "{inside}: {said}");
    }
    assert_eq!(first("--trim 2..90"), ("2".into(), String::new()));
    assert_eq!(first("--trim 0..90 --keep-lead-in").0, "0");
    assert_eq!(first("-q"), ("2".into(), String::new()));
    place.done("run t.bvh --out o");
    assert!(read(&place.path("o/report.json")).contains("W_LEAD_IN"));
    // The remaining motion is the pitch, two frames later in its file.
    let (with, without) = (place.done("keys t.bvh"), place.done("keys data/pitch.bvh"));
    let later = |cell: &String| (cell.parse::<f64>().unwrap() + 2.0).to_string();
    let without: Vec<String> = column(&without, "source_frame").iter().map(later).collect();
    assert_eq!(column(&with, "source_frame"), without);
}

#[test]
fn the_written_recipe_gives_the_same_results_again() {
    let place = Place::new();
    let asked = "--set filter.width=0.15s --set spacing.on=3 --set turns.steady=3% --set keys.per_second=2.5 \
                 --set omission.naka_nashi=3 --pin 12:wind-up,70 --pin 100";
    place.done(&format!("run data/pitch.bvh --out a {asked}"));
    place.done("run data/pitch.bvh --out b --recipe a/recipe.toml");
    assert_eq!(place.files("a"), place.files("b"));
    place.done("run data/pitch.bvh --out c");
    assert_ne!(place.files("a")["sheet.csv"], place.files("c")["sheet.csv"]);
    let sheet = text(&place.files("a")["sheet.csv"]);
    for (frame, why) in [("12", "pinned: wind-up"), ("70", "pinned"), ("100", "pinned")] {
        let row = |line: &str| line.contains(&format!(",genga,{frame},")) && line.contains(why);
        assert!(sheet.lines().any(row), "frame {frame} is not pinned in\n{sheet}");
    }
    // --set overrides the file.
    let over = "--recipe a/recipe.toml --set spacing.on=1";
    place.done(&format!("run data/pitch.bvh --out d {over}"));
    assert!(read(&place.path("d/recipe.toml")).contains("\non = 1\n"));
    fs::write(place.path("default.toml"), place.done("recipe")).unwrap();
    place.done("run data/pitch.bvh --out e --recipe default.toml");
    assert_eq!(place.files("e"), place.files("c"));
    fs::write(place.path("study.toml"), place.done("recipe --study")).unwrap();
    let study = place.done("study data/pitch.bvh --recipe study.toml");
    assert_eq!(study, place.done("study data/pitch.bvh"));
}

#[cfg(unix)]
#[test]
fn a_reader_that_has_enough_is_no_failure() {
    let place = Place::new();
    let data = here("data");
    for args in [
        "recipe".into(),
        "man".into(),
        "completions bash".into(),
        format!("keys {}/kuroda-pitch.bvh --per-joint", data.display()),
        format!("omit {}/kuroda-pitch.bvh --out -", data.display()),
    ] {
        let script = format!(
            "( '{}' {args}; echo \"code $?\" >&2 ) | head -c 1",
            env!("CARGO_BIN_EXE_genga")
        );
        let output =
            Command::new("sh").arg("-c").arg(script).current_dir(place.0.path()).output().unwrap();
        let said = text(&output.stderr);
        assert!(said.ends_with("code 0\n"), "{args}: {said}");
        assert!(!said.contains("panic"), "{args}: {said}");
        assert_eq!(output.stdout.len(), 1, "{args}");
        // The reader closes the pipe before the first byte.
        let script = format!(
            "( sleep 0.1; '{}' {args}; echo \"code $?\" >&2 ) | true",
            env!("CARGO_BIN_EXE_genga")
        );
        let output = Command::new("sh").arg("-c").arg(script).output().unwrap();
        assert!(text(&output.stderr).ends_with("code 0\n"), "{args}: {}", text(&output.stderr));
    }
}

#[test]
fn what_cannot_be_written_leaves_nothing_half_written() {
    let place = Place::new();
    // A folder blocks the place of one of the run's files.
    fs::create_dir_all(place.path("o/limited.bvh/taken")).unwrap();
    let said = place.refused(1, "run data/kick.bvh --out o");
    assert!(said.contains("limited.bvh"), "{said}");
    place.done("run data/kick.bvh --out whole");
    let whole = place.files("whole");
    for (file, bytes) in place.files("o") {
        assert!(whole.get(&file) == Some(&bytes), "o/{file} is not what it should be");
    }
    // An existing file stays whole if the new one cannot be made.
    fs::write(place.path("keep.bvh"), "old").unwrap();
    place.refused(1, "omit none.bvh --out keep.bvh");
    assert_eq!(read(&place.path("keep.bvh")), "old");
    fs::write(place.path("keep.csv"), "old").unwrap();
    place.refused(2, "study data/kick.bvh --set turns.steady=-1 --out keep.csv");
    assert_eq!(read(&place.path("keep.csv")), "old");
    let left: Vec<_> = place.files(".").into_keys().collect();
    assert_eq!(left, ["keep.bvh", "keep.csv"], "no file beside");
}

#[test]
fn quiet_is_quiet_and_errors_are_said_all_the_same() {
    let place = Place::new();
    fs::write(place.path("t.bvh"), with_t_pose()).unwrap();
    for args in [
        "run t.bvh --out o --quiet",
        "keys t.bvh --quiet",
        "omit t.bvh --out o.bvh --naka-nashi 500 --quiet",
        "study t.bvh --quiet",
        "inspect t.bvh --quiet",
        "recipe --quiet",
        "--quiet man",
        "-q completions zsh",
    ] {
        let output = place.genga(args);
        assert_eq!(
            (output.status.code(), text(&output.stderr)),
            (Some(0), String::new()),
            "{args}"
        );
    }
    assert!(!place.refused(1, "keys none.bvh --quiet").is_empty());
}

#[test]
fn completions_and_the_manual_name_every_subcommand() {
    let place = Place::new();
    for page in ["completions bash", "completions zsh", "completions fish", "man"] {
        let page = place.done(page);
        for subcommand in SUBCOMMANDS {
            assert!(page.contains(subcommand), "{subcommand}");
        }
    }
    let recipe = place.done("recipe");
    for knob in genga::recipe::KNOBS {
        assert!(recipe.contains(&format!("{} = ", knob.path().1)), "{}", knob.name);
    }
}

#[test]
fn the_studio_says_how_to_get_it_or_why_it_does_not_open() {
    let place = Place::new();
    if cfg!(feature = "studio") {
        assert!(place.refused(1, "studio none.bvh").contains("none.bvh: there is no such file"));
        assert!(place.refused(2, "studio -").contains("give a file, not stdin"));
    } else {
        assert!(place.refused(1, "studio none.bvh").contains("--features studio"));
    }
}

#[test]
fn nothing_is_written_over_the_motion_itself() {
    let place = Place::new();
    let kick = fs::read(here("data/kick.bvh")).unwrap();
    fs::create_dir(place.path("out")).unwrap();
    for motion in ["k.bvh", "out/limited.bvh"] {
        fs::write(place.path(motion), &kick).unwrap();
    }
    for args in [
        "keys k.bvh -o k.bvh",
        "study k.bvh -o k.bvh",
        "study k.bvh --plot k.bvh",
        "omit k.bvh -o k.bvh",
        "omit k.bvh -o l.bvh --sheet k.bvh",
        "omit k.bvh -o l.bvh --plot k.bvh",
        "run out/limited.bvh -o out",
    ] {
        let output = place.genga(args);
        assert_eq!(output.status.code(), Some(2), "{args}");
        assert!(text(&output.stderr).contains("this is the motion itself"), "{args}");
        for motion in ["k.bvh", "out/limited.bvh"] {
            assert!(fs::read(place.path(motion)).unwrap() == kick, "{args} wrote over {motion}");
        }
    }
}

#[test]
fn a_sheet_is_delivered_again_as_the_run_wrote_it() {
    let place = Place::new();
    fs::write(place.path("t.bvh"), with_t_pose()).unwrap();
    let runs = ["data/kick.bvh", "data/kick.bvh --trim 10..61", "t.bvh", "data/kick.bvh --fps 30"];
    let again = if is_full() { "all" } else { "json,csv,remap,bvh" };
    for (at, run) in runs.into_iter().enumerate() {
        place.done(&format!("run {run} --out a{at}"));
        let clip = run.split(' ').next().unwrap();
        let fps = run.find("--fps").map_or("", |at| &run[at..]);
        place.done(&format!("deliver a{at}/sheet.json {clip} --to {again} --out b{at} {fps}"));
        let (a, b) = (place.files(&format!("a{at}")), place.files(&format!("b{at}")));
        for file in
            ["sheet.json", "keys.csv", "drawings.csv", "sheet.csv", "remap.csv", "limited.bvh"]
        {
            assert!(a[file] == b[file], "{run}: {file} came out different");
        }
    }
}

#[test]
fn a_sheet_edited_by_hand_is_delivered_as_it_is() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --deliver remap,bvh");
    let sheet = read(&place.path("a/sheet.json"));
    let (head, exposures) = sheet.split_once("\"exposures\": [").unwrap();
    let edited = exposures.replacen("\"koma\": 3", "\"koma\": 6", 1);
    assert_ne!(edited, exposures);
    fs::write(place.path("a/sheet.json"), format!("{head}\"exposures\": [{edited}")).unwrap();
    let rows = |table: &str| column(&read(&place.path(table)), "koma").len();
    let before = rows("a/sheet.csv");
    let said = text(&place.genga("deliver a/sheet.json data/kick.bvh --to csv,remap").stderr);
    assert!(
        said.contains("files       a: keys.csv drawings.csv sheet.csv remap.csv remap.ffconcat\n"),
        "{said}"
    );
    assert_eq!((rows("a/sheet.csv"), rows("a/remap.csv")), (before + 3, before + 3));
    let sheet = fs::read(place.path("a/sheet.json")).unwrap();
    let output = place.fed("deliver - data/kick.bvh --to json", &sheet);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(fs::read(place.path("sheet.json")).unwrap() == sheet);
}

/// Edits a sheet so that its first drawing is held for one koma only.
fn edit(sheet: &Path) -> Vec<u8> {
    let text = read(sheet);
    let (head, held) = text.split_once("\"koma\": ").unwrap();
    let rest = held.trim_start_matches(|digit: char| digit.is_ascii_digit());
    let edited = format!("{head}\"koma\": 1{rest}");
    assert_ne!(text, edited);
    fs::write(sheet, &edited).unwrap();
    edited.into_bytes()
}

#[test]
fn another_timing_beside_that_of_the_run_is_told() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --deliver xdts");
    fs::copy(place.path("a/sheet.json"), place.path("edited.json")).unwrap();
    edit(&place.path("edited.json"));
    let said = |args: &str| text(&place.genga(args).stderr);
    let into_run = said("deliver edited.json data/kick.bvh --out a --to bars");
    assert!(
        into_run.contains("keeps the timing of the sheet.json in this folder; --out"),
        "{into_run}"
    );
    for same in [
        "deliver edited.json data/kick.bvh --out b --to bars",
        "deliver a/kick_douga_ts.xdts data/kick.bvh --to bars",
    ] {
        assert!(!said(same).contains("keeps the timing"), "{same}");
    }
}

#[test]
fn nothing_is_written_over_a_sheet_that_was_edited() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    place.done("run data/kick.bvh --out a --set spacing.on=3");
    place.done("run data/kick.bvh --out a --fresh");
    fs::copy(place.path("a/sheet.json"), place.path("whole.json")).unwrap();
    place.done("run data/kick.bvh --out b");
    let edited = edit(&place.path("a/sheet.json"));
    let before = place.files("a");
    for args in [
        "run data/kick.bvh --out a",
        "run none.bvh --out a",
        "deliver whole.json data/kick.bvh --out a --to json",
        "deliver whole.json data/kick.bvh --out a --to all",
    ] {
        let said = place.refused(2, args);
        assert!(
            said.starts_with("genga: a/sheet.json: this sheet is not as a run wrote it"),
            "{said}"
        );
        assert!(said.contains("--out") && said.matches('\n').count() == 1, "{said}");
        assert!(place.files("a") == before, "{args}");
    }
    // An edited sheet stays edited when delivered, and replaces one that was not edited.
    place.done("deliver a/sheet.json data/kick.bvh --out b --to json");
    assert!(fs::read(place.path("b/sheet.json")).unwrap() == edited);
    place.refused(2, "run data/kick.bvh --out b");
    fs::write(place.path("b/sheet.json"), "{").unwrap();
    place.refused(2, "run data/kick.bvh --out b");
}

#[test]
fn a_sheet_is_not_delivered_onto_itself() {
    let place = Place::new();
    place.done("run data/kick.bvh --trim 0..12 --out a");
    let edited = edit(&place.path("a/sheet.json"));
    for to in ["json", "all,json", "csv --out ./a/../a --to json"] {
        let said = place.refused(2, &format!("deliver a/sheet.json data/kick.bvh --to {to}"));
        assert!(said.contains("sheet.json: this is the sheet itself; write elsewhere"), "{said}");
    }
    let said = text(&place.genga("deliver a/sheet.json data/kick.bvh --to all").stderr);
    assert!(said.contains("files       a: keys.csv "), "{said}");
    assert!(fs::read(place.path("a/sheet.json")).unwrap() == edited);
}

#[test]
fn what_is_read_is_not_written_over() {
    let place = Place::new();
    fs::create_dir(place.path("o")).unwrap();
    fs::write(place.path("o/kick-bones.csv"), "").unwrap();
    fs::write(place.path("o/recipe.toml"), "").unwrap();
    for (args, what) in [
        ("--deliver vmd --bones o/kick-bones.csv", "table of bones"),
        ("--bones o/recipe.toml", "table of bones"),
        ("--deliver vmd --recipe o/kick-bones.csv", "recipe"),
    ] {
        let said = place.refused(2, &format!("run data/kick.bvh --out o {args}"));
        assert!(said.contains(&format!("this is the {what} itself")), "{said}");
        assert_eq!(place.files("o").len(), 2);
    }
    // A recipe that is tuned in place keeps its comments.
    fs::write(place.path("o/recipe.toml"), "[spacing]\non = 3 # mine\n").unwrap();
    let said = text(&place.genga("run data/kick.bvh --out o --recipe o/recipe.toml").stderr);
    assert!(said.contains("recipe.toml is the recipe that was given"), "{said}");
    assert!(!said.contains("this run adds"), "{said}");
    assert!(read(&place.path("o/report.json")).contains("recipe.toml is the recipe"));
    assert_eq!(read(&place.path("o/recipe.toml")), "[spacing]\non = 3 # mine\n");
    place.done("run data/kick.bvh --out p --recipe o/recipe.toml");
    let said = text(&place.genga("run data/kick.bvh --out p --recipe p/recipe.toml").stderr);
    assert!(!said.contains("recipe.toml is"), "{said}");
}

#[test]
fn a_recipe_tuned_in_its_place_loses_neither_comments_nor_corrections() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --keys 12");
    let again = "run data/kick.bvh --out a --fresh --recipe a/recipe.toml --pin 42:contact";
    let said = text(&place.genga(again).stderr);
    assert!(!said.contains("recipe.toml is"), "{said}");
    let tuned = read(&place.path("a/recipe.toml"));
    assert!(tuned.contains("[[edits.pins]]\nframe = 42\nname = \"contact\"\n"), "{tuned}");
    place.done("run data/kick.bvh --out b --recipe a/recipe.toml");
    let [a, b] = ["a", "b"].map(|folder| place.files(folder));
    assert!(without_found(a) == without_found(b), "and the settings that --keys found");
    // A comment makes it a person's own text.
    let own = tuned.replace("frame = 42", "frame = 42 # the foot");
    fs::write(place.path("a/recipe.toml"), &own).unwrap();
    let said = text(&place.genga(&again.replace("--pin 42:contact", "--pin 60")).stderr);
    assert!(said.contains("corrections and settings that this run adds are not in it"), "{said}");
    assert_eq!(read(&place.path("a/recipe.toml")), own);
    // The way out that the message names.
    place.done("run data/kick.bvh --out c --recipe a/recipe.toml --pin 60");
    assert!(read(&place.path("c/recipe.toml")).contains("frame = 60"));
}

#[test]
fn all_goes_without_what_cannot_be_made_and_says_so() {
    let place = Place::new();
    // A swinging stick: neither its names nor its shape match any bone.
    let mut bvh = String::from(
        "HIERARCHY\nROOT q0\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nJOINT q1\n{\nOFFSET 0 50 0\n\
         CHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 50 0\n}\n}\n}\nMOTION\nFrames: 12\n\
         Frame Time: 0.0416667\n",
    );
    for frame in 0..12 {
        let angle = 40.0 * (f64::from(frame) / 8.0).sin();
        bvh += &format!("{angle} 0 0 {} 0 0\n", 0.5 * angle);
    }
    fs::write(place.path("k.bvh"), bvh).unwrap();
    let unknown = "all goes without vmd: vmd: no joint has a name that is known";
    let fast = "all goes without vmd: vmd.fps: 48 koma a second do not go into 30 frames";
    for (o, args, note) in
        [("o", "k.bvh", unknown), ("r", "data/kick.bvh --trim 0..12 --set rate=48", fast)]
    {
        let said = text(&place.genga(&format!("run {args} --deliver all --out {o}")).stderr);
        assert!(said.contains(note), "{said}");
        assert!(read(&place.path(&format!("{o}/report.json"))).contains(note));
        // Keys with curves are at the times of the take, whatever the rate of the sheet.
        let is_stepped = |name: &String| name.ends_with(".vmd") && !name.ends_with("-keys.vmd");
        assert!(!place.files(o).keys().any(is_stepped));
        let clip = args.split(' ').next().unwrap();
        let output = place.genga(&format!("deliver {o}/sheet.json {clip} --to all --out {o}-all"));
        assert!(text(&output.stderr).contains(note) && output.status.success());
        let by_name = format!("deliver {o}/sheet.json {clip} --to all,vmd --out {o}-vmd");
        assert!(place.refused(1, &by_name).contains("vmd is not made: "));
        assert!(place.path(&format!("{o}-vmd/flipbook.html")).exists(), "the rest is written");
    }
}

#[test]
fn a_format_that_cannot_be_made_stops_no_other() {
    let place = Place::new();
    let fast = "run data/kick.bvh --trim 0..12 --set rate=60";
    let why = "vmd is not made: vmd.fps: 60 koma a second do not go into 30 frames";
    let said = place.refused(1, &format!("{fast} --deliver xdts,vmd,glb --out o --quiet"));
    assert!(said.contains(why) && said.contains("take 60 or more"), "{said}");
    assert!(said.ends_with("genga: one format is not made, as said above; all else is written\n"));
    assert!(read(&place.path("o/report.json")).contains(why));
    let files = place.files("o");
    for file in ["kick_douga_ts.xdts", "limited.glb", "sheet.json", "manifest.json"] {
        assert!(files.contains_key(file), "{file}");
    }
    assert!(!files.contains_key("kick.vmd") && !files.contains_key("kick-bones.csv"));
    // The way out that the reason names.
    place.done(&format!("{fast} --deliver xdts,vmd,glb --with vmd.fps=60 --out o"));
    assert!(place.path("o/kick.vmd").exists());
    // Of nothing that was asked for can anything be made: no folder.
    place.refused(2, "deliver o/sheet.json data/kick.bvh --to vmd --out p");
    assert!(!place.path("p").exists());
}

#[test]
fn pictures_of_a_long_sheet_show_its_beginning_and_say_so() {
    let place = Place::new();
    let most = "--with strip.most=24 --with flipbook.most=10 --with strip.rows=1";
    let said = text(
        &place.genga(&format!("run data/kick.bvh --deliver strip,flipbook {most} --out o")).stderr,
    );
    assert!(said.contains("strip shows the first 24 of 92 koma"), "{said}");
    assert!(said.contains("flipbook shows the first 10 of 92 koma"), "{said}");
    assert!(place.path("o/strip-2.svg").exists() && !place.path("o/strip-5.svg").exists());
    assert!(read(&place.path("o/flipbook.html")).contains("\"koma\":10,"));
    // Known pages of an earlier sheet are removed; unknown ones stay and are named.
    fs::write(place.path("o/strip-9.svg"), "mine").unwrap();
    let less = "run data/kick.bvh --deliver strip --with strip.most=8 --out o";
    let said = text(&place.genga(less).stderr);
    assert!(said.contains("of an earlier sheet, not of this one: strip-9.svg\n"), "{said}");
    assert!(!place.path("o/strip-2.svg").exists() && place.path("o/strip-9.svg").exists());
}

#[test]
fn an_unknown_format_or_setting_lists_the_known_ones() {
    let place = Place::new();
    for (args, option) in [
        ("run data/kick.bvh --deliver json,xdst --out o", "--deliver: xdst: "),
        ("deliver s.json data/kick.bvh --to xdst", "--to: xdst: "),
        ("deliver s.json data/kick.bvh --to json --with csv.mob=1", "--with: csv.mob: "),
    ] {
        let said = place.refused(2, args);
        assert!(said.starts_with(&format!("genga: {option}")), "{said}");
        let known = if option.starts_with("--with") { "csv.bom" } else { "json, csv, " };
        assert!(said.contains("there are ") && said.contains(known), "{said}");
    }
    assert!(place.files(".").is_empty(), "nothing was written");
}

#[cfg(unix)]
#[test]
fn what_is_no_file_is_written_into_and_links_stay() {
    let place = Place::new();
    let expected = place.done("keys data/kick.bvh").into_bytes();
    fs::write(place.path("real.csv"), "before").unwrap();
    std::os::unix::fs::symlink(place.path("real.csv"), place.path("link.csv")).unwrap();
    place.done("keys data/kick.bvh --out link.csv");
    assert!(fs::read(place.path("real.csv")).unwrap() == expected, "through the link");
    assert!(fs::symlink_metadata(place.path("link.csv")).unwrap().is_symlink());
    fs::create_dir(place.path("run")).unwrap();
    std::os::unix::fs::symlink(place.path("real.csv"), place.path("run/keys.csv")).unwrap();
    fs::write(place.path("real.csv"), "before").unwrap();
    place.refused(2, "run data/kick.bvh --out run");
    place.done("run data/kick.bvh --out run --force");
    place.done("run data/kick.bvh --out run");
    assert!(fs::symlink_metadata(place.path("run/keys.csv")).unwrap().is_symlink());
    assert!(fs::read(place.path("real.csv")).unwrap() == expected, "through the link");
    let pipe = place.path("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).unwrap()
    });
    place.done("keys data/kick.bvh --out pipe");
    assert!(!fs::metadata(&pipe).unwrap().is_file(), "the pipe was replaced");
    assert_eq!(reader.join().unwrap(), expected);
}

#[test]
fn the_key_poses_are_a_bvh_by_either_name() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --bvh keys --deliver bvh-keys");
    let keys = read(&place.path("a/keys.bvh"));
    let genga = column(&read(&place.path("a/keys.csv")), "genga_no").len();
    assert!(keys.contains(&format!("\nFrames: {genga}\nFrame Time: 0.041667\n")), "{genga}");
    for (asked, file) in [
        ("--bvh keys", "keys.bvh"),
        ("--bvh stepped", "limited.bvh"),
        ("--to bvh-keys", "keys.bvh"),
    ] {
        fs::create_dir_all(place.path("b")).unwrap();
        place.done(&format!("deliver a/sheet.json data/kick.bvh --out b {asked}"));
        let mut files = [file, "manifest.json"];
        files.sort_unstable();
        assert_eq!(place.files("b").into_keys().collect::<Vec<_>>(), files, "{asked}");
        assert!(place.files("b")[file] == place.files("a")[file], "{asked}");
        fs::remove_dir_all(place.path("b")).unwrap();
    }
    assert!(place.refused(2, "deliver a/sheet.json data/kick.bvh").contains("--to"));
    assert!(
        place.refused(2, "deliver a/sheet.json data/kick.bvh --bvh held").contains("stepped, keys")
    );
}

#[test]
fn a_sheet_that_does_not_fit_says_what_and_leaves_nothing() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    place.done("run data/kick.bvh --out short --trim 0..50");
    let sheet = read(&place.path("a/sheet.json"));
    fs::write(place.path("short.bvh"), read(&place.path("short/limited.bvh"))).unwrap();
    fs::write(place.path("slip.json"), sheet.replacen("\"koma\": 3", "\"koma\": 0", 1)).unwrap();
    fs::write(place.path("later.json"), sheet.replacen("genga-sheet-2", "genga-sheet-3", 1))
        .unwrap();
    fs::write(place.path("kick.bvh"), read(&here("data/kick.bvh")).replace("LeftArm", "Arm_L"))
        .unwrap();
    let empty = sheet.split("\"exposures\"").next().unwrap().to_owned() + "\"exposures\": []}]}";
    fs::write(place.path("empty.json"), empty).unwrap();
    for (args, words) in [
        (
            "a/sheet.json kick.bvh",
            "genga: a/sheet.json: the sheet has the joint LeftArm where the clip has Arm_L",
        ),
        (
            "a/sheet.json short.bvh",
            "genga: a/sheet.json: the sheet shows frames 0 to 91, the clip has frames 0 to 49\n",
        ),
        (
            "a/sheet.json data/kick.bvh --fps 60",
            "is for 24 frames a second, the clip has 60; if it is the same take, --fps 24",
        ),
        ("slip.json data/kick.bvh", ": an exposure of 0 koma is not seen"),
        (
            "later.json data/kick.bvh",
            "genga: later.json:2:13: the sheet is of the schema genga-sheet-3",
        ),
        ("data/kick.bvh data/kick.bvh", "data/kick.bvh: this is no sheet of genga"),
        ("none.json data/kick.bvh", "genga: none.json: "),
        ("a/sheet.json none.bvh", "genga: none.bvh: "),
        ("empty.json data/kick.bvh", "the sheet is empty"),
    ] {
        let said = place.refused(1, &format!("deliver {args} --to json,bvh --out o/p"));
        assert!(said.contains(words), "{args}: {said}");
        assert_eq!(said.matches('\n').count(), 1, "{said}");
        assert!(!place.path("o").exists(), "{args} left something");
    }
    let said = place.refused(1, "deliver slip.json data/kick.bvh --to all --out o");
    let line = sheet.lines().position(|line| line.contains("\"koma\": 3")).unwrap() + 1;
    assert!(said.starts_with(&format!("genga: slip.json:{line}:9: ")), "{said}");
    assert!(place.refused(2, "deliver - - --to all").contains("both"));
    assert!(
        place.refused(2, "deliver a/sheet.json data/kick.bvh --to all --out -").contains("--out")
    );
}

#[test]
fn a_folder_that_cannot_be_written_leaves_nothing_half_written() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let before = place.files("a");
    fs::write(place.path("file"), "mine").unwrap();
    for out in ["file", "file/under"] {
        place.refused(1, &format!("deliver a/sheet.json data/kick.bvh --to all --out {out}"));
        place.refused(1, &format!("run data/kick.bvh --out {out}"));
    }
    assert_eq!(read(&place.path("file")), "mine");
    // If one of several files cannot be placed, none is.
    fs::create_dir_all(place.path("o/remap.csv")).unwrap();
    let said = place.refused(1, "deliver a/sheet.json data/kick.bvh --to all --out o");
    assert!(said.contains("remap.csv: is a folder"), "{said}");
    assert!(place.files("o").is_empty());
    assert!(place.files("a") == before);
}

#[test]
fn another_motion_on_the_same_frames_is_taken_with_a_note() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a");
    let clip = read(&here("data/kick.bvh"));
    let (head, last) = clip.trim_end().rsplit_once(' ').unwrap();
    fs::write(
        place.path("cleaned.bvh"),
        format!("{head} {}\n", last.parse::<f64>().unwrap() + 1.0),
    )
    .unwrap();
    let output = place.genga("deliver a/sheet.json cleaned.bvh --to bvh --out b");
    assert!(output.status.success());
    assert!(text(&output.stderr).contains("[W_SHEET_MOTION]"), "{}", text(&output.stderr));
    assert!(place.files("b")["limited.bvh"] != place.files("a")["limited.bvh"]);
    let output = place.genga("deliver a/sheet.json data/kick.bvh --to bvh --out c");
    assert!(!text(&output.stderr).contains("W_SHEET"), "{}", text(&output.stderr));
}

#[test]
fn tables_begin_with_a_mark_where_that_is_asked_for() {
    let place = Place::new();
    place.done("run data/kick.bvh --out a --with csv.bom=true");
    place.done("run data/kick.bvh --out b");
    let (a, b) = (place.files("a"), place.files("b"));
    for file in ["keys.csv", "drawings.csv", "sheet.csv", "remap.csv"] {
        assert!(a[file] == [b"\xef\xbb\xbf", &b[file][..]].concat(), "{file}");
    }
    assert!(
        place
            .refused(2, "run data/kick.bvh --with csv.bom=1 --out c")
            .contains("csv.bom: expected true | false, found \"1\"")
    );
}

#[cfg(unix)]
#[test]
fn files_that_wait_for_their_places_are_not_open() {
    let place = Place::new();
    let clip = here("data/kick.bvh");
    let script = format!(
        "ulimit -n 12; exec '{}' run '{}' --trim 0..12 --deliver all --out o",
        env!("CARGO_BIN_EXE_genga"),
        clip.display()
    );
    let mut command = Command::new("sh");
    let output = command.arg("-c").arg(script).current_dir(place.0.path()).output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(place.files("o").len() > 11);
}

#[test]
fn the_motion_for_mmd_says_which_joints_it_leaves_out_and_takes_a_table_of_bones() {
    let place = Place::new();
    let said = text(&place.genga("run data/kick.bvh --deliver vmd --out a").stderr);
    let note = "no bone for LeftToeBase, RightToeBase";
    assert!(said.contains(note) && said.contains("kick.vmd kick-bones.csv"), "{said}");
    assert!(read(&place.path("a/report.json")).contains(note));
    assert!(read(&place.path("a/kick-bones.csv")).contains("LeftToeBase,,left_out\n"));
    assert!(
        fs::read(place.path("a/kick.vmd")).unwrap().starts_with(b"Vocaloid Motion Data 0002\0")
    );
    let toes = ["左", "右"].map(|side| {
        let joint = if side == "左" { "LeftToeBase" } else { "RightToeBase" };
        format!("[extra.\"{side}足先EX\"]\nparent = \"{side}足首\"\njoints = \"{joint}\"\n")
    });
    fs::write(place.path("bones.toml"), toes.concat()).unwrap();
    let again = "deliver a/sheet.json data/kick.bvh --to vmd --out b --bones bones.toml";
    let said = text(&place.genga(again).stderr);
    assert!(!said.contains("no bone"), "{said}");
    assert!(read(&place.path("b/kick-bones.csv")).contains("LeftToeBase,左足先EX,drives\n"));
    fs::write(place.path("bones.toml"), "[bones]\n\"左うで\" = \"A\"\n").unwrap();
    let said = place.refused(2, again);
    assert!(said.contains("--bones: ") && said.contains("2:1: there is no bone 左うで"), "{said}");
}

/// Makes a PMD with some bones, each the child of the one before.
fn pmd(bones: &[(&str, [f32; 3])]) -> Vec<u8> {
    let name = |text: &str| {
        let mut field = encoding_rs::SHIFT_JIS.encode(text).0.into_owned();
        field.resize(20, 0);
        field
    };
    // Signature, version, name, comment; no vertices, no faces, no materials.
    let mut file = [b"Pmd\0\0\x80\x3f", &*name("人形"), &[0; 256 + 3 * 4]].concat();
    file.extend((bones.len() as u16).to_le_bytes());
    for (at, (bone, place)) in bones.iter().enumerate() {
        let parent = at.checked_sub(1).map_or(u16::MAX, |parent| parent as u16);
        file.extend([name(bone), parent.to_le_bytes().to_vec(), vec![0; 5]].concat());
        place.iter().for_each(|axis| file.extend(axis.to_le_bytes()));
    }
    file.extend([0; 2]);
    file
}

#[test]
fn the_motion_for_mmd_fits_the_model_whose_file_is_given() {
    let place = Place::new();
    let bones = [
        ("センター", [0.0, 8.0, 0.0]),
        ("上半身", [0.0, 12.0, 0.0]),
        ("左腕", [1.0, 15.0, 0.0]),
        ("左ひじ", [3.0, 13.0, 0.0]),
    ];
    fs::write(place.path("doll.PMD"), pmd(&bones)).unwrap();
    let run = |more: &str| format!("run data/kick.bvh --deliver vmd --with {more} --out a");
    let said = text(&place.genga(&run("vmd.model=doll.PMD")).stderr);
    assert!(said.contains("the model has no bone 下半身, 首, "), "{said}");
    let table = read(&place.path("a/kick-bones.csv"));
    let driven: BTreeSet<&str> = table
        .lines()
        .filter(|line| line.ends_with(",drives"))
        .filter_map(|line| line.split(',').nth(1))
        .collect();
    assert_eq!(driven, bones.iter().map(|(bone, _)| *bone).collect());
    let motion = fs::read(place.path("a/kick.vmd")).unwrap();
    assert_eq!(encoding_rs::SHIFT_JIS.decode(&motion[30..34]).0, "人形");
    // A name without a model file is used as it is.
    place.done(&run("vmd.model=doll"));
    assert!(fs::read(place.path("a/kick.vmd")).unwrap()[30..].starts_with(b"doll\0"));
    let mut file = pmd(&bones);
    file.truncate(320);
    fs::write(place.path("half.pmd"), file).unwrap();
    let said = place.refused(1, &run("vmd.model=half.pmd"));
    assert!(said.contains("half.pmd: byte 295: 4 bones do not go into the 23 bytes"), "{said}");
    fs::write(place.path("doll.bak"), "").unwrap();
    let said = place.refused(2, &run("vmd.model=doll.bak"));
    assert!(said.contains("doll.bak is no model (.pmx, .pmd), nor the name of one"), "{said}");
    let said = place.refused(1, &run("vmd.model=none.pmx"));
    assert!(said.contains("none.pmx: "), "{said}");
}

#[test]
fn a_command_line_that_was_not_understood_says_what_to_type() {
    let place = Place::new();
    fs::copy(here("data/kick.bvh"), place.path("kick.bvh")).unwrap();
    fs::copy(here("data/kick.bvh"), place.path("more.bvh")).unwrap();
    fs::create_dir(place.path("takes")).unwrap();
    fs::copy(here("data/kick.bvh"), place.path("takes/first.bvh")).unwrap();
    fs::create_dir(place.path("empty")).unwrap();
    place.done("run kick.bvh --out made");
    fs::rename(place.path("made/sheet.json"), place.path("sheet.json")).unwrap();
    for (args, say) in [
        ("kick.bvh", "genga run kick.bvh"),
        ("kick.bvh --keys 8", "genga run kick.bvh"),
        ("takes", "genga run takes/first.bvh"),
        ("rnu kick.bvh", "did you mean run?"),
        ("help layers", "formats in genga help deliver"),
        ("inspct kick.bvh", "'inspect'"),
        ("run kick.bvh more.bvh", "of many: genga batch kick.bvh more.bvh --out library"),
        ("run --out o kick.bvh more.bvh", "of many: genga batch kick.bvh more.bvh --out library"),
        ("split kick.bvh more.bvh", "takes one clip at a time; run genga split for each"),
        ("-q inspect kick.bvh more.bvh", "takes one clip at a time; run genga inspect for each"),
        ("omit kick.bvh", "give one of --out, --table, --sheet, --plot"),
        ("omit kick.bvh more.bvh", "(of several clips: --table)"),
        ("deliver sheet.json kick.bvh --out o", "--to help lists the formats"),
        ("eval kick.bvh more.bvh", "run it for each: genga eval SHEET --clip CLIP"),
        (
            "eval kick.bvh more.bvh --clip kick.bvh",
            "takes one sheet at a time, and its motion after --clip",
        ),
        ("keys kick.bvh more.bvh", "one clip at a time"),
        ("run takes", "such as takes/first.bvh; of all: genga batch takes --out library"),
        (
            "run sheet.json",
            "sheet.json is a sheet and no motion; for files of it: genga deliver sheet.json",
        ),
        ("keys kick.bvh --fps -24", "expected frames a second"),
        ("inspect takes", "such as takes/first.bvh"),
        ("run empty", "a folder without a motion file"),
    ] {
        let output = place.genga(args);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{args}: {errors}");
        assert!(errors.contains(say), "genga {args} says:\n{errors}");
    }
    fs::copy(here("data/kick.bvh"), place.path("a b.bvh")).unwrap();
    let output = place.command(&["run", "kick.bvh", "a b.bvh"]).output().unwrap();
    let errors = text(&output.stderr);
    assert!(errors.contains("genga batch kick.bvh \"a b.bvh\" --out library"), "{errors}");
}

#[test]
fn a_study_says_where_its_files_are() {
    let place = Place::new();
    let args = "study data/kick.bvh --filter-width 10,20 --persistence 5 --out table.csv --plot curves.svg";
    let said = text(&place.genga(args).stderr);
    assert!(said.contains("files       curves.svg table.csv"), "{said}");
    let said =
        text(&place.genga("study data/kick.bvh --filter-width 10,20 --persistence 5").stderr);
    assert!(!said.contains("files"), "what goes to stdout is seen: {said}");
}

#[cfg(unix)]
#[test]
fn what_never_ends_is_read_up_to_a_limit_and_work_keeps_within_its_own() {
    let place = Place::new();
    let endless = place.refused(1, "keys /dev/zero --memory 0.01");
    assert!(endless.contains("/dev/zero: more than 10 MiB came"), "{endless}");
    assert!(endless.contains("save it as a file") && endless.contains("--memory"), "{endless}");
    for work in ["keys", "study", "compare"] {
        let refused = place.refused(1, &format!("{work} data/kick.bvh --memory 0.0001"));
        let of =
            refused.contains("data/kick.bvh: 23 joints in 92 frames and on 92 koma take about");
        assert!(of && refused.contains("--memory 1 allows it"), "{work}: {refused}");
    }
}

#[test]
fn a_results_folder_is_delivered_by_its_sheet_and_a_table_is_refused() {
    let place = Place::new();
    place.done("run data/kick.bvh --deliver xdts --out a");
    place.done("deliver a data/kick.bvh --to remap --out b");
    assert_eq!(
        fs::read(place.path("b/remap.csv")).unwrap(),
        fs::read(place.path("a/remap.csv")).unwrap()
    );
    place.done("deliver a/kick_douga_ts.xdts data/kick.bvh --drawings a --to remap --out c");
    let said = place.refused(2, "deliver a/sheet.csv data/kick.bvh --to remap");
    assert!(
        said.contains("a/sheet.csv: a table is no sheet") && said.contains("--pin-from"),
        "{said}"
    );
    let note = "from a table only keys are taken, not the timing";
    assert!(place.said("run data/kick.bvh --pin-from a/sheet.csv --out d").contains(note));
    assert!(!place.said("run data/kick.bvh --pin-from a/keys.csv --out e").contains(note));
}

#[test]
fn a_file_of_markers_is_refused_as_such_by_its_name() {
    let place = Place::new();
    fs::write(place.path("short.C3D"), [2, 0x50, 0]).unwrap();
    let said = place.refused(1, "run short.C3D");
    assert!(said.contains("short.C3D: these are the paths of markers and no skeleton"), "{said}");
}

#[test]
fn a_length_is_also_taken_as_seconds_and_koma() {
    let place = Place::new();
    let said = place.said("run data/kick.bvh --at 1+0 --length 5+1 --out a");
    assert!(said.contains("koma 1 to 23 and 116 to 121 of 121"), "{said}");
    place.said("deliver a data/kick.bvh --length 5+2 --to remap --out b");
    place.refused(2, "run data/kick.bvh --length 0+0 --out a");
}

#[test]
fn an_unknown_option_is_not_offered_as_a_value() {
    let place = Place::new();
    for args in ["inspect --json", "inspect data/kick.bvh --json", "study --wide", "run --wide"] {
        let said = place.refused(2, args);
        assert!(said.contains("unexpected argument"), "{said}");
        assert!(!said.contains("as a value"), "{said}");
    }
}

#[test]
fn omit_writes_a_sheet_alone_and_a_caption_names_the_seed() {
    let place = Place::new();
    place.done("omit data/kick.bvh --sheet sheet.csv");
    place.done("study data/kick.bvh --x noise=0,1 --heat map.svg --caption a.md --out a.csv");
    let caption = fs::read_to_string(place.path("a.md")).unwrap();
    assert!(caption.contains("noise.seed 0"), "{caption}");
}

#[test]
fn what_the_system_refuses_is_said_in_words_with_a_way_out() {
    let place = Place::new();
    place.done("run data/kick.bvh --out kick");
    fs::create_dir(place.path("folder")).unwrap();
    fs::write(place.path("plain"), "").unwrap();
    let missing = "there is no such file or folder; check its name, and the folder that you are in";
    for args in [
        "run none",
        "keys none",
        "inspect none",
        "study none",
        "eval none --clip data/kick.bvh",
        "eval kick/sheet.json --clip none",
        "compare none",
        "deliver none data/kick.bvh --to xdts",
        "run data/kick.bvh --recipe none",
        "run data/kick.bvh --bones none",
        "batch none --out library",
        "batch @none --out library",
        "batch --join none --out library",
        "trial --read none",
    ] {
        let said = place.refused(1, args);
        assert_eq!(said, format!("genga: none: {missing}\n"), "{args}");
    }
    fs::write(place.path("house.toml"), place.done("recipe")).unwrap();
    for (what, args) in [
        ("recipe", "keys data/kick.bvh --recipe house.toml --out house.toml"),
        ("recipe", "study data/kick.bvh --recipe house.toml --out house.toml"),
        ("recipe", "compare data/kick.bvh --recipe house.toml --out house.toml"),
        ("file of layers", "keys data/kick.bvh --layers house.toml --out house.toml"),
    ] {
        let said = place.refused(2, args);
        assert!(said.contains(&format!("this is the {what} itself")), "{args}: {said}");
    }
    let said = place.refused(2, "run data/kick.bvh --recipe data/kick.bvh");
    assert!(said.contains("data/kick.bvh: is a motion and no recipe"), "{said}");
    let said = place.refused(2, "eval folder --clip data/kick.bvh");
    assert!(said.contains("folder: there is no sheet.json in this folder"), "{said}");
    let said = place.refused(2, "run data/kick.bvh --naka-nashi 4");
    assert!(said.contains("it is a setting: --set omission.naka_nashi=VALUE"), "{said}");
    let (folder, file) = ("is a folder; name a file", "is a file; name a folder");
    for (args, says) in [
        (
            "run data/kick.bvh --recipe folder",
            "folder/recipe.toml: there is no such file or folder; check its name, and the folder that you are in".into(),
        ),
        ("omit data/kick.bvh --out folder", format!("folder: {folder}")),
        (
            "omit data/kick.bvh --out none/a.bvh",
            "none: there is no such folder; make it first".into(),
        ),
        ("run data/kick.bvh --out plain", format!("plain: {file}")),
        ("run data/kick.bvh --out plain/deep", format!("plain: {file}")),
        ("batch data/kick.bvh --out plain", format!("plain: {file}")),
        ("batch data/kick.bvh --out plain/deep", format!("plain: {file}")),
        (
            "batch --join plain --out library",
            "plain: a part of this path is a file and no folder; check the path".into(),
        ),
    ] {
        assert_eq!(place.refused(1, args), format!("genga: {says}\n"), "{args}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_called_full() {
    let place = Place::new();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = place.command(&words("keys data/kick.bvh")).stdout(full).output().unwrap();
    let said = text(&output.stderr);
    assert!(said.ends_with("stdout: the disk is full; make room, or write elsewhere\n"), "{said}");
}

#[test]
fn a_trim_without_frames_says_what_would_be_one() {
    let place = Place::new();
    for (trim, says) in [
        ("5..5", "5..5: it is empty, for the last number is not included; 5..6 is one frame"),
        ("0..0", "0..0: it is empty, for the last number is not included; 0..1 is one frame"),
        ("9..2", "9..2: it ends before it begins"),
        ("200..", "200..: the motion has frames 0 to 91"),
        ("92..92", "92..92: it is empty, for the last number is not included; 92..93 is one frame"),
        ("80..93", "80..93: the clip has frames 0 to 91"),
    ] {
        let said = place.refused(2, &format!("inspect data/kick.bvh --trim {trim}"));
        assert_eq!(said, format!("genga: --trim: cannot keep frames {says}\n"));
    }
}
