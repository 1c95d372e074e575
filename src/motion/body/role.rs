//! The role of a joint in a body (関節の役割).

/// Role of a joint in a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Part of the body.
    Body,
    /// Carries the body and never moves, like the reference of a scene.
    Guide,
    /// Never moves: hangs on nothing that moves, or is a point on a bone.
    Still,
    /// A helper or a control of the rig.
    Helper,
    /// Hair, cloth, a tail.
    Hair,
    /// Something held or worn.
    Prop,
    /// Reaches too far from the body to be part of it.
    Far,
    /// Belongs to another person in the same file.
    Other,
}
