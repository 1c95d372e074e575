//! Cases of the MOTION section.

use super::{Case, accepted, refused, same, warned};
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};
use crate::motion::bvh::tests::{OTHER_ROW, sample, with};
use crate::motion::bvh::warnings::{DECIMAL_COMMA, FRAMES_MISMATCH, GLUED_MINUS, POSES};
use crate::time::Frame;

pub(super) fn cases() -> Vec<Case> {
    let mut cases = labels();
    cases.extend(values());
    cases.extend(no_values());
    cases.extend(rows());
    cases
}

fn labels() -> Vec<Case> {
    let (five, one) = (
        "the file says 5 frames and has 2 complete frames",
        "the file says 1 frames and has 2 complete frames",
    );
    let time = |seconds| text(seconds, &[ROW]);
    vec![
        warned(11, with("Frames: 2", "Frames: 5"), (17, 9), FRAMES_MISMATCH, five, same),
        warned(12, with("Frames: 2", "Frames: 1"), (17, 9), FRAMES_MISMATCH, one, same),
        refused(
            38,
            text("0.01", &[]),
            (17, 9),
            "the file says it has 0 frames: there is no motion",
        ),
        refused(
            39,
            HIERARCHY,
            (16, 1),
            "expected \"MOTION\" or \"ROOT\", found the end of the file",
        ),
        refused(
            40,
            time("0.0"),
            (18, 13),
            "expected a frame time of at least a millionth of a second, found 0; --fps gives the rate",
        ),
        refused(
            41,
            time("-0.04"),
            (18, 13),
            "expected a frame time of at least a millionth of a second, found -0.04; --fps gives the rate",
        ),
        accepted(42, time("0.041667"), |clip| assert_eq!(clip.rate().fps(), 24.0)),
        refused(
            64,
            time("30"),
            (18, 13),
            "30 seconds a frame looks like a rate; --fps 30 reads it as one",
        ),
        refused(
            65,
            time("41.6667"),
            (18, 13),
            "41.6667 seconds a frame looks like milliseconds; --fps 24 reads it so",
        ),
        warned(
            66,
            time("1.0"),
            (18, 13),
            POSES,
            "a frame lasts 1 second, as in a list of poses; --fps N plays N of them a second",
            |clip| assert_eq!(clip.rate().fps(), 1.0),
        ),
    ]
}

fn values() -> Vec<Case> {
    let comma = "\"1,0\" has a decimal comma";
    let glued = "a blank is missing before a minus in \"5-6\"";
    vec![
        accepted(29, with(" 10 20 30", " 1e1 2.0E+01 300e-1"), same),
        warned(33, with(ROW, "0 1,0 0 10 20 30 40 50 60"), (19, 3), DECIMAL_COMMA, comma, same),
        refused(
            33,
            with(ROW, "0 1,0 0 10.0 20 30 40 50 60"),
            (19, 3),
            "expected a number, found \"1,0\" (other decimals here are written with a dot)",
        ),
        warned(56, with("4 5 6", "4 5-6"), (20, 10), GLUED_MINUS, glued, |clip| {
            assert_eq!(clip.row(Frame(1))[3..7], [4.0, 5.0, -6.0, 7.0]);
        }),
    ]
}

fn no_values() -> Vec<Case> {
    vec![
        refused(
            30,
            with(" 20 ", " nan "),
            (19, 10),
            "expected a number for Xrotation of \"Hips\" in frame 0, found \"nan\"; --repair holds the value before it",
        ),
        refused(
            31,
            with("8 9", "8 -1.#IND00"),
            (20, 17),
            "expected a number for Yrotation of \"Spine\" in frame 1, found \"-1.#IND00\" (Windows for: this is no number); --repair holds the value before it",
        ),
        refused(
            32,
            with("1 2 3", "-inf 2 3"),
            (20, 1),
            "expected a number for Xposition of \"Hips\" in frame 1, found \"-inf\"; --repair holds the value before it",
        ),
    ]
}

fn rows() -> Vec<Case> {
    let short = "1 2 3 4 5 6 7 8";
    let cut = "the file says 2 frames and has 1 complete frame and 8 values of a cut one, left out";
    let spread = sample().replace(" 30 ", " 30\n").replace(" 6 ", " 6\n");
    vec![
        refused(
            34,
            text("0.01", &[short, ROW]),
            (19, 16),
            "expected 9 values in this row, found 8",
        ),
        warned(34, with(OTHER_ROW, short), (17, 9), FRAMES_MISMATCH, cut, |clip| {
            assert_eq!(clip.len(), 1);
        }),
        refused(
            35,
            with(ROW, &format!("{ROW} 70")),
            (19, 25),
            "expected 9 values in this row, found 10; --repair leaves the rest out",
        ),
        accepted(36, spread, same),
        accepted(37, with(OTHER_ROW, &format!("\n \n{OTHER_ROW}")), same),
    ]
}
