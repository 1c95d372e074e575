//! What of a body the cartoon filter moves.

use crate::knob::choices;
use crate::motion::{Clip, JointId, Landmarks, below};

/// What of a body the cartoon filter moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CartoonParts {
    /// What no foot hangs on (上半身): root, legs and feet stay as they were, and feet stand where they stood. Of a
    /// body without feet it is everything.
    #[default]
    Upper,
    /// Everything (全身), and the way of the root: kicks and jumps as well. Feet that stand slide a little.
    Body,
}

choices!(CartoonParts { Upper: "upper", Body: "body" });

impl CartoonParts {
    /// Which joints are moved.
    pub(super) fn joints(self, clip: &Clip) -> Vec<bool> {
        let skeleton = clip.skeleton();
        let mut moves = vec![true; skeleton.len()];
        if self == Self::Upper {
            for foot in Landmarks::of(clip).feet {
                let ankle = foot.ankle.joint;
                below(skeleton, ankle.0).for_each(|joint| moves[joint] = false);
                let mut carrier = Some(ankle);
                while let Some(JointId(joint)) = carrier {
                    moves[joint] = false;
                    carrier = skeleton.joints[joint].parent;
                }
            }
        }
        moves
    }
}
