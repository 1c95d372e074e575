//! Finds the joints that make up the body (体をなす関節). Rigs also have references that stay in place, and joints that
//! hang on them.
//!
//! Code that asks for the lengths of bones, for limbs or for ends looks at the body alone.

use glam::DVec3;

use crate::motion::body::accessories::Rig;
use crate::motion::body::limbs::NamedLimbs;
use crate::motion::body::role::Role;
use crate::motion::landmarks::{above, body_root, bones_by_tree};
use crate::motion::{Channel, Clip, EndSite, Joint, JointId, Skeleton, local_translation};

/// Least rotation in degrees that counts as movement: single floats and rounded decimals have smaller noise.
const LEAST_TURN: f64 = 0.05;

/// Least displacement that counts as movement, as a share of the sum of all bones.
const LEAST_WAY: f64 = 1e-4;

/// The joints of a clip that are the body.
#[derive(Debug, Clone, PartialEq)]
pub struct Members {
    roles: Vec<Role>,
    /// Skeleton in which joints outside the body are isolated: without length, parent and tips. A root of the body
    /// has no parent.
    skeleton: Skeleton,
    /// Largest distance of a tip from its joint at which it belongs to the body, in the file's unit.
    longest: f64,
}

impl Members {
    /// Finds the body in a skeleton. In each tree it begins at the lowest joint that carries everything that moves
    /// and all named limbs. If anything moves, trees without movement are not part of the body.
    pub(super) fn find(
        skeleton: &Skeleton,
        [moves, travels]: [Vec<bool>; 2],
        limbs: &NamedLimbs,
    ) -> Self {
        let begins = if moves.contains(&true) {
            tops(skeleton, &moves, limbs)
        } else {
            skeleton.joints.iter().map(|joint| joint.parent.is_none()).collect()
        };
        let mut roles = below(skeleton, &begins);
        leave_out_others(skeleton, &main_tree(skeleton, &moves), &mut roles);
        Rig { skeleton, limbs, moves: &moves, travels: &travels }.strip(&mut roles);
        let longest = longest_tip(skeleton, &roles).max(limbs.longest_tip(skeleton));
        Self { skeleton: alone(skeleton, &roles, longest), roles, longest }
    }

    /// Takes every joint as part of the body, except those of other people.
    pub(crate) fn all_of_one(skeleton: &Skeleton, is_main: &[bool]) -> Self {
        let mut roles = vec![Role::Body; skeleton.len()];
        leave_out_others(skeleton, is_main, &mut roles);
        let longest = f64::INFINITY;
        Self { skeleton: alone(skeleton, &roles, longest), roles, longest }
    }

    /// Whether every joint is part of the body.
    pub(crate) fn are_all(&self) -> bool {
        self.roles.iter().all(|role| *role == Role::Body)
    }

    /// Skeleton of the body alone.
    pub(crate) fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Whether a joint is part of the body.
    pub(crate) fn has(&self, joint: usize) -> bool {
        self.roles[joint] == Role::Body
    }

    /// Returns the roots of other people's trees.
    pub(super) fn others<'a>(&'a self, clip: &'a Clip) -> impl Iterator<Item = &'a str> {
        let roots = clip.skeleton().joints.iter().zip(&self.roles);
        let roots = roots.filter(|(joint, role)| joint.parent.is_none() && **role == Role::Other);
        roots.map(|(joint, _)| &joint.name[..])
    }

    /// Number of joints with a role.
    pub(super) fn count(&self, role: Role) -> usize {
        self.roles.iter().filter(|own| **own == role).count()
    }

    /// Marks the points of a clip, joints and then tips, that are part of the body.
    pub(crate) fn own_points(&self, skeleton: &Skeleton) -> Vec<bool> {
        self.points(skeleton, |joint| self.has(joint))
    }

    /// Marks the points of a clip that appear in a picture. Technical joints of the rig do not.
    pub fn shown(&self, skeleton: &Skeleton) -> Vec<bool> {
        self.points(skeleton, |joint| {
            matches!(
                self.roles[joint],
                Role::Body | Role::Hair | Role::Prop | Role::Far | Role::Other
            )
        })
    }

    fn points(&self, skeleton: &Skeleton, is: impl Fn(usize) -> bool) -> Vec<bool> {
        let of_tips = skeleton.iter().flat_map(|(joint, data)| {
            let is_one = is(joint.0);
            let near = |end: &EndSite| end.offset.length() <= self.longest;
            data.end_sites.iter().map(move |end| is_one && near(end))
        });
        (0..skeleton.len()).map(&is).chain(of_tips).collect()
    }

