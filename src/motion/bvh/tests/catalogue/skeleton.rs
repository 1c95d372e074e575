//! Cases of the HIERARCHY section.

use super::{Case, accepted, refused, same, warned};
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};
use crate::motion::bvh::tests::{OTHER_ROW, sample, with};
use crate::motion::bvh::warnings::{
    AXIS_TWICE, CHANNEL_COUNT, CHANNEL_UNKNOWN, END_SITE_CHANNELS, ROOTS,
};
use crate::motion::{Axis, Channel, Clip, local_translation};
use crate::time::Frame;

const SIX: &str = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
const THREE: &str = "CHANNELS 3 Zrotation Xrotation Yrotation";
const END_SITE: &str = "\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 3 0\n\t\t}\n";

pub(super) fn cases() -> Vec<Case> {
    let mut cases = channels();
    cases.extend(positions());
    cases.extend(odd_channels());
    cases.extend(end_sites());
    cases.extend(joints());
    cases
}

/// The sample with something replaced in its hierarchy, and one row.
fn with_row(from: &str, to: &str, row: &str) -> String {
    text("0.0083333", &[row]).replacen(from, to, 1)
}

/// The sample with values added to both rows.
fn with_more(from: &str, to: &str, more: &str) -> String {
    with(from, to)
        .replace(ROW, &format!("{ROW} {more}"))
        .replace(OTHER_ROW, &format!("{OTHER_ROW} {more}"))
}

fn channels() -> Vec<Case> {
    fn counts(root: usize, clip: &Clip) {
        assert_eq!(clip.skeleton().joints[0].channels.len(), root);
        assert_eq!(clip.skeleton().joints[1].first_channel, root);
        assert_eq!(clip.row(Frame(0)).len(), root + 3);
    }
    let lower = SIX.to_lowercase().replace("channels", "CHANNELS");
    let swapped = "CHANNELS 6 Zrotation Xrotation Yrotation Xposition Yposition Zposition";
    vec![
        accepted(17, with(SIX, &lower), same),
        accepted(19, with(SIX, swapped), |clip| {
            let channels = &clip.skeleton().joints[0].channels;
            assert_eq!(channels[0], Channel::Rotation(Axis::Z));
            assert_eq!(channels[5], Channel::Position(Axis::Z));
        }),
        accepted(23, with_row(SIX, "CHANNELS 2 Zrotation Yrotation", "1 2 3 4 5"), |clip| {
            counts(2, clip)
        }),
        accepted(24, with_row(SIX, "CHANNELS 1 Yrotation", "1 2 3 4"), |clip| counts(1, clip)),
        accepted(25, with_row(SIX, "CHANNELS 0", "1 2 3"), |clip| counts(0, clip)),
    ]
}

/// A position channel replaces the offset on its axis.
fn positions() -> Vec<Case> {
    fn stands(joint: usize, at: [f64; 3], clip: &Clip) {
        let joint = &clip.skeleton().joints[joint];
        assert_eq!(local_translation(joint, clip.row(Frame(0))).to_array(), at);
    }
    let six = SIX.replace("CHANNELS", "\tCHANNELS");
    let only_y = "CHANNELS 4 Yposition Zrotation Xrotation Yrotation";
    vec![
        accepted(20, with_row(THREE, &six, "0 1 0 10 20 30 7 8 9 40 50 60"), |clip| {
            stands(1, [7.0, 8.0, 9.0], clip);
        }),
        accepted(21, with("OFFSET 0 1 0", "OFFSET 5 6 7"), |clip| stands(0, [0.0, 1.0, 0.0], clip)),
        accepted(22, with_row(SIX, only_y, "9 1 2 3 4 5 6").replace("0 1 0", "5 6 7"), |clip| {
            stands(0, [5.0, 9.0, 7.0], clip);
        }),
    ]
}

