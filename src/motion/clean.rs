//! Removes or mends capture artefacts before any work on a clip.

use std::ops::Range;

use crate::error::{Error, Warning};
use crate::motion::Clip;
use crate::time::Frame;

mod ends;
pub mod glitches;
pub mod lead_in;
mod ramps;

pub use lead_in::LeadIn;
pub use ramps::Ramps;

/// Selects the frames to work on and cleans them of capture artefacts.
///
/// By default it removes a [lead-in](LeadIn), a lead-out and [ramps](Ramps), and mends
/// [single-frame glitches](glitches).
///
/// ```
/// use genga::motion::{bvh::read, clean::Cleaning};
///
/// let kick = std::fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/data/kick.bvh"))?;
/// let (clip, notes) = Cleaning::default().apply(read(&kick)?.clip)?;
/// assert_eq!((clip.len(), notes.len()), (92, 0));
/// # Ok::<_, Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Cleaning {
    /// Keeps poses inserted in front of the motion or behind it.
    pub keep_lead_in: bool,
    /// Keeps single-frame glitches and ramps.
    pub keep_glitches: bool,
    /// Frames to work on, numbered from 0 as in the file, the end excluded. A start before the motion means
    /// its beginning. Default: all.
    pub trim: Option<Range<usize>>,
}

impl Cleaning {
    /// Cleans a clip, and returns warnings about its changes: `W_GLITCH`, `W_LEAD_IN`, `W_RAMP`. Frames
    /// keep their numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Clip`] if the trim leaves no frame.
    pub fn apply(&self, clip: Clip) -> Result<(Clip, Vec<Warning>), Error> {
        let whole = frames(&clip);
        let asked = self.trim.clone().unwrap_or(whole.clone());
        let mut work = Work { clip, notes: Vec::new(), asked };
        if !self.keep_glitches {
            work = work.after(glitches::mend);
        }
        // Ramps are found before the lead-in is stripped: a lost tracker loses the pose too, and cutting
        // the inserted pose would hide the rest of the ramp.
        let ramps = self.ramps(&work.clip);
        if !self.keep_lead_in {
            work = work.after(lead_in::strip).after(lead_in::strip_out);
        }
        work = work.after(|clip| ramps.leave_out(clip));
        let Work { clip, notes, .. } = work;
        let Some(trim) = &self.trim else { return Ok((clip, notes)) };
        // The trim may extend into frames removed behind the motion, but not past the end of the file.
        let motion = frames(&clip);
        let is_open = trim.end <= whole.end || trim.end == usize::MAX;
        let end = if is_open { trim.end.min(motion.end) } else { trim.end };
        // An empty trim is refused in its own numbers.
        let (start, end) = match trim.is_empty() {
            true => (trim.start, trim.end),
            false => (trim.start.max(motion.start), end),
        };
        if !trim.is_empty() && start >= end {
            return Err(missed(trim, &motion));
        }
        Ok((clip.trimmed(Frame(start), Frame(end))?, notes))
    }

    /// Finds the ramps to remove. A kept inserted pose keeps its ramp at the origin too.
    fn ramps(&self, clip: &Clip) -> Ramps {
        let found = Ramps::find(clip);
        let is_kept =
            |pose: Option<LeadIn>| self.keep_glitches || self.keep_lead_in && pose.is_some();
        Ramps {
            front: found.front.filter(|_| !is_kept(LeadIn::find(clip))),
            back: found.back.filter(|_| !is_kept(LeadIn::find_out(clip))),
        }
    }
}

/// The error of a trim that leaves no frame of the motion.
fn missed(trim: &Range<usize>, motion: &Range<usize>) -> Error {
    let end = if trim.end == usize::MAX { String::new() } else { trim.end.to_string() };
    Error::clip(format!(
        "cannot keep frames {}..{end}: the motion has frames {} to {}",
        trim.start,
        motion.start,
        motion.end - 1
    ))
}

/// A clip that is being cleaned.
struct Work {
    clip: Clip,
    notes: Vec<Warning>,
    /// The frames that the user wants to work on.
    asked: Range<usize>,
}

impl Work {
    /// Applies one cleaning step, and keeps its warning if it concerns the requested frames.
    fn after(mut self, step: impl FnOnce(Clip) -> (Clip, Option<Warning>)) -> Self {
        let before = frames(&self.clip);
        let (clip, note) = step(self.clip);
        let after = frames(&clip);
        self.notes.extend(note.filter(|_| concerns(&self.asked, &before, &after)));
        Self { clip, ..self }
    }
}

