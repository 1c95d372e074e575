use std::f64::consts::PI;

use nalgebra::DMatrix;
use proptest::prelude::*;

use super::FilterKind::{Box, Butterworth, Gaussian, Ideal};
use super::*;
use crate::motion::JointId;
use crate::signal::Quantity;
use crate::time::Frame;

const KINDS: [FilterKind; 4] = [Box, Gaussian, Ideal, Butterworth];
const WIDTHS: [f64; 10] = [0.0, 1.0, 1.5, 2.0, 3.0, 7.0, 20.0, 21.0, 33.3, 130.7];

fn signals(values: DMatrix<f64>) -> Signals {
    Signals { values, unit: Quantity::Angle, rate: FrameRate::new(120.0).unwrap(), first: Frame(5) }
}

fn column(values: &[f64]) -> Signals {
    signals(DMatrix::from_column_slice(values.len(), 1, values))
}

fn filter(kind: FilterKind, width: f64, values: &[f64]) -> Vec<f64> {
    let filter = LowPass { kind, width: Span::Frames(width) };
    let filtered = filter.apply(&Spectrum::new(&column(values)));
    filtered.values.as_slice().to_vec()
}

/// Values that look random and are always the same.
fn noise(frames: usize) -> Vec<f64> {
    let mut state = 1u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / 1e6
    };
    (0..frames).map(|_| next()).collect()
}

/// The frame that stands at `n` in the endless mirrored clip.
fn mirrored(n: i64, frames: usize) -> usize {
    let place = n.rem_euclid(2 * frames as i64) as usize;
    if place < frames { place } else { 2 * frames - 1 - place }
}

/// The slow way: every tap times every frame.
fn convolved(values: &[f64], reach: i64, tap: impl Fn(i64) -> f64) -> Vec<f64> {
    let whole: f64 = (-reach..=reach).map(&tap).sum();
    let at = |n: i64, m: i64| tap(m) * values[mirrored(n + m, values.len())];
    let frame = |n: i64| (-reach..=reach).map(|m| at(n, m)).sum::<f64>() / whole;
    (0..values.len() as i64).map(frame).collect()
}

/// Returns the three steps in which an edge of the window falls, each with its place. Searches for the least last step
/// with which they sum to 1, lie at W/2 on average and have squares that sum to 1/2.
fn steps(width: f64) -> [(f64, f64); 3] {
    let middle = (width / 2.0).floor() + 0.5;
    let beyond = middle - width / 2.0;
    let sizes = |last: f64| [last + beyond, 1.0 - beyond - 2.0 * last, last];
    let squares = |last: f64| sizes(last).iter().map(|size| size * size).sum::<f64>();
    let (mut low, mut high) = (0.0, 1.0 / 3.0 - beyond / 2.0);
    for _ in 0..200 {
        let between = (low + high) / 2.0;
        if squares(between) > 0.5 { low = between } else { high = between }
    }
    let [first, second, third] = sizes(low);
    [(middle - 1.0, first), (middle, second), (middle + 1.0, third)]
}

/// Returns what the steps of both edges leave of frame m.
fn box_tap(width: f64, m: i64) -> f64 {
    let fallen = |place: f64| -> f64 {
        steps(width).iter().filter(|(step, _)| *step < place).map(|(_, size)| size).sum()
    };
    1.0 - fallen(m as f64) - fallen(-m as f64)
}

/// The slow way: a sum over all frames for every cosine, and back.
fn without_short_periods(values: &[f64], width: f64) -> Vec<f64> {
    let frames = values.len() as f64;
    let wave = |k: usize, n: usize| (PI * k as f64 * (2 * n + 1) as f64 / (2.0 * frames)).cos();
    let size = |k: usize| -> f64 {
        let sum: f64 = values.iter().enumerate().map(|(n, value)| value * wave(k, n)).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / frames
    };
    let kept: Vec<(usize, f64)> = (0..values.len())
        .filter(|k| *k == 0 || 2.0 * frames / *k as f64 >= width)
        .map(|k| (k, size(k)))
        .collect();
    (0..values.len()).map(|n| kept.iter().map(|(k, size)| size * wave(*k, n)).sum()).collect()
}

