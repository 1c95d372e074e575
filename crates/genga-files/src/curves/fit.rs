//! Keys are added to the genga until the curves are close to the take.

use std::ops::RangeInclusive;

use glam::DQuat;
use rayon::prelude::*;

use super::samples::{Path, Take};
use super::spline::{Shape, Span, Tangents};
use genga::error::Error;
use genga::motion::{Body, Clip, Pose, Poser, Stature, layer_of};
use genga::sheet::{Layer, Sheet};
use genga::time::Frame;

/// Distance from a joint to the skin about it, as a share of body height. A joint that only turns about its bone moves
/// its skin, which the positions of joints do not show.
pub(crate) const GIRTH: f64 = 0.05;

/// Part of the allowed error that a straight track may use up. Errors of several joints add up along a limb.
const STRAIGHT: f64 = 0.1;

/// A key of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Key {
    /// Its place in the source, as a fractional frame number.
    pub(crate) place: f64,
    /// Index of its genga among the layer's drawings; `None` for an added key.
    pub(crate) drawing: Option<usize>,
}

/// A channel of a joint as a curve.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    pub(crate) joint: usize,
    pub(crate) path: Path,
    /// The layer whose keys it has.
    pub(crate) layer: usize,
    pub(crate) shape: Shape,
}

/// A take as keys with curves between them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct KeyedTake {
    /// Keys of each layer, in order of time, two or more.
    pub(crate) layers: Vec<Vec<Key>>,
    /// The curves, joint by joint. A channel that is at rest throughout has none.
    pub(crate) tracks: Vec<Track>,
    /// Body height, in the file's unit.
    pub(crate) height: f64,
    /// Largest distance from the take with the genga alone, as a share of body height.
    pub(crate) error_of_genga: f64,
    /// Largest distance from the take.
    pub(crate) largest: f64,
    /// Mean distance from the take over all joints and frames.
    pub(crate) mean: f64,
}

impl KeyedTake {
    /// Finds keys and curves that are off the take by `error` of body height at the most.
    pub(super) fn new(clip: &Clip, sheet: &Sheet, error: f64) -> Result<Self, Error> {
        let layer_of = layer_of(clip.skeleton(), sheet)?;
        let mut layers: Vec<Vec<Key>> =
            sheet.layers.iter().map(|layer| keys_of(layer, clip)).collect();
        let (first, last) = ends(&layers)?;
        layers.iter_mut().for_each(|keys| span_all(keys, first, last));
        let take = Take::new(clip, first.floor() as usize, last.ceil() as usize);
        let ruler = Ruler::new(clip, &layer_of, first..=last);
        let straight = straight(&take, &layers, &layer_of, &ruler, STRAIGHT * error);
        let mut error_of_genga = None;
        loop {
            let tracks = curves(&take, &layers, &layer_of, &straight);
            let errors = ruler.measure(clip, &layers, &tracks);
            let largest = errors.largest();
            let error_of_genga = *error_of_genga.get_or_insert(largest);
            if !errors.add_keys(&mut layers, error) {
                let mean = errors.mean();
                let height = ruler.height;
                return Ok(Self { layers, tracks, height, error_of_genga, largest, mean });
            }
        }
    }

    /// Goes straight between keys on some frames, two or more in order of time.
    pub(super) fn from_lines(clip: &Clip, frames: &[Frame]) -> Self {
        let key = |frame: &Frame| Key { place: frame.0 as f64, drawing: None };
        let layers = vec![frames.iter().map(key).collect::<Vec<_>>()];
        let layer_of = vec![0; clip.skeleton().len()];
        let (first, last) = (frames[0], frames[frames.len() - 1]);
        let take = Take::new(clip, first.0, last.0);
        let ruler = Ruler::new(clip, &layer_of, first.0 as f64..=last.0 as f64);
        let tracks = curves(&take, &layers, &layer_of, &vec![true; take.tracks().count()]);
        let errors = ruler.measure(clip, &layers, &tracks);
        let (largest, mean) = (errors.largest(), errors.mean());
        Self { layers, tracks, height: ruler.height, error_of_genga: largest, largest, mean }
    }

