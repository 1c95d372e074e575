//! Reference footage (参考) recorded beside the motion: pictures and sound. The studio shows and plays them; they never
//! change a drawing.

use serde::{Deserialize, Serialize};

use super::file;
use crate::error::Error;
use crate::sheet::is_default;
use crate::time::KOMA_RATE;

/// Accepted picture rates, per second.
const RATES: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
/// Largest offset in koma: the length of the longest sheet.
const FARTHEST: i64 = 1_000_000;

/// Pictures and sound beside a take. File names are relative to the clip's folder, or absolute.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Footage {
    /// A folder of pictures, one picture of a numbered sequence, or a video. Empty if there are none.
    #[serde(skip_serializing_if = "is_default")]
    pub pictures: String,
    /// Pictures per second; default 24. A video is split into 24 per second.
    #[serde(skip_serializing_if = "is_usual")]
    pub fps: f64,
    /// The koma, from 0, at which the first picture appears; negative if recording began before the motion.
    #[serde(skip_serializing_if = "is_default")]
    pub offset: i64,
    /// A WAV file. Empty if there is none.
    #[serde(skip_serializing_if = "is_default")]
    pub sound: String,
    /// The koma, from 0, at which the sound begins; negative if it began before the motion.
    #[serde(skip_serializing_if = "is_default")]
    pub sound_offset: i64,
}

impl Default for Footage {
    fn default() -> Self {
        let none = String::new();
        Self { pictures: none.clone(), fps: KOMA_RATE, offset: 0, sound: none, sound_offset: 0 }
    }
}

fn is_usual(fps: &f64) -> bool {
    *fps == KOMA_RATE
}

impl Footage {
    /// Extensions of picture files, in lower case.
    pub const PICTURES: [&str; 3] = ["png", "jpg", "jpeg"];
    /// Extensions of video files.
    pub const VIDEOS: [&str; 6] = ["mp4", "mov", "m4v", "webm", "mkv", "avi"];
    /// Extensions of sound files.
    pub const SOUNDS: [&str; 1] = ["wav"];

    /// Reads the `[footage]` section of a recipe file; the default if there is none.
    ///
    /// # Errors
    /// [`Error::Recipe`] with line and column when the text is not TOML or a value is out of range.
    ///
    /// ```
    /// use genga::recipe::{Footage, Recipe};
    ///
    /// let text = "[footage]\npictures = \"take_0001.png\"\noffset = -12\n";
    /// assert_eq!(Footage::parse(text)?.offset, -12);
    /// assert!(Recipe::parse(text).is_ok(), "the chain passes over it");
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        file::footage(text)
    }

    /// Writes the section of a recipe file; empty for the default.
    pub fn write(&self) -> String {
        if *self == Self::default() {
            return String::new();
        }
        let lines = toml::to_string(self).unwrap_or_default();
        format!(
            "\n# What was recorded beside the motion (参考), for the studio: no drawing changes by it.\n\
             # Files are named from the clip's folder; offsets are koma.\n[footage]\n{lines}"
        )
    }

    /// Returns the index of the picture shown at a koma, both from 0; `None` before the first.
    ///
    /// ```
    /// use genga::recipe::Footage;
    ///
    /// let footage = Footage { fps: 30.0, offset: 12, ..Footage::default() };
    /// assert_eq!([11, 12, 16].map(|koma| footage.picture(koma, 24.0)), [None, Some(0), Some(5)]);
    /// ```
    pub fn picture(&self, koma: usize, koma_rate: f64) -> Option<usize> {
        let gone = koma as i64 - self.offset;
        // The epsilon keeps 4/24 · 30 = 5 from rounding down to 4.999….
        (gone >= 0).then(|| (gone as f64 * self.fps / koma_rate + 1e-9).floor() as usize)
    }

    /// Returns the second of the sound heard at a koma, which may be fractional; negative before the sound begins.
    pub fn second(&self, koma: f64, koma_rate: f64) -> f64 {
        (koma - self.sound_offset as f64) / koma_rate
    }

    /// Describes the first invalid value, if there is one.
    pub(super) fn fault(&self) -> Option<String> {
        let Self { fps, offset, sound_offset, .. } = self;
        if !RATES.contains(fps) {
            let (least, most) = (RATES.start(), RATES.end());
            return Some(format!(
                "footage.fps: expected {least} to {most} pictures a second, found {fps}"
            ));
        }
        let is_far = |koma: &&i64| !(-FARTHEST..=FARTHEST).contains(*koma);
        let far = [offset, sound_offset].into_iter().find(is_far)?;
        Some(format!(
            "footage: an offset of {far} koma is beyond any sheet; expected at most {FARTHEST}"
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edits::Edits;
    use crate::recipe::Recipe;

    #[test]
    fn a_recipe_has_it_beside_what_the_chain_reads() {
        let (mut recipe, edits) = (Recipe::default(), Edits::default());
        recipe.set("spacing.on", "3").unwrap();
        for footage in [
            Footage::default(),
            Footage { sound: "声 1.wav".into(), ..Footage::default() },
            Footage {
                pictures: "take/\"a\"_0001.png".into(),
                fps: 29.97,
                offset: -12,
                sound: "take.wav".into(),
                sound_offset: 7,
            },
        ] {
            let text = recipe.write(&edits) + &footage.write();
            assert_eq!(Footage::parse(&text).unwrap(), footage, "{text}");
            assert_eq!(Recipe::parse(&text).unwrap(), (recipe.clone(), edits.clone()));
        }
        assert_eq!(Footage::parse("rate = 24").unwrap(), Footage::default());
    }

    #[test]
    fn what_it_cannot_be_is_refused_with_its_place_by_whoever_reads_the_recipe() {
        for (wrong, says) in [
            (
                "[footage]\nfps = 0\n",
                "1:2: footage.fps: expected 0.1 to 1000 pictures a second, found 0",
            ),
            ("[footage]\nfps = nan\n", "found NaN"),
            ("[footage]\noffset = 1.5\n", "2:10: invalid type"),
            ("[footage]\noffset = 2000000\n", "an offset of 2000000 koma is beyond any sheet"),
            ("[footage]\nvideo = \"a\"\n", "2:1: unknown field `video`"),
            ("footage = 3\n", "1:11: invalid type"),
        ] {
            let errors = [Footage::parse(wrong).unwrap_err(), Recipe::parse(wrong).unwrap_err()];
            for error in errors.map(|error| error.to_string()) {
                assert!(error.contains(says), "{error}");
            }
        }
    }

    #[test]
    fn every_koma_has_its_picture_and_its_second() {
        let footage = Footage { fps: 60.0, offset: -2, sound_offset: 24, ..Footage::default() };
        assert_eq!(
            [0, 1, 24].map(|koma| footage.picture(koma, 24.0)),
            [Some(5), Some(7), Some(65)]
        );
        assert_eq!([0.0, 24.0, 36.0].map(|koma| footage.second(koma, 24.0)), [-1.0, 0.0, 0.5]);
        for koma in 0..2000 {
            let own = Footage::default();
            assert_eq!(own.picture(koma, 24.0), Some(koma), "a picture a koma");
        }
    }
}
