//! Reads an MMD model (モデル), as far as a motion needs it: its bones, their rest positions, and its IK.

mod bytes;
mod pmd;
mod pmx;
#[cfg(test)]
pub(crate) mod tests;

use glam::DVec3;

use super::usual_skeleton::{self, RestBone};
use bytes::{Bytes, damaged};
use genga::error::Error;

/// An MMD model read from a PMD or a PMX 2.0 or 2.1 file; writing a VMD for its body needs it too.
#[derive(Debug, Clone, PartialEq)]
pub struct MmdModel {
    /// Name of the model (モデル名).
    pub name: String,
    pub(super) bones: Vec<ModelBone>,
    ik: Vec<Ik>,
}

/// A bone of a model.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ModelBone {
    pub(super) name: String,
    pub(super) parent: Option<usize>,
    /// Number of its ancestors.
    pub(super) depth: usize,
    /// Its start at rest, in MMD units; +X is left, +Y up, +Z in front, as in BVH.
    pub(super) place: DVec3,
    /// The vector from its start to its end (接続先), if the model defines it.
    pub(super) tip: Option<DVec3>,
}

/// An IK bone and the bones that it turns.
#[derive(Debug, Clone, PartialEq)]
struct Ik {
    bone: usize,
    links: Vec<usize>,
}

impl MmdModel {
    /// Reads a model file.
    ///
    /// # Errors
    /// [`Error::Motion`] with the byte, from 0, if the file is no model, ends early, or contradicts itself:
    /// a bone whose parent is missing, or that is its own ancestor.
    pub fn read(bytes: &[u8]) -> Result<Self, Error> {
        match bytes {
            [b'P', b'M', b'X', b' ', ..] => pmx::read(&mut Bytes::after(4, bytes)),
            [b'P', b'm', b'd', ..] => pmd::read(&mut Bytes::after(3, bytes)),
            _ => Err(damaged(0, "this is no model of MMD: no PMD and no PMX")),
        }
    }

    /// Returns a nameless figure of usual proportions, with the standard bones and the IK of the legs. Its legs are 9.7
    /// units long.
    pub fn usual() -> Self {
        let mut bones: Vec<ModelBone> = Vec::new();
        for RestBone { name, parent, place, tip } in usual_skeleton::bones() {
            let depth = parent.map_or(0, |parent| bones[parent].depth + 1);
            bones.push(ModelBone { name, parent, depth, place, tip });
        }
        let find = |name: String| bones.iter().position(|bone| bone.name == name);
        let ik = |side: &str, ik: &str, links: &[&str]| {
            let links = links.iter().filter_map(|link| find(format!("{side}{link}")));
            Some(Ik { bone: find(format!("{side}{ik}"))?, links: links.collect() })
        };
        let legs = ["左", "右"].into_iter().flat_map(|side| {
            [ik(side, "足ＩＫ", &["ひざ", "足"]), ik(side, "つま先ＩＫ", &["足首"])]
        });
        let ik = legs.flatten().collect();
        Self { name: String::new(), bones, ik }
    }

    /// The names of the bones, in the order of the file.
    pub fn bones(&self) -> impl Iterator<Item = &str> {
        self.bones.iter().map(|bone| &bone.name[..])
    }

    /// Finds the index of a bone by name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.bones.iter().position(|bone| bone.name == name)
    }

    /// Number of ancestors of a bone.
    pub fn depth(&self, bone: usize) -> usize {
        self.bones[bone].depth
    }

    /// The names of the ancestors of a bone, the nearest first.
    pub fn above(&self, bone: usize) -> impl Iterator<Item = &str> {
        let parent = |bone: &usize| self.bones[*bone].parent;
        std::iter::successors(parent(&bone), parent).map(|bone| &self.bones[bone].name[..])
    }

    /// The start of a bone at rest, in MMD units; +X is left, +Y up, +Z in front.
    pub fn place(&self, name: &str) -> Option<DVec3> {
        self.find(name).map(|bone| self.bones[bone].place)
    }

    /// The vector from the start of one bone to the start of another.
    pub fn way(&self, from: &str, to: &str) -> Option<DVec3> {
        Some(self.place(to)? - self.place(from)?)
    }

    /// The length of a leg from 足 to 足首, averaged over both sides.
    pub fn leg(&self) -> Option<f64> {
        let leg = |side: &str| {
            let [top, knee, ankle] = ["足", "ひざ", "足首"].map(|name| format!("{side}{name}"));
            Some(self.way(&top, &knee)?.length() + self.way(&knee, &ankle)?.length())
        };
        let legs: Vec<f64> = ["左", "右"].into_iter().filter_map(leg).collect();
        let mean = legs.iter().sum::<f64>() / legs.len().max(1) as f64;
        (mean > 0.0).then_some(mean)
    }

    /// The names of the IK bones that turn any bone accepted by `is_one`.
    pub fn ik_of(&self, is_one: impl Fn(&str) -> bool) -> Vec<String> {
        let turns = |ik: &&Ik| ik.links.iter().any(|link| is_one(&self.bones[*link].name));
        self.ik.iter().filter(turns).map(|ik| self.bones[ik.bone].name.clone()).collect()
    }
}

/// Builds an IK; `None` if its bone or all of its links do not exist, as in files of some programs.
fn ik(bone: usize, mut links: Vec<usize>, bones: usize) -> Option<Ik> {
    links.retain(|link| *link < bones);
    (bone < bones && !links.is_empty()).then_some(Ik { bone, links })
}

/// A bone as stored in the file, with the byte offset of its parent index.
struct RawBone {
    name: String,
    parent: Option<usize>,
    parent_at: usize,
    place: DVec3,
    tail: Tail,
}

/// The end of a bone (接続先).
enum Tail {
    /// The start of another bone.
    Bone(Option<usize>),
    /// A vector from the start of the bone.
    Way(DVec3),
}

/// Validates the bones and builds the model.
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

/// The vector to the end of a bone; `None` if its length is zero, or if it ends at bone 0, which means no
/// bone in a PMD.
fn tip(bone: &RawBone, all: &[RawBone]) -> Option<DVec3> {
    let way = match bone.tail {
        Tail::Way(way) => way,
        Tail::Bone(end) => all.get(end.filter(|end| *end > 0)?)?.place - bone.place,
    };
    (way.is_finite() && way != DVec3::ZERO).then_some(way)
}

/// Number of ancestors of each bone; the error is a bone on a cycle.
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
