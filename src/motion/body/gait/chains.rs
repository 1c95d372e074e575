//! Builds chains (連なり) of alternating steps and splits them into gaits.

use std::array;
use std::cmp::Ordering;
use std::mem;
use std::ops::{Range, RangeInclusive};

use super::legs::{Legs, Passing, RATE, most};
use super::{Gait, Step};
use crate::maths::median;

/// Fewest steps of a gait: two of each foot, as a single one has no counterpart.
const LEAST_STEPS: usize = 4;

/// Shortest and longest step, in seconds: a sprint, and a walk in slow motion.
const SECONDS: RangeInclusive<f64> = 0.15..=2.0;

/// Longest time in a step with both feet on the ground, in seconds: after more the body has stopped.
const LONGEST_STAND: f64 = 0.4;

/// Largest difference of a step, and of its way to the passing, from the median of its foot, as a share of the median
/// step and in seconds; the larger of both applies. The time is a koma and a half of film, because a step of a run
/// lasts only a few koma.
const ALIKE: (f64, f64) = (0.25, 0.0625);

/// Least distance of the ankles at a contact, as a share of their largest distance, in the median step of a gait.
/// Pedalling has 0.2, because one foot is lowest when the other is highest. A sprint has 0.4 and more, a walk nearly
/// 1.
const STILL_APART: f64 = 0.33;

/// How much of the median step has passed when the other foot passes: a third in a run, nearly two thirds in a march.
/// Drawn poses with straight inbetweens may have feet that go past each other as soon as one comes down; that is no
/// gait.
const PASSING: RangeInclusive<f64> = 0.2..=0.8;

/// Largest time between an end of the clip and a step's missing contact, in seconds, at which the clip has cut the
/// step.
const AT_END: f64 = 1.0 / 12.0;

/// Least time that a foot must be down before the clip ends, in seconds: half of [`AT_END`], so that a step whose end
/// is just visible still counts.
const LANDED: f64 = AT_END / 2.0;

/// The observed part of a step, in instants.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Seen {
    foot: usize,
    contact: Option<f64>,
    passing: Option<f64>,
    next: Option<f64>,
    /// Distance of the ankles at the contact, as a share of their largest.
    still_apart: Option<f64>,
}

impl Seen {
    /// Returns the duration, if both contacts are observed.
    fn length(&self) -> Option<f64> {
        Some(self.next? - self.contact?)
    }

    /// Returns the time from contact to passing, if both are observed.
    fn swing(&self) -> Option<f64> {
        Some(self.passing? - self.contact?)
    }
}

/// Finds the gaits of two legs, in instants. Steps on the spot count only outside the strides.
pub(super) fn gaits(legs: &Legs) -> Vec<Gait> {
    let mut found = gaits_by(legs);
    let strides: Vec<[Step; 2]> = found.iter().filter_map(outer).collect();
    let on_spot = gaits_by(&legs.on_spot());
    found.extend(on_spot.iter().flat_map(|gait| beside(gait, &strides)));
    let begin = |gait: &Gait| gait.steps.first().map(|step| step.contact);
    found.sort_by(|a, b| begin(a).partial_cmp(&begin(b)).unwrap_or(Ordering::Equal));
    found
}

/// Returns the first and the last step of a gait.
fn outer(gait: &Gait) -> Option<[Step; 2]> {
    Some([*gait.steps.first()?, *gait.steps.last()?])
}

/// Returns the parts of a gait on the spot in which the feet pass outside the bounds of all strides.
fn beside(gait: &Gait, strides: &[[Step; 2]]) -> Vec<Gait> {
    let is_stride = |step: &Step| {
        strides.iter().any(|[first, last]| (first.contact..=last.next).contains(&step.passing))
    };
    let parts = gait.steps.split(is_stride).filter(|part| part.len() >= LEAST_STEPS);
    parts.map(|part| joined(part.to_vec(), strides)).collect()
}

/// Joins steps on the spot to the strides before and behind them. Both measure the contact between them, each by its
/// own distance of the ankles; that of the stride counts.
fn joined(mut steps: Vec<Step>, strides: &[[Step; 2]]) -> Gait {
    let are_one = |a: &Step, b: &Step, gap: f64| {
        gap < 0.0
            || (a.foot != b.foot && gap < 0.5 * f64::min(a.next - a.contact, b.next - b.contact))
    };
    for [begin, end] in strides {
        if let Some(first) = steps.first_mut().filter(|first| end.next < first.passing)
            && are_one(end, first, first.contact - end.next)
        {
            first.contact = end.next;
            first.down = first.down.max(end.next);
        }
        if let Some(last) = steps.last_mut().filter(|last| last.passing < begin.contact)
            && are_one(last, begin, begin.contact - last.next)
        {
            last.next = begin.contact;
            last.up = last.up.min(begin.contact);
        }
    }
    Gait { steps }
}

