//! Estimates the memory of a run before it starts.

use crate::error::Error;
use crate::motion::{Clip, GIB, bytes_in_words};
use crate::sheet::MOST_KOMA;

/// Bytes per joint and frame: angles as quaternions, speeds before and after the filter, and turns.
const POSE: f64 = 64.0;
/// Bytes per joint and koma: its position, and the sums by which spans between keys are judged.
const STAND: f64 = 104.0;
/// Bytes per koma, independent of the number of joints.
const KOMA: f64 = 1100.0;
/// Bytes per joint: its name and place in the body.
const JOINT: f64 = 2000.0;
/// Number of copies of the clip's values, including the clip itself.
const COPIES: f64 = 3.0;

/// Bytes allowed for any clip.
const ANY: f64 = GIB;
/// Further allowance, as a multiple of the clip's values. A body whose joints all move takes 10 times at 24 frames
/// per second and 17 times at 10. Joints without channels take memory but add no values.
const TIMES: f64 = 18.0;

/// The most memory that a run may take (メモリの上限).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budget {
    /// In bytes. Default: 1 GiB plus 18 times the values of the clip.
    pub bytes: Option<f64>,
}

impl Budget {
    /// Creates a budget in GiB.
    pub fn gib(gib: f64) -> Self {
        Self { bytes: Some(gib * GIB) }
    }

    /// Checks that a run of the clip at `koma_rate` koma per second stays within the budget.
    ///
    /// # Errors
    /// [`Error::Clip`] with the numbers and a remedy, when the run needs more memory or more koma than a sheet has.
    pub fn check(self, clip: &Clip, koma_rate: f64) -> Result<(), Error> {
        let (joints, frames) = (clip.skeleton().len(), clip.len());
        let koma = clip.rate().koma_from_frames(frames, koma_rate);
        if koma > MOST_KOMA {
            let message = format!(
                "{frames} frames at {} a second are {koma} koma, and a sheet has {MOST_KOMA} at the most; \
                 --trim takes a part, --fps gives another rate",
                clip.rate()
            );
            return Err(Error::clip(message));
        }
        let values = 8.0 * (frames * clip.skeleton().channels()) as f64;
        let need = need([joints, frames, koma].map(|count| count as f64), values);
        let most = self.bytes.unwrap_or(allowed(values));
        if need <= most {
            return Ok(());
        }
        let (about, most, enough) =
            (bytes_in_words(need), bytes_in_words(most), (need / GIB).ceil());
        let most = if most == about { "a little less is".into() } else { format!("{most} are") };
        Err(Error::clip(format!(
            "{joints} joints in {frames} frames and on {koma} koma take about {about} of memory, and {most} allowed; \
             --trim takes a part, --memory {enough} allows it"
        )))
    }
}

/// Estimates the bytes that a run takes; `values` are the bytes of the clip's values.
fn need([joints, frames, koma]: [f64; 3], values: f64) -> f64 {
    joints * (POSE * frames + STAND * koma + JOINT) + KOMA * koma + COPIES * values
}

/// Returns the bytes allowed by default.
fn allowed(values: f64) -> f64 {
    ANY + TIMES * values
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::edits::Edits;
    use crate::motion::bvh;
    use crate::pipeline::Engine;
    use crate::recipe::Recipe;

    /// Builds a clip with a moving root and `joints` rigid joints; `seconds` is the frame time.
    fn clip(joints: usize, frames: usize, seconds: &str) -> Clip {
        let mut text = "HIERARCHY ROOT a { OFFSET 0 0 0 CHANNELS 1 Xposition ".to_owned();
        (0..joints).for_each(|joint| text += &format!("JOINT j{joint} {{ OFFSET 0 1 0 }} "));
        text += &format!("}}\nMOTION\nFrames: {frames}\nFrame Time: {seconds}\n");
        (0..frames).for_each(|frame| text += &format!("{}\n", frame % 7));
        bvh::read(text.as_bytes()).unwrap().clip
    }

    fn said(clip: Clip, budget: Budget) -> String {
        let engine = Engine::new(clip).unwrap().with_budget(budget);
        let run = |mut engine: Engine| {
            engine
                .run(&Recipe::default(), &Edits::default())
                .map(|breakdown| breakdown.sheet.length())
        };
        run(engine).map_or_else(|error| error.to_string(), |koma| koma.to_string())
    }

    #[test]
    fn joints_that_bring_no_values_do_not_fill_the_memory() {
        for (joints, frames) in [(2000, 20_000), (20_000, 20_000), (1_000_000, 2)] {
            let said = said(clip(joints, frames, "0.01"), Budget::default());
            assert!(said.contains(&format!("{} joints in {frames} frames", joints + 1)), "{said}");
            assert!(
                said.contains(" GiB of memory, and 1.0 GiB are allowed")
                    && said.contains("--memory"),
                "{said}"
            );
        }
        assert_eq!(said(clip(10, 100, "0.041666667"), Budget::default()), "100");
    }

    #[test]
    fn a_slow_rate_does_not_fill_the_memory_with_koma() {
        let said = |frames| said(clip(0, frames, "0.999"), Budget::default());
        let many = said(200_000);
        assert!(many.starts_with("200000 frames at 1.001 a second are 4795177 koma"), "{many}");
        assert!(many.contains("1000000 at the most") && many.contains("--fps"), "{many}");
        assert_eq!(said(50), "1175");
    }

    #[test]
    fn a_person_may_allow_more_or_less() {
        let body = || clip(99, 1000, "0.041666667");
        assert_eq!(said(body(), Budget::gib(0.1)), "1000");
        let less = said(body(), Budget::gib(0.01));
        assert!(
            less.starts_with("100 joints in 1000 frames and on 1000 koma take about 17 MiB"),
            "{less}"
        );
        // Need and limit are equal to two digits here.
        let [joints, frames] = [100.0, 1000.0];
        let need = need([joints, frames, frames], 8.0 * frames);
        let hardly = said(body(), Budget { bytes: Some(need - 1.0) });
        assert!(
            hardly.contains("take about 17 MiB of memory, and a little less is allowed"),
            "{hardly}"
        );
    }

    proptest! {
        #[test]
        fn a_body_whose_joints_all_move_is_never_refused(
            joints in 20..400usize,
            frames in 1..400_000usize,
            fps in 10.0..240.0_f64,
        ) {
            let koma = (frames as f64 * 24.0 / fps).ceil();
            let values = 8.0 * 3.0 * (joints * frames) as f64;
            prop_assert!(need([joints as f64, frames as f64, koma], values) <= allowed(values));
        }
    }
}
