//! What two legs do from instant to instant, and when a foot passes the other or comes down.

use std::array;

use glam::DVec3;

/// Instants a second at which legs are looked at: a quarter of a koma of film, whatever the rates of clip and sheet.
pub(super) const RATE: f64 = 96.0;

/// Instants to each side up to which places are averaged, by a triangle a koma and a half wide: frames that a low rate lacks
/// and noise make no extremes of their own.
const SMOOTH: usize = 3;

/// What the rise of one ankle above the other counts against the way between them along the ground, both squared. With it
/// who marches on the spot passes when a foot is highest; with more a run would pass half a koma early.
const RISE: f64 = 0.25;

/// How far ankles come nearer and part again in a step at the least, in %H: feet that stand do less.
const LEAST_SWING: f64 = 5.0;

/// How much higher the ankle that passes is than the one that stands at the least, in %H.
const LEAST_RISE: f64 = 1.0;

/// How much higher than where it comes down a foot was at the least that came down, in %H.
const LEAST_LIFT: f64 = 0.5;

/// The share of its way past the other after which a foot may come down: a swing may skim the ground before.
const APART: f64 = 0.95;

/// How near to its ground a foot is down, in %H: more than it trembles, and less than it is off in a step.
const DOWN: f64 = 0.75;

/// The share of the way apart below which a foot is on its way again.
const LEAVES: f64 = 0.85;

/// How high the pelvis is above the ankle that stands at the least, in %H: who crawls or sits does not walk.
const LEAST_PELVIS: f64 = 25.0;

/// How far ankles may be from each other along the way at the least, in %H, that one is before the other.
const BEFORE: f64 = 10.0;

/// Where the points of both legs are, left first, in %H: hips, ankles and soles, a place an instant each.
#[derive(Debug, Clone, Default)]
pub(super) struct Paths {
    pub(super) hips: [Vec<DVec3>; 2],
    pub(super) ankles: [Vec<DVec3>; 2],
    pub(super) soles: [Vec<DVec3>; 2],
}

/// Two legs; all lengths in %H, an entry an instant.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Legs {
    /// How far the ankles are apart: the square of the way along the ground less [`RISE`] times that of the rise.
    apart: Vec<f64>,
    /// How far the left ankle is above the right one.
    rise: Vec<f64>,
    /// How far the left ankle is before the right one, square to the line through the hips; which way that faces is not known.
    before: Vec<f64>,
    /// The heights of ankle and sole of each foot.
    levels: [[Vec<f64>; 2]; 2],
    /// The height of the middle of the hips.
    pub(super) pelvis: Vec<f64>,
}

/// An instant at which ankles are nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passing {
    pub(super) at: f64,
    /// The foot that is higher.
    pub(super) swings: usize,
    /// Whether it passes: not where both feet stand side by side.
    pub(super) is_step: bool,
}

impl Legs {
    pub(super) fn of(paths: &Paths, up: DVec3) -> Self {
        let [hips, ankles, soles] = [&paths.hips, &paths.ankles, &paths.soles]
            .map(|pair| pair.each_ref().map(|path| smoothed(path)));
        let level = |path: &Vec<DVec3>| path.iter().map(|place| place.dot(up)).collect();
        let ways = ankles[0].iter().zip(&ankles[1]).map(|(left, right)| *left - *right);
        let ways: Vec<DVec3> = ways.collect();
        let rise: Vec<f64> = ways.iter().map(|way| way.dot(up)).collect();
        let along = ways.iter().zip(&rise).map(|(way, rise)| *way - *rise * up);
        let apart = along.zip(&rise).map(|(way, rise)| way.length_squared() - RISE * rise.powi(2));
        let across = hips[0].iter().zip(&hips[1]).map(|(left, right)| *right - *left);
        let ahead = across.map(|across| up.cross(across).normalize_or_zero());
        Self {
            apart: apart.collect(),
            before: ways.iter().zip(ahead).map(|(way, ahead)| way.dot(ahead)).collect(),
            rise,
            levels: array::from_fn(|foot| [level(&ankles[foot]), level(&soles[foot])]),
            pelvis: hips[0].iter().zip(&hips[1]).map(|(a, b)| a.midpoint(*b).dot(up)).collect(),
        }
    }

