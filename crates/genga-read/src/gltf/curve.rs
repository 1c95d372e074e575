//! Evaluates a curve: its keys and the interpolation between them.

use glam::{DQuat, DVec4};

use super::accessor::{self, Numbers};
use super::buffers::Buffers;
use super::document::{Document, Sampler};
use super::wrong;
use crate::track::{self, Track};
use genga::error::Error;

/// Largest distance at which an instant counts as on a key, as a share of a frame: key times are
/// single-precision floats.
const ON: f64 = 1e-3;

/// Relative rounding error of single-precision floats.
const SINGLE: f64 = 1.2e-7;

/// The interpolation between two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Between {
    Step,
    Linear,
    Cubic,
}

/// The keys of one property of one node.
#[derive(Debug)]
pub(super) struct Curve {
    pub(super) times: Vec<f64>,
    values: Vec<f64>,
    width: usize,
    between: Between,
}

impl Curve {
    /// Reads the curve of a sampler, whose rows are `width` wide. Without a width they are as many numbers as there are for
    /// a key.
    pub(super) fn read(
        document: &Document,
        buffers: &mut Buffers<'_>,
        sampler: &Sampler,
        width: Option<usize>,
        part: &str,
    ) -> Result<Self, Error> {
        let mut numbers = |accessor, part: &str| accessor::read(document, buffers, accessor, part);
        let Numbers { width: one, values: times } =
            numbers(sampler.input, &format!("{part}.input"))?;
        let Numbers { width: found, values } = numbers(sampler.output, &format!("{part}.output"))?;
        let between = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") => Between::Linear,
            Some("STEP") => Between::Step,
            Some("CUBICSPLINE") => Between::Cubic,
            Some(other) => {
                let message = format!("expected LINEAR, STEP or CUBICSPLINE, found {other:?}");
                return Err(wrong(format!("{part}.interpolation"), message));
            }
        };
        let wide = width.unwrap_or(1);
        if one != 1 || found != wide {
            let message = format!("expected rows of 1 and {wide} numbers, found {one} and {found}");
            return Err(wrong(part, message));
        }
        let rows = if between == Between::Cubic { 3 } else { 1 };
        let width = width.unwrap_or_else(|| (values.len() / (rows * times.len()).max(1)).max(1));
        if times.is_empty() || values.len() != times.len() * rows * width {
            let (keys, have) = (times.len(), values.len() / width);
            return Err(wrong(
                part,
                format!("{keys} keys need {} rows, found {have}", keys * rows),
            ));
        }
        // Two keys may share an instant, as in files of Sketchfab; the second counts.
        if let Some(key) = times.windows(2).position(|pair| pair[0] > pair[1] || pair[1].is_nan()) {
            return Err(wrong(part, format!("key {} is earlier than the one before it", key + 1)));
        }
        if !times[0].is_finite() || !times[times.len() - 1].is_finite() {
            return Err(wrong(part, "the time of a key is no number"));
        }
        Ok(Self { times, values, width, between })
    }

    /// Returns the keys at places of a clip, whose first frame is at the time `begin`. Of two keys at one time the second
    /// counts.
    pub(super) fn track(&self, begin: f64, fps: f64, is_rotation: bool) -> Track {
        let between = match self.between {
            Between::Step => track::Between::Step,
            Between::Linear if is_rotation => track::Between::Arc,
            Between::Linear => track::Between::Linear,
            Between::Cubic => track::Between::Cubic,
        };
        let rows = if self.between == Between::Cubic { 3 } else { 1 };
        let (mut places, mut values) = (Vec::new(), Vec::new());
        for (key, time) in self.times.iter().enumerate() {
            if self.times.get(key + 1) == Some(time) {
                continue;
            }
            places.push((time - begin) * fps);
            let own = self.values[key * rows * self.width..].iter().take(rows * self.width);
            // Slopes are per second in a file, and per frame in a track.
            let slope = |at: usize| rows == 3 && at / self.width != 1;
            let scaled = |(at, value): (usize, &f64)| if slope(at) { value / fps } else { *value };
            values.extend(own.enumerate().map(scaled));
        }
        Track { places, values, width: self.width, between }
    }

    /// Whether the value varies over time.
    pub(super) fn moves(&self) -> bool {
        (1..self.times.len()).any(|key| self.row(key) != self.row(0))
    }

    /// The total count of its numbers.
    pub(super) fn numbers(&self) -> usize {
        self.times.len() + self.values.len()
    }

    /// The value of a key; for a spline, the one between its tangents.
    fn row(&self, key: usize) -> &[f64] {
        match self.between {
            Between::Cubic => self.part(key, 1),
            _ => &self.values[key * self.width..][..self.width],
        }
    }

    /// A part of a spline key: 0 for the in-tangent, 1 for the value, 2 for the out-tangent.
    fn part(&self, key: usize, part: usize) -> &[f64] {
        &self.values[(3 * key + part) * self.width..][..self.width]
    }

    /// The value at an instant of a clip with this frame rate; `N` is the width of a row.
    pub(super) fn at<const N: usize>(&self, time: f64, fps: f64) -> [f64; N] {
        let snap = f64::max(ON / fps, SINGLE * time.abs());
        let after = self.times.partition_point(|key| *key <= time + snap);
        let (before, last) = (after.saturating_sub(1), self.times.len() - 1);
        let begin = self.times[before];
        if before == last || time <= begin + snap || self.between == Between::Step {
            return array(self.row(before));
        }
        let length = self.times[after] - begin;
        let share = (time - begin) / length;
        match self.between {
            Between::Cubic => {
                let value = |at: usize| self.spline(before, share, length, at);
                let value: [f64; N] = std::array::from_fn(value);
                value
            }
            _ => between(array(self.row(before)), array(self.row(after)), share),
        }
    }

    /// Evaluates the Hermite spline after a key.
    fn spline(&self, key: usize, share: f64, length: f64, at: usize) -> f64 {
        let (from, to) = (self.part(key, 1)[at], self.part(key + 1, 1)[at]);
        let (out, into) = (self.part(key, 2)[at] * length, self.part(key + 1, 0)[at] * length);
        let (two, three) = (share * share, share * share * share);
        (2.0 * three - 3.0 * two + 1.0) * from
            + (three - 2.0 * two + share) * out
            + (3.0 * two - 2.0 * three) * to
            + (three - two) * into
    }
}

fn array<const N: usize>(row: &[f64]) -> [f64; N] {
    std::array::from_fn(|at| row.get(at).copied().unwrap_or_default())
}

/// Interpolates between two values: linearly, or for rotations, which are four numbers, by slerp along the
/// shorter way.
fn between<const N: usize>(from: [f64; N], to: [f64; N], share: f64) -> [f64; N] {
    if N != 4 {
        return std::array::from_fn(|at| from[at] + share * (to[at] - from[at]));
    }
    let [from, to] = [from, to].map(|row| {
        let row = DVec4::from_array(array(&row)).normalize_or(DVec4::W);
        DQuat::from_vec4(row)
    });
    array(&from.slerp(to, share).to_array())
}
