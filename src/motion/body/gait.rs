//! Gaits (歩き・走り): steps of left and right by turns that are alike, and the phases of each.

mod chains;
mod legs;

use std::array;
use std::mem;

use crate::motion::body::gait::legs::{Legs, Paths, RATE};
use crate::motion::{Build, Clip, Point, landmarks};
use crate::time::Clock;

/// A stretch of four or more steps, left and right by turns, each about as long as the others of its foot. The body may
/// travel, go on a treadmill or march on the spot.
///
/// Four are two of each foot: fewer would show no cycle, as one step of a foot is like every other.
#[derive(Debug, Clone, PartialEq)]
pub struct Gait {
    /// Its steps, each from one contact to the next.
    pub steps: Vec<Step>,
}

/// A step: from where a foot comes down to where the other does. Instants are in koma from the clip's first, with a
/// fraction.
///
/// What the clip cuts off of its first or last step lies before 0 or behind the last koma, as long from what is seen as in
/// other steps of that foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The foot that comes down and stands: 0 is the left one, 1 the right one. In a body whose joints have no names of
    /// sides 0 is the first in the file.
    pub foot: usize,
    /// Contact (接地): this foot comes down. Its ankle or its sole is within 0.75 %H of its ground.
    pub contact: f64,
    /// Down (沈み): the pelvis is lowest from contact to passing.
    pub down: f64,
    /// Passing (すれ違い): the other foot passes this one. The ankles are nearest: the square of the way between them along
    /// the ground less a quarter of that of their rise is least. In a stride that is where they cross, on the spot where the
    /// foot is highest.
    pub passing: f64,
    /// Up (伸び): the pelvis is highest from passing to the next contact. A walk is as high as it gets when feet pass,
    /// or even before: then this is the passing.
    pub up: f64,
    /// The other foot comes down.
    pub next: f64,
}

impl Gait {
    /// The gaits of a clip, in their order; none of a body without head, two arms and two legs.
    pub fn find(clip: &Clip, clock: Clock) -> Vec<Self> {
        Self::of(clip, &Build::of(clip), clock)
    }

    /// The same of a body that is known.
    pub(crate) fn of(clip: &Clip, build: &Build, clock: Clock) -> Vec<Self> {
        let Some(paths) = paths(clip, build, clock) else { return Vec::new() };
        let legs = Legs::of(&paths, build.landmarks.up.unit());
        let mut gaits = chains::gaits(&legs);
        let koma = clock.koma_rate / RATE;
        gaits.iter_mut().flat_map(|gait| &mut gait.steps).for_each(|step| step.scale(koma));
        gaits
    }
}

impl Step {
    fn scale(&mut self, factor: f64) {
        let Self { foot: _, contact, down, passing, up, next } = self;
        [contact, down, passing, up, next].into_iter().for_each(|instant| *instant *= factor);
    }
}

/// Where hips, ankles and soles of both legs are, the left one first.
fn paths(clip: &Clip, build: &Build, clock: Clock) -> Option<Paths> {
    let (mannequin, feet) = (build.mannequin.as_ref()?, &build.landmarks.feet);
    let legs = mannequin.legs();
    let [_, _, left, _] = mannequin.limb_tops(clip.skeleton());
    let order = if legs[0][0] == left { [0, 1] } else { [1, 0] };
    let points = order.map(|leg| {
        let foot = feet.get(leg)?;
        Some([Point::of(legs[leg][0]), foot.ankle, foot.sole])
    });
    let [left, right] = points;
    let points = [left?, right?].concat();
    let clock = Clock { koma_rate: RATE, ..clock };
    let mut paths = landmarks::paths(clip, clock, &points);
    let percent = 100.0 / mannequin.height();
    paths.iter_mut().flatten().for_each(|place| *place *= percent);
    let mut of = |point: usize| array::from_fn(|leg| mem::take(&mut paths[3 * leg + point]));
    Some(Paths { hips: of(0), ankles: of(1), soles: of(2) })
}

#[cfg(test)]
mod tests;
