//! Where the joints and the tips of the bones are in a drawing.

use glam::DVec3;

use crate::motion::{Body, Clip, Composite, CompositePoser, Poser};
use crate::sheet::Source;

/// Turns sources into points: the joints in their order, then the tips in the order of their joints.
pub(crate) struct Posing<'a> {
    poser: Poser<'a>,
    body: Body,
}

impl<'a> Posing<'a> {
    /// For a clip of at least one frame.
    pub(crate) fn of(clip: &'a Clip) -> Self {
        Self { poser: Poser::of(clip), body: Body::new(clip.skeleton()) }
    }

    /// The points of a drawing, in the file's unit.
    pub(crate) fn points(&mut self, source: Source) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(source));
        self.body.points().to_vec()
    }

    /// The points of several drawings.
    pub(crate) fn all(&mut self, sources: impl IntoIterator<Item = Source>) -> Vec<Vec<DVec3>> {
        sources.into_iter().map(|source| self.points(source)).collect()
    }
}

/// Turns what is on screen into points, as [`Posing`] does with sources.
pub(super) struct Showing<'a> {
    poser: CompositePoser<'a>,
    body: Body,
}

impl<'a> Showing<'a> {
    pub(super) fn of(composite: &'a Composite<'a>) -> Self {
        let body = Body::new(composite.clip().skeleton());
        Self { poser: CompositePoser::of(composite), body }
    }

    /// The points of a drawing as it is on screen on a koma.
    pub(super) fn points(&mut self, drawing: usize, koma: usize) -> Vec<DVec3> {
        self.body.place(self.poser.drawing(drawing, koma));
        self.body.points().to_vec()
    }
}
