//! The height of a body (身長), the unit of its file and its up axis.

use std::ops::RangeInclusive;

use glam::DVec3;

use crate::motion::{Axis, Body, Build, Clip, Members, Poser};

/// Ratio by which a body must be taller along one axis than along the other to stand along it.
const CLEARLY: f64 = 1.25;

/// Plausible heights of an animated figure in metres, from a doll to a giant.
const SOMEBODY: RangeInclusive<f64> = 0.1..=30.0;

/// Height, up axis and unit of a body in its file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stature {
    /// Height of a person with the legs of this body, in the file's unit. For a body without limbs, the longest side
    /// of its joints' bounding box in the first frame; 0 without a frame or with one joint.
    pub size: f64,
    /// Axis that points up, Y or Z.
    pub up: Axis,
    /// Metres per unit of the file: as declared, if that gives a plausible height, otherwise by the unit that makes
    /// the body a person.
    pub metres: f64,
}

impl Stature {
    /// Measures the body of a clip.
    ///
    /// The up axis is the [declared](Clip::declared) one, or else the axis along which the body mostly stands, from
    /// its ankles to hips or head. A body that always lies or crawls, or has no limbs, gets the axis along which it
    /// is clearly taller in the first frame or at rest, or else the usual axis, Y.
    pub fn new(clip: &Clip) -> Self {
        Build::new(clip).stature
    }

    /// Creates the stature of a body with a known size and up axis.
    pub(super) fn of_size(clip: &Clip, size: f64, up: Axis) -> Self {
        let metres = clip.declared().metres;
        let declared = metres.filter(|metres| SOMEBODY.contains(&(size * metres)));
        let metres = declared.unwrap_or_else(|| Unit::nearest(size).metres());
        Self { size, up, metres }
    }
}

/// Returns the size of a body in the first frame, and the axis along which it is clearly taller in that frame or at
/// rest. Z is not up if the rest pose stands along Y: such a body begins on hands and knees.
pub(super) fn seen(clip: &Clip, members: &Members) -> (f64, Option<Axis>) {
    let mut body = Body::new(clip.skeleton());
    let rest = members.extent(body.positions());
    if !clip.is_empty() {
        body.place(Poser::new(clip).frame(clip.first()));
    }
    let first = members.extent(body.positions());
    let up = match (taller(first), taller(rest)) {
        (Some(Axis::Z), Some(Axis::Y)) => Some(Axis::Y),
        (first, rest) => first.or(rest),
    };
    (if clip.is_empty() { 0.0 } else { first.max_element() }, up)
}

/// Returns which of Y and Z a body is clearly taller along, if either.
fn taller(extent: DVec3) -> Option<Axis> {
    let is_clearly = |tall: f64, other: f64| tall > CLEARLY * other;
    match extent {
        DVec3 { y, z, .. } if is_clearly(z, y) => Some(Axis::Z),
        DVec3 { y, z, .. } if is_clearly(y, z) => Some(Axis::Y),
        _ => None,
    }
}

/// The unit of length of a file (単位). BVH does not name it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// 1 m.
    Metre,
    /// 10 cm, as in MakeHuman.
    Decimetre,
    /// The unit of CMU's motion: an inch divided by 0.45, 5.64 cm.
    Cmu,
    /// 2.54 cm.
    Inch,
    /// 1 cm.
    Centimetre,
    /// 1 mm.
    Millimetre,
}

/// Sizes of a person in each unit, in ascending order. At a shared bound, one unit gives a tall person and the other
/// a child.
const PERSONS: [(Unit, f64, f64); 6] = [
    (Unit::Metre, 1.0, 3.0),
    (Unit::Decimetre, 10.0, 21.5),
    (Unit::Cmu, 21.5, 40.0),
    (Unit::Inch, 50.0, 90.0),
    (Unit::Centimetre, 100.0, 250.0),
    (Unit::Millimetre, 1000.0, 2500.0),
];

impl Unit {
    /// Returns the unit in which a body of that size is a person's; `None` without such a unit.
    pub fn of_size(size: f64) -> Option<Self> {
        let is_person = |(_, low, high): &&(Self, f64, f64)| (*low..=*high).contains(&size);
        PERSONS.iter().find(is_person).map(|person| person.0)
    }

