//! Tests that every error is reported at its place.

use super::{sample, with};
use crate::motion::bvh::read;
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};

fn assert_error(text: &str, line: usize, column: usize, message: &str) {
    let error = read(text.as_bytes()).expect_err(text);
    assert_eq!(error.to_string(), format!("{line}:{column}: {message}"), "{text}");
    assert_eq!(error.position(), Some((line, column)));
}

#[test]
fn a_hierarchy_that_is_none_is_an_error_at_its_place() {
    let not = "this is not a BVH file: expected \"HIERARCHY\", found";
    let parts = "expected \"OFFSET\", \"CHANNELS\", \"JOINT\", \"End Site\" or \"}\"";
    for (text, line, column, message) in [
        (String::new(), 1, 1, format!("{not} the end of the file")),
        ("\n \n".into(), 3, 1, format!("{not} the end of the file")),
        (format!("made by hand\n{}", sample()), 1, 1, format!("{not} \"made\"")),
        ("HIERARCHY\n".into(), 2, 1, "expected \"ROOT\", found the end of the file".into()),
        ("HIERARCHY\nMOTION".into(), 2, 1, "expected \"ROOT\", found \"MOTION\"".into()),
        (
            HIERARCHY.into(),
            16,
            1,
            "expected \"MOTION\" or \"ROOT\", found the end of the file".into(),
        ),
        (with("Hips\n{", "Hips\n"), 4, 2, "expected \"{\", found \"OFFSET\"".into()),
        (with("0 2 0", "0 2"), 9, 3, "expected a number, found \"CHANNELS\"".into()),
        (with("OFFSET 0 2 0", "OFFSET 0 abc 0"), 8, 12, "expected a number, found \"abc\"".into()),
        (with("\t\tOFFSET 0 2 0\n", ""), 13, 2, "joint \"Spine\" has no OFFSET".into()),
        (
            with("\t\tOFFSET 0 2 0\n", "\t\tOFFSET 0 2 0\n\t\tOFFSET 0 2 0\n"),
            9,
            3,
            "joint \"Spine\" has \"OFFSET\" twice".into(),
        ),
        (
            with("\t\t}\n\t}\n", "\t\t}\n\t}\n\tCHANNELS 1 Xrotation\n"),
            15,
            2,
            "joint \"Hips\" has \"CHANNELS\" twice".into(),
        ),
        (
            with("\t\tOFFSET 0 2 0\n", "").replacen("\t\t}\n", "\t\t}\nOFFSET 0 2 0\n", 1),
            13,
            1,
            "\"OFFSET\" of joint \"Spine\" must stand before its children".into(),
        ),
        (with("CHANNELS 3", "CHANNELS x"), 9, 12, "expected a number, found \"x\"".into()),
        (
            with("CHANNELS 3", "CHANNELS -3"),
            9,
            12,
            "expected a whole number of at least 0, found \"-3\"".into(),
        ),
        (
            with("CHANNELS 3", "CHANNELS 2.5"),
            9,
            12,
            "expected a whole number of at least 0, found \"2.5\"".into(),
        ),
        (
            with("CHANNELS 3 Zrotation", "CHANNELS 3 1.5 Zrotation"),
            9,
            14,
            format!("{parts}, found \"1.5\""),
        ),
        (with("JOINT", "LIMB"), 6, 2, format!("{parts}, found \"LIMB\"")),
        (
            with("\t\t\tOFFSET 0 3 0\n", ""),
            12,
            3,
            "expected \"OFFSET\" of the End Site, found \"}\"".into(),
        ),
        (
            with("0 3 0\n", "0 3 0\nJOINT\n"),
            13,
            1,
            "expected \"}\" of the End Site, found \"JOINT\"".into(),
        ),
        (
            with("}\nMOTION", "MOTION"),
            15,
            1,
            "expected \"}\" of joint \"Hips\", opened in line 2, found \"MOTION\"".into(),
        ),
        (
            HIERARCHY.trim_end_matches("\t}\n}\n").into(),
            14,
            1,
            "expected \"}\" of joint \"Spine\", opened in line 6, found the end of the file".into(),
        ),
        (with("MOTION", "}"), 16, 1, "expected \"MOTION\" or \"ROOT\", found \"}\"".into()),
    ] {
        assert_error(&text, line, column, &message);
    }
}

