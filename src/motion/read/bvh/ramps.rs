//! A tracker that starts or ends at the origin: its way out and its way back are found, and left out.
//!
//! A system that has no place of the body yet writes zeros, and what smooths its output makes a ramp of
//! a few frames from there. No body goes from the origin to where it is at such a speed and is slower by
//! far in the next frame.

use crate::error::Warning;
use crate::motion::bvh::ends::{End, Jump, MOST_HELD, following};
use crate::motion::{Channel, Clip, Joint, local_translation};
use crate::time::Frame;

/// A place nearer to the origin than this share of the body's longest reach is the origin.
const AT_ORIGIN: f64 = 0.01;

/// The share of the reach that a tracker goes at least.
const SMALLEST_WAY: f64 = 0.1;

/// Its largest step is at least so many times any step of the motion beside it.
const JUMP: f64 = 5.0;

/// Seconds that a ramp may take, and the frames that it may take at whatever rate.
const LONGEST: f64 = 0.035;
const MOST_FRAMES: usize = 3;

/// The share of the reach below which a step is no motion but rounding.
const STILL: f64 = 1e-9;

/// The frames at both ends of a clip in which a tracker is at the origin or on its way.
///
/// A joint with positions is within 0.01 of the skeleton's longest reach from the origin on the
/// outermost frame. It goes 0.1 of the reach or more. The largest step of its way is 5 times or more any step of
/// the next 0.25 s (4 steps at the least). The way takes 3 frames or 0.035 s, what is longer. A clip that
/// is too short to tell has none, nor has one that stands still beside the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Ramps {
    /// First and last frame of the one at the start.
    pub front: Option<(Frame, Frame)>,
    /// First and last frame of the one at the end.
    pub back: Option<(Frame, Frame)>,
}

impl Ramps {
    /// Finds the ramps of a clip.
    ///
    /// ```
    /// use genga::motion::bvh::{Ramps, read};
    ///
    /// let kick = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh"))?;
    /// assert_eq!(Ramps::find(&read(&kick)?.clip), Ramps { front: None, back: None });
    /// # Ok::<_, Box<dyn std::error::Error>>(())
    /// ```
    pub fn find(clip: &Clip) -> Self {
        let reach = clip.skeleton().reaches().into_iter().fold(0.0, f64::max);
        let joints = clip.skeleton().joints.iter().filter(|joint| has_position(joint));
        let of = |end: End| {
            let steps = joints.clone().filter_map(|joint| last_step(clip, joint, reach, end)).max();
            steps.map(|last| end.span(clip, last))
        };
        Self { front: of(End::Front), back: of(End::Back) }
    }

    /// The clip without these frames, and what a person should know about that: `W_RAMP`. Frames keep their
    /// numbers. What the clip does not have any more is not missed.
    pub fn leave_out(self, clip: Clip) -> (Clip, Option<Warning>) {
        let (first, last) = (clip.first(), clip.last());
        let front =
            self.front.map(|(from, to)| (from.max(first), to)).filter(|(from, to)| from <= to);
        let back = self.back.map(|(from, to)| (from, to.min(last))).filter(|(from, to)| from <= to);
        let begin = front.map_or(first, |(_, to)| Frame(to.0 + 1));
        let end = back.map_or(Frame(last.0 + 1), |(from, _)| from);
        if front.or(back).is_none() || begin >= end {
            return (clip, None);
        }
        let motion = clip.trimmed(begin, end).expect("motion stands between the ramps");
        (motion, Some(warning(front.into_iter().chain(back))))
    }
}

fn warning(ramps: impl Iterator<Item = (Frame, Frame)>) -> Warning {
    let frames = |(from, to): (Frame, Frame)| {
        if from == to { format!("frame {from}") } else { format!("frames {from} to {to}") }
    };
    let ramps: Vec<String> = ramps.map(frames).collect();
    let message = format!(
        "{}: the tracker is at the origin or on its way; left out (keep with --keep-glitches)",
        ramps.join(" and ")
    );
    Warning::new("W_RAMP", message)
}

fn has_position(joint: &Joint) -> bool {
    joint.channels.iter().any(|channel| matches!(channel, Channel::Position(_)))
}

/// How many steps from an end the last frame is on which a joint is at the origin or on its way.
fn last_step(clip: &Clip, joint: &Joint, reach: f64, end: End) -> Option<usize> {
    let tail = ((LONGEST * clip.rate().fps()).round() as usize).max(MOST_FRAMES);
    let following = following(clip);
    let most = MOST_HELD + 1 + tail + following;
    let at = |step| local_translation(joint, clip.row(end.frame(clip, step)));
    if clip.is_empty() || reach <= 0.0 || at(0).length() > AT_ORIGIN * reach {
        return None;
    }
    let count = (clip.len() - 1).min(most);
    let steps: Vec<f64> = (0..count).map(|step| at(step).distance(at(step + 1)) / reach).collect();
    let jump = Jump::find(&steps, STILL, tail - 1, following)?;
    let largest = steps[jump.begin..=jump.end].iter().copied().fold(0.0, f64::max);
    let way = at(0).distance(at(jump.end + 1)) / reach;
    let is_ramp = largest >= JUMP * jump.largest_after && way >= SMALLEST_WAY;
    is_ramp.then_some(jump.end)
}

#[cfg(test)]
mod tests;
