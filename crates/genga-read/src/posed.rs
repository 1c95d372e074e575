//! Converts world transforms of nodes, frame by frame, to a clip. All formats with node trees use it.
//!
//! A clip's rest pose has no rotation, while a node may rest at any. So each joint turns relative to its
//! node's rest: W·G⁻¹ of the parent times G·W⁻¹ of the joint, where G is the current rotation and W the
//! rest rotation. World positions are preserved, whatever scales, pre-rotations and parents produced them.
//! A joint that stays at its place on its parent has that place as its offset; any other joint has position
//! channels.

#[cfg(test)]
mod tests;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::reading::Options;
use genga::error::{Error, Place, Warning};
use genga::motion::bvh::warnings::{NAME_MISSING, NAME_TWICE, ROOTS};
use genga::motion::bvh::{no_tree, renamed};
use genga::motion::{Axis, Channel, Clip, EndSite, Joint, JointId, Skeleton, set_local_rotation};
use genga::time::{Frame, FrameRate};

/// A joint that strays less than this share of the body's size on its parent counts as fixed there:
/// single-precision floats have such noise.
const STILL: f64 = 2e-6;

/// Bytes per joint and frame while a clip is built: its transform and its row.
const POSE: u64 = 104;

/// Least number of joints that a frame counts as having, so that a take of days is rejected even for a tiny
/// skeleton.
const LEAST_JOINTS: u64 = 5;

/// Position and rotation of a node, in the world or relative to its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stand {
    pub(super) place: DVec3,
    pub(super) turn: DQuat,
}

impl Stand {
    /// Extracts position and rotation from a matrix. Its scale and shear only affect the nodes below.
    pub(super) fn new(matrix: &DAffine3) -> Self {
        let [x, y] = [matrix.matrix3.x_axis, matrix.matrix3.y_axis];
        let x = x.normalize_or_zero();
        let y = (y - x * x.dot(y)).normalize_or_zero();
        let turn = DMat3::from_cols(x, y, x.cross(y));
        // An axis scaled to zero has no direction.
        let turn = if turn.determinant() > 0.5 { DQuat::from_mat3(&turn) } else { DQuat::IDENTITY };
        Self { place: matrix.translation, turn: turn.normalize() }
    }
}

/// A node that becomes a joint.
#[derive(Debug, Clone)]
pub(super) struct Bone {
    pub name: String,
    /// Index of the parent bone, which precedes this one in the list.
    pub parent: Option<usize>,
    /// Rest transform in the world.
    pub rest: Stand,
}

/// Bones with their transforms over all frames, from which a clip is built.
pub(super) struct Posed {
    bones: Vec<Bone>,
    /// Transform of each bone relative to its parent, frame after frame.
    local: Vec<Stand>,
    /// Index of each bone in the list from which it was taken.
    from: Vec<usize>,
    /// Whether each bone leaves its place on its parent, and whether it only marks its end.
    moving: Vec<bool>,
    tips: Vec<bool>,
    warnings: Vec<Warning>,
}

impl Posed {
    /// Collects the transforms of the bones for each frame; `stand` fills in the world transforms. Keeps
    /// only the tree of `options.root`, if given.
    ///
    /// # Errors
    /// [`Error::Motion`] if there is no bone, if the poses exceed the memory limit, or if a transform is
    /// not finite; [`Error::Setting`] if no tree has the requested root.
    pub(super) fn new(
        mut bones: Vec<Bone>,
        frames: usize,
        options: &Options,
        mut stand: impl FnMut(usize, &mut [DAffine3]),
    ) -> Result<Self, Error> {
        let mut warnings = Vec::new();
        name(&mut bones, &mut warnings);
        let kept = tree(&bones, options.root.as_deref(), &mut warnings)?;
        let count = kept.iter().filter(|kept| **kept).count();
        check_size(count, frames, options)?;
        let mut world = vec![DAffine3::IDENTITY; bones.len()];
        let mut turned = vec![Stand { place: DVec3::ZERO, turn: DQuat::IDENTITY }; bones.len()];
        let mut local = Vec::with_capacity(frames * count);
        for frame in 0..frames {
            stand(frame, &mut world);
            for (at, bone) in bones.iter().enumerate() {
                if !world[at].is_finite() {
                    return Err(nowhere(&bone.name, frame));
                }
                let Stand { place, turn } = Stand::new(&world[at]);
                turned[at] = Stand { place, turn: turn * bone.rest.turn.conjugate() };
                if kept[at] {
                    local.push(on_parent(turned[at], bone.parent.map(|parent| turned[parent])));
                }
            }
        }
        let bones = select(bones, &kept);
        let from = (0..kept.len()).filter(|bone| kept[*bone]).collect();
        let (moving, tips) = (Vec::new(), Vec::new());
        let mut posed = Self { bones, local, from, moving, tips, warnings };
        let (count, size) = (posed.bones.len(), posed.size());
        posed.moving = (0..count).map(|bone| posed.moves(bone, size)).collect();
        posed.tips = (0..count).map(|bone| posed.is_tip(bone)).collect();
        Ok(posed)
    }

