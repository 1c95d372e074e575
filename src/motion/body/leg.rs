//! Moves the foot of a leg (脚) by inverse kinematics: two bones that turn at hip and knee.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use crate::maths;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::rotation_axes;
use crate::motion::{Body, Build, Clip, JointId, Pose, Poser};
use crate::time::Frame;

/// Number of frames sampled to see how a knee bends.
const LOOKS: usize = 200;

/// Least mean bend of a knee, as the sine of its angle, at which its hinge can be told: 1°.
const LEAST_BEND: f64 = 0.02;

/// Largest overextension of a knee, in radians, that counts as a straight leg rather than a knee on the wrong side:
/// 15°.
const OVER: f64 = 0.26;

/// Speed at which an overextended knee passes through straight, in radians per radian of further bending.
const THROUGH: f64 = 4.0;

/// The joints of a leg and the hinge of its knee.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::motion) struct Leg {
    hip: usize,
    knee: usize,
    pub(in crate::motion) ankle: usize,
    /// Parents of knee and ankle: the hip or knee itself, or a twist joint below it.
    over_knee: usize,
    over_ankle: usize,
    over_hip: Option<usize>,
    /// Unit axis of the knee, about which shin and thigh bend together, in the axes of the knee's parent.
    hinge: DVec3,
}

/// World-space rotations that move a foot to a target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Rotation of the whole leg at the hip, applied after the knee's.
    pub swing: DQuat,
    /// Rotation of the shin at the knee.
    pub bend: DQuat,
}

impl Leg {
    /// Finds the legs of a body in the order of its feet. A leg is `None` if hip, knee or ankle cannot turn freely,
    /// or if its knee never bends. A body without head, two arms and two legs has no legs.
    pub(crate) fn both(clip: &Clip, build: &Build) -> Vec<Option<Self>> {
        let joints = build.mannequin.as_ref().map(Mannequin::legs);
        joints.into_iter().flatten().map(|joints| Self::from_joints(clip, joints)).collect()
    }

    fn from_joints(clip: &Clip, [hip, knee, ankle]: [usize; 3]) -> Option<Self> {
        let joints = &clip.skeleton().joints;
        let over = |joint: usize| joints[joint].parent.map(|JointId(parent)| parent);
        if [hip, knee, ankle].iter().any(|joint| rotation_axes(&joints[*joint]).is_none()) {
            return None;
        }
        let (over_knee, over_ankle) = (over(knee)?, over(ankle)?);
        let hinge = DVec3::ZERO;
        let leg = Self { hip, knee, ankle, over_knee, over_ankle, over_hip: over(hip), hinge };
        let hinge = leg.seen_hinge(clip)?;
        Some(Self { hinge, ..leg })
    }

    /// Estimates the axis about which the knee mostly bends, in the axes of its parent.
    fn seen_hinge(&self, clip: &Clip) -> Option<DVec3> {
        let (mut poser, mut body) = (Poser::new(clip), Body::new(clip.skeleton()));
        let looks = clip.len().min(LOOKS);
        let bend = |look: usize| {
            body.place(poser.frame(Frame(clip.first().0 + look * clip.len() / looks)));
            let positions = body.positions();
            let [thigh, shin] = [self.hip, self.ankle]
                .map(|end| (positions[end] - positions[self.knee]).normalize_or_zero());
            body.rotations()[self.over_knee].inverse() * thigh.cross(shin)
        };
        let mean = (0..looks).map(bend).sum::<DVec3>() / looks.max(1) as f64;
        (mean.length() > LEAST_BEND).then(|| mean.normalize())
    }

    /// Returns the joints that [`Leg::carry`] turns.
    pub(in crate::motion) fn joints(&self) -> [usize; 3] {
        [self.hip, self.knee, self.ankle]
    }

