//! One curve for the whole layer: the joints' speeds are added before turns are looked for.

use nalgebra::DMatrix;

use crate::maths;
use crate::signal::{Signals, Turn, TurnKind};
use crate::time::Frame;

/// The weighted mean of the joints' speeds, a one-column signal: Σ wⱼ·ωⱼ / Σ wⱼ.
///
/// A mean and not the bare sum, so that a steady band in °/s² means for the layer what it means for a
/// joint. The filter is linear: the mean of filtered speeds is the filtered mean.
pub(super) fn mean_speed(filtered: &Signals, weights: &[f64]) -> Signals {
    let mut mean = vec![0.0; filtered.frames()];
    let all_weight: f64 = weights.iter().sum();
    if all_weight > 0.0 {
        for (column, weight) in filtered.values.column_iter().zip(weights) {
            let share = weight / all_weight;
            mean.iter_mut().zip(column.iter()).for_each(|(mean, speed)| *mean += share * speed);
        }
    }
    Signals { values: DMatrix::from_vec(mean.len(), 1, mean), ..*filtered }
}

/// The turns of a kind with their strength: for keys the prominence of their valley in
/// ln(S + 0.02 · median S), how much the motion slows there against what is around it; for walls that
/// of their hill. Turns with no turn of the other kind between them belong to one valley.
pub(super) fn prominences(
    mean: &Signals,
    turns: &[Turn],
    kind: TurnKind,
    margin: usize,
) -> Vec<(Frame, f64)> {
    let height = log_curve(mean, kind);
    let mut found = Vec::new();
    for group in turns.chunk_by(|a, b| a.kind == b.kind).filter(|group| group[0].kind == kind) {
        let row = |turn: &Turn| turn.frame.0 - mean.first.0;
        let begin = row(&group[0]).saturating_sub(margin);
        let end = (row(&group[group.len() - 1]) + margin + 1).min(height.len());
        let prominence = prominence(&height, begin, end);
        found.extend(group.iter().map(|turn| (turn.frame, prominence)));
    }
    found
}

/// The curve in which a turn of that kind is a minimum.
fn log_curve(mean: &Signals, kind: TurnKind) -> Vec<f64> {
    let speed = mean.values.as_slice();
    let mut sorted = speed.to_vec();
    sorted.sort_by(f64::total_cmp);
    let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
    let ground = 0.02 * median.max(f64::MIN_POSITIVE);
    let sign = if kind == TurnKind::Key { 1.0 } else { -1.0 };
    speed.iter().map(|speed| sign * maths::ln(speed.max(0.0) + ground)).collect()
}

/// How far one has to climb from the lowest point of `begin..end` to get to lower ground, on the
/// easier side; a side without lower ground counts up to its highest point.
fn prominence(height: &[f64], begin: usize, end: usize) -> f64 {
    let bottom = height[begin..end].iter().copied().fold(f64::INFINITY, f64::min);
    let climb = |way: &mut dyn Iterator<Item = &f64>| {
        way.take_while(|height| **height >= bottom).copied().fold(bottom, f64::max)
    };
    let before = climb(&mut height[..begin].iter().rev());
    let after = climb(&mut height[end..].iter());
    before.min(after) - bottom
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::Quantity;
    use crate::time::FrameRate;

    fn signals(columns: &[&[f64]]) -> Signals {
        Signals {
            values: DMatrix::from_vec(columns[0].len(), columns.len(), columns.concat()),
            unit: Quantity::Angle,
            rate: FrameRate::new(24.0).unwrap(),
            first: Frame(10),
        }
    }

    #[test]
    fn the_mean_is_weighted() {
        let mean = mean_speed(&signals(&[&[1.0, 2.0], &[5.0, 10.0]]), &[3.0, 1.0]);
        assert_eq!(mean.values.as_slice(), [2.0, 4.0]);
        let nobody = mean_speed(&signals(&[&[1.0, 2.0]]), &[0.0]);
        assert_eq!(nobody.values.as_slice(), [0.0, 0.0]);
    }

    #[test]
    fn a_prominence_is_the_easier_climb_to_lower_ground() {
        let height = [0.0, 5.0, 1.0, 3.0, 0.5, 9.0];
        assert_eq!(prominence(&height, 2, 3), 2.0, "over the 3 to the 0.5");
        assert_eq!(prominence(&height, 4, 5), 4.5, "over the 5 to the 0; the 9 ends nowhere");
    }

    #[test]
    fn an_end_and_a_start_of_one_rest_share_its_prominence() {
        let speed = signals(&[&[8.0, 4.0, 1.0, 1.2, 1.1, 4.0, 8.0, 2.0]]);
        let turn = |frame, kind| Turn { frame: Frame(frame), kind, confirmed_for: 1 };
        let turns = [
            turn(12, TurnKind::Key),
            turn(14, TurnKind::Key),
            turn(16, TurnKind::Wall),
            turn(17, TurnKind::Key),
        ];
        let keys = prominences(&speed, &turns, TurnKind::Key, 0);
        assert_eq!(keys.len(), 3);
        assert_eq!(keys[0].1, keys[1].1);
        assert!(keys[0].1 > 1.5, "{keys:?}");
        assert!(prominences(&speed, &turns, TurnKind::Wall, 0)[0].1 > 1.0);
    }
}
