//! Computes the curves of a panel, as lines of points.

use serde::{Deserialize, Serialize};

use genga::signal::{Turn, TurnKind};
use genga::time::Frame;

/// The curves that a panel shows.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SpeedCurves {
    /// As measured and after the low pass. The default.
    #[default]
    Both,
    /// As measured [KT11 Fig. 3].
    Measured,
    /// After the low pass [KT11 Fig. 4].
    Filtered,
    /// After the low pass, and the measured speed reduced to the joint's keys: each key's speed stays up to
    /// the next [KT11 Fig. 6].
    Kept,
}

/// Width of the line reduced to the keys, in px.
pub(super) const KEPT: f64 = 1.5;

/// Splits the curve into lines of (row, value), broken where a value is not finite. If several frames share a
/// px, only the first, the least and the greatest of them remain, in their order. `px` maps a row to its x.
pub(super) fn runs(curve: &[f64], px: impl Fn(usize) -> f64) -> Vec<Vec<(usize, f64)>> {
    let mut runs = Vec::new();
    let mut at = 0;
    for run in curve.split(|value| !value.is_finite()) {
        if !run.is_empty() {
            let kept = thinned(run, |frame| px(at + frame));
            runs.push(kept.into_iter().map(|frame| (at + frame, run[frame])).collect());
        }
        at += run.len() + 1;
    }
    runs
}

/// Returns the frames that represent a curve: the first, the least and the greatest of each px, and the last
/// of all.
fn thinned(curve: &[f64], px: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut kept = Vec::new();
    let mut begin = 0;
    while begin < curve.len() {
        let column = px(begin).floor();
        let length =
            (begin..curve.len()).take_while(|frame| px(*frame).floor() == column).count().max(1);
        let end = begin + length;
        let by_value = |a: &usize, b: &usize| curve[*a].total_cmp(&curve[*b]);
        let least = (begin..end).min_by(by_value).unwrap_or(begin);
        let greatest = (begin..end).max_by(by_value).unwrap_or(begin);
        let mut of_column = [begin, least, greatest];
        of_column.sort_unstable();
        for frame in of_column {
            if kept.last() != Some(&frame) {
                kept.push(frame);
            }
        }
        begin = end;
    }
    let last = curve.len().saturating_sub(1);
    if kept.last().is_some_and(|kept| *kept != last) {
        kept.push(last);
    }
    kept
}

/// Reduces a curve to its keys, as (row, value). Each key's own value stays up to the next key, where the
/// line turns at a right angle. The value of the first row stays up to the first key. Values that are not
/// finite are skipped.
pub(super) fn kept(curve: &[f64], turns: &[Turn], first: Frame) -> Vec<(usize, f64)> {
    let row = |turn: &Turn| turn.frame.0.checked_sub(first.0).filter(|row| *row < curve.len());
    let keys = turns.iter().filter(|turn| turn.kind == TurnKind::Key).filter_map(row);
    let mut corners: Vec<(usize, f64)> = Vec::new();
    for row in std::iter::once(0).chain(keys) {
        let Some(&value) = curve.get(row).filter(|value| value.is_finite()) else { continue };
        corners.extend(corners.last().map(|(_, before)| (row, *before)));
        corners.push((row, value));
    }
    corners.extend(corners.last().map(|(_, before)| (curve.len() - 1, *before)));
    corners
}
