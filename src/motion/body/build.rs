//! The build of a body (体つき): its landmarks, and the mannequin that fits it.

use crate::motion::body::mannequin::Mannequin;
use crate::motion::{Clip, Landmarks};

/// What a body is like, looked for once: every stage that asks for limbs is given it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Build {
    pub(crate) landmarks: Landmarks,
    /// None for a body without head, two arms and two legs.
    pub(crate) mannequin: Option<Mannequin>,
}

impl Build {
    pub(crate) fn of(clip: &Clip) -> Self {
        let landmarks = Landmarks::of(clip);
        let mannequin = Mannequin::of(clip, &landmarks);
        Self { landmarks, mannequin }
    }
}
