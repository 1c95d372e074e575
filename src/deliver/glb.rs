//! The limited motion as GLB (glTF 2.0 in one file), every channel stepped.

pub(in crate::deliver) mod animation;
pub(in crate::deliver) mod binary;
pub(in crate::deliver) mod bones;
mod hold;
mod mesh;
#[cfg(test)]
mod tests;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::error::Error;
use crate::knob::{Knobs, choices, knob, knobs};
use crate::motion::{Axis, Clip, Composite, Stature, Unit};
use crate::sheet::Sheet;
use binary::Binary;
use bones::Bones;

/// The limited motion as GLB: a skeleton that holds each drawing's pose for as long as the drawing is
/// exposed (by default every sampler is `STEP`), in metres and +Y up.
///
/// It has two animations: `koma` with every drawing, first because players show the first, and `genga`
/// with the key drawings (原画) alone. The koma, number, role and source place of every drawing stand
/// in `animations[i].extras`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glb {
    /// The clip's unit of length; default `auto`: guessed from the size of the body.
    pub unit: LengthUnit,
    /// How many times as large the body becomes, 0.001 to 1000; default 1.
    pub scale: f64,
    /// The clip's axis that points up; default `auto`: seen from the poses.
    pub up: Up,
    /// Whether each bone has an octahedron to be seen by, default true. Without it most viewers show
    /// nothing and Blender still makes the armature.
    pub mesh: bool,
    /// How a hold is keyed; default `single`.
    pub step: Step,
}

/// How a hold (止め) is keyed.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Step {
    /// One key a drawing, `STEP`: it stands until the next.
    #[default]
    Single,
    /// Two equal keys a drawing, `LINEAR`, the second a hundredth of a koma before the next drawing. For
    /// readers that make lines of steps; the file's keys are twice as many.
    Doubled,
}

choices!(Step { Single: "single", Doubled: "doubled" });

/// A unit of length (単位), or that nobody knows it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// The one that the file declares, else the one in which the body is as high as a person.
    #[default]
    Auto,
    /// Metres.
    M,
    /// Decimetres.
    Dm,
    /// Centimetres.
    Cm,
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
    /// An inch divided by 0.45, as CMU's motion has it.
    Cmu,
}

choices!(LengthUnit {
    Auto: "auto",
    M: "m",
    Dm: "dm",
    Cm: "cm",
    Mm: "mm",
    Inch: "inch",
    Cmu: "cmu"
});

impl LengthUnit {
    /// Metres in one of it, where it is known.
    fn metres(self) -> Option<f64> {
        let unit = match self {
            Self::Auto => return None,
            Self::M => Unit::Metre,
            Self::Dm => Unit::Decimetre,
            Self::Cm => Unit::Centimetre,
            Self::Mm => Unit::Millimetre,
            Self::Inch => Unit::Inch,
            Self::Cmu => Unit::Cmu,
        };
        Some(unit.metres())
    }
}

/// The axis that points up.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Up {
    /// The one that a person or the file declares, else the one along which the body stands.
    #[default]
    Auto,
    /// As in most motion files.
    Y,
    /// As in files that Blender writes.
    Z,
}

choices!(Up { Auto: "auto", Y: "y", Z: "z" });

impl Default for Glb {
    fn default() -> Self {
        Self { unit: LengthUnit::Auto, scale: 1.0, up: Up::Auto, mesh: true, step: Step::Single }
    }
}

knobs!(glb::Glb {
    unit: knob("単位", "The clip's unit of length.", "素材の長さの単位。"),
    scale: knob("倍率", "How many times as large the body becomes.", "体を何倍にするか。")
        .unit("times")
        .at_least(0.001)
        .at_most(1000.0),
    up: knob("上の軸", "The clip's axis that points up.", "素材の上向きの軸。"),
    mesh: knob(
        "骨の形",
        "Whether each bone has an octahedron to be seen by; without it most viewers show nothing.",
        "骨を八面体で見せるか。ないと多くのビューアでは何も見えない。",
    ),
    step: knob(
        "止めのキー",
        "One stepped key a drawing, or two equal linear ones for programs that know no steps.",
        "1枚にステップのキー1つ、またはステップのないソフト向けに同じリニアのキー2つ。",
    ),
});

