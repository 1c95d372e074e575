//! The build of a body (体つき): the joints that belong to it, its landmarks and its mannequin.

use crate::motion::body::landmarks::Looks;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::mannequin::Mannequin;
use crate::motion::body::members::{self, Members};
use crate::motion::body::stature;
use crate::motion::body::upright::{self, By};
use crate::motion::{Clip, Landmarks, Stature};

/// Properties of a body, computed once and shared by every stage that needs limbs.
#[derive(Debug, Clone, PartialEq)]
pub struct Build {
    /// Joints that belong to the body.
    pub members: Members,
    /// Limbs known by name.
    pub(crate) limbs: NamedLimbs,
    /// Its height and up axis.
    pub stature: Stature,
    /// Evidence for the up axis.
    pub(crate) up_by: By,
    pub(crate) landmarks: Landmarks,
    /// `None` for a body without head, two arms and two legs.
    pub(crate) mannequin: Option<Mannequin>,
}

impl Build {
    /// Describes the performer of a clip. If the moving joints alone have no limbs, all joints but those of other
    /// people are tried: perhaps only a part of the body moves.
    pub fn new(clip: &Clip) -> Self {
        let bones = members::bones(clip);
        let moving = members::moving(clip, &bones);
        let tree = members::main_tree(&bones, &moving[0]);
        let limbs = NamedLimbs::new(&bones, &tree, clip.declared());
        let build = Self::with(clip, Members::find(&bones, moving, &limbs), limbs);
        if build.mannequin.is_some() || build.members.are_all() {
            return build;
        }
        let whole = Self::with(clip, Members::all_of_one(&bones, &tree), build.limbs.clone());
        if whole.mannequin.is_some() { whole } else { build }
    }

    /// Finds head, hands and feet from shape and motion alone, ignoring names.
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
        let mannequin = Mannequin::new(members.skeleton(), &landmarks, &limbs);
        let height = mannequin.as_ref().map(Mannequin::height);
        landmarks.height = height.unwrap_or(landmarks.height);
        let stature = Stature::of_size(clip, height.unwrap_or(size), up);
        Self { members, limbs, stature, up_by, landmarks, mannequin }
    }
}
