//! What keys of one layer are judged by: the motion that its own joints make.

use std::sync::Arc;

use crate::error::Error;
use crate::keys::JointWeights;
use crate::keys::layers::LayerJoints;
use crate::motion::{Clip, Members, Skeleton};

/// The motion of a layer: its joints move, all others stay as in the clip's first frame.
///
/// So a hand that is carried along by a walk has no keys for it, whatever the hips do: what counts is how
/// a joint turns and what hangs on it, and both are the same whichever way the rest of the body stands.
#[derive(Debug, Clone)]
pub(crate) struct LayerClip {
    pub(crate) clip: Arc<Clip>,
    /// Which joints are of the layer.
    pub(crate) moves: Vec<bool>,
    /// How much each joint's turns count; 0 outside the layer.
    pub(crate) heard: Vec<f64>,
    /// How much each joint counts where poses are compared; 0 for what the layer does not carry.
    pub(crate) judged: Vec<f64>,
}

impl LayerClip {
    /// The motion of some joints; of the whole body it is the clip itself.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`JointWeights::of`], and where none of them has a say.
    pub(crate) fn of(
        clip: &Arc<Clip>,
        layer: &LayerJoints,
        members: &Members,
        weights: &JointWeights,
    ) -> Result<Self, Error> {
        let skeleton = clip.skeleton();
        let own = weights.of(skeleton)?;
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

/// Weights of some joints, and 0 for all others.
fn only(own: &[f64], counts: impl Fn(usize) -> bool) -> Vec<f64> {
    let own = own.iter().enumerate();
    own.map(|(joint, own)| if counts(joint) { *own } else { 0.0 }).collect()
}

/// Some joints and all that hang on them.
fn carried(skeleton: &Skeleton, joints: &[bool]) -> Vec<bool> {
    let mut carried = joints.to_vec();
    for (joint, data) in skeleton.iter() {
        carried[joint.0] |= data.parent.is_some_and(|parent| carried[parent.0]);
    }
    carried
}
