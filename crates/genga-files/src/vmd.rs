//! The limited motion for MikuMikuDance (MMD): a VMD file for any model with the standard bones, or for a given one.

mod keyed;
mod passed;
mod record;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::collections::HashSet;

use glam::DQuat;
use serde::{Deserialize, Serialize};

use crate::Sink;
use crate::beside::{Passes, unpassed};
use crate::csv_table;
use crate::curves::{Curves, TOO_FEW, keys_of};
use crate::humanoid::capture::Capture;
use crate::humanoid::cast::Cast;
pub use crate::humanoid::cast::{STILL_LIMB, VmdBones};
use crate::humanoid::rest_alignment::Stance;
use crate::humanoid::retarget::{Local, Retarget};
use crate::timeline::{Others, Timeline};
use genga::error::{Error, Warning};
use genga::knob::{Knobs, knob, knobs};
pub use genga::motion::BoneMap;
use genga::motion::body::names::bones::{Model, cp932};
use genga::motion::body::names::{Found, SHAPE};
use genga::motion::{Clip, Composite, JointId, Skeleton, played_out};
use genga::sheet::{Blank, Exposure, Sheet, Source};
pub use genga_read::MmdModel;
use genga_read::VmdBeside;
use keyed::IkLegs;
use passed::Passing;
pub use record::{VmdCameraMotion, VmdFaceKey, VmdKey, VmdMotion};

/// Maximum length of a model's name, in bytes of CP932.
const LONGEST_MODEL: usize = 20;

/// The default model name.
const NAMELESS: &str = "genga";

/// File extensions of models.
const ENDINGS: [&str; 2] = [".pmx", ".pmd"];

/// Settings of the motion for MMD.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Vmd {
    /// Playback rate in frames per second, 1 to 1000; default 30, MMD's own. At the sheet's own rate, each koma
    /// is one frame.
    pub fps: f64,
    /// Angle of the model's upper arms below the horizontal at rest, in degrees, 0 to 90; default 35. Models
    /// range from 30 to 45. A given model's own angle takes precedence.
    pub arm_angle: f64,
    /// Length of the model's leg from its root (足) to the ankle (足首), in MMD units; default 9.7, that of a
    /// figure of 158 cm at 8 cm per unit. Translations are scaled by this over the capture's own leg length, so
    /// that feet do not slide. A given model's own leg takes precedence.
    pub leg: f64,
    /// Name of the model; default genga. MMD warns if another model loads the motion, but loads it.
    pub model: String,
    /// The bone set to write; default `standard`. A given model's own bones take precedence.
    pub bones: VmdBones,
    /// Whether the face and the camera of a VMD keep their keys or are stepped with the drawings; default `keep`.
    pub others: Others,
    /// Map from joints to bones; `None`, the default, is the built-in table.
    #[serde(skip)]
    pub map: Option<BoneMap>,
    /// The model the motion is for; `None`, the default, is any with the standard bones.
    #[serde(skip)]
    pub body: Option<MmdModel>,
}

/// A motion for MMD, with a report on the joints.
#[derive(Debug, Clone, PartialEq)]
pub struct VmdMade {
    /// The contents of the file; [`VmdMotion::bytes`] encodes them.
    pub motion: VmdMotion,
    /// The camera that stands beside the body, which is a file of its own; `None` without one.
    pub camera: Option<VmdCameraMotion>,
    /// The mapping of joints to bones.
    pub report: VmdReport,
    /// Notes for the user.
    pub notes: Vec<Warning>,
}

/// The mapping of joints to bones.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VmdReport {
    /// The naming dialect that matched best.
    pub dialect: String,
    /// Bones with the joints that drive each, from the body outward.
    pub bones: Vec<(String, Vec<String>)>,
    /// Joints without a bone whose rotation is included in that of mapped joints further out.
    pub carried: Vec<String>,
    /// Joints whose motion is not in the file.
    pub left_out: Vec<String>,
    /// MMD units per unit of the clip.
    pub scale: f64,
}

