//! A camera of a glTF file (.glb or .gltf): where it stands and which way it looks.

mod carried;
#[cfg(test)]
mod tests;

use glam::DVec3;

use super::gltf::Document;
use crate::error::Error;
use crate::maths;
use crate::motion::seen::looks;
use crate::motion::{Axis, Clip, Eye, Stature};
use carried::Cameras;

/// How much further off than it is a camera without perspective is put, where none is left to be seen.
const FAR: f64 = 1000.0;

/// Digits that a place keeps behind the first of its distance: a camera's place is read by a person too.
const DIGITS: i32 = 6;

/// A camera (カメラ) as a glTF file has it, in metres and +Y up, where its node rests.
///
/// How wide it sees is not asked: a longer lens makes all movement larger alike.
#[derive(Debug, Clone, PartialEq)]
pub struct GltfCamera {
    /// The name of its node, or its own; `of node` and its number where neither has one.
    pub name: String,
    /// Where it stands.
    pub at: DVec3,
    /// Which way it looks; of length 1.
    pub towards: DVec3,
    /// Whether it has no perspective.
    pub is_orthographic: bool,
    /// Whether an animation of the file moves it, or what carries it.
    pub is_animated: bool,
}

impl GltfCamera {
    /// The camera of that name, or the first: nodes have the order of the file.
    ///
    /// # Errors
    /// [`Error::Camera`] when the bytes are no glTF 2.0, or have no such camera; then with the names of those
    /// there are.
    pub fn read(bytes: &[u8], name: Option<&str>) -> Result<Self, Error> {
        let (document, _) = Document::read(bytes).map_err(of_camera)?;
        let stand = Cameras::of(&document).map_err(of_camera)?;
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

    /// The same in a clip's own unit and axes, by which `genga` writes a GLB of it: the unit that makes a person
    /// of the body, and up as the body stands. It looks at where its axis comes nearest to the middle of the
    /// body over the whole clip; without perspective from a thousand times as far.
    ///
    /// # Errors
    /// [`Error::Camera`] when the body is behind it.
    pub fn eye(&self, clip: &Clip) -> Result<Eye, Error> {
        let stature = Stature::of(clip);
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

/// What is wrong with the file, as an error of its camera.
fn of_camera(error: Error) -> Error {
    Error::Camera { message: error.to_string() }
}

/// Where a body is in the mean over its joints and a clip.
fn middle(clip: &Clip) -> DVec3 {
    let poses = looks(clip);
    let joints = poses.iter().map(Vec::len).sum::<usize>().max(1);
    poses.iter().flatten().sum::<DVec3>() / joints as f64
}

/// A place without the digits that do not matter at a distance.
fn rounded(place: DVec3, distance: f64) -> DVec3 {
    let order = maths::log10(distance.max(f64::MIN_POSITIVE)).floor() as i32;
    let steps = 10f64.powi((DIGITS - order).clamp(-300, 300));
    // Without −0.
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
