//! The poses of a sheet as glTF animation channels that hold each of them.

use glam::DQuat;
use serde_json::{Value, json};

use super::binary::{Binary, Use};
use super::bones::floats;
use super::{Space, Step};
use genga::motion::{Composite, CompositeRows, Joint, local_rotation, local_translation};
use genga::sheet::{Layer, Sheet, Source};

/// A drawing in an animation, shown from koma `begin` until before koma `end`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Exposed {
    drawing: usize,
    begin: usize,
    end: usize,
    /// Koma on which the sheet shows the drawing.
    shows: usize,
}

/// All exposures of a layer.
pub(super) fn all(layer: &Layer) -> Vec<Exposed> {
    let shown = |(begin, exposure): (usize, genga::sheet::Exposure)| Exposed {
        drawing: exposure.drawing,
        begin,
        end: begin + exposure.koma,
        shows: begin,
    };
    layer.timed().map(shown).collect()
}

/// The exposures of key drawings and ends alone, each held until the next. The first kept one also covers the koma
/// before it.
pub(super) fn genga(layer: &Layer) -> Vec<Exposed> {
    let is_kept = |shown: &Exposed| layer.drawings[shown.drawing].role.is_kept();
    let mut kept: Vec<Exposed> = all(layer).into_iter().filter(is_kept).collect();
    for at in 0..kept.len() {
        kept[at].end = kept.get(at + 1).map_or(layer.length(), |next| next.begin);
    }
    if let Some(first) = kept.first_mut() {
        first.begin = 0;
    }
    kept
}

/// A joint's part of a pose, converted for glTF.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Local {
    translation: [f32; 3],
    rotation: [f32; 4],
}

/// The poses of a layer's drawings, and the joints that move in them.
pub(super) struct Poses<'a> {
    composite: &'a Composite<'a>,
    space: Space,
    /// Local transforms, drawing by drawing and joint by joint.
    locals: Vec<Local>,
    joints: usize,
    /// Joints whose translation differs from the rest pose in any drawing.
    translated: Vec<usize>,
    /// Joints whose rotation differs from the rest pose in any drawing.
    rotated: Vec<usize>,
    /// Joints that turn on every koma even while a drawing is held.
    steppers: Vec<usize>,
}

impl<'a> Poses<'a> {
    /// Computes the poses, equal to those of `limited.bvh`.
    pub(super) fn new(composite: &'a Composite<'a>, space: Space) -> Self {
        let joints = &composite.clip().skeleton().joints;
        let mut row = vec![0.0; composite.clip().skeleton().channels()];
        let mut rows = CompositeRows::new(composite);
        let first_koma = composite.first_koma();
        let mut locals = Vec::with_capacity(first_koma.len() * joints.len());
        for (drawing, koma) in first_koma.into_iter().enumerate() {
            rows.write(drawing, koma, &mut row);
            locals.extend(joints.iter().map(|joint| Local::new(joint, &row, space)));
        }
        let any = |joint: usize, leaves: &dyn Fn(&Local) -> bool| {
            locals[joint..].iter().step_by(joints.len()).any(leaves)
        };
        let is_translated = |joint: &usize| {
            let rest = floats(space.position(joints[*joint].offset));
            any(*joint, &|local| local.translation != rest)
        };
        // Tests x, y and z but not w: the cosine of a small angle rounds to 1.
        let is_rotated = |joint: &usize| any(*joint, &|local| local.rotation[..3] != [0.0; 3]);
        let mut translated: Vec<usize> = (0..joints.len()).filter(is_translated).collect();
        let mut rotated: Vec<usize> = (0..joints.len()).filter(is_rotated).collect();
        if translated.is_empty() && rotated.is_empty() {
            // A glTF animation needs at least one channel, so a body that never leaves its rest is held there.
            translated.push(0);
        }
        let steppers = composite.steppers();
        translated.retain(|joint| !composite.travellers().contains(joint));
        rotated.retain(|joint| !steppers.contains(joint));
        Self { composite, space, locals, joints: joints.len(), translated, rotated, steppers }
    }

    /// Writes an animation of some drawings of a layer of a sheet.
    pub(super) fn animation(
        &self,
        name: &str,
        shown: &[Exposed],
        (layer, sheet): (&Layer, &Sheet),
        step: Step,
        binary: &mut Binary,
    ) -> Value {
        let (koma_rate, blank, length) = (sheet.clock.koma_rate, sheet.blank, layer.length());
        let on_film = |(begin, end)| (blank.pose_begins(begin), blank.pose_ends(end, length));
        let holds = shown.iter().map(|shown| on_film((shown.begin, shown.end)));
        let times = step.times(holds, koma_rate);
        let times = binary.add_bounded(Use::Data, "SCALAR", &times);
        let held = Held { times, step };
        let mut tracks = Vec::new();
        for &joint in &self.translated {
            tracks.push(held.translation(joint, self.track(joint, shown), binary));
        }
        for &joint in &self.rotated {
            tracks.push(held.rotation(joint, self.track(joint, shown), binary));
        }
        if self.composite.slides() {
            let travellers = self.composite.travellers();
            let followed = [travellers, &self.steppers].concat();
            let locals = self.on_ones(&followed, shown);
            let koma = locals.len() / followed.len();
            let times = step.times((0..koma).map(|koma| on_film((koma, koma + 1))), koma_rate);
            let times = binary.add_bounded(Use::Data, "SCALAR", &times);
            let held = Held { times, step };
            let koma_by_koma = |at: usize| locals[at..].iter().step_by(followed.len()).copied();
            for (at, &joint) in travellers.iter().enumerate() {
                tracks.push(held.translation(joint, koma_by_koma(at), binary));
            }
            for (at, &joint) in (travellers.len()..).zip(&self.steppers) {
                tracks.push(held.rotation(joint, koma_by_koma(at), binary));
            }
        }
        let sampler = |track: &Track| json!({ "input": track.times, "interpolation": step.interpolation(), "output": track.values });
        let channel = |(sampler, track): (usize, &Track)| json!({ "sampler": sampler, "target": { "node": track.joint, "path": track.path } });
        json!({
            "name": name,
            "channels": tracks.iter().enumerate().map(channel).collect::<Vec<_>>(),
            "samplers": tracks.iter().map(sampler).collect::<Vec<_>>(),
            "extras": extras(shown, layer, sheet),
        })
    }

