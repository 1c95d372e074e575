//! Reference footage (参考), recorded beside the motion: adds files to a take and loads them.

use std::path::Path;

use egui::Ui;

use super::Studio;
use super::footage_cache::Told;
use super::notice::Message;
use genga::recipe::Footage;

fn has_ending(path: &Path, endings: &[&str]) -> bool {
    let own = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    own.is_some_and(|own| endings.contains(&&*own))
}

/// Whether a file is reference footage, judging by its extension: a picture, a video or a sound.
pub(super) fn is_beside(path: &Path) -> bool {
    [&Footage::PICTURES[..], &Footage::VIDEOS, &Footage::SOUNDS]
        .iter()
        .any(|endings| has_ending(path, endings))
}

impl Studio {
    /// Loads the footage that the document names, and reports what has been read.
    pub(super) fn renew_footage(&mut self, ui: &Ui) {
        let footage = self.take.as_ref().map(|take| (take, &take.wanted.footage));
        let place = |name: fn(&Footage) -> &String| {
            footage.and_then(|(take, footage)| take.place_of(name(footage)))
        };
        let (pictures, sound) = (place(|of| &of.pictures), place(|of| &of.sound));
        self.reel.take_up(&self.desk, pictures.as_deref());
        self.track.take_up(&self.desk, sound.as_deref());
        for told in self.reel.receive(&self.desk, ui.ctx()) {
            match told {
                Told::Note(text) => self.say(text),
                Told::Failure(text) => self.fail(text),
            }
        }
        if let Some(text) = self.track.receive() {
            self.message = Some(Message::failure(text));
        }
    }

    /// Opens the panel of reference footage.
    pub(super) fn ask_footage(&mut self) {
        if let Some(take) = &self.take {
            self.footage.ask(&take.wanted.footage);
        }
    }

    /// Adds a picture, a video, a folder of pictures or a sound to the take as reference.
    pub(super) fn put_beside(&mut self, path: &Path) {
        let Some(take) = &self.take else {
            return self.fail("Open a clip first, then pictures or sound.".into());
        };
        let (name, now) = (take.name_of(path), take.wanted.footage.clone());
        let none = Footage::default();
        let footage = match has_ending(path, &Footage::SOUNDS) {
            true => Footage { sound: name, sound_offset: none.sound_offset, ..now },
            false => Footage { pictures: name, fps: none.fps, offset: none.offset, ..now },
        };
        self.set_footage(footage);
        self.ask_footage();
    }

    pub(super) fn set_footage(&mut self, footage: Footage) {
        if let Some(take) = &mut self.take {
            take.wanted.footage = footage;
            self.message = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_known_by_its_ending() {
        for name in ["a.png", "b/c.JPG", "d.Mp4", "e.wav"] {
            assert!(is_beside(Path::new(name)), "{name}");
        }
        for name in ["a.bvh", "b.toml", "png", "c.glb", ""] {
            assert!(!is_beside(Path::new(name)), "{name}");
        }
    }
}