/// The slow way: the recursive filter run forward, then back, over many mirrored copies.
fn forward_and_back(values: &[f64], width: f64) -> Vec<f64> {
    let lead = (20.0 * width) as i64;
    let mut long: Vec<f64> =
        (-lead..values.len() as i64 + lead).map(|n| values[mirrored(n, values.len())]).collect();
    second_order(&mut long, width);
    long.reverse();
    second_order(&mut long, width);
    long.reverse();
    long[lead as usize..lead as usize + values.len()].to_vec()
}

fn second_order(values: &mut [f64], width: f64) {
    let c = (PI / width).tan();
    let norm = 1.0 / (1.0 + 2f64.sqrt() * c + c * c);
    let b = c * c * norm;
    let (a1, a2) = (2.0 * (c * c - 1.0) * norm, (1.0 - 2f64.sqrt() * c + c * c) * norm);
    let (mut x1, mut x2, mut y1, mut y2) = (values[0], values[0], values[0], values[0]);
    for value in values {
        let y = b * (*value + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
        (x2, x1, y2, y1) = (x1, *value, y1, y);
        *value = y;
    }
}

fn slow(kind: FilterKind, width: f64, values: &[f64]) -> Vec<f64> {
    let narrowest = match kind {
        Box => 0.0,
        Gaussian => 1.0,
        Ideal | Butterworth => 2.0,
    };
    if width <= narrowest {
        return values.to_vec();
    }
    let sigma = width / 6.0;
    match kind {
        Box => convolved(values, width as i64 + 1, |m| box_tap(width, m)),
        Gaussian => convolved(values, (10.0 * sigma) as i64 + 1, |m| {
            (-0.5 * (m as f64 / sigma).powi(2)).exp()
        }),
        Ideal => without_short_periods(values, width),
        Butterworth => forward_and_back(values, width),
    }
}

#[test]
fn settings_refuse_what_is_no_width() {
    for width in [-1.0, f64::NAN, f64::INFINITY] {
        for width in [Span::Frames(width), Span::Seconds(width)] {
            let error = LowPass { width, ..LowPass::default() }.validate().unwrap_err();
            assert!(error.to_string().starts_with("filter.width: "), "{error}");
        }
    }
    for width in [Span::Frames(0.0), Span::Frames(0.5), Span::Seconds(0.2)] {
        assert!(LowPass { width, ..LowPass::default() }.validate().is_ok());
    }
    assert!(toml::from_str::<LowPass>("kind = \"butterworth\"\nwidth = 20").is_ok());
    for wrong in ["kind = \"median\"", "width = -1", "size = 3"] {
        assert!(toml::from_str::<LowPass>(wrong).is_err(), "{wrong}");
    }
    let default: LowPass = toml::from_str("").unwrap();
    assert_eq!(default, LowPass { kind: Box, width: Span::Seconds(0.15) });
}

#[test]
fn every_filter_equals_its_slow_way_at_every_length_and_width() {
    for kind in KINDS {
        for frames in 1..=40 {
            let values = noise(frames);
            for width in WIDTHS {
                let (fast, slow) = (filter(kind, width, &values), slow(kind, width, &values));
                for (fast, slow) in fast.iter().zip(&slow) {
                    let near = (fast - slow).abs() < 1e-9;
                    assert!(near, "{kind:?} {width} on {frames} frames: {fast} for {slow}");
                }
            }
        }
    }
}

#[test]
fn a_running_sum_equals_the_spectrum_on_a_long_clip_and_does_not_drift() {
    let mut values = noise(5000);
    values[4000..].fill(0.0);
    let spectrum = Spectrum::new(&column(&values));
    for width in [0.4, 1.5, 12.0, 13.0, 100.4, 2047.0, 4998.0, 9990.0] {
        let summed = Window::within(width, 5000).unwrap().means(spectrum.unfiltered());
        let by_waves = spectrum.times(&Box.response(width, 5000));
        let apart = (&summed.values - &by_waves.values).amax();
        assert!(apart < 1e-9 * by_waves.values.amax(), "{width}: {apart}");
    }
    assert!(Window::within(13.0, 7).is_some() && Window::within(14.0, 7).is_none());
    let still = filter(Box, 12.0, &values)[4200..].iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    assert!(still < 1e-8, "what stands still stays so but for rounding: {still}");
}

/// Returns the weights of the box, from its answer to a single 1.
fn box_taps(width: f64) -> Vec<f64> {
    let mut values = [0.0; 201];
    values[100] = 1.0;
    filter(Box, width, &values)
}

#[test]
fn a_window_of_20_has_half_weight_on_its_outer_taps_and_one_of_21_falls_in_sixths() {
    for (width, edge) in [(20.0, [1.0, 0.5, 0.0, 0.0]), (21.0, [1.0, 5.0 / 6.0, 1.0 / 6.0, 0.0])] {
        let taps = box_taps(width);
        for (at, weight) in edge.iter().enumerate() {
            for tap in [taps[100 + 9 + at], taps[100 - 9 - at]] {
                assert!((tap - weight / width).abs() < 1e-15, "{width} {at}: {tap}");
            }
        }
    }
}

#[test]
fn no_width_lets_more_noise_into_the_acceleration_than_those_beside_it() {
    for tenths in 20..600 {
        let width = f64::from(tenths) / 10.0;
        let taps = box_taps(width);
        // Frames with equal noise give an acceleration of that variance.
        let variance: f64 = taps.windows(2).map(|pair| (pair[1] - pair[0]).powi(2)).sum();
        assert!((variance * width * width - 1.0).abs() < 1e-9, "{width}: {variance}");
        let wide: f64 = taps.iter().sum::<f64>() / taps[100];
        assert!((wide - width).abs() < 1e-9, "{width} is {wide} wide");
    }
}

#[test]
fn a_box_goes_evenly_from_no_filter_to_any_width() {
    let values = noise(50);
    let apart = |a: f64, b: f64| {
        let (a, b) = (filter(Box, a, &values), filter(Box, b, &values));
        a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let largest = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    for tenths in 0..400 {
        let width = f64::from(tenths) / 10.0;
        assert!(apart(width, width + 1e-6) < 1e-5 * largest, "{width}");
    }
}

#[test]
fn a_width_that_is_no_filter_returns_the_very_values() {
    let values = noise(17);
    for (kind, widest) in [(Box, 0.0), (Gaussian, 1.0), (Ideal, 2.0), (Butterworth, 2.0)] {
        for width in [0.0, widest / 3.0, widest] {
            assert_eq!(filter(kind, width, &values), values, "{kind:?} {width}");
        }
        assert_ne!(filter(kind, widest + 1.5, &values), values, "{kind:?}");
    }
}

#[test]
fn clips_without_frames_or_joints_and_of_one_frame_pass() {
    for kind in KINDS {
        for (frames, joints) in [(0, 0), (0, 3), (4, 0), (1, 3)] {
            let before = signals(DMatrix::from_element(frames, joints, 4.0));
            let filter = LowPass { kind, width: Span::Frames(5.0) };
            assert_eq!(filter.apply(&Spectrum::new(&before)), before);
        }
    }
}

#[test]
fn every_joint_is_filtered_by_itself_and_keeps_unit_rate_and_first_frame() {
    let (a, b) = (noise(30), noise(60)[30..].to_vec());
    let both = signals(DMatrix::from_column_slice(30, 2, &[a.clone(), b.clone()].concat()));
    for kind in KINDS {
        let filtered = LowPass { kind, width: Span::Frames(6.5) }.apply(&Spectrum::new(&both));
        assert_eq!(filtered.joint(JointId(0)), filter(kind, 6.5, &a));
        assert_eq!(filtered.joint(JointId(1)), filter(kind, 6.5, &b));
        assert_eq!(
            (filtered.unit, filtered.rate, filtered.first),
            (both.unit, both.rate, both.first)
        );
    }
}

#[test]
fn a_width_in_seconds_follows_the_rate() {
    let values = noise(30);
    let spectrum = Spectrum::new(&column(&values));
    let filter = |width| LowPass { kind: Box, width }.apply(&spectrum);
    assert_eq!(filter(Span::Seconds(0.1)), filter(Span::Frames(12.0)));
}

#[test]
fn the_delay_is_a_share_of_the_width_in_frames() {
    let rate = FrameRate::new(60.0).unwrap();
    for (kind, share) in
        [(Box, 0.5), (Gaussian, 1.0 / 3.0), (Ideal, 1.0 / 3.0), (Butterworth, 1.0 / 3.0)]
    {
        let delay = |width| LowPass { kind, width }.delay(rate);
        assert_eq!(delay(Span::Frames(21.0)), 21.0 * share);
        assert_eq!(delay(Span::Seconds(0.2)), 12.0 * share);
        assert_eq!(delay(Span::Frames(0.0)), 0.0, "no filter eats nothing");
    }
}

#[test]
fn a_joint_that_does_not_move_stays_exactly_still() {
    for kind in KINDS {
        for frames in 2..20 {
            assert_eq!(filter(kind, 7.0, &vec![0.0; frames]), vec![0.0; frames]);
        }
    }
}

#[test]
fn a_very_wide_filter_gives_the_mean() {
    let values = noise(25);
    let mean = values.iter().sum::<f64>() / 25.0;
    for kind in KINDS {
        for width in [1e6, 1e15, 1e300] {
            for value in filter(kind, width, &values) {
                assert!((value - mean).abs() < 1e-3, "{kind:?} {width}: {value} for {mean}");
            }
        }
    }
}

proptest! {
    #[test]
    fn length_and_mean_are_kept(
        values in prop::collection::vec(-100.0..100.0, 1..80),
        kind in prop::sample::select(&KINDS[..]),
        width in 0.0..120.0,
    ) {
        let filtered = filter(kind, width, &values);
        prop_assert_eq!(filtered.len(), values.len());
        let lost = values.iter().sum::<f64>() - filtered.iter().sum::<f64>();
        prop_assert!(lost.abs() < 1e-9, "{}", lost);
    }

    #[test]
    fn filters_are_linear(
        values in prop::collection::vec((-100.0..100.0, -100.0..100.0), 1..80),
        kind in prop::sample::select(&KINDS[..]),
        width in 0.0..120.0,
        factor in -3.0..3.0,
    ) {
        let (a, b): (Vec<f64>, Vec<f64>) = values.into_iter().unzip();
        let sum: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + factor * b).collect();
        let (a, b): (Vec<f64>, Vec<f64>) = (filter(kind, width, &a), filter(kind, width, &b));
        for (n, found) in filter(kind, width, &sum).iter().enumerate() {
            let expected: f64 = a[n] + factor * b[n];
            prop_assert!((found - expected).abs() < 1e-9);
        }
    }

    #[test]
    fn a_constant_stays(
        value in -100.0..100.0,
        frames in 1..80usize,
        kind in prop::sample::select(&KINDS[..]),
        width in 0.0..120.0,
    ) {
        for found in filter(kind, width, &vec![value; frames]) {
            prop_assert!((found - value).abs() < 1e-11);
        }
    }

    #[test]
    fn a_clip_backwards_is_filtered_backwards(
        mut values in prop::collection::vec(-100.0..100.0, 1..80),
        kind in prop::sample::select(&KINDS[..]),
        width in 0.0..120.0,
    ) {
        let forth = filter(kind, width, &values);
        values.reverse();
        for (back, forth) in filter(kind, width, &values).iter().rev().zip(&forth) {
            prop_assert!((back - forth).abs() < 1e-10, "no shift in time");
        }
    }
}
