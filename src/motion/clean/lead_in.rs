//! Finds and removes an inserted pose in front of the motion or behind it.
//!
//! The cgspeed releases of the CMU clips start with a T-pose. In the DAZ-friendly ones the next three or
//! four steps still lead out of it. A search for the fastest frame would pick these.
//!
//! The first step is compared with the steps *right after* it, never with the whole clip. A clip that
//! starts in the middle of a swing starts fast, but a body cannot be five times slower a frame later.
//!
//! At low rates the steps of the motion grow and the jump does not. The share of jumping joints still tells
//! them apart. Out of a T-pose nearly every joint jumps, each more than it turns afterwards, while a body
//! that starts fast swings one limb and carries the rest.

use glam::DQuat;

use crate::error::Warning;
use crate::maths;
use crate::motion::clean::ends::{End, Jump, MOST_HELD, following};
use crate::motion::{Clip, Pose, is_t_pose};
use crate::time::Frame;

/// Least ratio of a jump to the largest following step, if [`SOME_JOINTS`] of the joints jump. A single
/// joint that turns half round in one step is a capture error, not a pose.
const JUMP: f64 = 5.0;

/// Least ratio if [`MOST_JOINTS`] of the joints jump; starts of real clips reach 2.6 at 12 to 120 frames a
/// second.
const COMMON_JUMP: f64 = 2.5;

/// Least ratio of a joint's turn to its own largest following step for the joint to count as jumping. Half
/// of the joints reach 2.4 out of a T-pose at 12 frames a second, 3.4 at 24 and 3.6 at 120. Of 33,210 other
/// start frames, none reaches 2 in half of its joints while its jump is 2.5 times any following step.
const JOINT_JUMP: f64 = 2.0;

/// Least share of jumping joints, for a pose that only shifts the body: 17 to 22 % in real clips, and up to
/// 8 % in capture errors.
const SOME_JOINTS: f64 = 0.12;

/// Least share of jumping joints in a jump out of a T-pose.
const MOST_JOINTS: f64 = 0.5;

/// Turn in radians below which a joint counts as still and is ignored.
const STANDS: f64 = 1e-4;

/// Longest way out of the pose after the jump, in seconds: four frames at 120 and at 100 frames a second.
/// In a longer time a body can really stop.
const LONGEST_TAIL: f64 = 0.035;

/// Least straightness of the way out of a pose that is no T-pose: from end to end, as a share of its steps. Real clips go
/// out of inserted poses at 0.99. A body that shakes comes back.
const STRAIGHT: f64 = 0.9;

/// Smallest jump, in mean radians per joint; below 1 degree it does not matter.
const SMALLEST_JUMP: f64 = 0.0175;

/// Mean radians per joint below which a step is rounding, not motion.
const STILL: f64 = 1e-7;

/// A lead-in or lead-out of a clip.
///
/// A lead-in is an inserted pose at the start and the frames that lead out of it. A lead-out is its mirror
/// image at the end: the way into a pose, then the pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeadIn {
    /// The first frame that is not motion; for a lead-in, the clip's first.
    pub first: Frame,
    /// The last frame that is not motion; for a lead-out, the clip's last.
    pub last: Frame,
    /// Ratio of the jump to the largest step of the quarter of a second beside it.
    pub ratio: f64,
    /// Whether the inserted pose is a T-pose: arms level and spread, in the body's own axes.
    pub is_t_pose: bool,
}

impl LeadIn {
    /// Finds the lead-in of a clip, if it has one.
    ///
    /// A step is the sum of the angles by which the joints turn relative to their parents. The lead-in ends
    /// before the first step that belongs to the motion. Returns `None` if the clip is too short to tell,
    /// or if it is still after the jump: its frames are then drawings, as in limited animation.
    pub fn find(clip: &Clip) -> Option<Self> {
        Self::find_at(clip, End::Front)
    }

    /// Finds the lead-out of a clip, if it has one, like [`LeadIn::find`] on the clip played backwards.
    pub fn find_out(clip: &Clip) -> Option<Self> {
        Self::find_at(clip, End::Back)
    }