#[test]
fn names_of_no_known_encoding_are_an_error() {
    let (before, after) =
        sample().split_once("Spine").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    for name in [&b"\xff"[..], b"\x83", b"\xfd"] {
        let bytes = [before.as_bytes(), name, after.as_bytes()].concat();
        let error = read(&bytes).unwrap_err().to_string();
        let message = "6:8: the names are neither UTF-8 nor Shift-JIS text; save the file as UTF-8";
        assert_eq!(error, message, "{name:x?}");
    }
    let odd = [&b"\xff\xfe"[..], &sample().as_bytes()[..101], b"\x00"].concat();
    for wrong in [&b"\xff\xfe\x00\xd8\x00"[..], &odd[..100 + 1], b"\xfe\xff\xdc\x00"] {
        let error = read(wrong).unwrap_err().to_string();
        assert_eq!(error, "1:1: the file begins as UTF-16 does, but is not UTF-16 text");
    }
}

#[test]
fn a_file_of_another_kind_is_no_bvh_and_not_a_question_of_encoding() {
    for bytes in [&b"\x89PNG\r\n\x1a\n\x00\xff"[..], b"\xff\x00", b"\x83\x83\x83\x83"] {
        let error = read(bytes).unwrap_err().to_string();
        assert!(error.starts_with("1:1: this is not a BVH file: "), "{error}");
        assert!(!error.contains('ャ'), "{error}");
    }
}

#[test]
fn bytes_of_no_encoding_in_the_table_are_an_error_in_their_row() {
    let (before, after) =
        sample().split_once(" 20 ").map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let error = read(&[before.as_bytes(), b" \xff ", after.as_bytes()].concat()).unwrap_err();
    assert!(error.to_string().starts_with("19:10: expected a number, found "), "{error}");
}

#[test]
fn a_motion_that_is_none_is_an_error_at_its_place() {
    let no_motion = "there is no motion";
    let time = |found: &str| {
        format!(
            "expected a frame time of at least a millionth of a second, found {found}; --fps gives the rate"
        )
    };
    let still = text("0.01", &[])
        .replace("CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 0")
        .replace(
            "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation",
            "CHANNELS 0",
        );
    for (text, line, column, message) in [
        (still, 16, 7, format!("no joint has a channel: {no_motion}")),
        (
            with("Frames: 2", "Frames: 0"),
            17,
            9,
            format!("the file says it has 0 frames: {no_motion}"),
        ),
        (with("Frames:", "Frame:"), 17, 1, "expected \"Frames:\", found \"Frame:\"".into()),
        (with("Frames: 2", "Frames 2"), 17, 1, "expected \"Frames:\", found \"Frames\"".into()),
        (with("Frames: 2", "Frames: two"), 17, 9, "expected a number, found \"two\"".into()),
        (
            with("Frames: 2", "Frames: -2"),
            17,
            9,
            "expected a whole number of at least 0, found \"-2\"".into(),
        ),
        (with("Frame Time", "Time"), 18, 1, "expected \"Frame Time:\", found \"Time:\"".into()),
        (with("0.0083333", "0"), 18, 13, time("0")),
        (with("0.0083333", "-0.04"), 18, 13, time("-0.04")),
        (with("0.0083333", "1e-320"), 18, 13, time(&format!("{}", 1e-320))),
        (with("0.0083333", "nan"), 18, 13, "expected a number, found \"nan\"".into()),
        (
            with("0.0083333", "30"),
            18,
            13,
            "30 seconds a frame looks like a rate; --fps 30 reads it as one".into(),
        ),
        (
            with("0.0083333", "5000"),
            18,
            13,
            "expected a frame time in seconds, found 5000; --fps gives the rate".into(),
        ),
        (
            text("0.01", &["", ""]),
            21,
            1,
            format!("expected 9 values for the first frame, found 0: {no_motion}"),
        ),
        (
            text("0.01", &["1 2 3"]),
            20,
            1,
            format!("expected 9 values for the first frame, found 3: {no_motion}"),
        ),
    ] {
        assert_error(&text, line, column, &message);
    }
}

