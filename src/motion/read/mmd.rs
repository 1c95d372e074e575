//! MikuMikuDance (MMD): motions (.vmd), and the models (.pmd, .pmx) that say where their bones are.
//!
//! A motion has keys of bones by name and no skeleton. Where no model is given it is laid on a figure of usual
//! proportions. Between keys it is evaluated as MMD does, frame by frame at 30 a second; legs that are keyed by their
//! IK are brought to their feet.

mod curve;
mod figure;
mod legs;
pub(crate) mod model;
mod names;
mod played;
mod record;
mod rig;
#[cfg(test)]
mod tests;

use std::path::Path;

use super::reading::{Found, Given, Options, Read, join_names};
use crate::error::{Error, Place, Warning};
use crate::motion::Declared;
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

/// Whether a file begins as a motion of MMD.
pub(crate) fn is_motion(head: &[u8]) -> bool {
    head.starts_with(SIGNATURE)
}

/// Reads a motion, on the bones of the model that [`Options::skeleton`] names.
///
/// # Errors
/// [`Error::Motion`] with the byte, where it is no motion, ends early or has no bones, and where the skeleton has none of
/// those it has; with the model's path and the byte, where the model is none.
pub(super) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    let motion = Motion::read(given.bytes)?;
    let model = options.skeleton.as_deref().map(|path| opened(path, options)).transpose()?;
    let rig = Rig::of(&motion, model.as_ref());
    check(&motion, &rig, model.as_ref())?;
    let rate = FrameRate::new(RATE)?;
    let clip = played::clip(&motion, &rig, rate, options.stream.bytes)?;
    let clip = clip.with_declared(Declared::y_up(0.01));
    let mut found = vec![
        Found::new("format", format!("VMD for {}", motion.model)),
        Found::new("unit", "centimetres, 8 to a unit of MMD"),
        Found::new("up", "Y, left-handed axes turned to right-handed ones"),
        Found::new("rate", "30 frames a second, in-betweens by the file's own curves"),
        Found::new("skeleton", skeleton(model.as_ref())),
        Found::new("legs", rig.legs_in_words()),
    ];
    let foreign = motion.names.foreign().map(|encoding| format!("names in {encoding}"));
    found.extend(foreign.map(|names| Found::new("names", names)));
    let left_out = motion.left_out.iter().map(|(count, what)| (*count, *what));
    found.extend(Found::left_out(&left_out.collect::<Vec<_>>()));
    let warnings = motion.far.into_iter().chain(strangers(&rig)).collect();
    Ok(Read { clip, warnings, written_frame_time: None, found, takes: Vec::new() })
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
    let read = MmdModel::read(&options.stream.read(file).map_err(failed)?);
    read.map_err(|error| match error {
        Error::Model { byte, message } => {
            let place = Place::Part(format!("{}:byte {byte}", path.display()));
            Error::Motion { place, message }
        }
        other => other,
    })
}

fn skeleton(model: Option<&MmdModel>) -> String {
    match model {
        Some(model) => format!("on the bones of the model {}", model.name),
        None => {
            "on a figure of usual proportions (--skeleton MODEL.pmx for the model's own)".into()
        }
    }
}

/// Refuses a motion of which the skeleton has no bone: it would be a figure that stands still.
fn check(motion: &Motion, rig: &Rig, model: Option<&MmdModel>) -> Result<(), Error> {
    if rig.bones.iter().any(|bone| !bone.keys.is_empty()) {
        return Ok(());
    }
    let names = join_names(&rig.strangers);
    let message = match model {
        Some(model) => format!(
            "the model {} has none of the bones that are keyed ({names}): is it another model's motion, for {}?",
            model.name, motion.model
        ),
        None => format!(
            "none of the keyed bones is one of MMD's standard ones ({names}): give the model that the motion is for, \
             with --skeleton MODEL.pmx"
        ),
    };
    Err(Error::Motion { place: Place::Whole, message })
}

/// Which keyed bones are not there.
fn strangers(rig: &Rig) -> Option<Warning> {
    let names = &rig.strangers;
    let message = format!(
        "{} keyed bones are none that the skeleton has, and are left out: {}",
        names.len(),
        join_names(names)
    );
    (!names.is_empty()).then(|| Warning::new(BONES, message))
}

fn damaged(byte: usize, message: impl Into<String>) -> Error {
    Error::Motion { place: Place::Byte(byte as u64), message: message.into() }
}
