//! Tests every accepted spelling and its meaning.

use super::{OTHER_ROW, clip, hierarchy, sample, with};
use crate::error::Warning;
use crate::motion::bvh::sample::{HIERARCHY, ROW, text};
use crate::motion::bvh::warnings::FRAMES_MISMATCH;
use crate::motion::bvh::{Read, read, write};
use crate::motion::{Axis, Channel, EndSite, Joint, JointId};
use crate::time::Frame;

#[test]
fn a_plain_file_reads_as_written() {
    let clip = clip(&sample());
    assert_eq!((clip.len(), clip.first(), clip.rate().fps()), (2, Frame(0), 120.0));
    assert_eq!(clip.row(Frame(0)), [0.0, 1.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
    assert_eq!(clip.row(Frame(1)), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    let [hips, spine] = &clip.skeleton().joints[..] else { panic!("two joints") };
    let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
    let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
    let channels = [positions, rotations].concat();
    let offset = |y| glam::DVec3::new(0.0, y, 0.0);
    let expected = Joint {
        name: "Hips".into(),
        parent: None,
        offset: offset(1.0),
        channels,
        first_channel: 0,
        end_sites: vec![],
    };
    assert_eq!(*hips, expected);
    let end_sites = vec![EndSite { name: "Site".into(), offset: offset(3.0) }];
    let expected = Joint {
        name: "Spine".into(),
        parent: Some(JointId(0)),
        offset: offset(2.0),
        channels: rotations.to_vec(),
        first_channel: 6,
        end_sites,
    };
    assert_eq!(*spine, expected);
}

#[test]
fn spellings_that_mean_the_same_read_the_same() {
    let plain = sample();
    let expected = clip(&plain);
    let lower = plain
        .to_lowercase()
        .replace("hips", "Hips")
        .replace("spine", "Spine")
        .replace("site", "Site");
    let mixed = plain.replace("}\n", "}\r\n").replace("Frames: 2\n", "Frames: 2\r");
    let glued =
        plain.replace('\n', " ").replace("Hips {", "Hips{").replace("0 3 0 \t\t}", "0 3 0}");
    for same in [
        plain.replace('\n', "\r\n"),
        plain.replace('\n', "\r"),
        mixed,
        format!("\u{feff}{plain}"),
        format!("\n \r\n{plain}"),
        plain.trim_end().to_owned(),
        format!("{plain}\n\n \n"),
        plain.replace('\n', " \t\n"),
        plain.replace(' ', "\t").replace("End\tSite", "End Site"),
        plain.replace('\t', "    "),
        lower,
        glued.replace("Hips", "Hips\n").replace("Spine", "Spine\n").replace("Site", "Site\n"),
        plain.replace("Frames: ", "Frames:").replace("Time: ", "Time:"),
        plain.replace("Frames: ", "Frames:\t").replace("Time: ", "Time:\t"),
        plain.replace("Frame Time: ", "FRAME\ttime:"),
        plain.replace("Frames: 2", "Frames: 2.0"),
        plain.replace("0.0083333", ".0083333"),
        plain.replace("0.0083333", "8.3333e-03"),
        plain.replace("10 20 30", "1e1 2.0E+01 +30."),
        plain.replace("10 20 30", "10\n20\n\n30"),
        plain.replace(OTHER_ROW, "\n1 2 3 4 5 6 7 8 9\n"),
        plain.replace("Spine\n\t{", "Spine {"),
        plain.replace("Hips\n{\n", "Hips{"),
        plain.replace("\t\t\tOFFSET 0 3 0\n", "\t\t\tCHANNELS 0\n\t\t\tOFFSET 0.0e-06 3 0\n"),
        plain.replace("CHANNELS 3 ", "CHANNELS\n3\n"),
        swap_offset_and_channels(&plain),
    ] {
        assert_ne!(same, plain);
        assert_eq!(clip(&same), expected, "{same}");
    }
}

fn swap_offset_and_channels(text: &str) -> String {
    let (offset, channels) =
        ("\t\tOFFSET 0 2 0\n", "\t\tCHANNELS 3 Zrotation Xrotation Yrotation\n");
    text.replace(&format!("{offset}{channels}"), &format!("{channels}{offset}"))
}

#[test]
fn names_run_to_the_end_of_the_line_or_a_brace() {
    for name in ["Bip01 Pelvis", "mixamorig:Hips", "腰", "a  b", "JOINT", "}"] {
        assert_eq!(hierarchy(&with("Hips", name)).joints[0].name, name);
        assert_eq!(hierarchy(&with("Hips\n{", &format!("{name} {{"))).joints[0].name, name);
    }
}

#[test]
fn end_sites_keep_their_name_and_may_be_many_or_none() {
    let end_sites = |from: &str, to: &str| hierarchy(&with(from, to)).joints[1].end_sites.clone();
    for (written, name) in [
        ("End Site", "Site"),
        ("end site", "site"),
        ("End Site HeadTop", "Site HeadTop"),
        ("End Site {", "Site"),
        ("END", ""),
    ] {
        let written = written.replace(" {", "");
        assert_eq!(end_sites("End Site", &written)[0].name, name);
    }
    let end = "\t\tEnd Site\n\t\t{\n\t\t\tOFFSET 0 3 0\n\t\t}\n";
    assert_eq!(end_sites(end, ""), []);
    assert_eq!(end_sites(end, &end.repeat(2)).len(), 2);
}

#[test]
fn a_joint_has_any_channels_in_any_order_or_none() {
    let six = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation";
    for (channels, count) in [
        ("CHANNELS 6 Yrotation Zposition Xrotation Xposition Zrotation Yposition", 9),
        ("CHANNELS 3 zROTATION xrotation YROTATION", 6),
        ("CHANNELS 1 Yposition", 4),
        ("CHANNELS 2 Zrotation Yrotation", 5),
        ("CHANNELS 0", 3),
        ("", 3),
    ] {
        let row = ["1"; 9][..count].join(" ");
        let skeleton = hierarchy(&text("0.01", &[&row]).replace(six, channels));
        assert_eq!(skeleton.channels(), count);
        assert_eq!(skeleton.joints[1].first_channel, count - 3);
    }
    let moved = "CHANNELS 6 Xrotation Yposition Zrotation Xposition Yrotation Zposition";
    let channels = &hierarchy(&with(six, moved)).joints[0].channels;
    let expected = [
        Channel::Rotation(Axis::X),
        Channel::Position(Axis::Y),
        Channel::Rotation(Axis::Z),
        Channel::Position(Axis::X),
        Channel::Rotation(Axis::Y),
        Channel::Position(Axis::Z),
    ];
    assert_eq!(channels[..], expected);
}

#[test]
fn several_roots_are_several_trees() {
    let second = "ROOT Sword\n{\n\tOFFSET 5 0 0\n\tCHANNELS 1 Xrotation\n}\n";
    let hierarchy = format!("{HIERARCHY}{second}");
    let text = text("0.01", &["0 1 0 10 20 30 40 50 60 70"]).replace(HIERARCHY, &hierarchy);
    let Read { clip, .. } = read(text.as_bytes()).unwrap();
    let parents: Vec<_> = clip.skeleton().iter().map(|(_, joint)| joint.parent).collect();
    assert_eq!(parents, [None, Some(JointId(0)), None]);
    assert_eq!(clip.skeleton().joints[2].first_channel, 9);
    assert_eq!(read(write(&clip).as_bytes()).unwrap().clip, clip);
}

#[test]
fn a_rounded_frame_time_is_the_usual_rate_and_no_warning() {
    for (seconds, fps) in
        [(".0083333", 120.0), ("0.041667", 24.0), ("0.033333", 30.0), ("0.1", 10.0)]
    {
        assert_eq!(clip(&text(seconds, &[ROW])).rate().fps(), fps);
    }
}

#[test]
fn more_or_fewer_frames_than_said_are_used_as_far_as_they_are_complete() {
    let cases = [
        (with("Frames: 2", "Frames: 5"), 2, "the file says 5 frames and has 2 complete frames"),
        (with("Frames: 2", "Frames: 1"), 2, "the file says 1 frames and has 2 complete frames"),
        (
            with("7 8 9", "7"),
            1,
            "the file says 2 frames and has 1 complete frame and 7 values of a cut one, left out",
        ),
        (
            with("Frames: 2", "Frames: 1000000000000").replace('\n', "\r\n"),
            2,
            "the file says 1000000000000 frames and has 2 complete frames",
        ),
        (
            with("Frames: 2", "Frames: 3").replace(" 30 ", " 30\n").replace(" 5 6 ", " 5 6\n"),
            2,
            "the file says 3 frames and has 2 complete frames",
        ),
    ];
    for (text, frames, message) in cases {
        let Read { clip, warnings, .. } = read(text.as_bytes()).unwrap();
        assert_eq!(clip.len(), frames);
        assert_eq!(clip.row(Frame(0))[8], 60.0);
        assert_eq!(warnings, [Warning::at((17, 9), FRAMES_MISMATCH, message)]);
    }
}
