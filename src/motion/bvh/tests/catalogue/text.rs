//! Cases of bytes, lines and names.

use super::{Case, accepted, refused, same, warned};
use crate::motion::Clip;
use crate::motion::bvh::sample::ROW;
use crate::motion::bvh::tests::{OTHER_ROW, sample, with};
use crate::motion::bvh::warnings::{
    ENCODING, LABEL_SPACING, NAME_MISSING, NAME_TWICE, TRAILING_BYTES,
};

pub(super) fn cases() -> Vec<Case> {
    let mut cases = lines();
    cases.extend(labels());
    cases.extend(names());
    cases.extend(ends());
    cases
}

fn lines() -> Vec<Case> {
    let plain = sample();
    vec![
        accepted(1, plain.replace('\n', "\r\n"), same),
        accepted(2, plain.replace('\n', "\r"), same),
        accepted(3, format!("\u{feff}{plain}"), same),
        accepted(4, plain.trim_end(), same),
        accepted(5, format!("{plain}\n\n \n"), same),
        accepted(6, plain.replace('\n', " \t\n"), same),
        accepted(7, with(ROW, &ROW.replace(' ', "\t")), same),
        accepted(53, format!("\n \r\n{plain}"), same),
    ]
}

fn labels() -> Vec<Case> {
    let spaced = "a blank stands before the colon of \"Frames:\"; some programs find none";
    let glued = sample().replace("Frames: ", "Frames:").replace("Time: ", "Time:");
    vec![
        accepted(8, with("Frames: 2", "Frames:\t2"), same),
        accepted(9, glued, same),
        warned(10, with("Frames:", "Frames :"), (17, 7), LABEL_SPACING, spaced, same),
        accepted(
            18,
            with("ROOT", "root").replace("MOTION", "motion").replace("Time", "time"),
            same,
        ),
        accepted(60, with("Frames: 2", "Frames: 2.0"), same),
    ]
}

fn names() -> Vec<Case> {
    fn first_is(name: &'static str, clip: &Clip) {
        assert_eq!(clip.skeleton().joints[0].name, name);
    }
    vec![
        accepted(13, with("Hips", "mixamorig:Hips"), |clip| first_is("mixamorig:Hips", clip)),
        accepted(14, with("Hips", "Bip01 Pelvis"), |clip| first_is("Bip01 Pelvis", clip)),
        accepted(15, with("Hips", "腰"), |clip| first_is("腰", clip)),
        warned(
            16,
            in_shift_jis(&with("Hips", "NAME")),
            (2, 6),
            ENCODING,
            "the names are Shift-JIS; save the file as UTF-8",
            |clip| first_is("ボーン", clip),
        ),
        warned(
            50,
            with("Spine", "Hips"),
            (6, 8),
            NAME_TWICE,
            "two joints are called \"Hips\"; this one is called \"Hips.2\"",
            |clip| assert_eq!(clip.skeleton().joints[1].name, "Hips.2"),
        ),
        warned(
            51,
            with("Spine", ""),
            (6, 8),
            NAME_MISSING,
            "a joint has no name; it is called joint_1",
            |clip| assert_eq!(clip.skeleton().joints[1].name, "joint_1"),
        ),
    ]
}

/// The text with NAME replaced by ボーン in Shift-JIS, where the second byte of the first letter is a brace.
fn in_shift_jis(text: &str) -> Vec<u8> {
    let (before, after) = text.split_once("NAME").unwrap();
    [before.as_bytes(), b"\x83\x7b\x81\x5b\x83\x93", after.as_bytes()].concat()
}

fn ends() -> Vec<Case> {
    let no_bvh = "this is not a BVH file: expected \"HIERARCHY\", found \"made\"";
    let nothing = "this is not a BVH file: expected \"HIERARCHY\", found the end of the file";
    let (nuls, ctrl_z) = (
        "3 NUL or Ctrl-Z bytes follow the text; left out",
        "1 NUL or Ctrl-Z byte follows the text; left out",
    );
    let utf_16 = "the file is UTF-16; save it as UTF-8";
    vec![
        refused(52, format!("made by hand\n{}", sample()), (1, 1), no_bvh),
        refused(57, "", (1, 1), nothing),
        warned(61, sample() + "\0\0\0", (21, 1), TRAILING_BYTES, nuls, same),
        warned(
            62,
            with(OTHER_ROW, "1 2 3 4 5 6 7 8 9\x1a"),
            (20, 18),
            TRAILING_BYTES,
            ctrl_z,
            same,
        ),
        warned(63, in_utf_16(u16::to_le_bytes), (1, 1), ENCODING, utf_16, same),
        warned(63, in_utf_16(u16::to_be_bytes), (1, 1), ENCODING, utf_16, same),
    ]
}

fn in_utf_16(bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    format!("\u{feff}{}", sample()).encode_utf16().flat_map(bytes).collect()
}
