//! The reader and the writer together: every accepted style, every error at its place, and the laws.

use proptest::prelude::*;

use super::sample::{HIERARCHY, ROW, real_clips, text};
use super::{Read, Writer, read, write};
use crate::error::Warning;
use crate::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton};
use crate::time::{Frame, FrameRate};

const OTHER_ROW: &str = "1 2 3 4 5 6 7 8 9";

fn sample() -> String {
    text("0.0083333", &[ROW, OTHER_ROW])
}

fn clip(text: &str) -> Clip {
    let Read { clip, warnings } = read(text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(warnings, [], "{text}");
    clip
}

/// Replaces what must be there.
fn with(from: &str, to: &str) -> String {
    let sample = sample();
    assert!(sample.contains(from), "{from}");
    sample.replacen(from, to, 1)
}

fn hierarchy(text: &str) -> Skeleton {
    clip(text).skeleton().clone()
}

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
        plain.replace("Frames: ", "Frames : ").replace("Frame Time: ", "FRAME  time :"),
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
    let Read { clip, warnings } = read(with("Spine", "").as_bytes()).unwrap();
    assert_eq!(clip.skeleton().joints[1].name, "joint_1");
    let message = "the joint in line 6 has no name; it is called joint_1";
    assert_eq!(warnings, [Warning::new("W_NAME_MISSING", message)]);
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
        ("CHANNELS 3 Zrotation Xrotation Zrotation", 6),
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
    let clip = clip(&text);
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
            with("Frames: 2", "Frames: 3").replace(" 30 ", " 30\n").replace(" 6 ", " 6\n"),
            2,
            "the file says 3 frames and has 2 complete frames",
        ),
    ];
    for (text, frames, message) in cases {
        let Read { clip, warnings } = read(text.as_bytes()).unwrap();
        assert_eq!(clip.len(), frames);
        assert_eq!(clip.row(Frame(0))[8], 60.0);
        assert_eq!(warnings, [Warning::new("W_FRAMES_MISMATCH", message)]);
    }
}

#[test]
fn a_file_that_lies_about_its_frames_reserves_no_more_than_it_can_hold() {
    let text = with("Frames: 2", "Frames: 1e300");
    assert_eq!(read(text.as_bytes()).unwrap().clip.len(), 2);
}

