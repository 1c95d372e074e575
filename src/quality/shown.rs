//! What is on screen koma by koma.

use crate::keys::{Figure, with_ends};
use crate::motion::Clip;
use crate::quality::holds::Pops;
use crate::sheet::{Layer, Role, Source};
use crate::time::{Clock, Frame};

/// How far the drawing of each koma is from the source there, in % of body height.
pub(super) fn errors(figure: &mut Figure<'_>, shown: &[Source]) -> Vec<f64> {
    let mut taken: Option<Source> = None;
    let mut error = |(koma, source): (usize, Source)| {
        // A drawing stays for some koma.
        if taken != Some(source) {
            figure.take(source);
            taken = Some(source);
        }
        figure.off(koma)
    };
    shown.iter().copied().enumerate().map(&mut error).collect()
}

/// The pops of a layer. The drawing of the clip's end is there whatever stands before it, so the step
/// into it is none.
pub(super) fn pops(figure: &mut Figure<'_>, layer: &Layer, koma_rate: f64) -> Pops {
    let is_end = |drawing: usize| layer.drawings[drawing].role == Role::End;
    let exposures = match layer.exposures.split_last() {
        Some((last, rest)) if is_end(last.drawing) => rest,
        _ => &layer.exposures,
    };
    let mut steps = Vec::new();
    let mut before = Vec::new();
    for (at, exposure) in exposures.iter().enumerate() {
        figure.take(layer.drawings[exposure.drawing].source);
        if at > 0 {
            steps.push(figure.apart(&before));
        }
        before.clear();
        before.extend_from_slice(figure.positions());
    }
    let exposures: Vec<usize> = exposures.iter().map(|exposure| exposure.koma).collect();
    Pops::of(&exposures, &steps, koma_rate)
}

/// The source of each koma when nothing but some keys and the ends of the clip are left: a slerp from
/// each to the next.
pub(super) fn slerped(clip: &Clip, clock: Clock, keys: &[Frame]) -> impl Fn(usize) -> Source {
    let frames = with_ends(clip, keys);
    move |koma| {
        let place = clock.place_from_koma(koma);
        let after = frames.partition_point(|frame| frame.0 as f64 <= place);
        let [from, to] =
            [after.saturating_sub(1), after.min(frames.len() - 1)].map(|at| frames[at].0 as f64);
        if to > from {
            Source::Between { from, to, share: (place - from) / (to - from) }
        } else {
            Source::At(from)
        }
    }
}
