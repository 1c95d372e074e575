use std::f64::consts::PI;

use proptest::prelude::*;

use super::*;
use crate::motion::{Axis, Channel, Joint, JointId, Skeleton};
use crate::time::FrameRate;

const ZXY: [Channel; 3] =
    [Channel::Rotation(Axis::Z), Channel::Rotation(Axis::X), Channel::Rotation(Axis::Y)];

/// A chain of joints, each one unit above its parent.
fn chain(joints: &[&[Channel]]) -> Skeleton {
    let mut first_channel = 0;
    let joint = |(at, channels): (usize, &&[Channel])| {
        let joint = Joint {
            name: format!("joint {at}"),
            parent: at.checked_sub(1).map(JointId),
            offset: DVec3::Y,
            channels: channels.to_vec(),
            first_channel,
            end_sites: vec![],
        };
        first_channel += channels.len();
        joint
    };
    Skeleton { joints: joints.iter().enumerate().map(joint).collect() }
}

fn clip(skeleton: Skeleton, fps: f64, rows: &[Vec<f64>]) -> Clip {
    let rate = FrameRate::new(fps).unwrap();
    Clip::new(skeleton, rate, Frame(7), rows.len(), rows.concat()).unwrap()
}

fn measured(measure: Measure, clip: &Clip) -> Signals {
    Speed { measure }.measure(clip).unwrap()
}

const ALL: [Measure; 4] =
    [Measure::Rotation, Measure::Displacement, Measure::Combined, Measure::Angle];

#[test]
fn settings_refuse_an_unknown_measure_and_an_unknown_name() {
    assert!(toml::from_str::<Speed>("measure = \"combined\"").is_ok());
    assert!(toml::from_str::<Speed>("measure = \"velocity\"").is_err());
    assert!(toml::from_str::<Speed>("mesure = \"angle\"").is_err());
    assert_eq!(Speed::default().measure, Measure::Rotation);
}

#[test]
fn a_constant_spin_reads_its_rate() {
    for spin in [1e-6, 1e-3, 0.5] {
        let row = |frame: i32| vec![30.0, -20.0, (f64::from(frame) * spin / 120.0).to_degrees()];
        let clip = clip(chain(&[&ZXY]), 120.0, &(0..300).map(row).collect::<Vec<_>>());
        for value in &measured(Measure::Rotation, &clip).values {
            assert!((value - spin).abs() < 1e-9, "{value} for {spin}");
        }
    }
}

#[test]
fn degenerate_clips_have_their_shape_and_no_speed() {
    for measure in ALL {
        for frames in [0, 1] {
            let clip = clip(chain(&[&ZXY, &ZXY]), 24.0, &vec![vec![5.0; 6]; frames]);
            let signals = measured(measure, &clip);
            assert_eq!(signals.values, DMatrix::zeros(frames, 2), "{measure:?}");
            assert_eq!(signals.first, Frame(7));
        }
        let clip = clip(Skeleton::default(), 24.0, &[vec![], vec![]]);
        assert_eq!(measured(measure, &clip).values.shape(), (2, 0));
    }
}

#[test]
fn the_first_frame_repeats_the_second() {
    let rows = [vec![0.0, 0.0, 0.0, 0.0], vec![2.0, 0.0, 0.0, 9.0], vec![3.0, 0.0, 0.0, 1.0]];
    let joint = [Channel::Position(Axis::X), ZXY[0], ZXY[1], ZXY[2]];
    let clip = clip(chain(&[&joint]), 10.0, &rows);
    for measure in ALL {
        let values = measured(measure, &clip).values;
        assert!(
            values[0] != 0.0 && values[0] == values[1] && values[1] != values[2],
            "{measure:?}"
        );
    }
}

