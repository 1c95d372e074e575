//! Measures how near counts come to the paper's Table 1.

use super::readings::Six;
use super::table_1::PAPER;
use crate::table::spread;

/// Six counts compared with the paper's.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// ln(count/paper) of each; a count of 0 is taken as 1.
    logs: [f64; PAPER.len()],
}

impl Fit {
    pub(super) fn new(counts: Six) -> Self {
        let mut logs = [0.0; PAPER.len()];
        for ((log, count), (.., paper)) in logs.iter_mut().zip(counts).zip(PAPER) {
            *log = libm::log(count.max(1) as f64 / paper as f64);
        }
        Self { logs }
    }

    /// Root mean square of ln(count/paper): 0.7 is a factor of 2.
    pub(super) fn error(&self) -> f64 {
        rms(self.logs)
    }

    /// Geometric mean of count/paper.
    pub(super) fn level(&self) -> f64 {
        libm::exp(self.mean())
    }

    /// The error that remains without the level.
    pub(super) fn shape(&self) -> f64 {
        rms(self.logs.map(|log| log - self.mean()))
    }

    fn mean(&self) -> f64 {
        self.logs.iter().sum::<f64>() / self.logs.len() as f64
    }
}

fn rms(values: [f64; PAPER.len()]) -> f64 {
    (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt()
}

/// Share of keys lost to the longer persistence, at each filter range.
pub(super) fn lost(counts: Six) -> [f64; 3] {
    std::array::from_fn(|at| 1.0 - counts[2 * at + 1] as f64 / counts[2 * at].max(1) as f64)
}

/// Share of keys lost to the widest filter compared with the narrowest, at the shorter persistence.
pub(super) fn filtered_away(counts: Six) -> f64 {
    1.0 - counts[4] as f64 / counts[0].max(1) as f64
}

/// The paper's counts.
pub(super) fn paper() -> Six {
    PAPER.map(|(.., keys)| keys)
}

/// The median.
pub(super) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    spread(values)[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_own_counts_fit_and_their_double_is_off_in_level_alone() {
        let fit = Fit::new(paper());
        assert_eq!((fit.error(), fit.level(), fit.shape()), (0.0, 1.0, 0.0));
        let fit = Fit::new(paper().map(|keys| 2 * keys));
        assert!((fit.level() - 2.0).abs() < 1e-12 && fit.shape() < 1e-12);
        assert!((fit.error() - libm::log(2.0)).abs() < 1e-12);
        let fit = Fit::new([99, 75, 80, 71, 64, 104]);
        assert!(fit.shape() > 0.2, "{fit:?}");
        assert!(Fit::new([0; 6]).error().is_finite());
    }

    #[test]
    fn the_paper_loses_a_tenth_to_a_quarter_to_the_longer_persistence() {
        let lost = lost(paper()).map(|share| (100.0 * share).round());
        assert_eq!(lost, [24.0, 11.0, 19.0]);
        assert_eq!((100.0 * filtered_away(paper())).round(), 35.0);
    }
}
