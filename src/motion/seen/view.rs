//! Finds the side view that shows most of a motion.

use glam::DVec3;

use crate::maths;

/// An orthographic view: its right, up and near directions in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// Unit vector to the viewer's right.
    pub right: DVec3,
    /// Unit vector up.
    pub up: DVec3,
    /// Unit vector towards the viewer.
    pub near: DVec3,
}

/// Least travel of the root, as a share of the body's height, that counts as walking rather than swaying.
const WALKED: f64 = 0.5;

impl View {
    /// Computes the side view of some poses. All list the positions of the same points, the root first.
    ///
    /// The horizontal direction of largest movement becomes the right: that of the root if it travels, otherwise that
    /// of the points about their means. A walk goes from left to right.
    pub fn new(up: DVec3, poses: &[Vec<DVec3>]) -> Self {
        let first = poses.first().map_or(&[][..], Vec::as_slice);
        // Both pairs satisfy `a` × `b` = `up`.
        let (a, b) = if up == DVec3::Z { (DVec3::X, DVec3::Y) } else { (DVec3::Z, DVec3::X) };
        let roots: Vec<DVec3> = poses.iter().filter_map(|pose| pose.first().copied()).collect();
        let flat = |point: &DVec3| (point.dot(a), point.dot(b));
        let ways =
            [roots.iter().map(flat).collect(), about_means(poses, flat), about_mean(first, flat)];
        let height = extent(first).dot(up);
        let least = [WALKED * height, 1e-9 * height, 0.0];
        let way = ways.iter().zip(least).find(|(way, least)| spread(way) > *least);
        let angle = way.map_or(0.0, |(way, _)| principal_angle(way));
        let right = a * maths::cos(angle) + b * maths::sin(angle);
        let gone = match (roots.first(), roots.last()) {
            (Some(from), Some(to)) => (*to - *from).dot(right),
            _ => 0.0,
        };
        let right = if gone < -1e-9 { -right } else { right };
        Self { right, up, near: right.cross(up) }
    }

    /// Creates the view from a level direction.
    pub fn from(up: DVec3, near: DVec3) -> Self {
        Self { right: up.cross(near), up, near }
    }

    /// Returns the right, up and near coordinates of a point.
    pub fn see(&self, point: DVec3) -> (f64, f64, f64) {
        (point.dot(self.right), point.dot(self.up), point.dot(self.near))
    }

    /// Returns the leftmost and the rightmost coordinate of some points.
    pub fn sides<'a>(&self, pose: impl IntoIterator<Item = &'a DVec3>) -> (f64, f64) {
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        pose.into_iter().fold(start, |(low, high), point| {
            let x = self.see(*point).0;
            (low.min(x), high.max(x))
        })
    }
}

/// Returns the size of the bounding box of some points.
pub fn extent(points: &[DVec3]) -> DVec3 {
    let low = points.iter().copied().reduce(DVec3::min);
    let high = points.iter().copied().reduce(DVec3::max);
    low.zip(high).map_or(DVec3::ZERO, |(low, high)| high - low)
}

/// Projects every point of every pose, relative to the root and to its own mean.
fn about_means(poses: &[Vec<DVec3>], flat: impl Fn(&DVec3) -> (f64, f64)) -> Vec<(f64, f64)> {
    let points = poses.first().map_or(0, Vec::len);
    let against_root = |pose: &Vec<DVec3>, point: usize| pose[point] - pose[0];
    let mut all = Vec::with_capacity(points * poses.len());
    for point in 0..points {
        let sum: DVec3 = poses.iter().map(|pose| against_root(pose, point)).sum();
        let mean = sum / poses.len() as f64;
        all.extend(poses.iter().map(|pose| flat(&(against_root(pose, point) - mean))));
    }
    all
}

/// Projects the points of one pose as they are.
fn about_mean(pose: &[DVec3], flat: impl Fn(&DVec3) -> (f64, f64)) -> Vec<(f64, f64)> {
    pose.iter().map(flat).collect()
}

/// Returns the diagonal of the bounding box of some flat points.
fn spread(points: &[(f64, f64)]) -> f64 {
    let side = |of: fn(&(f64, f64)) -> f64| {
        let values = points.iter().map(of);
        let start = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = values.fold(start, |(low, high), v| (low.min(v), high.max(v)));
        (high - low).max(0.0)
    };
    maths::hypot(side(|point| point.0), side(|point| point.1))
}

/// Computes the principal direction of flat points, as an angle from the first axis towards the second.
fn principal_angle(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let sum = points.iter().fold((0.0, 0.0), |sum, point| (sum.0 + point.0, sum.1 + point.1));
    let mean = (sum.0 / count, sum.1 / count);
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for point in points {
        let (a, b) = (point.0 - mean.0, point.1 - mean.1);
        aa += a * a;
        ab += a * b;
        bb += b * b;
    }
    0.5 * maths::atan2(2.0 * ab, aa - bb)
}