    /// Returns the joint at which the largest part of the body begins.
    pub(crate) fn root(&self) -> usize {
        body_root(&self.skeleton).unwrap_or(0)
    }

    /// Returns the size of the joints' bounding box; `positions` begins with those of all joints.
    pub(crate) fn extent(&self, positions: &[DVec3]) -> DVec3 {
        let joints = || positions.iter().zip(&self.roles);
        let own = || joints().filter(|(_, role)| **role == Role::Body).map(|(place, _)| *place);
        let corners = own().reduce(DVec3::min).zip(own().reduce(DVec3::max));
        corners.map_or(DVec3::ZERO, |(low, high)| high - low)
    }
}

/// Assigns roles, given the joints at which bodies begin.
fn below(skeleton: &Skeleton, begins: &[bool]) -> Vec<Role> {
    let mut roles = vec![Role::Still; skeleton.len()];
    for (joint, data) in skeleton.iter() {
        let is_carried = data.parent.is_some_and(|parent| roles[parent.0] == Role::Body);
        if begins[joint.0] || is_carried {
            roles[joint.0] = Role::Body;
        }
    }
    for (joint, _) in skeleton.iter().filter(|(joint, _)| begins[joint.0]) {
        above(skeleton, joint.0).skip(1).for_each(|guide| roles[guide] = Role::Guide);
    }
    roles
}

/// Longest tip of a bone, as a share of all bones of the body.
const LONGEST_TIP: f64 = 0.15;

/// Returns the largest distance of a tip from its joint. Some hands have a tip that is as far away as the floor.
fn longest_tip(skeleton: &Skeleton, roles: &[Role]) -> f64 {
    let is_own = |joint: &JointId| roles[joint.0] == Role::Body;
    let own = skeleton
        .iter()
        .filter(|(joint, data)| is_own(joint) && data.parent.is_some_and(|parent| is_own(&parent)));
    let bones: Vec<f64> = own.map(|(_, data)| data.offset.length()).collect();
    if bones.len() < PERSON.0 { f64::INFINITY } else { LONGEST_TIP * bones.iter().sum::<f64>() }
}

/// Isolates the joints that have another role than the body.
fn alone(skeleton: &Skeleton, roles: &[Role], longest: f64) -> Skeleton {
    let mut skeleton = skeleton.clone();
    for (joint, role) in skeleton.joints.iter_mut().zip(roles) {
        joint.parent = joint.parent.filter(|parent| roles[parent.0] == Role::Body);
        joint.end_sites.retain(|end| end.offset.length() <= longest);
        if *role != Role::Body {
            (joint.parent, joint.offset) = (None, DVec3::ZERO);
            joint.end_sites.clear();
        }
    }
    skeleton
}

/// Returns the skeleton with offsets taken from position channels: some files have zero offsets and keep the bones in
/// these channels.
pub(super) fn bones(clip: &Clip) -> Skeleton {
    let mut skeleton = clip.skeleton().clone();
    if let Some(first) = clip.rows().next() {
        for joint in skeleton.joints.iter_mut().filter(|joint| joint.parent.is_some()) {
            joint.offset = local_translation(joint, first);
        }
    }
    skeleton
}

/// Marks the joints that move relative to their parent, and those that change position relative to it.
pub(super) fn moving(clip: &Clip, skeleton: &Skeleton) -> [Vec<bool>; 2] {
    let ranges = clip.ranges();
    let size: f64 = skeleton.joints.iter().map(|joint| joint.offset.length()).sum();
    let any = |joint: &Joint, has: fn(&Channel) -> bool| {
        let channels = joint.channels.iter().zip(&ranges[joint.first_channel..]);
        let is_more = |(channel, range): (&Channel, &f64)| match channel {
            Channel::Rotation(_) => *range > LEAST_TURN,
            Channel::Position(_) => *range > LEAST_WAY * size,
        };
        channels.filter(|(channel, _)| has(channel)).any(is_more)
    };
    let joints = || skeleton.joints.iter();
    let travels =
        joints().map(|joint| any(joint, |channel| matches!(channel, Channel::Position(_))));
    [joints().map(|joint| any(joint, |_| true)).collect(), travels.collect()]
}

/// Whether a clip has no movement at all.
pub fn is_still(clip: &Clip) -> bool {
    let [moves, _] = moving(clip, &bones(clip));
    !moves.contains(&true)
}

