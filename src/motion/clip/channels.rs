//! Converts poses back into channel values, the file's own terms.

use glam::{DMat3, DQuat};

use crate::maths;
use crate::motion::{Axis, Channel, Clip, Joint, Poser};
use crate::sheet::Source;
use crate::time::Frame;

/// Writes drawings as rows of channel values. Reuses its buffers.
#[derive(Debug, Clone)]
pub struct RowWriter<'a> {
    poser: Poser<'a>,
}

impl<'a> RowWriter<'a> {
    /// Creates a writer for drawings of a clip.
    pub fn new(clip: &'a Clip) -> Self {
        Self { poser: Poser::new(clip) }
    }

    /// Writes a drawing into `row`, as wide as the skeleton has channels. A source frame comes out as the numbers it
    /// was read from. An instant between frames is slerped. Its angles are the ones nearest to those of the frame
    /// before, so that they continue past ±180° as in the file.
    pub fn write(&mut self, source: Source, row: &mut [f64]) {
        let clip = self.poser.clip();
        let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
        let place = source.place().clamp(first, last);
        let before = clip.row(Frame(place.floor() as usize));
        if let (Source::At(_), true) = (source, place.fract() == 0.0) {
            row.copy_from_slice(before);
            return;
        }
        let after = clip.row(Frame((place.floor() as usize + 1).min(clip.last().0)));
        self.poser.drawing(source);
        for (index, joint) in clip.skeleton().joints.iter().enumerate() {
            let columns = joint.first_channel..joint.first_channel + joint.channels.len();
            let (before, after) = (&before[columns.clone()], &after[columns.clone()]);
            if before == after && matches!(source, Source::At(_)) {
                // Between equal frames a joint keeps its numbers: converting to a pose and back would add rounding
                // errors.
                row[columns].copy_from_slice(before);
                continue;
            }
            self.write_joint(index, joint, [before, after], place.fract(), &mut row[columns]);
        }
    }

    fn write_joint(
        &self,
        index: usize,
        joint: &Joint,
        rows: [&[f64]; 2],
        share: f64,
        row: &mut [f64],
    ) {
        let [before, after] = rows;
        let pose = self.poser.pose();
        let translation = pose.translations[index];
        let angles = rotation_axes(joint)
            .map(|axes| angles_from_rotation(pose.rotations[index], axes, &near(joint, before)));
        let mut rotations = 0..3;
        for (at, channel) in joint.channels.iter().enumerate() {
            row[at] = match (channel, &angles) {
                (Channel::Position(Axis::X), _) => translation.x,
                (Channel::Position(Axis::Y), _) => translation.y,
                (Channel::Position(Axis::Z), _) => translation.z,
                (Channel::Rotation(_), Some(angles)) => angles[rotations.next().unwrap_or(2)],
                // Fewer than three axes, or one axis twice, cannot follow a slerp exactly: each angle is interpolated
                // linearly.
                (Channel::Rotation(_), None) => before[at] + share * (after[at] - before[at]),
            };
        }
    }
}

/// Writes a rotation into the columns of a joint that turns about three different axes. Of all equivalent triples of
/// angles it picks the one nearest to the present values.
pub(crate) fn turn_columns(joint: &Joint, axes: [Axis; 3], rotation: DQuat, columns: &mut [f64]) {
    let angles = angles_from_rotation(rotation, axes, &near(joint, columns));
    let is_rotation = |channel: &Channel| matches!(channel, Channel::Rotation(_));
    let turned = joint.channels.iter().zip(columns).filter(|(channel, _)| is_rotation(channel));
    turned.zip(angles).for_each(|((_, value), angle)| *value = angle);
}

/// Writes a rotation into a joint's columns of a row as wide as the skeleton, in degrees: the inverse of
/// [`local_rotation`](crate::motion::local_rotation). Of all equivalent triples of angles it picks the one nearest to
/// the present values. Returns whether it could: only a joint with three different axes can express every rotation.
pub fn set_local_rotation(joint: &Joint, rotation: DQuat, row: &mut [f64]) -> bool {
    let columns = joint.first_channel..joint.first_channel + joint.channels.len();
    let axes = rotation_axes(joint);
    if let Some(axes) = axes {
        turn_columns(joint, axes, rotation, &mut row[columns]);
    }
    axes.is_some()
}

/// Returns the axes of a joint's rotations, in the order listed, if they are three different ones.
pub(crate) fn rotation_axes(joint: &Joint) -> Option<[Axis; 3]> {
    let mut axes = joint.channels.iter().filter_map(|channel| match channel {
        Channel::Rotation(axis) => Some(*axis),
        Channel::Position(_) => None,
    });
    let three = [axes.next()?, axes.next()?, axes.next()?];
    let [a, b, c] = three;
    (axes.next().is_none() && a != b && b != c && a != c).then_some(three)
}

