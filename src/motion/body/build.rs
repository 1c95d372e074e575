//! The build of a body (体つき): which joints are the body, its landmarks, and the mannequin that fits it.

use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::body::members::{self, Members};
use crate::motion::{Clip, Landmarks, Stature};

/// What a body is like, looked for once: every stage that asks for limbs is given it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Build {
    pub(crate) members: Members,
    pub(crate) stature: Stature,
    pub(crate) landmarks: Landmarks,
    /// None for a body without head, two arms and two legs.
    pub(crate) mannequin: Option<Mannequin>,
}

impl Build {
    /// Describes whoever moves in a clip. A body of which only a part moves, and whose limbs nobody named, is the whole where
    /// the whole has limbs.
    pub(crate) fn of(clip: &Clip) -> Self {
        let bones = members::bones(clip);
        let limbs = NamedLimbs::of(&bones);
        let build = Self::with(clip, Members::of(clip, &bones, &limbs), &limbs);
        if build.mannequin.is_some() || build.members.are_all() {
            return build;
        }
        let whole = Self::with(clip, Members::all(&bones), &limbs);
        if whole.mannequin.is_some() { whole } else { build }
    }

    fn with(clip: &Clip, members: Members, limbs: &NamedLimbs) -> Self {
        let stature = Stature::of_members(clip, &members);
        let landmarks = Landmarks::of_members(clip, &members, limbs, stature.up);
        let mannequin = Mannequin::of(members.skeleton(), &landmarks, limbs);
        Self { members, stature, landmarks, mannequin }
    }
}
