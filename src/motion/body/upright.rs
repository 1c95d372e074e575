//! Finds the up axis (上方向): as a person or the file declares, or else as the body stands over the clip.

use glam::DVec3;

use crate::motion::body::landmarks::Looks;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::body::members::Members;
use crate::motion::{Axis, Body, Clip, Landmarks, Word};

/// Least uprightness of a body in the median of its poses, as the cosine to the axis: 45°.
const UPRIGHT: f64 = 0.7;

/// Least lead over the other axis.
const CLEARLY: f64 = 0.15;

/// Evidence for a fact about a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum By {
    /// Declared by a person.
    Person,
    /// Declared by the file.
    File,
    /// Motion: how the body stands.
    Motion,
    /// Motion, against the rest pose: the file is rotated in its root, or the body lies down.
    Turned,
    /// Shape of the body.
    Shape,
    /// No evidence: the usual value.
    Custom,
}

/// Finds the up axis, Y or Z, and the evidence for it. A body that always lies or crawls keeps the axis along which
/// its legs stand at rest, or else Y. A body without legs has the axis of its longest side, `rest`.
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
    // Without names, the choice of feet depends on the up axis, so each axis is judged by its own choice.
    let ends = |axis: Axis| {
        let landmarks = Landmarks::of_members(looks, members, limbs, axis);
        let legs = Mannequin::new(members.skeleton(), &landmarks, limbs)?.legs();
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
        // The orientation of a body that lies tells nothing about the room.
        () if of_y.or(of_z).is_some() => (rest_up(clip, of_y.or(of_z)), By::Custom),
        () => rest.map_or((Axis::Y, By::Custom), |axis| (axis, By::Shape)),
    }
}

/// Head and legs of a body.
type Ends = Option<([[usize; 3]; 2], usize)>;

/// Returns the direction of the legs at rest, from ankles to hips; zero without legs.
fn along_rest(clip: &Clip, ends: Ends) -> DVec3 {
    let Some((legs, _)) = ends else { return DVec3::ZERO };
    let body = Body::new(clip.skeleton());
    let way = |[hip, _, ankle]: [usize; 3]| body.positions()[hip] - body.positions()[ankle];
    let ways = legs.map(|leg| way(leg).normalize_or_zero());
    (ways[0] + ways[1]).normalize_or_zero()
}

/// Returns the axis along which the legs stand at rest, Y if neither.
fn rest_up(clip: &Clip, ends: Ends) -> Axis {
    if along_rest(clip, ends).z.abs() >= UPRIGHT { Axis::Z } else { Axis::Y }
}
