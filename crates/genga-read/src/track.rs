//! Keys of what the timing does not touch (体以外のキー), and the values between them.

use glam::{DQuat, DVec4};
use serde::{Deserialize, Serialize};

/// What is between two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Between {
    /// The value of the earlier key.
    Step,
    /// A straight line.
    Linear,
    /// The shorter arc between two rotations, of four numbers each.
    Arc,
    /// A Hermite spline. A key has three rows: the slope towards it, its value, the slope from it, per frame.
    Cubic,
}

/// The keys of one property (キー).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Track {
    /// Places of the keys in the source, frame numbers with a fraction, ascending.
    pub places: Vec<f64>,
    /// Rows of the keys, each as wide as `width`.
    pub values: Vec<f64>,
    /// Numbers of a value.
    pub width: usize,
    /// What is between two keys.
    pub between: Between,
}

/// The row of a cubic key that holds its value; the slopes lie around it.
pub(crate) const VALUE: usize = 1;

impl Track {
    /// Number of rows of a key.
    pub(crate) fn rows(&self) -> usize {
        if self.between == Between::Cubic { 3 } else { 1 }
    }

    /// Returns a row of a key: of a cubic one the slope towards it (0), its value (1) or the slope from it (2); the only
    /// row of any other.
    pub fn row(&self, key: usize, row: usize) -> &[f64] {
        let at = if self.between == Between::Cubic { 3 * key + row } else { key };
        &self.values[at * self.width..][..self.width]
    }

    /// Returns the value of a key.
    pub fn value(&self, key: usize) -> &[f64] {
        self.row(key, VALUE)
    }

    /// Writes the value at a place; before the first key that of the first, after the last that of the last.
    ///
    /// # Panics
    ///
    /// If there is no key.
    pub fn write_at(&self, place: f64, value: &mut [f64]) {
        match self.find(place) {
            Some((key, share)) => self.write_between(key, share, value),
            None => {
                let end = if place < self.places[0] { 0 } else { self.places.len() - 1 };
                value.copy_from_slice(self.value(end));
            }
        }
    }

    /// Writes the value after a share of the way from a key to the next.
    pub(crate) fn write_between(&self, key: usize, share: f64, value: &mut [f64]) {
        let (from, to) = (self.value(key), self.value(key + 1));
        match self.between {
            Between::Step => value.copy_from_slice(from),
            Between::Linear => mix(from, to, share, value),
            Between::Arc => arc(from, to, share, value),
            Between::Cubic => {
                let length = self.places[key + 1] - self.places[key];
                let (out, into) = (self.row(key, 2), self.row(key + 1, 0));
                let (two, three) = (share * share, share * share * share);
                for (at, value) in value.iter_mut().enumerate() {
                    *value = (2.0 * three - 3.0 * two + 1.0) * from[at]
                        + (three - 2.0 * two + share) * (out[at] * length)
                        + (3.0 * two - 2.0 * three) * to[at]
                        + (three - two) * (into[at] * length);
                }
            }
        }
    }

    /// Writes the slope of a spline at a place, per frame; 0 outside the keys. On a key, it is the slope from it, or
    /// towards it if `is_before`.
    pub fn write_slope(&self, place: f64, is_before: bool, slope: &mut [f64]) {
        if let Ok(key) = self.places.binary_search_by(|key| key.total_cmp(&place)) {
            let is_outside = key == if is_before { 0 } else { self.places.len() - 1 };
            let row = self.row(key, if is_before { 0 } else { 2 });
            return if is_outside { slope.fill(0.0) } else { slope.copy_from_slice(row) };
        }
        let Some((key, share)) = self.find(place) else { return slope.fill(0.0) };
        let length = self.places[key + 1] - self.places[key];
        let (from, to) = (self.value(key), self.value(key + 1));
        let (out, into) = (self.row(key, 2), self.row(key + 1, 0));
        let two = share * share;
        for (at, slope) in slope.iter_mut().enumerate() {
            *slope = (6.0 * two - 6.0 * share) * (from[at] - to[at]) / length
                + (3.0 * two - 4.0 * share + 1.0) * out[at]
                + (3.0 * two - 2.0 * share) * into[at];
        }
    }

