//! Puts a clip's motion on the bones of a humanoid model: the common part of VMD and VRM animation.
//!
//! `cast` selects the model's bones and the joints that drive them, `capture` measures the clip's rest pose and
//! motion, `stance` aligns both rest poses, and `retarget` converts each drawing to rotations of bones.

pub(crate) mod capture;
pub(crate) mod cast;
pub(crate) mod rest_alignment;
pub(crate) mod retarget;
