//! Finds single-frame glitches and replaces them by interpolation between their neighbours.
//!
//! A tracker that loses a marker throws a joint away for one frame and has it back in the next. A glitch
//! goes out and comes back, while all steps around it are small. A fast movement looks different: after two
//! frames the joint is far from where it was, or its other steps are large too.

use glam::DQuat;

use crate::error::Warning;
use crate::maths;
use crate::motion::clean::LeadIn;
use crate::motion::{Channel, Clip, Joint, RowWriter, local_rotation, local_translation};
use crate::sheet::Source;
use crate::time::Frame;

/// Seconds on either side of a frame against which an excursion is compared.
const AROUND: f64 = 0.05;

/// Fewest steps needed on either side to judge the motion, at any frame rate.
const FEWEST_AROUND: usize = 4;

/// Least ratio of an excursion to the largest step around it, and to the direct way past it.
const EXCURSION: f64 = 6.0;

/// Smallest turn of a glitch, in radians: 15 degrees.
const SMALLEST_TURN: f64 = 0.2618;

/// Smallest shift of a glitch, as a share of the body's longest reach.
const SMALLEST_SHIFT: f64 = 0.1;

/// Least mean step of a moving body, in radians per joint or shares of the reach. A single pose amid total
/// stillness is a drawing of limited animation, no glitch.
const STILL: f64 = 1e-7;

/// Finds the glitch frames of a clip, in order.
///
/// A joint glitches in a frame if it turns by 15 degrees or more, or moves by a tenth of the skeleton's
/// longest reach or more, both into the frame and out of it. The smaller of the two steps must be at least
/// 6 times the joint's largest step within 0.05 s (at least 4 steps) on either side. It must also be at
/// least 6 times the way from the frame before to the frame after. A frame with fewer than 4 steps of the
/// clip on either side is never called a glitch, nor is one around which the joint stays still.
pub fn find(clip: &Clip) -> Vec<Frame> {
    let rows: Vec<&[f64]> = clip.rows().collect();
    let frame = |row: usize| Frame(clip.first().0 + row);
    flown_off(clip, &rows).into_iter().map(frame).collect()
}

/// Indices of the glitch rows among `rows`.
fn flown_off(clip: &Clip, rows: &[&[f64]]) -> Vec<usize> {
    let joints = &clip.skeleton().joints;
    let reach = clip.skeleton().reaches().into_iter().fold(0.0, f64::max);
    let search = Search { rows, reach, around: around(clip) };
    let last = rows.len().saturating_sub(FEWEST_AROUND + 1);
    let mut was_far = vec![false; joints.len()];
    let mut off = Vec::new();
    for row in 1..rows.len() {
        let mut is_off = false;
        for (joint, was_far) in joints.iter().zip(&mut was_far) {
            let is_far = search.may_be_far(joint, row);
            let is_candidate = is_far && *was_far && row > 1 + FEWEST_AROUND && row <= last;
            is_off = is_off || is_candidate && search.flies_off(joint, row - 1);
            *was_far = is_far;
        }
        if is_off {
            off.push(row - 1);
        }
    }
    off
}

/// Number of steps on either side against which an excursion is compared.
fn around(clip: &Clip) -> usize {
    ((AROUND * clip.rate().fps()).round() as usize).max(FEWEST_AROUND)
}

/// A search for glitches in the rows of a clip.
struct Search<'a> {
    rows: &'a [&'a [f64]],
    /// The skeleton's longest reach, in the file's unit.
    reach: f64,
    around: usize,
}

