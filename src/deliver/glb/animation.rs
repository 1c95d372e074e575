//! The poses of a sheet as channels that hold each of them.

use glam::DQuat;
use serde_json::{Value, json};

use super::binary::{Binary, Use};
use super::bones::floats;
use super::{Space, Step};
use crate::motion::{Composite, CompositeRows, Joint, local_rotation, local_translation};
use crate::sheet::{Layer, Source};

/// A drawing that an animation shows, and from which koma until before which.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Exposed {
    drawing: usize,
    begin: usize,
    end: usize,
}

/// Every exposure of a layer.
pub(super) fn all(layer: &Layer) -> Vec<Exposed> {
    let shown = |(begin, exposure): (usize, crate::sheet::Exposure)| Exposed {
        drawing: exposure.drawing,
        begin,
        end: begin + exposure.koma,
    };
    layer.timed().map(shown).collect()
}

/// The exposures of key drawings and ends alone, each held until the next. What a sheet shows before
/// its first key is that key.
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

/// One joint's part of a pose, ready to be written.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Local {
    translation: [f32; 3],
    rotation: [f32; 4],
}

/// The pose of every drawing of a layer, and which parts of it move.
pub(super) struct Poses<'a> {
    composite: &'a Composite<'a>,
    space: Space,
    /// Drawing by drawing, joint by joint.
    locals: Vec<Local>,
    joints: usize,
    /// Joints whose translation leaves the rest pose in any drawing.
    translated: Vec<usize>,
    /// The same of rotations.
    rotated: Vec<usize>,
    /// Joints that turn on every koma whatever is held.
    steppers: Vec<usize>,
}

impl<'a> Poses<'a> {
    /// The poses as `limited.bvh` has them.
    pub(super) fn of(composite: &'a Composite<'a>, space: Space) -> Self {
        let joints = &composite.clip().skeleton().joints;
        let mut row = vec![0.0; composite.clip().skeleton().channels()];
        let mut rows = CompositeRows::of(composite);
        let first_koma = composite.first_koma();
        let mut locals = Vec::with_capacity(first_koma.len() * joints.len());
        for (drawing, koma) in first_koma.into_iter().enumerate() {
            rows.write(drawing, koma, &mut row);
            locals.extend(joints.iter().map(|joint| Local::of(joint, &row, space)));
        }
        let any = |joint: usize, leaves: &dyn Fn(&Local) -> bool| {
            locals[joint..].iter().step_by(joints.len()).any(leaves)
        };
        let is_translated = |joint: &usize| {
            let rest = floats(space.position(joints[*joint].offset));
            any(*joint, &|local| local.translation != rest)
        };
        // Not by the last value: the cosine of a small angle is 1.
        let is_rotated = |joint: &usize| any(*joint, &|local| local.rotation[..3] != [0.0; 3]);
        let mut translated: Vec<usize> = (0..joints.len()).filter(is_translated).collect();
        let mut rotated: Vec<usize> = (0..joints.len()).filter(is_rotated).collect();
        if translated.is_empty() && rotated.is_empty() {
            // glTF has no animation without a channel: a body that stays at rest is held there.
            translated.push(0);
        }
        let steppers = composite.steppers();
        translated.retain(|joint| !composite.travellers().contains(joint));
        rotated.retain(|joint| !steppers.contains(joint));
        Self { composite, space, locals, joints: joints.len(), translated, rotated, steppers }
    }

    /// An animation of some drawings of a layer at its rate.
    pub(super) fn animation(
        &self,
        name: &str,
        shown: &[Exposed],
        (layer, koma_rate): (&Layer, f64),
        step: Step,
        binary: &mut Binary,
    ) -> Value {
        let times = step.times(shown.iter().map(|shown| (shown.begin, shown.end)), koma_rate);
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
            let times = step.times((0..koma).map(|koma| (koma, koma + 1)), koma_rate);
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
            "extras": extras(shown, layer, koma_rate),
        })
    }

    /// A joint through some drawings.
    fn track(&self, joint: usize, shown: &[Exposed]) -> impl Iterator<Item = Local> {
        shown.iter().map(move |shown| self.locals[shown.drawing * self.joints + joint])
    }

    /// Some joints koma by koma in an animation of some drawings: what goes on while they are held.
    fn on_ones(&self, joints: &[usize], shown: &[Exposed]) -> Vec<Local> {
        let skeleton = self.composite.clip().skeleton();
        let mut row = vec![0.0; skeleton.channels()];
        let mut rows = CompositeRows::of(self.composite);
        let mut locals = Vec::new();
        for shown in shown {
            for koma in shown.begin..shown.end {
                rows.write(shown.drawing, koma, &mut row);
                let local = |joint: &usize| Local::of(&skeleton.joints[*joint], &row, self.space);
                locals.extend(joints.iter().map(local));
            }
        }
        locals
    }
}

/// What a joint does: accessors of its times and of its values.
struct Track {
    joint: usize,
    path: &'static str,
    times: usize,
    values: usize,
}

/// Holds at some times, to which tracks are written.
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
    fn of(joint: &Joint, row: &[f64], space: Space) -> Self {
        Self {
            translation: floats(space.position(local_translation(joint, row))),
            rotation: quaternion(space.rotation(local_rotation(joint, row))),
        }
    }
}

/// What stands on which koma, in the words of `sheet.json`: koma, drawings and source frames from 0.
/// `genga_no` alone counts from 1, as it stands in a circle on paper.
fn extras(shown: &[Exposed], layer: &Layer, koma_rate: f64) -> Value {
    let genga = layer.genga_numbers();
    let key = |shown: &Exposed| {
        let drawing = &layer.drawings[shown.drawing];
        let mut key = json!({
            "koma": shown.begin,
            "length": shown.end - shown.begin,
            "drawing": shown.drawing,
            "role": drawing.role.word(),
        });
        match drawing.source {
            Source::At(place) => key["frame"] = (place + 0.0).into(),
            Source::Between { from, to, share } => {
                key["between"] = json!([from + 0.0, to + 0.0]);
                key["share"] = (share + 0.0).into();
            }
        }
        if let Some(number) = genga[shown.drawing] {
            key["genga_no"] = number.into();
        }
        key
    };
    json!({
        "fps": koma_rate,
        "frame_base": 0,
        "koma": shown.last().map_or(0, |last| last.end),
        "layer": layer.name,
        "keys": shown.iter().map(key).collect::<Vec<_>>(),
    })
}

/// Of q and −q, which are one rotation, the one nearer to the key before, so that a curve drawn through
/// them does not jump.
pub(in crate::deliver) fn continuous(
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

pub(in crate::deliver) fn quaternion(rotation: DQuat) -> [f32; 4] {
    rotation.normalize().to_array().map(|value| value as f32)
}
