//! The sample motions of `data/` are as made, match the papers' tables, and move as a body can.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

#[allow(dead_code, reason = "the program's own printing is not used here")]
#[path = "../examples/make_samples/main.rs"]
mod make_samples;

use std::path::PathBuf;

use genga::motion::{
    Axis, Body, Channel, Clip, EndSite, Joint, JointId, Pose, Skeleton, local_rotation,
};
use genga::time::{Frame, FrameRate};
use glam::DVec3;
use make_samples::perform::{Performance, share};
use make_samples::score::{Score, Side};

const FLOOR_TOLERANCE: f64 = 2.0;
const SLIDE_TOLERANCE: f64 = 3.0;
/// Degrees per second: above the shoulder of these throws, below a joint that jumps.
const FASTEST_TURN: f64 = 1_800.0;

fn data(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("data").join(file)
}

fn text(score: &Score) -> String {
    std::fs::read_to_string(data(score.file)).unwrap()
}

#[test]
fn the_files_are_byte_for_byte_what_the_program_makes() {
    for score in make_samples::actions::all() {
        let made = make_samples::file(&score, &Performance::new(&score));
        assert!(made == text(&score), "{} differs: cargo run --example make_samples", score.file);
    }
}

#[test]
fn frames_joints_and_rates_are_those_of_the_papers() {
    let expected = [
        ("pitch.bvh", 129, 24.0),
        ("kick.bvh", 92, 24.0),
        ("tennis.bvh", 88, 24.0),
        ("swing.bvh", 120, 24.0),
        ("kuroda-pitch.bvh", 496, 100.0),
    ];
    for (file, frames, fps) in expected {
        let clip = clip(&std::fs::read_to_string(data(file)).unwrap());
        assert_eq!((clip.len(), clip.skeleton().len()), (frames, 23), "{file}");
        assert!((clip.rate().fps() - fps).abs() < 1e-3, "{file}: {}", clip.rate().fps());
    }
}

#[test]
fn the_read_me_names_every_key_pose_at_its_frame() {
    let readme = std::fs::read_to_string(data("README.md")).unwrap();
    for score in make_samples::actions::all() {
        let row = format!(
            "| `{}` | {} | {} | 23 | {:.2} | {} |",
            score.file,
            score.frames,
            score.fps,
            (score.frames - 1) as f64 / score.fps,
            make_samples::timeline(&score),
        );
        assert!(readme.contains(&row), "data/README.md lacks\n{row}");
    }
}

#[test]
fn no_foot_is_below_the_floor() {
    each_pose(|score, moment| {
        for side in ["Left", "Right"] {
            let toes = moment.joint(&format!("{side}ToeBase"));
            let tip = moment.tip(toes);
            let foot = moment.positions[moment.joint(&format!("{side}Foot"))];
            let lowest = moment.positions[toes].y.min(tip.y).min(foot.y);
            let frame = moment.frame;
            assert!(lowest > -FLOOR_TOLERANCE, "{} frame {frame}: {side} {lowest}", score.file);
        }
    });
}

#[test]
fn planted_feet_stay_where_they_stand() {
    let mut stood = 0;
    let mut bounds: Vec<Vec<(DVec3, DVec3)>> = Vec::new();
    each_pose(|score, moment| {
        if moment.frame == 0 {
            let nowhere = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            bounds.push(vec![nowhere; score.plants.len()]);
        }
        let time = moment.frame as f64 / score.fps;
        let bounds = bounds.last_mut().unwrap();
        for (plant, (low, high)) in score.plants.iter().zip(bounds) {
            let swings = score.swings.iter().filter(|swing| swing.0 == plant.side);
            let free = swings.map(|swing| share(&swing.1, time)).fold(0.0, f64::max);
            if !(plant.from..=plant.to).contains(&time) || free > 0.0 {
                continue;
            }
            let side = if plant.side == Side::L { "LeftToeBase" } else { "RightToeBase" };
            let ball = moment.positions[moment.joint(side)];
            (*low, *high) = (low.min(ball), high.max(ball));
            let slid = (*high - *low).length();
            let (file, frame) = (score.file, moment.frame);
            assert!(slid < SLIDE_TOLERANCE, "{file} frame {frame}: {side} slid {slid:.1} cm");
            assert!(ball.y < 4.0, "{file} frame {frame}: {side} floats at {:.1} cm", ball.y);
            stood += 1;
        }
    });
    assert!(stood > 1_000, "only {stood} standing feet were looked at");
}

#[test]
fn no_joint_jumps() {
    for score in make_samples::actions::all() {
        let clip = clip(&text(&score));
        for frame in 1..clip.len() {
            let [before, now] = [frame - 1, frame].map(|frame| clip.row(Frame(frame)));
            for joint in &clip.skeleton().joints {
                let step = local_rotation(joint, before).inverse() * local_rotation(joint, now);
                let turn = step.to_scaled_axis().length().to_degrees();
                let turn = turn.min(360.0 - turn) * score.fps;
                let (file, name) = (score.file, &joint.name);
                assert!(turn < FASTEST_TURN, "{file} frame {frame}: {name} turns {turn:.0} °/s");
            }
        }
    }
}

