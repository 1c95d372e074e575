//! A waveform (波形): how loud a sound is, so fine that it can be drawn, and without its samples.

/// Values a second. A koma at 24 a second has ten and more of them.
const FINENESS: u32 = 250;

/// How loud a sound is from its beginning on.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// The loudest sample of each stretch, beside the loudest of all: 0 to 1.
    levels: Vec<f32>,
    /// Stretches a second.
    per_second: f64,
}

impl Waveform {
    /// Listens to the samples of a sound, those of all channels one after the other, so many a second.
    ///
    /// ```
    /// use genga::studio::Waveform;
    ///
    /// let samples = (0..8000).map(|at| if at < 4000 { 0.0 } else { 0.25 });
    /// let waveform = Waveform::of(samples, 1, 8000);
    /// assert_eq!((waveform.seconds(), waveform.level(0.0, 0.4), waveform.level(0.4, 0.6)), (1.0, 0.0, 1.0));
    /// ```
    pub fn of(samples: impl IntoIterator<Item = f32>, channels: u16, rate: u32) -> Self {
        let stretch = usize::from(channels.max(1)) * (rate / FINENESS).max(1) as usize;
        let per_second = f64::from(rate) / f64::from((rate / FINENESS).max(1));
        let (mut levels, mut loudest, mut count) = (Vec::new(), 0.0_f32, 0);
        for sample in samples {
            // What is no number is not heard.
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

    /// How long it is.
    pub fn seconds(&self) -> f64 {
        self.levels.len() as f64 / self.per_second
    }

    /// How loud it is at the most from one second to another, 0 to 1; nothing before and behind it.
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
            // Of two channels, 8 samples a stretch.
            let waveform = Waveform::of(samples.iter().copied(), 2, 1000);
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
            let waveform = Waveform::of(samples, 1, 48_000);
            assert!((0.0..=1.0).contains(&waveform.level(-5.0, 5.0)));
            assert_eq!(waveform.level(9.0, 3.0), 0.0);
        }
        assert_eq!(Waveform::of([0.5; 50], 0, 8).seconds(), 50.0 / 8.0);
    }
}