    /// Builds the clip, and returns the warnings about its joints.
    ///
    /// # Errors
    /// [`Error::Clip`] if a value is not finite.
    pub(super) fn clip(self, rate: FrameRate) -> Result<(Clip, Vec<Warning>), Error> {
        let count = self.bones.len();
        let skeleton = self.skeleton();
        let joints: Vec<usize> = (0..count).filter(|bone| !self.tips[*bone]).collect();
        let (width, frames) = (skeleton.channels(), self.local.len() / count.max(1));
        let mut values = vec![0.0; width * frames];
        for (frame, stands) in self.local.chunks_exact(count).enumerate() {
            let (before, after) = values.split_at_mut(frame * width);
            let row = &mut after[..width];
            // Angles continue from those of the previous row.
            if let Some(before) = before.rchunks_exact(width.max(1)).next() {
                row.copy_from_slice(before);
            }
            for (joint, bone) in skeleton.joints.iter().zip(&joints) {
                write(joint, &stands[*bone], row);
            }
        }
        Ok((Clip::new(skeleton, rate, Frame(0), frames, values)?, self.warnings))
    }

    /// Returns the index of each joint of the clip in the list of bones that was given.
    pub(super) fn joints(&self) -> impl Iterator<Item = usize> {
        self.from.iter().zip(&self.tips).filter(|(_, is_tip)| !**is_tip).map(|(from, _)| *from)
    }

    /// Total length of the bones in the first frame.
    fn size(&self) -> f64 {
        self.local.iter().take(self.bones.len()).zip(&self.bones).fold(0.0, |sum, (stand, bone)| {
            sum + if bone.parent.is_some() { stand.place.length() } else { 0.0 }
        })
    }

    /// Whether a bone leaves its place on its parent; roots always count as moving.
    fn moves(&self, bone: usize, size: f64) -> bool {
        let mut places = self.local.iter().skip(bone).step_by(self.bones.len());
        let Some(first) = places.next().map(|stand| stand.place) else { return true };
        let strays = |stand: &Stand| (stand.place - first).length() > STILL * size;
        self.bones[bone].parent.is_none() || places.any(strays)
    }

    /// Whether a bone only marks the end of its parent: it is named like one, has no children and never
    /// moves.
    fn is_tip(&self, bone: usize) -> bool {
        let Bone { name, parent, .. } = &self.bones[bone];
        let called = ["end", "leaf", "nub", "tip", "site"];
        let name = name.to_lowercase();
        // The End Sites of assimp start with this, followed by the name of their parent.
        let is_called =
            called.iter().any(|end| name.ends_with(end)) || name.starts_with("endsite_");
        let turns = || {
            let mut stands = self.local.iter().skip(bone).step_by(self.bones.len());
            let first = stands.next().map_or(DQuat::IDENTITY, |stand| stand.turn);
            stands.any(|stand| stand.turn.dot(first).abs() < 1.0 - 1e-9)
        };
        parent.is_some()
            && !self.moving[bone]
            && is_called
            && self.bones.iter().all(|other| other.parent != Some(bone))
            && !turns()
    }

