//! Frozen genga (凍結): they stay, whatever the knobs say, until they are found again in a part of the clip.

use std::ops::Range;

use genga::edits::Edits;
use genga::keys::{Key, Origin};
use genga::pipeline::{Breakdown, LayerBreakdown};
use genga::time::Frame;

/// Returns corrections with every genga frozen as it is. A person's corrections still apply on top.
pub(super) fn frozen(edits: &Edits, breakdown: &Breakdown<'_>) -> Edits {
    let mut frozen = thawed(edits);
    for (column, layer) in columns(breakdown) {
        *frozen.frozen_of(column) = found(&layer, edits.again);
    }
    frozen.again = false;
    frozen
}

/// Returns corrections with no genga frozen.
pub(super) fn thawed(edits: &Edits) -> Edits {
    let mut edits = edits.clone();
    edits.frozen.clear();
    edits.layers.values_mut().for_each(|own| own.frozen.clear());
    edits.without_empty_layers()
}

/// Replaces the frozen genga in some koma by those of `fresh`.
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

/// Each column with its name for corrections. The name is `None` if the sheet has only one column.
fn columns<'a>(
    breakdown: &Breakdown<'a>,
) -> impl Iterator<Item = (Option<&'a str>, LayerBreakdown<'a>)> + use<'a> {
    let layers = &breakdown.sheet.layers;
    let is_named = layers.len() > 1;
    let names = layers.iter().map(move |layer| is_named.then_some(layer.name.as_str()));
    names.zip(breakdown.layers())
}

/// Frames of the genga that corrections apply to. If all were chosen again around the corrections, the resulting genga.
fn found(layer: &LayerBreakdown<'_>, again: bool) -> Vec<Frame> {
    let keys = if again { &layer.keys.keys } else { layer.uncorrected };
    // Gaits also have keys at the phases of their steps.
    let steps = layer.keys.keys.iter().filter(|key| key.origin == Origin::Step);
    let mut frames: Vec<Frame> = keys.iter().chain(steps).map(Key::unmoved).collect();
    frames.sort_unstable();
    frames.dedup();
    frames
}