impl Search<'_> {
    /// Whether the step into a row may be large enough for a glitch. The changes of a joint's angle
    /// channels add up to at least the angle that it turns, so this cheap bound rules out most steps.
    fn may_be_far(&self, joint: &Joint, row: usize) -> bool {
        let columns = joint.first_channel..joint.first_channel + joint.channels.len();
        let values = self.rows[row - 1][columns.clone()].iter().zip(&self.rows[row][columns]);
        let (mut turned, mut shifted) = (0.0, 0.0);
        for (channel, (before, after)) in joint.channels.iter().zip(values) {
            match channel {
                Channel::Rotation(_) => turned += (after - before).abs(),
                Channel::Position(_) => shifted += (after - before).abs(),
            }
        }
        turned.to_radians() >= SMALLEST_TURN || self.may_be_shifted(shifted)
    }

    fn may_be_shifted(&self, way: f64) -> bool {
        self.reach > 0.0 && way >= SMALLEST_SHIFT * self.reach
    }

    /// Whether a joint glitches in a row, by its rotation or its position.
    fn flies_off(&self, joint: &Joint, row: usize) -> bool {
        let turn = |a: usize, b: usize| {
            angle(local_rotation(joint, self.rows[a]), local_rotation(joint, self.rows[b]))
        };
        let shift = |a: usize, b: usize| {
            let at = |row: usize| local_translation(joint, self.rows[row]);
            at(a).distance(at(b)) / self.reach
        };
        self.is_excursion(row, SMALLEST_TURN, turn)
            || self.reach > 0.0 && self.is_excursion(row, SMALLEST_SHIFT, shift)
    }

    /// Whether the step into a row and the step out of it are excursions amid small steps.
    fn is_excursion(&self, row: usize, smallest: f64, way: impl Fn(usize, usize) -> f64) -> bool {
        let excursion = way(row - 1, row).min(way(row, row + 1));
        if excursion < smallest {
            return false;
        }
        let before = (row - 1).saturating_sub(self.around)..row - 1;
        let after = row + 1..(row + 1 + self.around).min(self.rows.len() - 1);
        let step = |from: usize| way(from, from + 1);
        let sound = before.chain(after).map(step).fold(0.0, f64::max);
        sound > STILL && excursion >= EXCURSION * sound.max(way(row - 1, row + 1))
    }
}

/// Replaces every glitch frame by the pose halfway between its neighbours, and reports it as `W_GLITCH`.
/// Rotations are slerped, positions interpolated linearly. Frames keep their numbers. An inserted pose at
/// the start, a [`LeadIn`], is left unchanged.
pub fn mend(clip: Clip) -> (Clip, Option<Warning>) {
    let begin = LeadIn::find(&clip).map_or(0, |lead_in| lead_in.len());
    let motion: Vec<&[f64]> = clip.rows().skip(begin).collect();
    let rows: Vec<usize> = flown_off(&clip, &motion).into_iter().map(|row| begin + row).collect();
    let Some(first) = rows.first() else { return (clip, None) };
    let warning = warning(Frame(clip.first().0 + first), rows.len());
    let mut values: Vec<f64> = clip.rows().flatten().copied().collect();
    let width = clip.skeleton().channels();
    for row in rows {
        let mended = between(&clip, Frame(clip.first().0 + row));
        values[row * width..(row + 1) * width].copy_from_slice(&mended);
    }
    (clip.with_values(values), Some(warning))
}

fn warning(first: Frame, count: usize) -> Warning {
    let of = if count == 1 { String::new() } else { format!(" (the first of {count})") };
    let message = format!(
        "frame {first} flies off for a single frame{of}; replaced by interpolation (keep with --keep-glitches)"
    );
    Warning::new("W_GLITCH", message)
}

/// Computes the row halfway between the neighbours of a frame. The neighbours form a clip of two frames, so
/// that angles continue from the frame before and the glitch has no influence.
fn between(clip: &Clip, frame: Frame) -> Vec<f64> {
    let neighbours = [clip.row(Frame(frame.0 - 1)), clip.row(Frame(frame.0 + 1))].concat();
    let pair = Clip::new(clip.skeleton().clone(), clip.rate(), Frame(0), 2, neighbours);
    let mut row = vec![0.0; clip.skeleton().channels()];
    RowWriter::new(&pair.expect("two rows of the clip")).write(Source::At(0.5), &mut row);
    row
}