impl VmdReport {
    /// Writes `joint,bone,what` as CSV, in the order of the lists. `what` is `drives` for a joint that drives a bone,
    /// `carried` for one whose rotation is in that of joints further out, or `left_out`.
    ///
    /// # Errors
    /// Fails only if memory runs out.
    pub fn csv(&self) -> Result<String, Error> {
        let driving = self.bones.iter().flat_map(|(bone, joints)| {
            joints.iter().map(move |joint| [joint.clone(), bone.clone(), "drives".into()])
        });
        let without = |joints: &'static str, list: &[String]| {
            list.iter()
                .map(|joint| [joint.clone(), String::new(), joints.into()])
                .collect::<Vec<_>>()
        };
        let carried = without("carried", &self.carried);
        let left_out = without("left_out", &self.left_out);
        csv_table(&["joint", "bone", "what"], driving.chain(carried).chain(left_out))
    }
}

impl Default for Vmd {
    fn default() -> Self {
        Self {
            fps: 30.0,
            arm_angle: 35.0,
            leg: 9.7,
            model: NAMELESS.into(),
            bones: VmdBones::Standard,
            others: Others::Keep,
            map: None,
            body: None,
        }
    }
}

knobs!(vmd::Vmd {
    fps: knob(
        "フレームレート",
        "Frames per second at which the motion is played. MMD uses 30.",
        "再生する毎秒フレーム数。MMDでは30。",
    )
    .unit("frames a second")
    .at_least(1.0)
    .at_most(1000.0),
    arm_angle: knob(
        "腕の角度",
        "Angle of the model's upper arms below the horizontal in its rest pose.",
        "モデルの初期姿勢で上腕が水平から下がる角度。",
    )
    .unit("degrees")
    .at_most(90.0),
    leg: knob(
        "脚の長さ",
        "Length of the model's leg, from 足 to 足首.",
        "モデルの足から足首までの長さ。",
    )
    .unit("MMD units")
    .above(0.0)
    .at_most(1e6),
    model: knob(
        "モデル",
        "The model: its file (.pmx, .pmd), to whose skeleton the motion is fitted, or only its \
         name.",
        "モデル。ファイル（.pmx、.pmd）ならその骨格に合わせる。名前だけでもよい。",
    )
    .unit("words"),
    bones: knob(
        "ボーン",
        "Bones that the motion drives: only those of every model, or also 上半身2 and 親指０.",
        "動かすボーン。全モデル共通の標準ボーンだけ、または上半身2と親指０も。",
    ),
    others: knob(
        "体以外",
        "Face, camera and light of a VMD: with their own keys (keep), or stepped with the drawings (step).",
        "VMDの表情・カメラ・照明。元のキーのまま（keep）か、画に合わせて止める（step）。",
    ),
    ..map, body
});

