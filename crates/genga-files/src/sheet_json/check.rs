//! Validity checks of a sheet, run both when it is written and when it is read.

use super::{MadeOf, SheetFile};
use genga::error::{Error, did_you_mean};
use genga::recipe::Knob;
use genga::sheet::{Repeat, Source, Why};

impl SheetFile {
    /// Checks the whole file.
    pub(super) fn check(&self) -> Result<(), Error> {
        let clock = self.sheet.clock;
        if clock.first.0 != self.clip.first_frame {
            let (first, clip) = (clock.first, self.clip.first_frame);
            let message =
                format!("koma 0 shows frame {first}, but the clip begins at frame {clip}");
            return Err(Error::sheet(message));
        }
        if clock.frame_rate.fps() != self.clip.frame_rate {
            let (rate, clip) = (clock.frame_rate, self.clip.frame_rate);
            let message = format!("it is made for {rate} frames a second, the clip has {clip}");
            return Err(Error::sheet(message));
        }
        koma_rate(clock.koma_rate).map_err(Error::sheet)?;
        if let Some(round) = self.sheet.repeat {
            repeat(round, &self.clip).map_err(Error::sheet)?;
        }
        for layer in &self.sheet.layers {
            let named = |message: String| Error::sheet(format!("layer {}: {message}", layer.name));
            joints(&layer.joints, &self.clip).map_err(named)?;
            for drawing in &layer.drawings {
                source(drawing.source, &self.clip).map_err(named)?;
                let Why { strength, price, .. } = drawing.why;
                if [strength, price].into_iter().flatten().any(|value| !value.is_finite()) {
                    return Err(named("a strength or price is no number".into()));
                }
            }
        }
        self.sheet.check_numbers()?;
        self.sheet.check()
    }
}

/// Checks that the koma rate is in the range of the recipe's `rate`.
pub(super) fn koma_rate(rate: f64) -> Result<(), String> {
    let range = Knob::find("rate").expect("it is a setting").range;
    let wrong = || format!("fps is {rate}; a sheet has {range} koma a second, 24 is usual");
    range.contains(rate).then_some(()).ok_or_else(wrong)
}

/// Checks that a round goes from the first frame of the clip to its last, in at least one koma.
pub(super) fn repeat(round: Repeat, clip: &MadeOf) -> Result<(), String> {
    let frames = clip.frames.saturating_sub(1);
    match round {
        Repeat { frames: own, .. } if own != frames || own == 0 => Err(format!(
            "a round has {own} frames; it is the whole clip, {frames} frames from the first to the last"
        )),
        Repeat { koma: 0, .. } => Err("a round has 0 koma: 1 at the least".into()),
        _ => Ok(()),
    }
}

/// Checks that the clip has all the joints.
pub(super) fn joints(joints: &[String], clip: &MadeOf) -> Result<(), String> {
    let names = || clip.joints.iter().map(String::as_str);
    match joints.iter().find(|joint| !names().any(|name| name == **joint)) {
        None => Ok(()),
        Some(joint) => {
            Err(format!("the clip has no joint {joint}{}", did_you_mean(joint, names())))
        }
    }
}

/// Checks that a pose can be sampled from the clip.
pub(super) fn source(source: Source, clip: &MadeOf) -> Result<(), String> {
    let (first, last) = (clip.first_frame, clip.last_frame());
    let is_in_clip = |place: f64| clip.frames > 0 && (first as f64..=last as f64).contains(&place);
    let (places, share) = match source {
        Source::At(place) => ([place, place], 0.0),
        Source::Between { from, to, share } => ([from, to], share),
    };
    if let Some(place) = places.into_iter().find(|place| !is_in_clip(*place)) {
        return Err(format!(
            "frame {place} is not in the clip, which has frames {first} to {last}"
        ));
    }
    if !(0.0..=1.0).contains(&share) {
        return Err(format!(
            "share is {share}; it is 0 at the first frame of between and 1 at the second"
        ));
    }
    Ok(())
}
