//! Reads PMX 2.0 and 2.1, whose header sets the text encoding and the width of indices.

use glam::DVec3;

use super::bytes::{Bytes, damaged};
use super::{MmdModel, RawBone, Tail, built};
use genga::error::Error;

/// The settings in the header.
struct Header {
    is_utf8: bool,
    /// Number of additional vectors per vertex.
    extras: usize,
    /// Bytes of a vertex index, a texture index and a bone index.
    vertex: usize,
    texture: usize,
    bone: usize,
}

/// Reads a model, from behind its signature.
pub(super) fn read(bytes: &mut Bytes<'_>) -> Result<MmdModel, Error> {
    let header = header(bytes)?;
    let name = text(bytes, &header, "name")?;
    for what in ["name in English", "comment", "comment in English"] {
        text(bytes, &header, what)?;
    }
    for _ in 0..bytes.count(12 + 12 + 8 + 1 + header.bone + 4, "vertices")? {
        vertex(bytes, &header)?;
    }
    let corners = bytes.count(header.vertex, "faces")?;
    bytes.skip(corners, header.vertex, "faces")?;
    for _ in 0..bytes.count(4, "textures")? {
        text(bytes, &header, "textures")?;
    }
    for _ in 0..bytes.count(4, "materials")? {
        material(bytes, &header)?;
    }
    let count = bytes.count(4 + 4 + 12 + header.bone + 4 + 2, "bones")?;
    let (mut bones, mut chains) = (Vec::with_capacity(count), Vec::new());
    for at in 0..count {
        let (bone, links) = bone(bytes, &header)?;
        bones.push(bone);
        chains.extend(links.map(|links| (at, links)));
    }
    let ik = chains.into_iter().filter_map(|(bone, links)| super::ik(bone, links, count));
    built(name, bones, ik.collect())
}

fn header(bytes: &mut Bytes<'_>) -> Result<Header, Error> {
    let at = bytes.at();
    let version = bytes.single("header")?;
    if !(2.0..2.2).contains(&version) {
        return Err(damaged(at, format!("PMX {version} is not read; 2.0 and 2.1 are")));
    }
    let (at, count) = (bytes.at(), usize::from(bytes.byte("header")?));
    let globals = bytes.take(count, "header")?;
    let [text, extras, vertex, texture, _, bone, ..] = globals else {
        return Err(damaged(at, format!("the header has {count} entries, where 8 belong")));
    };
    if let Some(wrong) = [vertex, texture, bone].iter().find(|width| !matches!(**width, 1 | 2 | 4))
    {
        return Err(damaged(
            at,
            format!("the header has numbers of {wrong} bytes; 1, 2 and 4 are known"),
        ));
    }
    let [vertex, texture, bone] = [vertex, texture, bone].map(|width| usize::from(*width));
    Ok(Header { is_utf8: *text != 0, extras: usize::from(*extras), vertex, texture, bone })
}

fn text(bytes: &mut Bytes<'_>, header: &Header, what: &str) -> Result<String, Error> {
    let count = bytes.count(1, &format!("bytes of its {what}"))?;
    let text = bytes.take(count, what)?;
    if header.is_utf8 {
        return Ok(String::from_utf8_lossy(text).into_owned());
    }
    let units = text.chunks_exact(2).map(|pair| u16::from_le_bytes([pair[0], pair[1]]));
    Ok(char::decode_utf16(units).map(|letter| letter.unwrap_or('\u{fffd}')).collect())
}

fn vertex(bytes: &mut Bytes<'_>, header: &Header) -> Result<(), Error> {
    const WHAT: &str = "vertices";
    bytes.skip(1, 12 + 12 + 8 + 16 * header.extras, WHAT)?;
    let at = bytes.at();
    // The skinning of the vertex: its number of bones and of floats.
    let (bones, floats) = match bytes.byte(WHAT)? {
        0 => (1, 0),
        1 => (2, 1),
        2 | 4 => (4, 4),
        3 => (2, 1 + 9),
        other => {
            return Err(damaged(
                at,
                format!("a vertex hangs on bones in way {other}; 0 to 4 are known"),
            ));
        }
    };
    bytes.skip(1, bones * header.bone + 4 * floats + 4, WHAT)
}