fn frames(clip: &Clip) -> Range<usize> {
    clip.first().0..clip.first().0 + clip.len()
}

/// Whether a step mended frames, or removed any of the requested ones.
fn concerns(asked: &Range<usize>, before: &Range<usize>, after: &Range<usize>) -> bool {
    before == after
        || before.start < after.start && asked.start < after.start
        || after.end < before.end && after.end < asked.end
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::bvh::{read, sample};

    /// A clip whose tracker starts and ends at the origin, with a glitch in frame 20.
    fn spoiled() -> Clip {
        let row = |frame: usize| {
            let place = match frame {
                0 | 39 => 0.0,
                _ => 50.0 + 0.01 * frame as f64,
            };
            let off = 0.5 * frame as f64 + if frame == 20 { 90.0 } else { 0.0 };
            format!("{place} {place} 0 {} 0 0 0 {off} 0", 0.3 * frame as f64)
        };
        let rows: Vec<String> = (0..40).map(row).collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip
    }

    fn codes(notes: &[Warning]) -> Vec<&str> {
        notes.iter().map(|note| note.code).collect()
    }

    #[test]
    fn what_no_body_did_goes_and_frames_keep_their_numbers() {
        let (clip, notes) = Cleaning::default().apply(spoiled()).unwrap();
        assert_eq!((frames(&clip), codes(&notes)), (1..39, vec!["W_GLITCH", "W_RAMP"]));
        let kept = Cleaning { keep_glitches: true, ..Cleaning::default() };
        assert_eq!(kept.apply(spoiled()).unwrap(), (spoiled(), vec![]));
    }

    #[test]
    fn a_tracker_that_loses_the_pose_too_is_left_out_whole() {
        let row = |frame: usize| {
            let share = (frame as f64 / 3.0).min(1.0);
            let seconds = frame as f64 / 24.0;
            let place = share * (50.0 + seconds);
            let angle = share.ceil() * (40.0 + 20.0 * (6.0 * seconds).sin());
            format!("{place} {place} 0 {angle} {angle} 0 {angle} {angle} 0")
        };
        let rows: Vec<String> = (0..60).map(row).collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let clip = read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip;
        let (motion, notes) = Cleaning::default().apply(clip.clone()).unwrap();
        assert_eq!((frames(&motion), codes(&notes)), (3..60, vec!["W_LEAD_IN", "W_RAMP"]));
        let kept = Cleaning { keep_lead_in: true, ..Cleaning::default() };
        assert_eq!(frames(&kept.apply(clip).unwrap().0), 0..60);
    }

    #[test]
    fn a_pose_behind_the_motion_goes_unless_it_is_to_stay() {
        let row = |frame: usize| {
            let seconds = frame as f64 / 24.0;
            let angle = if frame < 59 { 40.0 + 20.0 * (6.0 * seconds).sin() } else { 0.0 };
            format!("50 50 0 {angle} {angle} 0 {angle} {angle} 0")
        };
        let rows: Vec<String> = (0..60).map(row).collect();
        let rows: Vec<&str> = rows.iter().map(String::as_str).collect();
        let clip = read(sample::text("0.0416667", &rows).as_bytes()).unwrap().clip;
        let (motion, notes) = Cleaning::default().apply(clip.clone()).unwrap();
        assert_eq!((frames(&motion), codes(&notes)), (0..59, vec!["W_LEAD_IN"]));
        let kept = Cleaning { keep_lead_in: true, ..Cleaning::default() };
        assert_eq!(kept.apply(clip.clone()).unwrap(), (clip, vec![]));
    }

    #[test]
    fn a_trim_means_frames_of_the_motion_and_hears_of_what_it_asked_for() {
        let trimmed = |trim: Range<usize>| {
            Cleaning { trim: Some(trim), ..Cleaning::default() }.apply(spoiled())
        };
        for (asked, kept, said) in [
            (0..40, 1..39, true),
            (0..20, 1..20, true),
            (20..40, 20..39, true),
            (30..usize::MAX, 30..39, true),
            (1..39, 1..39, false),
            (10..30, 10..30, false),
        ] {
            let (clip, notes) = trimmed(asked.clone()).unwrap();
            assert_eq!(
                (frames(&clip), codes(&notes).contains(&"W_RAMP")),
                (kept, said),
                "{asked:?}"
            );
        }
        assert!(trimmed(30..41).is_err() && trimmed(39..40).is_err());
    }
}
