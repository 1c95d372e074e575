//! The stance (基準姿勢): how each joint of the capture is turned when its body stands like the model at
//! rest. The model's bones get the rotation of the joints relative to the stance.
//!
//! If the file's own rest is an upright body (a T-pose, or arms down), it is the stance, whichever way it
//! faces. Some programs lay every bone along one axis instead; such a rest does not show how a body
//! stands, so the stance is built. Pelvis and chest are derived from the positions of legs, arms and neck,
//! the roll of the limbs from the direction in which elbows and knees bend in the clip.

use glam::{DMat3, DQuat, DVec3};

use super::capture::Capture;
use genga::motion::body::names::bones::{Bone, Part, Side};

/// Cosine of the angle within which a bone counts as lying along an axis.
const ALONG: f64 = 0.999;

/// Cosine of 35°: an axis this close to a direction seen in the clip is taken for it.
const MEANT: f64 = 0.82;

/// The correction from capture to model: the world rotation of a bone is `up · Q · right`, where Q is that of
/// the joint.
pub(crate) struct Stance {
    /// Rotation from the capture's up to +Y.
    pub(crate) up: DQuat,
    /// Rotation from the pelvis's own axes to left, up and forward.
    pub(crate) pelvis: DQuat,
    /// The right-hand correction of each bone of the model; `None` if nothing drives it.
    pub(crate) right: Vec<Option<DQuat>>,
}

impl Stance {
    /// Computes the stance of a capture for a model whose arms hang `arm_angle` radians below the horizontal.
    pub(crate) fn new(capture: &Capture<'_>, arm_angle: f64) -> Self {
        let upright = upright_rest(capture);
        // How the body stands counts, and not the rest, which may stand along another axis.
        let file_up = capture.up();
        let up = DQuat::from_rotation_arc(file_up, DVec3::Y);
        let turns = match upright {
            Some(basis) => {
                let turn = DQuat::from_mat3(&basis).inverse();
                vec![Some(turn); capture.model().bones.len()]
            }
            None => built(capture, file_up),
        };
        // The facing is kept: only up is brought to +Y.
        let mut aligned: Vec<Option<DQuat>> = Vec::new();
        for (index, bone) in capture.model().bones.iter().enumerate() {
            let carried = bone.parent.and_then(|parent| aligned[parent]).unwrap_or_default();
            aligned.push(Some(alignment(capture, index, bone, turns[index], carried, arm_angle)));
        }
        let right = |index: usize| {
            capture.joint(index)?;
            Some(turns[index]?.inverse() * aligned[index]?)
        };
        let pelvis = capture.model().find("下半身").and_then(|bone| turns[bone]);
        let right = (0..turns.len()).map(right).collect();
        Self { up, pelvis: pelvis.unwrap_or_default(), right }
    }
}

/// The rotation of a bone from the model's rest to the stance. A limb is turned to where the capture's limb
/// points in the stance, by the shortest rotation from where its parent leaves it.
fn alignment(
    capture: &Capture<'_>,
    index: usize,
    bone: &Bone,
    turn: Option<DQuat>,
    carried: DQuat,
    arm_angle: f64,
) -> DQuat {
    match (bone.rest_direction(arm_angle), turn, capture.direction(index)) {
        (None, ..) if bone.part == Part::Follows => carried,
        (None, ..) => DQuat::IDENTITY,
        (Some(rest), Some(turn), Some(own)) => {
            DQuat::from_rotation_arc((carried * rest).normalize(), (turn * own).normalize())
                * carried
        }
        (Some(_), ..) => carried,
    }
}

/// The left, up and forward axes of the rest as columns, if the rest is a standing body.
fn upright_rest(capture: &Capture<'_>) -> Option<DMat3> {
    let left = capture.rest_across("足").or_else(|| capture.rest_across("腕"))?;
    let up = capture.rest_up()?;
    let down =
        |side| capture.rest_span(side, "足", "足首").or(capture.rest_span(side, "足", "ひざ"));
    let legs_hang = Side::BOTH.iter().filter_map(|side| down(*side)).all(|leg| leg.dot(up) < -0.7);
    let arm = |side: Side| capture.rest_span(side, "腕", "手首");
    let crosses = |side: &Side| arm(*side).is_some_and(|arm| side.sign() * arm.dot(left) < -0.3);
    if !legs_hang || left.dot(up).abs() > 0.3 || Side::BOTH.iter().any(crosses) {
        return None;
    }
    let up = snapped(up);
    let left = snapped((left - left.dot(up) * up).normalize());
    Some(DMat3::from_cols(left, up, left.cross(up)))
}

