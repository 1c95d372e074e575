//! Gaits (歩き・走り): similar steps of alternating feet, and the phases of each step.

mod chains;
mod legs;

use std::array;
use std::mem;

use crate::motion::body::gait::legs::{Legs, Paths, RATE};
use crate::motion::{Build, Clip, Point, landmarks};
use crate::time::Clock;

/// A stretch of four or more steps of alternating feet, each about as long as the others of its foot. The body may
/// travel, use a treadmill or march on the spot.
///
/// Four steps are two of each foot. Fewer would show no cycle: a single step of a foot has no counterpart.
#[derive(Debug, Clone, PartialEq)]
pub struct Gait {
    /// Steps of the gait, each from one contact to the next.
    pub steps: Vec<Step>,
}

/// A step, from one foot's contact to that of the other. Instants are in fractional koma from the clip's first.
///
/// If the clip cuts off a part of its first or last step, the missing instants are extrapolated from other steps of
/// that foot. They lie before 0 or behind the last koma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Foot that comes down and stands: 0 is left, 1 is right. If the joints' names tell no sides, 0 is the first in
    /// the file.
    pub foot: usize,
    /// Contact (接地): this foot comes down. Its ankle or its sole is within 0.75 %H of its ground level.
    pub contact: f64,
    /// Down (沈み): the pelvis is lowest between contact and passing. Like *up*, it is measured from a line that rises
    /// with the gait, so that stairs do not move it.
    pub down: f64,
    /// Passing (すれ違い): the other foot passes this one, and the ankles are nearest. In a stride the ankles cross
    /// there: their squared horizontal distance minus a quarter of their squared vertical one is least. On the spot the
    /// passing foot is highest there.
    pub passing: f64,
    /// Up (伸び): the pelvis is highest between passing and the next contact. A walk may reach its top at the passing
    /// or even before; then this equals the passing.
    pub up: f64,
    /// Contact of the other foot.
    pub next: f64,
}

impl Gait {
    /// Finds the gaits of a clip in order of time; empty for a body without head, two arms and two legs.
    pub fn find(clip: &Clip, clock: Clock) -> Vec<Self> {
        Self::find_all(clip, &Build::new(clip), clock)
    }

    /// Finds the gaits of a clip whose build is known.
    pub fn find_all(clip: &Clip, build: &Build, clock: Clock) -> Vec<Self> {
        let Some(paths) = paths(clip, build, clock) else { return Vec::new() };
        let legs = Legs::new(&paths, build.landmarks.up.unit());
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

/// Computes the paths of hips, ankles and soles of both legs, the left one first.
fn paths(clip: &Clip, build: &Build, clock: Clock) -> Option<Paths> {
    let (mannequin, feet) = (build.mannequin.as_ref()?, &build.landmarks.feet);
    let legs = mannequin.legs();
    let [_, _, left, _] = mannequin.limb_tops(clip.skeleton());
    let order = if legs[0][0] == left { [0, 1] } else { [1, 0] };
    let points = order.map(|leg| {
        let foot = feet.get(leg)?;
        Some([Point::new(legs[leg][0]), foot.ankle, foot.sole])
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
