//! Tests the options of the reader.

use super::{OTHER_ROW, clip, sample, with};
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};
use crate::motion::bvh::{Options, Read, read};
use crate::motion::{Clip, JointId};
use crate::time::{Frame, FrameRate};

fn rate(fps: f64) -> Options {
    Options { fps: Some(FrameRate::new(fps).unwrap()), ..Options::default() }
}

fn root(name: &str) -> Options {
    Options { root: Some(name.into()), ..Options::default() }
}

/// The clip and the one warning of a repaired text.
fn repaired(text: &str) -> (Clip, String) {
    let repair = Options { repair: true, ..Options::default() };
    let Read { clip, warnings, .. } = repair.read(text.as_bytes()).unwrap();
    let [warning] = &warnings[..] else { panic!("one warning: {warnings:?}") };
    (clip, warning.to_string())
}

#[test]
fn options_have_names_in_files_and_no_others() {
    let options: Options = toml::from_str("fps = 24.0\nroot = \"Hips\"\nrepair = true").unwrap();
    assert_eq!(options, Options { repair: true, root: Some("Hips".into()), ..rate(24.0) });
    assert_eq!(toml::from_str::<Options>("").unwrap(), Options::default());
    assert!(toml::from_str::<Options>("fps = 0.0").is_err());
    assert!(toml::from_str::<Options>("strikt = true").is_err());
}

#[test]
fn a_rate_that_is_asked_for_takes_the_place_of_any_frame_time() {
    for (time, written) in [("0", 0.0), ("-0.04", -0.04), ("30", 30.0), ("0.0083333", 0.0083333)] {
        let text = text(time, &[ROW, OTHER_ROW]);
        let read = rate(29.0).read(text.as_bytes()).unwrap();
        assert_eq!((read.clip.rate().fps(), read.written_frame_time), (29.0, written));
        assert_eq!(read.clip.with_rate(FrameRate::new(120.0).unwrap()), clip(&sample()));
        assert_eq!(read.warnings, []);
    }
    let nan = rate(29.0).read(text("nan", &[ROW]).as_bytes()).unwrap();
    assert!(nan.written_frame_time.is_nan());
    assert!(rate(29.0).read(text("fast", &[ROW]).as_bytes()).is_err());
}

#[test]
fn the_frame_time_is_told_as_the_file_writes_it() {
    let read = read(sample().as_bytes()).unwrap();
    assert_eq!((read.written_frame_time, read.clip.rate().fps()), (0.0083333, 120.0));
}

/// A file of two bodies with the same names, and a ball between them that only moves.
fn three_trees() -> String {
    let ball = "ROOT ball\n{\n\tOFFSET 0 0 0\n\tCHANNELS 2 Xposition Wscale\n}\n";
    let body = HIERARCHY.trim_start_matches("HIERARCHY\n").replace("Spine", "Head");
    let trees = format!("HIERARCHY\n{body}{ball}{body}");
    text("0.01", &["1 2 3 4 5 6 7 8 9 100 0 11 12 13 14 15 16 17 18 19"]).replace(HIERARCHY, &trees)
}

#[test]
fn a_tree_that_is_asked_for_comes_alone_with_its_columns_and_names() {
    let text = three_trees();
    for (name, joints, row) in [
        ("Hips", vec!["Hips", "Head"], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
        ("ball", vec!["ball"], vec![100.0]),
        (
            "Hips.2",
            vec!["Hips", "Head"],
            vec![11.0, 12.0, 13.0, 14.0, 15.0, 16.0, 17.0, 18.0, 19.0],
        ),
    ] {
        let Read { clip, .. } = root(name).read(text.as_bytes()).unwrap();
        let names: Vec<_> = clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
        assert_eq!((names, clip.row(Frame(0))), (joints, &row[..]), "{name}");
        let parents: Vec<_> = clip.skeleton().iter().map(|(_, joint)| joint.parent).collect();
        let last = clip.skeleton().joints.last().unwrap();
        if row.len() == 9 {
            assert_eq!((parents, last.first_channel), (vec![None, Some(JointId(0))], 6), "{name}");
        } else {
            assert_eq!((parents, last.first_channel), (vec![None], 0), "{name}");
        }
    }
    let error = root("Sword").read(text.as_bytes()).unwrap_err().to_string();
    let trees = "\"Hips\" (2 joints, with hip and head), \"ball\" (1 joint), \"Hips.2\" (2 joints, with hip and head)";
    assert_eq!(error, format!("root: no tree is called \"Sword\"; the file has {trees}"));
    assert!(root("Hips").read(sample().as_bytes()).is_ok());
}

#[test]
fn all_trees_are_read_unless_one_is_asked_for() {
    let Read { clip, warnings, .. } = read(three_trees().as_bytes()).unwrap();
    let names: Vec<_> = clip.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["Hips", "Head", "ball", "Hips.2", "Head.2"]);
    let codes: Vec<_> = warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(
        codes,
        ["W_ROOTS", "W_CHANNEL_UNKNOWN", "W_NAME_TWICE"],
        "in the order of the lines"
    );
    assert!(warnings[2].message.ends_with("(the first of 2)"), "{}", warnings[2]);
    let strict = Options { strict: true, ..Options::default() };
    let error = strict.read(three_trees().as_bytes()).unwrap_err();
    assert_eq!(error.position(), warnings[0].place);
}