/// The coordinate axis near a direction, or else the direction itself.
fn snapped(direction: DVec3) -> DVec3 {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    axes.into_iter().find(|axis| axis.dot(direction) > 0.9).unwrap_or(direction)
}

/// Builds the stance bone by bone, for a rest that is not a standing body.
fn built(capture: &Capture<'_>, up: DVec3) -> Vec<Option<DQuat>> {
    let model = capture.model();
    let mut turns: Vec<Option<DQuat>> = vec![None; model.bones.len()];
    for (index, bone) in model.bones.iter().enumerate() {
        let parent = bone.parent.and_then(|parent| turns[parent]);
        turns[index] = match bone.part {
            Part::Center => None,
            Part::Follows => parent,
            Part::Arm(side) | Part::Leg(side) if starts_limb(capture, bone) => {
                limb(capture, index, bone.part, side, &turns)
            }
            Part::Arm(_) | Part::Leg(_) => {
                toward(capture, index, bone.part.rest_direction(0.0), parent)
            }
            Part::Trunk => trunk(capture, index, &bone.name, &turns, up),
        };
    }
    // Collar bones share the axes of their arm.
    for side in Side::BOTH {
        if let (Some(collar), Some(arm)) = (model.sided(side, "肩"), model.sided(side, "腕")) {
            let sideways = Part::Arm(side).rest_direction(0.0);
            turns[collar] = toward(capture, collar, sideways, turns[arm]);
        }
    }
    turns
}

/// Whether a bone is the first of its limb: upper arm and thigh hang on the trunk, forearm and shin do not.
fn starts_limb(capture: &Capture<'_>, bone: &Bone) -> bool {
    bone.parent.is_some_and(|parent| capture.model().bones[parent].part != bone.part)
}

/// The rotation, closest to `from`, that makes a bone point to `target` in the stance.
fn toward(
    capture: &Capture<'_>,
    index: usize,
    target: Option<DVec3>,
    from: Option<DQuat>,
) -> Option<DQuat> {
    let from = from?;
    match (capture.direction(index), target) {
        (Some(own), Some(target)) => {
            Some(DQuat::from_rotation_arc((from * own).normalize(), target) * from)
        }
        _ => Some(from),
    }
}

/// The rotation of pelvis, spine, head or foot.
fn trunk(
    capture: &Capture<'_>,
    index: usize,
    name: &str,
    turns: &[Option<DQuat>],
    up: DVec3,
) -> Option<DQuat> {
    let model = capture.model();
    let turn_of = |name: &str| model.find(name).and_then(|bone| turns[bone]);
    match name {
        "下半身" => {
            let left = capture.rest_across("足")?;
            Some(turn(capture.spine_way()?, left, DVec3::Y, DVec3::X))
        }
        // The chest's left is derived from the position of the shoulders.
        "上半身" | "上半身2" | "首" | "頭" => {
            let chest = chest(capture, turns);
            toward(capture, index, Some(DVec3::Y), chest)
        }
        _ => {
            let side = Side::BOTH.into_iter().find(|side| name.starts_with(side.word()))?;
            match name.strip_prefix(side.word())? {
                "足首" => foot(capture, index, side, up).or_else(|| turn_of("下半身")),
                _ => None,
            }
        }
    }
}

/// The bone that carries shoulders and neck: the outermost driven bone of the upper body.
fn chest_bone(capture: &Capture<'_>) -> Option<usize> {
    ["上半身2", "上半身"].into_iter().find_map(|name| {
        let bone = capture.model().find(name)?;
        capture.joint(bone).map(|_| bone)
    })
}

