//! Reads PMD, the older model format: fields of fixed width, names in CP932.

use encoding_rs::SHIFT_JIS;

use super::bytes::Bytes;
use super::{Ik, MmdModel, RawBone, Tail, built};
use genga::error::Error;

const NAME: usize = 20;
const COMMENT: usize = 256;
const VERTEX: usize = 38;
const CORNER: usize = 2;
const MATERIAL: usize = 70;
const BONE: usize = 39;
const IK: usize = 11;

/// Bone index that means no bone.
const NONE: u16 = u16::MAX;

/// Reads a model, from behind its signature.
pub(super) fn read(bytes: &mut Bytes<'_>) -> Result<MmdModel, Error> {
    bytes.single("version")?;
    let name = text(bytes, "name")?;
    bytes.skip(1, COMMENT, "comment")?;
    for (size, what) in [(VERTEX, "vertices"), (CORNER, "faces"), (MATERIAL, "materials")] {
        let count = bytes.count(size, what)?;
        bytes.skip(count, size, what)?;
    }
    let bones = few(bytes, BONE, "bones")?;
    let bones = (0..bones).map(|_| bone(bytes)).collect::<Result<Vec<_>, _>>()?;
    let chains = few(bytes, IK, "IK")?;
    let chains = (0..chains).map(|_| ik(bytes, bones.len()));
    let ik = chains.collect::<Result<Vec<_>, _>>()?;
    built(name, bones, ik.into_iter().flatten().collect())
}

fn few(bytes: &mut Bytes<'_>, least: usize, what: &str) -> Result<usize, Error> {
    let at = bytes.at();
    let count = bytes.word(what)?;
    bytes.bounded(count.into(), least, at, what)
}

fn text(bytes: &mut Bytes<'_>, what: &str) -> Result<String, Error> {
    let field = bytes.take(NAME, what)?;
    let name = field.split(|byte| *byte == 0).next().unwrap_or_default();
    Ok(SHIFT_JIS.decode_without_bom_handling(name).0.into_owned())
}

fn bone(bytes: &mut Bytes<'_>) -> Result<RawBone, Error> {
    let name = text(bytes, "bones")?;
    let parent_at = bytes.at();
    let parent = bytes.word("bones")?;
    let tail = bytes.word("bones")?;
    // Skips the bone's kind and the IK to which it belongs.
    bytes.skip(1, 1 + 2, "bones")?;
    let place = bytes.place("bones")?;
    let [parent, tail] = [parent, tail].map(|bone| (bone != NONE).then_some(bone.into()));
    Ok(RawBone { name, parent, parent_at, place, tail: Tail::Bone(tail) })
}

fn ik(bytes: &mut Bytes<'_>, bones: usize) -> Result<Option<Ik>, Error> {
    let bone = usize::from(bytes.word("IK")?);
    bytes.skip(1, 2, "IK")?;
    let count = bytes.byte("IK")?;
    // Skips the number of iterations and the largest angle per iteration.
    bytes.skip(1, 2 + 4, "IK")?;
    let links = (0..count).map(|_| bytes.word("IK").map(usize::from));
    let links: Vec<usize> = links.collect::<Result<_, _>>()?;
    Ok(super::ik(bone, links, bones))
}
