//! How near counts come to the paper's Table 1.

use super::readings::Six;
use super::table_1::PAPER;
use crate::table::spread;

/// Six counts beside the paper's.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    /// ln(count/paper) of each; of no key at all as of one.
    logs: [f64; PAPER.len()],
}

impl Fit {
    pub(super) fn of(counts: Six) -> Self {
        let mut logs = [0.0; PAPER.len()];
        for ((log, count), (.., paper)) in logs.iter_mut().zip(counts).zip(PAPER) {
            *log = libm::log(count.max(1) as f64 / paper as f64);
        }
        Self { logs }
    }

    /// The root mean square of ln(count/paper): 0.7 is a factor of 2.
    pub(super) fn error(&self) -> f64 {
        rms(self.logs)
    }

    /// How many times the paper's counts they are: the geometric mean.
    pub(super) fn level(&self) -> f64 {
        libm::exp(self.mean())
    }

    /// The error that is left when the level is taken away.
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

/// The share of keys that the longer persistence costs, at each filter range.
pub(super) fn lost(counts: Six) -> [f64; 3] {
    std::array::from_fn(|at| 1.0 - counts[2 * at + 1] as f64 / counts[2 * at].max(1) as f64)
}

/// The share of keys that the widest filter costs against the narrowest, at the shorter persistence.
pub(super) fn filtered_away(counts: Six) -> f64 {
    1.0 - counts[4] as f64 / counts[0].max(1) as f64
}

/// What the paper counted.
pub(super) fn paper() -> Six {
    PAPER.map(|(.., keys)| keys)
}

/// The middle of some values.
pub(super) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    spread(values)[1]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_papers_own_counts_fit_and_their_double_is_off_in_level_alone() {
        let fit = Fit::of(paper());
        assert_eq!((fit.error(), fit.level(), fit.shape()), (0.0, 1.0, 0.0));
        let fit = Fit::of(paper().map(|keys| 2 * keys));
        assert!((fit.level() - 2.0).abs() < 1e-12 && fit.shape() < 1e-12);
        assert!((fit.error() - libm::log(2.0)).abs() < 1e-12);
        let fit = Fit::of([99, 75, 80, 71, 64, 104]);
        assert!(fit.shape() > 0.2, "{fit:?}");
        assert!(Fit::of([0; 6]).error().is_finite());
    }

    #[test]
    fn the_paper_loses_a_tenth_to_a_quarter_to_the_longer_persistence() {
        let lost = lost(paper()).map(|share| (100.0 * share).round());
        assert_eq!(lost, [24.0, 11.0, 19.0]);
        assert_eq!((100.0 * filtered_away(paper())).round(), 35.0);
    }
}
