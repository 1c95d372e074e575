//! Measures how far the body is off, koma by koma, if the poses of two frames are slerped.

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
/// Frames are given by their place in the list.
#[derive(Clone)]
pub struct Bridge<'a> {
    reference: &'a Reference,
    frames: &'a [Frame],
    rig: Rig,
    stances: Stances,
    /// Slerp of each joint, [`LANES`] joints together.
    arcs: Vec<Arc>,
    /// World rotations at the koma of a block.
    rotations: Vec<LaneQuat>,
    /// Position of each joint against its parent at the koma of a block.
    translations: Vec<LaneVec>,
    /// Position of each point in the world at the koma of a block.
    positions: Vec<LaneVec>,
}

/// The ends of a bridge and the koma between them.
struct Piers {
    from: usize,
    to: usize,
    koma: Range<usize>,
}

impl Piers {
    /// Returns the blocks of the reference that its koma are in.
    fn blocks(&self) -> Range<usize> {
        self.koma.start / LANES..self.koma.end.div_ceil(LANES)
    }
}

impl<'a> Bridge<'a> {
    /// Creates a bridge for slerps between some frames of a clip.
    pub fn new(clip: &Clip, reference: &'a Reference, frames: &'a [Frame]) -> Self {
        let rig = Rig::new(clip.skeleton());
        let stances = Stances::new(clip, &rig, frames);
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

    /// Passes on the number and the error of every koma that lies strictly between two frames: root mean square over
    /// the body's points, in % of body height.
    pub fn errors(&mut self, from: usize, to: usize, mut each: impl FnMut(usize, f64)) {
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

    /// Computes the slerp of each joint from one end to the other.
    #[inline(always)]
    fn aim(&mut self, piers: &Piers) {
        let ends = self.stances.rotations(piers.from).iter();
        let ends = ends.zip(self.stances.rotations(piers.to));
        for (arc, (from, to)) in self.arcs.iter_mut().zip(ends) {
            *arc = Arc::between(*from, *to);
        }
    }

    /// Returns the mean squared distance from the source at each koma of a block. Koma outside the bridge get that of
    /// the nearest inside.
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

    /// Moves the joints that have a position of their own by some shares of the way.
    #[inline(always)]
    fn move_joints(&mut self, piers: &Piers, shares: Lanes) {
        let ends = self.stances.translations(piers.from).iter();
        let ends = ends.zip(self.stances.translations(piers.to));
        for (joint, (from, to)) in self.stances.moving().iter().zip(ends) {
            let (from, to) = (LaneVec::splat(*from), LaneVec::splat(*to));
            self.translations[*joint] = from.lerp(to, shares);
        }
    }

    /// Turns every joint by some shares of its way and places it in the world at once, without storing local rotations.
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

/// Returns the rotation of one of a group's joints after some shares of its way.
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