    /// Number of keys on all layers.
    pub(crate) fn keys(&self) -> usize {
        self.layers.iter().map(Vec::len).sum()
    }

    /// Number of keys that are no genga of the sheet.
    pub(crate) fn added(&self) -> usize {
        self.layers.iter().flatten().filter(|key| key.drawing.is_none()).count()
    }
}

/// Returns the genga that a layer shows, each once, in order of time.
pub(crate) fn keys_of(layer: &Layer, clip: &Clip) -> Vec<Key> {
    let mut is_shown = vec![false; layer.drawings.len()];
    layer.exposures.iter().for_each(|exposure| is_shown[exposure.drawing] = true);
    let drawings = layer.drawings.iter().enumerate();
    let kept = drawings.filter(|(at, drawing)| is_shown[*at] && drawing.role.is_kept());
    let (first, last) = (clip.first().0 as f64, clip.last().0 as f64);
    let place = |place: f64| place.clamp(first, last);
    let key = |(at, drawing): (usize, &genga::sheet::Drawing)| Key {
        place: place(drawing.source.place()),
        drawing: Some(at),
    };
    let mut keys: Vec<Key> = kept.map(key).collect();
    keys.sort_by(|a, b| a.place.total_cmp(&b.place));
    keys.dedup_by(|later, earlier| later.place == earlier.place);
    keys
}

/// Returns the first and the last place that is a key on any layer.
fn ends(layers: &[Vec<Key>]) -> Result<(f64, f64), Error> {
    let places = || layers.iter().flatten().map(|key| key.place);
    let (first, last) =
        (places().fold(f64::INFINITY, f64::min), places().fold(f64::NEG_INFINITY, f64::max));
    if first < last {
        return Ok((first, last));
    }
    Err(Error::sheet(super::TOO_FEW))
}

/// Adds keys at the ends where a layer has none.
fn span_all(keys: &mut Vec<Key>, first: f64, last: f64) {
    if keys.first().is_none_or(|key| key.place > first) {
        keys.insert(0, Key { place: first, drawing: None });
    }
    if keys.last().is_none_or(|key| key.place < last) {
        keys.push(Key { place: last, drawing: None });
    }
}

fn places(keys: &[Key]) -> Vec<f64> {
    keys.iter().map(|key| key.place).collect()
}

/// Finds the tracks that may go straight from key to key: `error` is their share of the whole error. With more keys,
/// they only come closer.
fn straight(
    take: &Take,
    layers: &[Vec<Key>],
    layer_of: &[usize],
    ruler: &Ruler,
    error: f64,
) -> Vec<bool> {
    let places: Vec<Vec<f64>> = layers.iter().map(|keys| places(keys)).collect();
    let is_straight = |(joint, path): (usize, Path)| {
        let (keys, samples) = (&places[layer_of[joint]], take.samples(joint, path));
        let line = Shape::Linear(keys.iter().map(|key| samples.at(*key)).collect());
        ruler.frames().all(|frame| {
            let (span, found) = (Span::new(keys, frame as f64), samples.at(frame as f64));
            let off = match path {
                Path::Translation => line.value(span).distance(found),
                Path::Rotation => {
                    let turn = turn_between(line.rotation(span), DQuat::from_vec4(found));
                    turn * (ruler.reaches[joint] + ruler.girth)
                }
            };
            off <= error * ruler.height
        })
    };
    take.tracks().map(is_straight).collect()
}