impl Vmd {
    /// Checks every setting.
    ///
    /// # Errors
    /// [`Error::Setting`] naming the first setting that is out of its range.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()
    }

    /// Converts the motion of a sheet for the model, or for any with the standard bones, with all layers combined.
    ///
    /// MMD has no stepped keys. A held drawing's pose is written again on the last frame before the next drawing.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::first_layer`]; [`Error::Clip`] if the clip has no frame, the map knows none of
    /// its joints, or the model has none of the bones they drive; [`Error::Setting`] if a setting is out of its
    /// range, or two koma would fall on the same frame.
    pub fn make(&self, clip: &Clip, sheet: &Sheet) -> Result<VmdMade, Error> {
        self.validate()?;
        let (beside, own) = (kept(clip), sheet);
        let (clip, sheet) = played_out(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = Composite::new(clip, sheet)?;
        if clip.is_empty() {
            return Err(Error::clip("the clip has no frame: there is no pose to write"));
        }
        let frames = Frames::new(self.fps, sheet.clock.koma_rate)?;
        let write = |retarget: &mut Retarget<'_>| {
            let keys = keys(&composite, (&frames, sheet.blank), retarget)?;
            Ok(Written { keys, ik_on: Vec::new(), notes: Vec::new() })
        };
        let made = self.made(&composite, sheet, write)?;
        let (timeline, in_koma) = (Timeline::new(own, self.others), frames.in_koma);
        made.passing(beside, &Passing { timeline: &timeline, in_koma })
    }

    /// Converts the take for the model as keys at the genga of a sheet with MMD's curves between them, which stay within
    /// `curves.error` of body height of the take. The keys stand at the times of the take.
    ///
    /// All bones have keys on the same frames, so each is a pose. The error is measured on the body of the take, moved by
    /// the bones of the model.
    ///
    /// # Errors
    /// Those of [`Vmd::make`]; [`Error::Sheet`] if fewer than two genga are on screen.
    pub fn make_keys(&self, clip: &Clip, sheet: &Sheet, curves: &Curves) -> Result<VmdMade, Error> {
        self.validate()?;
        if clip.is_empty() {
            return Err(Error::clip("the clip has no frame: there is no pose to write"));
        }
        let places = genga_places(clip, sheet)?;
        let genga = frames_at(&places, (self.fps, clip.rate().fps()))?;
        let length = genga[genga.len() - 1] as usize + 1;
        let mut ones = Sheet::on_ones(clip.clock(self.fps), length);
        for drawing in &mut ones.layers[0].drawings {
            let place = drawing.source.place() + places[0] - clip.first().0 as f64;
            drawing.source = Source::At(place.min(clip.last().0 as f64));
        }
        let composite = Composite::new(clip, &ones)?;
        let write = |retarget: &mut Retarget<'_>| {
            let legs = self.ik_legs(retarget);
            let made = keyed::keyed(clip, (retarget, &legs), (&genga, length), curves.error);
            let note = curves.note("keys-vmd", made.frames, made.added, made.error_of_genga);
            let notes = note.into_iter().chain(legs.note(made.error_of_knees));
            Ok(Written { keys: made.keys, ik_on: legs.names(), notes: notes.collect() })
        };
        let made = self.made(&composite, &ones, write)?;
        let pace = clip.rate().fps() / self.fps;
        let timeline = Timeline::of_take(places[0], places[places.len() - 1], pace);
        made.passing(kept(clip), &Passing { timeline: &timeline, in_koma: 1.0 })
    }

    /// The legs that MMD brings to keyed feet.
    fn ik_legs(&self, retarget: &Retarget<'_>) -> IkLegs<'_> {
        let bones = retarget.bones();
        let bones: Vec<&str> = bones.into_iter().map(|bone| retarget.name(bone)).collect();
        let leg = self.body.as_ref().and_then(MmdModel::leg).unwrap_or(self.leg);
        IkLegs::new(self.body.as_ref(), leg, &bones)
    }

    /// Makes a motion of the keys that `write` writes.
    fn made(
        &self,
        composite: &Composite<'_>,
        sheet: &Sheet,
        write: impl FnOnce(&mut Retarget<'_>) -> Result<Written, Error>,
    ) -> Result<VmdMade, Error> {
        let clip = composite.clip();
        let cast = self.cast(clip)?;
        let Cast { model, found, .. } = &cast;
        let capture = Capture::new(clip, model, found);
        let stance = Stance::new(&capture, self.arm_angle.to_radians());
        let leg = cast.leg.unwrap_or(self.leg);
        let mut retarget = Retarget::new(composite, model, &capture, &stance, leg);
        let report = report(clip.skeleton(), model, found, retarget.scale);
        let (name, _) = self.name()?;
        let mut notes = self.notes(clip, sheet)?;
        let Written { keys, ik_on, notes: own } = write(&mut retarget)?;
        notes.extend(own);
        let ik_off = cast.ik_off.into_iter().filter(|ik| !ik_on.contains(ik)).collect();
        let (faces, shown) = (Vec::new(), Vec::new());
        let motion = VmdMotion { model: name, keys, ik_on, ik_off, faces, shown };
        Ok(VmdMade { motion, camera: None, report, notes })
    }

    /// Collects the notes of [`Vmd::make`] without making the motion.
    ///
    /// # Errors
    /// [`Error::Clip`] if the map knows none of the joints, or the model has none of the bones they drive;
    /// [`Error::Setting`] if the model's name cannot be encoded, or two koma would fall on the same frame.
    pub fn notes(&self, clip: &Clip, sheet: &Sheet) -> Result<Vec<Warning>, Error> {
        Frames::new(self.fps, sheet.clock.koma_rate)?;
        let cast = self.cast(clip)?;
        let report = report(clip.skeleton(), &cast.model, &cast.found, 1.0);
        let mut notes = notes(&report, &cast.found);
        notes.extend(cast.still_limbs());
        notes.extend(cast.undriven());
        notes.extend(self.name()?.1);
        notes.extend((!cast.has_leg()).then(no_legs));
        notes.extend(cast.notes);
        notes.extend(unpassed("vmd", clip, Passes::Vmd));
        Ok(notes)
    }

    /// Whether a value of [`Vmd::model`] names a model file, which only the program can read.
    pub fn is_file(model: &str) -> bool {
        let lower = model.to_ascii_lowercase();
        ENDINGS.iter().any(|ending| lower.ends_with(ending))
    }

    /// Sets the model that the motion is for, and its name.
    pub fn play(&mut self, body: MmdModel) {
        self.model.clone_from(&body.name);
        self.body = Some(body);
    }

    fn cast(&self, clip: &Clip) -> Result<Cast, Error> {
        let map = self.map();
        Cast::new(&map, map.locate(clip)?, self.bones, self.body.as_ref())
    }

    /// The model's name as encoded in the file, with a warning if it had to change.
    fn name(&self) -> Result<(String, Option<Warning>), Error> {
        if self.body.is_none() && Self::is_file(&self.model) {
            let message =
                "this is a file: the program reads it, in the library MmdModel::read does";
            return Err(Error::setting("vmd.model", message));
        }
        match (cut(&self.model), &self.body) {
            (Err(_), Some(body)) if body.name == self.model => {
                let message = format!(
                    "the model's name {} has letters that no VMD holds: MMD will say that the motion is for another",
                    body.name
                );
                Ok((NAMELESS.into(), Some(Warning::new("W_VMD_MODEL_NAME", message))))
            }
            (named, _) => named,
        }
    }

    fn map(&self) -> Cow<'_, BoneMap> {
        self.map.as_ref().map_or_else(|| Cow::Owned(BoneMap::default()), Cow::Borrowed)
    }
}

