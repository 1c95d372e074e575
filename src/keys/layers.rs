//! Splits a body into layers (セル分け): groups of joints with their own keys and column.

mod clip;
mod named;
#[cfg(test)]
mod tests;

use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{Kind, Setting};
use crate::motion::{Build, Clip, JointId, Skeleton, below};
use crate::sheet::column_name;

pub(crate) use clip::LayerClip;
pub use named::NamedLayer;

/// How the body is split into layers, each with its own keys, spacing and omission.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub enum Layers {
    /// One layer, the whole body.
    #[default]
    Body,
    /// Five: trunk with head, left arm, right arm, left leg, right leg. An arm begins at the shoulder, a
    /// leg at the hip.
    Limbs,
    /// One for each joint that moves. A joint that never moves goes with its parent.
    Joints,
    /// Layers that a person names. The first also takes the joints that no layer names.
    Named(Vec<NamedLayer>),
}

/// A layer and its joints.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerJoints {
    /// The column's name.
    pub name: String,
    /// Its joints in skeleton order; never empty.
    pub joints: Vec<JointId>,
}

impl Layers {
    /// Checks what can be checked without a clip.
    ///
    /// # Errors
    /// [`Error::Setting`] if a list has no layer, or a layer has no joint, an unusable name or the name of another.
    pub fn validate(&self) -> Result<(), Error> {
        match self {
            Self::Named(layers) => named::validate(layers),
            _ => Ok(()),
        }
    }

    /// Splits a body into layers that together have every joint once.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Layers::validate`]; if a named joint does not exist or is in two layers; or if a body
    /// without head, two arms and two legs is to be split into its limbs.
    pub fn split(&self, clip: &Clip) -> Result<Vec<LayerJoints>, Error> {
        self.validate()?;
        let skeleton = clip.skeleton();
        match self {
            Self::Body => Ok(layers(vec![0; skeleton.len()])),
            Self::Limbs => limbs(clip).map(layers),
            Self::Joints => Ok(layers(moving(clip))),
            Self::Named(layers) => named::split(layers, skeleton),
        }
    }

    /// Reads layers from a file of their own: `[[layers]]` with `name` and `joints`, as in a recipe. The settings of the
    /// layers are passed over.
    ///
    /// # Errors
    /// [`Error::Setting`] if the file is no such list, and the errors of [`Layers::validate`].
    pub(crate) fn parse(text: &str) -> Result<Self, Error> {
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct File {
            layers: Vec<WithSettings>,
        }
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        struct WithSettings {
            name: String,
            joints: Vec<String>,
            #[serde(default, rename = "keys")]
            _keys: IgnoredAny,
            #[serde(default, rename = "spacing")]
            _spacing: IgnoredAny,
            #[serde(default, rename = "omission")]
            _omission: IgnoredAny,
        }
        let wrong = |error: toml::de::Error| Error::setting("layers", error.to_string().trim());
        let file: File = toml::from_str(text).map_err(wrong)?;
        let named = |WithSettings { name, joints, .. }| NamedLayer { name, joints };
        let layers = Self::Named(file.layers.into_iter().map(named).collect());
        layers.validate()?;
        Ok(layers)
    }
}

/// Builds the layers A, B, C … from the number of each joint's layer.
fn layers(layer_of: Vec<usize>) -> Vec<LayerJoints> {
    let layers = layer_of.iter().max().map_or(0, |last| last + 1);
    let joints = |layer: usize| {
        let own = layer_of.iter().enumerate().filter(|(_, of)| **of == layer);
        own.map(|(joint, _)| JointId(joint)).collect()
    };
    (0..layers)
        .map(|layer| LayerJoints { name: column_name(layer), joints: joints(layer) })
        .collect()
}

/// Numbers the joints by layer: trunk and head 0, the arms 1 and 2, the legs 3 and 4.
fn limbs(clip: &Clip) -> Result<Vec<usize>, Error> {
    let mannequin = Build::new(clip).mannequin.ok_or_else(|| {
        let message = "this body has no head, two arms and two legs to be seen by; name the joints of each \
                       layer, layers = [{ name = \"A\", joints = [\"Hips\"] }], or take body";
        Error::setting("layers", message)
    })?;
    let mut layer_of = vec![0; clip.skeleton().len()];
    for (limb, top) in mannequin.limb_tops(clip.skeleton()).into_iter().enumerate() {
        below(clip.skeleton(), top).for_each(|joint| layer_of[joint] = limb + 1);
    }
    Ok(layer_of)
}

/// Numbers the joints that move; the others get the number of their parent.
fn moving(clip: &Clip) -> Vec<usize> {
    let moves = clip.moving_joints();
    let mut layers = 0;
    let mut layer_of: Vec<usize> = Vec::with_capacity(moves.len());
    for (joint, moves) in clip.skeleton().joints.iter().zip(moves) {
        let own = layers;
        let carrier = joint.parent.map_or(0, |parent| layer_of[parent.0]);
        layer_of.push(if moves { own } else { carrier });
        layers += usize::from(moves);
    }
    layer_of
}

impl LayerJoints {
    /// Whether it has every joint of a body.
    pub fn is_whole(&self, skeleton: &Skeleton) -> bool {
        self.joints.len() == skeleton.len()
    }
}

impl Setting for Layers {
    const KIND: Kind = Kind::Choice(&["body", "limbs", "joints"]);

    fn word(&self) -> String {
        match toml::Value::try_from(self).expect("names are plain text") {
            toml::Value::String(word) => word,
            list => list.to_string(),
        }
    }

    /// Reads a word, or a list in TOML.
    fn of_word(word: &str) -> Option<Self> {
        let list = || toml::from_str::<toml::Table>(&format!("list = {word}")).ok()?.remove("list");
        let list = word.starts_with('[').then(list).flatten();
        list.unwrap_or_else(|| word.into()).try_into().ok()
    }
}

/// Layers as a recipe writes them: a word, or a list.
#[derive(Serialize, Deserialize)]
#[serde(
    untagged,
    expecting = "expected body, limbs, joints or a list [{ name = \"A\", joints = [\"Hips\"] }]"
)]
enum Written {
    Word(String),
    List(Vec<NamedLayer>),
}

impl TryFrom<Written> for Layers {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        match written {
            Written::List(layers) => Ok(Self::Named(layers)),
            Written::Word(word) => match word.as_str() {
                "body" => Ok(Self::Body),
                "limbs" => Ok(Self::Limbs),
                "joints" => Ok(Self::Joints),
                other => Err(format!(
                    "expected body, limbs, joints or a list of layers, found \"{other}\""
                )),
            },
        }
    }
}

impl From<Layers> for Written {
    fn from(layers: Layers) -> Self {
        match layers {
            Layers::Body => Self::Word("body".into()),
            Layers::Limbs => Self::Word("limbs".into()),
            Layers::Joints => Self::Word("joints".into()),
            Layers::Named(layers) => Self::List(layers),
        }
    }
}
