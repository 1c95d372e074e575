//! Draws the curve of one joint: measured and filtered, with keys and walls, over bands where it counts as steady.

use std::ops::Range;

use egui::{Align2, FontId, Painter, Pos2, Rect, Shape, Stroke, pos2, vec2};

use crate::label_culling::Room;
use crate::theme::Look;
use crate::time_axis::{Scale, across};
use crate::view_state::Shown;
use genga::motion::JointId;
use genga::signal::{Turn, TurnKind};

/// Raw peaks are cut off above this multiple of the filtered curve.
const OVER: f64 = 1.6;

/// Share of frames that counts as usual, and the multiple of their height above which the rest is cut off.
const USUAL: f64 = 0.99;
const OUTLIER: f64 = 3.0;
/// Number of frames sampled to find the usual height.
const LOOKS: usize = 4000;

/// Distance below which marks of turns cover each other, in points.
const CLOSEST: f32 = 2.0;
/// Average distance below which marks shrink, in points, and their smallest scale.
const ROOMY: f32 = 9.0;
const SMALLEST: f32 = 0.45;

/// Height of a lane below which the highest value is shown without its unit, in points.
const LOW: f32 = 22.0;

/// Height of a title in points.
const NAME: f32 = 15.0;

/// Least width of a band in points.
const THIN: f32 = 2.0;

/// Draws the lane of a joint. `steps` tells which of its steps are steady.
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

/// Draws an arrow wherever the curve leaves the lane.
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

/// Shades where the joint neither speeds up nor slows down (等速). Turns can only lie in unshaded parts.
fn steady(painter: &Painter, rect: Rect, steps: &[bool], time: &Scale, shown: &Shown<'_>) {
    let filtered = shown.breakdown.filtered;
    let x = |row: usize| time.x((filtered.first.0 + row) as f64);
    for run in runs(steps) {
        let (left, right) = (x(run.start).max(rect.min.x), x(run.end).min(rect.max.x));
        // Thinner bands would merge into a grey haze over a long clip.
        if right - left >= THIN {
            let band = Rect::from_x_y_ranges(left..=right, rect.y_range());
            painter.rect_filled(band, 0.0, shown.look.steady);
        }
    }
}

/// The stretches of `true`, as ranges of rows.
fn runs(steps: &[bool]) -> Vec<Range<usize>> {
    let mut at = 0;
    let stretch = |same: &[bool]| {
        let begin = at;
        at += same.len();
        same[0].then_some(begin..at)
    };
    steps.chunk_by(|a, b| a == b).filter_map(stretch).collect()
}

/// Lowest and highest value of a lane.
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

/// Greatest height of a curve that is drawn. If a few frames far exceed the rest, it is the height of the rest; else
/// infinite.
fn usual(values: &[f64]) -> f64 {
    // A sample suffices, and not every frame has to be sorted on each redraw.
    let step = values.len().div_ceil(LOOKS).max(1);
    let mut sizes: Vec<f64> = values.iter().step_by(step).map(|value| value.abs()).collect();
    let Some(last) = sizes.len().checked_sub(1) else { return f64::INFINITY };
    let at = (USUAL * last as f64).ceil() as usize;
    let usual = *sizes.select_nth_unstable_by(at, f64::total_cmp).1;
    let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    if usual > 0.0 && most > OUTLIER * usual { usual } else { f64::INFINITY }
}

/// Points of the curve in view. If many frames share a point of the window, only the lowest and highest are kept.
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
        // In the direction of the curve, so that the line does not go back.
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

/// Writes the highest value, and its unit if there is room.
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

/// Writes each lane's title in its upper left corner. A title that would touch the one above is skipped.
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
        // A movement that lasts is no outlier, even if the rest of the clip is still.
        values.iter_mut().take(20).for_each(|value| *value = 900.0);
        assert_eq!(range(&values, &values), (0.0, 900.0));
    }
}
