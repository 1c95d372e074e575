//! Finds and removes ramps: frames in which a tracker sits at the origin or travels from or to it.
//!
//! A capture system that does not know the body's position yet writes zeros, and its smoothing makes a ramp
//! of a few frames from there. No real body moves from the origin at such a speed and is far slower in the
//! next frame.

use crate::error::Warning;
use crate::motion::clean::ends::{End, Jump, MOST_HELD, following};
use crate::motion::{Channel, Clip, Joint, local_translation};
use crate::time::Frame;

/// A position within this share of the body's longest reach counts as the origin.
const AT_ORIGIN: f64 = 0.01;

/// Shortest way of a ramp, as a share of the reach.
const SMALLEST_WAY: f64 = 0.1;

/// Least ratio of a ramp's largest step to any step of the motion beside it.
const JUMP: f64 = 5.0;

/// Longest duration of a ramp in seconds, and the number of frames always allowed.
const LONGEST: f64 = 0.035;
const MOST_FRAMES: usize = 3;

/// Share of the reach below which a step is rounding, not motion.
const STILL: f64 = 1e-9;

/// The ramps of a clip: frames at both ends in which a tracker is at the origin or on its way.
///
/// A joint with position channels is within 0.01 of the skeleton's longest reach from the origin in the
/// outermost frame. It moves 0.1 of the reach or more. The largest step of its way is at least 5 times any
/// step of the next 0.25 s (at least 4 steps). The way takes at most 3 frames or 0.035 s, whichever is
/// longer. A clip that is too short to tell, or still beside the way, has no ramp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Ramps {
    /// First and last frame of the ramp at the start.
    pub front: Option<(Frame, Frame)>,
    /// First and last frame of the ramp at the end.
    pub back: Option<(Frame, Frame)>,
}

impl Ramps {
    /// Finds the ramps of a clip.
    ///
    /// ```
    /// use genga::motion::{bvh::read, clean::Ramps};
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

    /// Removes these frames from the clip and returns the warning `W_RAMP` about them. Frames keep their
    /// numbers. Ramp frames that the clip no longer has are ignored.
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

/// Number of steps from an end to the last frame in which a joint is at the origin or on its way.
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