#[test]
fn ten_thousand_levels_are_read_and_written_without_recursion() {
    let levels = 10_000;
    let open = "JOINT a\n{\nOFFSET 0 1 0\n".repeat(levels);
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

/// A file, and where and how it is wrong.
fn assert_error(text: &str, line: usize, column: usize, message: &str) {
    let error = read(text.as_bytes()).expect_err(text);
    assert_eq!(error.to_string(), format!("{line}:{column}: {message}"), "{text}");
    assert_eq!(error.position(), Some((line, column)));
}

#[test]
fn a_hierarchy_that_is_none_is_an_error_at_its_place() {
    let not = "this is not a BVH file: expected \"HIERARCHY\", found";
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
            with("CHANNELS 3", "CHANNELS 1e300"),
            10,
            3,
            format!(
                "expected channel name 4 of {}, such as Xposition or Zrotation, found \"End\"",
                usize::MAX
            ),
        ),
        (
            with("CHANNELS 3 Zrotation", "CHANNELS 3 Zscale"),
            9,
            14,
            "expected channel name 1 of 3, such as Xposition or Zrotation, found \"Zscale\"".into(),
        ),
        (
            with("CHANNELS 3", "CHANNELS 2"),
            9,
            34,
            "joint \"Spine\" has more channel names than its CHANNELS says, found \"Yrotation\""
                .into(),
        ),
        (
            with("JOINT", "LIMB"),
            6,
            2,
            "expected \"OFFSET\", \"CHANNELS\", \"JOINT\", \"End Site\" or \"}\", found \"LIMB\""
                .into(),
        ),
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
            with("0 3 0\n", "0 3 0\nCHANNELS 3\n"),
            13,
            10,
            "expected 0, for an End Site has no channels, found \"3\"".into(),
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
fn a_name_that_is_no_utf_8_is_an_error() {
    let mut bytes = sample().into_bytes();
    let at = sample().find("Spine").unwrap();
    bytes[at] = 0x83;
    let error = read(&bytes).unwrap_err().to_string();
    assert_eq!(error, "6:8: the name is not UTF-8 text; save the file as UTF-8");
}

#[test]
fn a_motion_that_is_none_is_an_error_at_its_place() {
    let no_motion = "there is no motion";
    let time = "expected a frame time in seconds above 0, such as 0.0083333, found";
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
        (with("0.0083333", "0"), 18, 13, format!("{time} \"0\"")),
        (with("0.0083333", "-0.04"), 18, 13, format!("{time} \"-0.04\"")),
        (with("0.0083333", "1e-320"), 18, 13, format!("{time} \"1e-320\"")),
        (with("0.0083333", "nan"), 18, 13, "expected a number, found \"nan\"".into()),
        (
            with("0.0083333", "30"),
            18,
            13,
            "30 seconds a frame looks like a rate; 30 frames a second is \"Frame Time: 0.033333\""
                .into(),
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
    for (value, message) in [
        ("abc", "expected a number, found \"abc\""),
        ("nan", "expected a number, found \"nan\""),
        ("-1.#IND00", "expected a number, found \"-1.#IND00\""),
        ("inf", "expected a number, found \"inf\""),
        ("1e999", "expected a number, found \"1e999\" (it is too large)"),
        ("0,5", "expected a number, found \"0,5\" (write decimals with a dot)"),
        ("3-10", "expected a number, found \"3-10\" (a blank may be missing)"),
        ("\0", "expected a number, found \"\\0\""),
        ("}", "expected a number, found \"}\""),
    ] {
        let text = with("10 20 30", &format!("10 {value} 30")).replace('\n', "\r\n");
        assert_error(&text, 19, 10, message);
    }
}

#[test]
fn a_row_too_short_or_too_long_is_an_error_where_it_is() {
    let rows = |rows: &[&str]| text("0.01", rows);
    let (short, long) = ("1 2 3 4 5 6 7 8 ", "1 2 3 4 5 6 7 8 9 10 11");
    let (less, more) =
        ("expected 9 values in this row, found 8", "expected 9 values in this row, found 11");
    for (text, line, column, message) in [
        (rows(&[ROW, short, ROW]), 20, 16, less),
        (rows(&[short, ROW]), 19, 16, less),
        (rows(&[ROW, "", short, ROW]).replace('\n', "\r\n"), 21, 16, less),
        (rows(&[ROW, long, ROW]), 20, 19, more),
        (rows(&[ROW, ROW, long]), 21, 19, more),
        (rows(&[short, short, short]), 19, 16, less),
    ] {
        assert_error(&text, line, column, message);
    }
}

#[test]
fn numbers_are_written_short_and_plain() {
    let text = text("0.041667", &["-0 1e-06 0.50 1e3 -.25 1e21 30.000 0.1 5.1e-06"]);
    let expected = "Frames: 1\nFrame Time: 0.041667\n0 0.000001 0.5 1000 -0.25 1000000000000000000000 30 0.1 0.0000051\n";
    assert_eq!(write(&clip(&text)), format!("{HIERARCHY}MOTION\n{expected}"));
}

#[test]
fn the_frame_time_is_short_near_the_truth_and_the_same_rate_again() {
    for (fps, text) in [
        (24.0, "0.041667"),
        (23.976, "0.041708"),
        (25.0, "0.04"),
        (29.97, "0.033367"),
        (30.0, "0.033333"),
        (60.0, "0.0166667"),
        (100.0, "0.01"),
        (120.0, "0.0083333"),
        (240.0, "0.0041667"),
        (10.0, "0.1"),
    ] {
        let rate = FrameRate::new(fps).unwrap();
        let written = Writer::new(&Skeleton::default(), rate).finish();
        assert_eq!(written, format!("HIERARCHY\nMOTION\nFrames: 0\nFrame Time: {text}\n"));
        assert_eq!(FrameRate::from_frame_time(text.parse().unwrap()).unwrap(), rate);
    }
}

#[test]
fn a_writer_repeats_rows_as_told() {
    let clip = clip(&sample());
    let mut writer = Writer::new(clip.skeleton(), FrameRate::new(24.0).unwrap());
    writer.rows([clip.row(Frame(1)), clip.row(Frame(1))]);
    writer.row(clip.row(Frame(0)));
    let rows = format!("{OTHER_ROW}\n{OTHER_ROW}\n{ROW}\n");
    let expected = format!("{HIERARCHY}MOTION\nFrames: 3\nFrame Time: 0.041667\n{rows}");
    assert_eq!(writer.finish(), expected);
}

#[test]
fn joints_listed_level_by_level_are_written_tree_by_tree_with_their_own_columns() {
    let joint = |name: &str, parent: Option<usize>, first_channel| Joint {
        name: name.into(),
        parent: parent.map(JointId),
        offset: glam::DVec3::ZERO,
        channels: vec![Channel::Rotation(Axis::X)],
        first_channel,
        end_sites: vec![],
    };
    let joints = vec![
        joint("hips", None, 0),
        joint("left", Some(0), 1),
        joint("right", Some(0), 2),
        joint("left foot", Some(1), 3),
    ];
    let mut writer = Writer::new(&Skeleton { joints }, FrameRate::new(24.0).unwrap());
    writer.row(&[0.0, 1.0, 2.0, 3.0]);
    let again = clip(&writer.finish());
    let names: Vec<_> = again.skeleton().joints.iter().map(|joint| &joint.name[..]).collect();
    assert_eq!(names, ["hips", "left", "left foot", "right"]);
    assert_eq!(again.row(Frame(0)), [0.0, 1.0, 3.0, 2.0]);
}

#[test]
fn every_real_clip_comes_back_the_same() {
    for (name, bytes) in real_clips() {
        let Read { clip, warnings } =
            read(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(warnings, [], "{name}");
        let written = write(&clip);
        assert!(written.is_ascii() && !written.contains('\r') && written.ends_with('\n'), "{name}");
        let again = read(written.as_bytes()).unwrap().clip;
        assert!(again == clip, "{name} comes back as another clip");
        assert_eq!(write(&again), written, "{name}");
    }
}

#[test]
fn every_value_of_every_real_clip_is_what_std_reads() {
    for (name, bytes) in real_clips() {
        let clip = read(&bytes).unwrap().clip;
        let text = String::from_utf8(bytes).unwrap();
        let (_, motion) = text.split_once("Frame Time:").unwrap();
        let values =
            motion.split_ascii_whitespace().skip(1).map(|word| word.parse::<f64>().unwrap());
        let read = clip.rows().flatten();
        assert!(values.map(f64::to_bits).eq(read.map(|value| value.to_bits())), "{name}");
    }
}

proptest! {
    #[test]
    fn edited_bytes_never_panic(edits in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4u8), 1..8)) {
        let mut bytes = sample().into_bytes();
        for (index, byte, kind) in edits {
            let at = index.index(bytes.len().max(1)).min(bytes.len());
            match kind {
                0 if at < bytes.len() => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 if at < bytes.len() => drop(bytes.remove(at)),
                _ => bytes.truncate(at),
            }
        }
        if let Ok(Read { clip, .. }) = read(&bytes) {
            prop_assert!(!clip.is_empty());
            let again = read(write(&clip).as_bytes());
            prop_assert!(again.is_ok_and(|again| again.clip == clip));
        }
    }

    #[test]
    fn shuffled_words_never_panic(words in prop::collection::vec(prop::sample::select(WORDS.to_vec()), 0..40)) {
        let _ = read(format!("HIERARCHY ROOT a\n{{ {}", words.join(" ")).as_bytes());
        let _ = read(with("Frames:", &words.join(" ")).as_bytes());
    }

    #[test]
    fn any_finite_values_and_rate_come_back(
        values in prop::collection::vec(proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO, 9),
        time in 1e-4..0.99f64,
    ) {
        let text = text(&format!("{time}"), &[&values.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")]);
        let first = clip(&text);
        prop_assert_eq!(first.row(Frame(0)), &values[..]);
        prop_assert_eq!(clip(&write(&first)), first);
    }
}

const WORDS: [&str; 18] = [
    "ROOT",
    "JOINT",
    "a\n",
    "{",
    "}",
    "OFFSET",
    "0",
    "1 2 3",
    "CHANNELS",
    "3",
    "Xrotation",
    "Yposition",
    "End",
    "Site\n",
    "MOTION",
    "Frames:",
    "Frame Time:",
    "1e999",
];
