//! Computes several instants of a clip at once: local poses, their blends and the position of every joint.
//!
//! The vector counterpart of [`Poser`](super::Poser) and [`Body`](super::Body), which compute one instant.

use std::array;

use crate::motion::Clip;
use crate::motion::clip::rig::{Rig, Rows};
use crate::motion::lanes::{LANES, LaneQuat, LaneVec, Lanes};
use crate::sheet::Source;
use crate::time::{Clock, Frame};

/// Computes several poses of a clip at a time. Reuses its buffers.
#[derive(Debug, Clone)]
pub(crate) struct LanePoser<'a> {
    clip: &'a Clip,
    rig: Rig,
    pose: LanePose,
    from: LanePose,
    to: LanePose,
}

impl<'a> LanePoser<'a> {
    pub(crate) fn new(clip: &'a Clip) -> Self {
        Self::of_rig(clip, Rig::new(clip.skeleton()))
    }

    /// Creates a poser for a part of the clip's skeleton; poses list its joints in the order of the rig.
    pub(crate) fn of_rig(clip: &'a Clip, rig: Rig) -> Self {
        let rest = LanePose::rest(&rig);
        Self { clip, rig, pose: rest.clone(), from: rest.clone(), to: rest }
    }

    /// Returns the last computed poses.
    pub(crate) fn pose(&self) -> &LanePose {
        &self.pose
    }

    /// Computes the poses of rows of the table.
    #[inline(always)]
    pub(crate) fn rows(&mut self, rows: &Rows<'_>) -> &LanePose {
        self.pose.take_rows(&self.rig, rows);
        &self.pose
    }

    /// Computes the poses at a block of [`LANES`] koma of a clock. Lanes behind the last koma repeat it.
    #[inline(always)]
    pub(crate) fn koma(&mut self, clock: Clock, block: usize, koma: usize) -> &LanePose {
        let place = |lane: usize| clock.place_from_koma((LANES * block + lane).min(koma - 1));
        self.pose.take_places(self.clip, &self.rig, array::from_fn(place));
        &self.pose
    }

    /// Computes the poses of drawings.
    #[inline(always)]
    pub(crate) fn drawings(&mut self, sources: [Source; LANES]) -> &LanePose {
        let Self { clip, rig, pose, from, to } = self;
        if sources.iter().all(|source| matches!(source, Source::At(_))) {
            pose.take_places(clip, rig, sources.map(Source::place));
        } else {
            // A source that is no blend becomes a blend of one pose with itself.
            let blends = sources.map(|source| match source {
                Source::At(place) => (place, place, 0.0),
                Source::Between { from, to, share } => (from, to, share),
            });
            from.take_places(clip, rig, blends.map(|blend| blend.0));
            to.take_places(clip, rig, blends.map(|blend| blend.1));
            pose.take_blends(from, to, Lanes(blends.map(|blend| blend.2)));
        }
        &self.pose
    }

    /// Puts the last computed poses into world space: rotations become world rotations, translations become
    /// positions.
    #[inline(always)]
    pub(crate) fn stand(&mut self) -> &LanePose {
        self.pose.place(&self.rig);
        &self.pose
    }
}

/// One local pose per lane: a rotation and a translation per joint, in joint order.
#[derive(Debug, Clone)]
pub(crate) struct LanePose {
    pub(crate) rotations: Vec<LaneQuat>,
    pub(crate) translations: Vec<LaneVec>,
}

impl LanePose {
    /// Creates a buffer for poses of a rig.
    fn rest(rig: &Rig) -> Self {
        let offsets = (0..rig.len()).map(|joint| LaneVec::splat(rig.offset(joint)));
        Self { rotations: vec![LaneQuat::default(); rig.len()], translations: offsets.collect() }
    }

    /// Sets the poses to those at some places, fractional frame numbers: a slerp between the two neighbouring frames.
    /// Places outside the clip give its first or last frame.
    #[inline(always)]
    fn take_places(&mut self, clip: &Clip, rig: &Rig, places: [f64; LANES]) {
        let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
        let places = places.map(|place| place.clamp(first, last));
        let row = |place: f64| clip.row(Frame(place as usize));
        let before = places.map(|place| row(place.floor()));
        let shares = Lanes(places).map(|place| place - place.floor());
        if shares == Lanes::ZERO {
            return self.take_rows(rig, &before);
        }
        let after = places.map(|place| row(place.ceil()));
        for joint in 0..rig.len() {
            let (from, to) = (rig.rotation(joint, &before), rig.rotation(joint, &after));
            self.rotations[joint] = from.slerp(to, shares);
            let (from, to) = (rig.translation(joint, &before), rig.translation(joint, &after));
            self.translations[joint] = from.lerp(to, shares);
        }
    }

    /// Sets the poses from rows of the table.
    #[inline(always)]
    fn take_rows(&mut self, rig: &Rig, rows: &Rows<'_>) {
        for joint in 0..rig.len() {
            self.rotations[joint] = rig.rotation(joint, rows);
            self.translations[joint] = rig.translation(joint, rows);
        }
    }

    /// Sets the poses to the blends `shares` of the way from some poses to others: a slerp of every joint.
    #[inline(always)]
    fn take_blends(&mut self, from: &Self, to: &Self, shares: Lanes) {
        for joint in 0..self.rotations.len() {
            let (a, b) = (from.rotations[joint], to.rotations[joint]);
            self.rotations[joint] = a.slerp(b, shares);
            let (a, b) = (from.translations[joint], to.translations[joint]);
            self.translations[joint] = a.lerp(b, shares);
        }
    }

