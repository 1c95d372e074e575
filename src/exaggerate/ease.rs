//! Slow-in and slow-out (スローイン・スローアウト) by a bilateral filter of time, after Kwon and Lee 2011: averages the times of
//! poses that are near in time *and* alike, so that slow poses gather the frames around them.
//!
//! Only the timing of poses changes: the path of every joint stays the same.

use rayon::prelude::*;

use crate::maths;
use crate::motion::{Build, Clip, Joint, local_rotation};

/// Half-width of the window, in standard deviations of its bell.
const REACH: f64 = 3.0;

/// Most instants sampled to each side of a frame; a wider window is sampled in wider steps.
const LOOKS: usize = 24;

/// How alike two poses must be to attract one another, as a share of the distance that the body goes within the reach
/// at its root mean square speed.
const ALIKE: f64 = 1.0 / 3.0;

/// Shift in frames below which a place counts as the frame itself.
const DUST: f64 = 1e-9;

/// Computes the source time of each frame of a clip, in frames after the first. Times never go back, and the ends stay
/// in place. `None` if that has no effect. `reach` is a standard deviation in frames.
pub(super) fn places(clip: &Clip, strength: f64, reach: f64) -> Option<Vec<f64>> {
    if strength == 0.0 || reach == 0.0 || clip.len() < 3 {
        return None;
    }
    let poses = Poses::new(clip);
    let window = Window::new(&poses, reach)?;
    let mut drawn: Vec<f64> =
        (0..clip.len()).into_par_iter().map(|frame| window.drawn(frame)).collect();
    never_back(&mut drawn);
    let place = |(frame, drawn): (usize, f64)| {
        let shift = strength * (drawn - frame as f64);
        if shift.abs() > DUST { frame as f64 + shift } else { frame as f64 }
    };
    Some(drawn.into_iter().enumerate().map(place).collect())
}

/// Poses as points, one flat row per frame. The distance between two points is the distance between the poses.
struct Poses {
    coordinates: usize,
    values: Vec<f64>,
}

impl Poses {
    /// Takes, for each moving joint, the quaternion of its rotation relative to its parent, times twice the length of
    /// what hangs on it, so that the distance of two points is the root sum square of the joints' paths. The body's
    /// position is left out: a steady walk is to gather in its steps as well.
    fn new(clip: &Clip) -> Self {
        let moving = clip.moving_joints();
        let members = Build::new(clip).members;
        let reaches = members.skeleton().reaches();
        let moving = moving.into_iter().enumerate().map(|(at, moves)| moves && members.has(at));
        let joints = clip.skeleton().joints.iter().zip(reaches).zip(moving);
        let joints: Vec<(&Joint, f64)> = joints
            .filter(|((joint, _), moves)| *moves && joint.turns())
            .map(|(own, _)| own)
            .collect();
        let coordinates = 4 * joints.len();
        let mut values = Vec::with_capacity(clip.len() * coordinates);
        let mut before = vec![glam::DQuat::IDENTITY; joints.len()];
        for row in clip.rows() {
            for ((joint, reach), before) in joints.iter().zip(&mut before) {
                let rotation = local_rotation(joint, row);
                // Picks the one of q and −q that continues from the previous frame.
                *before = if rotation.dot(*before) < 0.0 { -rotation } else { rotation };
                values.extend((*before * (2.0 * reach)).to_array());
            }
        }
        Self { coordinates, values }
    }

    fn frames(&self) -> usize {
        self.values.len().checked_div(self.coordinates).unwrap_or(0)
    }

    /// Returns the squared distance between the poses of two frames.
    fn apart(&self, frame: usize, other: usize) -> f64 {
        let row = |frame: usize| &self.values[frame * self.coordinates..][..self.coordinates];
        let squares = row(frame).iter().zip(row(other)).map(|(a, b)| (a - b) * (a - b));
        squares.sum()
    }
}

