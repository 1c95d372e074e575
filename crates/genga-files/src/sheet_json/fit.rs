//! Checks whether a sheet and a clip belong together.

use super::{MadeOf, SheetFile, digest};
use genga::error::{Error, Warning};
use genga::motion::{Clip, laid, middle_round};
use genga::sheet::Layer;
use genga::time::{Clock, Frame};

/// Warning code: the clip's joints have the sheet's names, but other bones.
pub const OTHER_BONES: &str = "W_SHEET_BONES";
/// Warning code: the clip's motion differs from the one the sheet was made from.
pub const OTHER_MOTION: &str = "W_SHEET_MOTION";
/// Warning code: a person's edit changed the length of the sheet.
pub const OTHER_LENGTH: &str = "W_SHEET_LENGTH";

impl MadeOf {
    /// Describes a clip.
    pub fn new(file: &str, clip: &Clip) -> Self {
        Self {
            file: file.into(),
            frame_rate: clip.rate().fps(),
            first_frame: clip.first().0,
            frames: clip.len(),
            motion: digest::motion(clip),
            skeleton: digest::skeleton(clip.skeleton()),
            joints: clip.skeleton().joints.iter().map(|joint| joint.name.clone()).collect(),
        }
    }

    /// Number of its last frame; that of the first for an empty clip.
    pub fn last_frame(&self) -> usize {
        self.first_frame.saturating_add(self.frames.saturating_sub(1))
    }
}

impl SheetFile {
    /// Cuts out the part of a clip that the sheet was made from, and warns of differences. The clip must be the
    /// whole file, with its lead-in and untrimmed. The drawings are poses of what `exaggerate` makes of it.
    ///
    /// Other bones, or another motion of the same joints, are not errors: a take that was cleaned up keeps its
    /// sheet.
    ///
    /// # Errors
    /// [`Error::Sheet`] saying which joint, rate or frames do not fit.
    pub fn fit(&self, clip: Clip) -> Result<(Clip, Vec<Warning>), Error> {
        let made_of = &self.clip;
        self.fit_joints(&clip)?;
        let rate = clip.rate().fps();
        if rate != made_of.frame_rate {
            let meant = made_of.frame_rate;
            return Err(Error::sheet(format!(
                "the sheet is for {meant} frames a second, the clip has {rate}; if it is the same take, \
                 --fps {meant} reads it so"
            )));
        }
        let (first, last) = (made_of.first_frame, made_of.last_frame());
        let (begin, end) = (clip.first(), clip.last());
        let Ok(clip) = clip.trimmed(Frame(first), Frame(last.saturating_add(1))) else {
            return Err(Error::sheet(format!(
                "the sheet shows frames {first} to {last}, the clip has frames {begin} to {end}"
            )));
        };
        let now = MadeOf::new(&made_of.file, &clip);
        let mut notes = Vec::new();
        if now.skeleton != made_of.skeleton {
            notes.push(Warning::new(
                OTHER_BONES,
                "the clip's joints have other bones or channels than those that the sheet was made of",
            ));
        } else if now.motion != made_of.motion {
            notes.push(Warning::new(
                OTHER_MOTION,
                "the clip has another motion than the one that the sheet was made of; the drawings are \
                 taken from this one",
            ));
        }
        notes.extend(self.other_length());
        Ok((clip, notes))
    }

    /// Warns of the layers of an edited sheet that have another length than its clip.
    fn other_length(&self) -> Option<Warning> {
        let Clock { frame_rate, koma_rate, .. } = self.sheet.clock;
        let whole = frame_rate.koma_from_frames(self.clip.frames, koma_rate);
        // An empty layer is refused later, with a reason of its own.
        let is_whole = |koma: usize| match self.sheet.repeat {
            None => koma == whole,
            Some(round) => koma.is_multiple_of(round.koma),
        };
        let is_other = |layer: &&Layer| layer.length() > 0 && !is_whole(layer.length());
        let layers = self.sheet.layers.iter().filter(is_other);
        let layers: Vec<String> =
            layers.map(|layer| format!("layer {} has {}", layer.name, layer.length())).collect();
        let is_changed = !self.is_as_made() && !layers.is_empty();
        is_changed.then(|| {
            let layers = layers.join(", ");
            let message =
                format!("the sheet's length was changed: the clip has {whole} koma, {layers}");
            Warning::new(OTHER_LENGTH, message)
        })
    }

    /// Applies the sheet's exaggeration to the fitted clip; `None` if there is none. A loop is exaggerated in the midst of
    /// its rounds.
    ///
    /// # Errors
    /// The errors of [`Exaggerate::apply`](genga::exaggerate::Exaggerate::apply).
    pub fn drawn(&self, clip: &Clip) -> Result<Option<Clip>, Error> {
        let drawn = || match self.sheet.repeat {
            None => self.exaggerate.apply(clip),
            Some(round) => {
                let rate = round.frame_rate(self.sheet.clock.koma_rate)?;
                let drawn = self.exaggerate.apply(&laid(clip, 3, 0).with_rate(rate))?;
                Ok(middle_round(&drawn).with_rate(clip.rate()).with_beside_of(clip))
            }
        };
        (!self.exaggerate.is_off()).then(drawn).transpose()
    }

    fn fit_joints(&self, clip: &Clip) -> Result<(), Error> {
        let (sheet, clip) = (&self.clip.joints, &clip.skeleton().joints);
        if let Some((sheet, clip)) = sheet.iter().zip(clip).find(|(a, b)| **a != b.name) {
            let clip = &clip.name;
            return Err(Error::sheet(format!(
                "the sheet has the joint {sheet} where the clip has {clip}: they belong to different \
                 skeletons"
            )));
        }
        let (ours, theirs) = (sheet.len(), clip.len());
        let extra = match ours.cmp(&theirs) {
            std::cmp::Ordering::Equal => return Ok(()),
            std::cmp::Ordering::Greater => format!("{} is only in the sheet", sheet[theirs]),
            std::cmp::Ordering::Less => format!("{} is only in the clip", clip[ours].name),
        };
        Err(Error::sheet(format!("the sheet has {ours} joints, the clip {theirs}: {extra}")))
    }
}
