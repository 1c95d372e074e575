//! The effect of a goal in words, with its change: "31 → 24".

use super::stops::{PACE, Path, SNAP};
use super::{Goal, Seen};

/// Describes what a goal has come to.
pub(super) fn of(goal: Goal, seen: &Seen<'_>) -> String {
    let (value, is_japanese) = (value(goal, seen), seen.words.is_japanese());
    match (goal, is_japanese) {
        (Goal::Genga, true) => format!("{value}枚 · 毎秒{}", tenths(rate(seen))),
        (Goal::Genga, false) => format!("{value} · {} a second", tenths(rate(seen))),
        (Goal::Pace, true) => format!("毎秒{value}枚 · {}", name(&PACE, seen)),
        (Goal::Pace, false) => format!("{value} · {}", name(&PACE, seen)),
        (Goal::Snap, true) => format!("{} · 最速は普通の{value}倍", name(&SNAP, seen)),
        (Goal::Snap, false) => {
            format!("{} · fastest {value} × the usual step", name(&SNAP, seen))
        }
    }
}

/// Describes it where there is little room.
pub(super) fn in_short(goal: Goal, seen: &Seen<'_>) -> String {
    match goal {
        Goal::Snap => format!("{} · {}×", name(&SNAP, seen), value(goal, seen)),
        Goal::Genga | Goal::Pace => value(goal, seen),
    }
}

/// Whether the last change has changed it.
pub(super) fn is_new(goal: Goal, seen: &Seen<'_>) -> bool {
    let [before, now] = values(goal, seen);
    before != now
}

/// The value of a goal, with its change.
fn value(goal: Goal, seen: &Seen<'_>) -> String {
    let [before, now] = values(goal, seen);
    match before == now {
        true => now,
        false => format!("{before} {} {now}", seen.words.arrow()),
    }
}

/// The value of a goal before the last change, and now.
fn values(goal: Goal, seen: &Seen<'_>) -> [String; 2] {
    [seen.before, seen.counts].map(|counts| match goal {
        Goal::Genga => counts.genga.to_string(),
        Goal::Pace => tenths(counts.a_second(counts.drawings)),
        Goal::Snap => tenths(counts.contrast),
    })
}

fn rate(seen: &Seen<'_>) -> f64 {
    seen.counts.a_second(seen.counts.genga)
}

fn tenths(value: f64) -> String {
    format!("{value:.1}")
}

/// Name of the stop that the recipe is at.
fn name(path: &Path, seen: &Seen<'_>) -> &'static str {
    match path.stop(seen.recipe) {
        Some(stop) => seen.words.say(stop.english, stop.japanese),
        None => seen.words.say("your own", "自分の設定"),
    }
}
