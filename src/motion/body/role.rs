//! What a joint is to the body (関節の役割).

/// What a joint is to the body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// A part of it.
    Body,
    /// Carries the body and never moves, as the reference of a scene.
    Guide,
    /// Never moves: it hangs on nothing that does, or is a point on a bone.
    Still,
    /// A helper or a control of the rig.
    Helper,
    /// Hair, cloth, a tail.
    Hair,
    /// Something that is held or worn.
    Prop,
    /// Reaches too far from the body to be a part of it.
    Far,
    /// Somebody else's, who is in the same file.
    Other,
}
