//! The parts of the body that the cartoon filter moves.

use crate::knob::choices;
use crate::motion::{Clip, JointId, Landmarks, below};

/// The parts of the body that the cartoon filter moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CartoonParts {
    /// The parts that carry no foot (上半身): root, legs and feet stay unchanged, so planted feet do not slide. For a body
    /// without feet, everything.
    #[default]
    Upper,
    /// Everything (全身), including the path of the root: kicks and jumps as well. Planted feet slide a little.
    Body,
}

choices!(CartoonParts { Upper: "upper", Body: "body" });

impl CartoonParts {
    /// Returns for each joint whether it is moved.
    pub(super) fn joints(self, clip: &Clip) -> Vec<bool> {
        let skeleton = clip.skeleton();
        let mut moves = vec![true; skeleton.len()];
        if self == Self::Upper {
            for foot in Landmarks::new(clip).feet {
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