/// Puts a curve through the keys of every track that moves.
fn curves(take: &Take, layers: &[Vec<Key>], layer_of: &[usize], straight: &[bool]) -> Vec<Track> {
    let places: Vec<Vec<f64>> = layers.iter().map(|keys| places(keys)).collect();
    let tangents: Vec<Tangents<'_>> = places.iter().map(|keys| Tangents::new(keys)).collect();
    let tracks = take.tracks().zip(straight).map(|((joint, path), is_straight)| {
        let (layer, samples) = (layer_of[joint], take.samples(joint, path));
        let values = || places[layer].iter().map(|key| samples.at(*key)).collect::<Vec<_>>();
        let shape = if samples.is_constant() {
            Shape::Constant(samples.first_value())
        } else if *is_straight {
            Shape::Linear(values())
        } else {
            let values = values();
            Shape::Cubic { tangents: tangents[layer].solve(samples, &values), values }
        };
        Track { joint, path, layer, shape }
    });
    tracks.collect()
}

/// Measures how far a body is off the take.
pub(super) struct Ruler {
    /// Body height, in the file's unit.
    pub(super) height: f64,
    girth: f64,
    reaches: Vec<f64>,
    /// The joint of each tip.
    tips: Vec<usize>,
    /// Layers that move each joint, those of its ancestors included.
    moved_by: Vec<Vec<usize>>,
    /// Whole frames from the first key to the last.
    frames: RangeInclusive<usize>,
}

impl Ruler {
    pub(super) fn new(clip: &Clip, layer_of: &[usize], places: RangeInclusive<f64>) -> Self {
        let skeleton = clip.skeleton();
        let mut moved_by: Vec<Vec<usize>> = Vec::with_capacity(skeleton.len());
        for (joint, data) in skeleton.iter() {
            let mut layers = data.parent.map_or_else(Vec::new, |parent| moved_by[parent.0].clone());
            if !layers.contains(&layer_of[joint.0]) {
                layers.push(layer_of[joint.0]);
            }
            moved_by.push(layers);
        }
        let tips =
            skeleton.iter().flat_map(|(joint, data)| data.end_sites.iter().map(move |_| joint.0));
        let reaches = skeleton.reaches();
        let height = body_height(clip, &reaches);
        Self {
            height,
            girth: GIRTH * height,
            reaches,
            tips: tips.collect(),
            moved_by,
            frames: places.start().ceil() as usize..=places.end().floor() as usize,
        }
    }

    fn frames(&self) -> RangeInclusive<usize> {
        self.frames.clone()
    }

    /// Measures every frame.
    fn measure(&self, clip: &Clip, layers: &[Vec<Key>], tracks: &[Track]) -> Errors {
        let places: Vec<Vec<f64>> = layers.iter().map(|keys| places(keys)).collect();
        let (first, columns) = (*self.frames.start(), layers.len() + 1);
        let mut values = vec![0.0; columns * self.frames().count()];
        values.par_chunks_mut(columns).enumerate().for_each_init(
            || Bodies::new(clip),
            |bodies, (at, errors)| {
                bodies.place(Frame(first + at), &places, tracks);
                let (mean, by_layer) = errors.split_last_mut().expect("the mean is there");
                *mean = bodies.compare(self, by_layer);
            },
        );
        values.iter_mut().for_each(|value| *value /= self.height);
        Errors { first, columns, values }
    }
}

/// Returns the height of a body; of a thing without one its longest chain of bones, and of a point the file's unit.
pub(crate) fn body_height(clip: &Clip, reaches: &[f64]) -> f64 {
    let longest = reaches.iter().copied().fold(0.0, f64::max);
    let sizes = [Stature::new(clip).size, longest];
    sizes.into_iter().find(|size| *size > 0.0).unwrap_or(1.0)
}

/// Returns nearly the angle between two rotations, in radians: twice the distance of their quaternions.
pub(crate) fn turn_between(a: DQuat, b: DQuat) -> f64 {
    2.0 * (a - b).length().min((a + b).length())
}

/// The bodies of the take and of the curves on one frame.
pub(super) struct Bodies<'a> {
    poser: Poser<'a>,
    pose: Pose,
    taken: Body,
    made: Body,
    spans: Vec<Span>,
}

