//! Evaluates a curve: its keys and the interpolation between them.

use super::accessor::{self, Numbers};
use super::buffers::Buffers;
use super::document::{Document, Sampler};
use super::wrong;
use crate::reading::Options;
use crate::track::{Between, Track, VALUE};
use genga::error::Error;

/// Largest distance at which an instant counts as on a key, as a share of a frame: key times are
/// single-precision floats.
const ON: f64 = 1e-3;

/// Relative rounding error of single-precision floats.
const SINGLE: f64 = 1.2e-7;

/// The keys of one property of one node, on the seconds of the file.
#[derive(Debug)]
pub(super) struct Curve(Track);

/// Numbers of curves that may still be taken into memory. A sampler that many channels name is read for each of them.
pub(super) struct Room {
    left: u64,
}

impl Room {
    pub(super) fn new(options: &Options) -> Self {
        Self { left: options.stream.bytes / 8 }
    }

    /// Takes the room of a curve.
    pub(super) fn take(&mut self, Curve(track): &Curve, part: &str) -> Result<(), Error> {
        let numbers = (track.places.len() + track.values.len()) as u64;
        let message =
            "its curves have more numbers than are taken into memory; --memory GIB allows more";
        self.left = self.left.checked_sub(numbers).ok_or_else(|| wrong(part, message))?;
        Ok(())
    }
}

impl Curve {
    /// Reads the curve of a sampler, whose rows are `width` wide; those of 4 numbers are rotations. Without a width they are
    /// as many numbers as there are for a key.
    pub(super) fn read(
        document: &Document,
        buffers: &mut Buffers<'_>,
        sampler: &Sampler,
        width: Option<usize>,
        part: &str,
    ) -> Result<Self, Error> {
        let mut numbers = |accessor, part: &str| accessor::read(document, buffers, accessor, part);
        let Numbers { width: one, values: places } =
            numbers(sampler.input, &format!("{part}.input"))?;
        let Numbers { width: found, values } = numbers(sampler.output, &format!("{part}.output"))?;
        let between = match sampler.interpolation.as_deref() {
            None | Some("LINEAR") if width == Some(4) => Between::Arc,
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
        let mut track = Track { places, values, width: wide, between };
        let (keys, rows) = (track.places.len(), track.rows());
        track.width = width.unwrap_or_else(|| (track.values.len() / (rows * keys).max(1)).max(1));
        if keys == 0 || track.values.len() != keys * rows * track.width {
            let have = track.values.len() / track.width;
            return Err(wrong(
                part,
                format!("{keys} keys need {} rows, found {have}", keys * rows),
            ));
        }
        // Two keys may share an instant, as in files of Sketchfab; the second counts.
        let is_back = |pair: &[f64]| pair[0] > pair[1] || pair[1].is_nan();
        if let Some(key) = track.places.windows(2).position(is_back) {
            return Err(wrong(part, format!("key {} is earlier than the one before it", key + 1)));
        }
        if !track.places[0].is_finite() || !track.places[keys - 1].is_finite() {
            return Err(wrong(part, "the time of a key is no number"));
        }
        Ok(Self(track))
    }

    /// The times of the keys, in seconds.
    pub(super) fn times(&self) -> &[f64] {
        &self.0.places
    }

    /// Returns the keys at places of a clip, whose first frame is at the time `begin`. Of two keys at one time the second
    /// counts.
    pub(super) fn track(&self, begin: f64, fps: f64) -> Track {
        let Track { width, between, .. } = self.0;
        let (mut places, mut values) = (Vec::new(), Vec::new());
        for (key, time) in self.times().iter().enumerate() {
            if self.times().get(key + 1) == Some(time) {
                continue;
            }
            places.push((time - begin) * fps);
            for row in 0..self.0.rows() {
                // Slopes are per second in a file, and per frame in a track.
                let is_slope = between == Between::Cubic && row != VALUE;
                let scale = if is_slope { fps } else { 1.0 };
                values.extend(self.0.row(key, row).iter().map(|value| value / scale));
            }
        }
        Track { places, values, width, between }
    }

    /// Whether the value varies over time.
    pub(super) fn moves(&self) -> bool {
        (1..self.times().len()).any(|key| self.0.value(key) != self.0.value(0))
    }

    /// The value at an instant of a clip with this frame rate; `N` is the width of a row.
    pub(super) fn at<const N: usize>(&self, time: f64, fps: f64) -> [f64; N] {
        let (track, times) = (&self.0, self.times());
        let snap = f64::max(ON / fps, SINGLE * time.abs());
        let after = times.partition_point(|key| *key <= time + snap);
        let (before, last) = (after.saturating_sub(1), times.len() - 1);
        let begin = times[before];
        let mut value = [0.0; N];
        if before == last || time <= begin + snap {
            value.copy_from_slice(track.value(before));
        } else {
            track.write_between(before, (time - begin) / (times[after] - begin), &mut value);
        }
        value
    }
}
