//! The shared state of both omission stages: the layer as a linked list of drawings.

use std::ops::Range;

use crate::error::Error;
use crate::sheet::{Drawing, Exposure, Layer, Reason};
use crate::timing::report::Shortfall;
use crate::timing::{Course, On, Stills};

/// Number of times that naka-nashi may lengthen a drawing (KKMFT §3.2, Algorithm 1).
pub(super) const MOST_LENGTHENINGS: usize = 3;

/// A drawing in the list. Indices are those of the input layer.
#[derive(Debug, Clone)]
pub(super) struct Link {
    /// The drawing before; itself for the first.
    pub(super) before: usize,
    /// The drawing after; the number of drawings for the last.
    pub(super) after: usize,
    /// Koma on screen; 0 once removed.
    pub(super) koma: usize,
    /// SSD to the drawing before; 0 for the first.
    pub(super) step: f64,
    /// Whether the drawing is never left out.
    pub(super) kept: bool,
    /// Whether the drawing is an inbetween.
    is_inbetween: bool,
    /// Whether the body hardly moves there, before any omission. A turn in the midst of a swing is not a pose to hold.
    is_slow: bool,
    /// Whether the drawing begins on a koma that is [kept](Course::kept), and keeps its length.
    pub(super) paced: bool,
    /// The interval that the drawing lies in or opens, an index into [`Strip::intervals`].
    pub(super) interval: usize,
    /// Number of times that naka-nashi lengthened the drawing.
    pub(super) given: usize,
    /// Number of koma that naka-nashi took from the drawing while it stayed.
    pub(super) taken: usize,
    /// Most koma that it may grow to.
    pub(super) bound: usize,
    /// Number of drawings after it that koma-dori replaced by it.
    pub(super) held_for: usize,
    /// Number of drawings just before it that naka-nashi left out.
    pub(super) omitted_before: usize,
}

/// A layer as a linked list of drawings, with the distance between neighbours.
pub(super) struct Strip<'a> {
    pub(super) stills: &'a Stills,
    pub(super) links: Vec<Link>,
    /// Index ranges of a drawing that keeps its place and those in transit up to the next such one.
    pub(super) intervals: Vec<Range<usize>>,
    /// Whether naka-nashi takes single koma, as Algorithm 1 does: on a sheet on ones without genga.
    pub(super) by_koma: bool,
    /// Number of drawings that are left.
    pub(super) drawings: usize,
}

impl<'a> Strip<'a> {
    /// Links the drawings of a layer and measures each pair of neighbours once. `bound` gives the most koma to which the
    /// drawing of a koma may grow.
    ///
    /// # Errors
    /// [`Error::Clip`] unless the exposures show each drawing once, in order, and there is a still
    /// for each.
    pub(super) fn new(
        layer: &Layer,
        stills: &'a Stills,
        bound: impl Fn(usize) -> usize,
        course: &Course,
    ) -> Result<Self, Error> {
        check(layer, stills)?;
        let is_kept = |begin| course.kept.iter().any(|koma| koma.contains(&begin));
        let count = layer.drawings.len();
        let mut links: Vec<Link> = Vec::with_capacity(count);
        let mut intervals: Vec<Range<usize>> = Vec::new();
        for (index, (drawing, (begin, exposure))) in
            layer.drawings.iter().zip(layer.timed()).enumerate()
        {
            let paced = is_kept(begin);
            // The first and the last drawing stay, whatever their role.
            let kept = drawing.role.is_kept() || paced || index == 0 || index + 1 == count;
            // A fill lies in transit. The next interval begins where the body turns, rests or comes to an end.
            let opens = drawing.why.reason != Some(Reason::Fill) || intervals.is_empty();
            if kept && (opens || index + 1 == count) {
                intervals.push(index..index);
            }
            let interval = intervals.len() - 1;
            intervals[interval].end = index + 1;
            let before = index.saturating_sub(1);
            links.push(Link {
                before,
                after: index + 1,
                koma: exposure.koma,
                step: if index == 0 { 0.0 } else { stills.ssd(before, index) },
                kept,
                is_inbetween: !drawing.role.is_kept(),
                paced,
                is_slow: false,
                interval,
                bound: bound(begin),
                given: 0,
                taken: 0,
                held_for: 0,
                omitted_before: 0,
            });
        }
        let kept = links.iter().filter(|link| link.kept).count();
        let by_koma = course.on.values().all(|on| *on == On::every(1)) && kept <= 2;
        Ok(Self { stills, links, intervals, by_koma, drawings: count })
    }

