//! Composites the cels of a sheet (合成) into one body: each joint takes the pose of its own layer's drawing.

mod feet;
mod flat;
mod poser;
mod rows;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;

use crate::error::{Error, did_you_mean};
use crate::motion::{Channel, Clip, Skeleton};
use crate::sheet::{Drawing, Feet, Layer, RootMotion, Sheet, Source};
use crate::time::Clock;

use feet::{FootHold, HeldFeet};
pub use poser::CompositePoser;
pub use rows::CompositeRows;

/// The composited cels of a sheet, without the clip they are posed from. They can be kept as long as the sheet stays.
#[derive(Debug, Clone)]
pub struct Cels {
    clock: Clock,
    layer: Layer,
    /// Sources of each drawing, one per layer with joints.
    drawings: Vec<Vec<Source>>,
    /// Layer of each joint, counted without layers that have no joint.
    layer_of: Vec<usize>,
    /// Joints that take their position from the source on every koma.
    travellers: Vec<usize>,
    /// Places in the source of the koma of each layer, if there are such joints.
    places: Vec<Vec<f64>>,
    /// Whether each drawing is on screen at some time.
    is_shown: Vec<bool>,
    /// Feet that stay in place while they stand, if the sheet holds feet.
    feet: Option<Arc<HeldFeet>>,
}

impl Cels {
    /// Composites the layers of a sheet. Joints that no layer names, or whose layer shows nothing, belong to the
    /// first layer. A layer that ends before the others holds its last drawing.
    ///
    /// # Errors
    ///
    /// [`Error::Sheet`] as in [`Sheet::first_layer`], and for a joint that the clip does not have.
    pub fn new(clip: &Clip, sheet: &Sheet) -> Result<Self, Error> {
        let feet = match sheet.feet {
            Feet::Free => None,
            Feet::Held => HeldFeet::new(clip, sheet.clock).map(Arc::new),
        };
        Self::on(clip, sheet, feet)
    }

    /// Composites another sheet of the same motion and keeps the held feet already found.
    ///
    /// # Errors
    ///
    /// As in [`Cels::new`].
    pub fn again(&self, clip: &Clip, sheet: &Sheet) -> Result<Self, Error> {
        Self::on(clip, sheet, self.feet.clone())
    }

    fn on(clip: &Clip, sheet: &Sheet, feet: Option<Arc<HeldFeet>>) -> Result<Self, Error> {
        let first = sheet.first_layer()?;
        let layer_of = layer_of(clip.skeleton(), sheet)?;
        let mut layers: Vec<usize> = std::iter::once(0).chain(layer_of.iter().copied()).collect();
        layers.sort_unstable();
        layers.dedup();
        // Layers without a joint do not count.
        let rank = |layer: &usize| layers.partition_point(|other| other < layer);
        let layer_of = layer_of.iter().map(rank).collect();
        let layers: Vec<&Layer> = layers.iter().map(|layer| &sheet.layers[*layer]).collect();
        let travellers = match sheet.root {
            RootMotion::Drawings => Vec::new(),
            RootMotion::Ones => travellers(clip),
        };
        let places = match travellers.as_slice() {
            [] => Vec::new(),
            _ => layers.iter().map(|layer| layer.source_places(sheet.clock)).collect(),
        };
        let (layer, drawings) = match layers.as_slice() {
            [_] => {
                let alone = first.drawings.iter().map(|drawing| vec![drawing.source]).collect();
                (first.clone(), alone)
            }
            layers => flat::flattened(layers),
        };
        let mut is_shown = vec![false; layer.drawings.len()];
        layer.exposures.iter().for_each(|shown| is_shown[shown.drawing] = true);
        let clock = sheet.clock;
        Ok(Self { clock, layer, drawings, layer_of, travellers, places, is_shown, feet })
    }

    /// Returns all layers merged into one.
    pub fn layer(&self) -> &Layer {
        &self.layer
    }

    /// Whether the body travels on while a drawing is held.
    pub fn slides(&self) -> bool {
        !self.travellers.is_empty()
    }

    /// Returns the source of a joint in a drawing.
    pub fn source(&self, drawing: usize, joint: usize) -> Source {
        self.drawings[drawing][self.layer_of[joint]]
    }

    /// Returns the place in the source to which a joint has come on a koma: that which its layer shows there. A drawing
    /// that is never shown has its own.
    fn place(&self, joint: usize, drawing: usize, koma: usize) -> f64 {
        let places = &self.places[self.layer_of[joint]];
        let shown = places.get(koma).or(places.last()).filter(|_| self.is_shown[drawing]);
        shown.copied().unwrap_or_else(|| self.source(drawing, joint).place())
    }