    /// The transforms of a joint through some drawings.
    fn track(&self, joint: usize, shown: &[Exposed]) -> impl Iterator<Item = Local> {
        shown.iter().map(move |shown| self.locals[shown.drawing * self.joints + joint])
    }

    /// The transforms of some joints on every koma, including koma on which a drawing is held.
    fn on_ones(&self, joints: &[usize], shown: &[Exposed]) -> Vec<Local> {
        let skeleton = self.composite.clip().skeleton();
        let mut row = vec![0.0; skeleton.channels()];
        let mut rows = CompositeRows::new(self.composite);
        let mut locals = Vec::new();
        for shown in shown {
            for koma in shown.begin..shown.end {
                rows.write(shown.drawing, koma, &mut row);
                let local = |joint: &usize| Local::new(&skeleton.joints[*joint], &row, self.space);
                locals.extend(joints.iter().map(local));
            }
        }
        locals
    }
}

/// A glTF animation channel of one joint, with the accessors of its times and values.
struct Track {
    joint: usize,
    path: &'static str,
    times: usize,
    values: usize,
}

/// The times of some holds, shared by the tracks that are written to them.
struct Held {
    times: usize,
    step: Step,
}

impl Held {
    fn translation(
        &self,
        joint: usize,
        locals: impl Iterator<Item = Local>,
        binary: &mut Binary,
    ) -> Track {
        let values = self.step.values(locals.map(|local| local.translation));
        let values = binary.add(Use::Data, "VEC3", &values);
        Track { joint, path: "translation", times: self.times, values }
    }

    fn rotation(
        &self,
        joint: usize,
        locals: impl Iterator<Item = Local>,
        binary: &mut Binary,
    ) -> Track {
        let values = self.step.values(continuous(locals.map(|local| local.rotation)));
        let values = binary.add(Use::Data, "VEC4", &values);
        Track { joint, path: "rotation", times: self.times, values }
    }
}

impl Local {
    fn new(joint: &Joint, row: &[f64], space: Space) -> Self {
        Self {
            translation: floats(space.position(local_translation(joint, row))),
            rotation: quaternion(space.rotation(local_rotation(joint, row))),
        }
    }
}

/// The drawings of an animation with their koma, under their numbers on paper. Koma and source frames count from 0, like
/// the times of the keys. `layer` is that of the sheet, where all rounds of a loop show the same drawings.
fn extras(shown: &[Exposed], layer: &Layer, sheet: &Sheet) -> Value {
    let (numbers, genga) = (layer.numbers(), layer.genga_numbers());
    let on_screen: Vec<usize> = layer.koma().collect();
    let key = |shown: &Exposed| {
        let index = on_screen[shown.shows];
        let drawing = &layer.drawings[index];
        let mut key = json!({
            "koma": sheet.blank.before + shown.begin,
            "length": shown.end - shown.begin,
            "drawing": numbers[index],
            "role": drawing.role.word(),
        });
        match drawing.source {
            Source::At(place) => key["frame"] = (place + 0.0).into(),
            Source::Between { from, to, share } => {
                key["between"] = json!([from + 0.0, to + 0.0]);
                key["share"] = (share + 0.0).into();
            }
        }
        if let Some(number) = &genga[index] {
            key["genga_no"] = json!(number);
        }
        key
    };
    json!({
        "fps": sheet.clock.koma_rate,
        "frame_base": 0,
        "koma": shown.last().map_or(0, |last| sheet.blank.pose_ends(last.end, layer.length())),
        "layer": layer.name,
        "keys": shown.iter().map(key).collect::<Vec<_>>(),
    })
}

/// Picks between q and −q, which are the same rotation, the one nearer to the key before. Otherwise a curve
/// interpolated through the keys would jump.
pub(crate) fn continuous(
    rotations: impl Iterator<Item = [f32; 4]>,
) -> impl Iterator<Item = [f32; 4]> {
    let mut before = [0.0, 0.0, 0.0, 1.0];
    let near = move |rotation: [f32; 4]| {
        let dot: f32 = rotation.iter().zip(before).map(|(a, b)| a * b).sum();
        before = if dot < 0.0 { rotation.map(|value| -value) } else { rotation };
        before
    };
    rotations.map(near)
}

pub(crate) fn quaternion(rotation: DQuat) -> [f32; 4] {
    rotation.normalize().to_array().map(|value| value as f32)
}
