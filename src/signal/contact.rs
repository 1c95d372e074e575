//! Contacts (接地): when a foot stands on the ground, and when a hand stays where it is.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::motion::Clip;
use crate::motion::landmarks::{self, Landmarks, Point};
use crate::time::Clock;

/// What touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limb {
    /// A foot on the ground.
    Foot,
    /// A hand on something, wherever that is.
    Hand,
}

/// A stretch in which a foot or a hand stays where it is in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// What touches.
    pub limb: Limb,
    /// The point that stays: the sole of a foot, the wrist of a hand.
    pub point: Point,
    /// Its first and its last koma.
    pub koma: RangeInclusive<usize>,
}

/// Finds contacts in world positions koma by koma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFinder {
    /// How fast a foot may be and still stand, in % of body height a second. Default 15. Raised, slow
    /// swings of a foot near the ground count as standing.
    pub foot_speed: f64,
    /// How high a foot may stand above its own ground (the level below which it is in one of twenty
    /// koma), in % of body height. Default 4. Raised, a foot that is held still in the air stands too.
    pub foot_lift: f64,
    /// How long a foot must stand, in seconds. Default 0.125, three koma.
    pub foot_least: f64,
    /// How fast a hand may be and still stay, in % of body height a second. Default 8.
    pub hand_speed: f64,
    /// How long a hand must stay, in seconds. Default 0.25.
    pub hand_least: f64,
    /// How fast a hand must have been in the half second before, in % of body height a second: a hand
    /// that hangs still touches nothing. Default 40.
    pub hand_before: f64,
}

impl Default for ContactFinder {
    fn default() -> Self {
        Self {
            foot_speed: 15.0,
            foot_lift: 4.0,
            foot_least: 0.125,
            hand_speed: 8.0,
            hand_least: 0.25,
            hand_before: 40.0,
        }
    }
}

/// Seconds before a hand's contact in which it must have moved.
const BEFORE: f64 = 0.5;

/// The share of koma in which a foot is below its ground.
const LOW: f64 = 0.05;

impl ContactFinder {
    /// The contacts of both feet, then of both hands, each by koma.
    pub fn find(&self, clip: &Clip, clock: Clock) -> Vec<Contact> {
        let found = Landmarks::of(clip);
        if found.height <= 0.0 {
            return Vec::new();
        }
        let soles: Vec<Point> = found.feet.iter().map(|foot| foot.sole).collect();
        let points = [&soles[..], &found.wrists].concat();
        let paths = landmarks::paths(clip, clock, &points);
        let mut contacts = Vec::new();
        for (at, (point, path)) in points.iter().zip(&paths).enumerate() {
            let path: Vec<DVec3> =
                path.iter().map(|position| *position * (100.0 / found.height)).collect();
            let limb = if at < soles.len() { Limb::Foot } else { Limb::Hand };
            let stretches = match limb {
                Limb::Foot => self.standing(&path, found.up.unit(), clock.koma_rate),
                Limb::Hand => self.staying(&path, clock.koma_rate),
            };
            contacts.extend(stretches.into_iter().map(|koma| Contact {
                limb,
                point: *point,
                koma,
            }));
        }
        contacts
    }

    /// The stretches in which a sole stands; the path in % of body height.
    fn standing(&self, path: &[DVec3], up: DVec3, koma_rate: f64) -> Vec<RangeInclusive<usize>> {
        let levels: Vec<f64> = path.iter().map(|position| position.dot(up)).collect();
        let mut sorted = levels.clone();
        sorted.sort_by(f64::total_cmp);
        let ground = sorted.get((LOW * sorted.len() as f64) as usize).copied().unwrap_or(0.0);
        let is_low = |koma: &RangeInclusive<usize>| {
            let levels = &levels[koma.clone()];
            levels.iter().sum::<f64>() / levels.len() as f64 <= ground + self.foot_lift
        };
        let mut still = still(path, self.foot_speed / koma_rate, self.foot_least * koma_rate);
        still.retain(is_low);
        still
    }

