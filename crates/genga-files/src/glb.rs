//! The limited motion as GLB (glTF 2.0 in a single file), every channel stepped.

pub(crate) mod animation;
pub(crate) mod binary;
pub(crate) mod bones;
mod hold;
mod keyed;
mod mesh;
mod others;
#[cfg(test)]
mod tests;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::curves::Curves;
use crate::timeline::{Others, Timeline};
use binary::Binary;
use bones::Bones;
use genga::error::Error;
use genga::knob::{Knobs, choices, knob, knobs};
use genga::motion::{Axis, Cels, Clip, Composite, Stature, Unit, played_out};
use genga::sheet::{Layer, Sheet};
use genga_read::GltfScene;
use others::Hung;

/// The limited motion as GLB: a skeleton that holds each drawing's pose for as long as the drawing is
/// exposed, in metres and +Y up. By default every sampler is `STEP`.
///
/// The file has two animations: `koma` with every drawing, and `genga` with the key drawings (原画) alone.
/// `koma` comes first because players show the first one. The koma, number, role and source place of
/// every drawing are in `animations[i].extras`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glb {
    /// Unit of length of the clip; default `auto`: guessed from the size of the body.
    pub unit: LengthUnit,
    /// Factor by which the body is enlarged, 0.001 to 1000; default 1.
    pub scale: f64,
    /// Axis of the clip that points up; default `auto`: derived from the poses.
    pub up: Up,
    /// Whether each bone gets an octahedron that makes it visible, default true. Without it most viewers show
    /// nothing, though Blender still imports the armature.
    pub mesh: bool,
    /// Keying of holds; default `single`.
    pub step: Step,
    /// Whether cameras, props and morphs of a glTF keep their keys or are stepped with the drawings; default `keep`.
    pub others: Others,
}

/// The keying of holds (止め).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Step {
    /// One `STEP` key per drawing, which lasts until the next.
    #[default]
    Single,
    /// Two equal `LINEAR` keys per drawing, the second a hundredth of a koma before the next drawing. Doubles
    /// the number of keys, for readers that interpolate stepped keys linearly.
    Doubled,
}

choices!(Step { Single: "single", Doubled: "doubled" });

/// A unit of length (単位), or automatic detection.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// The unit that the file declares, or else the one in which the body has human height.
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
    /// An inch divided by 0.45, as in CMU's motion library.
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
    /// Metres per unit; `None` for `Auto`.
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
    /// The axis that a person or the file declares, or else the one along which the body stands.
    #[default]
    Auto,
    /// Y, as in most motion files.
    Y,
    /// Z, as in files that Blender writes.
    Z,
}

choices!(Up { Auto: "auto", Y: "y", Z: "z" });

impl Default for Glb {
    fn default() -> Self {
        Self {
            unit: LengthUnit::Auto,
            scale: 1.0,
            up: Up::Auto,
            mesh: true,
            step: Step::Single,
            others: Others::Keep,
        }
    }
}

knobs!(glb::Glb {
    unit: knob("単位", "Unit of length of the clip.", "素材の長さの単位。"),
    scale: knob("倍率", "Scale factor of the body.", "体の倍率。")
        .unit("times")
        .at_least(0.001)
        .at_most(1000.0),
    up: knob("上の軸", "Up axis of the clip.", "素材の上向きの軸。"),
    mesh: knob(
        "骨の形",
        "Whether each bone gets an octahedron as a mesh. Without it, most viewers show nothing.",
        "骨に八面体のメッシュを付けるか。ないと多くのビューアでは何も見えない。",
    ),
    step: knob(
        "止めのキー",
        "Keyframes per drawing: one with step interpolation (single), or two equal linear ones for \
         programs without step interpolation (doubled).",
        "1枚ごとのキー。ステップ補間のキー1つ（single）、\
         またはステップ補間に非対応のソフト向けに同じリニアのキー2つ（doubled）。",
    ),
    others: knob(
        "体以外",
        "Cameras, props and morphs of a glTF: with their own keys (keep), or stepped with the drawings (step).",
        "glTFのカメラ・小道具・モーフ。元のキーのまま（keep）か、画に合わせて止める（step）。",
    ),
});