#[test]
fn a_whole_turn_in_the_angles_is_no_movement() {
    let rows = [vec![179.0, 0.0, 0.0], vec![-179.0, 0.0, 0.0], vec![541.0, 0.0, 0.0]];
    let values = measured(Measure::Rotation, &clip(chain(&[&ZXY]), 1.0, &rows)).values;
    assert!((values[1] - 2f64.to_radians()).abs() < 1e-14);
    assert!(values[2].abs() < 1e-13, "{}", values[2]);
}

#[test]
fn displacement_is_the_way_of_the_joint_in_the_world() {
    let root = [Channel::Position(Axis::X), Channel::Rotation(Axis::Z)];
    let rows = [vec![0.0, 0.0], vec![3.0, 0.0], vec![3.0, 90.0]];
    let signals = measured(Measure::Displacement, &clip(chain(&[&root, &[]]), 10.0, &rows));
    assert_eq!(signals.unit, Quantity::Length);
    assert_eq!(signals.joint(JointId(0)), [30.0, 30.0, 0.0]);
    let carried = signals.joint(JointId(1));
    assert!((carried[1] - 30.0).abs() < 1e-12);
    assert!((carried[2] - 10.0 * 2f64.sqrt()).abs() < 1e-12, "the chord of a quarter turn");
}

#[test]
fn combined_adds_both_in_units_of_their_own_rms() {
    let root = [Channel::Position(Axis::X), Channel::Rotation(Axis::Z)];
    let rows = [vec![0.0, 0.0], vec![1.0, 0.0], vec![1.0, 50.0]];
    let signals = measured(Measure::Combined, &clip(chain(&[&root]), 30.0, &rows));
    assert_eq!(signals.unit, Quantity::Ratio);
    for value in &signals.values {
        assert!((value - 2f64.sqrt()).abs() < 1e-12, "one of two steps each: {value}");
    }
    let still = clip(chain(&[&root]), 30.0, &vec![vec![1.0, 2.0]; 4]);
    assert_eq!(measured(Measure::Combined, &still).values, DMatrix::zeros(4, 1));
    let only_turning = clip(chain(&[&root]), 30.0, &[vec![0.0, 0.0], vec![0.0, 9.0]]);
    assert!(
        measured(Measure::Combined, &only_turning).values.iter().all(|v| (v - 1.0).abs() < 1e-12)
    );
}

#[test]
fn combined_keeps_joints_comparable() {
    let turns = [Channel::Rotation(Axis::Z)];
    let rows = [vec![0.0, 0.0], vec![10.0, 1.0], vec![20.0, 2.0]];
    let values = measured(Measure::Combined, &clip(chain(&[&turns, &turns]), 30.0, &rows)).values;
    assert!(values[(1, 0)] > 1.0 && values[(1, 0)] > values[(1, 1)] / 10.0);
    let rms = ((100.0 + 1.0) / 2f64).sqrt();
    assert!((values[(1, 0)] - 10.0 / rms).abs() < 1e-12, "the root turns and does not travel");
}

#[test]
fn the_signed_angle_falls_as_well_as_rises() {
    let row = |degrees: f64| vec![degrees, 0.0, 0.0];
    let rows = [row(0.0), row(10.0), row(4.0), row(-4.0)];
    let signals = measured(Measure::Angle, &clip(chain(&[&ZXY]), 2.0, &rows));
    let degrees: Vec<f64> = signals.values.iter().map(|v| v * 180.0 / PI).collect();
    for (found, expected) in degrees.iter().zip([20.0, 20.0, -12.0, 0.0]) {
        assert!((found - expected).abs() < 1e-12, "{degrees:?}");
    }
}

#[test]
fn a_speed_that_is_not_finite_is_an_error() {
    let root = [Channel::Position(Axis::X)];
    let clip = clip(chain(&[&root]), 30.0, &[vec![-1e308], vec![1e308]]);
    assert!(matches!(
        Speed { measure: Measure::Displacement }.measure(&clip),
        Err(Error::Clip { .. })
    ));
    assert!(matches!(Speed { measure: Measure::Combined }.measure(&clip), Err(Error::Clip { .. })));
}