/// The weights that attract a frame to its neighbours.
struct Window<'a> {
    poses: &'a Poses,
    /// The factor −1/2σ² of the squared distance between poses.
    alike: f64,
    /// The weights of the sampled instants on one side, by time alone.
    near: Vec<f64>,
    /// Frames between two sampled instants.
    step: usize,
}

impl<'a> Window<'a> {
    /// Creates the window; `None` if nothing moves or the window is a single frame.
    fn new(poses: &'a Poses, reach: f64) -> Option<Self> {
        let steps = poses.frames().saturating_sub(1);
        let way: f64 = (0..steps).map(|frame| poses.apart(frame, frame + 1)).sum();
        let sigma = ALIKE * reach * (way / steps as f64).sqrt();
        let widest = (REACH * reach).floor().min(steps as f64) as usize;
        let step = widest.div_ceil(LOOKS);
        if step == 0 || sigma == 0.0 {
            return None;
        }
        let weight = |look: usize| maths::exp(-0.5 * ((look * step) as f64 / reach).powi(2));
        let near = (1..=widest / step).map(weight).collect();
        Some(Self { poses, alike: -0.5 / (sigma * sigma), near, step })
    }

    /// Returns the mean time of the instants that are near a frame and like it, itself included. The clip is mirrored
    /// beyond its ends, so that the ends attract no shift.
    fn drawn(&self, frame: usize) -> f64 {
        let last = self.poses.frames() - 1;
        let (mut shift, mut weights) = (0.0, 1.0);
        for (look, near) in self.near.iter().enumerate() {
            let way = (look + 1) * self.step;
            let after = if frame + way > last { 2 * last - frame - way } else { frame + way };
            let weight = |other| near * maths::exp(self.alike * self.poses.apart(frame, other));
            let (before, after) = (weight(frame.abs_diff(way)), weight(after));
            shift += way as f64 * (after - before);
            weights += before + after;
        }
        (frame as f64 + shift / weights).clamp(0.0, last as f64)
    }
}

