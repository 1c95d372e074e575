//! Converts a document to a clip: chooses the joints and samples their transforms at each frame.

mod humanoid;
mod joints;

use glam::DAffine3;

use super::buffers::Buffers;
use super::camera::Cameras;
use super::curve::{Curve, Room};
use super::document::{Animation, Document, placed};
use super::kept::{Body, GltfScene, Played};
use super::wrong;
use crate::posed::{Bone, Posed, Stand};
use crate::rates;
use crate::reading::{Found, Given, Options, Read, Take};
use genga::error::{Error, Place, Warning};
use genga::motion::{Beside, CameraPath, Declared};
use genga::time::FrameRate;

/// The curves that move a node.
#[derive(Debug, Default)]
struct Moved {
    translation: Option<Curve>,
    rotation: Option<Curve>,
    scale: Option<Curve>,
}

/// The curves of an animation.
#[derive(Debug, Default)]
struct Motion {
    /// Curves of each node.
    nodes: Vec<Moved>,
}

/// Reads a glTF file.
pub(crate) fn read(given: &Given<'_>, options: &Options) -> Result<Read, Error> {
    let (document, chunk) = Document::read(given.bytes)?;
    let parents = document.parents()?;
    let mut buffers = Buffers::new(&document, given, options, chunk);
    let mut takes = Vec::with_capacity(document.animations.len());
    for at in 0..document.animations.len() {
        let motion = Motion::read(&document, &mut buffers, at, options)?;
        takes.push(motion.take(name_of(&document.animations[at], at)));
    }
    let Some((at, told)) = options.choose(&takes)? else {
        let message =
            "there is no animation: it is a model and no motion; export it with its animation";
        return Err(Error::Motion { place: Place::Whole, message: message.into() });
    };
    let motion = Motion::read(&document, &mut buffers, at, options)?;
    let times = motion.times();
    let name = &takes[at].name;
    let (near, far) = rates::cut(&times, Place::Whole, |at| format!("{} s", times[at]))
        .map_err(|error| of_take(error, at, name))?;
    let times = &times[..near];
    let of_keys = options.fps.or(rates::of_keys(times));
    let rate = of_keys.map_or_else(|| rates::otherwise(times), Ok)?;
    let [begin, end] = [times.first(), times.last()].map(|time| time.copied().unwrap_or_default());
    let frames = rates::frames(end - begin, rate);
    let called = humanoid::names(&document);
    let joints = joints::find(&document, &parents, &motion, &called);
    let order = joints::order(&document, &parents);
    let mut world = vec![DAffine3::IDENTITY; parents.len()];
    place(&order, &parents, &mut world, |node| document.nodes[node].local());
    let bone = |(node, parent): &(usize, Option<usize>)| {
        let name = called.get(node).cloned().or_else(|| document.nodes[*node].name.clone());
        Bone { name: name.unwrap_or_default(), parent: *parent, rest: Stand::new(&world[*node]) }
    };
    let bones = joints.iter().map(bone).collect();
    let (mut now, mut cameras) = (world.clone(), Cameras::new(&document));
    let stand = |frame: usize, stands: &mut [DAffine3]| {
        let time = begin + frame as f64 / rate.fps();
        place(&order, &parents, &mut now, |node| motion.local(&document, node, time, rate));
        stands.iter_mut().zip(&joints).for_each(|(stand, (node, _))| *stand = now[*node]);
        cameras.add(&now);
    };
    let posed = Posed::new(bones, frames, options, stand);
    let posed = posed.map_err(|error| of_take(error, at, name))?;
    let body = Body {
        joints: posed.joints().map(|bone| joints[bone].0).collect(),
        order: &order,
        parents: &parents,
        world: &world,
    };
    let played = Played { animation: at, begin, fps: rate.fps() };
    let kept = (given.bytes, &body, Room::new(options));
    let scene = GltfScene::new(&document, &mut buffers, kept, played)?;
    let (clip, named) = posed.clip(rate).map_err(|error| of_take(error, at, name))?;
    let clip = clip.with_declared(Declared::y_up(1.0));
    let finer = rates::finer(times, begin, rate).filter(|_| options.fps.is_none());
    let warnings: Vec<Warning> = told.into_iter().chain(named).chain(far).chain(finer).collect();
    let mut found = vec![
        Found::new("format", format(&document, given.bytes)),
        Found::new("up", "Y up"),
        Found::new("unit", "metres"),
    ];
    let why = if of_keys.is_some() { "" } else { ", its keys mean no usual rate" };
    found.push(Found::new("read", format!("animation {name}, sampled {rate} a second{why}")));
    if !called.is_empty() {
        let message = format!("joints called by their names of VRM: {}", called.len());
        found.push(Found::new("names", message));
    }
    let scene = scene.unwrap_or_default();
    found.extend(scene.found());
    if !scene.lost.is_empty() {
        found.push(Found::new("left out", format!("left out: {}", scene.lost.join(", "))));
    }
    let camera = cameras.path();
    let is_alone = camera.is_none() && scene == GltfScene::default();
    let clip = if is_alone { clip } else { clip.with_beside(Beside::new(camera).keep(scene)) };
    Ok(Read { clip, warnings, written_frame_time: None, found, takes })
}