/// Marks the joints of the main tree: the one with the greatest sum of bone lengths among those that move.
pub(super) fn main_tree(skeleton: &Skeleton, moves: &[bool]) -> Vec<bool> {
    let roots = skeleton.roots();
    let bones = bones_by_tree(skeleton, &roots);
    let mut is_moving = vec![false; moves.len()];
    roots.iter().zip(moves).for_each(|(root, moves)| is_moving[*root] |= moves);
    let largest = |best: usize, other: usize| {
        let is_more = (is_moving[other], bones[other]) > (is_moving[best], bones[best]);
        if is_more { other } else { best }
    };
    let main = roots.iter().copied().reduce(largest);
    roots.iter().map(|root| Some(*root) == main).collect()
}

/// Least number of joints of a person, and the least share of the main tree's bones that another person has.
const PERSON: (usize, f64) = (8, 1.0 / 3.0);

/// Marks the joints of other people than the one whose keys are found.
pub(super) fn joints_of_others(clip: &Clip) -> Vec<bool> {
    let skeleton = bones(clip);
    if skeleton.joints.iter().filter(|joint| joint.parent.is_none()).count() < 2 {
        return vec![false; skeleton.len()];
    }
    let [moves, _] = moving(clip, &skeleton);
    of_others(&skeleton, &main_tree(&skeleton, &moves))
}

fn leave_out_others(skeleton: &Skeleton, is_main: &[bool], roles: &mut [Role]) {
    let others =
        roles.iter_mut().zip(of_others(skeleton, is_main)).filter(|(_, is_other)| *is_other);
    others.for_each(|(role, _)| *role = Role::Other);
}

/// Marks the joints of other people: those of trees as large as a person, besides the main one.
fn of_others(skeleton: &Skeleton, is_main: &[bool]) -> Vec<bool> {
    let roots = skeleton.roots();
    let bones = bones_by_tree(skeleton, &roots);
    let mut joints = vec![0; roots.len()];
    roots.iter().for_each(|root| joints[*root] += 1);
    let main = is_main.iter().position(|is_main| *is_main).map_or(0.0, |main| bones[roots[main]]);
    let is_person = |root: usize| joints[root] >= PERSON.0 && bones[root] >= PERSON.1 * main;
    roots.iter().zip(is_main).map(|(root, is_main)| !is_main && is_person(*root)).collect()
}

/// Marks the joint at which the body begins in each moving tree.
fn tops(skeleton: &Skeleton, moves: &[bool], limbs: &NamedLimbs) -> Vec<bool> {
    let mut wanted = moves.to_vec();
    limbs.joints().for_each(|joint| wanted[joint] = true);
    let mut is_moving = moves.to_vec();
    for (joint, data) in skeleton.iter().rev() {
        if let Some(parent) = data.parent {
            is_moving[parent.0] |= is_moving[joint.0];
        }
    }
    let roots = skeleton.roots();
    let mut lowest = carriers(skeleton, &roots, &wanted);
    if limbs.are_whole() {
        let mut core = vec![false; wanted.len()];
        limbs.joints().for_each(|joint| core[joint] = true);
        // Further moving joints of the tree may hang on a joint that only carries the body.
        for (top, carrier) in lowest.iter_mut().zip(carriers(skeleton, &roots, &core)) {
            let begin = |carrier| above(skeleton, carrier).filter(|joint| moves[*joint]).last();
            *top = carrier.map(|carrier| begin(carrier).unwrap_or(carrier)).or(*top);
        }
    }
    let mut tops = vec![false; wanted.len()];
    let moving = lowest.into_iter().zip(is_moving).filter(|(_, is_moving)| *is_moving);
    moving.filter_map(|(top, _)| top).for_each(|top| tops[top] = true);
    tops
}

/// Returns, for each root, the lowest joint that carries all wanted joints of its tree, if there are any.
fn carriers(skeleton: &Skeleton, roots: &[usize], wanted: &[bool]) -> Vec<Option<usize>> {
    let mut below: Vec<usize> = wanted.iter().map(|wanted| usize::from(*wanted)).collect();
    for (joint, data) in skeleton.iter().rev() {
        if let Some(parent) = data.parent {
            below[parent.0] += below[joint.0];
        }
    }
    // Parents come first, so the last joint that carries all of them is the lowest.
    let mut lowest = vec![None; below.len()];
    for (joint, root) in roots.iter().enumerate() {
        if below[joint] > 0 && below[joint] == below[*root] {
            lowest[*root] = Some(joint);
        }
    }
    lowest
}
