//! The timing alone, for players of the same take: a CSV table, and a list for ffmpeg.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use crate::{Cut, Sink, csv_table, number};
use genga::error::Error;
use genga::knob::{Knobs, knob, knobs};
use genga::sheet::{Layer, Sheet};

/// Naming of the picture sequence that the timing is applied to: the rendered source, one picture per frame.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Remap {
    /// Name pattern of a picture, with `%d` for its number, or `%04d` for at least four digits; default
    /// `%04d.png`, as Blender names them.
    pub pictures: String,
    /// Number of the picture of the clip's frame 0, from 0; default 1, because Blender imports it as frame 1.
    pub first: usize,
}

impl Default for Remap {
    fn default() -> Self {
        Self { pictures: "%04d.png".into(), first: 1 }
    }
}

knobs!(remap::Remap {
    pictures: knob(
        "連番の名前",
        "File names of the rendered pictures of the source; %04d is the number in four digits.",
        "素材をレンダリングした連番のファイル名。%04dが4桁の番号。",
    )
    .unit("words"),
    first: knob(
        "最初の番号",
        "Number of the picture of frame 0 of the clip.",
        "素材のフレーム0の絵の番号。",
    )
    .unit("frames"),
});

impl Remap {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the name has no place for the number, or more than one.
    pub fn validate(&self) -> Result<(), Error> {
        self.check()?;
        self.naming().map(drop)
    }

    /// Writes a layer as a list for ffmpeg's *concat* demuxer: which source picture is shown, and for how long.
    /// Each drawing becomes the picture of the nearest frame.
    ///
    /// # Errors
    /// The errors of [`Remap::validate`].
    pub fn ffconcat(&self, sheet: &Sheet, layer: &Layer) -> Result<String, Error> {
        let (rate, naming) = (sheet.clock.koma_rate, self.naming()?);
        let mut list = String::from("ffconcat version 1.0\n");
        for (at, exposure) in layer.exposures.iter().enumerate() {
            let picture = quoted(&naming.format(nearest(layer, exposure.drawing) + self.first));
            // ffmpeg assumes 25 pictures per second unless told otherwise.
            let file = format!("file {picture}\noption framerate {rate}\n");
            let is_last = at + 1 == layer.exposures.len();
            let koma = if is_last { exposure.koma - 1 } else { exposure.koma };
            if koma > 0 {
                let seconds = koma as f64 / rate;
                let _ = writeln!(list, "{file}duration {seconds:.6}");
            }
            // The last koma is a file of its own, because ffmpeg ignores the duration of the last file.
            if is_last {
                list.push_str(&file);
            }
        }
        Ok(list)
    }

    /// Parses the name pattern.
    fn naming(&self) -> Result<Naming<'_>, Error> {
        let parted = self.pictures.split_once('%').and_then(|(before, rest)| {
            let (digits, after) = rest.split_once('d')?;
            let width: usize = if digits.is_empty() { 0 } else { digits.parse().ok()? };
            (width <= 20 && !after.contains('%')).then_some(Naming { before, width, after })
        });
        parted.ok_or_else(|| {
            let message =
                format!("expected a name with one %d or %04d in it, found \"{}\"", self.pictures);
            Error::setting("remap.pictures", message)
        })
    }

    /// Writes the files of a sheet: the table, and a list per layer.
    pub(super) fn write(&self, cut: &Cut<'_>, put: &mut Sink<'_>) -> Result<(), Error> {
        let layers = &cut.sheet.layers;
        for (at, layer) in layers.iter().enumerate() {
            let list = self.ffconcat(cut.sheet, layer)?;
            let name = match layers.len() {
                1 => "remap.ffconcat".into(),
                _ => Cut::file_of(&layer.name, &format!("remap-{}-CUT.ffconcat", at + 1)),
            };
            put(&name, list.as_bytes())?;
        }
        Ok(())
    }
}

/// A name pattern, split at the place for the number.
struct Naming<'a> {
    before: &'a str,
    width: usize,
    after: &'a str,
}

impl Naming<'_> {
    fn format(&self, number: usize) -> String {
        let Self { before, width, after } = self;
        format!("{before}{number:0width$}{after}")
    }
}

/// The frame nearest to a drawing's instant.
fn nearest(layer: &Layer, drawing: usize) -> usize {
    layer.drawings[drawing].source.place().round().max(0.0) as usize
}

/// Quotes a word for ffmpeg's lists.
fn quoted(word: &str) -> String {
    format!("'{}'", word.replace('\'', "'\\''"))
}

/// Writes `koma,source_frame,source_time_s,nearest_frame`: the timing alone, for any rig that plays the same
/// source. Koma count from 1. A sheet of several layers has one row per koma and layer, with a second column
/// `layer`.
///
/// A root on ones is not listed, because it follows the source frame by frame.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn remap_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let has_layers = sheet.layers.len() > 1;
    let rows = sheet.layers.iter().flat_map(|layer| {
        layer.koma().enumerate().map(move |(koma, index)| {
            let place = layer.drawings[index].source.place();
            let seconds = number(sheet.clock.seconds_from_place(place));
            let name = has_layers.then(|| layer.name.clone());
            let row = [
                Some((koma + 1).to_string()),
                name,
                Some(number(place)),
                Some(seconds),
                Some(nearest(layer, index).to_string()),
            ];
            row.into_iter().flatten()
        })
    });
    let mut header = vec!["koma", "source_frame", "source_time_s", "nearest_frame"];
    if has_layers {
        header.insert(1, "layer");
    }
    csv_table(&header, rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::xdts::tests::sheets::{layer, sheet};

    #[test]
    fn a_list_shows_the_nearest_picture_for_as_long_as_the_drawing() {
        let sheet = sheet(vec![layer("A", "eie", &[(0, 3), (1, 1), (2, 2)])]);
        let remap = Remap { pictures: "it's/%03d.exr".into(), first: 0 };
        let list = remap.ffconcat(&sheet, &sheet.layers[0]).unwrap();
        let expected = "ffconcat version 1.0\n\
            file 'it'\\''s/010.exr'\noption framerate 24\nduration 0.125000\n\
            file 'it'\\''s/013.exr'\noption framerate 24\nduration 0.041667\n\
            file 'it'\\''s/016.exr'\noption framerate 24\nduration 0.041667\n\
            file 'it'\\''s/016.exr'\noption framerate 24\n";
        assert_eq!(list, expected);
    }

    #[test]
    fn a_name_without_a_place_for_its_number_is_refused() {
        for (pictures, is_good) in [
            ("%d.png", true),
            ("a_%05d.png", true),
            ("a.png", false),
            ("%x.png", false),
            ("%d_%d.png", false),
            ("%99d.png", false),
        ] {
            let remap = Remap { pictures: pictures.into(), first: 1 };
            assert_eq!(remap.validate().is_ok(), is_good, "{pictures}");
        }
        let said = Remap { pictures: "a.png".into(), first: 1 }.validate().unwrap_err();
        assert!(said.to_string().contains("%04d"), "{said}");
    }
}
