//! Retargets the capture's body to the model's. Every pose is taken as world rotations, and each bone is then
//! expressed relative to its parent bone. So chains of other lengths work: the rotation of joints between two
//! mapped ones is part of the outer one's world rotation, and an undriven bone follows its parent.

use glam::{DQuat, DVec3};

use super::capture::Capture;
use super::rest_alignment::Stance;
use genga::motion::body::names::bones::{Model, Part};
use genga::motion::{
    Body, Clip, Composite, CompositeRows, JointId, Pose, Stature, local_rotation, local_translation,
};

/// Conventional number of MMD units per metre, for a clip without legs to measure.
const UNITS_IN_METRE: f64 = 12.5;

/// A model's bone and the joint that drives it.
struct Driven {
    bone: usize,
    joint: JointId,
    right: DQuat,
}

/// Turns drawings into poses of the model.
pub(crate) struct Retarget<'a> {
    clip: &'a Clip,
    model: &'a Model,
    rows: CompositeRows<'a>,
    row: Vec<f64>,
    pose: Pose,
    body: Body,
    driven: Vec<Driven>,
    waist: Option<JointId>,
    /// Index of the centre bone, and the waist's rest position in the capture's unit, after `up`.
    center: Option<(usize, DVec3)>,
    up: DQuat,
    /// MMD units per unit of the capture.
    pub(crate) scale: f64,
}

/// A bone's pose in BVH's right-handed axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Local {
    pub(crate) translation: DVec3,
    pub(crate) rotation: DQuat,
}

impl<'a> Retarget<'a> {
    /// Prepares the conversion. `leg` is the model's leg length from root to ankle, in MMD units.
    pub(crate) fn new(
        composite: &'a Composite<'a>,
        model: &'a Model,
        capture: &Capture<'_>,
        stance: &Stance,
        leg: f64,
    ) -> Self {
        let clip = composite.clip();
        let skeleton = clip.skeleton();
        let driven = |bone: usize| {
            if model.bones[bone].part == Part::Center {
                return None;
            }
            Some(Driven { bone, joint: capture.joint(bone)?, right: stance.right[bone]? })
        };
        let center = model.find("センター").filter(|bone| capture.joint(*bone).is_some());
        Self {
            clip,
            model,
            rows: CompositeRows::new(composite),
            row: vec![0.0; skeleton.channels()],
            pose: Pose::rest(skeleton),
            body: Body::new(skeleton),
            driven: (0..model.bones.len()).filter_map(driven).collect(),
            waist: capture.waist(),
            center: center.map(|bone| (bone, standing(capture, stance))),
            up: stance.up,
            scale: capture.leg().map_or_else(|| without_legs(clip), |own| leg / own),
        }
    }

    pub(crate) fn name(&self, bone: usize) -> &str {
        &self.model.bones[bone].name
    }

    /// The bones that get keys, in the model's order.
    pub(crate) fn bones(&self) -> Vec<usize> {
        let center = self.center.map(|(bone, _)| bone);
        center.into_iter().chain(self.driven.iter().map(|driven| driven.bone)).collect()
    }

    /// Whether the first of [`Retarget::bones`] is the centre (センター), the only bone that is translated.
    pub(crate) fn has_center(&self) -> bool {
        self.center.is_some()
    }

    /// Returns the joint that drives each of [`Retarget::bones`]; none for the centre, which only moves.
    pub(crate) fn joints(&self) -> Vec<Option<usize>> {
        let driven = self.driven.iter().map(|driven| Some(driven.joint.0));
        self.center.iter().map(|_| None).chain(driven).collect()
    }

    /// Returns which of [`Retarget::bones`] carries each of them.
    pub(crate) fn carriers(&self) -> Vec<Option<usize>> {
        let bones = self.bones();
        let up = |bone: &usize| self.model.bones[*bone].parent;
        let carrier = |bone: &usize| {
            let ancestors = std::iter::successors(up(bone), up);
            let mut listed =
                ancestors.filter_map(|bone| bones.iter().position(|other| *other == bone));
            listed.next()
        };
        bones.iter().map(carrier).collect()
    }

    /// Computes the pose of a drawing on a koma, with one entry for each of [`Retarget::bones`].
    pub(crate) fn take(&mut self, drawing: usize, koma: usize) -> Vec<Local> {
        self.rows.write(drawing, koma, &mut self.row);
        for (index, joint) in self.clip.skeleton().joints.iter().enumerate() {
            self.pose.rotations[index] = local_rotation(joint, &self.row);
            self.pose.translations[index] = local_translation(joint, &self.row);
        }
        self.body.place(&self.pose);
        let center = self.center.zip(self.waist).map(|((_, stands), waist)| {
            let moved = self.up * self.body.positions()[waist.0] - stands;
            Local { translation: self.scale * moved, rotation: DQuat::IDENTITY }
        });
        center.into_iter().chain(self.turned()).collect()
    }

    /// Position of a joint in the last pose taken, after `up` and in the capture's unit.
    pub(crate) fn place(&self, joint: JointId) -> DVec3 {
        self.up * self.body.positions()[joint.0]
    }

    fn turned(&self) -> Vec<Local> {
        let mut worlds = vec![None; self.model.bones.len()];
        for Driven { bone, joint, right } in &self.driven {
            worlds[*bone] = Some(self.up * self.body.rotations()[joint.0] * *right);
        }
        let driven = self.driven.iter();
        let local = |driven: &Driven| {
            let world = worlds[driven.bone].unwrap_or_default();
            let rotation = self.carrier(driven.bone, &worlds).inverse() * world;
            Local { translation: DVec3::ZERO, rotation: rotation.normalize() }
        };
        driven.map(local).collect()
    }

    /// World rotation of the nearest driven ancestor of a bone.
    fn carrier(&self, bone: usize, worlds: &[Option<DQuat>]) -> DQuat {
        let mut parent = self.model.bones[bone].parent;
        while let Some(bone) = parent {
            if let Some(world) = worlds[bone] {
                return world;
            }
            parent = self.model.bones[bone].parent;
        }
        DQuat::IDENTITY
    }
}

/// MMD units per unit of the clip, from the body's size.
fn without_legs(clip: &Clip) -> f64 {
    UNITS_IN_METRE * Stature::new(clip).metres
}

/// Position of the waist when the body stands straight on the ground, over the origin.
///
/// The model's upper and lower body turn about the waist, so the waist is followed rather than the root of the
/// pelvis. The legs then hang correctly when the pelvis tilts.
fn standing(capture: &Capture<'_>, stance: &Stance) -> DVec3 {
    let over_legs = capture.waist_over_legs().map_or(0.0, |way| (stance.pelvis * way).y);
    let leg = capture.leg().unwrap_or(0.0);
    let ankle = capture.standing_ankle(stance.up).unwrap_or(0.0);
    DVec3::new(0.0, over_legs + leg + ankle, 0.0)
}
