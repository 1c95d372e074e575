//! Reports the drawings of each passage (区間), and how many omission took.

use std::collections::BTreeSet;

use crate::console::counted;
use genga::pipeline::Breakdown;
use genga::recipe::{Frames, Passage, Recipe};
use genga::sheet::Layer;

/// Returns a line for each passage and each layer that it holds in.
pub(super) fn lines(recipe: &Recipe, breakdown: &Breakdown<'_>) -> Vec<String> {
    let is_one = breakdown.sheet.layers.len() == 1;
    let mut lines = Vec::new();
    for passage in &recipe.scopes.passages {
        for (layer, own) in breakdown.sheet.layers.iter().zip(breakdown.layers()) {
            if passage.layer.as_ref().is_none_or(|name| *name == layer.name) {
                let of = if is_one { String::new() } else { format!("{}/", layer.name) };
                lines.push(line(&of, passage, [own.spaced, layer]));
            }
        }
    }
    lines
}

/// `spaced` is the layer before omission.
fn line(of: &str, passage: &Passage, [spaced, layer]: [&Layer; 2]) -> String {
    let frames = passage.frames;
    let [before, after] = [spaced, layer].map(|layer| drawings(layer, frames));
    let koma: usize = shown(layer, frames).map(|(_, koma)| koma).sum();
    let mut line = format!(
        "passage     区間       {of}{frames}: {} on {koma} koma",
        counted(after, "drawing")
    );
    if after < before {
        let on = format!("--within {of}{frames}:omission");
        line += &format!(
            "; naka-nashi and koma-dori took {} of {before} ({on}.naka_nashi=0 {on}.koma_dori=0 keep them)",
            before - after
        );
    }
    line
}

/// The number of different drawings of a layer whose source is among some frames.
fn drawings(layer: &Layer, frames: Frames) -> usize {
    shown(layer, frames).map(|(drawing, _)| drawing).collect::<BTreeSet<_>>().len()
}

/// The exposures of drawings whose source is among some frames: drawing and koma.
fn shown(layer: &Layer, frames: Frames) -> impl Iterator<Item = (usize, usize)> {
    let within = move |drawing: usize| {
        let place = layer.drawings[drawing].source.place();
        frames.from.0 as f64 <= place && place < frames.past.0 as f64
    };
    let exposures = layer.timed().map(|(_, shown)| (shown.drawing, shown.koma));
    exposures.filter(move |(drawing, _)| within(*drawing))
}
