//! The poses of a sheet as stepped channels.

use glam::DQuat;
use serde_json::{Value, json};

use super::Space;
use super::binary::{Binary, Use};
use super::bones::floats;
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

    /// An animation of some drawings, with a key at the end of the last: without it the last drawing
    /// would last no time and a player would begin again at once.
    pub(super) fn animation(
        &self,
        name: &str,
        shown: &[Exposed],
        layer: &Layer,
        koma_rate: f64,
        binary: &mut Binary,
    ) -> Value {
        let closing = shown.last().into_iter();
        let times = shown.iter().map(|shown| shown.begin).chain(closing.map(|last| last.end));
        let second = |koma: usize| [(koma as f64 / koma_rate) as f32];
        let times: Vec<[f32; 1]> = times.map(second).collect();
        let times = binary.add_bounded(Use::Data, "SCALAR", &times);
        let mut tracks = Vec::new();
        for &joint in &self.translated {
            let values: Vec<_> = self.track(joint, shown).map(|local| local.translation).collect();
            tracks.push((joint, "translation", times, binary.add(Use::Data, "VEC3", &values)));
        }
        for &joint in &self.rotated {
            let values = continuous(self.track(joint, shown).map(|local| local.rotation));
            tracks.push((joint, "rotation", times, binary.add(Use::Data, "VEC4", &values)));
        }
        if self.composite.slides() {
            let travellers = self.composite.travellers();
            let followed = [travellers, &self.steppers].concat();
            let locals = self.on_ones(&followed, shown);
            let times: Vec<[f32; 1]> = (0..locals.len() / followed.len()).map(second).collect();
            let times = binary.add_bounded(Use::Data, "SCALAR", &times);
            let koma_by_koma = |at: usize| locals[at..].iter().step_by(followed.len()).copied();
            for (at, &joint) in travellers.iter().enumerate() {
                let values: Vec<_> = koma_by_koma(at).map(|local| local.translation).collect();
                tracks.push((joint, "translation", times, binary.add(Use::Data, "VEC3", &values)));
            }
            for (at, &joint) in (travellers.len()..).zip(&self.steppers) {
                let values = continuous(koma_by_koma(at).map(|local| local.rotation));
                tracks.push((joint, "rotation", times, binary.add(Use::Data, "VEC4", &values)));
            }
        }
        type Track = (usize, &'static str, usize, usize);
        let sampler = |(_, _, times, values): &Track| json!({ "input": times, "interpolation": "STEP", "output": values });
        let channel = |(sampler, (node, path, ..)): (usize, &Track)| json!({ "sampler": sampler, "target": { "node": node, "path": path } });
        json!({
            "name": name,
            "channels": tracks.iter().enumerate().map(channel).collect::<Vec<_>>(),
            "samplers": tracks.iter().map(sampler).collect::<Vec<_>>(),
            "extras": extras(shown, layer, koma_rate),
        })
    }

    /// A joint through some drawings, the last once more.
    fn track(&self, joint: usize, shown: &[Exposed]) -> impl Iterator<Item = Local> {
        let drawings = shown.iter().chain(shown.last()).map(|shown| shown.drawing);
        drawings.map(move |drawing| self.locals[drawing * self.joints + joint])
    }

    /// Some joints koma by koma in an animation of some drawings, the last koma once more: what goes on while
    /// they are held.
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
        locals.extend_from_within(locals.len().saturating_sub(joints.len())..);
        locals
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
fn continuous(rotations: impl Iterator<Item = [f32; 4]>) -> Vec<[f32; 4]> {
    let mut before = [0.0, 0.0, 0.0, 1.0];
    let near = |rotation: [f32; 4]| {
        let dot: f32 = rotation.iter().zip(before).map(|(a, b)| a * b).sum();
        before = if dot < 0.0 { rotation.map(|value| -value) } else { rotation };
        before
    };
    rotations.map(near).collect()
}

fn quaternion(rotation: DQuat) -> [f32; 4] {
    rotation.normalize().to_array().map(|value| value as f32)
}
