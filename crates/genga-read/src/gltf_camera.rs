//! Reads a camera of a glTF file (.glb or .gltf): its position and view direction.

mod carried;
#[cfg(test)]
mod tests;

use glam::DVec3;

use super::gltf::Document;
use carried::Cameras;
use genga::error::Error;
use genga::maths;
use genga::motion::seen::looks;
use genga::motion::{Axis, Clip, Eye, Stature};

/// How many times farther a camera without perspective is placed, so that no visible perspective remains.
const FAR: f64 = 1000.0;

/// Decimal digits kept after the leading digit of the distance, so that a position stays readable.
const DIGITS: i32 = 6;

/// A camera (カメラ) of a glTF file at its node's rest, in metres and +Y up.
///
/// The field of view is ignored, because a longer lens enlarges all movement equally.
#[derive(Debug, Clone, PartialEq)]
pub struct GltfCamera {
    /// The name of its node, or its own; `of node` and the node's index if neither has one.
    pub name: String,
    /// Position of the camera.
    pub at: DVec3,
    /// View direction, of length 1.
    pub towards: DVec3,
    /// Whether it is orthographic.
    pub is_orthographic: bool,
    /// Whether an animation of the file moves the camera or one of its ancestors.
    pub is_animated: bool,
}

impl GltfCamera {
    /// Reads the camera with that name, or the first one; nodes keep the order of the file.
    ///
    /// # Errors
    /// [`Error::Camera`] if the bytes are no glTF 2.0 or have no such camera; the error then lists the
    /// names that exist.
    pub fn read(bytes: &[u8], name: Option<&str>) -> Result<Self, Error> {
        let (document, _) = Document::read(bytes).map_err(of_camera)?;
        let stand = Cameras::new(&document).map_err(of_camera)?;
        let cameras = stand.all();
        let is_asked = |names: &[&str]| name.is_none_or(|name| names.contains(&name));
        let Some(found) = cameras.iter().find(|camera| is_asked(&camera.names)) else {
            let names: Vec<String> = cameras.iter().map(|camera| camera.name()).collect();
            return Err(none_of(name, &names));
        };
        let place = stand.place(found.node);
        let towards = place.transform_vector3(DVec3::NEG_Z).normalize_or_zero();
        if !place.translation.is_finite() || towards == DVec3::ZERO {
            let message =
                format!("camera {} stands nowhere: its node is scaled away", found.name());
            return Err(Error::Camera { message });
        }
        Ok(Self {
            name: found.name(),
            at: place.translation,
            towards,
            is_orthographic: found.is_orthographic,
            is_animated: stand.is_animated(found.node),
        })
    }

    /// Converts the camera to the unit and axes of a clip, by inverting what `genga` does when it writes a
    /// GLB of the clip: the unit is scaled to human size, and up is as the body stands. The target is the
    /// point of the view axis nearest to the middle of the body over the whole clip. An orthographic camera
    /// is placed a thousand times as far away.
    ///
    /// # Errors
    /// [`Error::Camera`] if the body is behind the camera.
    pub fn eye(&self, clip: &Clip) -> Result<Eye, Error> {
        let stature = Stature::new(clip);
        let own = |way: DVec3| match stature.up {
            Axis::Z => DVec3::new(way.x, -way.z, way.y),
            Axis::X | Axis::Y => way,
        };
        let (at, towards) = (own(self.at) / stature.metres, own(self.towards));
        let distance = (middle(clip) - at).dot(towards);
        if distance <= 0.0 || !distance.is_finite() {
            let message = format!(
                "camera {} looks away from the body; is it of this clip? It stands at {}, in the clip's unit",
                self.name,
                rounded(at, at.length()),
            );
            return Err(Error::Camera { message });
        }
        let target = at + distance * towards;
        let back = if self.is_orthographic { FAR * distance } else { distance };
        let [at, target] = [target - back * towards, target].map(|place| rounded(place, distance));
        Ok(Eye { at, target })
    }
}

/// Converts an error of the file to one of its camera.
fn of_camera(error: Error) -> Error {
    Error::Camera { message: error.to_string() }
}

/// The mean position of all joints over the whole clip.
fn middle(clip: &Clip) -> DVec3 {
    let poses = looks(clip);
    let joints = poses.iter().map(Vec::len).sum::<usize>().max(1);
    poses.iter().flatten().sum::<DVec3>() / joints as f64
}

/// Rounds a position to the digits that matter at a distance.
fn rounded(place: DVec3, distance: f64) -> DVec3 {
    let order = maths::log10(distance.max(f64::MIN_POSITIVE)).floor() as i32;
    let steps = 10f64.powi((DIGITS - order).clamp(-300, 300));
    // Adding zero turns −0 into 0.
    (place * steps).round() / steps + DVec3::ZERO
}

fn none_of(name: Option<&str>, names: &[String]) -> Error {
    let there_are = match names {
        [] => "it has no camera that stands in its scene; export one with it".to_owned(),
        names => {
            let name = name.unwrap_or_default();
            format!("there is no camera {name}; there is {}", names.join(", "))
        }
    };
    Error::Camera { message: there_are }
}