#[test]
fn a_value_that_is_no_finite_number_is_an_error_at_its_place() {
    let here = " for Xrotation of \"Hips\" in frame 0";
    let out = "; --repair holds the value before it";
    for (value, message) in [
        ("abc", "expected a number, found \"abc\"".into()),
        ("nan", format!("expected a number{here}, found \"nan\"{out}")),
        ("-Infinity", format!("expected a number{here}, found \"-Infinity\"{out}")),
        ("1e999", format!("expected a number{here}, found \"1e999\" (it is too large){out}")),
        (
            "0,5,1",
            "expected a number, found \"0,5,1\" (other decimals here are written with a dot)"
                .into(),
        ),
        ("--10", "expected a number, found \"--10\" (a blank may be missing)".into()),
        ("1.2.3", "expected a number, found \"1.2.3\" (a blank may be missing)".into()),
        ("\0", "expected a number, found \"\\0\"".into()),
        ("}", "expected a number, found \"}\"".into()),
    ] {
        let text = with("10 20 30", &format!("10 {value} 30")).replace('\n', "\r\n");
        assert_error(&text, 19, 10, &message);
    }
    assert_error(&with("0 2 0", "0 nan 0"), 8, 12, "expected a number, found \"nan\"");
}

#[test]
fn a_row_is_named_only_where_the_rows_before_leave_no_doubt() {
    let out = "; --repair holds the value before it";
    let spread = with(ROW, &ROW.replace(" 30 ", " 30\n")).replace("8 9", "8 nan");
    assert_error(&spread, 21, 17, &format!("expected a number, found \"nan\"{out}"));
    let unused =
        with("CHANNELS 3 Zrotation Xrotation Yrotation", "CHANNELS 3 Xscale Xrotation Yrotation");
    let message = format!("expected a number in frame 0, found \"nan\"{out}");
    assert_error(&unused.replace(" 40 ", " nan "), 19, 16, &message);
}

#[test]
fn a_row_too_short_or_too_long_is_an_error_where_it_is() {
    let rows = |rows: &[&str]| text("0.01", rows);
    let (short, long) = ("1 2 3 4 5 6 7 8 ", "1 2 3 4 5 6 7 8 9 10 11");
    let (less, more) = (
        "expected 9 values in this row, found 8",
        "expected 9 values in this row, found 11; --repair leaves the rest out",
    );
    for (text, line, column, message) in [
        (rows(&[ROW, short, ROW]), 20, 16, less),
        (rows(&[short, ROW]), 19, 16, less),
        (rows(&[ROW, "", short, ROW]).replace('\n', "\r\n"), 21, 16, less),
        (rows(&[ROW, long, ROW]), 20, 19, more),
        (rows(&[ROW, ROW, long]), 21, 19, more),
        (rows(&[short, short, short]), 19, 16, less),
        // The number of values is right, and so is the number of lines.
        (rows(&[short, "1 2 3 4 5 6 7 8 9 10"]), 19, 16, less),
        (
            rows(&["1 2 3 4 5 6 7 8 9 10", short]),
            19,
            19,
            "expected 9 values in this row, found 10; --repair leaves the rest out",
        ),
        (rows(&[long, long, long]).replace("Frames: 3", "Frames: 9"), 19, 19, more),
    ] {
        assert_error(&text, line, column, message);
    }
}