impl VmdMade {
    /// Hands over the camera's file, if there is one.
    pub(crate) fn put_camera(&self, name: &str, put: &mut Sink<'_>) -> Result<(), Error> {
        self.camera.as_ref().map_or(Ok(()), |camera| put(name, &camera.bytes()?))
    }

    /// Adds what the source holds beside the body.
    fn passing(mut self, beside: Option<&VmdBeside>, passing: &Passing<'_>) -> Result<Self, Error> {
        if let Some(beside) = beside {
            self.motion.faces = passing.faces(beside)?;
            self.motion.shown = passing.shown(beside)?;
            self.camera = passing.camera(beside)?;
        }
        Ok(self)
    }
}

/// The keys of a motion.
struct Written {
    keys: Vec<VmdKey>,
    /// The IK that brings legs to their feet.
    ik_on: Vec<String>,
    notes: Vec<Warning>,
}

/// What a VMD holds beside the body of a clip.
fn kept(clip: &Clip) -> Option<&VmdBeside> {
    clip.beside().and_then(|beside| beside.kept())
}

/// Returns the places of the genga on all layers, in order of time.
fn genga_places(clip: &Clip, sheet: &Sheet) -> Result<Vec<f64>, Error> {
    let keys = sheet.layers.iter().flat_map(|layer| keys_of(layer, clip));
    let mut places: Vec<f64> = keys.map(|key| key.place).collect();
    places.sort_by(f64::total_cmp);
    if places.is_empty() { Err(Error::sheet(TOO_FEW)) } else { Ok(places) }
}

