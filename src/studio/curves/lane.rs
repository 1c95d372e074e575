//! The curve of one joint: as measured, filtered, with its keys and walls, over a band where it counts as steady.

use std::ops::Range;

use egui::{Align2, FontId, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};

use super::time::{Scale, across};
use crate::motion::JointId;
use crate::signal::{Turn, TurnKind};
use crate::studio::look::Look;
use crate::studio::room::Room;
use crate::studio::shown::Shown;

/// How far a raw peak may stand out over the filtered curve.
const OVER: f64 = 1.6;

/// The share of the frames that are usual, and how far over them one has to be to be cut off.
const USUAL: f64 = 0.99;
const OUTLIER: f64 = 3.0;
/// Frames that are looked at for it.
const LOOKS: usize = 4000;

/// Marks of turns nearer than this cover each other.
const CLOSEST: f32 = 2.0;
/// Where marks mostly stand nearer than this they are smaller, down to this share.
const ROOMY: f32 = 9.0;
const SMALLEST: f32 = 0.45;

/// Lanes lower than this have room for their highest value alone, without its unit.
const LOW: f32 = 22.0;

/// Height of a name.
const NAME: f32 = 15.0;

/// Points across that a band has at the least.
const THIN: f32 = 2.0;

/// Draws a lane; `steps` are the steady steps of its joint.
pub(super) fn draw(
    painter: &Painter,
    rect: Rect,
    (joint, steps): (JointId, &[bool]),
    time: &Scale,
    shown: &Shown<'_>,
) {
    let look = &shown.look;
    let breakdown = &shown.breakdown;
    let (raw, filtered) = (breakdown.speed.joint(joint), breakdown.filtered.joint(joint));
    let (low, high) = range(raw, filtered);
    let y = |value: f64| {
        let share = (value - low) / (high - low);
        rect.max.y - (share as f32 * rect.height()).clamp(0.0, rect.height())
    };
    steady(painter, rect, steps, time, shown);
    painter.hline(rect.x_range(), y(0.0), Stroke::new(1.0, look.grid));
    let clipped = painter.with_clip_rect(rect.intersect(painter.clip_rect()));
    let first = breakdown.speed.first.0;
    for (values, color, width) in [(raw, look.raw, 1.0), (filtered, look.filtered, 1.8)] {
        let line = points(values, first, time, rect, y);
        clipped.add(Shape::line(line, Stroke::new(width, color)));
    }
    cut_off(&clipped, rect, (filtered, first), (low, high), time, look);
    let x = |turn: &Turn| time.x(turn.frame.0 as f64);
    let turns = breakdown.turns[joint.0].iter();
    let is_seen = |turn: &&Turn| (time.from..=time.to).contains(&(turn.frame.0 as f64));
    let turns: Vec<&Turn> = turns.filter(is_seen).collect();
    let size = (across(turns.iter().map(|turn| x(turn))) / ROOMY).clamp(SMALLEST, 1.0);
    let mut room = Room::default();
    for turn in turns.into_iter().filter(|turn| room.take(x(turn), CLOSEST)) {
        let at = pos2(x(turn), y(filtered[turn.frame.0 - first]));
        mark(&clipped, at, size, turn, look);
    }
    values(painter, rect, high, shown);
}

/// An arrow and the value where the curve goes beyond the lane.
fn cut_off(
    painter: &Painter,
    rect: Rect,
    (values, first): (&[f64], usize),
    (low, high): (f64, f64),
    time: &Scale,
    look: &Look,
) {
    let is_beyond = |value: f64| value > high || value < low;
    if !values.iter().any(|value| is_beyond(*value)) {
        return;
    }
    let mut from = 0;
    for run in values.chunk_by(|a, b| is_beyond(*a) == is_beyond(*b)) {
        let begin = from;
        from += run.len();
        if !is_beyond(run[0]) {
            continue;
        }
        let x = time.x((first + begin) as f64 + 0.5 * (run.len() - 1) as f64);
        let top = pos2(x, rect.min.y + 1.0);
        let corners = [vec2(0.0, 0.0), vec2(4.0, 6.0), vec2(-4.0, 6.0)].map(|way| top + way);
        painter.add(Shape::convex_polygon(corners.to_vec(), look.genga, Stroke::NONE));
    }
}

/// Shades where the joint neither speeds up nor slows down (等速): only what is not shaded can turn.
fn steady(painter: &Painter, rect: Rect, steps: &[bool], time: &Scale, shown: &Shown<'_>) {
    let filtered = shown.breakdown.filtered;
    let x = |row: usize| time.x((filtered.first.0 + row) as f64);
    for run in runs(steps) {
        let (left, right) = (x(run.start).max(rect.min.x), x(run.end).min(rect.max.x));
        // What is thinner would be a grey haze over a long clip.
        if right - left >= THIN {
            let band = Rect::from_x_y_ranges(left..=right, rect.y_range());
            painter.rect_filled(band, 0.0, shown.look.steady);
        }
    }
}

/// The stretches that are so, as the rows from which to which they go.
fn runs(steps: &[bool]) -> Vec<Range<usize>> {
    let mut at = 0;
    let stretch = |same: &[bool]| {
        let begin = at;
        at += same.len();
        same[0].then_some(begin..at)
    };
    steps.chunk_by(|a, b| a == b).filter_map(stretch).collect()
}

/// From which value to which a lane goes.
fn range(raw: &[f64], filtered: &[f64]) -> (f64, f64) {
    let bounds = |values: &[f64]| {
        let wider = |(low, high): (f64, f64), value: &f64| (low.min(*value), high.max(*value));
        values.iter().fold((0.0, 0.0), wider)
    };
    let (whole, most) = (bounds(filtered), bounds(raw));
    let usual = usual(filtered);
    let whole = (whole.0.max(-usual), whole.1.min(usual));
    let low = most.0.max(OVER * whole.0).min(whole.0);
    let high = most.1.min(OVER * whole.1).max(whole.1);
    if high > low { (low, high) } else { (0.0, 1.0) }
}

