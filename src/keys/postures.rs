//! Postures (姿勢): the body at each half koma as a row of numbers. The distance of two rows is how far two poses are
//! apart.
//!
//! Rows describe the [`Mannequin`], not the rig, and turn with the body's heading. On a spinning body all frames are
//! alike except for the heading, and the choice of keys must not depend on the axes of the room. On a screen, rows
//! describe what is seen there, and a spin is what it looks like.

mod heading;

use std::array;

use glam::DVec3;

use crate::keys::acting::{self, Acting};
use crate::keys::points::Points;
use crate::maths;
use crate::motion::body::mannequin::{BONES, Mannequin, POINTS, Stand};
use crate::motion::clip::lane_poser::{LanePose, LanePoser};
use crate::motion::lanes::{LANES, LaneVec, wide};
use crate::motion::{Axis, Build, Clip, Point, Screen};
use crate::time::Clock;

/// Movement that a turn of the body by one radian counts as, in body heights: about half a hip's width. Without it a
/// spin would have no keys of its own, and with much more of it little else would.
const GIRTH: f64 = 0.075;

/// The body at evenly spaced instants.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Postures {
    columns: usize,
    /// Instants × columns, in % of the body's height.
    rows: Vec<f64>,
    /// Parts that act while the whole body is quiet.
    acting: Acting,
}

impl Postures {
    /// Computes the body at each instant of a clock as seen on a screen. `height` is the body's in the file's unit, and
    /// `own` the weight of each joint on top of its bones. `build` is that of the whole body.
    ///
    /// The squared distance of two rows is the mean squared distance of the points, weighted by their bones, plus the
    /// squared distance of the pelvis and, in the world, of the heading, and of the turns of parts that act while the
    /// rest is quiet. A body that is no person's is described by its own points.
    pub(super) fn new(
        clip: &Clip,
        build: &Build,
        clock: Clock,
        (screen, height): (&Screen, f64),
        own: &[f64],
    ) -> Self {
        let instants = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let mut postures = match &build.mannequin {
            Some(mannequin) if screen.is_world() => {
                of_person(clip, clock, instants, mannequin, build.landmarks.up, own)
            }
            Some(mannequin) => of_person_seen(clip, clock, instants, mannequin, screen, own),
            None => of_points(clip, build, clock, instants, (screen, height), own),
        };
        postures.start_at_0();
        postures.watch(clip, build, clock, (own, screen.is_world()));
        postures
    }

    /// Adds columns for acting parts.
    fn watch(&mut self, clip: &Clip, build: &Build, clock: Clock, own: (&[f64], bool)) {
        let acting = Acting::new(clip, build, clock, own, &self.speeds(clock.koma_rate));
        if acting.len() > 0 {
            let columns = self.columns + acting::COLUMNS * acting.len();
            let mut rows = vec![0.0; self.len() * columns];
            let places = self.rows.chunks_exact(self.columns);
            rows.chunks_exact_mut(columns).zip(places).for_each(|(row, places)| {
                row[..places.len()].copy_from_slice(places);
            });
            acting.write(&mut rows, columns);
            (self.columns, self.rows) = (columns, rows);
        }
        self.acting = acting;
    }

    /// Returns the parts that act while the whole body is quiet.
    pub(super) fn acting(&self) -> &Acting {
        &self.acting
    }

    /// Subtracts the first row from every row. A body far from the origin would have large numbers, and rounding in
    /// their last digits would count as movement.
    fn start_at_0(&mut self) {
        let first = self.rows.get(..self.columns).map(<[f64]>::to_vec).unwrap_or_default();
        for row in self.rows.chunks_exact_mut(self.columns.max(1)) {
            row.iter_mut().zip(&first).for_each(|(value, first)| *value -= first);
        }
    }

    /// Number of instants.
    pub(super) fn len(&self) -> usize {
        self.rows.len() / self.columns.max(1)
    }

    /// Returns how fast the posture changes into each instant from the second on, in % of body height a second. It is
    /// measured over a whole koma, because trembling within a koma is no movement.
    pub(super) fn speeds(&self, instants_a_second: f64) -> Vec<f64> {
        let speed = |at: usize| {
            let before = at.saturating_sub(2);
            instants_a_second * apart(self.row(before), self.row(at)) / (at - before) as f64
        };
        (1..self.len()).map(speed).collect()
    }

    /// Returns how far acting parts turn from one instant to another, in % of body height; 0 if the acting is slight: a
    /// rest.
    pub(super) fn acted(&self, a: usize, b: usize) -> f64 {
        if self.acting.len() == 0 || self.acting.is_slight() {
            return 0.0;
        }
        let acts = self.columns - acting::COLUMNS * self.acting.len();
        apart(&self.row(a)[acts..], &self.row(b)[acts..])
    }

    /// Returns the body at an instant.
    pub(super) fn row(&self, instant: usize) -> &[f64] {
        &self.rows[instant * self.columns..(instant + 1) * self.columns]
    }
}

/// Returns the distance of two postures, in % of body height.
pub(super) fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt()
}

/// Columns of a posture in the world: points, pelvis and heading.
const COLUMNS: usize = 3 * POINTS + 3 + 1;

