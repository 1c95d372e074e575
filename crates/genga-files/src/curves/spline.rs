//! Cubic curves through keys, with the tangents that bring them closest to samples between the keys.

use glam::{DQuat, DVec4};

use super::samples::Samples;

/// Weight of the take's own velocity at a key beside the samples around it. It is small: it decides only where no
/// sample lies between two keys.
pub(super) const RIDGE: f64 = 1e-3;

/// A track between its keys. Values and tangents are in the order of the keys.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Shape {
    /// One value throughout.
    Constant(DVec4),
    /// Straight from key to key; a slerp for rotations.
    Linear(Vec<DVec4>),
    /// Cubic Hermite curves. Tangents are per source frame.
    Cubic { values: Vec<DVec4>, tangents: Vec<DVec4> },
}

impl Shape {
    /// Evaluates a rotation. `span` is the one that contains the instant.
    pub(super) fn rotation(&self, span: Span) -> DQuat {
        match self {
            Self::Linear(values) => {
                let [from, to] = [values[span.key], values[span.key + 1]].map(DQuat::from_vec4);
                if from == to { from } else { from.slerp(to, span.share) }
            }
            // A reader of glTF normalizes what it interpolates.
            _ => DQuat::from_vec4(self.value(span)).normalize(),
        }
    }

    /// Evaluates a translation, or the components of a rotation before they are normalized.
    pub(super) fn value(&self, span: Span) -> DVec4 {
        match self {
            Self::Constant(value) => *value,
            Self::Linear(values) => values[span.key].lerp(values[span.key + 1], span.share),
            Self::Cubic { values, tangents } => {
                let [from, to] = [values[span.key], values[span.key + 1]];
                let [leaving, arriving] = span.tangent_weights();
                span.between(from, to)
                    + tangents[span.key] * leaving
                    + tangents[span.key + 1] * arriving
            }
        }
    }
}

/// An instant between two keys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    /// Index of the key before.
    key: usize,
    /// Share of the way to the next key, 0 to 1.
    share: f64,
    /// Frames from key to key.
    frames: f64,
}

impl Span {
    /// Finds the span of an instant. There are two keys or more.
    pub(super) fn new(keys: &[f64], place: f64) -> Self {
        let after = keys.partition_point(|key| *key <= place).clamp(1, keys.len() - 1);
        let (before, frames) = (keys[after - 1], keys[after] - keys[after - 1]);
        Self { key: after - 1, share: ((place - before) / frames).clamp(0.0, 1.0), frames }
    }

    /// Index of the key before.
    pub(super) fn key(self) -> usize {
        self.key
    }

    /// The part of a Hermite curve that its ends alone decide.
    fn between(self, from: DVec4, to: DVec4) -> DVec4 {
        let u = self.share;
        let risen = u * u * (3.0 - 2.0 * u);
        from * (1.0 - risen) + to * risen
    }

    /// Weights of the two tangents in a Hermite curve.
    fn tangent_weights(self) -> [f64; 2] {
        let (u, rest) = (self.share, 1.0 - self.share);
        [self.frames * u * rest * rest, -self.frames * u * u * rest]
    }
}

/// The least-squares problem of the tangents at some keys. Its tridiagonal matrix depends on the times alone, so all
/// tracks with the same keys share it.
pub(super) struct Tangents<'a> {
    keys: &'a [f64],
    /// The diagonal after elimination.
    diagonal: Vec<f64>,
    /// The entries beside the diagonal.
    beside: Vec<f64>,
}

impl<'a> Tangents<'a> {
    /// Builds and factorizes the matrix.
    pub(super) fn new(keys: &'a [f64]) -> Self {
        let mut diagonal = vec![RIDGE; keys.len()];
        let mut beside = vec![0.0; keys.len()];
        for span in spans(keys) {
            let [leaving, arriving] = span.tangent_weights();
            diagonal[span.key] += leaving * leaving;
            diagonal[span.key + 1] += arriving * arriving;
            beside[span.key] += leaving * arriving;
        }
        for key in 1..keys.len() {
            diagonal[key] -= beside[key - 1] * beside[key - 1] / diagonal[key - 1];
        }
        Self { keys, diagonal, beside }
    }

    /// Finds the tangents of a track whose values at the keys are given.
    pub(super) fn solve(&self, samples: Samples<'_>, values: &[DVec4]) -> Vec<DVec4> {
        let mut tangents: Vec<DVec4> =
            self.keys.iter().map(|key| samples.velocity(*key) * RIDGE).collect();
        for span in spans(self.keys) {
            let key = span.key;
            let off = samples.at(self.keys[key] + span.share * span.frames)
                - span.between(values[key], values[key + 1]);
            let [leaving, arriving] = span.tangent_weights();
            tangents[key] += off * leaving;
            tangents[key + 1] += off * arriving;
        }
        for key in 1..tangents.len() {
            let before = tangents[key - 1];
            tangents[key] -= before * (self.beside[key - 1] / self.diagonal[key - 1]);
        }
        for key in (0..tangents.len()).rev() {
            let after = tangents.get(key + 1).copied().unwrap_or_default();
            tangents[key] = (tangents[key] - after * self.beside[key]) / self.diagonal[key];
        }
        tangents
    }
}

/// Returns the span of every whole frame from the first key to the last.
fn spans(keys: &[f64]) -> impl Iterator<Item = Span> + '_ {
    keys.windows(2).enumerate().flat_map(|(key, ends)| {
        let (before, frames) = (ends[0], ends[1] - ends[0]);
        let (first, past) = (before.ceil() as usize, ends[1].ceil() as usize);
        (first..past).map(move |frame| Span {
            key,
            share: (frame as f64 - before) / frames,
            frames,
        })
    })
}