    /// Returns the unit in which a body of that size is nearest to a person's; centimetres if the size is 0.
    pub fn nearest(size: f64) -> Self {
        let off = |(_, low, high): &(Self, f64, f64)| (low / size).max(size / high);
        let nearest = PERSONS.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        nearest.filter(|_| size > 0.0).map_or(Self::Centimetre, |person| person.0)
    }

    /// Metres per unit.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Decimetre => 0.1,
            Self::Cmu => 0.0254 / 0.45,
            Self::Inch => 0.0254,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{Channel, Declared, Joint, JointId, Skeleton};
    use crate::time::{Frame, FrameRate};

    /// A straight body along `offset` at rest, turned about X by some degrees in its only frame.
    fn body(offset: DVec3, degrees: f64) -> Clip {
        let joint = |parent: Option<usize>, offset, channels: &[Channel]| Joint {
            name: "joint".into(),
            parent: parent.map(JointId),
            offset,
            channels: channels.to_vec(),
            first_channel: 0,
            end_sites: vec![],
        };
        let turn = [Channel::Rotation(Axis::X)];
        let joints = vec![joint(None, DVec3::ZERO, &turn), joint(Some(0), offset, &[])];
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(Skeleton { joints }, rate, Frame(0), 1, vec![degrees]).unwrap()
    }

    #[test]
    fn up_is_z_only_where_both_poses_allow_it() {
        let up = |offset, degrees| Stature::new(&body(offset, degrees)).up;
        assert_eq!(up(DVec3::Y, 0.0), Axis::Y);
        assert_eq!(up(DVec3::Z, 0.0), Axis::Z, "as Blender writes it");
        assert_eq!(up(DVec3::Y, 90.0), Axis::Y, "it begins lying down");
        assert_eq!(up(DVec3::Z, 90.0), Axis::Y, "a rig whose bones point forward at rest");
        assert_eq!(up(DVec3::Z, 45.0), Axis::Z, "it begins bent: the rest pose stands");
        assert_eq!(up(DVec3::Y, 45.0), Axis::Y, "the same");
        assert_eq!(up(DVec3::X, 0.0), Axis::Y, "flat: nobody knows");
    }

    #[test]
    fn what_is_declared_goes_before_what_is_seen() {
        let lying = body(170.0 * DVec3::Z, 0.0);
        let by_eye = Stature::new(&lying);
        assert_eq!((by_eye.up, by_eye.metres), (Axis::Z, 0.01));
        let declared = |metres| Stature::new(&lying.clone().with_declared(Declared::y_up(metres)));
        assert_eq!((declared(0.02).up, declared(0.02).metres), (Axis::Y, 0.02), "a giant");
        assert_eq!(declared(1.0).metres, 0.01, "nobody is 170 m tall");
    }

    #[test]
    fn the_size_is_that_of_the_first_frame() {
        assert_eq!(Stature::new(&body(170.0 * DVec3::Y, 0.0)).size, 170.0);
        let none = Skeleton { joints: vec![] };
        let none = Clip::new(none, FrameRate::new(24.0).unwrap(), Frame(0), 0, vec![]).unwrap();
        assert_eq!(Stature::new(&none).size, 0.0);
    }

    #[test]
    fn a_unit_makes_a_person_of_a_body() {
        for (size, unit) in [
            (1.7, Unit::Metre),
            (17.0, Unit::Decimetre),
            (30.0, Unit::Cmu),
            (67.0, Unit::Inch),
            (170.0, Unit::Centimetre),
            (1700.0, Unit::Millimetre),
        ] {
            assert_eq!(Unit::of_size(size), Some(unit));
            assert!((1.6..1.75).contains(&(size * unit.metres())), "{unit:?}");
        }
        assert_eq!(Unit::of_size(5.0), None);
        assert_eq!(Unit::of_size(f64::NAN), None);
    }

    #[test]
    fn a_body_of_no_usual_size_has_the_nearest_unit() {
        for (size, unit) in [
            (170.0, Unit::Centimetre),
            (0.4, Unit::Metre),
            (4.5, Unit::Metre),
            (7.0, Unit::Decimetre),
            (300.0, Unit::Centimetre),
            (9e9, Unit::Millimetre),
            (0.0, Unit::Centimetre),
        ] {
            assert_eq!(Unit::nearest(size), unit, "{size}");
        }
    }
}
