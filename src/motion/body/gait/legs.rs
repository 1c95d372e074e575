//! Computes the relative movement of two legs, their passings and touchdowns.

use std::array;

use glam::DVec3;

/// Samples per second of the legs: a quarter of a koma of film, whatever the rates of clip and sheet.
pub(super) const RATE: f64 = 96.0;

/// Half width of the triangular smoothing window, in instants; it spans a koma and a half. It keeps noise, and the
/// missing frames of a low rate, from creating extremes.
const SMOOTH: usize = 3;

/// Weight of the ankles' squared vertical distance against their squared horizontal one in a stride. With more, a run
/// would pass half a koma early.
const RISE: f64 = 0.25;

/// Least change of the ankles' distance in a step, in %H: standing feet have less.
const LEAST_SWING: f64 = 5.0;

/// Least height of the passing ankle above the standing one, in %H.
const LEAST_RISE: f64 = 1.0;

/// Least height that a foot must have had above its level at touchdown, in %H.
const LEAST_LIFT: f64 = 0.5;

/// Share of the way from passing to the widest stance after which a foot may come down: before, it may skim the
/// ground.
const APART: f64 = 0.95;

/// Largest height above its ground level at which a foot is down, in %H: more than a foot trembles, less than the
/// lift of a step.
const DOWN: f64 = 0.75;

/// Share of the widest stance below which a foot has left for the next step.
const LEAVES: f64 = 0.85;

/// Least height of the pelvis above the standing ankle, in %H: a body that crawls or sits does not walk.
const LEAST_PELVIS: f64 = 25.0;

/// Distance of the ankles along the way, in %H, below which neither is ahead.
const BEFORE: f64 = 10.0;

/// Paths of both legs' hips, ankles and soles, the left leg first, in %H, one position per instant.
#[derive(Debug, Clone, Default)]
pub(super) struct Paths {
    pub(super) hips: [Vec<DVec3>; 2],
    pub(super) ankles: [Vec<DVec3>; 2],
    pub(super) soles: [Vec<DVec3>; 2],
}

/// Relative movement of two legs; all lengths in %H, one entry per instant.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Legs {
    /// Distance of the ankles, least at a passing. In a stride: its squared horizontal part minus [`RISE`] times its
    /// squared vertical part. On the spot: minus its squared vertical part alone, because a raised knee takes the foot
    /// ahead.
    apart: Vec<f64>,
    is_on_spot: bool,
    /// Height of the left ankle above the right one.
    rise: Vec<f64>,
    /// Distance of the left ankle ahead of the right one, perpendicular to the line through the hips. The sign of the
    /// direction is unknown.
    before: Vec<f64>,
    /// Heights of ankle and sole of each foot.
    levels: [[Vec<f64>; 2]; 2],
    /// Height of the midpoint of the hips.
    pub(super) pelvis: Vec<f64>,
}

/// An instant at which the ankles are nearest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passing {
    pub(super) at: f64,
    /// Foot that is higher.
    pub(super) swings: usize,
    /// Whether the foot passes: false if both feet just stand side by side.
    pub(super) is_step: bool,
}

