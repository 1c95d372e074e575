//! The cels of a sheet laid on one another (合成): one body, each joint in the pose of its own layer's
//! drawing.

mod feet;
mod flat;
mod poser;
mod rows;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;

use crate::error::{Error, nearest};
use crate::motion::{Channel, Clip, Skeleton};
use crate::sheet::{Drawing, Exposure, Feet, Layer, RootMotion, Sheet, Source};
use crate::time::Clock;

use feet::{FootHold, HeldFeet};
pub(crate) use poser::CompositePoser;
pub(crate) use rows::CompositeRows;

/// The cels of a sheet laid on one another, without the motion that they are poses of: what may be kept while
/// the sheet stays.
#[derive(Debug, Clone)]
pub(crate) struct Cels {
    clock: Clock,
    layer: Layer,
    /// For each drawing what its layers show: one source for each layer that has joints.
    drawings: Vec<Vec<Source>>,
    /// Which layer each joint is of, counted without layers that have none.
    layer_of: Vec<usize>,
    /// Joints whose place is the source's on every koma.
    travellers: Vec<usize>,
    /// Feet that stay where they stand, where they are to.
    feet: Option<Arc<HeldFeet>>,
}

impl Cels {
    /// Lays the layers of a sheet on one another. What no layer names, or one that shows nothing, is of
    /// the first; a layer that ends before the others stays on its last drawing.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::first_layer`], and for a joint that the clip does not have.
    pub(crate) fn of(clip: &Clip, sheet: &Sheet) -> Result<Self, Error> {
        let feet = match sheet.feet {
            Feet::Free => None,
            Feet::Held => HeldFeet::of(clip, sheet.clock).map(Arc::new),
        };
        Self::on(clip, sheet, feet)
    }

    /// The same for another sheet of the same motion, whose feet stand where they stood.
    ///
    /// # Errors
    /// Those of [`Cels::of`].
    #[cfg(feature = "panels")]
    pub(crate) fn again(&self, clip: &Clip, sheet: &Sheet) -> Result<Self, Error> {
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
        let (layer, drawings) = match layers.as_slice() {
            [_] => {
                let alone = first.drawings.iter().map(|drawing| vec![drawing.source]).collect();
                (first.clone(), alone)
            }
            layers => flat::flattened(layers),
        };
        let travellers = match sheet.root {
            RootMotion::Drawings => Vec::new(),
            RootMotion::Ones => travellers(clip),
        };
        Ok(Self { clock: sheet.clock, layer, drawings, layer_of, travellers, feet })
    }

    /// All layers as one.
    pub(crate) fn layer(&self) -> &Layer {
        &self.layer
    }

    /// Whether the body goes on through the room while a drawing is held.
    pub(crate) fn slides(&self) -> bool {
        !self.travellers.is_empty()
    }

    /// What a joint shows in a drawing.
    pub(crate) fn source(&self, drawing: usize, joint: usize) -> Source {
        self.drawings[drawing][self.layer_of[joint]]
    }

    /// Where the koma stands in the source.
    fn place(&self, koma: usize) -> f64 {
        self.clock.place_from_koma(koma)
    }

    /// Number of layers.
    fn layers(&self) -> usize {
        self.layer_of.iter().max().map_or(1, |last| last + 1)
    }
}

/// What is on screen of all layers together, as one column of drawings.
///
/// Of a single layer it is that layer. Of several it has a drawing wherever one of them has a new one;
/// it is a genga where one of theirs is, and shows its place and reasons.
#[derive(Debug, Clone)]
pub(crate) struct Composite<'a> {
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
    /// The layers of a sheet laid on one another, as [`Cels::of`] does.
    ///
    /// # Errors
    /// Those of [`Cels::of`].
    pub(crate) fn of(clip: &'a Clip, sheet: &Sheet) -> Result<Self, Error> {
        Ok(Self { clip, cels: Cow::Owned(Cels::of(clip, sheet)?) })
    }

    /// Cels that were laid before, of this motion.
    #[cfg(feature = "panels")]
    pub(crate) fn with(clip: &'a Clip, cels: &'a Cels) -> Self {
        Self { clip, cels: Cow::Borrowed(cels) }
    }

    /// The motion.
    pub(crate) fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// The koma on which each drawing is first on screen; of one that never is, where its own place is.
    pub(crate) fn first_koma(&self) -> Vec<usize> {
        let own = |drawing: &Drawing| self.clock.koma_from_place(drawing.source.place());
        let mut first: Vec<usize> = self.layer.drawings.iter().map(own).collect();
        let shown: Vec<(usize, Exposure)> = self.layer.timed().collect();
        // From the last to the first: what is shown earlier has the last word.
        shown.iter().rev().for_each(|(begin, exposure)| first[exposure.drawing] = *begin);
        first
    }

    /// Joints whose place is the source's on every koma.
    pub(crate) fn travellers(&self) -> &[usize] {
        &self.travellers
    }

    /// Joints that turn while a drawing is held: the legs of feet that stay while the body goes on.
    pub(crate) fn steppers(&self) -> Vec<usize> {
        let feet = self.feet.iter().filter(|_| self.slides());
        feet.flat_map(|feet| feet.joints()).collect()
    }

    /// What holds the feet of its poses, where they are held.
    fn foot_hold(&self) -> Option<FootHold<'_>> {
        self.feet.as_deref().map(|feet| FootHold::of(feet, self.clip))
    }
}

/// The layer of each joint: what no layer names, or one that shows nothing, is of the first.
///
/// # Errors
/// [`Error::Sheet`] for a joint that is not there.
pub(crate) fn layer_of(skeleton: &Skeleton, sheet: &Sheet) -> Result<Vec<usize>, Error> {
    let mut layer_of = vec![0; skeleton.len()];
    for (at, layer) in sheet.layers.iter().enumerate() {
        for name in &layer.joints {
            let Some(joint) = skeleton.find(name) else {
                let names = skeleton.joints.iter().map(|joint| joint.name.as_str());
                let (layer, hint) = (&layer.name, nearest(name, names).unwrap_or_default());
                return Err(Error::sheet(format!(
                    "layer {layer}: the clip has no joint {name}; did you mean {hint}?"
                )));
            };
            if !layer.exposures.is_empty() {
                layer_of[joint.0] = at;
            }
        }
    }
    Ok(layer_of)
}

/// The joints that carry the body through the room: those whose place changes and that hang on none such.
/// Usually it is the root; some rigs have a still joint above the one that travels.
fn travellers(clip: &Clip) -> Vec<usize> {
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

/// Whether a channel says where a joint is.
fn is_position(channel: Channel) -> bool {
    matches!(channel, Channel::Position(_))
}
