//! Reads files of MikuMikuDance (MMD): motions (.vmd), and the models (.pmd, .pmx) that define the bones.
//!
//! A motion has keys for bones by name but no skeleton. Without a model it is applied to a figure of usual
//! proportions. It is evaluated like MMD, frame by frame at 30 a second. Legs whose IK bones have keys are
//! solved to reach their feet.

mod beside;
mod camera;
mod curve;
mod legs;
pub(crate) mod model;
mod names;
mod record;
mod rig;
mod sample_motion;
#[cfg(test)]
mod tests;
mod usual_skeleton;

use std::path::Path;

use super::other_camera::fitted;
use super::reading::{Found, Given, Options, Read, join_names};
pub use beside::{MORPH_NAME, VmdBeside};
pub use camera::{VmdCamera, VmdCameraKey};
use genga::error::{Error, Place, Warning};
use genga::motion::{Beside, Clip, Declared};
use genga::time::FrameRate;
pub use legs::MmdLeg;
pub use model::MmdModel;
#[cfg(test)]
mod test_models;
use record::Motion;
use rig::Rig;

/// Frames per second of every VMD.
const RATE: f64 = 30.0;

/// Centimetres in an MMD unit, by convention.
const CENTIMETRES: f64 = 8.0;

/// Warning about keyed bones that the skeleton lacks; their keys are left out.
pub(crate) const BONES: &str = "W_VMD_BONES";

/// First bytes of a motion.
const SIGNATURE: &[u8] = b"Vocaloid Motion Data";

/// Whether a file begins like an MMD motion.
pub fn is_motion(head: &[u8]) -> bool {
    head.starts_with(SIGNATURE)
}

/// Reads a motion onto the bones of the model that [`Options::skeleton`] names.
///
/// # Errors
/// [`Error::Motion`] with the byte if the file is no motion, ends early or has no bones, and if the
/// skeleton has none of its bones; with the model's path and the byte if the model is invalid.
pub(super) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    let motion = Motion::read(given.bytes)?;
    let model = options.skeleton.as_deref().map(|path| opened(path, options)).transpose()?;
    let rig = Rig::new(&motion, model.as_ref());
    check(&motion, &rig, model.as_ref())?;
    let rate = FrameRate::new(RATE)?;
    let clip = sample_motion::clip(&motion, &rig, rate, options.stream.bytes)?;
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
    found.extend(motion.beside.found());
    let clip = match motion.beside.is_empty() {
        true => clip,
        false => {
            let camera = motion.beside.camera_path(clip.len());
            clip.with_beside(Beside::new(camera).keep(motion.beside))
        }
    };
    let warnings = motion.far.into_iter().chain(strangers(&rig)).collect();
    Ok(Read { clip, warnings, written_frame_time: None, found, takes: Vec::new() })
}

/// Puts the camera, the light and the shadow of a VMD beside a clip. The file begins with the clip.
///
/// # Errors
/// [`Error::Motion`] if the file is damaged or has no camera.
pub(super) fn with_camera(clip: Clip, bytes: &[u8]) -> Result<Clip, Error> {
    let VmdBeside { camera, light, shadow, .. } = Motion::read_any(bytes)?.beside;
    let old = clip.beside().cloned().unwrap_or_default();
    let frames = clip.rate().fps() / RATE;
    let own = old.kept::<VmdBeside>().cloned();
    let own = own.unwrap_or_else(|| VmdBeside { frames, ..VmdBeside::default() });
    let beside = VmdBeside { camera, light, shadow, ..own };
    let path = beside.camera_path(clip.len()).ok_or_else(|| {
        let message =
            "this VMD has no key of the camera; a camera's motion is a file of its own in MMD";
        Error::Motion { place: Place::Whole, message: message.into() }
    })?;
    let mut all = old.keep(beside);
    all.camera = Some(fitted(path, &clip, 0.01));
    Ok(clip.with_beside(all))
}

/// The frames on which a bone of the body has a key, sorted and unique: the key poses of the animator.
///
/// # Errors
/// Errors of reading a VMD.
pub fn key_frames(bytes: &[u8]) -> Result<Vec<u32>, Error> {
    let motion = Motion::read(bytes)?;
    let of_body = motion.bones.iter().filter(|(name, _)| usual_skeleton::is_of_body(name));
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
        Error::Motion { place: Place::Byte(byte), message } => {
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

/// Rejects a motion that shares no bone with the skeleton, since the figure would not move at all.
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

/// The warning about keyed bones that the skeleton lacks.
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
