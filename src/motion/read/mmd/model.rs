//! A model (モデル) of MMD, as far as a motion needs it: its bones, where they stand at rest, and its IK.

mod bytes;
mod pmd;
mod pmx;
#[cfg(test)]
pub(crate) mod tests;

use glam::DVec3;

use crate::error::Error;
use bytes::{Bytes, damaged};

/// A model of MMD as its file has it, PMD or PMX 2.0 and 2.1: what [`Vmd::body`](crate::deliver::Vmd::body) takes.
#[derive(Debug, Clone, PartialEq)]
pub struct MmdModel {
    /// Its name (モデル名).
    pub name: String,
    pub(super) bones: Vec<ModelBone>,
    ik: Vec<Ik>,
}

/// A bone of a model.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelBone {
    pub(super) name: String,
    pub(super) parent: Option<usize>,
    /// Bones above it.
    pub(super) depth: usize,
    /// Where it begins at rest, in MMD units; +X is left, +Y up, +Z in front, as in BVH.
    pub(super) place: DVec3,
    /// From there to where it ends (接続先), where the model says so.
    pub(super) tip: Option<DVec3>,
}

/// An IK, which turns the bones it links.
#[derive(Debug, Clone, PartialEq)]
struct Ik {
    bone: usize,
    links: Vec<usize>,
}

impl MmdModel {
    /// The model of a file.
    ///
    /// # Errors
    /// [`Error::Model`] with the byte, from 0, when the bytes are no such file, end early, or say what cannot be: a
    /// bone that hangs on none there is or on itself.
    pub fn read(bytes: &[u8]) -> Result<Self, Error> {
        match bytes {
            [b'P', b'M', b'X', b' ', ..] => pmx::read(&mut Bytes::after(4, bytes)),
            [b'P', b'm', b'd', ..] => pmd::read(&mut Bytes::after(3, bytes)),
            _ => Err(damaged(0, "this is no model of MMD: no PMD and no PMX")),
        }
    }

    /// The names of its bones, in the order of the file.
    pub fn bones(&self) -> impl Iterator<Item = &str> {
        self.bones.iter().map(|bone| &bone.name[..])
    }

    pub(crate) fn find(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.name == name)
    }

    /// How many bones are above a bone.
    pub(crate) fn depth(&self, bone: usize) -> usize {
        self.bones[bone].depth
    }

    /// The names of the bones above a bone, the nearest first.
    pub(crate) fn above(&self, bone: usize) -> impl Iterator<Item = &str> {
        let parent = |bone: &usize| self.bones[*bone].parent;
        std::iter::successors(parent(&bone), parent).map(|bone| &self.bones[bone].name[..])
    }

    /// The way from where one bone begins to where another does.
    pub(crate) fn way(&self, from: &str, to: &str) -> Option<DVec3> {
        let place = |name| self.find(name).map(|bone| self.bones[bone].place);
        Some(place(to)? - place(from)?)
    }

    /// The length of a leg from 足 to 足首, on average of both.
    pub(crate) fn leg(&self) -> Option<f64> {
        let leg = |side: &str| {
            let [top, knee, ankle] = ["足", "ひざ", "足首"].map(|name| format!("{side}{name}"));
            Some(self.way(&top, &knee)?.length() + self.way(&knee, &ankle)?.length())
        };
        let legs: Vec<f64> = ["左", "右"].into_iter().filter_map(leg).collect();
        let mean = legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        (mean > 0.0).then_some(mean)
    }

    /// The names of the IK that turn any of some bones.
    pub(crate) fn ik_of(&self, is_one: impl Fn(&str) -> bool) -> Vec<String> {
        let turns = |ik: &&Ik| ik.links.iter().any(|link| is_one(&self.bones[*link].name));
        self.ik.iter().filter(turns).map(|ik| self.bones[ik.bone].name.clone()).collect()
    }
}

/// An IK as it was read; none where it or all its links are no bones there are, as some programs leave them.
fn ik(bone: usize, mut links: Vec<usize>, bones: usize) -> Option<Ik> {
    links.retain(|link| *link < bones);
    (bone < bones && !links.is_empty()).then_some(Ik { bone, links })
}

/// A bone as it was read, and where in the file it says on which one it hangs.
struct RawBone {
    name: String,
    parent: Option<usize>,
    parent_at: usize,
    place: DVec3,
    tail: Tail,
}

/// Where a bone ends (接続先).
enum Tail {
    /// At another bone.
    Bone(Option<usize>),
    /// So far from where it begins.
    Way(DVec3),
}

/// The model of what was read.
fn built(name: String, raw: Vec<RawBone>, ik: Vec<Ik>) -> Result<MmdModel, Error> {
    for bone in &raw {
        if bone.parent.is_some_and(|parent| parent >= raw.len()) {
            let message = format!("bone {} hangs on one that is not there", bone.name);
            return Err(damaged(bone.parent_at, message));
        }
    }
    let parents: Vec<Option<usize>> = raw.iter().map(|bone| bone.parent).collect();
    let depths = depths(&parents).map_err(|ring| {
        damaged(raw[ring].parent_at, format!("bone {} hangs on itself", raw[ring].name))
    })?;
    let tips: Vec<Option<DVec3>> = raw.iter().map(|bone| tip(bone, &raw)).collect();
    let bones = raw.into_iter().zip(depths).zip(tips).map(|((bone, depth), tip)| {
        let RawBone { name, parent, place, .. } = bone;
        ModelBone { name, parent, depth, place, tip }
    });
    Ok(MmdModel { name, bones: bones.collect(), ik })
}

/// The way to the end of a bone; none where it ends at the first bone, which in a PMD stands for none, or where it begins.
fn tip(bone: &RawBone, all: &[RawBone]) -> Option<DVec3> {
    let way = match bone.tail {
        Tail::Way(way) => way,
        Tail::Bone(end) => all.get(end.filter(|end| *end > 0)?)?.place - bone.place,
    };
    (way.is_finite() && way != DVec3::ZERO).then_some(way)
}

/// How many bones are above each, or a bone of a ring.
fn depths(parents: &[Option<usize>]) -> Result<Vec<usize>, usize> {
    let mut depths: Vec<Option<usize>> = vec![None; parents.len()];
    let mut path = Vec::new();
    for bone in 0..parents.len() {
        let mut at = Some(bone);
        while let Some(open) = at.filter(|at| depths[*at].is_none()) {
            if path.len() == parents.len() {
                return Err(open);
            }
            path.push(open);
            at = parents[open];
        }
        let mut depth = at.and_then(|at| depths[at]).map_or(0, |above| above + 1);
        while let Some(open) = path.pop() {
            depths[open] = Some(depth);
            depth += 1;
        }
    }
    Ok(depths.into_iter().flatten().collect())
}
