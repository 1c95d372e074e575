//! Layers that a person names, joint by joint or by pattern.

use serde::{Deserialize, Serialize};

use crate::error::{Error, did_you_mean};
use crate::keys::layers::LayerJoints;
use crate::keys::weights::fits;
use crate::motion::{JointId, Skeleton};

/// Characters with a special meaning where a correction names a layer, `--pin B/12:top@0.5,40`.
const SIGNS: [char; 4] = ['/', ':', '@', ','];

/// A layer as a person names it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NamedLayer {
    /// The column's name on the sheet.
    pub name: String,
    /// Names of joints, or patterns in which `*` stands for any letters and `?` for one.
    pub joints: Vec<String>,
}

pub(super) fn validate(layers: &[NamedLayer]) -> Result<(), Error> {
    if layers.is_empty() {
        let message = "the list has no layer; name one, or take body";
        return Err(Error::setting("layers", message));
    }
    for (at, layer) in layers.iter().enumerate() {
        let name = &layer.name;
        if name.trim().is_empty() || name.contains(SIGNS) {
            let message =
                format!("\"{name}\" is no name of a layer; take letters without / : @ and comma");
            return Err(Error::setting("layers", message));
        }
        if layers[..at].iter().any(|other| other.name == *name) {
            let message = format!("two layers are called {name}; each needs a name of its own");
            return Err(Error::setting("layers", message));
        }
        if layer.joints.is_empty() {
            let message = "has no joint; name some, or take the layer away";
            return Err(Error::setting(knob(name), message));
        }
    }
    Ok(())
}

/// Splits a body into named layers; joints in none of them belong to the first.
pub(super) fn split(layers: &[NamedLayer], skeleton: &Skeleton) -> Result<Vec<LayerJoints>, Error> {
    let mut layer_of = vec![None; skeleton.len()];
    for (at, layer) in layers.iter().enumerate() {
        for pattern in &layer.joints {
            for joint in fitting(pattern, layer, skeleton)? {
                match layer_of[joint].replace(at) {
                    Some(other) if other != at => {
                        let (joint, other) = (&skeleton.joints[joint].name, &layers[other].name);
                        let message = format!(
                            "{joint} is in layer {other} already; a joint is of one layer, take it out of one"
                        );
                        return Err(Error::setting(knob(&layer.name), message));
                    }
                    _ => {}
                }
            }
        }
    }
    let joints = |layer: usize| {
        let own = layer_of.iter().enumerate().filter(move |(_, of)| of.unwrap_or(0) == layer);
        own.map(|(joint, _)| JointId(joint)).collect()
    };
    let part = |(at, layer): (usize, &NamedLayer)| LayerJoints {
        name: layer.name.clone(),
        joints: joints(at),
    };
    Ok(layers.iter().enumerate().map(part).collect())
}

/// Returns the joints that a name or pattern fits.
fn fitting(pattern: &str, layer: &NamedLayer, skeleton: &Skeleton) -> Result<Vec<usize>, Error> {
    let names = || skeleton.joints.iter().map(|joint| joint.name.as_str());
    // A whole name means that joint alone, whatever characters it has.
    if let Some(joint) = names().position(|name| name == pattern) {
        return Ok(vec![joint]);
    }
    let found: Vec<usize> =
        (0..skeleton.len()).filter(|joint| fits(pattern, &skeleton.joints[*joint].name)).collect();
    if found.is_empty() {
        let hint = did_you_mean(pattern, names());
        let message = format!("the clip has no joint {pattern}{hint}");
        return Err(Error::setting(knob(&layer.name), message));
    }
    Ok(found)
}

/// Returns the layer's name for errors.
fn knob(name: &str) -> String {
    format!("layers.{name}")
}