    /// Finds the key before a place between two keys, and the share of the way to the next.
    fn find(&self, place: f64) -> Option<(usize, f64)> {
        let after = self.places.partition_point(|key| *key <= place);
        let (from, to) = (*self.places.get(after.checked_sub(1)?)?, *self.places.get(after)?);
        Some((after - 1, (place - from) / (to - from)))
    }
}

fn mix(from: &[f64], to: &[f64], share: f64, value: &mut [f64]) {
    for ((value, from), to) in value.iter_mut().zip(from).zip(to) {
        *value = from + share * (to - from);
    }
}

fn arc(from: &[f64], to: &[f64], share: f64, value: &mut [f64]) {
    // A quaternion of length 0 is no rotation.
    let rotation = |row: &[f64]| match row {
        [x, y, z, w] => DQuat::from_vec4(DVec4::new(*x, *y, *z, *w).normalize_or(DVec4::W)),
        _ => DQuat::IDENTITY,
    };
    let turned = rotation(from).slerp(rotation(to), share).to_array();
    value.iter_mut().zip(turned).for_each(|(value, turned)| *value = turned);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(between: Between, values: &[f64]) -> Track {
        Track { places: vec![2.0, 4.0, 8.0], values: values.to_vec(), width: 1, between }
    }

    fn at(track: &Track, place: f64) -> f64 {
        let mut value = [0.0];
        track.write_at(place, &mut value);
        value[0]
    }

    #[test]
    fn a_track_holds_its_ends_and_goes_from_key_to_key() {
        let linear = track(Between::Linear, &[1.0, 3.0, -1.0]);
        let places = [0.0, 2.0, 3.0, 4.0, 7.0, 8.0, 9.0];
        assert_eq!(places.map(|place| at(&linear, place)), [1.0, 1.0, 2.0, 3.0, 0.0, -1.0, -1.0]);
        let step = track(Between::Step, &[1.0, 3.0, -1.0]);
        assert_eq!(places.map(|place| at(&step, place)), [1.0, 1.0, 1.0, 3.0, 3.0, -1.0, -1.0]);
    }

    #[test]
    fn a_spline_has_the_values_and_slopes_of_its_keys() {
        let rows = [0.0, 1.0, 0.5, 0.5, 3.0, -1.0, 2.0, -1.0, 0.0];
        let spline = track(Between::Cubic, &rows);
        assert_eq!([2.0, 4.0, 8.0].map(|place| at(&spline, place)), [1.0, 3.0, -1.0]);
        let slope = |place: f64, is_before: bool| {
            let mut slope = [0.0];
            spline.write_slope(place, is_before, &mut slope);
            slope[0]
        };
        assert_eq!([slope(4.0, true), slope(4.0, false)], [0.5, -1.0]);
        for place in [2.5, 5.0, 7.9] {
            let near = (at(&spline, place + 1e-6) - at(&spline, place - 1e-6)) / 2e-6;
            assert!((slope(place, false) - near).abs() < 1e-6, "{place}");
        }
        assert_eq!([slope(9.0, false), slope(2.0, true), slope(8.0, false)], [0.0; 3]);
    }

    #[test]
    fn a_rotation_goes_along_the_shorter_arc() {
        let [from, to] = [0.0, 60.0_f64].map(|angle| DQuat::from_rotation_y(angle.to_radians()));
        let values = [from.to_array(), (-to).to_array()].concat();
        let arc = Track { places: vec![0.0, 2.0], values, width: 4, between: Between::Arc };
        let mut value = [0.0; 4];
        arc.write_at(1.0, &mut value);
        let half = DQuat::from_rotation_y(30_f64.to_radians());
        assert!(DQuat::from_array(value).dot(half).abs() > 1.0 - 1e-12);
    }
}