    /// The last instant.
    pub(super) fn last(&self) -> usize {
        self.apart.len().saturating_sub(1)
    }

    /// The instants at which ankles are nearest, between others at which they are clearly further apart; also where the clip
    /// begins or ends before they are.
    pub(super) fn passings(&self) -> Vec<Passing> {
        let passing = |nearest: usize| {
            let at = extreme(&self.apart, nearest);
            let swings = usize::from(self.rise[nearest] < 0.0);
            let pelvis = self.pelvis[nearest] - self.levels[1 - swings][0][nearest];
            let is_high = self.rise[nearest].abs() >= LEAST_RISE && pelvis >= LEAST_PELVIS;
            Passing { at, swings, is_step: is_high }
        };
        self.nearest().into_iter().map(passing).collect()
    }

    /// Where `apart` is least between two instants at which it is clearly more; neither the first instant nor the last.
    fn nearest(&self) -> Vec<usize> {
        let mut found = Vec::new();
        let (mut low, mut high, mut is_falling) = (0, 0, true);
        for at in 0..self.apart.len() {
            let way = self.way(at);
            if way < self.way(low) {
                low = at;
            }
            if way > self.way(high) {
                high = at;
            }
            if is_falling && way - self.way(low) >= LEAST_SWING {
                found.extend((low > 0).then_some(low));
                (high, is_falling) = (at, false);
            } else if !is_falling && self.way(high) - way >= LEAST_SWING {
                (low, is_falling) = (at, true);
            }
        }
        if is_falling && low < self.last() {
            found.push(low);
        }
        found
    }

    /// How far the ankles are apart, in %H: the root of `apart`, but even about 0.
    fn way(&self, at: usize) -> f64 {
        let apart = self.apart[at];
        apart / (apart.abs() + LEAST_SWING * LEAST_SWING).sqrt()
    }

    /// When a foot that passes at `from`, or before, comes down: the first instant at which its ankle or its sole is on the
    /// ground that it has until `to`, when the other passes, once it is as far from the other as it gets or
    /// nearly so. In a walk that is the heel, in a run, in the air for a while longer, what comes first.
    pub(super) fn touchdown(&self, foot: usize, from: f64, to: f64) -> Option<f64> {
        let (from, to) = (from.ceil() as usize, to.floor() as usize);
        let furthest = self.furthest(from, to)?;
        let goal = self.apart[from] + APART * (self.apart[furthest] - self.apart[from]);
        let begin = (from..=furthest).find(|at| self.apart[*at] >= goal)?;
        let ground = self.levels[foot].each_ref().map(|levels| least(&levels[begin..=to]));
        let off = |at: usize| {
            let [ankle, sole] = [0, 1].map(|end| self.levels[foot][end][at] - ground[end]);
            ankle.min(sole) - DOWN
        };
        let down = (begin..=to).find(|at| off(*at) <= 0.0)?;
        let lands = crossing(down, off);
        Some(lands.max(crossing(begin, |at| goal - self.apart[at])))
    }

    /// Whether a foot was in the air before it came down.
    pub(super) fn was_lifted(&self, foot: usize, down: f64) -> bool {
        let down = down as usize;
        let is_lifted = |levels: &Vec<f64>| {
            levels[..=down].iter().any(|level| *level >= levels[down] + LEAST_LIFT)
        };
        self.levels[foot].iter().all(is_lifted)
    }

    /// How far the ankles still are apart at a contact between two passings, as a share of how far they get.
    pub(super) fn still_apart(&self, from: f64, contact: f64, passing: f64) -> f64 {
        let [before, contact, to] = [from, contact, passing].map(|at| at.round() as usize);
        let Some(furthest) = self.furthest(before, contact.min(to)) else { return 0.0 };
        let [far, down, near] = [furthest, contact, to].map(|at| self.apart[at]);
        (down - near) / (far - near).max(f64::MIN_POSITIVE)
    }