fn material(bytes: &mut Bytes<'_>, header: &Header) -> Result<(), Error> {
    const WHAT: &str = "materials";
    text(bytes, header, WHAT)?;
    text(bytes, header, WHAT)?;
    // Skips colours, flags, edge, texture, sphere map and its blend mode.
    bytes.skip(1, 16 + 12 + 4 + 12 + 1 + 16 + 4 + 2 * header.texture + 1, WHAT)?;
    let is_shared = bytes.byte(WHAT)? != 0;
    bytes.skip(1, if is_shared { 1 } else { header.texture }, WHAT)?;
    text(bytes, header, WHAT)?;
    bytes.skip(1, 4, WHAT)
}

/// Flag bits of a bone that announce optional fields.
mod has {
    pub(super) const TAIL_BONE: u16 = 0x0001;
    pub(super) const IK: u16 = 0x0020;
    pub(super) const GRANT: u16 = 0x0100 | 0x0200;
    pub(super) const FIXED_AXIS: u16 = 0x0400;
    pub(super) const OWN_AXES: u16 = 0x0800;
    pub(super) const OUTER_PARENT: u16 = 0x2000;
}

/// Reads a bone, and the bones that it turns if it is an IK bone.
fn bone(bytes: &mut Bytes<'_>, header: &Header) -> Result<(RawBone, Option<Vec<usize>>), Error> {
    const WHAT: &str = "bones";
    let name = text(bytes, header, WHAT)?;
    text(bytes, header, WHAT)?;
    let place = bytes.place(WHAT)?;
    let parent_at = bytes.at();
    let parent = number(bytes, header)?;
    bytes.skip(1, 4, WHAT)?;
    let flags = bytes.word(WHAT)?;
    let is = |bit: u16| flags & bit != 0;
    let tail = match is(has::TAIL_BONE) {
        true => Tail::Bone(number(bytes, header)?),
        false => Tail::Way(way(bytes, WHAT)?),
    };
    for (bit, size) in [
        (has::GRANT, header.bone + 4),
        (has::FIXED_AXIS, 12),
        (has::OWN_AXES, 24),
        (has::OUTER_PARENT, 4),
    ] {
        bytes.skip(usize::from(is(bit)), size, WHAT)?;
    }
    let links = if is(has::IK) { Some(ik(bytes, header)?) } else { None };
    Ok((RawBone { name, parent, parent_at, place, tail }, links))
}

/// Reads a vector and converts it to axes with +Z in front; it may be non-finite.
fn way(bytes: &mut Bytes<'_>, what: &str) -> Result<DVec3, Error> {
    let [x, y, z] = [bytes.single(what)?, bytes.single(what)?, bytes.single(what)?];
    Ok(DVec3::new(x.into(), y.into(), -f64::from(z)))
}

fn ik(bytes: &mut Bytes<'_>, header: &Header) -> Result<Vec<usize>, Error> {
    const WHAT: &str = "IK";
    // Skips the target, the number of iterations and the largest angle per iteration.
    bytes.skip(1, header.bone + 4 + 4, WHAT)?;
    let mut links = Vec::new();
    for _ in 0..bytes.count(header.bone + 1, "links of an IK")? {
        links.extend(number(bytes, header)?);
        let is_limited = bytes.byte(WHAT)? != 0;
        bytes.skip(usize::from(is_limited), 24, WHAT)?;
    }
    Ok(links)
}

/// Reads a bone index; `None` if it is negative.
fn number(bytes: &mut Bytes<'_>, header: &Header) -> Result<Option<usize>, Error> {
    let taken = bytes.take(header.bone, "bones")?;
    let is_negative = taken.last().is_some_and(|byte| *byte > 127);
    let number = taken.iter().rev().fold(0, |number, byte| number << 8 | usize::from(*byte));
    Ok((!is_negative).then_some(number))
}
