use std::f64::consts::TAU;

use super::*;

/// Instants a second, two a koma.
const RATE: f64 = 48.0;

/// To and fro along X, so far to each side, once a second.
fn to_and_fro(far: f64, seconds: f64) -> Vec<DVec3> {
    let instants = (RATE * seconds) as usize;
    (0..instants).map(|at| far * (TAU * at as f64 / RATE).sin() * DVec3::X).collect()
}

#[test]
fn what_gets_far_enough_acts_and_its_short_stops_are_a_part_of_it() {
    let found = when(&to_and_fro(2.5, 3.0), RATE, [false; 2]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].start < 3 && found[0].end > 140, "{found:?}");
    assert!(when(&to_and_fro(1.5, 3.0), RATE, [false; 2]).is_empty(), "not far enough");
    let slow: Vec<DVec3> = (0..480).map(|at| 0.02 * f64::from(at) * DVec3::Y).collect();
    assert!(when(&slow, RATE, [false; 2]).is_empty(), "one second for one percent");
}

#[test]
fn a_long_stop_parts_two_acts() {
    let (act, held) = (to_and_fro(3.0, 1.0), vec![DVec3::ZERO; 60]);
    let found = when(&[&act[..], &held, &act].concat(), RATE, [false; 2]);
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(found[0].end < 60 && found[1].start > 95, "{found:?}");
}

#[test]
fn what_comes_to_rest_with_the_body_is_no_act() {
    let settling: Vec<DVec3> =
        (0..96).map(|at| -9.0 * (-f64::from(at) / 12.0).exp() * DVec3::X).collect();
    assert_eq!(when(&settling, RATE, [false; 2]).len(), 1, "at the begin of a clip it acts");
    assert!(when(&settling, RATE, [true, false]).is_empty());
    let setting_out: Vec<DVec3> = settling.into_iter().rev().collect();
    assert!(when(&setting_out, RATE, [false, true]).is_empty());
}

#[test]
fn a_turn_is_its_axis_times_its_angle_the_short_way() {
    for degrees in [0.0_f64, 1e-7, 20.0, 179.0, -60.0] {
        let angle = degrees.to_radians();
        let turn = DQuat::from_rotation_z(angle);
        for turn in [turn, -turn] {
            assert!((vector(turn) - angle * DVec3::Z).length() < 1e-12, "{degrees}");
        }
    }
}

#[test]
fn reach_is_from_one_extreme_to_the_other() {
    assert!((reach(&to_and_fro(2.0, 2.0)) - 4.0).abs() < 0.02);
    assert_eq!(reach(&[DVec3::ONE; 3]), 0.0);
}