impl<'a> Bodies<'a> {
    pub(super) fn new(clip: &'a Clip) -> Self {
        let body = Body::new(clip.skeleton());
        let pose = Pose::rest(clip.skeleton());
        Self { poser: Poser::new(clip), pose, taken: body.clone(), made: body, spans: Vec::new() }
    }

    /// Places both on a frame.
    fn place(&mut self, frame: Frame, layers: &[Vec<f64>], tracks: &[Track]) {
        self.spans.clear();
        self.spans.extend(layers.iter().map(|keys| Span::new(keys, frame.0 as f64)));
        self.taken.place(self.poser.frame(frame));
        for Track { joint, path, layer, shape } in tracks {
            let span = self.spans[*layer];
            match path {
                Path::Rotation => self.pose.rotations[*joint] = shape.rotation(span),
                Path::Translation => {
                    self.pose.translations[*joint] = shape.value(span).truncate();
                }
            }
        }
        self.made.place(&self.pose);
    }

    /// Places the take on a frame, and the other body in a pose.
    pub(super) fn place_beside(&mut self, frame: Frame, pose: &Pose) {
        self.taken.place(self.poser.frame(frame));
        self.made.place(pose);
    }

    /// Returns the mean distance of the joints, and raises the largest of each layer.
    pub(super) fn compare(&self, ruler: &Ruler, by_layer: &mut [f64]) -> f64 {
        let points = self.taken.points().iter().zip(self.made.points());
        let off = points.map(|(taken, made)| taken.distance(*made));
        let turns = self.taken.rotations().iter().zip(self.made.rotations());
        let skin = turns.map(|(taken, made)| ruler.girth * turn_between(*taken, *made));
        let skin = skin.chain(std::iter::repeat(0.0));
        let joints = (0..ruler.moved_by.len()).chain(ruler.tips.iter().copied());
        let (mut sum, mut count) = (0.0, 0);
        for ((joint, off), skin) in joints.zip(off).zip(skin) {
            for &layer in &ruler.moved_by[joint] {
                by_layer[layer] = f64::max(by_layer[layer], off + skin);
            }
            sum += off;
            count += 1;
        }
        sum / count as f64
    }
}

/// Distances from the take on each frame, as shares of body height: the largest of each layer, then the mean.
struct Errors {
    first: usize,
    columns: usize,
    values: Vec<f64>,
}

impl Errors {
    fn rows(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.values.chunks_exact(self.columns)
    }

    fn largest(&self) -> f64 {
        let layers = self.rows().flat_map(|row| &row[..self.columns - 1]);
        layers.copied().fold(0.0, f64::max)
    }

    fn mean(&self) -> f64 {
        let frames = self.rows().len();
        self.rows().map(|row| row[self.columns - 1]).sum::<f64>() / frames.max(1) as f64
    }

    /// Adds a key in each span whose error is too large, at the worst frame. Returns whether there was any.
    fn add_keys(&self, layers: &mut [Vec<Key>], error: f64) -> bool {
        let mut any = false;
        for (layer, keys) in layers.iter_mut().enumerate() {
            let worst = self.worst(layer, &places(keys), error);
            any |= !worst.is_empty();
            keys.extend(worst.into_iter().map(|place| Key { place, drawing: None }));
            keys.sort_by(|a, b| a.place.total_cmp(&b.place));
        }
        any
    }

    /// Returns the worst frame of each span of a layer whose error is too large.
    fn worst(&self, layer: usize, keys: &[f64], error: f64) -> Vec<f64> {
        let mut worst = vec![(error, None); keys.len()];
        for (at, row) in self.rows().enumerate() {
            let place = (self.first + at) as f64;
            let span = Span::new(keys, place).key();
            let is_key = keys[span] == place || keys[span + 1] == place;
            if row[layer] > worst[span].0 && !is_key {
                worst[span] = (row[layer], Some(place));
            }
        }
        worst.into_iter().filter_map(|(_, place)| place).collect()
    }
}