proptest! {
    /// 180° more on the outer two and 180° minus the middle angle is the same rotation, with −q.
    #[test]
    fn q_and_minus_q_have_the_same_speed(
        rows in prop::collection::vec(prop::collection::vec(-400.0..400.0, 3), 2..12),
        flips in prop::collection::vec(prop::bool::ANY, 12),
    ) {
        let flipped: Vec<_> = rows.iter().zip(&flips).map(|(row, flip): (&Vec<f64>, _)| {
            if *flip { vec![row[0] + 360.0, row[1], row[2]] } else { row.clone() }
        }).collect();
        let written_otherwise: Vec<_> = rows.iter().zip(&flips).map(|(row, flip)| {
            if *flip { vec![row[0] + 180.0, 180.0 - row[1], row[2] + 180.0] } else { row.clone() }
        }).collect();
        for measure in [Measure::Rotation, Measure::Angle] {
            let plain = measured(measure, &clip(chain(&[&ZXY]), 24.0, &rows)).values;
            for other in [&flipped, &written_otherwise] {
                let other = measured(measure, &clip(chain(&[&ZXY]), 24.0, other)).values;
                prop_assert!((&plain - other).amax() < 1e-11);
            }
        }
    }

    /// Compares every step with one pose after the other: blocks, their seams and a last block that is not full; near
    /// angles, far ones, and lists of channels that are not three axes.
    #[test]
    fn every_step_is_the_angle_from_one_pose_to_the_next(
        values in prop::collection::vec(prop_oneof![-80.0..80.0, -80.0..80.0, -800.0..800.0], 14 * 40),
        frames in 2usize..40,
    ) {
        let turn = |axis| Channel::Rotation(axis);
        let root = [turn(Axis::Y), Channel::Position(Axis::X), turn(Axis::X), turn(Axis::Z)];
        let twice = [turn(Axis::Z), turn(Axis::X), turn(Axis::Z)];
        let skeleton = chain(&[&root, &ZXY, &[], &twice, &ZXY[..1], &ZXY]);
        let rows: Vec<Vec<f64>> = values.chunks(14).take(frames).map(<[f64]>::to_vec).collect();
        let clip = clip(skeleton, 1.0, &rows);
        let found = measured(Measure::Rotation, &clip).values;
        for (joint, data) in clip.skeleton().joints.iter().enumerate() {
            for (row, step) in (1..).zip(rows.windows(2)) {
                let way = local_rotation(data, &step[0]).conjugate() * local_rotation(data, &step[1]);
                let (found, expected) = (found[(row, joint)], angle_of(way));
                prop_assert!((found - expected).abs() < 1e-12, "{joint} {row}: {found} {expected}");
            }
        }
    }

    /// The slow way: rotation matrices, and the angle from their trace and skew part.
    #[test]
    fn rotation_is_the_angle_between_rotation_matrices(
        rows in prop::collection::vec(prop::collection::vec(-400.0..400.0, 3), 2..6),
    ) {
        let values = measured(Measure::Rotation, &clip(chain(&[&ZXY]), 1.0, &rows)).values;
        let matrix = |row: &[f64]| {
            glam::DMat3::from_rotation_z(row[0].to_radians())
                * glam::DMat3::from_rotation_x(row[1].to_radians())
                * glam::DMat3::from_rotation_y(row[2].to_radians())
        };
        for (step, value) in rows.windows(2).zip(values.iter().skip(1)) {
            let d = matrix(&step[0]).transpose() * matrix(&step[1]);
            let skew = DVec3::new(
                d.y_axis.z - d.z_axis.y,
                d.z_axis.x - d.x_axis.z,
                d.x_axis.y - d.y_axis.x,
            );
            let trace = d.x_axis.x + d.y_axis.y + d.z_axis.z;
            let expected = skew.length().atan2(trace - 1.0);
            prop_assert!((value - expected).abs() < 1e-10, "{value} {expected}");
        }
    }
}
