//! Noise on the rotations of a clip, as another capture might have had.

use genga::error::Error;
use genga::knob::{Setting, knob};
use genga::maths::mixed;
use genga::motion::{Channel, Clip};
use genga::recipe::Knob;

/// The strength of the noise; not a knob of a recipe, but an axis of a study.
pub(super) const NOISE: Knob = knob(
    "ノイズ",
    "Standard deviation of Gaussian noise on every rotation channel of the clip.",
    "クリップのすべての回転に加えるガウスノイズの標準偏差。",
)
.unit("degrees")
.at_most(180.0)
.slider(0.0, 10.0)
.for_studies()
.named("noise", f64::KIND);

/// The seed of the noise.
pub(super) const SEED: Knob = knob(
    "ノイズの種",
    "Seed of the noise. Another seed gives other noise of the same strength.",
    "ノイズの乱数の種。変えると、同じ強さの別のノイズになる。",
)
.slider(0.0, 1e9)
.for_studies()
.named("noise.seed", usize::KIND);

/// Noise (ノイズ) that a study adds to every rotation channel of a clip, independently for each frame and channel.
///
/// It depends only on the seed, frame number and channel, and it scales with the degrees: between two strengths, only
/// the strength changes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Noise {
    /// Standard deviation in degrees, 0 to 180; default 0, no noise.
    pub degrees: f64,
    /// The seed; default 0.
    pub seed: u64,
}

impl Noise {
    /// Names of the axes that vary it.
    pub const AXES: [&str; 2] = [NOISE.name, SEED.name];

    /// Checks the strength.
    ///
    /// # Errors
    /// [`Error::Setting`] named `noise` when the strength is outside 0 to 180 degrees.
    pub fn validate(&self) -> Result<(), Error> {
        if self.degrees.is_in(NOISE.range) {
            return Ok(());
        }
        Err(NOISE.refusal(&self.degrees.to_string()))
    }

    /// Returns the clip with the noise added.
    pub fn on(&self, clip: &Clip) -> Clip {
        let skeleton = clip.skeleton();
        let mut is_rotation = vec![false; skeleton.channels()];
        for joint in &skeleton.joints {
            for (at, channel) in joint.channels.iter().enumerate() {
                is_rotation[joint.first_channel + at] = matches!(channel, Channel::Rotation(_));
            }
        }
        let mut values = Vec::with_capacity(clip.len() * skeleton.channels());
        for (row, channels) in clip.rows().enumerate() {
            let frame = mixed(mixed(self.seed) ^ (clip.first().0 + row) as u64);
            for (channel, (value, is_rotation)) in channels.iter().zip(&is_rotation).enumerate() {
                let noise =
                    if *is_rotation { self.degrees * normal(frame ^ channel as u64) } else { 0.0 };
                values.push(value + noise);
            }
        }
        clip.with_values(values)
    }
}

/// Returns a nearly normal number with mean 0 and deviation 1: the sum of twelve uniform ones. Unlike a formula with
/// logarithm and cosine, it is identical to the last bit on every machine. Its magnitude never exceeds 6.
fn normal(at: u64) -> f64 {
    let word = |of: u64| mixed(at.wrapping_mul(3).wrapping_add(of));
    let quarters = |word: u64| (0..4).map(|part| (word >> (16 * part)) & 0xffff).sum::<u64>();
    let sum: u64 = (0..3).map(|of| quarters(word(of))).sum();
    // Each of the twelve is the middle of one of 65536 equal parts of 0 to 1.
    (sum as f64 + 6.0) / 65536.0 - 6.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::tests::swinging;
    use genga::time::Frame;

    fn differences(noise: Noise, clip: &Clip) -> Vec<f64> {
        let noisy = noise.on(clip);
        assert_eq!(
            (noisy.first(), noisy.len(), noisy.rate()),
            (clip.first(), clip.len(), clip.rate())
        );
        let rows = noisy.rows().zip(clip.rows());
        rows.flat_map(|(noisy, clean)| {
            noisy.iter().zip(clean).map(|(a, b)| a - b).collect::<Vec<_>>()
        })
        .collect()
    }

    #[test]
    fn noise_has_the_deviation_it_is_asked_for_on_rotations_alone() {
        let clip = swinging(2000);
        let channels = clip.skeleton().channels();
        let noise = differences(Noise { degrees: 2.0, seed: 0 }, &clip);
        let (positions, rotations): (Vec<_>, Vec<_>) =
            noise.into_iter().enumerate().partition(|(at, _)| at % channels < 3);
        assert!(positions.iter().all(|(_, noise)| *noise == 0.0), "the root's way is left alone");
        let count = rotations.len() as f64;
        let mean = rotations.iter().map(|(_, noise)| noise).sum::<f64>() / count;
        let deviation =
            (rotations.iter().map(|(_, noise)| noise * noise).sum::<f64>() / count).sqrt();
        // About 18000 numbers: four standard errors.
        assert!(mean.abs() < 4.0 * 2.0 / count.sqrt(), "{mean}");
        assert!((deviation - 2.0).abs() < 4.0 * 2.0 / (2.0 * count).sqrt(), "{deviation}");
        let within = rotations.iter().filter(|(_, noise)| noise.abs() < 2.0).count() as f64 / count;
        assert!((within - 0.683).abs() < 0.02, "{within} within one deviation");
    }

    #[test]
    fn a_frame_has_its_noise_whatever_the_trim_and_twice_is_twice() {
        let clip = swinging(60);
        let noise = Noise { degrees: 1.0, seed: 7 };
        let trimmed = clip.clone().trimmed(Frame(10), Frame(20)).unwrap();
        assert_eq!(noise.on(&trimmed).row(Frame(12)), noise.on(&clip).row(Frame(12)));
        let [once, twice] =
            [1.0, 2.0].map(|degrees| differences(Noise { degrees, ..noise }, &clip));
        assert!(once.iter().zip(&twice).all(|(once, twice)| (2.0 * once - twice).abs() < 1e-9));
        assert_ne!(once, differences(Noise { seed: 8, ..noise }, &clip));
        let mut row = once[3..12].to_vec();
        row.sort_by(f64::total_cmp);
        row.dedup();
        assert_eq!(row.len(), 9, "each channel has its own");
        assert_eq!(Noise::default().on(&clip), clip);
        for degrees in [-1.0, 181.0, f64::NAN] {
            assert!(Noise { degrees, seed: 0 }.validate().is_err());
        }
    }
}