fn of_person(
    clip: &Clip,
    clock: Clock,
    instants: usize,
    mannequin: &Mannequin,
    up: Axis,
    own: &[f64],
) -> Postures {
    let scales = scales(mannequin, own);
    let mut rows = vec![0.0; instants * COLUMNS];
    let mut across = Vec::with_capacity(instants);
    each_pose(clip, clock, instants, |instant, pose, lane| {
        let stand = mannequin.stand(|point| place(pose, lane, point));
        across.push(stand.across.map(|way| upright(way, up)));
        write(&stand, &scales, up, &mut rows[instant * COLUMNS..(instant + 1) * COLUMNS]);
    });
    let headings = heading::headings(&across);
    for (row, heading) in rows.chunks_exact_mut(COLUMNS).zip(headings) {
        let (sin, cos) = maths::sin_cos(heading);
        for point in row[..3 * POINTS].chunks_exact_mut(3) {
            (point[0], point[2]) =
                (cos * point[0] + sin * point[2], cos * point[2] - sin * point[0]);
        }
        row[COLUMNS - 1] = 100.0 * GIRTH * heading;
    }
    Postures { columns: COLUMNS, rows, acting: Acting::default() }
}

/// Columns of a posture on a screen: points and pelvis. A turn of the body counts by what is seen of it.
const COLUMNS_SEEN: usize = 3 * (POINTS + 1);

fn of_person_seen(
    clip: &Clip,
    clock: Clock,
    instants: usize,
    mannequin: &Mannequin,
    screen: &Screen,
    own: &[f64],
) -> Postures {
    let (scales, height) = (scales(mannequin, own), mannequin.height());
    let mut rows = vec![0.0; instants * COLUMNS_SEEN];
    let see = |place: DVec3| screen.see(height * place) / height;
    each_pose(clip, clock, instants, |instant, pose, lane| {
        let stand = mannequin.stand(|point| place(pose, lane, point));
        let pelvis = see(stand.pelvis);
        let ways = stand.points.iter().zip(scales);
        let ways = ways.map(|(point, scale)| scale * (see(stand.pelvis + *point) - pelvis));
        let row = rows[instant * COLUMNS_SEEN..].chunks_exact_mut(3);
        for (column, way) in row.zip(ways.chain([100.0 * pelvis])) {
            column.copy_from_slice(&way.to_array());
        }
    });
    Postures { columns: COLUMNS_SEEN, rows, acting: Acting::default() }
}

/// Returns the position of a point of the rig in one of several poses.
fn place(pose: &LanePose, lane: usize, point: Point) -> DVec3 {
    let joint = point.joint.0;
    pose.translations[joint].lane(lane) + pose.rotations[joint].lane(lane) * point.offset
}

/// Returns the scale of each point: its part of one body height, in %.
fn scales(mannequin: &Mannequin, own: &[f64]) -> [f64; POINTS] {
    let joints = mannequin.joints();
    let weights: [f64; POINTS] = array::from_fn(|point| BONES[point] * own[joints[point]]);
    // If no joint of the mannequin has a weight, every joint counts.
    let weights = if weights.iter().any(|weight| *weight > 0.0) { weights } else { BONES };
    let all: f64 = weights.iter().sum();
    weights.map(|weight| 100.0 * (weight / all).sqrt())
}

fn write(stand: &Stand, scales: &[f64; POINTS], up: Axis, row: &mut [f64]) {
    let (points, rest) = row.split_at_mut(3 * POINTS);
    for ((column, point), scale) in points.chunks_exact_mut(3).zip(stand.points).zip(scales) {
        column.copy_from_slice(&(*scale * upright(point, up)).to_array());
    }
    rest[..3].copy_from_slice(&(100.0 * upright(stand.pelvis, up)).to_array());
}

/// Converts a direction to axes with Y up.
fn upright(way: DVec3, up: Axis) -> DVec3 {
    if up == Axis::Z { DVec3::new(way.x, way.z, -way.y) } else { way }
}

fn of_points(
    clip: &Clip,
    build: &Build,
    clock: Clock,
    instants: usize,
    (screen, height): (&Screen, f64),
    own: &[f64],
) -> Postures {
    let points = Points::new(clip.skeleton(), build, own);
    let columns = 3 * points.len();
    let mut rows = vec![0.0; instants * columns];
    let scale = if height > 0.0 { 100.0 / height } else { 0.0 };
    let mut positions = vec![LaneVec::default(); points.len()];
    each_pose(clip, clock, instants, |instant, pose, lane| {
        if lane == 0 {
            points.place(pose, &mut positions);
        }
        let row = rows[instant * columns..(instant + 1) * columns].chunks_exact_mut(3);
        for ((column, position), weight) in row.zip(&positions).zip(points.weights()) {
            let way = scale * weight.sqrt() * screen.see(position.lane(lane));
            column.copy_from_slice(&way.to_array());
        }
    });
    Postures { columns, rows, acting: Acting::default() }
}

/// Poses the body at every koma of a clock, and passes on the instant, the poses of its block, and its lane.
fn each_pose(
    clip: &Clip,
    clock: Clock,
    instants: usize,
    mut each: impl FnMut(usize, &LanePose, usize),
) {
    let mut poser = LanePoser::new(clip);
    for block in 0..instants.div_ceil(LANES) {
        wide(
            #[inline(always)]
            || {
                poser.koma(clock, block, instants);
                poser.stand();
            },
        );
        for (lane, instant) in (LANES * block..instants).take(LANES).enumerate() {
            each(instant, poser.pose(), lane);
        }
    }
}

#[cfg(test)]
mod tests;
