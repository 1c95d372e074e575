//! Curves through the channels of a rig, which are plain numbers and no joints.

use glam::DVec4;

use super::samples::Samples;
use super::spline::Tangents;

/// Finds the tangents of cubic curves through some channels that bring the curves closest to samples of them.
///
/// `samples` are frames × channels, the last index fastest. `keys` are frames from 0, two or more in order of time. The
/// result is keys × channels: the change of the value per frame.
///
/// # Panics
/// If `samples` are no whole number of frames.
pub fn tangents(keys: &[f64], samples: &[f64], channels: usize) -> Vec<f64> {
    assert_eq!(samples.len() % channels.max(1), 0, "each frame has a sample of each channel");
    let solver = Tangents::new(keys);
    let mut found = vec![0.0; keys.len() * channels];
    let mut values = vec![DVec4::ZERO; samples.len() / channels.max(1)];
    for first in (0..channels).step_by(4) {
        let own = first..channels.min(first + 4);
        for (value, row) in values.iter_mut().zip(samples.chunks_exact(channels)) {
            let mut four = [0.0; 4];
            four[..own.len()].copy_from_slice(&row[own.clone()]);
            *value = four.into();
        }
        let samples = Samples::of_numbers(&values);
        let at_keys: Vec<DVec4> = keys.iter().map(|key| samples.at(*key)).collect();
        let solved = solver.solve(samples, &at_keys);
        for (row, tangent) in found.chunks_exact_mut(channels).zip(solved) {
            row[own.clone()].copy_from_slice(&tangent.to_array()[..own.len()]);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tangents_of_channels_that_are_cubic_are_their_slopes() {
        let curves: [fn(f64) -> [f64; 2]; 5] = [
            |t| [2.0, 0.0 * t],
            |t| [3.0 * t, 3.0],
            |t| [t * t, 2.0 * t],
            |t| [0.1 * t * t * t - t, 0.3 * t * t - 1.0],
            |t| [-0.5 * t * t * t, -1.5 * t * t],
        ];
        let frames = (0..21).map(f64::from);
        let samples: Vec<f64> = frames.flat_map(|t| curves.map(|curve| curve(t)[0])).collect();
        let keys = [0.0, 3.0, 11.0, 20.0];
        let found = tangents(&keys, &samples, curves.len());
        for (key, row) in keys.iter().zip(found.chunks_exact(curves.len())) {
            for (at, tangent) in row.iter().enumerate() {
                // The small weight of the take's own velocity, a difference of samples, moves it a little.
                let slope = curves[at](*key)[1];
                assert!((tangent - slope).abs() < 0.05, "{at} at {key}: {tangent} {slope}");
            }
        }
        assert_eq!(tangents(&keys, &[], 0), [0.0; 0]);
    }
}