/// Finds the nearest times that never go back (isotonic regression): each stretch that would is shown at its mean.
fn never_back(times: &mut [f64]) {
    // Each stretch as its sum and length.
    let mut stretches: Vec<(f64, usize)> = Vec::with_capacity(times.len());
    for time in times.iter() {
        let (mut sum, mut length) = (*time, 1);
        while let Some((before, count)) = stretches.last()
            && before / *count as f64 > sum / length as f64
        {
            (sum, length) = (sum + before, length + count);
            stretches.pop();
        }
        stretches.push((sum, length));
    }
    let mut rest = times;
    for (sum, length) in stretches {
        let (stretch, after) = rest.split_at_mut(length);
        stretch.fill(sum / length as f64);
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exaggerate::tests::chain;
    use crate::motion::{Axis, Pose};
    use crate::time::Frame;

    /// Builds a chain of two freely rotating joints.
    fn clip(values: &[[f64; 6]]) -> Clip {
        chain([Axis::Z, Axis::X, Axis::Y], values)
    }

    /// Computes the mean time by definition, over every frame of the mirrored clip within the window.
    fn slow(clip: &Clip, reach: f64) -> Vec<f64> {
        let last = clip.len() as isize - 1;
        let fold = |at: isize| {
            let at = at.rem_euclid(2 * last);
            at.min(2 * last - at) as usize
        };
        let poses: Vec<Pose> = (0..clip.len())
            .map(|frame| {
                let mut pose = Pose::rest(clip.skeleton());
                pose.take_frame(clip, Frame(clip.first().0 + frame));
                pose
            })
            .collect();
        let reaches = clip.skeleton().reaches();
        let apart = |a: usize, b: usize| -> f64 {
            let both = poses[a].rotations.iter().zip(&poses[b].rotations).zip(&reaches);
            both.map(|((a, b), reach)| 4.0 * reach * reach * (2.0 - 2.0 * a.dot(*b).abs())).sum()
        };
        let way: f64 = (1..clip.len()).map(|frame| apart(frame - 1, frame)).sum();
        let sigma = reach * (way / last as f64).sqrt() / 3.0;
        let widest = (3.0 * reach).floor().min(last as f64) as isize;
        let drawn = |frame: isize| {
            let (mut sum, mut weights) = (0.0, 0.0);
            for other in frame - widest..=frame + widest {
                let time = (other - frame) as f64 / reach;
                let pose = apart(fold(frame), fold(other)) / (sigma * sigma);
                let weight = (-0.5 * (time * time + pose)).exp();
                sum += weight * other as f64;
                weights += weight;
            }
            (sum / weights).clamp(0.0, last as f64)
        };
        (0..=last).map(drawn).collect()
    }

    #[test]
    fn the_window_is_the_mean_of_the_definition() {
        for (frames, reach) in [(3, 1.0), (20, 2.5), (20, 40.0), (40, 7.9)] {
            let row = |at: usize| {
                [1.0, 0.7, 1.3, 0.4, 2.0, 0.9].map(|pace| 50.0 * (pace * at as f64 * 0.3).sin())
            };
            let clip = clip(&(0..frames).map(row).collect::<Vec<_>>());
            let poses = Poses::new(&clip);
            let window = Window::new(&poses, reach).unwrap();
            assert_eq!(window.step, 1);
            for (frame, slow) in slow(&clip, reach).into_iter().enumerate() {
                let fast = window.drawn(frame);
                assert!((fast - slow).abs() < 1e-6, "{frames} {reach} {frame}: {fast} {slow}");
            }
        }
    }

    #[test]
    fn a_rotation_written_the_other_way_round_is_the_same_pose() {
        let row = |at: usize| {
            let way = 100.0 * (at as f64 * 0.2).sin();
            [way, 0.0, 0.0, if at.is_multiple_of(2) { way } else { way + 360.0 }, 0.0, 0.0]
        };
        let clip = clip(&(0..40).map(row).collect::<Vec<_>>());
        let poses = Poses::new(&clip);
        let window = Window::new(&poses, 3.0).unwrap();
        for (frame, slow) in slow(&clip, 3.0).into_iter().enumerate() {
            assert!((window.drawn(frame) - slow).abs() < 1e-6, "{frame}");
        }
    }

    #[test]
    fn a_wide_window_is_looked_at_in_wide_steps() {
        let row = |at: usize| [30.0 * (at as f64 * 0.01).sin(), 0.0, 0.0, 0.0, 0.0, 0.0];
        let clip = clip(&(0..500).map(row).collect::<Vec<_>>());
        let poses = Poses::new(&clip);
        let window = Window::new(&poses, 60.0).unwrap();
        assert_eq!((window.step, window.near.len()), (8, 22));
        for (frame, slow) in slow(&clip, 60.0).into_iter().enumerate() {
            assert!((window.drawn(frame) - slow).abs() < 1.5, "{frame}");
        }
    }

    #[test]
    fn a_pose_that_flickers_is_not_shown_before_what_came_before_it() {
        let way = |at: usize| [80.0, 40.0, 0.0][if at < 5 { 0 } else { 2 - usize::from(at == 6) }];
        let row = |at: usize| [way(at), 0.0, 0.0, 0.0, 0.0, 0.0];
        let clip = clip(&(0..100).map(row).collect::<Vec<_>>());
        let poses = Poses::new(&clip);
        let window = Window::new(&poses, 5.0).unwrap();
        assert!(window.drawn(6) + 0.5 < window.drawn(5), "the rest behind it draws more");
        let places = places(&clip, 1.0, 5.0).unwrap();
        assert!(places.windows(2).all(|pair| pair[0] <= pair[1]), "{places:?}");
    }

    #[test]
    fn times_that_go_back_are_shown_at_their_mean() {
        let mut times = [0.0, 2.0, 1.0, 3.0, 2.5, 2.0, 5.0];
        never_back(&mut times);
        assert_eq!(times, [0.0, 1.5, 1.5, 2.5, 2.5, 2.5, 5.0]);
        let mut forward = [0.0, 0.1, 0.1, 7.0];
        never_back(&mut forward);
        assert_eq!(forward, [0.0, 0.1, 0.1, 7.0]);
    }
}
