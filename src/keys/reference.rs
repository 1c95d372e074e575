//! The source motion at every koma, against which a motion made again from keys is judged.

use std::ops::Range;

use glam::DVec3;

use crate::keys::points::Points;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::clip::lane_poser::LanePoser;
use crate::motion::lanes::{LANES, LaneVec, Lanes, pieces, wide};
use crate::motion::{Build, Clip, Screen};
use crate::time::{Clock, Frame};

/// How many times further than the body's mean a single point moves to be as visible.
const FURTHEST: f64 = 2.5;

/// The source at each koma, computed once: a reconstruction is measured against it.
///
/// The error of a reconstruction is measured in the world. The speed of the body, and the loss between two of its
/// postures, are measured as seen [on a screen](Reference::on).
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    clock: Clock,
    koma: usize,
    points: Points,
    /// Blocks of [`LANES`] koma × points. The last koma is repeated to fill its block.
    positions: Vec<LaneVec>,
    /// Height of the body in the file's unit: see [`Reference::new`].
    height: f64,
    screen: Screen,
}

impl Reference {
    /// Samples the clip at every koma of the clock.
    ///
    /// The body's height is that of a person with legs of this length, from hip to ankle. For a body without limbs it
    /// is the median over the koma of the longest side of the box around all its points. Rest poses would depend on the
    /// rig, with arms out, arms down, or all bones along one axis.
    pub fn new(clip: &Clip, clock: Clock) -> Self {
        Self::weighted(clip, clock, &vec![1.0; clip.skeleton().len()])
    }

    /// Samples the clip with `own`, a weight for each joint on top of its bones: 0 or more, one of them above. The
    /// weights do not change the height.
    pub fn weighted(clip: &Clip, clock: Clock, own: &[f64]) -> Self {
        Self::of_build(clip, &Build::new(clip), clock, own)
    }

    /// Samples a clip whose build is known.
    pub(crate) fn of_build(clip: &Clip, build: &Build, clock: Clock, own: &[f64]) -> Self {
        let points = Points::new(clip.skeleton(), build, own);
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let mut positions = vec![LaneVec::default(); koma.div_ceil(LANES) * points.len()];
        let mut poser = LanePoser::new(clip);
        let mut sides = Vec::with_capacity(koma + LANES);
        let mut rows = positions.chunks_exact_mut(points.len().max(1));
        for piece in pieces(rows.len()) {
            wide(
                #[inline(always)]
                || {
                    for (block, row) in piece.zip(&mut rows) {
                        poser.koma(clock, block, koma);
                        points.place(poser.stand(), row);
                        sides.extend(longest_sides(points.own(row)).0);
                    }
                },
            );
        }
        sides.truncate(koma);
        sides.sort_by(f64::total_cmp);
        let median = sides.get(sides.len() / 2).copied().unwrap_or(0.0);
        // A body of one point has no height; the box of its whole path stands in.
        let seen = || if median > 0.0 { median } else { whole_side(&positions, &points) };
        let height = build.mannequin.as_ref().map_or_else(seen, Mannequin::height);
        Self { clock, koma, points, positions, height, screen: Screen::WORLD }
    }

    /// Takes the height of the whole body, in the file's unit: a part in which little moves has none of its own.
    pub(crate) fn beside(self, height: f64) -> Self {
        Self { height, ..self }
    }

    /// Sets the screen on which it is seen.
    pub fn on(self, screen: Screen) -> Self {
        Self { screen, ..self }
    }

    /// Returns the screen on which it is seen.
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// Returns the times of its koma.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// Number of koma.
    pub fn koma(&self) -> usize {
        self.koma
    }

    /// Returns its duration in seconds.
    pub(super) fn seconds(&self) -> f64 {
        self.koma as f64 / self.clock.koma_rate
    }

    /// Returns the points whose positions it has.
    pub(super) fn points(&self) -> &Points {
        &self.points
    }

    /// Returns the position of every point at the [`LANES`] koma of a block.
    pub(super) fn positions(&self, block: usize) -> &[LaneVec] {
        let points = self.points.len();
        &self.positions[block * points..(block + 1) * points]
    }

    /// Returns the body's height in the file's unit: see [`Reference::new`].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// Returns how far the poses of two koma are apart: root mean square over the body's points, in % of body height.
    ///
    /// # Panics
    /// When there is no such koma.
    pub fn apart(&self, a: usize, b: usize) -> f64 {
        self.way(self.still(a), self.still(b))
    }