impl Glb {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the scale is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Writes the motion of a sheet as the bytes of a `.glb`, with all layers combined.
    ///
    /// Nodes keep the order and names of the joints; the End Sites follow as `NAME_end`. Each pose equals that
    /// of `limited.bvh` on the same koma.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Glb::validate`]; [`Error::Sheet`] as [`Sheet::first_layer`];
    /// [`Error::Clip`] if the clip has no joint, too many joints for a skin (65535), or values that are not
    /// finite.
    pub fn write(&self, clip: &Clip, sheet: &Sheet) -> Result<Vec<u8>, Error> {
        self.validate()?;
        clip.check_size()?;
        // The rounds of a loop are at other places and show the same drawings.
        let named = Cels::new(clip, sheet)?;
        let (beside, timeline) = (others::scene_of(clip), Timeline::new(sheet, self.others));
        let (clip, sheet) = played_out(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = Composite::new(clip, sheet)?;
        let space = self.space(clip);
        let bones = Bones::new(clip.skeleton(), space)?;
        let (mut document, mut binary, hung) = self.scene(&bones, beside, space);
        let mut animations =
            self.animations(&composite, (sheet, named.layer()), space, &mut binary);
        for animation in &mut animations {
            let time = (&timeline, sheet.clock.koma_rate);
            hung.iter().for_each(|hung| hung.play(animation, time, &mut binary));
        }
        document["animations"] = Value::Array(animations);
        Ok(binary.into_glb(document))
    }

    /// Writes the take as keys at the genga with smooth curves between them: `CUBICSPLINE` samplers, `LINEAR` ones
    /// where a straight line is close enough.
    ///
    /// The file has one animation, `keys`, on the same skeleton as that of [`Glb::write`]. Its `extras` list the keys.
    ///
    /// # Errors
    /// Those of [`Glb::write`]; [`Error::Sheet`] if fewer than two genga are on screen.
    pub fn write_keys(
        &self,
        clip: &Clip,
        sheet: &Sheet,
        curves: &Curves,
    ) -> Result<Vec<u8>, Error> {
        self.validate()?;
        clip.check_size()?;
        let space = self.space(clip);
        let bones = Bones::new(clip.skeleton(), space)?;
        let keyed = curves.fit(clip, sheet)?;
        let (mut document, mut binary, hung) = self.scene(&bones, others::scene_of(clip), space);
        let mut animation = keyed::animation(clip, sheet, &keyed, (space, curves), &mut binary);
        if let (Some(hung), [first, .., last]) = (hung, &keyed.layers[0][..]) {
            let time = (&Timeline::of_take(first.place, last.place, 1.0), clip.rate().fps());
            hung.play(&mut animation, time, &mut binary);
        }
        document["animations"] = json!([animation]);
        Ok(binary.into_glb(document))
    }

    /// The conversion from the clip's space into that of glTF.
    fn space(&self, clip: &Clip) -> Space {
        let stature = Stature::new(clip);
        let scale = self.scale * self.unit.metres().unwrap_or(stature.metres);
        let is_z_up = match self.up {
            Up::Auto => stature.up == Axis::Z,
            up => up == Up::Z,
        };
        Space { scale, is_z_up }
    }

    /// Builds the document without its animations: nodes, the skin, the mesh bound to it, and what the source holds beside
    /// the body.
    fn scene<'a>(
        &self,
        bones: &Bones,
        beside: Option<&'a GltfScene>,
        space: Space,
    ) -> (Value, Binary, Option<Hung<'a>>) {
        let mut binary =
            beside.map_or_else(Binary::default, |scene| Binary::of(&scene.bytes, &scene.parts));
        let mut nodes = bones.nodes();
        let mut scene = vec![bones.root()];
        let mut document = json!({
            "asset": { "version": "2.0", "generator": GENERATOR },
            "skins": [bones.skin(&mut binary)],
            "scene": 0,
        });
        for (name, part) in beside.into_iter().flat_map(|scene| &scene.parts) {
            document[name] = part.clone();
        }
        if self.mesh {
            let [meshes, first] = ["meshes", "materials"].map(|name| count(&document[name]));
            let (mesh, materials) = mesh::mesh(bones, first, &mut binary);
            extend(&mut document["meshes"], vec![mesh]);
            extend(&mut document["materials"], materials);
            // A skinned mesh must not be a child of a joint: the joints alone move it.
            scene.push(nodes.len());
            nodes.push(json!({ "name": "bones", "mesh": meshes, "skin": 0 }));
        }
        let hung = beside.map(|beside| Hung::new(beside, space, (&mut nodes, &mut scene)));
        document["nodes"] = Value::Array(nodes);
        document["scenes"] = json!([{ "nodes": scene }]);
        (document, binary, hung)
    }

    /// Writes both animations, or only the first if no drawing is a key.
    fn animations(
        &self,
        composite: &Composite<'_>,
        (sheet, named): (&Sheet, &Layer),
        space: Space,
        binary: &mut Binary,
    ) -> Vec<Value> {
        let layer = composite.layer();
        let poses = animation::Poses::new(composite, space);
        let write = |name: &str, shown: &[animation::Exposed], binary: &mut Binary| {
            poses.animation(name, shown, (named, sheet), self.step, binary)
        };
        let mut animations = vec![write("koma", &animation::all(layer), binary)];
        let genga = animation::genga(layer);
        if !genga.is_empty() {
            animations.push(write("genga", &genga, binary));
        }
        animations
    }
}

/// Number of elements of a list, which may be missing.
fn count(list: &Value) -> usize {
    list.as_array().map_or(0, Vec::len)
}

/// Adds elements to a list, which may be missing.
fn extend(list: &mut Value, more: Vec<Value>) {
    match list.as_array_mut() {
        Some(list) => list.extend(more),
        None => *list = more.into(),
    }
}

pub(crate) const GENERATOR: &str = concat!("genga ", env!("CARGO_PKG_VERSION"));

/// Conversion of the clip's space into that of glTF: metres, +Y up, right-handed like the clip's.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Space {
    /// Metres per unit of the clip.
    scale: f64,
    is_z_up: bool,
}

impl Space {
    fn position(self, vector: DVec3) -> DVec3 {
        self.turned(vector) * self.scale
    }

    /// Expresses a local rotation in the turned axes: its axis turns with them, its angle stays.
    fn rotation(self, rotation: DQuat) -> DQuat {
        let axis = self.turned(rotation.xyz());
        DQuat::from_xyzw(axis.x, axis.y, axis.z, rotation.w)
    }

    /// Turns Z up to Y by a quarter turn about X. It only swaps coordinates, so nothing is rounded.
    fn turned(self, vector: DVec3) -> DVec3 {
        if self.is_z_up { DVec3::new(vector.x, vector.z, -vector.y) } else { vector }
    }
}