/// Reads the way of the first camera that an animation moves, or of the first camera, over some frames of a clip at a
/// rate. The animation begins with the clip.
///
/// # Errors
/// Those of [`read`]; [`Error::Motion`] if there is no camera.
pub(crate) fn camera_path(
    given: &Given<'_>,
    options: &Options,
    (frames, rate): (usize, FrameRate),
) -> Result<CameraPath, Error> {
    let (document, chunk) = Document::read(given.bytes)?;
    let parents = document.parents()?;
    let order = joints::order(&document, &parents);
    let mut buffers = Buffers::new(&document, given, options, chunk);
    let mut world = vec![DAffine3::IDENTITY; parents.len()];
    let mut first = None;
    for at in 0..document.animations.len() {
        let motion = Motion::read(&document, &mut buffers, at, options)?;
        let begin = motion.times().first().copied().unwrap_or_default();
        let mut cameras = Cameras::new(&document);
        for frame in 0..frames {
            let time = begin + frame as f64 / rate.fps();
            place(&order, &parents, &mut world, |node| motion.local(&document, node, time, rate));
            cameras.add(&world);
        }
        match cameras.path() {
            Some(path) if path.moves() => return Ok(path),
            path => first = first.or(path),
        }
    }
    let message = "it has no camera with an animation; export one with it";
    first.ok_or_else(|| Error::Motion { place: Place::Whole, message: message.into() })
}

fn name_of(animation: &Animation, at: usize) -> String {
    let named = animation.name.clone().filter(|name| !name.trim().is_empty());
    named.unwrap_or_else(|| format!("animation {at}"))
}

/// Adds the name of the animation to an error of its motion.
fn of_take(error: Error, at: usize, name: &str) -> Error {
    match error {
        Error::Motion { place: Place::Whole, message } | Error::Clip { message } => {
            wrong(format!("animations[{at}], {name}"), message)
        }
        other => other,
    }
}

/// Computes the world transforms of all nodes; `order` has parents first.
fn place(
    order: &[usize],
    parents: &[Option<usize>],
    world: &mut [DAffine3],
    local: impl Fn(usize) -> DAffine3,
) {
    for &node in order {
        let own = local(node);
        world[node] = parents[node].map_or(own, |parent| world[parent] * own);
    }
}

fn format(document: &Document, bytes: &[u8]) -> String {
    let has = |name: &str| document.extensions.contains_key(name);
    let kind = match bytes.starts_with(b"glTF") {
        _ if has("VRMC_vrm_animation") => "VRM animation",
        _ if has("VRMC_vrm") => "VRM 1.0",
        _ if has("VRM") => "VRM 0",
        true => "GLB",
        false => "glTF",
    };
    match document.asset.generator.trim() {
        "" => format!("{kind}, glTF {}", document.asset.version),
        by => format!("{kind}, glTF {}, by {by}", document.asset.version),
    }
}

impl Motion {
    fn read(
        document: &Document,
        buffers: &mut Buffers<'_>,
        at: usize,
        options: &Options,
    ) -> Result<Self, Error> {
        let animation = &document.animations[at];
        let mut motion = Self::default();
        motion.nodes.resize_with(document.nodes.len(), Moved::default);
        let mut room = Room::new(options);
        for (channel_at, channel) in animation.channels.iter().enumerate() {
            let part = format!("animations[{at}].channels[{channel_at}]");
            let Some(node) = channel.target.node else { continue };
            let Some(moved) = motion.nodes.get_mut(node) else {
                return Err(wrong(part, format!("there is no node {node}")));
            };
            let (place, width) = match channel.target.path.as_str() {
                "translation" => (&mut moved.translation, 3),
                "rotation" => (&mut moved.rotation, 4),
                "scale" => (&mut moved.scale, 3),
                _ => continue,
            };
            let Some(sampler) = animation.samplers.get(channel.sampler) else {
                return Err(wrong(part, format!("there is no sampler {}", channel.sampler)));
            };
            let sampler_part = format!("animations[{at}].samplers[{}]", channel.sampler);
            let curve = Curve::read(document, buffers, sampler, Some(width), &sampler_part)?;
            room.take(&curve, &part)?;
            *place = Some(curve);
        }
        Ok(motion)
    }

    fn curves(&self) -> impl Iterator<Item = &Curve> {
        self.nodes.iter().flat_map(Moved::curves)
    }

    /// Times of the keys, sorted and unique.
    fn times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.curves().flat_map(Curve::times).copied().collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    fn take(&self, name: String) -> Take {
        let ends = |curve: &Curve| (curve.times()[0], curve.times()[curve.times().len() - 1]);
        let span = self.curves().map(ends).reduce(|all, own| (all.0.min(own.0), all.1.max(own.1)));
        let seconds = span.map_or(0.0, |(begin, end)| end - begin);
        Take { name, seconds, moves: self.curves().any(Curve::moves) }
    }

    /// The local transform of a node at an instant.
    fn local(&self, document: &Document, node: usize, time: f64, rate: FrameRate) -> DAffine3 {
        let (moved, node) = (&self.nodes[node], &document.nodes[node]);
        if !moved.is_moved() {
            return node.local();
        }
        let (translation, rotation, scale) = node.parts();
        let fps = rate.fps();
        placed(
            Some(moved.translation.as_ref().map_or(translation, |curve| curve.at(time, fps))),
            Some(moved.rotation.as_ref().map_or(rotation, |curve| curve.at(time, fps))),
            Some(moved.scale.as_ref().map_or(scale, |curve| curve.at(time, fps))),
        )
    }
}

impl Moved {
    fn curves(&self) -> impl Iterator<Item = &Curve> {
        [&self.translation, &self.rotation, &self.scale].into_iter().flatten()
    }

    fn is_moved(&self) -> bool {
        self.curves().next().is_some()
    }

    /// Whether its curves vary over time.
    fn moves(&self) -> bool {
        self.curves().any(Curve::moves)
    }
}