/// Returns the frames of MMD that are nearest to some places, each once. The first place is on frame 0; `rate` is that
/// of the source.
fn frames_at(places: &[f64], (fps, rate): (f64, f64)) -> Result<Vec<u32>, Error> {
    let frame = |place: &f64| ((place - places[0]) * fps / rate).round() as u32;
    let mut frames: Vec<u32> = places.iter().map(frame).collect();
    frames.dedup();
    if frames.len() < 2 { Err(Error::sheet(TOO_FEW)) } else { Ok(frames) }
}

/// Conversion of koma to frames.
struct Frames {
    in_koma: f64,
}

impl Frames {
    fn new(fps: f64, koma_rate: f64) -> Result<Self, Error> {
        if koma_rate > fps {
            let message = format!(
                "{koma_rate} koma a second do not go into {fps} frames: two would be one; take {koma_rate} or more"
            );
            return Err(Error::setting("vmd.fps", message));
        }
        Ok(Self { in_koma: fps / koma_rate })
    }

    /// The frame on which a koma begins: its time, rounded half up.
    fn frame_at(&self, koma: usize) -> Result<u32, Error> {
        let frame = (koma as f64 * self.in_koma + 0.5).floor();
        if frame <= f64::from(u32::MAX) {
            Ok(frame as u32)
        } else {
            Err(Error::clip("the sheet is too long for a VMD file"))
        }
    }
}

/// Keys every bone on the first frame of each drawing, and on its last frame if that differs. If the root moves
/// while a drawing is held, the centre is keyed on every koma too. If the feet stay planted meanwhile, every bone is.
/// The first pose stands over the blank koma before it, the last over those after.
fn keys(
    composite: &Composite<'_>,
    (frames, blank): (&Frames, Blank),
    retarget: &mut Retarget<'_>,
) -> Result<Vec<VmdKey>, Error> {
    let layer = composite.layer();
    let bones = retarget.bones();
    let slides = composite.slides() && retarget.has_center();
    let mut before = vec![DQuat::IDENTITY; bones.len()];
    let exposures: Vec<(usize, Exposure)> = if composite.steppers().is_empty() {
        layer.timed().collect()
    } else {
        layer.koma().map(|drawing| Exposure { drawing, koma: 1 }).enumerate().collect()
    };
    let mut keys = Vec::with_capacity(2 * bones.len() * exposures.len());
    for (begin, exposure) in exposures {
        let mut pose = retarget.take(exposure.drawing, begin);
        for (local, before) in pose.iter_mut().zip(&mut before) {
            // q and −q are the same rotation, but MMD would interpolate between them the long way round.
            if local.rotation.dot(*before) < 0.0 {
                local.rotation = -local.rotation;
            }
            *before = local.rotation;
        }
        let end = blank.pose_ends(begin + exposure.koma, layer.length());
        let first = frames.frame_at(blank.pose_begins(begin))?;
        let last = frames.frame_at(end)? - 1;
        keys.extend(posed(retarget, &bones, &pose, first));
        let held = usize::from(slides)..bones.len() * usize::from(last > first);
        if !held.is_empty() {
            keys.extend(posed(retarget, &bones[held.clone()], &pose[held], last));
        }
        if slides && begin == 0 && blank.before > 0 {
            // The centre stands over the blank koma, and moves from here.
            let enters = frames.frame_at(blank.before)?;
            keys.extend(posed(retarget, &bones[..1], &pose[..1], enters));
        }
        if slides {
            keys.extend(slide(retarget, exposure, begin, (frames, blank))?);
        }
    }
    keys.sort_by_key(|key| key.frame);
    Ok(keys)
}

/// Keys some bones on a frame.
fn posed<'a>(
    retarget: &'a Retarget<'_>,
    bones: &'a [usize],
    pose: &'a [Local],
    frame: u32,
) -> impl Iterator<Item = VmdKey> + 'a {
    bones
        .iter()
        .zip(pose)
        .map(move |(bone, local)| VmdKey::new(retarget.name(*bone), frame, *local))
}

