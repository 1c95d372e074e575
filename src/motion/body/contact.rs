//! Contacts (接地): stretches in which a foot stands on the ground or a hand stays in place.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::motion::Clip;
use crate::motion::landmarks::{self, Landmarks, Point};
use crate::time::Clock;

/// The kind of limb that touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limb {
    /// A foot on the ground.
    Foot,
    /// A hand on something, at any height.
    Hand,
}

/// A stretch in which a foot or a hand stays in place in the world.
#[derive(Debug, Clone, PartialEq)]
pub struct Contact {
    /// Kind of limb.
    pub limb: Limb,
    /// Point that stays: the sole of a foot, the wrist of a hand.
    pub point: Point,
    /// First and last koma.
    pub koma: RangeInclusive<usize>,
}

/// Finds contacts from world positions, koma by koma.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFinder {
    /// Largest speed of a standing foot, in % of body height per second. Default 12. If raised, slow swings near the
    /// ground also count as standing.
    pub foot_speed: f64,
    /// Largest height of a standing foot, in % of body height: above its own ground level (5th percentile of its
    /// height) or, on stairs, above the other foot on some koma of the stretch. Default 3. If raised, a foot held
    /// still in the air also counts as standing.
    pub foot_lift: f64,
    /// Shortest contact of a foot, in seconds. Default 0.125, three koma.
    pub foot_least: f64,
    /// Largest speed of a staying hand, in % of body height per second. Default 6.5.
    pub hand_speed: f64,
    /// Shortest contact of a hand, in seconds. Default 0.25.
    pub hand_least: f64,
    /// Least top speed of a hand in the half second before a contact, in % of body height per second. Default 32. It
    /// excludes hands that just hang still.
    pub hand_before: f64,
}

impl Default for ContactFinder {
    fn default() -> Self {
        Self {
            foot_speed: 12.0,
            foot_lift: 3.0,
            foot_least: 0.125,
            hand_speed: 6.5,
            hand_least: 0.25,
            hand_before: 32.0,
        }
    }
}

/// Seconds before a hand's contact in which the hand must have moved.
const BEFORE: f64 = 0.5;

/// Share of koma in which a foot is below its ground level.
const LOW: f64 = 0.05;

/// Window in seconds for detecting slow drift, and the largest drift of a contact within it, in % of body height.
const SLOW: f64 = 0.5;
const SLOW_WAY: f64 = 2.5;

/// Largest number of too fast steps within one contact: a single bad koma causes two.
const TORN: usize = 2;

/// Largest displacement over such a gap, in units of the largest step of a still point.
const TORN_WAY: f64 = 2.0;

impl ContactFinder {
    /// Finds the contacts of both feet, then of both hands, each in order of time.
    pub fn find(&self, clip: &Clip, clock: Clock) -> Vec<Contact> {
        let found = Landmarks::new(clip);
        if found.height <= 0.0 {
            return Vec::new();
        }
        let soles: Vec<Point> = found.feet.iter().map(|foot| foot.sole).collect();
        let points = [&soles[..], &found.wrists].concat();
        let mut paths = landmarks::paths(clip, clock, &points);
        let percent = 100.0 / found.height;
        paths.iter_mut().flatten().for_each(|position| *position *= percent);
        let (feet, hands) = paths.split_at(soles.len());
        let standing = self.standing(feet, found.up.unit(), clock.koma_rate);
        let staying = hands.iter().map(|path| self.staying(path, clock.koma_rate));
        let limb = |at: usize| if at < soles.len() { Limb::Foot } else { Limb::Hand };
        let stretches = standing.into_iter().chain(staying).enumerate();
        let contacts = stretches.flat_map(|(at, stretches)| {
            let point = points[at];
            stretches.into_iter().map(move |koma| Contact { limb: limb(at), point, koma })
        });
        contacts.collect()
    }

