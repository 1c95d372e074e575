//! Rounds of a cycle laid end to end (つなぎ): rotations as they are, travel that goes on.

use std::borrow::Cow;

use crate::motion::composite::is_position;
use crate::motion::{Clip, travellers};
use crate::sheet::{Drawing, Exposure, Layer, Sheet, Source};
use crate::time::{Clock, Frame};

/// Lays a clip whose last pose is its first end to end. In each round the body is a round's way further; in the round
/// `own` it is where the clip has it. Each seam has one frame, the first of the round behind it.
///
/// The first frame keeps its number.
pub fn laid(clip: &Clip, rounds: usize, own: usize) -> Clip {
    let ways = ways(clip);
    let frames = clip.len().saturating_sub(1);
    let count = if clip.is_empty() { 0 } else { rounds * frames + 1 };
    let mut values = Vec::with_capacity(count * ways.len());
    for at in 0..count {
        let last = at + 1 == count && at > 0;
        let round = if last { rounds - 1 } else { at / frames.max(1) };
        let row = clip.row(Frame(clip.first().0 + at - round * frames));
        let further = round as f64 - own as f64;
        values.extend(row.iter().zip(&ways).map(|(value, way)| match *way {
            0.0 => *value,
            way => value + further * way,
        }));
    }
    let laid = Clip::of_finite(clip.skeleton().clone(), clip.rate(), clip.first(), count, values);
    laid.with_declared(clip.declared())
}

/// Returns the middle one of three rounds laid end to end, in the place and with the numbers of the first.
pub fn middle_round(laid: &Clip) -> Clip {
    let frames = laid.len().saturating_sub(1) / 3;
    let first = laid.first().0 + frames;
    let rows = (first..=first + frames).flat_map(|frame| laid.row(Frame(frame)));
    let (skeleton, values) = (laid.skeleton().clone(), rows.copied().collect());
    let round = Clip::of_finite(skeleton, laid.rate(), laid.first(), frames + 1, values);
    let ways = ways(&round);
    let mut values: Vec<f64> = round.rows().flatten().copied().collect();
    for row in values.chunks_exact_mut(ways.len().max(1)) {
        row.iter_mut().zip(&ways).for_each(|(value, way)| *value -= way);
    }
    round.with_values(values).with_declared(laid.declared())
}

/// Returns how far each column of the table gets in a round: the way of joints that carry the body, 0 for all others.
fn ways(clip: &Clip) -> Vec<f64> {
    let mut ways = vec![0.0; clip.skeleton().channels()];
    if clip.is_empty() {
        return ways;
    }
    let (first, last) = (clip.row(clip.first()), clip.row(clip.last()));
    for joint in travellers(clip) {
        let joint = &clip.skeleton().joints[joint];
        let columns = joint.channels.iter().zip(joint.first_channel..);
        for (_, column) in columns.filter(|(channel, _)| is_position(**channel)) {
            ways[column] = last[column] - first[column];
        }
    }
    ways
}

/// Plays out a sheet that repeats: every round has drawings of its own, in a clip laid end to end, so that the body
/// travels on. A sheet that does not repeat stays as it is.
///
/// The rounds do not share drawings any more, because the body is elsewhere in each.
///
/// # Panics
///
/// If a layer shows a drawing that it does not have.
pub fn played_out<'a>(clip: &'a Clip, sheet: &'a Sheet) -> (Cow<'a, Clip>, Cow<'a, Sheet>) {
    let Some(repeat) = sheet.repeat else { return (Cow::Borrowed(clip), Cow::Borrowed(sheet)) };
    let frames = repeat.frames as f64;
    let begin = begin(sheet);
    // A round in front for layers whose first drawing is held over from before.
    let layers: Vec<Layer> =
        sheet.layers.iter().map(|layer| unwound(layer, begin + frames, frames)).collect();
    let places = layers.iter().flat_map(|layer| &layer.drawings).map(|drawing| drawing.source);
    let furthest = places.map(Source::place).fold(0.0, f64::max) - clip.first().0 as f64;
    let laid = laid(clip, (furthest / frames) as usize + 2, 1);
    let rate = repeat.frame_rate(sheet.clock.koma_rate).unwrap_or(sheet.clock.frame_rate);
    let first = Frame((begin + frames).round() as usize);
    let clock = Clock { first, frame_rate: rate, ..sheet.clock };
    let sheet = Sheet { clock, layers, repeat: None, ..sheet.clone() };
    (Cow::Owned(laid.with_rate(rate)), Cow::Owned(sheet))
}

/// Plays out the first round of a sheet that repeats: as [`played_out`], for what shows each drawing once.
pub fn first_round<'a>(clip: &'a Clip, sheet: &'a Sheet) -> (Cow<'a, Clip>, Cow<'a, Sheet>) {
    match sheet.first_round() {
        Cow::Borrowed(sheet) => played_out(clip, sheet),
        Cow::Owned(round) => {
            let (clip, sheet) = played_out(clip, &round);
            (Cow::Owned(clip.into_owned()), Cow::Owned(sheet.into_owned()))
        }
    }
}

/// Returns the place of the first drawing on screen.
fn begin(sheet: &Sheet) -> f64 {
    let first = sheet.layers.first().and_then(|layer| layer.shown_at(0));
    first.map_or(sheet.clock.first.0 as f64, |drawing| drawing.source.place())
}

/// Gives each round of a layer drawings of its own, a round's frames further than those before. The first drawing is the
/// one of its pose that is nearest to `begin`.
fn unwound(layer: &Layer, begin: f64, frames: f64) -> Layer {
    let place = |shown: &Exposure| layer.drawings[shown.drawing].source.place();
    let is_alone = layer.exposures.iter().all(|shown| *shown == layer.exposures[0]);
    let mut round =
        layer.exposures.first().map_or(0.0, |shown| ((begin - place(shown)) / frames).round());
    let mut unwound = Layer { drawings: Vec::new(), exposures: Vec::new(), ..layer.clone() };
    let mut before: Option<Exposure> = None;
    for shown in &layer.exposures {
        if let Some(before) = before {
            // Going back is going on in the next round; so is a drawing that is the only one.
            round += f64::from(place(shown) < place(&before) || is_alone);
        }
        if is_alone || before.is_none_or(|before| before.drawing != shown.drawing) {
            let drawing = &layer.drawings[shown.drawing];
            let source = drawing.source.later(round * frames);
            unwound.drawings.push(Drawing { source, ..drawing.clone() });
        }
        let drawing = unwound.drawings.len() - 1;
        unwound.exposures.push(Exposure { drawing, koma: shown.koma });
        before = Some(*shown);
    }
    unwound
}

#[cfg(test)]
mod tests;