/// Returns the rotation values in a joint's part of a row.
fn near(joint: &Joint, row: &[f64]) -> [f64; 3] {
    let mut near = [0.0; 3];
    let rotations =
        joint.channels.iter().zip(row).filter_map(|(channel, value)| {
            matches!(channel, Channel::Rotation(_)).then_some(*value)
        });
    near.iter_mut().zip(rotations).for_each(|(near, value)| *near = value);
    near
}

/// Computes the angles in degrees whose product about `axes`, left to right, is `rotation`. Of all such triples it
/// returns the one nearest to `near`.
fn angles_from_rotation(rotation: DQuat, axes: [Axis; 3], near: &[f64; 3]) -> [f64; 3] {
    let matrix = DMat3::from_quat(rotation);
    let [i, j, k] = axes.map(|axis| axis as usize);
    let sign = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
    let entry = |row: usize, column: usize| matrix.col(column)[row];
    let sine = (sign * entry(i, k)).clamp(-1.0, 1.0);
    if sine.abs() > 1.0 - 1e-12 {
        return locked(&entry, [i, j, k], sign, sine, near);
    }
    let first = maths::atan2(-sign * entry(j, k), entry(k, k)).to_degrees();
    let second = maths::asin(sine).to_degrees();
    let third = maths::atan2(-sign * entry(i, j), entry(i, i)).to_degrees();
    let direct = unwrapped([first, second, third], near);
    let other = unwrapped([first + 180.0, 180.0 - second, third + 180.0], near);
    if distance(&direct, near) <= distance(&other, near) { direct } else { other }
}

/// Handles gimbal lock: only the sum or the difference of the first and third angle is known, so the first keeps its
/// value.
fn locked(
    entry: &impl Fn(usize, usize) -> f64,
    [i, j, _]: [usize; 3],
    sign: f64,
    sine: f64,
    near: &[f64; 3],
) -> [f64; 3] {
    let together = maths::atan2(sign * entry(j, i), entry(j, j)).to_degrees();
    unwrapped(
        [near[0], maths::asin(sine).to_degrees(), together - sign * sine.signum() * near[0]],
        near,
    )
}