    /// Finds the stretches in which each sole stands; paths are in % of body height.
    ///
    /// A still foot stands if it is near its own ground level. On stairs a foot stands if it carries the body: the
    /// other foot is no lower on some koma of the stretch. While a foot is held in the air, the other is always below
    /// it.
    fn standing(
        &self,
        soles: &[Vec<DVec3>],
        up: DVec3,
        koma_rate: f64,
    ) -> Vec<Vec<RangeInclusive<usize>>> {
        let level = |path: &Vec<DVec3>| path.iter().map(|place| place.dot(up)).collect();
        let levels: Vec<Vec<f64>> = soles.iter().map(level).collect();
        let stand = |(foot, path): (usize, &Vec<DVec3>)| {
            let ground = ground(&levels[foot]);
            let is_low = |koma: &RangeInclusive<usize>| {
                mean(&levels[foot][koma.clone()]) <= ground + self.foot_lift
            };
            let mut still = still(path, self.foot_speed, self.foot_least, koma_rate);
            still.retain(|koma| is_low(koma) || self.carries(&levels, foot, koma));
            still
        };
        soles.iter().enumerate().map(stand).collect()
    }

    /// Whether no other foot is below this one on some koma of a stretch.
    fn carries(&self, levels: &[Vec<f64>], foot: usize, koma: &RangeInclusive<usize>) -> bool {
        let others = || levels.iter().enumerate().filter(|(other, _)| *other != foot);
        koma.clone().any(|koma| {
            let own = levels[foot][koma] - self.foot_lift;
            others().all(|(_, other)| other[koma] >= own)
        })
    }

    /// Finds the stretches in which a wrist stays after having moved.
    fn staying(&self, path: &[DVec3], koma_rate: f64) -> Vec<RangeInclusive<usize>> {
        let before = (BEFORE * koma_rate).round() as usize;
        let moved = |koma: &RangeInclusive<usize>| {
            let begin = *koma.start();
            let steps = path[begin.saturating_sub(before)..=begin].windows(2);
            let fastest = steps.map(|step| step[0].distance(step[1])).fold(0.0, f64::max);
            fastest >= self.hand_before / koma_rate
        };
        let mut still = still(path, self.hand_speed, self.hand_least, koma_rate);
        still.retain(moved);
        still
    }
}

