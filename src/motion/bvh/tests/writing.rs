//! Tests the writer, and that its files read back.

use super::{OTHER_ROW, clip, sample};
use crate::motion::bvh::sample::{HIERARCHY, ROW, real_clips, text};
use crate::motion::bvh::{Read, Writer, read, write};
use crate::motion::{Axis, Channel, Joint, JointId, Skeleton};
use crate::time::{Frame, FrameRate};

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
        let Read { clip, warnings, .. } =
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