    /// Moves the foot by `way`, as far as the leg reaches, and keeps the foot's world orientation. The hip stays in
    /// place, the bones keep their length, and the knee bends as this body's knees do. `body` must be in this pose.
    pub(in crate::motion) fn carry(&self, pose: &mut Pose, body: &Body, way: DVec3) {
        let world = body.rotations();
        let hinge = world[self.over_knee] * self.hinge;
        let [hip, knee, ankle] = self.joints().map(|joint| body.positions()[joint]);
        let Some(Reach { swing, bend }) = reach([hip, knee, ankle], hinge, ankle + way) else {
            return;
        };
        let over_hip = self.over_hip.map_or(DQuat::IDENTITY, |joint| world[joint]);
        // The parents are rotated too; the foot itself is not.
        let turns = [
            (self.hip, over_hip, swing * world[self.hip]),
            (self.knee, world[self.over_knee], bend * world[self.knee]),
            (self.ankle, swing * bend * world[self.over_ankle], world[self.ankle]),
        ];
        for (joint, over, turned) in turns {
            pose.rotations[joint] = (over.inverse() * turned).normalize();
        }
    }
}

/// Computes the rotations that bring the end of two bones to a target, or as near as they reach; `None` for bones of
/// no length.
///
/// First the knee turns about its hinge until hip and ankle have the wanted distance. Then the leg swings to the
/// target by the shortest arc. Bones need not be perpendicular to the hinge: their components across the hinge obey
/// the law of cosines, those along it do not change.
pub fn reach([hip, knee, ankle]: [DVec3; 3], hinge: DVec3, target: DVec3) -> Option<Reach> {
    let (thigh, shin) = (hip - knee, ankle - knee);
    let (along_thigh, along_shin) = (thigh.dot(hinge), shin.dot(hinge));
    let (a, b) = (thigh - along_thigh * hinge, shin - along_shin * hinge);
    let product = a.length() * b.length();
    if product <= f64::EPSILON * (thigh.length_squared() + shin.length_squared()) {
        return None;
    }
    let across = a.length_squared() + b.length_squared() + (along_thigh - along_shin).powi(2);
    let cosine = ((across - (target - hip).length_squared()) / (2.0 * product)).clamp(-1.0, 1.0);
    let wanted = maths::atan2(((1.0 - cosine) * (1.0 + cosine)).sqrt(), cosine);
    let angle = maths::atan2(hinge.dot(a.cross(b)), a.dot(b));
    let bend = DQuat::from_axis_angle(hinge, bend(PI - angle, PI - wanted));
    let bent = (bend * shin - thigh).try_normalize()?;
    let swing = DQuat::from_rotation_arc(bent, (target - hip).try_normalize()?);
    Some(Reach { swing, bend })
}

