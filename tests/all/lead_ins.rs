//! The same lead-in is found in every dialect, and at every rate that a clip is reduced to.

use std::fs;

use genga::motion::bvh;
use genga::motion::clean::LeadIn;
use genga::motion::{Axis, Channel, Clip, Joint, Skeleton};
use genga::time::{Frame, FrameRate};

use crate::clips;
use crate::rerig::Rerig;

/// Strides: every n-th frame is kept.
const STRIDES: [usize; 7] = [1, 2, 3, 4, 5, 6, 8];

/// Lead-in frames found with each stride of [`STRIDES`].
///
/// At 120 frames per second, the way out of some inserted poses takes four frames. At a lower rate its remainder is no
/// farther from the motion than the motion's own steps, and stays where the table has `<`.
#[rustfmt::skip]
const FOUND: [(&str, [usize; 7]); 15] = [
    //                          120 60 40 30 24 20 15 frames a second (100, 50, 33 … of 100)
    ("cmu-01_06-playground-long",   [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-02_04-jump-balance",      [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-02_05-punch-strike",      [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-02_07-swordplay",         [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-05_11-dance-pirouette",   [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-06_15-dribble-shoot",     [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-07_01-walk",              [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-09_01-run",               [1, 1, 1, 1, 1, 1, 1]),
    ("cmu-10_03-soccer-kick",       [5, 3, 2, /*<2*/ 1, 1, 1, 1]),
    ("cmu-11_01-soccer-kick",       [5, /*<3*/ 2, 2, /*<2*/ 1, 1, 1, 1]),
    ("cmu-131_03-start-hop-stop",   [0, 0, 0, 0, 0, 0, 0]),
    ("cmu-135_04-front-kick",       [5, 3, 2, /*<2*/ 1, 1, 1, 1]),
    ("optitrack-arena-louise",      [2, 1, 1, 1, 1, 1, 1]),
    ("rokoko-jesse-dance",          [0, 0, 0, 0, 0, 0, 0]),
    ("threejs-pirouette",           [4, 2, /*<2*/ 1, 1, 1, 1, 1]),
];

/// The start of each clip as in its file, lead-in included.
fn starts() -> Vec<(String, Clip)> {
    let start = |path: std::path::PathBuf| {
        let clip = bvh::read(&fs::read(&path).unwrap()).unwrap().clip;
        let end = Frame(clip.len().min(400));
        (clips::name(&path), clip.trimmed(Frame(0), end).unwrap())
    };
    clips::all().into_iter().map(start).collect()
}

/// Keeps every n-th frame, and divides the rate by n.
fn every(clip: &Clip, stride: usize) -> Clip {
    let rows: Vec<&[f64]> = clip.rows().step_by(stride).collect();
    let rate = FrameRate::new(clip.rate().fps() / stride as f64).unwrap();
    Clip::new(clip.skeleton().clone(), rate, Frame(0), rows.len(), rows.concat()).unwrap()
}

fn found(clip: &Clip) -> usize {
    LeadIn::find(clip).map_or(0, |lead_in| lead_in.len())
}

/// Adds position channels to every joint, as some programs write them, and removes End Sites.
fn with_positions_everywhere(clip: &Clip) -> Clip {
    let mut first_channel = 0;
    let mut joint = |joint: &Joint| {
        let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
        let rotations = joint.channels.iter().filter(|channel| is_rotation(channel)).copied();
        let channels: Vec<Channel> = positions.into_iter().chain(rotations).collect();
        let begin = first_channel;
        first_channel += channels.len();
        Joint { channels, first_channel: begin, end_sites: vec![], ..joint.clone() }
    };
    let skeleton = Skeleton { joints: clip.skeleton().joints.iter().map(&mut joint).collect() };
    let mut values = Vec::new();
    for row in clip.rows() {
        for joint in &clip.skeleton().joints {
            values.extend(genga::motion::local_translation(joint, row).to_array());
            let channels = joint.channels.iter().enumerate();
            let rotations = channels.filter(|(_, channel)| is_rotation(channel));
            values.extend(rotations.map(|(at, _)| row[joint.first_channel + at]));
        }
    }
    Clip::new(skeleton, clip.rate(), Frame(0), clip.len(), values).unwrap()
}

fn is_rotation(channel: &Channel) -> bool {
    matches!(channel, Channel::Rotation(_))
}

#[test]
fn the_lead_in_is_found_at_every_rate() {
    for (name, clip) in starts() {
        let (_, expected) = FOUND.iter().find(|(clip, _)| *clip == name).unwrap();
        let found = STRIDES.map(|stride| found(&every(&clip, stride)));
        assert_eq!(found, *expected, "{name}");
    }
}

#[test]
fn a_frame_of_the_way_out_that_stays_is_a_step_from_the_motion() {
    for (name, clip) in starts() {
        let there = found(&clip);
        for stride in STRIDES {
            let cut = every(&clip, stride);
            let missed = there.div_ceil(stride) - found(&cut);
            assert!(missed <= 1 && there.div_ceil(stride) - missed >= there.min(1), "{name}");
        }
    }
}

#[test]
fn every_dialect_has_the_same_lead_in() {
    for (name, clip) in starts() {
        for stride in STRIDES {
            let clip = every(&clip, stride);
            let end = Frame(clip.len().min(48));
            let clip = clip.trimmed(Frame(0), end).unwrap();
            let expected = found(&clip);
            for (first_order, other_axes, scale) in [
                (0, false, 2.54),
                (1, true, 1.0),
                (2, false, 0.01),
                (3, true, 39.37),
                (5, true, 0.3),
            ] {
                let other = Rerig { first_order, other_axes, scale }.apply(&clip);
                let at = format!("{name}, every {stride}, order {first_order}, scale {scale}");
                assert_eq!(found(&other), expected, "{at}");
                assert_eq!(found(&with_positions_everywhere(&other)), expected, "{at}, positions");
            }
        }
    }
}