fn gaits_by(legs: &Legs) -> Vec<Gait> {
    chains(legs).iter().flat_map(|chain| parts(chain)).filter_map(|part| gait(legs, part)).collect()
}

/// Finds the longest chains of alternating steps of a body that keeps walking.
fn chains(legs: &Legs) -> Vec<Vec<Seen>> {
    let passings = legs.passings();
    let downs = touchdowns(legs, &passings);
    let (mut chains, mut chain) = (Vec::new(), Vec::new());
    for (at, passing) in passings.iter().enumerate() {
        let foot = 1 - passing.swings;
        let before = at.checked_sub(1);
        let goes_on = before.is_none_or(|at| passings[at].is_step && passings[at].swings == foot);
        let from = before.map_or(0.0, |before| passings[before].at);
        let contact = match before {
            Some(before) if passings[before].is_step => downs[before].filter(|_| goes_on),
            // The foot sets out from a stand, or does so before the clip begins.
            _ => {
                let down = legs.touchdown(foot, from, passing.at);
                down.filter(|down| legs.was_lifted(foot, from, *down))
            }
        };
        let still_apart = contact.map(|contact| legs.still_apart(from, contact, passing.at));
        let (passed, next) = (Some(passing.at), downs[at]);
        let step = Seen { foot, contact, passing: passed, next, still_apart };
        if !(goes_on && passing.is_step && is_step(legs, step)) {
            chains.push(mem::take(&mut chain));
        }
        if passing.is_step && is_step(legs, step) && (contact.is_some() || before.is_none()) {
            chain.push(step);
        }
    }
    chain.extend(cut_off(legs, &passings, &downs));
    chains.push(chain);
    chains
}

/// Finds the touchdown after each passing. A foot that is down only just before the clip ends may still be moving,
/// and gives `None`.
fn touchdowns(legs: &Legs, passings: &[Passing]) -> Vec<Option<f64>> {
    let last = legs.last() as f64;
    let down = |(at, passing): (usize, &Passing)| {
        let after = passings.get(at + 1);
        let down = legs.touchdown(passing.swings, passing.at, after.map_or(last, |after| after.at));
        down.filter(|down| passing.is_step && (after.is_some() || *down <= last - LANDED * RATE))
    };
    passings.iter().enumerate().map(down).collect()
}

/// Whether an observed step belongs to a body that keeps walking.
fn is_step(legs: &Legs, step: Seen) -> bool {
    let (Some(contact), Some(passing)) = (step.contact, step.passing) else { return true };
    let is_long = |length: f64| SECONDS.contains(&(length / RATE));
    let overtakes = |next: f64| legs.is_overtaken(contact, next);
    legs.stands(contact, passing) <= LONGEST_STAND * RATE
        && step.length().is_none_or(is_long)
        && step.next.is_none_or(overtakes)
}

/// Returns the step during which the clip ends before its passing.
fn cut_off(legs: &Legs, passings: &[Passing], downs: &[Option<f64>]) -> Option<Seen> {
    let (passing, contact) = (passings.last()?, downs.last().copied()??);
    let foot = passing.swings;
    let is_seen = legs.is_half_way(foot, passing.at, contact);
    let (contact, next) = (Some(contact), None);
    is_seen.then_some(Seen { foot, contact, passing: None, next, still_apart: None })
}

/// Splits a chain into stretches of equally long steps per foot: the longest one, then those before and behind it.
fn parts(chain: &[Seen]) -> Vec<&[Seen]> {
    let Some(Range { start, end }) = longest(chain) else { return Vec::new() };
    let mut found = parts(&chain[..start]);
    found.push(&chain[start..end]);
    found.extend(parts(&chain[end..]));
    found
}

/// Finds the longest stretch of a chain of which every prefix has similar steps; of equally long ones the first.
fn longest(chain: &[Seen]) -> Option<Range<usize>> {
    let mut best = 0..LEAST_STEPS - 1;
    for begin in 0..chain.len() {
        if chain.len() - begin <= best.len() {
            break;
        }
        let alike = (begin + 1..=chain.len()).take_while(|end| are_alike(&chain[begin..*end]));
        let end = alike.last().unwrap_or(begin);
        if end - begin > best.len() {
            best = begin..end;
        }
    }
    (best.len() >= LEAST_STEPS).then_some(best)
}