fn chest(capture: &Capture<'_>, turns: &[Option<DQuat>]) -> Option<DQuat> {
    let model = capture.model();
    let chest = chest_bone(capture)?;
    let pelvis = model.find("下半身").and_then(|bone| turns[bone]);
    let up = capture.direction(chest)?;
    let across = capture.rest_across("肩").or_else(|| capture.rest_across("腕"));
    let left = across.filter(|left| left.cross(up).length() > 0.5).or_else(|| {
        // Otherwise use the pelvis's left, averaged over the clip.
        let (joint, from) = (capture.joint(chest)?, model.find("下半身")?);
        let (pelvis, carrier) = (pelvis?, capture.joint(from)?);
        capture.mean_local(joint, |world| world[carrier.0] * (pelvis.inverse() * DVec3::X))
    })?;
    Some(turn(up, left, DVec3::Y, DVec3::X))
}

/// The rotation of an upper arm or thigh. It lies along the limb and is rolled so that the next joint bends as a
/// body's does: elbows bring the hand forward, knees take the foot back.
fn limb(
    capture: &Capture<'_>,
    index: usize,
    part: Part,
    side: Side,
    turns: &[Option<DQuat>],
) -> Option<DQuat> {
    let target = part.rest_direction(0.0)?;
    let model = capture.model();
    let (hinge, below, carrier) = match part {
        Part::Arm(_) => (-side.sign() * DVec3::Y, "ひじ", chest_bone(capture)),
        _ => (DVec3::X, "ひざ", model.find("下半身")),
    };
    let own = capture.direction(index)?;
    let joint = capture.joint(index)?;
    let bend = || {
        let below = model.sided(side, below)?;
        let (lower, direction) = (capture.joint(below)?, capture.direction(below)?);
        let cross = |world: &[DQuat]| (world[joint.0] * own).cross(world[lower.0] * direction);
        capture.mean_local(joint, cross)
    };
    let carried = || {
        let (turn, carrier) = (turns[carrier?]?, capture.joint(carrier?)?);
        capture.mean_local(joint, |world| world[carrier.0] * (turn.inverse() * hinge))
    };
    Some(turn(own, bend().or_else(carried)?, target, hinge))
}

/// The rotation of the foot: it points ahead, dropped by the median angle of the clip, without leaning sideways.
fn foot(capture: &Capture<'_>, index: usize, side: Side, up: DVec3) -> Option<DQuat> {
    let own = capture.direction(index)?;
    let joint = capture.joint(index)?;
    let above = capture.model().sided(side, "ひざ")?;
    let (shin, along) = (capture.joint(above)?, capture.direction(above)?);
    let cross = |world: &[DQuat]| (world[shin.0] * along).cross(world[joint.0] * own);
    let hinge = capture.mean_local(joint, cross)?;
    let drop = capture.median(|world| up.dot(world[joint.0] * own).clamp(-1.0, 1.0));
    let target = DVec3::new(0.0, drop, (1.0 - drop * drop).sqrt());
    Some(turn(own, hinge, target, DVec3::NEG_X))
}

/// The rotation that takes `along` to `target`, and `across` as close to `beside` as possible.
fn turn(along: DVec3, across: DVec3, target: DVec3, beside: DVec3) -> DQuat {
    let own = basis(along, meant(along, across));
    DQuat::from_mat3(&(basis(target, beside) * own.transpose()))
}

/// Corrects `across` for a bone that lies along an axis: its other axes then match the body's too, so the nearest
/// axis is taken.
fn meant(along: DVec3, across: DVec3) -> DVec3 {
    if along.abs().max_element() < ALONG {
        return across;
    }
    let across = (across - across.dot(along) * along).normalize_or(across);
    let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
    axes.into_iter().find(|axis| axis.dot(across) > MEANT).unwrap_or(across)
}

/// Right-handed axes whose first is `along` and whose first two span a plane that contains `across`.
fn basis(along: DVec3, across: DVec3) -> DMat3 {
    let third = along.cross(across).normalize_or(along.any_orthonormal_vector());
    DMat3::from_cols(along, third.cross(along), third)
}