#[test]
fn a_tree_that_was_asked_for_is_nothing_to_warn_of() {
    let strict = Options { strict: true, ..root("Hips.2") };
    let text =
        three_trees().replace("CHANNELS 2 Xposition Wscale", "CHANNELS 2 Xposition Yposition");
    assert!(strict.read(text.as_bytes()).is_ok());
}

#[test]
fn repair_holds_the_value_before_one_that_is_none() {
    let rows = ["1 nan 3 4 5 6 7 8 9", "1 2 3 4 inf 6 7 8 nan", "1 3 3 1e999 9 6 7 8 -1.#IND00"];
    let (clip, warning) = repaired(&text("0.01", &rows));
    let held: Vec<f64> = clip.rows().flatten().copied().collect();
    let first = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
    let third = [1.0, 3.0, 3.0, 4.0, 9.0, 6.0, 7.0, 8.0, 9.0];
    assert_eq!(held, [first, first, third].concat());
    let message = "19:3: expected a number for Yposition of \"Hips\" in frame 0, found none; the value before it is held (the first of 5) [W_VALUE_HELD]";
    assert_eq!(warning, message);
}

#[test]
fn a_channel_without_any_value_rests() {
    let (clip, _) = repaired(&text("0.01", &["1 nan 3 nan 5 6 7 8 9"; 2]));
    for row in clip.rows() {
        assert_eq!(row, [1.0, 1.0, 3.0, 0.0, 5.0, 6.0, 7.0, 8.0, 9.0], "OFFSET 0 1 0");
    }
}

#[test]
fn repair_leaves_out_what_is_too_much_in_a_row() {
    let long = format!("{ROW} 70 80");
    let (clip, warning) = repaired(&text("0.01", &[OTHER_ROW, &long, OTHER_ROW, &long, OTHER_ROW]));
    assert_eq!(clip.len(), 5);
    for (frame, row) in clip.rows().enumerate() {
        let first = if frame % 2 == 0 { 1.0 } else { 0.0 };
        assert_eq!((row[0], row.len()), (first, 9));
    }
    let message = "20:25: expected 9 values in this row, found 11; the rest is left out (the first of 2) [W_ROW_CUT]";
    assert_eq!(warning, message);
    let all_long = text("0.01", &[&long[..]; 3]).replace("Frames: 3", "Frames: 7");
    let repair = Options { repair: true, ..Options::default() };
    let Read { clip, warnings, .. } = repair.read(all_long.as_bytes()).unwrap();
    assert_eq!((clip.len(), warnings.len()), (3, 2));
    assert_eq!(clip.row(Frame(2))[8], 60.0);
}

#[test]
fn repair_mends_nothing_else() {
    let repair = Options { repair: true, ..Options::default() };
    let short = "1 2 3 4 5 6 7 8";
    for text in [
        with(" 20 ", " abc "),
        with("OFFSET 0 2 0", "OFFSET 0 nan 0"),
        text("0.01", &[short, ROW]),
        text("0.01", &[short, &format!("{ROW} 1"), ROW]),
        text("nan", &[ROW]),
    ] {
        assert!(repair.read(text.as_bytes()).is_err(), "{text}");
    }
    let plain = repair.read(sample().as_bytes()).unwrap();
    assert_eq!((plain.clip, plain.warnings), (clip(&sample()), vec![]));
}