    fn find_at(clip: &Clip, end: End) -> Option<Self> {
        let (following, tail) = (following(clip), (LONGEST_TAIL * clip.rate().fps()).round());
        let joints = clip.skeleton().len() as f64;
        let steps = Steps::new(clip, end, MOST_HELD + 1 + tail as usize + following);
        let jump = Jump::find(&steps.sums, STILL * joints, tail as usize, following)?;
        let size = steps.sums[jump.begin];
        let ratio = size / jump.largest_after;
        let jumping = steps.share_of_joints(jump.begin, jump.end + 1, following);
        let stands_out = ratio >= JUMP && jumping >= SOME_JOINTS
            || ratio >= COMMON_JUMP && jumping >= MOST_JOINTS;
        if !stands_out || size < SMALLEST_JUMP * joints {
            return None;
        }
        let is_t_pose = is_t_pose(clip, end.frame(clip, 0));
        let leads_out = is_t_pose || steps.straightness(jump.begin, jump.end) >= STRAIGHT;
        leads_out.then(|| {
            let (first, last) = end.span(clip, jump.end);
            Self { first, last, ratio, is_t_pose }
        })
    }

    /// Number of frames.
    #[expect(clippy::len_without_is_empty, reason = "it has a frame at the least")]
    pub fn len(&self) -> usize {
        self.last.0 - self.first.0 + 1
    }

    /// Builds the warning `W_LEAD_IN` for the user.
    pub fn warning(&self) -> Warning {
        let Self { first, last, ratio, is_t_pose } = self;
        let pose = if *is_t_pose { "T-pose" } else { "pose" };
        let frames = if first == last {
            format!("frame {first} is")
        } else {
            format!("frames {first} to {last} are")
        };
        let message = format!(
            "{frames} an inserted {pose}, not motion: a jump {ratio:.0} times any step beside it; left out (keep with --keep-lead-in)"
        );
        Warning::new("W_LEAD_IN", message)
    }
}

/// Removes the lead-in of a clip and returns the warning about it, if there was one. Frames keep their
/// numbers in the file.
pub fn strip(clip: Clip) -> (Clip, Option<Warning>) {
    let Some(lead_in) = LeadIn::find(&clip) else { return (clip, None) };
    let (begin, end) = (Frame(lead_in.last.0 + 1), Frame(clip.last().0 + 1));
    let motion = clip.trimmed(begin, end).expect("steps were seen after the lead-in");
    (motion, Some(lead_in.warning()))
}

/// Removes the lead-out of a clip and returns the warning about it, if there was one.
pub fn strip_out(clip: Clip) -> (Clip, Option<Warning>) {
    let Some(lead_out) = LeadIn::find_out(&clip) else { return (clip, None) };
    let begin = clip.first();
    let motion = clip.trimmed(begin, lead_out.first).expect("steps were seen before it");
    (motion, Some(lead_out.warning()))
}

/// The steps inward from one end of a clip, in radians; step 0 is the outermost.
struct Steps {
    /// Rotations of the joints, frame by frame.
    rotations: Vec<Vec<DQuat>>,
    /// Turn of each joint, step by step.
    joints: Vec<Vec<f64>>,
    /// Sums over all joints, step by step.
    sums: Vec<f64>,
}

impl Steps {
    fn new(clip: &Clip, end: End, most: usize) -> Self {
        let count = clip.len().saturating_sub(1).min(most);
        let mut pose = Pose::rest(clip.skeleton());
        let rotations: Vec<Vec<DQuat>> = (0..clip.len().min(count + 1))
            .map(|step| {
                pose.take_frame(clip, end.frame(clip, step));
                pose.rotations.clone()
            })
            .collect();
        let joints: Vec<Vec<f64>> =
            rotations.windows(2).map(|pair| turned(&pair[0], &pair[1])).collect();
        let sums = joints.iter().map(|step| step.iter().sum()).collect();
        Self { rotations, joints, sums }
    }

    /// How straight some steps lead away: the turn from the first pose to the last, as a share of the steps between.
    fn straightness(&self, begin: usize, end: usize) -> f64 {
        let away: f64 = turned(&self.rotations[begin], &self.rotations[end + 1]).iter().sum();
        away / self.sums[begin..=end].iter().sum::<f64>()
    }

