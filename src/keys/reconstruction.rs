//! Measures how far off the body is if only some keys are left of a motion.

use crate::keys::Reference;
use crate::keys::bridge::Bridge;
use crate::motion::Clip;
use crate::time::Frame;

/// The loss if a motion is made again from some keys alone (復元誤差): the error at each koma between the source and the
/// slerp from each key to the next.
///
/// It is the root mean square over the body's points, joints and tips weighted by the bones that lead to them, so that
/// another rig of the same body has nearly the same error; in % of body height. The choice of keys uses a similar but
/// quicker measure, see [`Chords`](crate::keys::Chords).
#[derive(Debug, Clone, PartialEq)]
pub struct Reconstruction {
    /// The error at each koma of the reference, in % of body height; 0 on a key.
    pub errors: Vec<f64>,
}

impl Reconstruction {
    /// Slerps between neighbouring keys. `keys` are source frames of the clip, in any order; the clip's first and last
    /// frame are always added.
    ///
    /// # Panics
    /// When a key is no frame of the clip.
    pub fn new(clip: &Clip, reference: &Reference, keys: &[Frame]) -> Self {
        let mut errors = vec![0.0; reference.koma()];
        let frames = with_ends(clip, keys);
        let mut bridge = Bridge::new(clip, reference, &frames);
        for key in 1..frames.len() {
            bridge.errors(key - 1, key, |koma, error| errors[koma] = error);
        }
        Self { errors }
    }

    /// Returns the mean over all koma, in % of body height; 0 if there is none.
    pub fn mean(&self) -> f64 {
        self.errors.iter().sum::<f64>() / self.errors.len().max(1) as f64
    }

    /// Returns the error at the worst koma, in % of body height; 0 if there is none.
    pub fn worst(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, f64::max)
    }
}

/// Returns the keys by frame, each once, with the clip's ends.
pub fn with_ends(clip: &Clip, keys: &[Frame]) -> Vec<Frame> {
    if clip.is_empty() {
        return Vec::new();
    }
    let mut frames = [keys, &[clip.first(), clip.last()]].concat();
    frames.sort_unstable();
    frames.dedup();
    frames
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::keys::tests::swing;
    use crate::motion::{Body, Pose};
    use crate::time::FrameRate;

    /// Computes the errors directly, one koma at a time with single poses. The arm of [`swing`] is straight with two
    /// bones of equal length, so that only the hand and the tip are off.
    fn slowly(clip: &Clip, reference: &Reference, keys: &[Frame]) -> Vec<f64> {
        let frames = with_ends(clip, keys);
        let rest = Pose::rest(clip.skeleton());
        let (mut from, mut to, mut pose) = (rest.clone(), rest.clone(), rest);
        let mut body = Body::new(clip.skeleton());
        let mut arm = |pose: &Pose| {
            body.place(pose);
            let joints = body.positions();
            [joints[1], 2.0 * joints[1] - joints[0]]
        };
        let mut error = |koma: usize| {
            let place = reference.clock().place_from_koma(koma);
            let after = frames.partition_point(|frame| (frame.0 as f64) < place).max(1);
            let [a, b] = [frames[after - 1], frames[after]];
            from.take_frame(clip, a);
            to.take_frame(clip, b);
            pose.take_blend(&from, &to, (place - a.0 as f64) / (b.0 - a.0) as f64);
            let made = arm(&pose);
            pose.take_place(clip, place);
            let squares = made.iter().zip(arm(&pose)).map(|(a, b)| a.distance_squared(b));
            100.0 * (squares.sum::<f64>() / 2.0).sqrt() / reference.height()
        };
        (0..reference.koma()).map(&mut error).collect()
    }

    proptest! {
        #[test]
        fn each_koma_is_off_by_what_a_slerp_of_single_poses_is_off(
            angles in prop::collection::vec(-80.0..80.0, 2..40),
            keys in prop::collection::vec(0usize..40, 0..6),
            fps in prop_oneof![Just(24.0), Just(30.0), Just(100.0), Just(10.0)],
        ) {
            let clip = swing(&angles).with_rate(FrameRate::new(fps).unwrap());
            let reference = Reference::new(&clip, clip.clock(24.0));
            let keys: Vec<Frame> = keys.iter().map(|key| Frame(key % angles.len())).collect();
            let found = Reconstruction::new(&clip, &reference, &keys);
            let slow = slowly(&clip, &reference, &keys);
            prop_assert_eq!(found.errors.len(), slow.len());
            for (fast, slow) in found.errors.iter().zip(&slow) {
                prop_assert!((fast - slow).abs() < 1e-9, "{} {}", fast, slow);
            }
            let worst = slow.iter().copied().fold(0.0, f64::max);
            let mean = slow.iter().sum::<f64>() / slow.len() as f64;
            prop_assert!((found.worst() - worst).abs() < 1e-9);
            prop_assert!((found.mean() - mean).abs() < 1e-9);
        }
    }

    #[test]
    fn a_key_on_every_frame_loses_nothing() {
        let clip = swing(&[0.0, 30.0, -10.0, 70.0, 20.0]);
        let reference = Reference::new(&clip, clip.clock(24.0));
        let all: Vec<Frame> = (0..5).map(Frame).collect();
        assert_eq!(Reconstruction::new(&clip, &reference, &all).errors, [0.0; 5]);
        let ends = Reconstruction::new(&clip, &reference, &[]);
        assert!(ends.mean() > 0.0 && ends.worst() > ends.mean(), "{ends:?}");
        assert_eq!([ends.errors[0], ends.errors[4]], [0.0; 2], "the ends are always there");
    }

    #[test]
    fn without_a_koma_nothing_is_off() {
        let nothing = Reconstruction { errors: vec![] };
        assert_eq!((nothing.mean(), nothing.worst()), (0.0, 0.0));
        let clip = swing(&[5.0]);
        let reference = Reference::new(&clip, clip.clock(24.0));
        assert_eq!(Reconstruction::new(&clip, &reference, &[Frame(0)]).errors, [0.0]);
    }
}