    /// Number of layers.
    fn layers(&self) -> usize {
        self.layer_of.iter().max().map_or(1, |last| last + 1)
    }
}

/// All layers on screen together, as one column of drawings.
///
/// A single layer is used as it is. Several layers give a drawing wherever one of them has a new one. It is a genga
/// if one of theirs is, and takes that drawing's place and reasons.
#[derive(Debug, Clone)]
pub struct Composite<'a> {
    clip: &'a Clip,
    cels: Cow<'a, Cels>,
}

impl Deref for Composite<'_> {
    type Target = Cels;

    fn deref(&self) -> &Cels {
        &self.cels
    }
}

impl<'a> Composite<'a> {
    /// Composites the layers of a sheet, as in [`Cels::new`].
    ///
    /// # Errors
    ///
    /// As in [`Cels::new`].
    pub fn new(clip: &'a Clip, sheet: &Sheet) -> Result<Self, Error> {
        Ok(Self { clip, cels: Cow::Owned(Cels::new(clip, sheet)?) })
    }

    /// Uses cels that were composited before from this clip.
    pub fn with(clip: &'a Clip, cels: &'a Cels) -> Self {
        Self { clip, cels: Cow::Borrowed(cels) }
    }

    /// The motion clip.
    pub fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// Returns the first koma of each drawing on screen. A drawing that is never shown gets the koma of its own
    /// place.
    pub fn first_koma(&self) -> Vec<usize> {
        let own = |drawing: &Drawing| self.clock.koma_from_place(drawing.source.place());
        let first = self.layer.first_koma().into_iter().zip(&self.layer.drawings);
        first.map(|(koma, drawing)| koma.unwrap_or_else(|| own(drawing))).collect()
    }

    /// Joints that take their position from the source on every koma.
    pub fn travellers(&self) -> &[usize] {
        &self.travellers
    }

    /// Joints that turn while a drawing is held: the legs of feet that stay while the body travels on.
    pub fn steppers(&self) -> Vec<usize> {
        let feet = self.feet.iter().filter(|_| self.slides());
        feet.flat_map(|feet| feet.joints()).collect()
    }

    /// Returns the foot hold for its poses, if the sheet holds feet.
    fn foot_hold(&self) -> Option<FootHold<'_>> {
        self.feet.as_deref().map(|feet| FootHold::new(feet, self.clip))
    }
}

/// Returns the layer of each joint. Joints that no layer names, or whose layer shows nothing, belong to the first
/// layer.
///
/// # Errors
///
/// [`Error::Sheet`] for a joint that the skeleton does not have.
pub fn layer_of(skeleton: &Skeleton, sheet: &Sheet) -> Result<Vec<usize>, Error> {
    let mut layer_of = vec![0; skeleton.len()];
    for (at, layer) in sheet.layers.iter().enumerate() {
        for name in &layer.joints {
            let Some(joint) = skeleton.find(name) else {
                let names = skeleton.joints.iter().map(|joint| joint.name.as_str());
                let (layer, hint) = (&layer.name, did_you_mean(name, names));
                let message = format!("layer {layer}: the clip has no joint {name}{hint}");
                return Err(Error::sheet(message));
            };
            if !layer.exposures.is_empty() {
                layer_of[joint.0] = at;
            }
        }
    }
    Ok(layer_of)
}

/// Finds the joints that carry the body through the room: those that change position and hang on no other such joint.
/// Usually this is the root; some rigs have a still joint above the one that travels.
pub(crate) fn travellers(clip: &Clip) -> Vec<usize> {
    let changes = clip.changing_channels();
    let mut carried: Vec<bool> = Vec::with_capacity(clip.skeleton().len());
    let mut travellers = Vec::new();
    for (joint, data) in clip.skeleton().iter() {
        let channels = data.channels.iter().zip(&changes[data.first_channel..]);
        let goes = channels.into_iter().any(|(channel, changes)| *changes && is_position(*channel));
        let is_carried = data.parent.is_some_and(|parent| carried[parent.0]);
        if goes && !is_carried {
            travellers.push(joint.0);
        }
        carried.push(goes || is_carried);
    }
    travellers
}

/// Whether a channel is a position channel.
pub(super) fn is_position(channel: Channel) -> bool {
    matches!(channel, Channel::Position(_))
}
