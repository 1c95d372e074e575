//! The frames among which a method chooses: one per koma.

use std::sync::Arc;

use genga::keys::Reference;
use genga::motion::Clip;
use genga::time::{Clock, Frame};

/// A clip, the reference it is measured against, and the frames that may become keys.
///
/// The frames are those nearest to the koma, with the ends of the clip as first and last. Keys of a sheet stand on
/// koma, so a finer grid would not distinguish methods.
#[derive(Debug, Clone)]
pub struct KomaFrames {
    /// The motion.
    pub clip: Arc<Clip>,
    /// The source, koma by koma.
    pub reference: Reference,
    /// Sorted, without duplicates.
    pub frames: Vec<Frame>,
}

impl KomaFrames {
    /// Collects the frames at the koma of a clock.
    pub fn new(clip: Arc<Clip>, clock: Clock) -> Self {
        let reference = Reference::new(&clip, clock);
        let last = clip.last();
        let at = |koma| clock.frame_from_koma(koma).min(last);
        let mut frames: Vec<Frame> = (0..reference.koma()).map(at).collect();
        // The last koma may lie a little before the last frame.
        match frames.last_mut() {
            Some(frame) if reference.koma() > 1 => *frame = last,
            _ if !clip.is_empty() && last > clip.first() => frames.push(last),
            _ => {}
        }
        frames.dedup();
        Self { clip, reference, frames }
    }

    /// Returns the clock of the koma.
    pub fn clock(&self) -> Clock {
        self.reference.clock()
    }

    /// Returns the frames at some places in the list.
    pub fn frames_at(&self, places: &[usize]) -> Vec<Frame> {
        places.iter().map(|place| self.frames[*place]).collect()
    }

    /// Returns the koma nearest to the frame at a place in the list.
    pub fn koma(&self, place: usize) -> usize {
        let koma = self.clock().koma_from_place(self.frames[place].0 as f64);
        koma.min(self.reference.koma() - 1)
    }

    /// Returns the place in the list of the frame nearest to a koma.
    pub fn place(&self, koma: usize) -> usize {
        let frame = self.clock().frame_from_koma(koma);
        self.frames.partition_point(|other| *other < frame).min(self.frames.len() - 1)
    }

    /// Returns the number of frames besides the two ends that may become keys.
    pub fn inner(&self) -> usize {
        self.frames.len().saturating_sub(2)
    }
}
