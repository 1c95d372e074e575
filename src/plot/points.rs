//! Where the joints, the tips of the bones and the marks of a figure are in a drawing.

use glam::DVec3;

use crate::motion::{Body, Clip, Composite, CompositePoser, Point, Poser};
use crate::sheet::Source;

/// Turns sources into points: the joints in their order, the tips in the order of their joints, then the marks.
pub(crate) struct Posing<'a> {
    poser: Poser<'a>,
    body: Body,
    marks: &'a [Point],
}

impl<'a> Posing<'a> {
    /// For a clip of at least one frame, and for what a figure has besides joints and tips.
    pub(crate) fn of(clip: &'a Clip, marks: &'a [Point]) -> Self {
        Self { poser: Poser::of(clip), body: Body::new(clip.skeleton()), marks }
    }

    /// The points of a drawing, in the file's unit.
    pub(crate) fn points(&mut self, source: Source) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(source));
        points(&self.body, self.marks)
    }

    /// The points of several drawings.
    pub(crate) fn all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<Vec<DVec3>> {
        sources.into_iter().map(|source| self.points(source)).collect()
    }
}

/// Turns what is on screen into points, as [`Posing`] does with sources.
pub(crate) struct Showing<'a> {
    poser: CompositePoser<'a>,
    body: Body,
    marks: &'a [Point],
}

impl<'a> Showing<'a> {
    pub(crate) fn of(composite: &'a Composite<'a>, marks: &'a [Point]) -> Self {
        let body = Body::new(composite.clip().skeleton());
        Self { poser: CompositePoser::of(composite), body, marks }
    }

    /// The points of a drawing as it is on screen on a koma.
    pub(crate) fn points(&mut self, drawing: usize, koma: usize) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(drawing, koma));
        points(&self.body, self.marks)
    }
}

/// Joints, tips and marks of a body that stands.
fn points(body: &Body, marks: &[Point]) -> Vec<DVec3> {
    let marks = marks.iter().map(|mark| mark.position(body));
    body.points().iter().copied().chain(marks).collect()
}
