//! The motion that the joints of one layer make, by which its keys are judged.

use std::sync::Arc;

use crate::error::Error;
use crate::keys::JointWeights;
use crate::keys::layers::LayerJoints;
use crate::motion::{Clip, Members, Skeleton};

/// The motion of a layer: its joints move, all others stay as in the clip's first frame.
///
/// A hand that is carried along by a walk therefore has no keys for the walk, whatever the hips do. The motion of a
/// layer is how its joints turn and move all that hangs on them, whichever way the rest of the body stands.
#[derive(Debug, Clone)]
pub(crate) struct LayerClip {
    pub(crate) clip: Arc<Clip>,
    /// Whether each joint is in the layer.
    pub(crate) moves: Vec<bool>,
    /// Weight of each joint's turns; 0 outside the layer.
    pub(crate) heard: Vec<f64>,
    /// Weight of each joint when poses are compared; 0 if the layer does not carry it.
    pub(crate) judged: Vec<f64>,
}

impl LayerClip {
    /// Builds the motion of a layer; for the whole body it is the clip itself.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`JointWeights::of`], and if no joint of the layer has a weight above 0.
    pub(crate) fn new(
        clip: &Arc<Clip>,
        layer: &LayerJoints,
        members: &Members,
        weights: &JointWeights,
    ) -> Result<Self, Error> {
        let skeleton = clip.skeleton();
        let own = weights.resolve(skeleton)?;
        // A layer of hair alone is judged by its hair.
        let is_of_body = layer.joints.iter().any(|joint| members.has(joint.0));
        let own = if is_of_body { only(&own, |joint| members.has(joint)) } else { own };
        if layer.is_whole(skeleton) {
            let moves = vec![true; skeleton.len()];
            return Ok(Self { clip: Arc::clone(clip), moves, judged: own.clone(), heard: own });
        }
        let mut moves = vec![false; skeleton.len()];
        layer.joints.iter().for_each(|joint| moves[joint.0] = true);
        let heard = only(&own, |joint| moves[joint]);
        if heard.iter().all(|weight| *weight == 0.0) {
            let name = &layer.name;
            let message = format!(
                "every joint of layer {name} has 0: leave one that has a say, or take the layer away"
            );
            return Err(Error::setting("keys.weights", message));
        }
        let carried = carried(skeleton, &moves);
        let judged = only(&own, |joint| carried[joint]);
        let clip = Arc::new(clip.with_others_still(&moves));
        Ok(Self { clip, moves, judged, heard })
    }
}

/// Returns the weights of some joints, and 0 for all others.
fn only(own: &[f64], counts: impl Fn(usize) -> bool) -> Vec<f64> {
    let own = own.iter().enumerate();
    own.map(|(joint, own)| if counts(joint) { *own } else { 0.0 }).collect()
}

/// Returns some joints and all below them.
fn carried(skeleton: &Skeleton, joints: &[bool]) -> Vec<bool> {
    let mut carried = joints.to_vec();
    for (joint, data) in skeleton.iter() {
        carried[joint.0] |= data.parent.is_some_and(|parent| carried[parent.0]);
    }
    carried
}