impl Legs {
    pub(super) fn new(paths: &Paths, up: DVec3) -> Self {
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
            is_on_spot: false,
            before: ways.iter().zip(ahead).map(|(way, ahead)| way.dot(ahead)).collect(),
            rise,
            levels: array::from_fn(|foot| [level(&ankles[foot]), level(&soles[foot])]),
            pelvis: hips[0].iter().zip(&hips[1]).map(|(a, b)| a.midpoint(*b).dot(up)).collect(),
        }
    }

    /// Returns the same legs, for steps on the spot.
    pub(super) fn on_spot(&self) -> Self {
        let apart = self.rise.iter().map(|rise| -rise.powi(2)).collect();
        Self { apart, is_on_spot: true, ..self.clone() }
    }

    /// Returns the last instant.
    pub(super) fn last(&self) -> usize {
        self.apart.len().saturating_sub(1)
    }

    /// Finds the instants at which the ankles are nearest, between others at which they are clearly further apart.
    /// The beginning and the end of the clip may take the place of the latter.
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

    /// Finds the minima of `apart` between clearly larger values, except at the first and the last instant.
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
        if is_falling && (1..self.last()).contains(&low) {
            found.push(low);
        }
        found
    }

    /// Returns the distance of the ankles in %H: the square root of `apart`, smoothed around 0.
    fn way(&self, at: usize) -> f64 {
        let apart = self.apart[at];
        apart / (apart.abs() + LEAST_SWING * LEAST_SWING).sqrt()
    }

    /// Finds when a foot that passes at `from`, or before, comes down. The other foot passes at `to`. It is the first
    /// instant at which ankle or sole is at its ground level of that time, once the feet are about as far apart as
    /// they get. In a walk the heel comes first; in a run the foot is longer in the air, and either may.
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

    /// Whether a foot was in the air from an instant on, before it came down.
    pub(super) fn was_lifted(&self, foot: usize, from: f64, down: f64) -> bool {
        let down = down as usize;
        let from = (from.ceil() as usize).min(down);
        let is_lifted = |levels: &Vec<f64>| {
            levels[from..=down].iter().any(|level| *level >= levels[down] + LEAST_LIFT)
        };
        self.levels[foot].iter().all(is_lifted)
    }

    /// Returns the distance of the ankles at a contact between two passings, as a share of their largest distance.
    pub(super) fn still_apart(&self, from: f64, contact: f64, passing: f64) -> f64 {
        let [before, contact, to] = [from, contact, passing].map(|at| at.round() as usize);
        let Some(furthest) = self.furthest(before, contact.min(to)) else { return 0.0 };
        let [far, down, near] = [furthest, contact, to].map(|at| self.apart[at]);
        (down - near) / (far - near).max(f64::MIN_POSITIVE)
    }

    /// Returns how many instants both feet stay in place after a contact, before one passes.
    pub(super) fn stands(&self, contact: f64, passing: f64) -> f64 {
        let (from, to) = (contact.ceil() as usize, passing.floor() as usize);
        let Some(furthest) = self.furthest(from, to) else { return 0.0 };
        let goal = self.apart[to] + LEAVES * (self.apart[furthest] - self.apart[to]);
        let leaves = (furthest..=to).find(|at| self.apart[*at] < goal).unwrap_or(to);
        leaves as f64 - contact
    }

    /// Whether the foot that came down first is ahead at one instant and behind at the other, or about level at both.
    pub(super) fn is_overtaken(&self, contact: f64, next: f64) -> bool {
        let [first, second] =
            [contact, next].map(|at| self.before[(at.round() as usize).min(self.last())]);
        let are_level = first.abs() < BEFORE && second.abs() < BEFORE;
        are_level || (!self.is_on_spot && first * second < 0.0)
    }

    /// Whether, between a foot's contact and the end of the clip, the other foot has come at least half of the way to
    /// it, and is higher.
    pub(super) fn is_half_way(&self, foot: usize, passing: f64, contact: f64) -> bool {
        let (from, last) = (passing as usize, self.last());
        let Some(furthest) = self.furthest(from, last) else { return false };
        let [near, far, end] = [from, furthest, last].map(|at| self.apart[at]);
        let rise = if foot == 0 { -self.rise[last] } else { self.rise[last] };
        contact < last as f64 && far - end >= 0.5 * (far - near) && rise >= LEAST_RISE
    }

    /// Returns how much the pelvis climbs an instant from contact to contact; `None` for a step that the clip cuts.
    pub(super) fn climb(&self, contact: f64, next: f64) -> Option<f64> {
        let is_whole = 0.0 <= contact && next <= self.last() as f64;
        let [from, to] =
            is_whole.then_some([contact, next])?.map(|at| self.pelvis[at.round() as usize]);
        Some((to - from) / (next.round() - contact.round()).max(1.0))
    }

    fn furthest(&self, from: usize, to: usize) -> Option<usize> {
        (from..=to).max_by(|a, b| self.apart[*a].total_cmp(&self.apart[*b]))
    }
}

/// Interpolates linearly when a value falls to 0 between `at - 1` and `at`. Without a positive value at `at - 1`,
/// returns `at - 1`.
fn crossing(at: usize, value: impl Fn(usize) -> f64) -> f64 {
    let Some(before) = at.checked_sub(1).map(&value).filter(|before| *before > 0.0) else {
        return at.saturating_sub(1) as f64;
    };
    at as f64 - 1.0 + before / (before - value(at))
}

/// Finds the maximum of some values between two instants, or the minimum if `sign` is −1, about a line that climbs so
/// much an instant.
pub(super) fn most(values: &[f64], (from, to): (f64, f64), climb: f64, sign: f64) -> f64 {
    let last = values.len().saturating_sub(1) as f64;
    let within = (from.clamp(0.0, last).ceil() as usize)..=(to.clamp(0.0, last).floor() as usize);
    let off = |at: usize| sign * (values[at] - climb * at as f64);
    let most = within.max_by(|a, b| off(*a).total_cmp(&off(*b)));
    most.map_or(from, |at| vertex(values, at, climb).clamp(from, to))
}

/// Refines an extreme to the vertex of the parabola through it and its neighbours.
fn extreme(values: &[f64], at: usize) -> f64 {
    vertex(values, at, 0.0)
}

/// Refines an extreme about a line that climbs so much an instant.
fn vertex(values: &[f64], at: usize, climb: f64) -> f64 {
    let around = at.checked_sub(1).and_then(|before| values.get(before..=at + 1));
    let Some(&[before, own, after]) = around else { return at as f64 };
    let bend = before - 2.0 * own + after;
    let off = if bend == 0.0 { 0.0 } else { (0.5 * (before - after) + climb) / bend };
    at as f64 + off.clamp(-0.5, 0.5)
}

fn least(values: &[f64]) -> f64 {
    values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Smooths a path about each instant, with a narrower window towards its ends.
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
