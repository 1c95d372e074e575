//! From the capture's body to the model's: every pose in world rotations, each bone then against the
//! bone it hangs on. So chains of other lengths work: what joints between two mapped ones turn is in the
//! world rotation of the outer one, and a bone that nothing drives goes with its parent.

use glam::{DQuat, DVec3};

use super::capture::Capture;
use super::stance::Stance;
use crate::motion::body::names::bones::{Model, Part};
use crate::motion::{
    Body, Clip, Composite, CompositeRows, JointId, Pose, Stature, local_rotation, local_translation,
};

/// MMD units in a metre by custom, for a clip without legs to measure.
const UNITS_IN_METRE: f64 = 12.5;

/// The model's bone for a joint of the capture.
struct Driven {
    bone: usize,
    joint: JointId,
    right: DQuat,
}

/// Turns drawings into poses of the model.
pub(super) struct Retarget<'a> {
    clip: &'a Clip,
    model: &'a Model,
    rows: CompositeRows<'a>,
    row: Vec<f64>,
    pose: Pose,
    body: Body,
    driven: Vec<Driven>,
    waist: Option<JointId>,
    /// Which bone moves, and from where it stands at rest, in the capture's unit after `up`.
    center: Option<(usize, DVec3)>,
    up: DQuat,
    /// MMD units in the capture's unit.
    pub(super) scale: f64,
}

/// A bone's pose in BVH's right-handed axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Local {
    pub(super) translation: DVec3,
    pub(super) rotation: DQuat,
}

impl<'a> Retarget<'a> {
    /// `leg` is the model's, from where it begins to the ankle, in MMD units.
    pub(super) fn new(
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
            rows: CompositeRows::of(composite),
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

    pub(super) fn name(&self, bone: usize) -> &str {
        &self.model.bones[bone].name
    }

    /// Bones that get keys, in the model's order.
    pub(super) fn bones(&self) -> Vec<usize> {
        let center = self.center.map(|(bone, _)| bone);
        center.into_iter().chain(self.driven.iter().map(|driven| driven.bone)).collect()
    }

    /// Whether the first of [`Retarget::bones`] is the centre (センター), which alone goes through the room.
    pub(super) fn has_center(&self) -> bool {
        self.center.is_some()
    }

    /// The pose of a drawing on a koma, one entry for each of [`Retarget::bones`].
    pub(super) fn take(&mut self, drawing: usize, koma: usize) -> Vec<Local> {
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

    /// Where a joint is in the pose that was taken last, after `up` and in the capture's unit.
    pub(super) fn place(&self, joint: JointId) -> DVec3 {
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

    /// The world rotation of what carries a bone: the nearest bone above that is driven.
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

/// MMD units in the clip's unit.
fn without_legs(clip: &Clip) -> f64 {
    UNITS_IN_METRE * Stature::of(clip).metres
}

/// Where the waist is when the body stands straight on the ground, over the origin.
///
/// The model's upper and lower body turn about the waist, so it is the waist that is followed and not the
/// root of the pelvis: so the legs hang where they should when it tilts.
fn standing(capture: &Capture<'_>, stance: &Stance) -> DVec3 {
    let over_legs = capture.waist_over_legs().map_or(0.0, |way| (stance.pelvis * way).y);
    let leg = capture.leg().unwrap_or(0.0);
    let ankle = capture.standing_ankle(stance.up).unwrap_or(0.0);
    DVec3::new(0.0, over_legs + leg + ankle, 0.0)
}
