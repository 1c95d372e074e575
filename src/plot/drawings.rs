//! The drawings of a sheet as pictures label them: numbers, koma, names.

use std::borrow::Cow;

use glam::DVec3;

use crate::error::Error;
use crate::motion::{Clip, Composite, Point};
use crate::plot::points::Showing;
use crate::plot::style;
use crate::sheet::{Drawing, Exposure, Layer, Reason, Sheet};

/// A drawing on screen.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShownDrawing<'a> {
    pub(crate) drawing: &'a Drawing,
    /// Its index in the layer.
    pub(crate) index: usize,
    /// The number of a kept drawing among the kept, from 1, as in the key table.
    pub(crate) genga: Option<usize>,
    /// The koma it begins on, from 0.
    pub(crate) koma: usize,
    /// Koma on screen.
    pub(crate) held: usize,
}

impl ShownDrawing<'_> {
    /// The number in the CELL column, from 1.
    pub(crate) fn number(&self) -> usize {
        self.index + 1
    }

    /// Whether a person asked for it.
    pub(super) fn is_pinned(&self) -> bool {
        self.drawing.why.pinned.is_some()
    }

    /// In a few words each: what a person called it, and why it is there.
    pub(super) fn reasons(&self) -> Vec<String> {
        let why = &self.drawing.why;
        let mut reasons = Vec::new();
        match why.pinned.as_deref() {
            Some("") => reasons.push("pinned".to_owned()),
            Some(name) => reasons.push(name.to_owned()),
            None => {}
        }
        if why.hold_set {
            reasons.push("hold 止め".to_owned());
        }
        if why.omitted_before > 0 {
            reasons.push(format!("抜いた中割 {}", why.omitted_before));
        }
        match why.reason {
            Some(reason @ (Reason::Fill | Reason::Rest | Reason::Contact | Reason::Step)) => {
                reasons.push(format!("{} {}", reason.word(), reason.japanese()));
            }
            Some(Reason::Turn | Reason::Pin) | None => {}
        }
        match &*why.voters {
            [] => {}
            [one] => reasons.push(one.to_string()),
            [first, others @ ..] => reasons.push(format!("{first} +{}", others.len())),
        }
        // No room for both.
        if let Some(price) = why.price.filter(|_| why.omitted_before == 0) {
            reasons.push(format!("{price:.1} %"));
        }
        reasons
    }
}

/// The exposures of a layer, labelled.
pub(crate) fn shown_drawings(layer: &Layer) -> Vec<ShownDrawing<'_>> {
    let numbers = layer.genga_numbers();
    let cell = |(koma, exposure): (usize, Exposure)| {
        let index = exposure.drawing;
        let drawing = &layer.drawings[index];
        ShownDrawing { drawing, index, genga: numbers[index], koma, held: exposure.koma }
    };
    layer.timed().map(cell).collect()
}

/// What figures show, all layers on one another, after a look at whether it can be shown.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::first_layer`], and for a joint that is not there; [`Error::Picture`] when
/// there is no frame or no joint, or a place is none.
pub(super) fn composed<'a>(clip: &'a Clip, sheet: &'a Sheet) -> Result<Composite<'a>, Error> {
    check(clip, &sheet.layers)?;
    Composite::of(clip, sheet)
}

/// The layer that curves show, the first, after the same look.
///
/// # Errors
/// Those of [`composed`].
pub(super) fn shown<'a>(clip: &Clip, sheet: &'a Sheet) -> Result<&'a Layer, Error> {
    check(clip, &sheet.layers)?;
    sheet.first_layer()
}

fn check(clip: &Clip, layers: &[Layer]) -> Result<(), Error> {
    if clip.is_empty() || clip.skeleton().is_empty() {
        return Err(style::cannot("a clip without frames or joints has no pose to draw"));
    }
    let mut drawings = layers.iter().flat_map(|layer| &layer.drawings);
    if drawings.all(|drawing| drawing.source.place().is_finite()) {
        Ok(())
    } else {
        Err(style::cannot("a drawing's place in the source must be a number"))
    }
}

/// The beginning of a layer: its first koma, `most` of them, and the drawings up to the last that is seen
/// there. Their numbers stay.
pub(super) fn beginning(layer: &Layer, most: usize) -> Cow<'_, Layer> {
    if layer.length() <= most {
        return Cow::Borrowed(layer);
    }
    let on_screen = layer.timed().take_while(|(koma, _)| *koma < most);
    let exposures: Vec<Exposure> = on_screen
        .map(|(koma, exposure)| Exposure { koma: exposure.koma.min(most - koma), ..exposure })
        .collect();
    let drawings = exposures.iter().map(|exposure| exposure.drawing + 1).max().unwrap_or(0);
    let drawings = layer.drawings[..drawings].to_vec();
    let (name, joints) = (layer.name.clone(), layer.joints.clone());
    Cow::Owned(Layer { name, joints, drawings, exposures })
}

/// The points of the first drawings of a composite, as each is first on screen.
pub(super) fn drawn_poses(
    composite: &Composite<'_>,
    marks: &[Point],
    drawings: usize,
) -> Vec<Vec<DVec3>> {
    let mut showing = Showing::of(composite, marks);
    let first = composite.first_koma().into_iter().take(drawings).enumerate();
    first.map(|(drawing, koma)| showing.points(drawing, koma)).collect()
}

/// The points of what is on screen koma by koma, where that is not the same for all koma of a drawing.
pub(super) fn sliding_poses(
    composite: &Composite<'_>,
    marks: &[Point],
    koma: usize,
) -> Option<Vec<Vec<DVec3>>> {
    let mut showing = Showing::of(composite, marks);
    let drawings = composite.layer().koma().take(koma).enumerate();
    let poses = drawings.map(|(koma, drawing)| showing.points(drawing, koma));
    composite.slides().then(|| poses.collect())
}

/// A length of time as a sheet has it: seconds + koma.
pub(super) fn seconds_and_koma(koma: usize, koma_rate: f64) -> String {
    let second = koma_rate.round().max(1.0) as usize;
    format!("{}+{}", koma / second, koma % second)
}
