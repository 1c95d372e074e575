//! Checks whether the joints named for a limb can be one.

use crate::motion::{JointId, Skeleton};

/// Whether named joints can be a limb: they hang on one another and end where the limb found by shape ends. A large
/// hand can mislead the shape to another end; then the joints win whose two bones are more similar in length. An upper
/// bone alone is a limb if the shape finds nothing below it.
pub(super) fn fits(
    skeleton: &Skeleton,
    names: [Option<JointId>; 3],
    shape: [Option<JointId>; 3],
) -> bool {
    if let [Some(upper), None, None] = names {
        let end = shape.into_iter().flatten().next_back();
        return end.is_some_and(|end| end == upper || carries(skeleton, end, upper));
    }
    let [Some(upper), Some(middle), lower] = names else { return false };
    // The names belong to another limb.
    if shape[2].is_some_and(|end| !carries(skeleton, upper, end)) {
        return false;
    }
    match lower {
        // If the names equal the shape's first two joints, the shape supplies the unnamed hand or foot. Otherwise the
        // limb has none, as its names say.
        None => names[..2] != shape[..2] && carries(skeleton, upper, middle),
        Some(_) => match (evenness(skeleton, names), evenness(skeleton, shape)) {
            (None, _) => false,
            (Some(_), None) => true,
            (Some(named), Some(shaped)) => lower == shape[2] || named >= shaped,
        },
    }
}

/// Ratio of a limb's two bones, up to 1; `None` if its joints do not hang on one another.
fn evenness(skeleton: &Skeleton, limb: [Option<JointId>; 3]) -> Option<f64> {
    let [Some(upper), Some(middle), Some(lower)] = limb else { return None };
    let (first, second) = (way(skeleton, upper, middle)?, way(skeleton, middle, lower)?);
    Some(first.min(second) / first.max(second).max(f64::MIN_POSITIVE))
}

/// Whether a joint is an ancestor of another.
pub(super) fn carries(skeleton: &Skeleton, upper: JointId, lower: JointId) -> bool {
    way(skeleton, upper, lower).is_some()
}

/// Returns the distance along the bones from a joint to one of its descendants.
pub(in crate::motion::body) fn way(skeleton: &Skeleton, from: JointId, to: JointId) -> Option<f64> {
    let (mut at, mut long) = (to, 0.0);
    while at != from {
        long += skeleton.joints[at.0].offset.length();
        at = skeleton.joints[at.0].parent?;
    }
    (from != to).then_some(long)
}
