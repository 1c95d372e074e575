//! MikuMikuDance (MMD): motions (.vmd), and the models (.pmd, .pmx) that say where their bones are.
//!
//! A motion has keys of bones by name and no skeleton. Where no model is given it is laid on a figure of usual
//! proportions. Between keys it is evaluated as MMD does, frame by frame at 30 a second; legs that are keyed by their
//! IK are brought to their feet.

mod curve;
mod figure;
mod legs;
pub(crate) mod model;
mod played;
mod record;
mod rig;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::reading::{Found, Given, Options, Read};
use crate::error::{Error, Place, Warning};
use crate::time::FrameRate;
pub use model::MmdModel;
#[cfg(test)]
pub(crate) use model::tests as model_tests;
use record::Motion;
use rig::Rig;

/// Frames a second of every VMD.
const RATE: f64 = 30.0;

/// Centimetres of a unit of MMD, by custom.
const CENTIMETRES: f64 = 8.0;

/// Bones that the skeleton does not have; their keys are left out.
pub(crate) const BONES: &str = "W_VMD_BONES";

/// How a motion begins.
const SIGNATURE: &[u8] = b"Vocaloid Motion Data";

/// Names at the most in a sentence.
const MOST: usize = 12;

/// Whether a file begins as a motion of MMD.
pub(crate) fn is_motion(head: &[u8]) -> bool {
    head.starts_with(SIGNATURE)
}

/// Reads a motion, on the bones of the model that [`Options::skeleton`] names.
///
/// # Errors
/// [`Error::Motion`] with the byte, where it is no motion, ends early or has no bones; [`Error::Model`] where the model is
/// none.
pub(super) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    let motion = Motion::read(given.bytes)?;
    let model = options.skeleton.as_deref().map(|path| opened(path, options)).transpose()?;
    let rig = Rig::of(&motion, model.as_ref());
    let rate = FrameRate::new(RATE)?;
    let clip = played::clip(&motion, &rig, rate, options.stream.bytes)?;
    let mut found = vec![
        Found::new("format", format!("VMD for {}", motion.model)),
        Found::new("unit", "centimetres, 8 to a unit of MMD"),
        Found::new("up", "Y, left-handed axes turned to right-handed ones"),
        Found::new("rate", "30 frames a second, in-betweens by the file's own curves"),
        Found::new("skeleton", skeleton(model.as_ref())),
        Found::new("legs", rig.legs_in_words()),
    ];
    found.extend(
        motion.left_out.iter().map(|what| Found::new("without", format!("without {what}"))),
    );
    Ok(Read { clip, warnings: strangers(&rig), written_frame_time: None, found, takes: Vec::new() })
}

/// The frames on which a bone of the body has a key, each once and in order: what an animator set.
///
/// # Errors
/// Those of reading a VMD.
pub(crate) fn key_frames(bytes: &[u8]) -> Result<Vec<u32>, Error> {
    let motion = Motion::read(bytes)?;
    let of_body = motion.bones.iter().filter(|(name, _)| figure::is_of_body(name));
    let mut frames: Vec<u32> =
        of_body.flat_map(|(_, keys)| keys.iter().map(|key| key.frame)).collect();
    frames.sort_unstable();
    frames.dedup();
    Ok(frames)
}

fn opened(path: &Path, options: &Options) -> Result<MmdModel, Error> {
    let failed = |source| Error::Io { path: path.to_owned(), source };
    let file = std::fs::File::open(path).map_err(failed)?;
    MmdModel::read(&options.stream.read(file).map_err(failed)?)
}

fn skeleton(model: Option<&MmdModel>) -> String {
    match model {
        Some(model) => format!("on the bones of the model {}", model.name),
        None => {
            "on a figure of usual proportions (--skeleton MODEL.pmx for the model's own)".into()
        }
    }
}

/// Which keyed bones are not there.
fn strangers(rig: &Rig) -> Vec<Warning> {
    let names = &rig.strangers;
    let more = if names.len() > MOST { ", …" } else { "" };
    let shown = names[..names.len().min(MOST)].join(", ");
    let message = format!(
        "{} keyed bones are none that the skeleton has, and are left out: {shown}{more}",
        names.len()
    );
    (!names.is_empty()).then(|| Warning::new(BONES, message)).into_iter().collect()
}

fn damaged(byte: usize, message: impl Into<String>) -> Error {
    Error::Motion { place: Place::Byte(byte as u64), message: message.into() }
}
