//! The direction in which a body faces (向き), from instant to instant.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::maths;

/// Least horizontal share of the lines across the body for a known heading: below it, somebody lies on a side.
const LEVEL: f64 = 0.3;

/// Returns the heading at each instant in radians about Y, counting whole turns, from the lines through both hips and
/// both shoulders, each of length 1. While they stand upright, the heading is interpolated between the known ones.
pub(super) fn headings(across: &[[DVec3; 2]]) -> Vec<f64> {
    // A file may begin with the left leg and the right arm.
    let agree: f64 = across.iter().map(|[hips, shoulders]| hips.dot(*shoulders)).sum();
    let side = if agree < 0.0 { -1.0 } else { 1.0 };
    let way = |[hips, shoulders]: &[DVec3; 2]| (*hips + side * *shoulders) / 2.0;
    let facing = |line: &[DVec3; 2]| {
        let way = way(line);
        (maths::hypot(way.x, way.z) >= LEVEL).then(|| maths::atan2(way.z, way.x))
    };
    let mut headings = Vec::with_capacity(across.len());
    let mut known: Option<f64> = None;
    for heading in across.iter().map(facing) {
        let Some(heading) = heading else {
            headings.push(f64::NAN);
            continue;
        };
        let heading = known.map_or(heading, |before| nearest_turn(heading, before));
        known = Some(heading);
        headings.push(heading);
    }
    bridged(headings)
}

/// Returns the angle nearest to `other` that is a whole number of turns from `angle`.
fn nearest_turn(angle: f64, other: f64) -> f64 {
    angle + TAU * ((other - angle) / TAU).round()
}

/// Fills unknown values by linear interpolation; at the ends, with the nearest known one.
fn bridged(mut values: Vec<f64>) -> Vec<f64> {
    let mut at = 0;
    let mut before: Option<f64> = None;
    while at < values.len() {
        if !values[at].is_nan() {
            before = Some(values[at]);
            at += 1;
            continue;
        }
        let gap = values[at..].iter().take_while(|value| value.is_nan()).count();
        let after = values.get(at + gap).copied();
        let (from, to) = match (before, after) {
            (Some(from), Some(to)) => (from, to),
            (Some(known), None) | (None, Some(known)) => (known, known),
            (None, None) => (0.0, 0.0),
        };
        for step in 0..gap {
            values[at + step] = from + (to - from) * (step + 1) as f64 / (gap + 1) as f64;
        }
        at += gap;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the lines across a body that faces `degrees` about Y, tipped up by `tipped` degrees.
    fn facing(degrees: f64, tipped: f64) -> [DVec3; 2] {
        let (angle, tipped) = (degrees.to_radians(), tipped.to_radians());
        let level = DVec3::new(angle.cos(), 0.0, angle.sin()) * tipped.cos();
        [level + DVec3::Y * tipped.sin(); 2]
    }

    fn degrees(across: &[[DVec3; 2]]) -> Vec<f64> {
        headings(across).iter().map(|heading| heading.to_degrees().round()).collect()
    }

    #[test]
    fn whole_turns_are_counted() {
        let spin: Vec<_> = (0..20).map(|at| facing(50.0 * f64::from(at), 0.0)).collect();
        let expected: Vec<f64> = (0..20).map(|at| 50.0 * f64::from(at)).collect();
        assert_eq!(degrees(&spin), expected);
    }

    #[test]
    fn a_body_on_its_side_turns_evenly_from_one_known_heading_to_the_next() {
        let lying = |degrees| facing(degrees, 89.0);
        let roll = [lying(170.0), facing(10.0, 0.0), lying(99.0), lying(-99.0), facing(40.0, 5.0)];
        assert_eq!(degrees(&roll), [10.0, 10.0, 20.0, 30.0, 40.0]);
        assert_eq!(degrees(&[facing(30.0, 0.0), lying(80.0)]), [30.0, 30.0]);
        assert_eq!(degrees(&[lying(80.0); 2]), [0.0, 0.0], "nobody knows");
        assert!(headings(&[]).is_empty());
    }

    #[test]
    fn hips_and_shoulders_may_be_written_from_different_sides() {
        let [hips, shoulders] = facing(25.0, 0.0);
        assert_eq!(degrees(&[[hips, -shoulders]]), [25.0]);
    }
}