/// The angle in radians between two rotations, from their chord; q and −q are the same rotation.
fn angle(from: DQuat, to: DQuat) -> f64 {
    let chord = (from - to).length().min((from + to).length());
    4.0 * maths::asin((0.5 * chord).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::bvh::{read, sample};
    use crate::motion::clean::lead_in;
    use crate::time::FrameRate;

    /// Every `stride`-th frame of a clip.
    fn thinned(clip: &Clip, stride: usize) -> Clip {
        let rows: Vec<&[f64]> = clip.rows().step_by(stride).collect();
        let rate = FrameRate::new(clip.rate().fps() / stride as f64).unwrap();
        Clip::new(clip.skeleton().clone(), rate, Frame(0), rows.len(), rows.concat()).unwrap()
    }

    /// Expected glitches of real clips that keep every `stride`-th frame, as frame numbers of the file. All
    /// are capture errors: a joint turns 19 to 178 degrees and is back in the next frame. Flips that last a
    /// few frames become single frames only by thinning.
    const OFF: [(&str, usize, &[usize]); 7] = [
        ("cmu-01_06-playground-long", 1, &[2990]),
        ("cmu-01_06-playground-long", 4, &[1809, 4757]),
        ("cmu-01_06-playground-long", 5, &[4756]),
        ("cmu-02_07-swordplay", 1, &[1573]),
        ("cmu-02_07-swordplay", 2, &[1573]),
        ("cmu-02_07-swordplay", 4, &[1573, 1885]),
        ("cmu-06_15-dribble-shoot", 2, &[155]),
    ];

    #[test]
    fn in_real_clips_only_errors_of_the_capture_fly_off_at_any_rate() {
        for (name, bytes) in sample::real_clips() {
            let clip = lead_in::strip(read(&bytes).unwrap().clip).0;
            for stride in [1, 2, 4, 5] {
                let of_file = |frame: &Frame| clip.first().0 + frame.0 * stride;
                let found: Vec<_> = find(&thinned(&clip, stride)).iter().map(of_file).collect();
                let expected = OFF.iter().find(|off| (off.0, off.1) == (name.as_str(), stride));
                let expected = expected.map_or(&[][..], |off| off.2);
                assert_eq!(found, expected, "{name}, every {stride}");
            }
        }
    }

    #[test]
    fn a_swing_out_and_back_in_a_sixth_of_a_second_is_no_glitch_and_its_flown_off_frame_is() {
        for fps in [24.0, 30.0, 60.0, 100.0, 120.0, 480.0] {
            let swing = |frame: usize| {
                let seconds = frame as f64 / fps - 1.0;
                10.0 * seconds + 120.0 * (-(seconds / 0.05).powi(2)).exp()
            };
            let clip = |off: usize| {
                let row = |frame: usize| {
                    let thrown = if frame == off { 150.0 } else { 0.0 };
                    format!("0 1 0 0 0 0 0 {} 0", swing(frame) + thrown)
                };
                let rows: Vec<_> = (0..2 * fps as usize).map(row).collect();
                let rows: Vec<_> = rows.iter().map(String::as_str).collect();
                let text = sample::text(&(1.0 / fps).to_string(), &rows);
                read(text.as_bytes()).unwrap().clip
            };
            assert_eq!(find(&clip(usize::MAX)), [], "{fps}");
            let off = Frame(fps as usize / 2);
            assert_eq!(find(&clip(off.0)), [off], "{fps}");
            let mended = mend(clip(off.0)).0.row(off)[7];
            let halfway = 0.5 * (swing(off.0 - 1) + swing(off.0 + 1));
            assert!((mended - halfway).abs() < 1e-9, "{fps}: {mended}, not {halfway}");
        }
    }

    #[test]
    fn frames_that_fly_off_are_found_and_no_others_and_are_mended() {
        for (name, bytes) in sample::real_clips() {
            let clip = mend(lead_in::strip(read(&bytes).unwrap().clip).0).0;
            let width = clip.skeleton().channels();
            let mut values: Vec<f64> = clip.rows().flatten().copied().collect();
            let frames: Vec<usize> = (40..clip.len() - 20).step_by(97).collect();
            for row in &frames {
                // The root is thrown over by half a turn, far more than it turns in a step.
                values[row * width + 3] += 170.0;
            }
            let off =
                Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), clip.len(), values)
                    .unwrap();
            let expected: Vec<_> = frames.iter().map(|row| Frame(clip.first().0 + row)).collect();
            assert_eq!(find(&off), expected, "{name}");
            let (mended, warning) = mend(off);
            assert_eq!(find(&mended), [], "{name}");
            assert_eq!(warning.unwrap().code, "W_GLITCH");
            for (row, (was, is)) in clip.rows().zip(mended.rows()).enumerate() {
                assert!(frames.contains(&row) || was == is, "{name}: row {row} was sound");
            }
        }
    }

    #[test]
    fn a_single_pose_of_a_body_that_stands_is_a_drawing() {
        let mut rows = [sample::ROW; 40];
        rows[20] = "0 1 0 10 20 30 40 140 60";
        let clip = read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip;
        assert_eq!(mend(clip.clone()), (clip, None));
    }
}
