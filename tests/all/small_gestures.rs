//! Clips in which little happens: somebody sits, stands, or talks with small gestures.

use std::f64::consts::TAU;

use genga::motion::{Channel, Clip, bvh};
use genga::time::{Frame, FrameRate};

/// Frames per second, as in captures.
const FPS: f64 = 120.0;

/// Amplitude of every joint's tremble, in degrees.
const TREMBLE: f64 = 0.08;

/// Ways of being quiet: name and seconds.
pub(crate) const ALL: [(&str, f64); 3] = [("sitting", 12.0), ("standing", 12.0), ("talking", 14.0)];

/// The gestures of somebody who talks: begin in seconds, joint, channel, degrees and duration in seconds.
const GESTURES: [(f64, &str, usize, f64, f64); 4] = [
    (2.5, "RightForeArm", 1, 45.0, 0.8),
    (5.0, "Head", 1, 30.0, 0.8),
    (8.0, "RightForeArm", 1, 30.0, 0.7),
    (10.5, "LeftArm", 0, 25.0, 0.9),
];

/// The gestures' begins and durations in seconds.
pub(crate) fn gestures() -> impl Iterator<Item = (f64, f64)> {
    GESTURES.into_iter().map(|(begin, .., seconds)| (begin, seconds))
}

/// Makes the clip of that name with the skeleton of `data/pitch.bvh`.
pub(crate) fn clip(name: &str) -> Clip {
    let (_, seconds) = ALL.into_iter().find(|quiet| quiet.0 == name).expect("there is such a clip");
    let text = include_bytes!("../../data/pitch.bvh");
    let pose = bvh::read(text).expect("a sample").clip;
    let frames = (FPS * seconds) as usize + 1;
    let values = (0..frames).flat_map(|frame| row(&pose, name, frame as f64 / FPS)).collect();
    let rate = FrameRate::new(FPS).expect("a rate");
    Clip::new(pose.skeleton().clone(), rate, Frame(0), frames, values).expect("a table")
}

/// The channels at an instant.
fn row(pose: &Clip, name: &str, time: f64) -> Vec<f64> {
    let mut row = pose.row(Frame(0)).to_vec();
    tremble(pose, time, &mut row);
    let mut turn = |joint: &str, channel: usize, degrees: f64| {
        let id = pose.skeleton().find(joint).expect("the sample has it");
        let joint = &pose.skeleton().joints[id.0];
        let rotations = joint.channels.len() - 3;
        row[joint.first_channel + rotations + channel] += degrees;
    };
    // Every body breathes, one breath in four seconds.
    let breath = (TAU * 0.25 * time).sin();
    turn("Spine1", 1, 0.6 * breath);
    turn("LeftArm", 0, 0.5 * breath);
    turn("RightArm", 0, -0.5 * breath);
    match name {
        "sitting" => {
            ["LeftUpLeg", "RightUpLeg"].iter().for_each(|leg| turn(leg, 1, -80.0));
            ["LeftLeg", "RightLeg"].iter().for_each(|leg| turn(leg, 1, 80.0));
        }
        "standing" => turn("Hips", 0, 0.5 * (TAU * 0.3 * time + 1.0).sin()),
        _ => {
            for (begin, joint, channel, degrees, seconds) in GESTURES {
                let share = ((time - begin) / seconds).clamp(0.0, 1.0);
                turn(joint, channel, degrees * (0.5 - 0.5 * (TAU * share).cos()));
            }
        }
    }
    row
}

/// Adds a little unrest to every rotation, each at its own pace.
fn tremble(pose: &Clip, time: f64, row: &mut [f64]) {
    for joint in &pose.skeleton().joints {
        for (at, channel) in joint.channels.iter().enumerate() {
            let column = joint.first_channel + at;
            let hertz = 3.0 + (column * 37 % 61) as f64 / 10.0;
            if matches!(channel, Channel::Rotation(_)) {
                row[column] += TREMBLE * (TAU * hertz * time + column as f64).sin();
            }
        }
    }
}
