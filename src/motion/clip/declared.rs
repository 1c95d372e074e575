//! What is said of a motion besides its values: by its file, or by a person.

use crate::motion::{Axis, JointId};

/// What is said of a motion (宣言). It goes before whatever can be seen.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Declared {
    /// The axis that points up, and who says so. Default: none, as in a BVH.
    pub up: Option<(Axis, Word)>,
    /// Metres in a unit of the values. Default: none, as in a BVH.
    pub metres: Option<f64>,
    /// Shoulder, elbow and wrist of the left and the right arm, then hip, knee and ankle of the legs, as far as a person says
    /// which joints they are. Default: none.
    pub limbs: [Option<[JointId; 3]>; 4],
    /// The head, likewise.
    pub head: Option<JointId>,
}

/// Whose word something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Word {
    /// A person's, who has seen the motion.
    Person,
    /// The file's.
    File,
}

impl Declared {
    /// What a file says whose values are turned to Y up, in a unit of so many metres.
    pub(crate) fn y_up(metres: f64) -> Self {
        Self { up: Some((Axis::Y, Word::File)), metres: Some(metres), ..Self::default() }
    }
}
