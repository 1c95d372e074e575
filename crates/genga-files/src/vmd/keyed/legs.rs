//! The legs whose IK (足ＩＫ, つま先ＩＫ) stays on: their feet have keys, and MMD bends the knees.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use genga::error::Warning;
use genga::maths;
use genga::motion::body::names::bones::{LONGEST_NAME, Side, cp932};
use genga_read::MmdModel;

/// Sine of the bend up to which a knee hardly shows the plane of its leg: 5°.
const SCARCE: f64 = 0.09;

/// A leg and its IK bones.
pub(super) struct IkLeg {
    /// Indices of 足, ひざ and 足首 among the keyed bones.
    pub(super) joints: [usize; 3],
    /// The bone that the ankle must reach (足ＩＫ).
    pub(super) foot: String,
    /// The bone that the toes must reach (つま先ＩＫ), if the model has it.
    pub(super) toes: Option<String>,
}

/// The legs of a figure that keep their IK.
pub(in super::super) struct IkLegs<'a> {
    figure: Cow<'a, MmdModel>,
    /// Size of the model, as a multiple of the figure's.
    size: f64,
    pub(super) legs: Vec<IkLeg>,
}

impl<'a> IkLegs<'a> {
    /// Finds the legs, all of whose `bones` have keys and whose IK a VMD can name. Without a model they are those of the
    /// usual figure, `leg` long.
    pub(in super::super) fn new(model: Option<&'a MmdModel>, leg: f64, bones: &[&str]) -> Self {
        let figure = model.map_or_else(|| Cow::Owned(MmdModel::usual()), Cow::Borrowed);
        let size = figure.leg().map_or(1.0, |own| leg / own);
        let of_side = |side: Side| {
            let joints = ["足", "ひざ", "足首"].map(|bone| side.named(bone));
            let ik = |joint: &String| {
                let found = figure.ik_of(|bone| bone == joint);
                found.into_iter().find(|ik| cp932(ik, LONGEST_NAME).is_ok())
            };
            let foot = ik(&joints[1])?;
            let toes = ik(&joints[2]).filter(|toes| *toes != foot);
            let find = |joint: &String| bones.iter().position(|bone| bone == joint);
            let joints = [find(&joints[0])?, find(&joints[1])?, find(&joints[2])?];
            Some(IkLeg { joints, foot, toes })
        };
        let legs = Side::BOTH.into_iter().filter_map(of_side).collect();
        Self { figure, size, legs }
    }

    /// The names of the IK bones.
    pub(in super::super) fn names(&self) -> Vec<String> {
        self.legs
            .iter()
            .flat_map(|leg| std::iter::once(&leg.foot).chain(&leg.toes))
            .cloned()
            .collect()
    }

    /// Says which IK has keys, and how far knees are off on its account.
    pub(in super::super) fn note(&self, error_of_knees: f64) -> Option<Warning> {
        let message = format!(
            "keys-vmd: {} have keys and are on; MMD bends the knees, which puts them up to {:.2} % of body height off",
            self.names().join(", "),
            100.0 * error_of_knees,
        );
        (!self.legs.is_empty()).then(|| Warning::new("W_VMD_IK", message))
    }

    /// The start of a bone of the model at rest, in MMD units.
    pub(super) fn place(&self, bone: &str) -> DVec3 {
        self.size * self.figure.place(bone).unwrap_or_default()
    }

    /// The names of the ancestors of a bone, the nearest first.
    pub(super) fn above(&self, bone: &str) -> impl Iterator<Item = &str> {
        self.figure.find(bone).into_iter().flat_map(|bone| self.figure.above(bone))
    }
}

/// Turns a thigh about itself so that a knee, which MMD bends about the thigh's X axis alone, takes the shin to where it
/// is. `along` is the sideways part of the shin at rest. A leg that is nearly straight keeps its turn.
pub(super) fn rolled(thigh: DQuat, [way, shin]: [DVec3; 2], along: f64) -> DQuat {
    let (Some(way), Some(shin)) = (way.try_normalize(), shin.try_normalize()) else {
        return thigh;
    };
    let hinge = thigh * DVec3::X;
    let across = hinge.reject_from_normalized(way);
    let (a, b) = (shin.dot(across), shin.dot(way.cross(across)));
    let most = maths::hypot(a, b);
    let wanted = along - hinge.dot(way) * way.dot(shin);
    if most <= wanted.abs() {
        return thigh;
    }
    // The shin's part along the hinge after a turn by an angle is most · cos(angle − middle).
    let (middle, apart) = (maths::atan2(b, a), maths::acos(wanted / most));
    let near = |angle: f64| angle - TAU * (angle / TAU).round();
    let [one, other] = [near(middle + apart), near(middle - apart)];
    let angle = if one.abs() < other.abs() { one } else { other };
    let bend = way.cross(shin).length_squared();
    DQuat::from_axis_angle(way, angle * bend / (bend + SCARCE * SCARCE)) * thigh
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Any turn of a thigh, given by three angles.
    fn turn() -> impl Strategy<Value = DQuat> {
        prop::array::uniform3(-2.0..2.0)
            .prop_map(|[x, y, z]| DQuat::from_euler(glam::EulerRot::XYZ, x, y, z))
    }

    proptest! {
        #[test]
        fn a_thigh_that_is_turned_about_itself_is_turned_back(
            thigh in turn(),
            off in -1.2..1.2,
            bend in 0.6..2.4,
            sideways in -0.1..0.1,
        ) {
            let [own, shin] = [[0.1, -0.9, 0.05], [sideways, -1.0, -0.1]].map(|way| DVec3::from_array(way).normalize());
            let ways = [thigh * own, thigh * DQuat::from_rotation_x(bend) * shin];
            let turned = DQuat::from_axis_angle(ways[0], off) * thigh;
            let found = rolled(turned, ways, shin.x);
            prop_assert!((found * own).abs_diff_eq(ways[0], 1e-9), "the thigh keeps its way");
            let left = found.angle_between(thigh);
            prop_assert!(left < 0.1 * f64::abs(off) + 1e-6, "{left} of {off} is left");
        }
    }

    #[test]
    fn a_straight_leg_keeps_its_turn() {
        let thigh = DQuat::from_rotation_y(0.7);
        let ways = [DVec3::NEG_Y, DVec3::new(0.001, -1.0, 0.0)];
        assert!(rolled(thigh, ways, 0.0).angle_between(thigh) < 1e-3);
        assert_eq!(rolled(thigh, [DVec3::NEG_Y, DVec3::ZERO], 0.0), thigh);
    }
}