/// How high a curve is taken to go: where a few frames stand out far over all others, over those.
fn usual(values: &[f64]) -> f64 {
    // So many are enough to tell, and no more are sorted with every frame of the window.
    let step = values.len().div_ceil(LOOKS).max(1);
    let mut sizes: Vec<f64> = values.iter().step_by(step).map(|value| value.abs()).collect();
    let Some(last) = sizes.len().checked_sub(1) else { return f64::INFINITY };
    let at = (USUAL * last as f64).ceil() as usize;
    let usual = *sizes.select_nth_unstable_by(at, f64::total_cmp).1;
    let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    if usual > 0.0 && most > OUTLIER * usual { usual } else { f64::INFINITY }
}

/// The curve in view. Where a point of the window has many frames, it has the lowest and the highest of them.
fn points(
    values: &[f64],
    first: usize,
    time: &Scale,
    rect: Rect,
    y: impl Fn(f64) -> f32,
) -> Vec<Pos2> {
    let row = |place: f64| (place - first as f64).max(0.0) as usize;
    let (from, to) = (row(time.from.floor()), (row(time.to.ceil()) + 1).min(values.len()));
    let Some(seen) = values.get(from..to).filter(|seen| !seen.is_empty()) else { return vec![] };
    let place = |at: usize, value: f64| pos2(time.x((first + from + at) as f64), y(value));
    let bunch = (seen.len() as f32 / rect.width().max(1.0)).floor() as usize;
    if bunch < 2 {
        return seen.iter().enumerate().map(|(at, value)| place(at, *value)).collect();
    }
    let extremes = |(bunched, values): (usize, &[f64])| {
        let at = |value: f64| place(bunched * bunch, value);
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // In the order in which they come, so that the line does not go back.
        if values[0] <= values[values.len() - 1] {
            [at(low), at(high)]
        } else {
            [at(high), at(low)]
        }
    };
    seen.chunks(bunch).enumerate().flat_map(extremes).collect()
}

fn mark(painter: &Painter, at: Pos2, size: f32, turn: &Turn, look: &Look) {
    let edge = Stroke::new(size, look.paper);
    match turn.kind {
        TurnKind::Key => drop(painter.circle(at, size * 3.6, look.genga, edge)),
        TurnKind::Wall => {
            let corners = [vec2(0.0, -4.6), vec2(4.2, 3.2), vec2(-4.2, 3.2)];
            let corners = corners.map(|way| at + size * way).to_vec();
            painter.add(Shape::convex_polygon(corners, look.wall, edge));
        }
    }
}

/// The highest value, and its unit where there is room.
fn values(painter: &Painter, rect: Rect, high: f64, shown: &Shown<'_>) {
    let (look, unit) = (&shown.look, shown.breakdown.filtered.unit);
    let number = (high * unit.for_people()).round();
    let font = FontId::proportional(10.0);
    let left = rect.min.x - 4.0;
    painter.text(pos2(left, rect.min.y), Align2::RIGHT_TOP, number, font.clone(), look.faint);
    if rect.height() >= LOW {
        let at = pos2(left, rect.min.y + 11.0);
        painter.text(at, Align2::RIGHT_TOP, unit.symbol(), font, look.faint);
    }
}

/// What each lane shows, in its upper left corner. A name that would touch the one over it is left out.
pub(super) fn titles(painter: &Painter, titles: &[(Rect, &str)], look: &Look) {
    let mut room = Room::default();
    for (rect, name) in titles {
        if room.take(rect.min.y, NAME) {
            title(painter, *rect, name, look);
        }
    }
}

fn title(painter: &Painter, rect: Rect, name: &str, look: &Look) {
    let galley = painter.layout_no_wrap(name.to_owned(), FontId::proportional(12.0), look.ink);
    let at = rect.min + vec2(4.0, 2.0);
    let paper = Rect::from_min_size(at, galley.size()).expand(2.0);
    painter.rect_filled(paper, 2.0, look.paper.gamma_multiply(0.85));
    painter.galley(at, galley, look.ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_goes_from_the_first_row_of_its_steps_to_the_row_behind_them() {
        assert_eq!(runs(&[true, true, false, true]), [0..2, 3..4]);
        assert!(runs(&[false]).is_empty());
        assert!(runs(&[]).is_empty());
    }

    #[test]
    fn a_lane_shows_all_of_the_filtered_curve_and_so_much_of_the_raw() {
        assert_eq!(range(&[1.0, 9.0], &[1.0, 2.0]), (0.0, 3.2));
        assert_eq!(range(&[1.0, 2.5], &[1.0, 2.0]), (0.0, 2.5));
        assert_eq!(range(&[0.0], &[0.0]), (0.0, 1.0), "what is still has a lane too");
        assert_eq!(range(&[-3.0, 1.0], &[-2.0, 1.0]), (-3.0, 1.0));
    }

    #[test]
    fn one_frame_that_flies_off_does_not_flatten_all_others() {
        let mut values: Vec<f64> = (0..400).map(|at| 10.0 + f64::from(at % 3)).collect();
        assert_eq!(range(&values, &values), (0.0, 12.0));
        values[200] = 900.0;
        assert_eq!(range(&values, &values), (0.0, OVER * 12.0));
        // A movement that lasts is no outlier, however still the rest of the clip is.
        values.iter_mut().take(20).for_each(|value| *value = 900.0);
        assert_eq!(range(&values, &values), (0.0, 900.0));
    }
}
