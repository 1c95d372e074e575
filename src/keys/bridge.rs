//! How far the body is off, koma after koma, when the poses of two frames are slerped.

mod stances;

use std::ops::Range;

use crate::keys::Reference;
use crate::motion::Clip;
use crate::motion::clip::rig::Rig;
use crate::motion::lanes::{Arc, LANES, LaneQuat, LaneVec, Lanes, wide};
use crate::time::Frame;
use stances::Stances;

/// The error of slerping between any two of some frames, with its buffers.
///
/// Frames are spoken of by their place in the list.
#[derive(Clone)]
pub(crate) struct Bridge<'a> {
    reference: &'a Reference,
    frames: &'a [Frame],
    rig: Rig,
    stances: Stances,
    /// The way of each joint, [`LANES`] joints together.
    arcs: Vec<Arc>,
    /// World rotations at the koma of a block.
    rotations: Vec<LaneQuat>,
    /// Where each joint stands against its parent there.
    translations: Vec<LaneVec>,
    /// Where each point stands in the world there.
    positions: Vec<LaneVec>,
}

/// The ends of a bridge and the koma between them.
struct Piers {
    from: usize,
    to: usize,
    koma: Range<usize>,
}

impl Piers {
    /// Blocks of the reference in which its koma lie.
    fn blocks(&self) -> Range<usize> {
        self.koma.start / LANES..self.koma.end.div_ceil(LANES)
    }
}

impl<'a> Bridge<'a> {
    pub(crate) fn new(clip: &Clip, reference: &'a Reference, frames: &'a [Frame]) -> Self {
        let rig = Rig::of(clip.skeleton());
        let stances = Stances::of(clip, &rig, frames);
        Self {
            reference,
            frames,
            arcs: vec![Arc::default(); stances.groups()],
            rotations: vec![LaneQuat::default(); rig.len()],
            translations: (0..rig.len()).map(|joint| LaneVec::splat(rig.offset(joint))).collect(),
            positions: vec![LaneVec::default(); reference.points().len()],
            stances,
            rig,
        }
    }

    /// The error at every koma that lies strictly between two frames, with its number: root mean square
    /// over the body's points, in % of body height.
    pub(crate) fn errors(&mut self, from: usize, to: usize, mut each: impl FnMut(usize, f64)) {
        let piers = self.piers(from, to);
        if piers.koma.is_empty() {
            return;
        }
        wide(
            #[inline(always)]
            || {
                self.aim(&piers);
                for block in piers.blocks() {
                    let apart = self.apart_in(block, &piers);
                    for (koma, apart) in (block * LANES..).zip(apart.0) {
                        if piers.koma.contains(&koma) {
                            each(koma, self.reference.percent(apart));
                        }
                    }
                }
            },
        );
    }

    fn piers(&self, from: usize, to: usize) -> Piers {
        let nothing = self.positions.is_empty() || self.reference.height() <= 0.0;
        let [begin, end] = [from, to].map(|at| self.frames[at]);
        let koma = if nothing { 0..0 } else { self.reference.koma_between(begin, end) };
        Piers { from, to, koma }
    }

    /// Finds the way of each joint from one end to the other.
    #[inline(always)]
    fn aim(&mut self, piers: &Piers) {
        let ends = self.stances.rotations(piers.from).iter();
        let ends = ends.zip(self.stances.rotations(piers.to));
        for (arc, (from, to)) in self.arcs.iter_mut().zip(ends) {
            *arc = Arc::between(*from, *to);
        }
    }

    /// The mean squared distance from the source at each koma of a block; of koma that lie outside the
    /// bridge that of the nearest inside.
    #[inline(always)]
    fn apart_in(&mut self, block: usize, piers: &Piers) -> Lanes {
        let koma = &piers.koma;
        let inside = |lane: usize| (block * LANES + lane).clamp(koma.start, koma.end - 1);
        let [begin, end] = [piers.from, piers.to].map(|at| self.frames[at].0 as f64);
        let clock = self.reference.clock();
        let place = Lanes::from_fn(|lane| clock.place_from_koma(inside(lane)));
        let shares = place.map(|place| (place - begin) / (end - begin));
        self.move_joints(piers, shares);
        self.turn_joints(piers.from, shares);
        let points = self.reference.points();
        points.place_tips(&self.rotations, &mut self.positions);
        points.apart(self.reference.positions(block), &self.positions)
    }

    /// Puts the joints that have a position of their own some shares of the way along.
    #[inline(always)]
    fn move_joints(&mut self, piers: &Piers, shares: Lanes) {
        let ends = self.stances.translations(piers.from).iter();
        let ends = ends.zip(self.stances.translations(piers.to));
        for (joint, (from, to)) in self.stances.moving().iter().zip(ends) {
            let (from, to) = (LaneVec::splat(*from), LaneVec::splat(*to));
            self.translations[*joint] = from.lerp(to, shares);
        }
    }

    /// Turns every joint some shares of the way along and places it in the world, both at once: what
    /// is local is never written down.
    #[inline(always)]
    fn turn_joints(&mut self, from: usize, shares: Lanes) {
        let starts = self.stances.rotations(from);
        let groups = self.arcs.iter().zip(starts).zip(self.translations.chunks(LANES));
        let mut joint = 0;
        for ((arc, start), translations) in groups {
            for (lane, translation) in translations.iter().enumerate() {
                let local = along(arc, start, lane, shares);
                (self.rotations[joint], self.positions[joint]) = match self.rig.parent(joint) {
                    None => (local, *translation),
                    Some(parent) => {
                        let carrier = self.rotations[parent];
                        let position = self.positions[parent] + carrier.rotate(*translation);
                        (carrier * local, position)
                    }
                };
                joint += 1;
            }
        }
    }
}

/// The rotation of one of a group's joints some shares of its way along.
#[inline(always)]
fn along(arc: &Arc, start: &LaneQuat, lane: usize, shares: Lanes) -> LaneQuat {
    let start = LaneQuat::splat(start.lane(lane));
    let degrees = arc.degrees.0[lane];
    if degrees == 0.0 {
        return start;
    }
    let Arc { middle, across, .. } = arc;
    let middle = LaneQuat::splat(middle.lane(lane));
    let across = LaneQuat::splat(across.lane(lane));
    Arc { middle, across, degrees: Lanes::splat(degrees) }.along(shares)
}
