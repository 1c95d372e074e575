//! Whether the joints that names give to a limb can be one.

use crate::motion::{JointId, Skeleton};

/// Whether joints can be a limb: they hang on one another, and they end where the shape has an end. Where a hand is so
/// large that the shape finds another end, those joints are believed whose two bones are more alike in length.
pub(super) fn fits(
    skeleton: &Skeleton,
    names: [Option<JointId>; 3],
    shape: [Option<JointId>; 3],
) -> bool {
    let [Some(upper), Some(middle), lower] = names else { return false };
    // Names of another limb.
    if shape[2].is_some_and(|end| !carries(skeleton, upper, end)) {
        return false;
    }
    match lower {
        // A hand or a foot without a known name is the shape's; a limb that has none is as names say.
        None => names[..2] != shape[..2] && carries(skeleton, upper, middle),
        Some(_) => match (evenness(skeleton, names), evenness(skeleton, shape)) {
            (None, _) => false,
            (Some(_), None) => true,
            (Some(named), Some(shaped)) => lower == shape[2] || named >= shaped,
        },
    }
}

/// How alike the two bones of a limb are, up to 1; none where its joints do not hang on one another.
fn evenness(skeleton: &Skeleton, limb: [Option<JointId>; 3]) -> Option<f64> {
    let [Some(upper), Some(middle), Some(lower)] = limb else { return None };
    let (first, second) = (way(skeleton, upper, middle)?, way(skeleton, middle, lower)?);
    Some(first.min(second) / first.max(second).max(f64::MIN_POSITIVE))
}

/// Whether a joint hangs on another, whether or not directly.
pub(super) fn carries(skeleton: &Skeleton, upper: JointId, lower: JointId) -> bool {
    way(skeleton, upper, lower).is_some()
}

/// How far it is along the bones from a joint to one that hangs on it, whether or not directly.
pub(in crate::motion::body) fn way(skeleton: &Skeleton, from: JointId, to: JointId) -> Option<f64> {
    let (mut at, mut long) = (to, 0.0);
    while at != from {
        long += skeleton.joints[at.0].offset.length();
        at = skeleton.joints[at.0].parent?;
    }
    (from != to).then_some(long)
}
