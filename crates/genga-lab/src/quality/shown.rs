//! The pose on screen, koma by koma.

use crate::quality::Slip;
use crate::quality::pops::Pops;
use genga::keys::{DrawnBody, with_ends};
use genga::motion::{Clip, Composite, CompositePoser};
use genga::sheet::{Role, Source};
use genga::signal::Contact;
use genga::time::{Clock, Frame};

/// Returns the error of the pose on screen at each koma, in % of body height.
pub(super) fn errors(
    body: &mut DrawnBody<'_>,
    composite: &Composite<'_>,
    drawings: &[usize],
) -> Vec<f64> {
    let mut poser = CompositePoser::new(composite);
    let mut taken = None;
    let mut error = |(koma, drawing): (usize, usize)| {
        // A drawing stays for several koma, so its pose is computed only once.
        if composite.slides() || taken.replace(drawing) != Some(drawing) {
            body.stand(poser.drawing(drawing, koma));
        }
        body.off(koma)
    };
    drawings.iter().copied().enumerate().map(&mut error).collect()
}

/// Measures how far feet slide on screen; `drawings` gives the drawing of each koma, and the last one continues.
pub(super) fn slip(
    body: &mut DrawnBody<'_>,
    clock: Clock,
    contacts: &[Contact],
    composite: &Composite<'_>,
    drawings: &[usize],
) -> Slip {
    let mut poser = CompositePoser::new(composite);
    let drawing = |koma: usize| drawings[koma.min(drawings.len() - 1)];
    let place =
        |contact: &Contact, koma| composite.source(drawing(koma), contact.point.joint.0).place();
    Slip::of_poses(body, clock, contacts, place, |body, koma| {
        body.stand(poser.drawing(drawing(koma), koma));
    })
}

/// Finds the pops on screen. The drawing of the clip's end is always there, so the step into it is not a pop.
pub(super) fn pops(body: &mut DrawnBody<'_>, composite: &Composite<'_>, koma_rate: f64) -> Pops {
    let layer = composite.layer();
    let is_end = |drawing: usize| layer.drawings[drawing].role == Role::End;
    let exposures = match layer.exposures.split_last() {
        Some((last, rest)) if is_end(last.drawing) => rest,
        _ => &layer.exposures,
    };
    let mut poser = CompositePoser::new(composite);
    let mut steps = Vec::new();
    let mut before = Vec::new();
    for (at, (begin, exposure)) in layer.timed().take(exposures.len()).enumerate() {
        body.stand(poser.drawing(exposure.drawing, begin));
        if at > 0 {
            steps.push(body.apart(&before));
        }
        if composite.slides() {
            body.stand(poser.drawing(exposure.drawing, begin + exposure.koma - 1));
        }
        before.clear();
        before.extend_from_slice(body.positions());
    }
    let exposures: Vec<usize> = exposures.iter().map(|exposure| exposure.koma).collect();
    Pops::new(&exposures, &steps, koma_rate)
}

/// Returns the source of each koma if only some keys and the ends of the clip are left, with a slerp from each to the
/// next.
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
