//! The clip that the chain runs over: the one given, or the rounds of a loop (リピート) laid end to end.

use std::sync::Arc;

use crate::edits::{Edits, Rounds};
use crate::error::Error;
use crate::keys::Cycle;
use crate::motion::{Clip, laid};
use crate::sheet::Repeat;
use crate::time::Frame;

/// Number of rounds that are laid end to end. The middle one has a whole round before and behind it.
pub(super) const ROUNDS: usize = 3;

/// The clip that the chain runs over.
#[derive(Debug, Clone)]
pub(super) struct Laid {
    pub(super) clip: Arc<Clip>,
    /// The round, if the clip is laid end to end.
    pub(super) round: Option<Round>,
}

/// A round of a loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Round {
    /// First frame of the clip.
    pub(super) first: Frame,
    pub(super) repeat: Repeat,
}

impl Laid {
    /// Lays a clip end to end, at a rate at which a round lasts a whole number of koma.
    ///
    /// # Errors
    /// [`Error::Setting`] when the last pose of the clip is not the first.
    pub(super) fn new(clip: &Arc<Clip>, koma_rate: Option<f64>) -> Result<Self, Error> {
        let Some(koma_rate) = koma_rate else {
            return Ok(Self { clip: Arc::clone(clip), round: None });
        };
        let wrong = |message: String| Error::setting("loop", message);
        let way_out =
            "genga split --cycles lists the best rounds of a take, and --trim A..B takes one";
        let cycle = Cycle::of_clip(clip).ok_or_else(|| {
            let count = clip.len();
            wrong(format!("{count} frames are too few for a round; {way_out}"))
        })?;
        if !cycle.is_repeatable() {
            let pose = cycle.pose;
            return Err(wrong(format!(
                "the last pose is not the first: they are {pose:.1} % of body height apart; {way_out}"
            )));
        }
        let frames = cycle.frames();
        let koma = (frames as f64 * koma_rate / clip.rate().fps()).round().max(1.0);
        let repeat = Repeat { frames, koma: koma as usize };
        let laid = laid(clip, ROUNDS, 0).with_rate(repeat.frame_rate(koma_rate)?);
        let round = Some(Round { first: clip.first(), repeat });
        Ok(Self { clip: Arc::new(laid), round })
    }
}

impl Round {
    /// Returns the corrections of the clip in every round.
    pub(super) fn spread(&self, edits: &Edits) -> Edits {
        let Self { first, repeat, .. } = *self;
        edits.in_rounds(Rounds { first, frames: repeat.frames, count: ROUNDS })
    }
}