    /// How long both feet stay where they are after a contact, in instants, before one passes.
    pub(super) fn stands(&self, contact: f64, passing: f64) -> f64 {
        let (from, to) = (contact.ceil() as usize, passing.floor() as usize);
        let Some(furthest) = self.furthest(from, to) else { return 0.0 };
        let goal = self.apart[to] + LEAVES * (self.apart[furthest] - self.apart[to]);
        let leaves = (furthest..=to).find(|at| self.apart[*at] < goal).unwrap_or(to);
        leaves as f64 - contact
    }

    /// Whether the foot that came down first is before the other at the one instant and behind it at the other, or both
    /// times hardly either.
    pub(super) fn is_overtaken(&self, contact: f64, next: f64) -> bool {
        let [first, second] =
            [contact, next].map(|at| self.before[(at.round() as usize).min(self.last())]);
        first * second < 0.0 || (first.abs() < BEFORE && second.abs() < BEFORE)
    }

    /// Whether from a foot's contact to the end of the clip the other has come half of its way to it, or more, and is
    /// higher.
    pub(super) fn is_half_way(&self, foot: usize, passing: f64, contact: f64) -> bool {
        let (from, last) = (passing as usize, self.last());
        let Some(furthest) = self.furthest(from, last) else { return false };
        let [near, far, end] = [from, furthest, last].map(|at| self.apart[at]);
        let rise = if foot == 0 { -self.rise[last] } else { self.rise[last] };
        contact < last as f64 && far - end >= 0.5 * (far - near) && rise >= LEAST_RISE
    }

    fn furthest(&self, from: usize, to: usize) -> Option<usize> {
        (from..=to).max_by(|a, b| self.apart[*a].total_cmp(&self.apart[*b]))
    }
}

/// Where a value that is above 0 before an instant, and no longer at it, is 0: a straight way between both. One that is
/// not above 0 before is nowhere.
fn crossing(at: usize, value: impl Fn(usize) -> f64) -> f64 {
    let Some(before) = at.checked_sub(1).map(&value).filter(|before| *before > 0.0) else {
        return at.saturating_sub(1) as f64;
    };
    at as f64 - 1.0 + before / (before - value(at))
}

/// Where some values are most from one instant to another, or, with a `sign` of −1, least.
pub(super) fn most(values: &[f64], (from, to): (f64, f64), sign: f64) -> f64 {
    let last = values.len().saturating_sub(1) as f64;
    let within = (from.clamp(0.0, last).ceil() as usize)..=(to.clamp(0.0, last).floor() as usize);
    let most = within.max_by(|a, b| (sign * values[*a]).total_cmp(&(sign * values[*b])));
    most.map_or(from, |at| extreme(values, at).clamp(from, to))
}

/// The extreme at an instant, more exactly: the top of the parabola through it and its neighbours.
fn extreme(values: &[f64], at: usize) -> f64 {
    let around = at.checked_sub(1).and_then(|before| values.get(before..=at + 1));
    let Some(&[before, own, after]) = around else { return at as f64 };
    let bend = before - 2.0 * own + after;
    let off = if bend == 0.0 { 0.0 } else { 0.5 * (before - after) / bend };
    at as f64 + off.clamp(-0.5, 0.5)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// A path averaged about each instant; towards its ends about fewer.
fn smoothed(path: &[DVec3]) -> Vec<DVec3> {
    let mean = |at: usize| {
        let room = at.min(path.len() - 1 - at).min(SMOOTH);
        let weighed = (at - room..=at + room).map(|near| {
            let weight = (room + 1 - near.abs_diff(at)) as f64;
            weight * path[near]
        });
        weighed.sum::<DVec3>() / ((room + 1) * (room + 1)) as f64
    };
    (0..path.len()).map(mean).collect()
}
