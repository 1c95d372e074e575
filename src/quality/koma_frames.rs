//! The frames among which a method chooses: one a koma.

use std::sync::Arc;

use crate::keys::Reference;
use crate::motion::Clip;
use crate::time::{Clock, Frame};

/// A clip, what it is measured against, and the frames that may become keys.
///
/// The frames are those nearest to the koma, the first and the last the ends of the clip: keys of a
/// sheet stand on koma, and finer than that no two methods need be told apart.
#[derive(Debug, Clone)]
pub struct KomaFrames {
    /// The motion.
    pub clip: Arc<Clip>,
    /// The source koma after koma.
    pub reference: Reference,
    /// By number, each once.
    pub frames: Vec<Frame>,
}

impl KomaFrames {
    /// The frames at the koma of a clock.
    pub fn of(clip: Arc<Clip>, clock: Clock) -> Self {
        let reference = Reference::of(&clip, clock);
        let last = clip.last();
        let at = |koma| clock.frame_from_koma(koma).min(last);
        let mut frames: Vec<Frame> = (0..reference.koma()).map(at).collect();
        // The last koma may stand a little before the last frame.
        match frames.last_mut() {
            Some(frame) if reference.koma() > 1 => *frame = last,
            _ if !clip.is_empty() && last > clip.first() => frames.push(last),
            _ => {}
        }
        frames.dedup();
        Self { clip, reference, frames }
    }

    /// Where the koma stand.
    pub fn clock(&self) -> Clock {
        self.reference.clock()
    }

    /// The frames at some places of the list.
    pub fn frames_at(&self, places: &[usize]) -> Vec<Frame> {
        places.iter().map(|place| self.frames[*place]).collect()
    }

    /// The koma nearest to a frame, by its place in the list.
    pub fn koma(&self, place: usize) -> usize {
        let koma = self.clock().koma_from_place(self.frames[place].0 as f64);
        koma.min(self.reference.koma() - 1)
    }

    /// The place in the list of the frame nearest to a koma.
    pub fn place(&self, koma: usize) -> usize {
        let frame = self.clock().frame_from_koma(koma);
        self.frames.partition_point(|other| *other < frame).min(self.frames.len() - 1)
    }

    /// How many frames may become keys besides the two ends.
    pub fn inner(&self) -> usize {
        self.frames.len().saturating_sub(2)
    }
}