    /// Puts the poses into world space: rotations become world rotations, translations become positions.
    #[inline(always)]
    fn place(&mut self, rig: &Rig) {
        rig.place(&mut self.rotations, &mut self.translations);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use proptest::prelude::*;

    use super::*;
    use crate::motion::{Axis, Body, Channel, Joint, JointId, Pose, Skeleton};
    use crate::time::FrameRate;

    /// A clip of a root that travels, an arm with every order of axes and a bone without channels; its columns are
    /// not in the order of joints.
    fn clip(values: &[f64]) -> Clip {
        let turn = |axis| Channel::Rotation(axis);
        let joint = |parent: Option<usize>, channels: Vec<Channel>, first_channel| Joint {
            name: "joint".into(),
            parent: parent.map(JointId),
            offset: DVec3::new(0.5, 2.0, -1.0),
            channels,
            first_channel,
            end_sites: vec![],
        };
        let root = vec![
            Channel::Position(Axis::Y),
            turn(Axis::Z),
            Channel::Position(Axis::X),
            turn(Axis::Y),
            turn(Axis::X),
        ];
        let joints = vec![
            joint(None, root, 4),
            joint(Some(0), vec![turn(Axis::Y), turn(Axis::Y), turn(Axis::Z)], 1),
            joint(Some(1), vec![], 9),
            joint(Some(1), vec![turn(Axis::X)], 0),
        ];
        let skeleton = Skeleton { joints };
        let frames = values.len() / skeleton.channels();
        let values = values[..frames * skeleton.channels()].to_vec();
        Clip::new(skeleton, FrameRate::new(24.0).unwrap(), Frame(3), frames, values).unwrap()
    }

    proptest! {
        #[test]
        fn several_poses_are_what_each_is_alone(
            values in prop::collection::vec(-400.0..400.0, 9..45),
            places in prop::array::uniform(prop_oneof![0.0..9.0, (0u32..9).prop_map(f64::from)]),
            share in prop_oneof![Just(0.0), Just(1.0), 0.0..1.0],
        ) {
            let clip = clip(&values);
            let (rig, skeleton) = (Rig::new(clip.skeleton()), clip.skeleton());
            let mut wide = LanePose::rest(&rig);
            wide.take_places(&clip, &rig, places);
            let other = wide.clone();
            wide.take_places(&clip, &rig, array::from_fn(|lane| places[lane ^ 1]));
            let mut blend = LanePose::rest(&rig);
            blend.take_blends(&other, &wide, Lanes::splat(share));
            blend.place(&rig);
            wide.place(&rig);
            let (mut from, mut to) = (Pose::rest(skeleton), Pose::rest(skeleton));
            from.take_place(&clip, places[0]);
            to.take_place(&clip, places[1]);
            let mut mix = from.clone();
            mix.take_blend(&from, &to, share);
            let mut body = Body::new(skeleton);
            for (pose, wide, lane) in [(&to, &wide, 0), (&from, &wide, 1), (&mix, &blend, 0)] {
                body.place(pose);
                for (joint, position) in body.positions().iter().enumerate() {
                    let found = wide.translations[joint].lane(lane);
                    // Half a turn apart, both directions are equally short; only there may the results differ.
                    let half_turn = pose == &mix
                        && from.rotations.iter().zip(&to.rotations).any(|(a, b)| a.dot(*b).abs() < 1e-6);
                    prop_assert!(half_turn || found.abs_diff_eq(*position, 1e-10), "{found} {position}");
                    let turned = wide.rotations[joint].lane(lane).dot(body.rotations()[joint]);
                    prop_assert!(half_turn || turned.abs() > 1.0 - 1e-12, "{turned}");
                }
            }
        }
    }

    proptest! {
        #[test]
        fn a_part_of_a_skeleton_stands_where_it_does_in_the_whole(
            values in prop::collection::vec(-400.0..400.0, 9..45),
            places in prop::array::uniform(0.0..9.0),
            picked in prop::collection::vec(any::<prop::sample::Index>(), 1..3),
        ) {
            let clip = clip(&values);
            let joints: Vec<usize> =
                picked.iter().map(|picked| picked.index(clip.skeleton().len())).collect();
            let (part, found) = Rig::carrying(clip.skeleton(), &joints);
            let stand = |rig: &Rig| {
                let mut pose = LanePose::rest(rig);
                pose.take_places(&clip, rig, places);
                pose.place(rig);
                pose
            };
            let (whole, part) = (stand(&Rig::new(clip.skeleton())), stand(&part));
            for (joint, place) in joints.into_iter().zip(found) {
                prop_assert_eq!(whole.translations[joint], part.translations[place]);
                prop_assert_eq!(whole.rotations[joint], part.rotations[place]);
            }
        }
    }

    #[test]
    fn between_equal_frames_nothing_moves_by_even_the_last_digit() {
        let row = [33.3, 0.1, -77.7, 12.0, 5.0, 179.0, -3.0, 361.0, 40.0];
        let clip = clip(&[row, row].concat());
        let rig = Rig::new(clip.skeleton());
        let (mut frame, mut between) = (LanePose::rest(&rig), LanePose::rest(&rig));
        frame.take_places(&clip, &rig, [3.0, 4.0, 4.0, 3.0]);
        between.take_places(&clip, &rig, [3.3, 3.9, 3.5, 3.0]);
        assert_eq!(frame.rotations, between.rotations);
        assert_eq!(frame.translations, between.translations);
    }
}
