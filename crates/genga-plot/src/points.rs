//! Computes where the joints, the tips of the bones and the marks of a figure are in a drawing.

use glam::DVec3;

use genga::motion::{Body, Clip, Composite, CompositePoser, Point, Poser};
use genga::sheet::Source;

/// Turns sources into points: the joints in order, the tips in the order of their joints, then the marks.
pub struct Posing<'a> {
    poser: Poser<'a>,
    body: Body,
    marks: &'a [Point],
}

impl<'a> Posing<'a> {
    /// Prepares a clip of at least one frame; `marks` are the figure's points besides joints and tips.
    pub fn new(clip: &'a Clip, marks: &'a [Point]) -> Self {
        Self { poser: Poser::new(clip), body: Body::new(clip.skeleton()), marks }
    }

    /// Returns the points of a drawing, in units of the file.
    pub fn points(&mut self, source: Source) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(source));
        points(&self.body, self.marks)
    }

    /// Returns the points of several drawings.
    pub fn all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<Vec<DVec3>> {
        sources.into_iter().map(|source| self.points(source)).collect()
    }
}

/// Turns drawings on screen into points, in the order of [`Posing`].
pub struct Showing<'a> {
    poser: CompositePoser<'a>,
    body: Body,
    marks: &'a [Point],
}

impl<'a> Showing<'a> {
    /// Prepares the layers of a composite, as they are shown together.
    pub fn new(composite: &'a Composite<'a>, marks: &'a [Point]) -> Self {
        let body = Body::new(composite.clip().skeleton());
        Self { poser: CompositePoser::new(composite), body, marks }
    }

    /// Returns the points of a drawing as it is shown on a koma.
    pub fn points(&mut self, drawing: usize, koma: usize) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(drawing, koma));
        points(&self.body, self.marks)
    }
}

/// Returns the joints, tips and marks of a posed body.
fn points(body: &Body, marks: &[Point]) -> Vec<DVec3> {
    let marks = marks.iter().map(|mark| mark.position(body));
    body.points().iter().copied().chain(marks).collect()
}