/// Keys the centre on each koma after the first of an exposure.
fn slide(
    retarget: &mut Retarget<'_>,
    exposure: Exposure,
    begin: usize,
    (frames, blank): (&Frames, Blank),
) -> Result<Vec<VmdKey>, Error> {
    let center = retarget.bones()[0];
    let key = |koma: usize| {
        let local = retarget.take(exposure.drawing, koma)[0];
        Ok(VmdKey::new(retarget.name(center), frames.frame_at(blank.before + koma)?, local))
    };
    (begin + 1..begin + exposure.koma).map(key).collect()
}

impl VmdKey {
    /// Converts a pose to MMD's left-handed axes, in which z is reversed.
    fn new(bone: &str, frame: u32, local: Local) -> Self {
        let Local { translation: t, rotation: q } = local;
        // Adding 0 turns −0 into 0.
        let single = |value: f64| value as f32 + 0.0;
        Self {
            bone: bone.into(),
            frame,
            translation: [t.x, t.y, -t.z].map(single),
            rotation: [-q.x, -q.y, q.z, q.w].map(single),
            curves: record::LINEAR,
        }
    }
}

/// Cuts the model's name to the length a VMD holds, never within a character.
fn cut(name: &str) -> Result<(String, Option<Warning>), Error> {
    let mut short = name.to_owned();
    while cp932(&short, usize::MAX)?.len() > LONGEST_MODEL {
        short.pop();
    }
    let note = (short != name).then(|| {
        let message = format!("the model's name is cut to \"{short}\": a VMD holds 20 bytes");
        Warning::new("W_VMD_MODEL_NAME", message)
    });
    Ok((short, note))
}

fn no_legs() -> Warning {
    let message = "no legs to measure: the unit is guessed by the body's size, 8 cm to an MMD unit";
    Warning::new("W_VMD_NO_LEGS", message)
}

fn report(skeleton: &Skeleton, model: &Model, found: &Found, scale: f64) -> VmdReport {
    let name = |joint: &JointId| skeleton.joints[joint.0].name.clone();
    let driven = model.bones.iter().zip(&found.joints).filter(|(_, joints)| !joints.is_empty());
    let bones = driven.map(|(bone, joints)| (bone.name.clone(), joints.iter().map(name).collect()));
    let mapped: HashSet<usize> = found.joints.iter().flatten().map(|joint| joint.0).collect();
    let mut carrying = vec![false; skeleton.len()];
    for (JointId(joint), data) in skeleton.iter().rev() {
        if let Some(JointId(parent)) = data.parent {
            carrying[parent] |= carrying[joint] || mapped.contains(&joint);
        }
    }
    let others = |carries: bool| {
        let joints = skeleton.iter().filter(|(joint, _)| !mapped.contains(&joint.0));
        let joints = joints.filter(|(joint, _)| carrying[joint.0] == carries);
        joints.map(|(_, joint)| joint.name.clone()).collect::<Vec<_>>()
    };
    VmdReport {
        dialect: found.dialect.clone(),
        bones: bones.collect(),
        carried: others(true),
        left_out: others(false),
        scale,
    }
}

fn notes(report: &VmdReport, found: &Found) -> Vec<Warning> {
    let mut notes = Vec::new();
    if !found.by_shape.is_empty() {
        let message = if found.dialect == SHAPE {
            "vmd: no joint has a name that is known: the shape of the body says which is which"
                .into()
        } else {
            let bones = found.by_shape.join(", ");
            format!(
                "vmd: the shape of the body says which joints are {bones}: names do not, or do not fit it"
            )
        };
        notes.push(Warning::new("W_BY_SHAPE", message));
    }
    if !report.left_out.is_empty() {
        let joints = report.left_out.join(", ");
        let message = format!(
            "vmd: no bone for {joints}: their motion is not in it ([extra] in a file of bones takes it up: --bones)"
        );
        notes.push(Warning::new("W_VMD_LEFT_OUT", message));
    }
    if !found.missing.is_empty() {
        let message = format!("vmd: the body has no joint {}", found.missing.join(", "));
        notes.push(Warning::new("W_VMD_NO_JOINT", message));
    }
    notes
}