/// Returns the ground level of a foot, the 5th percentile of its height.
fn ground(levels: &[f64]) -> f64 {
    let mut sorted = levels.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get((LOW * sorted.len() as f64) as usize).copied().unwrap_or(0.0)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Finds the stretches of a path, at least `least` seconds long, in which no step is faster than `speed`. Two
/// stretches separated by a single bad koma are merged.
fn still(path: &[DVec3], speed: f64, least: f64, koma_rate: f64) -> Vec<RangeInclusive<usize>> {
    let (step, least) = (speed / koma_rate, least * koma_rate);
    let steps = still_steps(path, step, koma_rate);
    let mut stretches: Vec<RangeInclusive<usize>> = Vec::new();
    let mut begin = 0;
    for run in steps.chunk_by(|a, b| a == b) {
        // A run of n steps joins n + 1 koma.
        let end = begin + run.len();
        if run[0] && (run.len() + 1) as f64 >= least - 1e-9 {
            let is_torn = |before: &&mut RangeInclusive<usize>| {
                let last = *before.end();
                begin - last <= TORN && path[last].distance(path[begin]) <= TORN_WAY * step
            };
            match stretches.last_mut().filter(is_torn) {
                Some(before) => *before = *before.start()..=end,
                None => stretches.push(begin..=end),
            }
        }
        begin = end;
    }
    stretches
}

/// Marks the steps of a path that are no longer than `step` and not part of a slow drift: many small steps in one
/// direction mean that a foot is carefully set elsewhere.
fn still_steps(path: &[DVec3], step: f64, koma_rate: f64) -> Vec<bool> {
    let is_small = |koma: usize| path[koma].distance(path[koma + 1]) <= step;
    let small: Vec<bool> = (0..path.len().saturating_sub(1)).map(is_small).collect();
    let half = (0.5 * SLOW * koma_rate).round() as usize;
    let is_on_its_way = |koma: usize| {
        let (Some(from), to) = (koma.checked_sub(half), koma + half) else { return false };
        let is_slow = small.get(from..to).is_some_and(|steps| steps.iter().all(|small| *small));
        is_slow && path[from].distance(path[to]) > SLOW_WAY
    };
    (0..small.len()).map(|koma| small[koma] && !is_on_its_way(koma)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A path along X made of steps, at a height.
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

    /// Finds the stretches in which a foot stands while the other stays on the ground.
    fn standing(path: Vec<DVec3>) -> Vec<RangeInclusive<usize>> {
        let other = vec![DVec3::ZERO; path.len()];
        ContactFinder::default().standing(&[path, other], DVec3::Y, 24.0).swap_remove(0)
    }

    #[test]
    fn a_sole_stands_where_it_hardly_moves_near_its_ground() {
        let steps = [(10, 0.1), (8, 5.0), (12, 0.1), (8, 5.0), (6, 0.1)];
        assert_eq!(standing(path(&steps, |_| 3.0)), [0..=10, 18..=30, 38..=44]);
        // At its second stop the foot is held in the air.
        let lifted = |koma| if (15..35).contains(&koma) { 9.0 } else { 3.0 };
        assert_eq!(standing(path(&steps, lifted)), [0..=10, 38..=44]);
    }

    #[test]
    fn a_foot_that_is_set_elsewhere_slowly_stands_twice() {
        let slow = standing(path(&[(24, 0.02), (48, 0.49), (24, 0.02)], |_| 0.0));
        assert_eq!(slow, [0..=23, 74..=96]);
    }

    #[test]
    fn a_foot_that_only_turns_back_does_not_stand() {
        let turn = path(&[(10, 2.0), (1, 0.1), (10, -2.0)], |_| 0.0);
        assert!(standing(turn).is_empty(), "two koma are too few");
        let stand = path(&[(10, 2.0), (2, 0.1), (10, -2.0)], |_| 0.0);
        assert_eq!(standing(stand), [10..=12]);
    }

    #[test]
    fn a_koma_that_is_off_does_not_tear_a_contact() {
        let steps = |fast: &[(usize, f64)]| [&[(10, 0.1)], fast, &[(10, 0.1), (8, 5.0)]].concat();
        let torn = |fast: &[(usize, f64)]| standing(path(&steps(fast), |_| 0.0));
        assert_eq!(torn(&[(1, 0.8)]), [0..=21], "one step that is a little long");
        assert_eq!(torn(&[(1, 2.5), (1, -2.5)]), [0..=22], "there and back");
        assert_eq!(torn(&[(1, 2.5)]), [0..=10, 11..=21], "it stands elsewhere");
        assert_eq!(torn(&[(3, 0.7)]).len(), 2, "three are a movement");
    }

    fn between(from: f64, to: f64, share: f64) -> f64 {
        from + share * (to - from)
    }

    /// Two feet in turn: every 12 koma one of them is set a stride further, at the heights in `steps`.
    fn walk(steps: &[f64]) -> Vec<Vec<DVec3>> {
        let mut feet = [vec![DVec3::ZERO], vec![DVec3::ZERO]];
        for (at, level) in steps.iter().enumerate() {
            let (swings, stands) = (at % 2, 1 - at % 2);
            let from = feet[swings][12 * at];
            let to = DVec3::new(20.0 * (at + 1) as f64, *level, 0.0);
            let highest = from.y.max(to.y) + 3.0;
            for koma in 1..=12 {
                let share = f64::from(koma) / 12.0;
                // First up, then forward and down.
                let level = if koma < 6 {
                    between(from.y, highest, share * 2.0)
                } else {
                    between(highest, to.y, share * 2.0 - 1.0)
                };
                feet[swings].push(DVec3 { y: level, ..from.lerp(to, share) });
                let stays = feet[stands][12 * at];
                feet[stands].push(stays);
            }
        }
        feet.to_vec()
    }

    #[test]
    fn every_step_of_a_walk_stands_on_the_flat_and_on_stairs() {
        let finder = ContactFinder::default();
        let flat = finder.standing(&walk(&[0.0; 8]), DVec3::Y, 24.0);
        let (up, down) = (
            [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0],
            [0.0, -10.0, -20.0, -30.0, -40.0, -50.0, -60.0, -70.0],
        );
        assert_eq!(
            flat,
            [
                [12..=24, 36..=48, 60..=72, 84..=96].to_vec(),
                [0..=12, 24..=36, 48..=60, 72..=84].to_vec()
            ]
        );
        for stairs in [up, down] {
            assert_eq!(finder.standing(&walk(&stairs), DVec3::Y, 24.0), flat);
        }
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
        assert_eq!(finder.standing(&[vec![], vec![]], DVec3::Y, 24.0), [vec![], vec![]]);
        assert!(finder.staying(&[DVec3::ZERO], 24.0).is_empty());
    }
}
