//! Facts about a motion, besides its values, that its file or a person declares.

use crate::motion::{Axis, JointId};

/// Declared facts about a motion (宣言). They override anything inferred from it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Declared {
    /// Axis that points up, and the source of that fact. Default: `None`, as in BVH.
    pub up: Option<(Axis, Word)>,
    /// Metres per unit of the values. Default: `None`, as in BVH.
    pub metres: Option<f64>,
    /// Shoulder, elbow and wrist of the left and the right arm, then hip, knee and ankle of the left and the right
    /// leg, if a person names the joints. Default: `None`.
    pub limbs: [Option<[JointId; 3]>; 4],
    /// Head joint, if a person names it. Default: `None`.
    pub head: Option<JointId>,
}

/// Source of a declared fact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// A person who has seen the motion.
    Person,
    /// The motion file.
    File,
}

impl Declared {
    /// Facts declared by a file whose values are converted to Y up, in a unit of `metres` metres.
    pub fn y_up(metres: f64) -> Self {
        Self { up: Some((Axis::Y, Word::File)), metres: Some(metres), ..Self::default() }
    }
}