    fn skeleton(&self) -> Skeleton {
        let mut skeleton = Skeleton::default();
        let mut joints = vec![0; self.bones.len()];
        let mut first_channel = 0;
        for (at, bone) in self.bones.iter().enumerate() {
            let rest = bone.parent.map_or(DVec3::ZERO, |parent| self.bones[parent].rest.place);
            let here = self.local.get(at).filter(|_| !self.moving[at]);
            let offset = here.map_or(bone.rest.place - rest, |stand| stand.place);
            let parent = bone.parent.map(|parent| joints[parent]);
            if let (true, Some(parent)) = (self.tips[at], parent) {
                let parent: &mut Joint = &mut skeleton.joints[parent];
                parent.end_sites.push(EndSite { name: bone.name.clone(), offset });
                continue;
            }
            joints[at] = skeleton.len();
            let positions = [Axis::X, Axis::Y, Axis::Z].map(Channel::Position);
            let positions = positions.into_iter().filter(|_| self.moving[at]);
            let rotations = [Axis::Z, Axis::X, Axis::Y].map(Channel::Rotation);
            let channels: Vec<Channel> = positions.chain(rotations).collect();
            let (name, parent) = (bone.name.clone(), parent.map(JointId));
            let width = channels.len();
            let end_sites = Vec::new();
            skeleton.joints.push(Joint {
                name,
                parent,
                offset,
                channels,
                first_channel,
                end_sites,
            });
            first_channel += width;
        }
        skeleton
    }
}

/// Writes the transform of a joint relative to its parent.
fn write(joint: &Joint, stand: &Stand, row: &mut [f64]) {
    for (at, channel) in joint.channels.iter().enumerate() {
        if let Channel::Position(axis) = channel {
            row[joint.first_channel + at] = stand.place[*axis as usize];
        }
    }
    set_local_rotation(joint, stand.turn, row);
}

fn on_parent(stand: Stand, parent: Option<Stand>) -> Stand {
    let Some(parent) = parent else { return stand };
    let back = parent.turn.conjugate();
    Stand { place: back * (stand.place - parent.place), turn: (back * stand.turn).normalize() }
}

/// The nodes of a scene, from which joints are chosen in addition to the bones that the file names.
pub(super) struct Nodes<'a> {
    /// All nodes, parents first.
    pub(super) order: &'a [usize],
    pub(super) parents: &'a [Option<usize>],
    pub(super) moves: &'a [bool],
    /// Whether a node is visible: a camera, a light, a shape or a control.
    pub(super) is_seen: &'a [bool],
}

impl Nodes<'_> {
    /// Adds the moving nodes in the trees of the bones, and the nodes that hang on these, because skins do
    /// not name every joint of a body. Returns the moving nodes that become no joints: visible things that
    /// carry nothing that moves, and other trees.
    pub(super) fn choose_moving(&self, chosen: &mut [bool]) -> Vec<usize> {
        let Self { order, parents, moves, is_seen } = self;
        let mut trees = vec![0; chosen.len()];
        let mut has_bones = vec![false; chosen.len()];
        for &node in *order {
            trees[node] = parents[node].map_or(node, |parent| trees[parent]);
            has_bones[trees[node]] |= chosen[node];
        }
        let carries_moving = below(order, parents, moves);
        let may = |node: usize| {
            has_bones[trees[node]]
                && (!is_seen[node] || carries_moving[node] > usize::from(moves[node]))
        };
        let mut wanted: Vec<bool> =
            (0..chosen.len()).map(|node| chosen[node] || moves[node] && may(node)).collect();
        let below = below(order, parents, &wanted);
        let mut total = wanted.iter().filter(|wanted| **wanted).count();
        // A node that carries all wanted ones moves the whole root, wherever that is, and is no joint
        // itself.
        for &node in order.iter().filter(|node| !chosen[**node]) {
            if wanted[node] && below[node] == total {
                wanted[node] = false;
                total -= 1;
            }
        }
        let mut added = vec![false; chosen.len()];
        for &node in order.iter().filter(|node| !chosen[**node]) {
            let hangs = parents[node].is_some_and(|parent| added[parent]);
            added[node] = wanted[node] || hangs && may(node);
        }
        let is_left_out = |node: &&usize| moves[**node] && !chosen[**node] && !may(**node);
        let left_out = order.iter().filter(is_left_out).copied().collect();
        chosen.iter_mut().zip(added).for_each(|(chosen, added)| *chosen |= added);
        left_out
    }
}

/// Counts for each node the marked nodes below it, itself included. `order` has parents first.
fn below(order: &[usize], parents: &[Option<usize>], some: &[bool]) -> Vec<usize> {
    let mut below: Vec<usize> = some.iter().map(|node| usize::from(*node)).collect();
    for &node in order.iter().rev() {
        if let Some(parent) = parents[node] {
            below[parent] += below[node];
        }
    }
    below
}

