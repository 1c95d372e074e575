//! The build of a body (体つき): which joints are the body, its landmarks, and the mannequin that fits it.

use crate::motion::body::landmarks::Looks;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::body::members::{self, Members};
use crate::motion::body::stature;
use crate::motion::body::upright::{self, By};
use crate::motion::{Clip, Landmarks, Stature};

/// What a body is like, looked for once: every stage that asks for limbs is given it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Build {
    pub(crate) members: Members,
    /// What names give of it.
    pub(crate) limbs: NamedLimbs,
    pub(crate) stature: Stature,
    /// By what it is known which way is up.
    pub(crate) up_by: By,
    pub(crate) landmarks: Landmarks,
    /// None for a body without head, two arms and two legs.
    pub(crate) mannequin: Option<Mannequin>,
}

impl Build {
    /// Describes whoever moves in a clip. A body of which only a part moves, and whose limbs nobody named, is the whole where
    /// the whole has limbs.
    pub(crate) fn of(clip: &Clip) -> Self {
        let bones = members::bones(clip);
        let moving = members::moving(clip, &bones);
        let limbs = {
            let tree = members::main_tree(&bones, &moving[0]);
            NamedLimbs::of(&bones, &tree, clip.declared())
        };
        let build = Self::with(clip, Members::of(&bones, moving, &limbs), limbs);
        if build.mannequin.is_some() || build.members.are_all() {
            return build;
        }
        let whole = Self::with(clip, Members::all(&bones), build.limbs.clone());
        if whole.mannequin.is_some() { whole } else { build }
    }

    /// Where head, hands and feet are by the shape and the motion of the body alone, whatever names say.
    pub(super) fn by_shape(&self, clip: &Clip) -> Landmarks {
        let nobody = NamedLimbs::default();
        let looks = Looks::at(clip, &self.members, &nobody);
        Landmarks::of_members(&looks, &self.members, &nobody, self.landmarks.up)
    }

    fn with(clip: &Clip, members: Members, limbs: NamedLimbs) -> Self {
        let looks = Looks::at(clip, &members, &limbs);
        let (size, rest) = stature::seen(clip, &members);
        let (up, up_by) = upright::up(clip, &members, &limbs, &looks, rest);
        let mut landmarks = Landmarks::of_members(&looks, &members, &limbs, up);
        let mannequin = Mannequin::of(members.skeleton(), &landmarks, &limbs);
        let height = mannequin.as_ref().map(Mannequin::height);
        landmarks.height = height.unwrap_or(landmarks.height);
        let stature = Stature::of_size(clip, height.unwrap_or(size), up);
        Self { members, limbs, stature, up_by, landmarks, mannequin }
    }
}