    /// The share of jumping joints among those that turn at all; 0 if none does.
    fn share_of_joints(&self, jump: usize, begin: usize, count: usize) -> f64 {
        let end = (begin + count).min(self.joints.len());
        let (mut turning, mut jumping) = (0usize, 0usize);
        for (joint, jump) in self.joints[jump].iter().enumerate() {
            let steps = self.joints[begin.min(end)..end].iter().map(|step| step[joint]);
            let largest = steps.fold(0.0, f64::max);
            turning += usize::from(jump.max(largest) > STANDS);
            jumping += usize::from(*jump > STANDS && *jump >= JOINT_JUMP * largest);
        }
        jumping as f64 / turning.max(1) as f64
    }
}

/// The angle by which each joint turns, in radians.
fn turned(from: &[DQuat], to: &[DQuat]) -> Vec<f64> {
    from.iter().zip(to).map(|(from, to)| angle(*from, *to)).collect()
}

/// The angle between two rotations from their chord, which is exact for small angles; q and −q are the same
/// rotation.
fn angle(from: DQuat, to: DQuat) -> f64 {
    let chord = (from - to).length().min((from + to).length());
    4.0 * maths::asin((0.5 * chord).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::bvh::{read, sample};
    use crate::motion::{Axis, Channel, Joint, Skeleton};
    use crate::time::FrameRate;

    /// Number of leading frames that each real clip loses. `threejs-pirouette` moves so soon that its
    /// fourth step after the jump belongs to the dance.
    const EXPECTED: [(&str, usize); 15] = [
        ("cmu-01_06-playground-long", 1),
        ("cmu-02_04-jump-balance", 1),
        ("cmu-02_05-punch-strike", 1),
        ("cmu-02_07-swordplay", 1),
        ("cmu-05_11-dance-pirouette", 1),
        ("cmu-06_15-dribble-shoot", 1),
        ("cmu-07_01-walk", 1),
        ("cmu-09_01-run", 1),
        ("cmu-10_03-soccer-kick", 5),
        ("cmu-11_01-soccer-kick", 5),
        ("cmu-131_03-start-hop-stop", 0),
        ("cmu-135_04-front-kick", 5),
        ("optitrack-arena-louise", 2),
        ("rokoko-jesse-dance", 0),
        ("threejs-pirouette", 4),
    ];

    #[test]
    fn real_clips_lose_their_inserted_pose_and_nothing_else() {
        for (name, bytes) in sample::real_clips() {
            let clip = read(&bytes).unwrap().clip;
            let expected = EXPECTED.iter().find(|(clip, _)| *clip == name);
            let (_, expected) = expected.unwrap_or_else(|| panic!("{name} is not in the table"));
            let (motion, warning) = strip(clip.clone());
            assert_eq!(motion.first(), Frame(*expected), "{name}");
            assert_eq!(motion.last(), clip.last(), "{name}");
            assert_eq!(motion.row(motion.last()), clip.row(clip.last()), "{name}");
            assert_eq!(warning.is_some(), *expected > 0, "{name}");
            let is_t_pose = LeadIn::find(&clip).is_none_or(|lead_in| lead_in.is_t_pose);
            assert!(is_t_pose, "the arms of {name} are spread");
            if name.contains("walk") {
                let walk = (10..clip.len()).step_by(40).map(Frame);
                assert!(walk.into_iter().all(|frame| !super::is_t_pose(&clip, frame)), "{name}");
            }
            assert_eq!(LeadIn::find(&motion), None, "{name} has a second one");
        }
    }

    /// `count` rows of a clip, every `stride`-th from `begin` on.
    fn window(clip: &Clip, begin: usize, count: usize, stride: usize) -> Clip {
        let rows: Vec<&[f64]> = clip.rows().skip(begin).step_by(stride).take(count).collect();
        let rate = FrameRate::new(clip.rate().fps() / stride as f64).unwrap();
        Clip::new(clip.skeleton().clone(), rate, Frame(0), rows.len(), rows.concat()).unwrap()
    }

    /// Start frames to try: every fourth, and the fastest twentieth.
    fn starts(clip: &Clip) -> Vec<usize> {
        let sums = Steps::new(clip, End::Front, usize::MAX).sums;
        let mut fastest: Vec<usize> = (0..sums.len()).collect();
        fastest.sort_by(|a, b| sums[*b].total_cmp(&sums[*a]));
        let mut starts = fastest[..sums.len() / 20].to_vec();
        starts.extend((0..sums.len()).step_by(4));
        starts.retain(|begin| (10..clip.len() - 45).contains(begin));
        starts
    }

    /// Cuts real clips in the middle of kicks, jumps and punches, and at regular places.
    #[test]
    fn of_a_thousand_places_to_cut_real_clips_at_most_one_looks_like_a_lead_in() {
        let clips = sample::real_clips();
        let clips: Vec<_> =
            clips.iter().map(|(name, bytes)| (name, read(bytes).unwrap())).collect();
        for stride in [1, 2, 3, 4, 5, 8] {
            let (mut cuts, mut alarms) = (0, Vec::new());
            for (name, read) in &clips {
                for begin in starts(&read.clip) {
                    cuts += 1;
                    if LeadIn::find(&window(&read.clip, begin, 76, stride)).is_some() {
                        alarms.push((*name, begin));
                    }
                }
            }
            assert!(alarms.len() * 1000 <= cuts, "{stride}: {alarms:?} of {cuts} cuts");
        }
    }

    #[test]
    fn a_jump_of_most_joints_counts_although_the_motion_is_fast_and_that_of_one_never() {
        let start = |joints: f64, degrees: f64| {
            turning(24.0, 60, move |frame, joint| {
                let out = if frame == 0 && joint < joints { degrees } else { 0.0 };
                60.0 + 8.0 * (6.0 * frame as f64 / 24.0 + joint).sin() - out
            })
        };
        let found = LeadIn::find(&start(20.0, 5.0)).unwrap();
        assert!(found.len() == 1 && found.ratio < JUMP, "{found:?}");
        assert_eq!(LeadIn::find(&start(9.0, 10.0)), None, "a limb");
        let flip = LeadIn::find(&start(1.0, 180.0));
        assert_eq!(flip, None, "a joint that the capture has the wrong way round");
    }

    const JOINTS: usize = 20;

    /// A clip of joints that turn about X, by `degrees(frame, joint)`.
    fn turning(fps: f64, frames: usize, degrees: impl Fn(usize, f64) -> f64) -> Clip {
        let joint = |joint: usize| Joint {
            name: format!("joint {joint}"),
            parent: None,
            offset: glam::DVec3::ZERO,
            channels: vec![Channel::Rotation(Axis::X)],
            first_channel: joint,
            end_sites: vec![],
        };
        let skeleton = Skeleton { joints: (0..JOINTS).map(joint).collect() };
        let values = (0..frames)
            .flat_map(|frame| (0..JOINTS).map(move |joint| (frame, joint)))
            .map(|(frame, joint)| degrees(frame, joint as f64))
            .collect();
        Clip::new(skeleton, FrameRate::new(fps).unwrap(), Frame(0), frames, values).unwrap()
    }

    fn walk(seconds: f64, joint: f64) -> f64 {
        30.0 + 20.0 * (6.0 * seconds + joint).sin()
    }

    #[test]
    fn a_t_pose_before_a_walk_is_found_however_long_it_is_held() {
        for fps in [24.0, 30.0, 60.0, 100.0, 120.0, 240.0] {
            for held in [1, 2, 5, 10] {
                let clip = turning(fps, 200, |frame, joint| {
                    if frame < held { 0.0 } else { walk(frame as f64 / fps, joint) }
                });
                let lead_in = LeadIn::find(&clip).unwrap_or_else(|| panic!("{held} at {fps}"));
                assert_eq!(lead_in.len(), held, "{fps}");
            }
        }
    }

    #[test]
    fn a_pose_behind_the_motion_is_found_as_one_in_front_of_the_clip_played_backwards() {
        for (fps, held) in [(24.0, 1), (60.0, 2), (120.0, 5)] {
            let pose = |frame: usize, joint| {
                if frame < held { 0.0 } else { walk(frame as f64 / fps, joint) }
            };
            let front = LeadIn::find(&turning(fps, 200, pose)).unwrap();
            let backwards = turning(fps, 200, |frame, joint| pose(199 - frame, joint));
            let back = LeadIn::find_out(&backwards).unwrap();
            let (first, last) = (Frame(199 - front.last.0), Frame(199 - front.first.0));
            assert_eq!(back, LeadIn { first, last, ..front }, "{held} at {fps}");
            let (motion, warning) = strip_out(backwards.clone());
            assert_eq!(motion, backwards.trimmed(Frame(0), first).unwrap());
            assert_eq!(warning, Some(back.warning()));
        }
    }

    #[test]
    fn a_lead_in_is_left_out_with_a_sentence_and_frames_keep_their_numbers() {
        let pose =
            |frame: usize, joint| if frame < 2 { 0.0 } else { walk(frame as f64 / 120.0, joint) };
        let clip = turning(120.0, 100, pose).trimmed(Frame(1), Frame(100)).unwrap();
        let (motion, warning) = strip(clip.clone());
        assert_eq!((motion.first(), motion.last(), motion.len()), (Frame(2), Frame(99), 98));
        let warning = warning.unwrap();
        assert_eq!(warning.code, "W_LEAD_IN");
        let words = "frame 1 is an inserted pose, not motion: a jump ";
        assert!(warning.message.starts_with(words), "{warning}");
        assert!(warning.message.ends_with("left out (keep with --keep-lead-in)"), "{warning}");
        let longer = LeadIn { first: Frame(0), last: Frame(4), ratio: 10.0, is_t_pose: true };
        assert!(longer.warning().message.starts_with("frames 0 to 4 are an inserted T-pose"));
    }

    #[test]
    fn the_way_out_of_the_pose_is_left_out_too() {
        let left = [1.0, 0.7, 0.4, 0.15];
        let clip = turning(120.0, 200, |frame, joint| {
            walk(frame as f64 / 120.0, joint) * (1.0 - left.get(frame).unwrap_or(&0.0))
        });
        assert_eq!(LeadIn::find(&clip).unwrap().len(), 4);
    }

    #[test]
    fn a_shake_has_no_lead_in() {
        let way = |there: f64| {
            turning(25.0, 40, move |frame, joint| match frame {
                0 => 60.0,
                1 => 60.0 + there,
                _ => 50.0 + 2.0 * (frame as f64 / 25.0 + joint).sin(),
            })
        };
        assert_eq!(LeadIn::find(&way(-6.0)).unwrap().len(), 2, "straight out of a pose");
        assert_eq!(LeadIn::find(&way(6.0)), None, "there and back");
    }

    #[test]
    fn a_clip_that_starts_in_the_middle_of_a_swing_has_no_lead_in() {
        for fps in [24.0, 30.0, 60.0, 120.0, 240.0] {
            let clip = turning(fps, 200, |frame, joint| {
                let seconds = frame as f64 / fps;
                -90.0 * (-seconds / 0.1).exp() + 0.1 * walk(seconds, joint)
            });
            assert_eq!(LeadIn::find(&clip), None, "{fps}");
        }
    }

    #[test]
    fn held_drawings_are_no_lead_in() {
        for holds in [2, 6, 20] {
            let pose = |frame: usize, joint| walk(frame.div_ceil(holds) as f64, joint);
            assert_eq!(LeadIn::find(&turning(24.0, 60, pose)), None, "{holds}");
        }
    }

    #[test]
    fn no_motion_a_tremble_and_too_few_frames_have_no_lead_in() {
        assert_eq!(LeadIn::find(&turning(120.0, 100, |_, joint| joint)), None);
        let tremble = |frame: usize, joint: f64| {
            if frame == 0 { 0.9 } else { 0.01 * walk(frame as f64 / 120.0, joint) - 0.3 }
        };
        assert_eq!(LeadIn::find(&turning(120.0, 100, tremble)), None);
        let pose = |frame: usize, joint| {
            if frame == 0 { 0.0 } else { walk(frame as f64 / 120.0, joint) }
        };
        for frames in 0..=5 {
            assert_eq!(LeadIn::find(&turning(120.0, frames, pose)), None, "{frames}");
            assert_eq!(LeadIn::find(&turning(24.0, frames, pose)), None, "{frames}");
            let (clip, warning) = strip(turning(120.0, frames, pose));
            assert_eq!((clip.len(), warning), (frames, None));
        }
    }
}