/// Returns the angle by which a knee turns about its hinge, from bend `now` to bend `wanted`. Both are 0 for a
/// straight leg; `wanted` is 0 to π.
///
/// A slightly overextended knee would jump to the same bend on the other side as soon as its foot moves. It passes
/// through straight gradually instead; so near to straight, the error of the foot is negligible.
fn bend(now: f64, wanted: f64) -> f64 {
    let past = if now > PI { TAU - now } else { -now };
    if !(0.0..=OVER).contains(&past) {
        return now - wanted;
    }
    let to = if wanted <= past { -wanted } else { (THROUGH * (wanted - past) - past).min(wanted) };
    -past - to
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
    }

    /// Returns hip, knee and ankle after a reach.
    fn reached([hip, knee, ankle]: [DVec3; 3], Reach { swing, bend }: Reach) -> [DVec3; 3] {
        let shin = bend * (ankle - knee);
        [hip, hip + swing * (knee - hip), hip + swing * (knee - hip + shin)]
    }

    #[test]
    fn a_straight_leg_of_two_bones_bends_by_the_law_of_cosines() {
        let leg = [2.0, 1.0, 0.0].map(|level| DVec3::Y * level);
        // Two bones of length 1 span √2 at a right angle.
        let target = DVec3::Y * (2.0 - 2.0_f64.sqrt());
        let found = reached(leg, reach(leg, DVec3::X, target).unwrap());
        assert!(found[2].abs_diff_eq(target, 1e-12), "{found:?}");
        let knee = DVec3::new(0.0, 2.0 - 0.5_f64.sqrt(), found[1].z);
        assert!(found[1].abs_diff_eq(knee, 1e-12), "{found:?}");
        assert!((found[1].z.abs() - 0.5_f64.sqrt()).abs() < 1e-12, "{found:?}");
        let other = reached(leg, reach(leg, -DVec3::X, target).unwrap());
        assert!((other[1].z + found[1].z).abs() < 1e-12, "the other hinge bends the other way");
    }

    #[test]
    fn a_knee_a_little_past_straight_goes_through_it_and_does_not_jump() {
        let past = -0.05_f64;
        let to = |wanted: f64| past - bend(past, wanted);
        assert_eq!(bend(past, 0.05), 0.0, "where the foot is, nothing moves");
        let wanted = (0..=300).map(|at| 0.001 * f64::from(at));
        let bends: Vec<f64> = wanted.map(to).collect();
        let steps = bends.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        assert!(steps.fold(0.0, f64::max) < 0.0041, "{bends:?}");
        assert!((bends[300] - 0.3).abs() < 1e-12, "bent well it is bent as asked");
        assert!(
            (bend(past + TAU, 0.2) - bend(past, 0.2)).abs() < 1e-12,
            "whole turns do not count"
        );
        assert!((bend(-1.0, 0.2) + 1.2).abs() < 1e-12, "a knee on the wrong side comes over");
    }

    proptest! {
        #[test]
        fn a_foot_gets_where_the_leg_reaches_and_its_bones_keep_their_length(
            hip in vector(5.0),
            thigh in vector(1.0),
            shin in vector(1.0),
            hinge in vector(1.0),
            way in vector(3.0),
        ) {
            let leg = [hip, hip + thigh, hip + thigh + shin];
            let Some(hinge) = hinge.try_normalize() else { return Ok(()) };
            prop_assume!(thigh.length() > 1e-3 && shin.length() > 1e-3);
            let target = leg[2] + way;
            let Some(found) = reach(leg, hinge, target) else { return Ok(()) };
            let found = reached(leg, found);
            for (bone, ends) in [thigh, shin].iter().zip(found.windows(2)) {
                prop_assert!((ends[0].distance(ends[1]) - bone.length()).abs() < 1e-12, "{found:?}");
            }
            let bend = |degrees: f64| {
                let shin = DQuat::from_axis_angle(hinge, degrees.to_radians()) * shin;
                (thigh + shin).length()
            };
            let reaches: Vec<f64> = (0..3600).map(|tenth| bend(0.1 * f64::from(tenth))).collect();
            let near = reaches.iter().copied().fold(f64::INFINITY, f64::min);
            let far = reaches.iter().copied().fold(0.0, f64::max);
            let wanted = hip.distance(target);
            // The tolerance allows for the oracle's resolution of a tenth of a degree.
            let off = found[2].distance(target);
            let across = |bone: DVec3| bone.reject_from_normalized(hinge);
            let past = hinge.dot(across(shin).cross(across(thigh))).atan2(across(thigh).dot(across(shin)));
            // An overextended knee passes through straight gradually, so it is excluded here.
            prop_assume!(!(-OVER..=0.0).contains(&past));
            let least = (near - wanted).max(wanted - far).max(0.0);
            prop_assert!(off <= least + 1e-6 || (wanted - near).abs() < 1e-5, "{off} {least} {found:?}");
            prop_assert!(off >= least - 1e-5, "{off} {least}");
        }
    }

    #[test]
    fn bones_of_no_length_and_targets_without_a_way_reach_nothing() {
        let leg = [DVec3::Y * 2.0, DVec3::Y, DVec3::ZERO];
        assert_eq!(reach([DVec3::Y; 3], DVec3::X, DVec3::ZERO), None);
        assert_eq!(reach([DVec3::Y, DVec3::Y, DVec3::ZERO], DVec3::X, DVec3::X), None);
        assert_eq!(reach(leg, DVec3::Y, DVec3::X), None, "a hinge along the bones bends nothing");
        let far = reached(leg, reach(leg, DVec3::X, DVec3::new(0.0, 2.0, 100.0)).unwrap());
        assert!(
            far[2].abs_diff_eq(DVec3::new(0.0, 2.0, 2.0), 1e-12),
            "stretched towards it: {far:?}"
        );
    }
}
