//! Pseudo-random numbers (乱数), the same for the same seed on every machine.

const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Returns a random-looking number for each number (the finaliser of SplitMix64).
pub fn mixed(number: u64) -> u64 {
    let mut mixed = number.wrapping_add(STEP);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// A sequence of random numbers (SplitMix64).
#[derive(Debug, Clone)]
pub struct Lots(u64);

impl Lots {
    /// Creates the sequence of a seed. Neighbouring seeds have nothing in common.
    pub fn new(seed: u64) -> Self {
        Self(mixed(seed))
    }

    fn next(&mut self) -> u64 {
        let lot = mixed(self.0);
        self.0 = self.0.wrapping_add(STEP);
        lot
    }

    /// Draws a number from 0 up to but not including 1.
    pub fn share(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Draws a whole number from 0 up to but not including `end`, which is above 0.
    pub fn below(&mut self, end: usize) -> usize {
        ((u128::from(self.next()) * end as u128) >> 64) as usize
    }

    /// Draws a nearly normal number of mean 0 and deviation 1: the sum of twelve even ones, which needs no logarithm.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.share()).sum::<f64>() - 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lots_are_even_and_of_their_seed() {
        let row = |seed| {
            let mut lots = Lots::new(seed);
            (0..6000).map(|_| lots.below(6)).collect::<Vec<_>>()
        };
        let (one, other) = (row(1), row(2));
        assert_eq!(one, row(1));
        for face in 0..6 {
            let count = one.iter().filter(|lot| **lot == face).count();
            // Five standard deviations.
            assert!(count.abs_diff(1000) < 145, "{face}: {count}");
        }
        let same = one.iter().zip(&other).filter(|(a, b)| a == b).count();
        assert!(same.abs_diff(1000) < 145, "{same} of neighbouring seeds are the same");
    }

    #[test]
    fn normal_lots_have_a_mean_of_0_and_a_deviation_of_1() {
        let mut lots = Lots::new(7);
        let row: Vec<f64> = (0..10_000).map(|_| lots.normal()).collect();
        let mean = row.iter().sum::<f64>() / 1e4;
        let square = row.iter().map(|lot| lot * lot).sum::<f64>() / 1e4;
        assert!(mean.abs() < 0.05 && (square - 1.0).abs() < 0.07, "{mean} {square}");
    }
}