#[test]
fn knees_and_elbows_bend_one_way() {
    each_pose(|score, moment| {
        for (name, hinge) in [
            ("LeftLeg", DVec3::X),
            ("RightLeg", DVec3::X),
            ("LeftForeArm", DVec3::NEG_Y),
            ("RightForeArm", DVec3::Y),
        ] {
            let turn = moment.pose.rotations[moment.joint(name)];
            let bend = 2.0 * turn.xyz().dot(hinge).atan2(turn.w).to_degrees();
            let bend = if bend > 180.0 { bend - 360.0 } else { bend };
            let frame = moment.frame;
            assert!((-3.0..155.0).contains(&bend), "{} frame {frame}: {name} {bend}", score.file);
        }
    });
}

#[test]
fn every_joint_stays_within_reach_and_the_head_above_the_hips() {
    each_pose(|score, moment| {
        let hips = moment.positions[0];
        let far = moment.positions.iter().map(|at| at.distance(hips)).fold(0.0, f64::max);
        assert!(far.is_finite() && far < 140.0, "{} frame {}: {far}", score.file, moment.frame);
        let head = moment.positions[moment.joint("Head")];
        assert!(head.y > hips.y, "{} frame {}: head {head}", score.file, moment.frame);
    });
}

#[test]
fn the_throwing_hand_is_as_fast_as_a_person_s() {
    let mut before = DVec3::ZERO;
    let mut peak: f64 = 0.0;
    each_pose(|score, moment| {
        let hand = moment.positions[moment.joint("RightHand")];
        if score.file == "kuroda-pitch.bvh" && moment.frame > 0 {
            peak = peak.max(hand.distance(before) / 100.0 * score.fps);
        }
        before = hand;
    });
    assert!((15.0..25.0).contains(&peak), "{peak} m/s");
}

/// One frame of a file, placed in the world.
struct Moment<'a> {
    frame: usize,
    skeleton: &'a Skeleton,
    pose: &'a Pose,
    body: &'a Body,
    positions: &'a [DVec3],
}

impl Moment<'_> {
    fn joint(&self, name: &str) -> usize {
        self.skeleton.find(name).unwrap().0
    }

    fn tip(&self, joint: usize) -> DVec3 {
        let end = &self.skeleton.joints[joint].end_sites[0];
        self.positions[joint] + self.body.rotations()[joint] * end.offset
    }
}

/// Calls `look` with every frame of every committed file.
fn each_pose(mut look: impl FnMut(&Score, &Moment)) {
    for score in make_samples::actions::all() {
        let clip = clip(&text(&score));
        let (skeleton, mut pose) = (clip.skeleton(), Pose::rest(clip.skeleton()));
        let mut body = Body::new(skeleton);
        for frame in 0..clip.len() {
            pose.take_frame(&clip, Frame(frame));
            body.place(&pose);
            let (pose, body, positions) = (&pose, &body, body.positions());
            look(&score, &Moment { frame, skeleton, pose, body, positions });
        }
    }
}

/// Reads the output of `bvh_text.rs`, and nothing else.
fn clip(text: &str) -> Clip {
    let mut words = text.split_whitespace();
    let mut skeleton = Skeleton::default();
    let mut open: Vec<Option<JointId>> = Vec::new();
    while let Some(word) = words.next() {
        match word {
            "ROOT" | "JOINT" => {
                let parent = open.last().copied().flatten();
                let first_channel = skeleton.channels();
                open.push(Some(JointId(skeleton.len())));
                skeleton.joints.push(Joint {
                    name: words.next().unwrap().into(),
                    parent,
                    offset: DVec3::ZERO,
                    channels: vec![],
                    first_channel,
                    end_sites: vec![],
                });
            }
            "End" => open.push(None),
            "OFFSET" => {
                let offset: Vec<f64> = numbers(&mut words, 3);
                let offset = DVec3::from_slice(&offset);
                let joint = skeleton.joints.last_mut().unwrap();
                match open.last().unwrap() {
                    Some(_) => joint.offset = offset,
                    None => joint.end_sites.push(EndSite { name: "Site".into(), offset }),
                }
            }
            "CHANNELS" => {
                let count: usize = words.next().unwrap().parse().unwrap();
                let channels = words.by_ref().take(count).map(channel).collect();
                skeleton.joints.last_mut().unwrap().channels = channels;
            }
            "}" => {
                open.pop();
            }
            "MOTION" => break,
            _ => {}
        }
    }
    let frames: usize = words.by_ref().nth(1).unwrap().parse().unwrap();
    let seconds: f64 = words.by_ref().nth(2).unwrap().parse().unwrap();
    let values = numbers(&mut words, frames * skeleton.channels());
    assert_eq!(words.next(), None, "nothing follows the rows");
    Clip::new(skeleton, FrameRate::new(1.0 / seconds).unwrap(), Frame(0), frames, values).unwrap()
}

fn numbers<'a>(words: &mut impl Iterator<Item = &'a str>, count: usize) -> Vec<f64> {
    words.take(count).map(|word| word.parse().unwrap()).collect()
}

fn channel(word: &str) -> Channel {
    let axis = [Axis::X, Axis::Y, Axis::Z][(word.as_bytes()[0] - b'X') as usize];
    if word.ends_with("position") { Channel::Position(axis) } else { Channel::Rotation(axis) }
}