fn unwrapped(angles: [f64; 3], near: &[f64; 3]) -> [f64; 3] {
    let mut angles = angles;
    for (angle, near) in angles.iter_mut().zip(near) {
        *angle -= 360.0 * ((*angle - near) / 360.0).round();
    }
    angles
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum()
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;
    use crate::motion::{Skeleton, local_rotation};
    use crate::time::FrameRate;

    const ORDERS: [[Axis; 3]; 6] = [
        [Axis::X, Axis::Y, Axis::Z],
        [Axis::X, Axis::Z, Axis::Y],
        [Axis::Y, Axis::X, Axis::Z],
        [Axis::Y, Axis::Z, Axis::X],
        [Axis::Z, Axis::X, Axis::Y],
        [Axis::Z, Axis::Y, Axis::X],
    ];

    fn joint(axes: &[Axis]) -> Joint {
        Joint {
            name: "joint".into(),
            parent: None,
            offset: DVec3::ZERO,
            channels: axes.iter().copied().map(Channel::Rotation).collect(),
            first_channel: 0,
            end_sites: vec![],
        }
    }

    fn same(a: DQuat, b: DQuat) -> bool {
        a.dot(b).abs() > 1.0 - 1e-9
    }

    proptest! {
        #[test]
        fn angles_give_the_rotation_they_were_taken_from(
            order in 0usize..6,
            angles in prop::array::uniform3(-400.0f64..400.0),
            near in prop::array::uniform3(-400.0f64..400.0),
        ) {
            let joint = joint(&ORDERS[order]);
            let rotation = local_rotation(&joint, &angles);
            let again = angles_from_rotation(rotation, ORDERS[order], &near);
            prop_assert!(same(local_rotation(&joint, &again), rotation), "{angles:?} {again:?}");
            let mut row = near;
            prop_assert!(set_local_rotation(&joint, rotation, &mut row));
            prop_assert_eq!(row, again);
            let kept = angles_from_rotation(rotation, ORDERS[order], &angles);
            prop_assert!(distance(&kept, &angles) < 1e-5, "{angles:?} {kept:?}");
        }

        #[test]
        fn a_locked_gimbal_still_gives_the_rotation(
            order in 0usize..6,
            first in -180.0f64..180.0,
            third in -180.0f64..180.0,
            up in any::<bool>(),
        ) {
            let joint = joint(&ORDERS[order]);
            let angles = [first, if up { 90.0 } else { -90.0 }, third];
            let rotation = local_rotation(&joint, &angles);
            let again = angles_from_rotation(rotation, ORDERS[order], &[first, 80.0, 0.0]);
            prop_assert!(same(local_rotation(&joint, &again), rotation), "{angles:?} {again:?}");
        }
    }

    fn clip(axes: &[Axis], values: &[f64]) -> Clip {
        let skeleton = Skeleton { joints: vec![joint(axes)] };
        let frames = values.len() / axes.len();
        Clip::new(skeleton, FrameRate::new(24.0).unwrap(), Frame(3), frames, values.to_vec())
            .unwrap()
    }

    #[test]
    fn a_joint_of_two_axes_is_left_as_it_is() {
        let mut row = [1.0, 2.0];
        assert!(!set_local_rotation(&joint(&[Axis::X, Axis::Y]), DQuat::IDENTITY, &mut row));
        assert_eq!(row, [1.0, 2.0]);
    }

    #[test]
    fn a_source_frame_comes_out_digit_for_digit() {
        let values = [100.1, 400.7, -0.3, 0.1, 0.2, 0.3];
        let clip = clip(&ORDERS[4], &values);
        let mut row = [0.0; 3];
        RowWriter::new(&clip).write(Source::At(3.0), &mut row);
        assert_eq!(row, values[..3]);
        RowWriter::new(&clip).write(Source::At(99.0), &mut row);
        assert_eq!(row, values[3..], "past the end is the last frame");
    }

    #[test]
    fn an_instant_between_frames_runs_on_past_half_a_turn() {
        let clip = clip(&ORDERS[5], &[178.0, 0.0, 0.0, 190.0, 0.0, 0.0]);
        let mut row = [0.0; 3];
        RowWriter::new(&clip).write(Source::At(3.5), &mut row);
        assert!((row[0] - 184.0).abs() < 1e-9, "{row:?}");
    }

    #[test]
    fn an_instant_between_equal_frames_keeps_their_digits() {
        let values = [100.1, 400.7, -0.3];
        let clip = clip(&ORDERS[4], &[values, values].concat());
        let mut row = [0.0; 3];
        RowWriter::new(&clip).write(Source::At(3.3), &mut row);
        assert_eq!(row, values);
    }

    #[test]
    fn a_blend_is_the_slerp_of_its_keys_and_fewer_axes_go_straight() {
        let wide = clip(&ORDERS[0], &[0.0, 0.0, 0.0, 80.0, 0.0, 0.0, 20.0, 0.0, 0.0]);
        let mut row = [0.0; 3];
        RowWriter::new(&wide).write(Source::Between { from: 3.0, to: 5.0, share: 0.5 }, &mut row);
        assert!((row[0] - 10.0).abs() < 1e-9, "{row:?}");
        let narrow = clip(&[Axis::X], &[10.0, 20.0]);
        let mut row = [0.0];
        RowWriter::new(&narrow).write(Source::At(3.25), &mut row);
        assert_eq!(row, [12.5]);
        let twice = clip(&[Axis::X, Axis::Y, Axis::X], &[10.0, 30.0, 10.0, 20.0, 40.0, 20.0]);
        let mut row = [0.0; 3];
        RowWriter::new(&twice).write(Source::At(3.25), &mut row);
        assert_eq!(row, [12.5, 32.5, 12.5], "one axis twice is no three axes");
    }

    #[test]
    fn a_blend_over_equal_frames_is_a_blend_of_its_keys() {
        let angles = [0.0, 80.0, 80.0, 20.0];
        let clip = clip(&ORDERS[0], &angles.map(|angle| [angle, 0.0, 0.0]).concat());
        let mut row = [0.0; 3];
        RowWriter::new(&clip).write(Source::Between { from: 3.0, to: 6.0, share: 0.5 }, &mut row);
        assert!((row[0] - 10.0).abs() < 1e-9, "{row:?}");
    }

    #[test]
    fn a_position_between_frames_goes_straight() {
        let positions = [Axis::Z, Axis::X, Axis::Y].map(Channel::Position);
        let joint = Joint { channels: positions.to_vec(), ..joint(&[]) };
        let values = vec![1.0, 10.0, 100.0, 2.0, 20.0, 200.0];
        let rate = FrameRate::new(24.0).unwrap();
        let clip = Clip::new(Skeleton { joints: vec![joint] }, rate, Frame(3), 2, values).unwrap();
        let mut row = [0.0; 3];
        RowWriter::new(&clip).write(Source::At(3.5), &mut row);
        assert_eq!(row, [1.5, 15.0, 150.0]);
    }
}
