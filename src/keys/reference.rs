//! The source koma after koma: what keys and rests are judged against.

use std::ops::Range;

use glam::DVec3;

use crate::keys::points::Points;
use crate::motion::{Body, Clip, Pose};
use crate::time::{Clock, Frame};

/// The source at each koma, computed once: what a reconstruction is measured against.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    clock: Clock,
    koma: usize,
    points: Points,
    /// Koma × points.
    positions: Vec<DVec3>,
    /// Height of the body in the file's unit: see [`Reference::of`].
    height: f64,
}

impl Reference {
    /// Samples the clip at every koma of the clock.
    ///
    /// The body's height is the median over the koma of the longest side of the box round all its points.
    /// It is taken from the motion and not from the rest pose because rest poses are a matter of the
    /// rig: arms out, arms down, or all bones along one axis.
    pub fn of(clip: &Clip, clock: Clock) -> Self {
        let points = Points::of(clip.skeleton());
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let mut positions = vec![DVec3::ZERO; koma * points.len()];
        let (mut pose, mut body) = (Pose::rest(clip.skeleton()), Body::new(clip.skeleton()));
        let mut sides = Vec::with_capacity(koma);
        for (at, row) in positions.chunks_exact_mut(points.len().max(1)).enumerate() {
            pose.take_place(clip, clock.place_from_koma(at));
            points.place(&mut body, &pose, row);
            sides.push(longest_side(row));
        }
        sides.sort_by(f64::total_cmp);
        let median = sides.get(sides.len() / 2).copied().unwrap_or(0.0);
        // A body of one point has no height; what it moves through stands for it.
        let height = if median > 0.0 { median } else { longest_side(&positions) };
        Self { clock, koma, points, positions, height }
    }

    /// Where its koma stand.
    pub(super) fn clock(&self) -> Clock {
        self.clock
    }

    /// Seconds that its koma last.
    pub(super) fn seconds(&self) -> f64 {
        self.koma as f64 / self.clock.koma_rate
    }

    /// The points that positions are of.
    pub(super) fn points(&self) -> &Points {
        &self.points
    }

    /// Where every point stands at a koma.
    pub(super) fn positions(&self, koma: usize) -> &[DVec3] {
        let points = self.points.len();
        &self.positions[koma * points..(koma + 1) * points]
    }

    /// The body's height in the file's unit: see [`Reference::of`].
    pub(super) fn height(&self) -> f64 {
        self.height
    }

    /// How fast the body goes into each koma from the second on, in % of its height a second: root mean
    /// square over its points.
    pub(super) fn speeds(&self) -> Vec<f64> {
        if self.points.len() == 0 || self.height <= 0.0 {
            return Vec::new();
        }
        let percent = 100.0 * self.clock.koma_rate / self.height;
        let rows: Vec<&[DVec3]> = self.positions.chunks_exact(self.points.len()).collect();
        let speed = |pair: &[&[DVec3]]| percent * self.points.apart(pair[0], pair[1]).sqrt();
        rows.windows(2).map(speed).collect()
    }

    /// The koma whose place lies strictly between two frames.
    pub(super) fn koma_between(&self, from: Frame, to: Frame) -> Range<usize> {
        let per_frame = self.clock.koma_rate / self.clock.frame_rate.fps();
        let koma = |frame: Frame| (frame.0 - self.clock.first.0) as f64 * per_frame;
        let begin = (koma(from) + 1e-9).floor() as usize + 1;
        let end = ((koma(to) - 1e-9).ceil().max(0.0) as usize).min(self.koma);
        begin.min(end)..end
    }
}

/// The longest side of the box round some points.
fn longest_side(points: &[DVec3]) -> f64 {
    let low = points.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = points.iter().copied().reduce(DVec3::max).unwrap_or_default();
    (high - low).max_element()
}
