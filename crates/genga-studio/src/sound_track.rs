//! The sound of a take (音): its waveform, and its playback along with the sheet.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::host::{Host, Playing};
use super::player::Run;
use super::task::{Look, Task};
use super::waveform::Waveform;

/// A sound that is being read, or has been.
#[derive(Default)]
pub(super) struct Track {
    of: Option<PathBuf>,
    listening: Option<Task<Result<Waveform, String>>>,
    pub(super) waveform: Option<Waveform>,
    playing: Option<Box<dyn Playing>>,
    /// Run of the player for which playback was last started or attempted.
    heard: Option<Run>,
    /// Whether the person has muted the sound.
    pub(super) is_silent: bool,
}

impl Track {
    /// Switches to the sound of another path. Does nothing if the path is unchanged.
    pub(super) fn take_up(&mut self, desk: &Arc<dyn Host>, of: Option<&Path>) {
        if self.of.as_deref() == of {
            return;
        }
        *self = Self { of: of.map(Path::to_owned), is_silent: self.is_silent, ..Self::default() };
        self.listening = of.map(|of| {
            let (desk, of) = (Arc::clone(desk), of.to_owned());
            Task::begin(move || desk.sound(&of))
        });
    }

    /// Collects what has been read. Returns why there is nothing to see or hear.
    pub(super) fn receive(&mut self) -> Option<String> {
        match self.listening.as_ref().map(Task::look) {
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

    /// Plays along with the player, from the given second of the sound, and starts again with every run. Returns why it
    /// cannot.
    pub(super) fn follow(
        &mut self,
        desk: &Arc<dyn Host>,
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
        // Not while the play head is dragged: the sound would start again at every koma.
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