    /// Returns the number of koma that naka-nashi may still give to a drawing.
    pub(super) fn room(&self, drawing: usize) -> usize {
        let Link { given, koma, interval, paced, is_slow, bound, .. } = self.links[drawing];
        match () {
            () if paced => 0,
            () if self.by_koma => room_of(given, koma, bound),
            // The drawing that opens an interval is held, and those that follow come later: a snap.
            () if drawing == self.intervals[interval].start && is_slow => {
                MOST_LENGTHENINGS.saturating_sub(given)
            }
            () => 0,
        }
    }

    /// Marks each of an action's drawings at which the body hardly moves: it arrives or sets out no faster than
    /// [usual](Self::usual_way).
    pub(super) fn tell_slow(&mut self, drawings: &[Range<usize>], usual: f64) {
        for at in drawings.iter().cloned().flatten() {
            let out = self.links.get(self.links[at].after).map_or(0.0, |next| next.step);
            // Compares roots on both sides, as the median is a root; squared again it might differ.
            self.links[at].is_slow = self.links[at].step.min(out).sqrt() <= usual;
        }
    }

    /// Returns the usual step between drawings in a range, as the root of the SSD: the median of the steps that move,
    /// or 0 if nothing does.
    pub(super) fn usual_way(&self, drawings: Range<usize>) -> f64 {
        let steps = self.links[drawings].iter().filter(|link| link.koma > 0 && link.step > 0.0);
        let mut ways: Vec<f64> = steps.map(|link| link.step.sqrt()).collect();
        ways.sort_by(f64::total_cmp);
        ways.get(ways.len() / 2).copied().unwrap_or(0.0)
    }

    /// Returns the number of inbetweens that are left among some drawings.
    pub(super) fn inbetweens(&self, has: impl Fn(usize) -> bool) -> usize {
        let left = |(at, link): &(usize, &Link)| link.koma > 0 && !link.kept && has(*at);
        self.links.iter().enumerate().filter(left).count()
    }

    /// Explains why nothing of some drawings can go: no inbetween is left, or only such as always stay.
    pub(super) fn none_left(&self, has: impl Fn(usize) -> bool) -> Shortfall {
        let stays =
            |(at, link): (usize, &Link)| link.koma > 0 && link.kept && link.is_inbetween && has(at);
        match self.links.iter().enumerate().any(stays) {
            true => Shortfall::AllStay,
            false => Shortfall::NoneLeft,
        }
    }

    /// Removes an inbetween from the list and returns its koma; its neighbours are measured anew.
    pub(super) fn remove(&mut self, drawing: usize) -> usize {
        let Link { before, after, omitted_before, .. } = self.links[drawing];
        self.links[before].after = after;
        let step = self.stills.ssd(before, after);
        let next = &mut self.links[after];
        next.before = before;
        next.step = step;
        next.omitted_before += omitted_before;
        self.drawings -= 1;
        std::mem::take(&mut self.links[drawing].koma)
    }

    /// Returns the remaining layer, its drawings renumbered.
    pub(super) fn into_layer(self, layer: &Layer) -> Layer {
        let mut left = Layer {
            name: layer.name.clone(),
            joints: layer.joints.clone(),
            drawings: Vec::with_capacity(self.drawings),
            exposures: Vec::with_capacity(self.drawings),
            gone: vec![],
        };
        for (link, drawing) in self.links.iter().zip(&layer.drawings) {
            if link.koma > 0 {
                let drawing_index = left.drawings.len();
                left.exposures.push(Exposure { drawing: drawing_index, koma: link.koma });
                left.drawings.push(with_reasons(drawing, link));
            }
        }
        left
    }
}

/// Returns the room on ones of a drawing lengthened `given` times that stays for `koma` and may grow to `bound`.
pub(super) fn room_of(given: usize, koma: usize, bound: usize) -> usize {
    MOST_LENGTHENINGS.saturating_sub(given).min(bound.saturating_sub(koma))
}

fn with_reasons(drawing: &Drawing, link: &Link) -> Drawing {
    let mut drawing = drawing.clone();
    drawing.why.lengthened += link.given.saturating_sub(link.taken);
    drawing.why.omitted_before += link.omitted_before;
    drawing.why.held_for += link.held_for;
    drawing
}

fn check(layer: &Layer, stills: &Stills) -> Result<(), Error> {
    let (name, drawings) = (&layer.name, layer.drawings.len());
    if stills.len() != drawings {
        let found = stills.len();
        return Err(Error::clip(format!(
            "layer {name} has {drawings} drawings, but positions of {found} were given"
        )));
    }
    let in_order =
        |(index, exposure): (usize, &Exposure)| exposure.drawing == index && exposure.koma > 0;
    if layer.exposures.len() != drawings || !layer.exposures.iter().enumerate().all(in_order) {
        return Err(Error::clip(format!(
            "layer {name} must show each drawing once and in order before any is left out"
        )));
    }
    Ok(())
}