    /// The stretches in which a wrist stays after it moved.
    fn staying(&self, path: &[DVec3], koma_rate: f64) -> Vec<RangeInclusive<usize>> {
        let before = (BEFORE * koma_rate).round() as usize;
        let moved = |koma: &RangeInclusive<usize>| {
            let begin = *koma.start();
            let steps = path[begin.saturating_sub(before)..=begin].windows(2);
            let fastest = steps.map(|step| step[0].distance(step[1])).fold(0.0, f64::max);
            fastest >= self.hand_before / koma_rate
        };
        let mut still = still(path, self.hand_speed / koma_rate, self.hand_least * koma_rate);
        still.retain(moved);
        still
    }
}

/// The stretches of a path in which no step is longer than `step`, of `least` koma or more.
fn still(path: &[DVec3], step: f64, least: f64) -> Vec<RangeInclusive<usize>> {
    let is_still = |koma: usize| path[koma].distance(path[koma + 1]) <= step;
    let steps: Vec<bool> = (0..path.len().saturating_sub(1)).map(is_still).collect();
    let mut stretches = Vec::new();
    let mut begin = 0;
    for run in steps.chunk_by(|a, b| a == b) {
        // So many steps join one koma more.
        let end = begin + run.len();
        if run[0] && (run.len() + 1) as f64 >= least - 1e-9 {
            stretches.push(begin..=end);
        }
        begin = end;
    }
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path along X by steps, at a height.
    fn path(steps: &[(usize, f64)], level: impl Fn(usize) -> f64) -> Vec<DVec3> {
        let mut x = 0.0;
        let mut path = vec![DVec3::new(0.0, level(0), 0.0)];
        for (count, step) in steps {
            for _ in 0..*count {
                x += step;
                path.push(DVec3::new(x, level(path.len()), 0.0));
            }
        }
        path
    }

    #[test]
    fn a_sole_stands_where_it_hardly_moves_near_its_ground() {
        let finder = ContactFinder::default();
        let steps = [(10, 0.1), (8, 5.0), (12, 0.1), (8, 5.0), (6, 0.1)];
        let standing =
            |level: &dyn Fn(usize) -> f64| finder.standing(&path(&steps, level), DVec3::Y, 24.0);
        assert_eq!(standing(&|_| 3.0), [0..=10, 18..=30, 38..=44]);
        // The second time it is held in the air.
        let lifted = |koma| if (15..35).contains(&koma) { 9.0 } else { 3.0 };
        assert_eq!(standing(&lifted), [0..=10, 38..=44]);
    }

    #[test]
    fn a_foot_that_only_turns_back_does_not_stand() {
        let finder = ContactFinder::default();
        let turn = path(&[(10, 2.0), (1, 0.1), (10, -2.0)], |_| 0.0);
        assert!(finder.standing(&turn, DVec3::Y, 24.0).is_empty(), "two koma are too few");
        let stand = path(&[(10, 2.0), (2, 0.1), (10, -2.0)], |_| 0.0);
        assert_eq!(finder.standing(&stand, DVec3::Y, 24.0), [10..=12]);
    }

    #[test]
    fn a_hand_touches_only_after_it_moved() {
        let finder = ContactFinder::default();
        let reach = path(&[(20, 0.05), (6, 4.0), (10, 0.05), (6, 4.0), (3, 0.05)], |_| 0.0);
        assert_eq!(finder.staying(&reach, 24.0), [26..=36], "not before, and not for three koma");
    }

    #[test]
    fn without_a_path_there_is_no_contact() {
        let finder = ContactFinder::default();
        assert!(finder.standing(&[], DVec3::Y, 24.0).is_empty());
        assert!(finder.staying(&[DVec3::ZERO], 24.0).is_empty());
    }
}
