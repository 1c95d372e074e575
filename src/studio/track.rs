//! The sound of a take (音): its waveform, and the sound itself while the sheet is played.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::desk::{Desk, Playing};
use super::errand::{Errand, Look};
use super::player::Run;
use super::waveform::Waveform;

/// A sound on its way and there.
#[derive(Default)]
pub(super) struct Track {
    of: Option<PathBuf>,
    listening: Option<Errand<Result<Waveform, String>>>,
    pub(super) waveform: Option<Waveform>,
    playing: Option<Box<dyn Playing>>,
    /// Which run of the player is heard, or could not be.
    heard: Option<Run>,
    /// Whether a person wants to hear nothing.
    pub(super) is_silent: bool,
}

impl Track {
    /// Takes up another sound, if it is another.
    pub(super) fn take_up(&mut self, desk: &Arc<dyn Desk>, of: Option<&Path>) {
        if self.of.as_deref() == of {
            return;
        }
        *self = Self { of: of.map(Path::to_owned), is_silent: self.is_silent, ..Self::default() };
        self.listening = of.map(|of| {
            let (desk, of) = (Arc::clone(desk), of.to_owned());
            Errand::begin(move || desk.sound(&of))
        });
    }

    /// Takes what has come. Gives why there is nothing to see, or to hear.
    pub(super) fn receive(&mut self) -> Option<String> {
        match self.listening.as_ref().map(Errand::look) {
            Some(Look::Done(waveform)) => {
                self.listening = None;
                match waveform {
                    Ok(waveform) => self.waveform = Some(waveform),
                    Err(error) => return Some(error),
                }
            }
            Some(Look::BrokeOff) => self.listening = None,
            Some(Look::Waiting) | None => {}
        }
        let fault = self.playing.as_ref().and_then(|playing| playing.fault())?;
        self.playing = None;
        Some(fault)
    }

    pub(super) fn is_waiting(&self) -> bool {
        self.listening.is_some()
    }

    /// Is heard as the player plays: from a second of the sound on, anew with every run. Gives why it is not.
    pub(super) fn follow(
        &mut self,
        desk: &Arc<dyn Desk>,
        run: Option<Run>,
        second: f64,
        is_held: bool,
    ) -> Option<String> {
        let run = run.filter(|_| !self.is_silent);
        if self.heard.is_some() && run != self.heard {
            (self.playing, self.heard) = (None, None);
        }
        let (Some(waveform), Some(of)) = (&self.waveform, &self.of) else { return None };
        let is_there = (0.0..waveform.seconds()).contains(&second);
        // While a hand pulls the play head along nothing is begun: it would be begun with every koma.
        if run.is_none() || self.heard == run || !is_there || is_held {
            return None;
        }
        self.heard = run;
        match desk.play(of, second) {
            Ok(playing) => {
                self.playing = Some(playing);
                None
            }
            Err(error) => Some(error),
        }
    }
}
