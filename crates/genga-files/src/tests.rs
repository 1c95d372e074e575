//! Snapshots of every deliverable of a small clip: read them as an animator would.

mod edited_sheets;
mod kept_numbers;
mod numbers;
mod timesheets;
mod wrong;

use super::*;
use genga::edits::{Edits, Pin};
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::Frame;

const HEAD: &str = "\
HIERARCHY
ROOT Hips
{
\tOFFSET 0 0 0
\tCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
\tJOINT Arm
\t{
\t\tOFFSET 0 50 0
\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\tJOINT Hand
\t\t{
\t\t\tOFFSET 30 0 0
\t\t\tCHANNELS 3 Zrotation Xrotation Yrotation
\t\t\tEnd Site
\t\t\t{
\t\t\t\tOFFSET 20 0 0
\t\t\t}
\t\t}
\t}
}
MOTION
";

/// Angles of the arm in degrees, by time in seconds. The hand follows with half the angle, a little later.
const ARM: [(f64, f64); 7] = [
    (0.0, 0.0),
    (0.35, 0.0),
    (0.8, 100.0),
    (1.15, 100.0),
    (1.4, -40.0),
    (1.5, -25.0),
    (2.0, -25.0),
];

/// Interpolates between the angles with a minimum-jerk curve.
fn arm(time: f64) -> f64 {
    let after = ARM.iter().position(|key| key.0 > time).unwrap_or(ARM.len());
    if after == 0 || after == ARM.len() {
        return ARM[after.min(ARM.len() - 1)].1;
    }
    let ((t0, from), (t1, to)) = (ARM[after - 1], ARM[after]);
    let u = (time - t0) / (t1 - t0);
    from + (to - from) * u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u)
}

/// A waving arm at 50 frames per second: raised, held, thrown down, settled. Frames are numbered from 4, as
/// after a lead-in. Values have four decimals, as files do.
pub(crate) fn wave() -> Clip {
    let row = |frame: i32| {
        let time = f64::from(frame) / 50.0;
        let (arm, hand) = (arm(time), 0.5 * arm(time - 0.06));
        format!(
            "0 {:.4} 0 {:.4} 0 0 {arm:.4} 0 {:.4} {hand:.4} 0 0\n",
            90.0 - 0.02 * arm,
            0.05 * arm,
            0.1 * arm
        )
    };
    let rows: String = (-4..=100).map(row).collect();
    let text = format!("{HEAD}Frames: 105\nFrame Time: 0.02\n{rows}");
    bvh::read(text.as_bytes()).unwrap().clip.trimmed(Frame(4), Frame(105)).unwrap()
}

pub(crate) fn recipe() -> Recipe {
    let mut recipe = Recipe::default();
    for (knob, value) in [
        ("omission.naka_nashi", "2"),
        ("omission.fast", "0"),
        ("keys.min_price", "2.5"),
        ("keys.per_second", "4.5"),
        ("spacing.on", "2"),
        ("spacing.drift", "0"),
        ("keys.rest", "15"),
    ] {
        recipe.set(knob, value).unwrap();
    }
    recipe
}

pub(crate) fn edits() -> Edits {
    let pin = Pin { weight: Some(0.5), ..Pin::parse("66:top, \"held\"").unwrap() };
    Edits { pins: vec![pin], ..Edits::default() }
}

/// A deliverable by its file name.
fn made(file: &str) -> String {
    let (recipe, edits) = (recipe(), edits());
    let mut engine = Engine::new(wave()).unwrap();
    let breakdown = engine.run(&recipe, &edits).unwrap();
    let (clip, sheet) = (breakdown.clip, breakdown.sheet);
    let table = |rows| Drawings { cut: "wave".into(), rows }.write(clip, sheet).unwrap();
    match file {
        "keys.csv" => table(Rows::Keys),
        "drawings.csv" => table(Rows::All),
        "sheet.csv" => sheet_csv(sheet).unwrap(),
        "remap.csv" => remap_csv(sheet).unwrap(),
        "turns.csv" => turns_csv(clip.skeleton(), breakdown.filtered, breakdown.turns).unwrap(),
        "limited.bvh" => limited_bvh(clip, sheet).unwrap(),
        "keys.bvh" => keys_bvh(clip, sheet).unwrap(),
        "recipe.toml" => recipe.write(&edits),
        "report.json" => {
            let report = Report::new(&breakdown, vec!["a note".into()]);
            // The library does not need JSON here: the program writes it from the same fields.
            format!("{report:#?}\n")
        }
        _ => panic!("{file} is not made"),
    }
}

#[test]
fn the_key_table_looks_as_it_did() {
    insta::assert_snapshot!(made("keys.csv"));
}