/// Adds the lowest node that carries all trees, if `may` allows it, and all nodes in between. `order` has
/// parents first.
pub(super) fn join(
    order: &[usize],
    parents: &[Option<usize>],
    chosen: &mut [bool],
    may: impl Fn(usize) -> bool,
) {
    let total = chosen.iter().filter(|chosen| **chosen).count();
    let below = below(order, parents, chosen);
    // The last node in the order that carries all chosen ones is the lowest.
    let carries = |node: &&usize| below[**node] == total && total > 0;
    let Some(&top) = order.iter().rev().find(carries).filter(|top| may(**top)) else { return };
    let mut inside = vec![false; chosen.len()];
    for &node in order {
        inside[node] = node == top || parents[node].is_some_and(|parent| inside[parent]);
        chosen[node] |= inside[node] && below[node] > 0;
    }
}

fn nowhere(name: &str, frame: usize) -> Error {
    let place = Place::Part(format!("joint {name}, frame {frame}"));
    Error::Motion { place, message: "a curve that moves it has a value that is no number".into() }
}

fn check_size(bones: usize, frames: usize, options: &Options) -> Result<(), Error> {
    let wrong = |message: String| Err(Error::Motion { place: Place::Whole, message });
    if bones == 0 || frames == 0 {
        return wrong("there is no joint that moves: there is no motion".into());
    }
    let of_frame = POSE * LEAST_JOINTS.max(bones as u64);
    let bytes = of_frame.saturating_mul(frames as u64);
    if bytes <= options.stream.bytes {
        return Ok(());
    }
    wrong(format!(
        "{bones} joints in {frames} frames are more than is taken into memory; a lower --fps takes fewer, \
         --memory GIB allows more"
    ))
}

/// Gives every bone a unique name on a single line.
fn name(bones: &mut [Bone], warnings: &mut Vec<Warning>) {
    let mut missing = None;
    for (at, bone) in bones.iter_mut().enumerate() {
        let plain = |letter: char| if letter.is_control() { ' ' } else { letter };
        let words: String = bone.name.chars().map(plain).collect();
        bone.name = words.split_whitespace().collect::<Vec<_>>().join(" ");
        if bone.name.is_empty() {
            bone.name = format!("joint_{at}");
            missing = missing.or(Some(at));
        }
    }
    if let Some(at) = missing {
        let message = format!("a joint has no name; it is called {}", bones[at].name);
        warnings.push(Warning::new(NAME_MISSING, message));
    }
    let names: Vec<&str> = bones.iter().map(|bone| bone.name.as_str()).collect();
    let renamed = renamed(&names);
    if let Some((at, new)) = renamed.first() {
        let more = if renamed.len() > 1 {
            format!(" (the first of {})", renamed.len())
        } else {
            String::new()
        };
        let message =
            format!("two joints are called {}; this one is called {new}{more}", names[*at]);
        warnings.push(Warning::new(NAME_TWICE, message));
    }
    for (at, name) in renamed {
        bones[at].name = name;
    }
}

/// Marks the bones of the tree to read.
fn tree(
    bones: &[Bone],
    root: Option<&str>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<bool>, Error> {
    let mut trees: Vec<usize> = Vec::with_capacity(bones.len());
    for (at, bone) in bones.iter().enumerate() {
        trees.push(bone.parent.map_or(at, |parent| trees[parent]));
    }
    let roots = bones.iter().filter(|bone| bone.parent.is_none());
    let names: Vec<&str> = roots.map(|bone| bone.name.as_str()).collect();
    let listed = names.iter().take(8).copied().collect::<Vec<_>>().join(", ");
    let Some(root) = root else {
        if names.len() > 1 {
            let count = names.len();
            let message =
                format!("the file has {count} trees, all of them used; --root takes one: {listed}");
            warnings.push(Warning::new(ROOTS, message));
        }
        return Ok(vec![true; bones.len()]);
    };
    let asked = bones.iter().position(|bone| bone.parent.is_none() && bone.name == root);
    let asked = asked.ok_or_else(|| no_tree(root, &listed))?;
    Ok(trees.iter().map(|tree| *tree == asked).collect())
}

/// Removes the other bones, and renumbers the parents of the kept ones.
fn select(bones: Vec<Bone>, kept: &[bool]) -> Vec<Bone> {
    let mut places = Vec::with_capacity(bones.len());
    let mut selected = Vec::new();
    for (bone, kept) in bones.into_iter().zip(kept) {
        places.push(selected.len());
        if *kept {
            let parent = bone.parent.map(|parent| places[parent]);
            selected.push(Bone { parent, ..bone });
        }
    }
    selected
}
