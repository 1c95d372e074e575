//! Which way is up (上方向): as a person or the file says, else as the body stands over the clip.

use glam::DVec3;

use crate::motion::body::landmarks::Looks;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::body::members::Members;
use crate::motion::{Axis, Body, Clip, Landmarks, Word};

/// How upright a body stands at the least in the middle of all its poses, as the cosine to the axis: 45°.
const UPRIGHT: f64 = 0.7;

/// By how much more than along the other axis.
const CLEARLY: f64 = 0.15;

/// By what something is known of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum By {
    /// A person says it.
    Person,
    /// The file says it.
    File,
    /// The motion does: how the body stands.
    Motion,
    /// The motion does, and the rest pose stands otherwise: a file that is turned in its root, or somebody who lies.
    Turned,
    /// The shape of the body does.
    Shape,
    /// Nothing does: it is what is usual.
    Custom,
}

/// The axis that points up, Y or Z, and by what it is known. Somebody who lies or crawls all the time keeps the axis of the
/// rest pose, where its legs stand along one, and else Y. A body without legs has that of its longest side, `rest`.
pub(super) fn up(
    clip: &Clip,
    members: &Members,
    limbs: &NamedLimbs,
    looks: &Looks,
    rest: Option<Axis>,
) -> (Axis, By) {
    match clip.declared().up {
        Some((up, Word::Person)) => return (up, By::Person),
        Some((up, Word::File)) => return (up, By::File),
        None => {}
    }
    // Which ends are feet depends on what is up, where no name says it: each axis has to prove itself by its own.
    let ends = |axis: Axis| {
        let landmarks = Landmarks::of_members(looks, members, limbs, axis);
        let legs = Mannequin::of(members.skeleton(), &landmarks, limbs)?.legs();
        Some((legs, landmarks.head?.joint.0))
    };
    let stands = |ends: Option<([[usize; 3]; 2], usize)>| {
        ends.map_or(DVec3::ZERO, |(legs, head)| looks.upright(clip, legs, head))
    };
    let (of_y, of_z) = (ends(Axis::Y), ends(Axis::Z));
    let along_y = stands(of_y);
    let along_z = if of_z == of_y { along_y } else { stands(of_z) };
    let (y, z) = (along_y.y, along_z.z);
    match () {
        () if y >= UPRIGHT && y >= z + CLEARLY => (Axis::Y, By::Motion),
        () if z >= UPRIGHT && z >= y + CLEARLY => {
            let is_turned = along_rest(clip, of_z).y.abs() >= UPRIGHT;
            (Axis::Z, if is_turned { By::Turned } else { By::Motion })
        }
        // Where a body lies says nothing of the room.
        () if of_y.or(of_z).is_some() => (rest_up(clip, of_y.or(of_z)), By::Custom),
        () => rest.map_or((Axis::Y, By::Custom), |axis| (axis, By::Shape)),
    }
}

/// Head and legs of a body.
type Ends = Option<([[usize; 3]; 2], usize)>;

/// The way that the legs of a rest pose stand up; none without legs.
fn along_rest(clip: &Clip, ends: Ends) -> DVec3 {
    let Some((legs, _)) = ends else { return DVec3::ZERO };
    let body = Body::new(clip.skeleton());
    let way = |[hip, _, ankle]: [usize; 3]| body.positions()[hip] - body.positions()[ankle];
    let ways = legs.map(|leg| way(leg).normalize_or_zero());
    (ways[0] + ways[1]).normalize_or_zero()
}

/// The axis along which the legs of a rest pose stand, Y if neither.
fn rest_up(clip: &Clip, ends: Ends) -> Axis {
    if along_rest(clip, ends).z.abs() >= UPRIGHT { Axis::Z } else { Axis::Y }
}
