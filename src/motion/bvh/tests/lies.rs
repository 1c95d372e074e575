//! Tests files that lie about their size: they give an error or a result at once, in memory proportional to
//! the file.

use super::{clip, with};
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};
use crate::motion::bvh::{Options, read, write};

#[test]
fn a_file_that_lies_about_its_frames_reserves_no_more_than_it_can_hold() {
    let text = with("Frames: 2", "Frames: 1e300");
    assert_eq!(read(text.as_bytes()).unwrap().clip.len(), 2);
}

#[test]
fn ten_thousand_levels_are_read_and_written_without_recursion() {
    let levels = 10_000;
    let joint = |level| format!("JOINT a{level}\n{{\nOFFSET 0 1 0\n");
    let open: String = (0..levels).map(joint).collect();
    let text = with("\tJOINT", &format!("{open}JOINT")).replacen(
        "MOTION",
        &format!("{}MOTION", "}".repeat(levels)),
        1,
    );
    let clip = clip(&text);
    assert_eq!(clip.skeleton().len(), levels + 2);
    let written = write(&clip);
    assert!(written.len() < 3_000_000, "{}", written.len());
    assert_eq!(read(written.as_bytes()).unwrap().clip, clip);
}

/// Large enough that quadratic work would not finish in a reasonable time.
const MANY: usize = 200_000;

#[test]
fn joints_that_all_have_one_name_or_none_get_names_in_linear_time() {
    for name in ["a", "", "腰"] {
        let joint = format!("JOINT {name}\n{{\nOFFSET 0 1 0\n}}\n").repeat(MANY);
        let clip = read(with("\tJOINT", &format!("{joint}JOINT")).as_bytes()).unwrap().clip;
        let last = &clip.skeleton().joints[MANY].name;
        let expected =
            if name.is_empty() { format!("joint_{MANY}") } else { format!("{name}.{MANY}") };
        assert_eq!(*last, expected);
    }
}

#[test]
fn as_many_roots_and_channels_as_bytes_are_read_in_linear_time() {
    let trees = "ROOT a\n{\nOFFSET 0 1 0\n}\n".repeat(MANY);
    let read = read(with("ROOT", &format!("{trees}ROOT")).as_bytes()).unwrap();
    assert_eq!(read.clip.skeleton().len(), MANY + 2);
    assert!(read.warnings[0].message.len() < 1000, "{}", read.warnings[0]);

    let channels = format!("CHANNELS {MANY} {}", "Xrotation Xscale ".repeat(MANY / 2));
    let hierarchy = HIERARCHY.replace("CHANNELS 3 Zrotation Xrotation Yrotation", &channels);
    let row = "7 ".repeat(6 + MANY);
    let read =
        super::read(text("0.01", &[&row]).replace(HIERARCHY, &hierarchy).as_bytes()).unwrap();
    assert_eq!(read.clip.skeleton().channels(), 6 + MANY / 2);
    let codes: Vec<_> = read.warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(codes, ["W_CHANNEL_UNKNOWN", "W_AXIS_TWICE"]);
}

#[test]
fn counts_of_channels_that_no_file_can_hold_are_an_error_or_a_warning() {
    for count in ["1e12", "1e300", "1000000000000"] {
        let text = with("CHANNELS 3", &format!("CHANNELS {count}"));
        assert_eq!(read(text.as_bytes()).unwrap().warnings[0].code, "W_CHANNEL_COUNT");
        let end = with("OFFSET 0 3 0", &format!("OFFSET 0 3 0 CHANNELS {count}"));
        assert_eq!(read(end.as_bytes()).unwrap().warnings[0].code, "W_CHANNEL_COUNT");
    }
}

#[test]
fn a_long_line_of_anything_ends_fast() {
    let many = if crate::cases::is_full() { 20 } else { 4 } * MANY;
    for (garbage, is_read) in [
        ("1".repeat(many), false),
        ("x".repeat(many), false),
        ("1-".repeat(many), false),
        ("-1".repeat(many), false),
        ("1,".repeat(many), false),
        ("nan-".repeat(many), false),
        ("-nan".repeat(many), false),
        ("{".repeat(many), false),
        (" ".repeat(many), true),
        ("1 ".repeat(many), false),
        ("1e".repeat(many), false),
    ] {
        let start = &garbage[..4];
        for text in [
            with(ROW, &format!("{ROW} {garbage}")).replace("Frames: 2", "Frames: 1e12"),
            with("0 2 0", &format!("0 2 0 {garbage}")),
            with("Frames: 2", &format!("Frames: {garbage}")),
            with("Spine", &garbage),
            garbage.clone(),
        ] {
            if let Err(error) = read(text.as_bytes()) {
                assert!(error.to_string().len() < 300, "{start}");
            }
            let repair = Options { repair: true, ..Options::default() };
            let _ = repair.read(text.as_bytes());
        }
        let row = with(ROW, &garbage).replace("Frames: 2", "Frames: 1e12");
        assert_eq!(read(row.as_bytes()).is_ok(), is_read, "{start}");
    }
}

#[test]
fn a_file_that_is_odd_in_every_value_has_one_warning_of_each_kind() {
    let row = "0,5-1 ".repeat(MANY / 2);
    let row = row.trim_end();
    let channels = format!("CHANNELS {MANY} {}", "Xrotation ".repeat(MANY));
    let hierarchy = HIERARCHY.replace("CHANNELS 3 Zrotation Xrotation Yrotation", &channels);
    let rows = format!("1 2 3 4 5 6 {row}");
    let text = text("0.01", &[&rows, &rows]).replace(HIERARCHY, &hierarchy);
    let warnings = read(text.as_bytes()).unwrap().warnings;
    let said: Vec<_> = warnings.iter().map(|warning| (warning.code, warning.place)).collect();
    let expected = [
        ("W_AXIS_TWICE", Some((9, 29))),
        ("W_DECIMAL_COMMA", Some((19, 13))),
        ("W_GLUED_MINUS", Some((19, 16))),
    ];
    assert_eq!(said, expected);
    assert!(warnings[1].message.ends_with(&format!("(the first of {MANY})")), "{}", warnings[1]);
}
