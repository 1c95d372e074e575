//! The source koma after koma: what the body made again from keys is judged against.

use std::ops::Range;

use glam::DVec3;

use crate::keys::points::Points;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::clip::lane_poser::LanePoser;
use crate::motion::lanes::{LANES, LaneVec, Lanes, pieces, wide};
use crate::motion::{Build, Clip, Screen};
use crate::time::{Clock, Frame};

/// So many times as far as the whole body in the mean a single point goes that is as plainly to be seen.
const FURTHEST: f64 = 2.5;

/// The source at each koma, computed once: what a reconstruction is measured against.
///
/// A reconstruction is off by what it is off in the world; how fast the body is, and what is lost between two
/// of its postures, is what is seen of it on [`Reference::on`] a screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Reference {
    clock: Clock,
    koma: usize,
    points: Points,
    /// Blocks of [`LANES`] koma × points; behind the last koma the last again.
    positions: Vec<LaneVec>,
    /// Height of the body in the file's unit: see [`Reference::of`].
    height: f64,
    screen: Screen,
}

impl Reference {
    /// Samples the clip at every koma of the clock.
    ///
    /// The body's height is that of a person with legs as long as these, from hip to ankle. Of a body without limbs it is
    /// the median over the koma of the longest side of the box round all its points: rest poses are a matter of the rig,
    /// with arms out, arms down, or all bones along one axis.
    pub fn of(clip: &Clip, clock: Clock) -> Self {
        Self::weighted(clip, clock, &vec![1.0; clip.skeleton().len()])
    }

    /// The same where joints do not all count as much as their bones say: `own` has a factor for each, 0 or
    /// more and one of them above. It does not change the height.
    pub fn weighted(clip: &Clip, clock: Clock, own: &[f64]) -> Self {
        Self::of_build(clip, &Build::of(clip), clock, own)
    }

    /// The same of a body that is known.
    pub(crate) fn of_build(clip: &Clip, build: &Build, clock: Clock, own: &[f64]) -> Self {
        let points = Points::of(clip.skeleton(), build, own);
        let koma = clip.rate().koma_from_frames(clip.len(), clock.koma_rate);
        let mut positions = vec![LaneVec::default(); koma.div_ceil(LANES) * points.len()];
        let mut poser = LanePoser::of(clip);
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
        // A body of one point has no height; what it moves through stands for it.
        let seen = || if median > 0.0 { median } else { whole_side(&positions, &points) };
        let height = build.mannequin.as_ref().map_or_else(seen, Mannequin::height);
        Self { clock, koma, points, positions, height, screen: Screen::WORLD }
    }

    /// The same beside a body of that height, in the file's unit: a part in which little moves has none of
    /// its own.
    pub(crate) fn beside(self, height: f64) -> Self {
        Self { height, ..self }
    }

    /// The same as it is seen on a screen.
    pub fn on(self, screen: Screen) -> Self {
        Self { screen, ..self }
    }

    /// From where it is seen.
    pub fn screen(&self) -> &Screen {
        &self.screen
    }

    /// Where its koma stand.
    pub fn clock(&self) -> Clock {
        self.clock
    }

    /// Number of koma.
    pub fn koma(&self) -> usize {
        self.koma
    }

    /// Seconds that its koma last.
    pub(super) fn seconds(&self) -> f64 {
        self.koma as f64 / self.clock.koma_rate
    }

    /// The points that positions are of.
    pub(super) fn points(&self) -> &Points {
        &self.points
    }

    /// Where every point stands at the [`LANES`] koma of a block.
    pub(super) fn positions(&self, block: usize) -> &[LaneVec] {
        let points = self.points.len();
        &self.positions[block * points..(block + 1) * points]
    }

    /// The body's height in the file's unit: see [`Reference::of`].
    pub fn height(&self) -> f64 {
        self.height
    }

    /// How far the poses of two koma are apart: root mean square over the body's points, in % of its
    /// height.
    ///
    /// # Panics
    /// When there is no such koma.
    pub fn apart(&self, a: usize, b: usize) -> f64 {
        self.way(self.still(a), self.still(b))
    }

    /// How unlike the poses of two koma look: the larger of how far they are [apart](Self::apart) and 0.4 of the way
    /// of the point of the body that goes furthest. Of one arm that is raised the mean alone says little.
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

    /// How far some positions of all points are from the source at a koma, in the same measure.
    pub(super) fn off(&self, koma: usize, positions: &[DVec3]) -> f64 {
        self.way(self.still(koma), positions.iter().copied())
    }

    /// How far two poses are apart, in the same measure.
    pub(super) fn way(
        &self,
        from: impl Iterator<Item = DVec3>,
        to: impl Iterator<Item = DVec3>,
    ) -> f64 {
        let squares = from.zip(to).map(|(from, to)| from.distance_squared(to));
        if self.height > 0.0 { self.percent(self.points.mean(squares)) } else { 0.0 }
    }

    /// Where every point stands at a koma.
    fn still(&self, koma: usize) -> impl Iterator<Item = DVec3> {
        self.positions(koma / LANES).iter().map(move |position| position.lane(koma % LANES))
    }

    /// A mean squared distance of points, as its root in % of the body's height.
    #[inline(always)]
    pub(super) fn percent(&self, squared: f64) -> f64 {
        100.0 * squared.sqrt() / self.height
    }

    /// How fast the body goes into each koma from the second on, as it is seen, in % of its height a second:
    /// root mean square over its points.
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

    /// The koma whose place lies strictly between two frames.
    pub(super) fn koma_between(&self, from: Frame, to: Frame) -> Range<usize> {
        let per_frame = self.clock.koma_rate / self.clock.frame_rate.fps();
        let koma = |frame: Frame| (frame.0 - self.clock.first.0) as f64 * per_frame;
        let begin = (koma(from) + 1e-9).floor() as usize + 1;
        let end = ((koma(to) - 1e-9).ceil().max(0.0) as usize).min(self.koma);
        begin.min(end)..end
    }
}

/// The longest side of the box round some points, of each lane by itself.
#[inline(always)]
fn longest_sides(points: impl Iterator<Item = LaneVec>) -> Lanes {
    let (low, high) = corners(points);
    let sides = high - low;
    sides.x.max(sides.y).max(sides.z)
}

/// The longest side of the box round the points of all lanes.
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
