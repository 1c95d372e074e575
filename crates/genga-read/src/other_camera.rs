//! Puts the camera of another file beside the body of a clip.

use std::fs::File;
use std::path::Path;

use glam::{DQuat, DVec3};

use super::reading::{Given, Options, Read};
use super::{gltf, mmd};
use genga::error::{Error, Place};
use genga::motion::{Axis, CameraPath, CameraPose, Clip, Lens, Stature};

impl Options {
    /// Puts the camera of the file that [`Options::camera`] names beside the body.
    pub(super) fn with_camera(&self, mut read: Read) -> Result<Read, Error> {
        if let Some(path) = &self.camera {
            let failed = |source| Error::Io { path: path.clone(), source };
            let file = File::open(path).map_err(failed)?;
            let bytes = self.stream.read(file).map_err(failed)?;
            let given = Given { bytes: &bytes, path: Some(path) };
            read.clip = self.beside(read.clip, &given).map_err(|error| in_file(error, path))?;
        }
        Ok(read)
    }

    fn beside(&self, clip: Clip, given: &Given<'_>) -> Result<Clip, Error> {
        if mmd::is_motion(given.bytes) {
            return mmd::with_camera(clip, given.bytes);
        }
        let camera = gltf::camera_path(given, self, (clip.len(), clip.rate()))?;
        let mut beside = clip.beside().cloned().unwrap_or_default();
        beside.camera = Some(fitted(camera, &clip, 1.0));
        Ok(clip.with_beside(beside))
    }
}

/// Converts a camera's way in units of some metres, with Y up, to the unit and axes of a clip.
pub(super) fn fitted(path: CameraPath, clip: &Clip, metres: f64) -> CameraPath {
    let stature = Stature::new(clip);
    let scale = metres / stature.metres;
    let (half, is_z_up) = (0.5_f64.sqrt(), stature.up == Axis::Z);
    let upright = if is_z_up { DQuat::from_xyzw(half, 0.0, 0.0, half) } else { DQuat::IDENTITY };
    let place = |at: DVec3| scale * if is_z_up { DVec3::new(at.x, -at.z, at.y) } else { at };
    let pose = |pose: &CameraPose| CameraPose {
        place: place(pose.place),
        turn: upright * pose.turn,
        lens: match pose.lens {
            Lens::Orthographic(height) => Lens::Orthographic(scale * height),
            lens => lens,
        },
    };
    CameraPath { poses: path.poses.iter().map(pose).collect(), ..path }
}

/// Adds the name of a file to an error.
fn in_file(error: Error, path: &Path) -> Error {
    let Error::Motion { place, message } = error else { return error };
    let place = match place.to_string().trim_end_matches(": ") {
        "" => path.display().to_string(),
        place => format!("{}:{place}", path.display()),
    };
    Error::Motion { place: Place::Part(place), message }
}