fn odd_channels() -> Vec<Case> {
    vec![
        warned(
            26,
            with(THREE, "CHANNELS 3 Zrotation Xrotation Zrotation"),
            (9, 34),
            AXIS_TWICE,
            "joint \"Spine\" has \"Zrotation\" twice",
            |clip| assert_eq!(clip.skeleton().joints[1].channels.len(), 3),
        ),
        warned(
            27,
            with("CHANNELS 3", "CHANNELS 4"),
            (9, 12),
            CHANNEL_COUNT,
            "4 channels are said to come and 3 do",
            same,
        ),
        warned(
            27,
            with("CHANNELS 3", "CHANNELS 2"),
            (9, 12),
            CHANNEL_COUNT,
            "2 channels are said to come and 3 do",
            same,
        ),
        refused(
            27,
            with_more("CHANNELS 3", "CHANNELS 4", "0"),
            (9, 12),
            "CHANNELS says another number than names follow; the names need 9 values in a row, and the first row has 10",
        ),
        warned(
            28,
            with_more(THREE, "CHANNELS 4 Zrotation Xrotation Yrotation Xscale", "1"),
            (9, 44),
            CHANNEL_UNKNOWN,
            "joint \"Spine\" has a channel \"Xscale\"; its column is left out",
            same,
        ),
    ]
}

fn end_sites() -> Vec<Case> {
    fn tips(names: &[&str], clip: &Clip) {
        let read: Vec<_> =
            clip.skeleton().joints[1].end_sites.iter().map(|end| &end.name[..]).collect();
        assert_eq!(read, names);
    }
    let none = END_SITE.replace("OFFSET 0 3 0", "OFFSET 0 3 0\n\t\t\tCHANNELS 0");
    let three = none.replace("CHANNELS 0", "CHANNELS 3 Xrotation Yrotation Zrotation");
    vec![
        accepted(43, with(END_SITE, ""), |clip| tips(&[], clip)),
        accepted(44, with("End Site", "End Site HeadTop"), |clip| tips(&["Site HeadTop"], clip)),
        accepted(45, with("End Site", "end site"), |clip| tips(&["site"], clip)),
        accepted(46, with(END_SITE, &none), same),
        warned(
            47,
            with_more(END_SITE, &three, "1 2 3"),
            (13, 13),
            END_SITE_CHANNELS,
            "an End Site has channels; their columns are left out",
            same,
        ),
    ]
}

fn joints() -> Vec<Case> {
    let swapped = sample()
        .replace(&format!("OFFSET 0 2 0\n\t\t{THREE}"), &format!("{THREE}\n\t\tOFFSET 0 2 0"));
    let sword = format!("{HIERARCHY}ROOT Sword\n{{\n\tOFFSET 5 0 0\n\tCHANNELS 1 Xrotation\n}}\n");
    vec![
        accepted(48, sample().replace("Hips\n{", "Hips {").replace("Spine\n\t{", "Spine{"), same),
        warned(
            49,
            with_more(HIERARCHY, &sword, "70"),
            (16, 6),
            ROOTS,
            "the file has 2 trees, all of them used; --root takes one: \"Hips\" (2 joints), \"Sword\" (1 joint)",
            |clip| {
                assert_eq!(clip.skeleton().joints[2].parent, None);
                assert_eq!(clip.row(Frame(1))[9], 70.0);
            },
        ),
        accepted(54, with("OFFSET 0 2 0", "OFFSET -0e-06 2.0E+00 0e5"), same),
        accepted(55, swapped, same),
        refused(
            58,
            with("}\nMOTION", "MOTION"),
            (15, 1),
            "expected \"}\" of joint \"Hips\", opened in line 2, found \"MOTION\"",
        ),
        accepted(59, with("OFFSET 0 2 0", "OFFSET 0 0 0"), |clip| {
            assert_eq!(clip.skeleton().joints[1].offset, glam::DVec3::ZERO);
        }),
    ]
}