impl Glb {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] for a scale out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// The motion of a sheet as the bytes of a `.glb`, all layers on one another.
    ///
    /// Nodes stand in the order of joints and have their names, then follow the End Sites as `NAME_end`.
    /// A pose is the one that `limited.bvh` has on the same koma.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Glb::validate`]; [`Error::Sheet`] as [`Sheet::first_layer`];
    /// [`Error::Clip`] when the clip has no joint, too many joints for a skin (65535), or values that are
    /// no motion.
    pub fn write(&self, clip: &Clip, sheet: &Sheet) -> Result<Vec<u8>, Error> {
        self.validate()?;
        clip.check_size()?;
        let composite = Composite::of(clip, sheet)?;
        let space = self.space(clip);
        let bones = Bones::of(clip.skeleton(), space)?;
        let mut binary = Binary::default();
        let mut document = self.scene(&bones, &mut binary);
        document["animations"] = self.animations(&composite, sheet, space, &mut binary);
        Ok(binary.into_glb(document))
    }

    /// From the clip's space into that of glTF.
    fn space(&self, clip: &Clip) -> Space {
        let stature = Stature::of(clip);
        let scale = self.scale * self.unit.metres().unwrap_or(stature.metres);
        let is_z_up = match self.up {
            Up::Auto => stature.up == Axis::Z,
            up => up == Up::Z,
        };
        Space { scale, is_z_up }
    }

    /// All but the animations: nodes, the skin, and the mesh that hangs on it.
    fn scene(&self, bones: &Bones, binary: &mut Binary) -> Value {
        let mut nodes = bones.nodes();
        let mut scene = vec![bones.root()];
        let mut document = json!({
            "asset": { "version": "2.0", "generator": GENERATOR },
            "skins": [bones.skin(binary)],
            "scene": 0,
        });
        if self.mesh {
            let (mesh, materials) = mesh::mesh(bones, binary);
            document["meshes"] = json!([mesh]);
            document["materials"] = materials.into();
            // A skinned mesh must not hang on a joint: it is moved by the joints alone.
            scene.push(nodes.len());
            nodes.push(json!({ "name": "bones", "mesh": 0, "skin": 0 }));
        }
        document["nodes"] = Value::Array(nodes);
        document["scenes"] = json!([{ "nodes": scene }]);
        document
    }

    /// Both animations, or the first alone where no drawing is a key.
    fn animations(
        &self,
        composite: &Composite<'_>,
        sheet: &Sheet,
        space: Space,
        binary: &mut Binary,
    ) -> Value {
        let layer = composite.layer();
        let poses = animation::Poses::of(composite, space);
        let write = |name: &str, shown: &[animation::Exposed], binary: &mut Binary| {
            poses.animation(name, shown, (layer, sheet.clock.koma_rate), self.step, binary)
        };
        let mut animations = vec![write("koma", &animation::all(layer), binary)];
        let genga = animation::genga(layer);
        if !genga.is_empty() {
            animations.push(write("genga", &genga, binary));
        }
        Value::Array(animations)
    }
}

pub(in crate::deliver) const GENERATOR: &str = concat!("genga ", env!("CARGO_PKG_VERSION"));

/// How the clip's space becomes that of glTF: metres, +Y up, right-handed as before.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Space {
    /// Metres in one of the clip's units.
    scale: f64,
    is_z_up: bool,
}

impl Space {
    fn position(self, vector: DVec3) -> DVec3 {
        self.turned(vector) * self.scale
    }

    /// A local rotation seen from the turned axes: its axis turns with them, its angle stays.
    fn rotation(self, rotation: DQuat) -> DQuat {
        let axis = self.turned(rotation.xyz());
        DQuat::from_xyzw(axis.x, axis.y, axis.z, rotation.w)
    }

    /// A quarter turn about X that brings Z up, by exchange alone and so without rounding.
    fn turned(self, vector: DVec3) -> DVec3 {
        if self.is_z_up { DVec3::new(vector.x, vector.z, -vector.y) } else { vector }
    }
}
