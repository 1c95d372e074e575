//! Keys with curves between them as a glTF animation.

use glam::{DQuat, DVec3, DVec4};
use serde_json::{Value, json};

use super::Space;
use super::binary::{Binary, Use};
use super::bones::floats;
use crate::curves::{Curves, KeyedTake, Path, Shape, Track};
use genga::motion::Clip;
use genga::sheet::{Layer, Sheet};

/// Writes the animation. Seconds count from the first key.
pub(super) fn animation(
    clip: &Clip,
    sheet: &Sheet,
    keyed: &KeyedTake,
    (space, settings): (Space, &Curves),
    binary: &mut Binary,
) -> Value {
    let fps = clip.rate().fps();
    let seconds: Vec<Vec<f64>> = seconds(keyed, fps);
    let inputs: Vec<usize> = seconds
        .iter()
        .map(|keys| {
            let keys: Vec<[f32; 1]> = keys.iter().map(|second| [*second as f32]).collect();
            binary.add_bounded(Use::Data, "SCALAR", &keys)
        })
        .collect();
    let (mut channels, mut samplers) = (Vec::new(), Vec::new());
    let mut still = None;
    let is_moving = |track: &&Track| {
        let offset = clip.skeleton().joints[track.joint].offset;
        match (&track.shape, track.path) {
            (Shape::Constant(value), Path::Translation) => value.truncate() != offset,
            (Shape::Constant(value), Path::Rotation) => value.truncate() != DVec3::ZERO,
            _ => true,
        }
    };
    // A glTF animation needs a channel: a body that never leaves its rest is held there.
    let moving = keyed.tracks.iter().filter(is_moving);
    let tracks: Vec<&Track> = match moving.collect::<Vec<_>>() {
        none if none.is_empty() => keyed.tracks.iter().skip(1).take(1).collect(),
        some => some,
    };
    for track in tracks {
        let input = match track.shape {
            Shape::Constant(_) => *still.get_or_insert_with(|| {
                let ends = [0.0, seconds[0][seconds[0].len() - 1] as f32].map(|second| [second]);
                binary.add_bounded(Use::Data, "SCALAR", &ends)
            }),
            _ => inputs[track.layer],
        };
        let output = output(track, space, fps, binary);
        let path = match track.path {
            Path::Rotation => "rotation",
            Path::Translation => "translation",
        };
        channels.push(json!({
            "sampler": samplers.len(),
            "target": { "node": track.joint, "path": path },
        }));
        samplers.push(json!({
            "input": input,
            "interpolation": if matches!(track.shape, Shape::Cubic { .. }) { "CUBICSPLINE" } else { "LINEAR" },
            "output": output,
        }));
    }
    json!({
        "name": "keys",
        "channels": channels,
        "samplers": samplers,
        "extras": extras(sheet, keyed, &seconds, (fps, space, settings)),
    })
}

/// Seconds of the keys of each layer.
fn seconds(keyed: &KeyedTake, fps: f64) -> Vec<Vec<f64>> {
    let first = keyed.layers[0][0].place;
    let second = |place: f64| (place - first) / fps;
    keyed.layers.iter().map(|keys| keys.iter().map(|key| second(key.place)).collect()).collect()
}

/// Writes the values of a track; of a cubic one each between its two tangents, which are equal: the curve is smooth.
fn output(track: &Track, space: Space, fps: f64, binary: &mut Binary) -> usize {
    let turned = |value: DVec4| match track.path {
        Path::Rotation => DVec4::from(space.rotation(DQuat::from_vec4(value))),
        Path::Translation => space.position(value.truncate()).extend(0.0),
    };
    let values: Vec<DVec4> = match &track.shape {
        Shape::Constant(value) => vec![turned(*value); 2],
        Shape::Linear(values) => values.iter().map(|value| turned(*value)).collect(),
        Shape::Cubic { values, tangents } => {
            let tangent = |tangent: &DVec4| turned(*tangent) * fps;
            let keys = values.iter().zip(tangents);
            keys.flat_map(|(value, slope)| [tangent(slope), turned(*value), tangent(slope)])
                .collect()
        }
    };
    match track.path {
        Path::Rotation => {
            let values: Vec<[f32; 4]> =
                values.iter().map(|value| value.to_array().map(|value| value as f32)).collect();
            binary.add(Use::Data, "VEC4", &values)
        }
        Path::Translation => {
            let values: Vec<[f32; 3]> =
                values.iter().map(|value| floats(value.truncate())).collect();
            binary.add(Use::Data, "VEC3", &values)
        }
    }
}

/// Describes the keys of every layer: which of them are genga, and how close the curves are.
fn extras(
    sheet: &Sheet,
    keyed: &KeyedTake,
    seconds: &[Vec<f64>],
    (fps, space, settings): (f64, Space, &Curves),
) -> Value {
    let layer = |((layer, keys), seconds): ((&Layer, _), &Vec<f64>)| {
        let keys: &Vec<crate::curves::Key> = keys;
        let genga = layer.genga_numbers();
        let keys = keys.iter().zip(seconds).map(|(key, second)| {
            let role = key.drawing.map_or("added", |at| layer.drawings[at].role.word());
            let mut entry = json!({ "time": second, "frame": key.place, "role": role });
            if let Some(number) = key.drawing.and_then(|at| genga[at].as_ref()) {
                entry["genga_no"] = json!(number);
            }
            entry
        });
        json!({ "layer": layer.name, "keys": keys.collect::<Vec<_>>() })
    };
    let layers = sheet.layers.iter().zip(&keyed.layers).zip(seconds).map(layer);
    json!({
        "fps": fps,
        "frame_base": 0,
        "height": keyed.height * space.scale,
        "error": { "asked": settings.error, "largest": keyed.largest, "mean": keyed.mean },
        "layers": layers.collect::<Vec<_>>(),
    })
}
