//! The noise of capture: small, band-limited unrest, identical on every run.

use std::f64::consts::TAU;

/// A splitmix64 generator.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform over `from..to`.
    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }
}

/// A sum of sines at random frequencies within a band.
pub(crate) struct Noise {
    /// Amplitude, frequency in turns a second, phase in radians.
    sines: Vec<[f64; 3]>,
}

impl Noise {
    /// Noise as in marker capture: `rms` from 1 to 8 Hz and a quarter of that above, up to 15 Hz or what the rate can
    /// carry.
    pub(crate) fn capture(random: &mut Random, rms: f64, fps: f64) -> Self {
        let mut noise = Self::band(random, rms, 1.0, 8.0, 9);
        noise
            .sines
            .extend(Self::band(random, 0.25 * rms, 8.0, f64::min(15.0, 0.45 * fps), 5).sines);
        noise
    }

    /// Noise in one band, in hertz.
    pub(crate) fn band(random: &mut Random, rms: f64, from: f64, to: f64, count: usize) -> Self {
        let amplitude = rms * (2.0 / count as f64).sqrt();
        // One sine in each equal part of the band, so that no seed leaves half of the band empty.
        let part = (to - from) / count as f64;
        let sine = |at: usize| {
            let begin = from + part * at as f64;
            [amplitude, random.between(begin, begin + part), random.between(0.0, TAU)]
        };
        Self { sines: (0..count).map(sine).collect() }
    }

    pub(crate) fn at(&self, time: f64) -> f64 {
        self.sines
            .iter()
            .map(|[size, hertz, phase]| size * libm::sin(TAU * hertz * time + phase))
            .sum()
    }
}
