//! Frozen genga (凍結): those there are stay, whatever the knobs say; in a part of the clip alone they are found again.

use std::ops::Range;

use crate::edits::Edits;
use crate::keys::{Key, Origin};
use crate::pipeline::{Breakdown, LayerBreakdown};
use crate::time::Frame;

/// Corrections with every genga frozen as it is; what a person corrected corrects it still.
pub(super) fn frozen(edits: &Edits, breakdown: &Breakdown<'_>) -> Edits {
    let mut frozen = thawed(edits);
    for (column, layer) in columns(breakdown) {
        *frozen.frozen_of(column) = found(&layer, edits.again);
    }
    frozen.again = false;
    frozen
}

/// Corrections with no genga frozen.
pub(super) fn thawed(edits: &Edits) -> Edits {
    let mut edits = edits.clone();
    edits.frozen.clear();
    edits.layers.values_mut().for_each(|own| own.frozen.clear());
    edits.without_empty_layers()
}

/// Frozen genga, with those of `fresh` in some koma in the place of their own there.
pub(super) fn found_again(edits: &Edits, fresh: &Breakdown<'_>, koma: &Range<usize>) -> Edits {
    let mut edits = edits.clone();
    let is_inside = |frame: &Frame| koma.contains(&fresh.clock.koma_from_frame(*frame));
    for (column, layer) in columns(fresh) {
        let frozen = edits.frozen_of(column);
        frozen.retain(|frame| !is_inside(frame));
        frozen.extend(found(&layer, false).iter().filter(|frame| is_inside(frame)));
        frozen.sort_unstable();
    }
    edits
}

/// Each column with the name by which it is corrected; none of a sheet that has no other.
fn columns<'a>(
    breakdown: &Breakdown<'a>,
) -> impl Iterator<Item = (Option<&'a str>, LayerBreakdown<'a>)> + use<'a> {
    let layers = &breakdown.sheet.layers;
    let is_named = layers.len() > 1;
    let names = layers.iter().map(move |layer| is_named.then_some(layer.name.as_str()));
    names.zip(breakdown.layers())
}

/// The frames of the genga that corrections are made on. Where all were chosen again around them, those that came of it.
fn found(layer: &LayerBreakdown<'_>, again: bool) -> Vec<Frame> {
    let frame = |key: &Key| match key.origin {
        Origin::Moved { from } => from,
        _ => key.frame,
    };
    let keys = if again { &layer.keys.keys } else { layer.uncorrected };
    // In gaits the sheet has the phases of steps instead.
    let steps = layer.keys.keys.iter().filter(|key| key.origin == Origin::Step);
    let mut frames: Vec<Frame> = keys.iter().chain(steps).map(frame).collect();
    frames.sort_unstable();
    frames.dedup();
    frames
}