fn are_alike(steps: &[Seen]) -> bool {
    (0..2).all(|foot| {
        let own = || steps.iter().filter(|step| step.foot == foot);
        let length = median(own().filter_map(Seen::length)).unwrap_or(0.0);
        let swing = median(own().filter_map(Seen::swing)).unwrap_or(0.0);
        let most = f64::max(ALIKE.0 * length, ALIKE.1 * RATE);
        let is_alike =
            |own: Option<f64>, usual: f64| own.is_none_or(|own| (own - usual).abs() <= most);
        own().all(|step| is_alike(step.length(), length) && is_alike(step.swing(), swing))
    })
}

/// Builds the gait of some steps. Parts cut off by the clip are completed from the other steps.
fn gait(legs: &Legs, steps: &[Seen]) -> Option<Gait> {
    let still_apart = median(steps.iter().filter_map(|step| step.still_apart))?;
    let passing = median(steps.iter().filter_map(|step| Some(step.swing()? / step.length()?)));
    if still_apart < STILL_APART || passing.is_some_and(|share| !PASSING.contains(&share)) {
        return None;
    }
    let parts: [fn(&Seen) -> Option<f64>; 2] =
        [Seen::swing, |step| Some(step.next? - step.passing?)];
    let usual = |foot: usize| parts.map(|part| middle(steps, foot, part));
    let usual: [[Option<f64>; 2]; 2] = array::from_fn(usual);
    let whole = |step: &Seen| {
        let [swing, fall] = usual[step.foot];
        let plus = |at: Option<f64>, way: Option<f64>| Some(at? + way?);
        let passing = step.passing.or_else(|| plus(step.contact, swing))?;
        let contact = step.contact.or_else(|| Some(passing - swing?))?;
        let next = step.next.or_else(|| plus(Some(passing), fall))?;
        Some((step.foot, [contact, passing, next]))
    };
    let mut whole: Vec<_> = steps.iter().map(whole).collect::<Option<_>>()?;
    let (near, last) = (AT_END * RATE, legs.last() as f64);
    let is_cut = |(seen, (_, [contact, _, next])): (&Seen, &(usize, [f64; 3]))| {
        (seen.contact.is_some() || *contact <= near)
            && (seen.next.is_some() || *next >= last - near)
    };
    let mut keep = steps.iter().zip(&whole).map(is_cut).collect::<Vec<bool>>().into_iter();
    whole.retain(|_| keep.next().unwrap_or(false));
    (whole.len() >= LEAST_STEPS).then(|| with_heights(legs, &whole))
}

/// Returns the median of a part of a foot's observed steps, or that of the other foot if there are none.
fn middle(steps: &[Seen], foot: usize, part: fn(&Seen) -> Option<f64>) -> Option<f64> {
    let of = |foot| median(steps.iter().filter(|step| step.foot == foot).filter_map(part));
    of(foot).or_else(|| of(1 - foot))
}

/// Adds down and up: the extremes of the pelvis about a line that rises with the gait from contact to contact, so that
/// stairs do not move them.
fn with_heights(legs: &Legs, steps: &[(usize, [f64; 3])]) -> Gait {
    let last = legs.last() as f64;
    let climbs = steps.iter().filter_map(|(_, [contact, _, next])| legs.climb(*contact, *next));
    let climb = median(climbs).unwrap_or(0.0);
    let extreme = |sign: f64, from: f64, to: f64| {
        let at = most(&legs.pelvis, (from, to), climb, sign);
        // At an end of the clip the pelvis may continue to rise or fall, so this is no extreme.
        (at > 0.0 && at < last && from < last && to > 0.0).then_some((at - from) / (to - from))
    };
    let seen = |&(foot, [contact, passing, next]): &(usize, [f64; 3])| {
        (foot, [extreme(-1.0, contact, passing), extreme(1.0, passing, next)])
    };
    let seen: Vec<_> = steps.iter().map(seen).collect();
    let usual = |foot: usize, part: usize| {
        let of = |foot| {
            let own = seen.iter().filter(|(own, _)| *own == foot);
            median(own.filter_map(|(_, shares)| shares[part]))
        };
        of(foot).or_else(|| of(1 - foot)).unwrap_or(0.5)
    };
    let usual: [[f64; 2]; 2] = array::from_fn(|foot| array::from_fn(|part| usual(foot, part)));
    let step =
        |(&(foot, [contact, passing, next]), (_, shares)): (&(usize, [f64; 3]), &(_, [_; 2]))| {
            let share = |part: usize| -> f64 { Option::unwrap_or(shares[part], usual[foot][part]) };
            let (down, up) = (share(0), share(1));
            let (down, up) =
                (contact + down * (passing - contact), passing + up * (next - passing));
            Step { foot, contact, down, passing, up, next }
        };
    Gait { steps: steps.iter().zip(&seen).map(step).collect() }
}