    /// Returns how unlike the poses of two koma look: the larger of how far they are [apart](Self::apart) and 0.4 of
    /// the distance of the point that moves furthest. The mean alone hardly shows that one arm is raised.
    ///
    /// # Panics
    /// When there is no such koma.
    pub fn unlike(&self, a: usize, b: usize) -> f64 {
        let ways = || self.still(a).zip(self.still(b)).map(|(a, b)| a.distance_squared(b));
        if self.height <= 0.0 {
            return 0.0;
        }
        let furthest = self.points.furthest(ways());
        self.percent(self.points.mean(ways())).max(self.percent(furthest) / FURTHEST)
    }

    /// Returns how far positions of all points are from the source at a koma: root mean square in % of body height.
    pub(super) fn off(&self, koma: usize, positions: &[DVec3]) -> f64 {
        self.way(self.still(koma), positions.iter().copied())
    }

    /// Returns how far two poses are apart: root mean square over the points, in % of body height.
    pub(super) fn way(
        &self,
        from: impl Iterator<Item = DVec3>,
        to: impl Iterator<Item = DVec3>,
    ) -> f64 {
        let squares = from.zip(to).map(|(from, to)| from.distance_squared(to));
        if self.height > 0.0 { self.percent(self.points.mean(squares)) } else { 0.0 }
    }

    /// Returns the position of every point at a koma.
    pub(super) fn still(&self, koma: usize) -> impl Iterator<Item = DVec3> {
        self.positions(koma / LANES).iter().map(move |position| position.lane(koma % LANES))
    }

    /// Converts a mean squared distance of points to its root in % of body height.
    #[inline(always)]
    pub(super) fn percent(&self, squared: f64) -> f64 {
        100.0 * squared.sqrt() / self.height
    }

    /// Returns how fast the body goes into each koma from the second on, as seen on the screen, in % of body height a
    /// second: root mean square over its points.
    pub(crate) fn speeds(&self) -> Vec<f64> {
        if self.koma == 0 || self.points.len() == 0 || self.height <= 0.0 {
            return Vec::new();
        }
        let percent = 100.0 * self.clock.koma_rate / self.height;
        let seen = |block: &[LaneVec]| -> Vec<LaneVec> {
            block.iter().map(|places| places.map(|place| self.screen.see(place))).collect()
        };
        let mut before = seen(self.positions(0));
        let mut speeds = Vec::with_capacity(self.koma + LANES);
        for now in self.positions.chunks_exact(self.points.len()).map(seen) {
            // One koma back: the last of the block before, then all but the last of this one.
            for (before, now) in before.iter_mut().zip(&now) {
                *before = now.shifted(before.lane(LANES - 1));
            }
            speeds.extend(self.points.apart(&before, &now).0.map(|apart| percent * apart.sqrt()));
            before = now;
        }
        speeds.truncate(self.koma);
        // There is no step into the first koma.
        speeds.drain(..1.min(self.koma));
        speeds
    }

    /// Returns the koma whose place lies strictly between two frames.
    pub(super) fn koma_between(&self, from: Frame, to: Frame) -> Range<usize> {
        let per_frame = self.clock.koma_rate / self.clock.frame_rate.fps();
        let koma = |frame: Frame| (frame.0 - self.clock.first.0) as f64 * per_frame;
        let begin = (koma(from) + 1e-9).floor() as usize + 1;
        let end = ((koma(to) - 1e-9).ceil().max(0.0) as usize).min(self.koma);
        begin.min(end)..end
    }
}

/// Returns the longest side of the box around some points, for each lane by itself.
#[inline(always)]
fn longest_sides(points: impl Iterator<Item = LaneVec>) -> Lanes {
    let (low, high) = corners(points);
    let sides = high - low;
    sides.x.max(sides.y).max(sides.z)
}

/// Returns the longest side of the box around the points of all lanes.
fn whole_side(positions: &[LaneVec], points: &Points) -> f64 {
    let rows = positions.chunks_exact(points.len().max(1));
    let (low, high) = corners(rows.flat_map(|row| points.own(row)));
    let lanes = 0..LANES;
    let low = lanes.clone().map(|lane| low.lane(lane)).reduce(DVec3::min).unwrap_or_default();
    let high = lanes.map(|lane| high.lane(lane)).reduce(DVec3::max).unwrap_or_default();
    (high - low).max_element()
}

#[inline(always)]
fn corners(mut points: impl Iterator<Item = LaneVec>) -> (LaneVec, LaneVec) {
    let Some(first) = points.next() else { return Default::default() };
    points.fold((first, first), |(low, high), point| {
        (low.with(point, Lanes::min), high.with(point, Lanes::max))
    })
}
