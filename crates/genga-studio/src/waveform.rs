//! A waveform (波形): the loudness of a sound over time, fine enough to draw and without its samples.

/// Values per second. Each koma at 24 per second has ten or more.
const FINENESS: u32 = 250;

/// Loudness of a sound from its beginning on.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// Loudest sample of each stretch, relative to the loudest of all: 0 to 1.
    levels: Vec<f32>,
    /// Stretches per second.
    per_second: f64,
}

impl Waveform {
    /// Builds the waveform of a sound. `samples` are interleaved by channel, and each channel has `rate` of them a
    /// second.
    ///
    /// ```
    /// use genga_studio::Waveform;
    ///
    /// let samples = (0..8000).map(|at| if at < 4000 { 0.0 } else { 0.25 });
    /// let waveform = Waveform::new(samples, 1, 8000);
    /// assert_eq!((waveform.seconds(), waveform.level(0.0, 0.4), waveform.level(0.4, 0.6)), (1.0, 0.0, 1.0));
    /// ```
    pub fn new(samples: impl IntoIterator<Item = f32>, channels: u16, rate: u32) -> Self {
        let stretch = usize::from(channels.max(1)) * (rate / FINENESS).max(1) as usize;
        let per_second = f64::from(rate) / f64::from((rate / FINENESS).max(1));
        let (mut levels, mut loudest, mut count) = (Vec::new(), 0.0_f32, 0);
        for sample in samples {
            // Infinite and NaN samples are ignored.
            if sample.is_finite() {
                loudest = loudest.max(sample.abs());
            }
            count += 1;
            if count == stretch {
                levels.push(loudest);
                (loudest, count) = (0.0, 0);
            }
        }
        if count > 0 {
            levels.push(loudest);
        }
        let most = levels.iter().copied().fold(0.0, f32::max);
        if most > 0.0 {
            levels.iter_mut().for_each(|level| *level /= most);
        }
        Self { levels, per_second }
    }

    /// Length in seconds.
    pub fn seconds(&self) -> f64 {
        self.levels.len() as f64 / self.per_second
    }

    /// Greatest loudness between two seconds, 0 to 1. It is 0 before the beginning and after the end.
    pub fn level(&self, from: f64, to: f64) -> f32 {
        let at = |second: f64| (second * self.per_second).clamp(0.0, self.levels.len() as f64);
        let (first, past) = (at(from).floor() as usize, at(to).ceil() as usize);
        self.levels[first..past.max(first)].iter().copied().fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_level_is_that_of_the_loudest_sample_there(
            samples in prop::collection::vec(-1.0_f32..1.0, 1..4000), from in 0.0_f64..2.0, wide in 0.01_f64..1.0,
        ) {
            // Two channels, so 8 samples a stretch.
            let waveform = Waveform::new(samples.iter().copied(), 2, 1000);
            let most = samples.iter().fold(0.0_f32, |most, sample| most.max(sample.abs()));
            let first = (from * 250.0).floor() as usize * 8;
            let past = (((from + wide) * 250.0).ceil() as usize * 8).min(samples.len());
            let there = samples.get(first..past).unwrap_or_default();
            let loudest = there.iter().fold(0.0_f32, |most, sample| most.max(sample.abs()));
            let found = waveform.level(from, from + wide);
            prop_assert!((found - loudest / most.max(f32::MIN_POSITIVE)).abs() < 1e-5, "{} {}", found, loudest);
        }
    }

    #[test]
    fn silence_and_nothing_are_no_trouble() {
        for samples in [vec![], vec![0.0; 100], vec![f32::NAN; 100], vec![f32::INFINITY; 3]] {
            let waveform = Waveform::new(samples, 1, 48_000);
            assert!((0.0..=1.0).contains(&waveform.level(-5.0, 5.0)));
            assert_eq!(waveform.level(9.0, 3.0), 0.0);
        }
        assert_eq!(Waveform::new([0.5; 50], 0, 8).seconds(), 50.0 / 8.0);
    }
}
