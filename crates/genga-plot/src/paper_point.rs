//! Defines points on paper, in px.

/// A point in px, from the upper left corner.
pub(super) type Point = (f64, f64);
