//! Finds round values along an axis.

use genga::maths;

/// A step: 1, 2 or 5 times a power of ten.
#[derive(Debug, Clone, Copy)]
struct Step {
    digit: f64,
    power: i32,
}

impl Step {
    /// Returns `count` steps. Negative powers are divisions: dividing by a power of ten is correct to the
    /// last digit, multiplying by a tenth is not.
    fn times(self, count: f64) -> f64 {
        let power = 10_f64.powi(self.power.abs());
        if self.power < 0 { count * self.digit / power } else { count * self.digit * power }
    }

    /// Returns the first and the last multiple within a range, as numbers of steps. A multiple that is
    /// outside by rounding alone counts as within.
    fn within(self, (low, high): (f64, f64)) -> (f64, f64) {
        let size = self.times(1.0);
        ((low / size - 1e-9).ceil(), (high / size + 1e-9).floor())
    }

    fn finer(self) -> Self {
        match self.digit {
            5.0 => Self { digit: 2.0, ..self },
            2.0 => Self { digit: 1.0, ..self },
            _ => Self { digit: 5.0, power: self.power - 1 },
        }
    }
}

/// Returns the multiples within a range of the finest step that has at most `most` of them; `most` is at
/// least 2.
pub(super) fn round_values(range: (f64, f64), most: usize) -> Vec<f64> {
    // Halves, because the difference of two numbers may overflow.
    let extent = 0.5 * range.1 - 0.5 * range.0;
    let mut step =
        Step { digit: 5.0, power: maths::log10(extent).floor().clamp(-300.0, 300.0) as i32 + 1 };
    let fits = |step: Step| {
        let (first, last) = step.within(range);
        last - first < most as f64 && step.power > -300
    };
    while fits(step.finer()) {
        step = step.finer();
    }
    let (first, last) = step.within(range);
    let count = (last - first).clamp(-1.0, most as f64 - 1.0) + 1.0;
    (0..count as usize).map(|at| step.times(first + at as f64)).collect()
}

#[cfg(test)]
mod tests {
    use plotters::coord::ranged1d::Ranged;
    use plotters::coord::types::RangedCoordf64;

    use super::*;

    #[test]
    fn they_are_those_of_the_library_of_charts() {
        let mut seed = 1_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed >> 8) / f64::from(1 << 24)
        };
        for _ in 0..2000 {
            let extent = 10_f64.powf(6.0 * random() - 2.0);
            let low = (random() - 0.5) * extent;
            let range = (low, low + extent);
            let most = 2 + (20.0 * random()) as usize;
            let expected = RangedCoordf64::from(low..low + extent).key_points(most);
            let found = round_values(range, most);
            // The library sometimes loses the last value to rounding.
            let lost = found.len() - expected.len();
            assert!(lost <= 1, "{range:?}, {most}: {found:?}, {expected:?}");
            assert!(*found.last().unwrap() <= range.1 && found.len() <= most, "{range:?}, {most}");
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-9 * extent, "{range:?}, {most}");
            }
        }
    }

    #[test]
    fn they_are_whole_and_decimal_numbers_to_the_last_digit() {
        assert_eq!(
            round_values((0.0, 1.0), 11),
            [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0]
        );
        assert_eq!(round_values((0.0, 1000.0), 3), [0.0, 500.0, 1000.0]);
        assert_eq!(round_values((-20.0, 43.0), 4), [-20.0, 0.0, 20.0, 40.0]);
        assert_eq!(round_values((0.0, 0.003), 4), [0.0, 0.001, 0.002, 0.003]);
    }

    #[test]
    fn odd_ranges_end() {
        for range in [
            (f64::MIN, f64::MAX),
            (1e300, 1e300 + 1e285),
            (0.0, f64::MIN_POSITIVE),
            (1.0, 1.0f64.next_up()),
        ] {
            assert!(round_values(range, 5).len() <= 5, "{range:?}");
        }
    }
}