#[test]
fn the_table_of_drawings_looks_as_it_did() {
    insta::assert_snapshot!(made("drawings.csv"));
}

#[test]
fn the_sheet_looks_as_it_did() {
    insta::assert_snapshot!(made("sheet.csv"));
}

#[test]
fn the_remap_looks_as_it_did() {
    insta::assert_snapshot!(made("remap.csv"));
}

#[test]
fn the_turns_look_as_they_did() {
    insta::assert_snapshot!(made("turns.csv"));
}

#[test]
fn the_limited_motion_looks_as_it_did() {
    insta::assert_snapshot!(made("limited.bvh"));
}

#[test]
fn the_stepped_clip_is_what_its_file_has() {
    let mut engine = Engine::new(wave()).unwrap();
    for root in ["drawings", "ones"] {
        let mut recipe = recipe();
        recipe.set("root", root).unwrap();
        let breakdown = engine.run(&recipe, &edits()).unwrap();
        let stepped = limited(breakdown.clip, breakdown.sheet).unwrap();
        assert_eq!(stepped.len(), breakdown.sheet.length());
        assert_eq!(bvh::write(&stepped), limited_bvh(breakdown.clip, breakdown.sheet).unwrap());
    }
}

#[test]
fn the_key_poses_look_as_they_did() {
    insta::assert_snapshot!(made("keys.bvh"));
}

#[test]
fn a_row_of_the_key_poses_is_a_genga_as_it_stands_on_its_koma() {
    let motion = |file: &str| {
        let text = made(file);
        let (head, rows) = text.split_once("Frame Time:").unwrap();
        let rows: Vec<String> = rows.lines().skip(1).map(String::from).collect();
        (head.split("MOTION").next().unwrap().to_owned(), rows)
    };
    let ((head, keys), (stepped_head, stepped)) = (motion("keys.bvh"), motion("limited.bvh"));
    assert_eq!(head, stepped_head);
    let text = made("keys.csv");
    let rows = csv::Reader::from_reader(text.as_bytes()).into_records().map(|row| row.unwrap());
    let shown: Vec<String> =
        rows.map(|row| stepped[row[6].parse::<usize>().unwrap() - 1].clone()).collect();
    assert_eq!(keys, shown);
}

#[test]
fn the_recipe_looks_as_it_did() {
    insta::assert_snapshot!(made("recipe.toml"));
}

#[test]
fn the_report_looks_as_it_did() {
    insta::assert_snapshot!(made("report.json"));
}

#[test]
fn the_tables_agree_with_each_other() {
    let rows = |file| -> Vec<csv::StringRecord> {
        csv::Reader::from_reader(made(file).as_bytes()).records().map(|row| row.unwrap()).collect()
    };
    let (drawings, sheet, remap) = (rows("drawings.csv"), rows("sheet.csv"), rows("remap.csv"));
    let keys: Vec<_> = drawings.iter().filter(|row| &row[3] != "inbetween").cloned().collect();
    assert_eq!(keys, rows("keys.csv"), "keys.csv is the kept rows of drawings.csv");
    assert_eq!(sheet.len(), remap.len());
    let mut koma = sheet.iter().zip(&remap);
    for drawing in &drawings {
        for held in 0..drawing[7].parse::<usize>().unwrap() {
            let (sheet, remap) = koma.next().unwrap();
            let number = drawing[6].parse::<usize>().unwrap() + held;
            assert_eq!(sheet[0], number.to_string());
            assert_eq!((&sheet[2], &sheet[3], &sheet[4]), (&drawing[2], &drawing[3], &drawing[9]));
            assert_eq!((&remap[0], &remap[1], &remap[2]), (&sheet[0], &sheet[4], &drawing[10]));
            assert_eq!(sheet[5], drawing[16], "why");
        }
    }
    assert!(koma.next().is_none());
}

#[test]
fn an_empty_sheet_has_headers_and_no_motion() {
    let clip = wave();
    let sheet = genga::sheet::Sheet::on_ones(clip.clock(24.0), 0);
    assert_eq!(sheet_csv(&sheet).unwrap(), "koma,layer,drawing,role,source_frame,why\n");
    assert_eq!(remap_csv(&sheet).unwrap(), "koma,source_frame,source_time_s,nearest_frame\n");
    let table = Drawings { cut: "wave".into(), rows: Rows::All }.write(&clip, &sheet).unwrap();
    assert_eq!(table.lines().count(), 1);
    assert!(limited_bvh(&clip, &sheet).is_err() && limited(&clip, &sheet).is_err());
    assert!(keys_bvh(&clip, &sheet).is_err());
}
