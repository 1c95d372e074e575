//! The timing alone, for players of the same take: a CSV table, and a list for ffmpeg.

use std::fmt::Write;

use serde::{Deserialize, Serialize};

use crate::{Cut, Sink, csv_table, number};
use genga::error::{Error, Warning};
use genga::knob::{Knobs, knob, knobs};
use genga::sheet::{Layer, RootMotion, Sheet};
use genga::time::{Frame, FrameRate};

/// The picture sequence that the timing is applied to: the rendered source.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Remap {
    /// Name pattern of a picture, with `%d` for its number, or `%04d` for at least four digits; default
    /// `%04d.png`, as Blender names them.
    pub pictures: String,
    /// Rendered pictures per second, 0.001 to 1,000,000; `None`, the default, is one per frame of the source.
    pub fps: Option<f64>,
    /// Number of the picture of the clip's frame 0, from 0; default 1, because Blender imports it as frame 1.
    pub first: usize,
}

impl Default for Remap {
    fn default() -> Self {
        Self { pictures: "%04d.png".into(), fps: None, first: 1 }
    }
}

knobs!(remap::Remap {
    pictures: knob(
        "連番の名前",
        "File names of the rendered pictures of the source; %04d is the number in four digits.",
        "素材をレンダリングした連番のファイル名。%04dが4桁の番号。",
    )
    .unit("words"),
    fps: knob(
        "毎秒の枚数",
        "Pictures per second at which the source was rendered; none is one picture per frame.",
        "素材をレンダリングした毎秒の枚数。noneは1フレームに1枚。",
    )
    .unit("pictures a second")
    .at_least(1e-3)
    .at_most(1e6),
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
    /// Each drawing becomes the picture nearest to its instant. Comments say which pictures the list expects, up to
    /// the one of the source frame `last`, and how long nothing is shown before and after: a list has pictures alone.
    ///
    /// # Errors
    /// The errors of [`Remap::validate`].
    pub fn ffconcat(&self, sheet: &Sheet, layer: &Layer, last: Frame) -> Result<String, Error> {
        let (rate, naming) = (sheet.clock.koma_rate, self.naming()?);
        let source = sheet.clock.frame_rate;
        let rendered = self.fps.map_or(Ok(source), FrameRate::new)?;
        let per_frame = rendered.fps() / source.fps();
        let picture = |place: f64| (place * per_frame).round().max(0.0) as usize;
        let name = |picture: usize| quoted(&naming.format(self.first + picture));
        let last = picture(last.0 as f64);
        let mut list = format!(
            "ffconcat version 1.0\n\
             # {} pictures, {rendered} a second: {} is the clip's frame 0, {} its last\n",
            last + 1,
            name(0),
            name(last)
        );
        let seconds = |koma: usize| koma as f64 / rate;
        let [before, after] = [sheet.blank.before, sheet.blank.after].map(seconds);
        if !sheet.blank.is_none() {
            let _ = writeln!(
                list,
                "# nothing is shown for {before:.6} s before the first picture and {after:.6} s after the last: \
                 ffmpeg -vf tpad=start_duration={before:.6}:stop_duration={after:.6} adds them black"
            );
        }
        for (at, exposure) in layer.exposures.iter().enumerate() {
            let picture = name(picture(layer.drawings[exposure.drawing].source.place()));
            // ffmpeg assumes 25 pictures per second unless told otherwise.
            let file = format!("file {picture}\noption framerate {rate}\n");
            let is_last = at + 1 == layer.exposures.len();
            let koma = if is_last { exposure.koma - 1 } else { exposure.koma };
            if koma > 0 {
                let _ = writeln!(list, "{file}duration {:.6}", seconds(koma));
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
            let list = self.ffconcat(cut.sheet, layer, cut.clip.last())?;
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

/// Warns that the instants of an exaggerated motion are those of the take, which is not shown as it is.
pub(crate) fn notes(cut: &Cut<'_>) -> Vec<Warning> {
    let message = "exaggerate.*: source frames, also those of remap.csv, name instants of the take before it was \
                   exaggerated; a rig that plays the take shows other poses";
    let exaggerated = cut.exaggerated.is_some();
    exaggerated.then(|| Warning::new("W_EXAGGERATED", message)).into_iter().collect()
}

/// Writes `koma,source_frame,source_time_s,nearest_frame`: the timing alone, for any rig that plays the same
/// source. Koma count from 1; one without a row is blank. A sheet of several layers has one row per koma and layer, with a second column
/// `layer`.
///
/// A root on ones adds the column `root_frame`: the source frame of the root's position.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn remap_csv(sheet: &Sheet) -> Result<String, Error> {
    sheet.check()?;
    let has_layers = sheet.layers.len() > 1;
    let is_on_ones = sheet.root == RootMotion::Ones;
    let rows = sheet.layers.iter().flat_map(|layer| {
        layer.koma().zip(layer.source_places(sheet.clock)).enumerate().map(
            move |(koma, (index, root))| {
                let place = layer.drawings[index].source.place();
                let seconds = number(sheet.clock.seconds_from_place(place));
                let name = has_layers.then(|| layer.name.clone());
                let row = [
                    Some((sheet.blank.before + koma + 1).to_string()),
                    name,
                    Some(number(place)),
                    Some(seconds),
                    Some(nearest(layer, index).to_string()),
                    is_on_ones.then(|| number(root)),
                ];
                row.into_iter().flatten()
            },
        )
    });
    let mut header = vec!["koma", "source_frame", "source_time_s", "nearest_frame"];
    if has_layers {
        header.insert(1, "layer");
    }
    if is_on_ones {
        header.push("root_frame");
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
        let remap = Remap { pictures: "it's/%03d.exr".into(), first: 0, ..Remap::default() };
        let list = remap.ffconcat(&sheet, &sheet.layers[0], Frame(19)).unwrap();
        let expected = "ffconcat version 1.0\n\
            # 20 pictures, 120 a second: 'it'\\''s/000.exr' is the clip's frame 0, 'it'\\''s/019.exr' its last\n\
            file 'it'\\''s/010.exr'\noption framerate 24\nduration 0.125000\n\
            file 'it'\\''s/013.exr'\noption framerate 24\nduration 0.041667\n\
            file 'it'\\''s/016.exr'\noption framerate 24\nduration 0.041667\n\
            file 'it'\\''s/016.exr'\noption framerate 24\n";
        assert_eq!(list, expected);
    }

    #[test]
    fn a_root_on_ones_has_a_source_frame_of_its_own_on_every_koma() {
        let layers = vec![layer("A", "eie", &[(0, 3), (1, 1), (2, 2), (0, 1)])];
        let sheet = Sheet { root: RootMotion::Ones, ..sheet(layers) };
        let table = remap_csv(&sheet).unwrap();
        let roots: Vec<&str> = table.lines().map(|row| row.rsplit(',').next().unwrap()).collect();
        assert_eq!(roots, ["root_frame", "10", "11", "12", "13", "16", "16", "10"]);
    }

    #[test]
    fn pictures_of_another_rate_are_those_of_the_same_instants() {
        // Frames 10, 13 and 16 of a take of 120 a second.
        let sheet = sheet(vec![layer("A", "eie", &[(0, 3), (1, 1), (2, 2)])]);
        let shown = |fps: f64, first| {
            let remap = Remap { fps: Some(fps), first, ..Remap::default() };
            let list = remap.ffconcat(&sheet, &sheet.layers[0], Frame(599)).unwrap();
            let files: Vec<String> =
                list.lines().filter(|line| line.starts_with("file")).map(String::from).collect();
            (list.lines().nth(1).unwrap().to_owned(), files)
        };
        let (expects, files) = shown(24.0, 1);
        assert_eq!(
            expects,
            "# 121 pictures, 24 a second: '0001.png' is the clip's frame 0, '0121.png' its last"
        );
        assert_eq!(
            files,
            ["file '0003.png'", "file '0004.png'", "file '0004.png'", "file '0004.png'"]
        );
        let (expects, files) = shown(23.976, 101);
        assert!(expects.starts_with("# 121 pictures, 23.976 a second: '0101.png' is"), "{expects}");
        assert_eq!(files[..2], ["file '0103.png'", "file '0104.png'"]);
        let usual = Remap::default().ffconcat(&sheet, &sheet.layers[0], Frame(599)).unwrap();
        assert!(shown(120.0, 1).1.iter().all(|file| usual.contains(file)), "{usual}");
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
            let remap = Remap { pictures: pictures.into(), ..Remap::default() };
            assert_eq!(remap.validate().is_ok(), is_good, "{pictures}");
        }
        let said = Remap { pictures: "a.png".into(), ..Remap::default() }.validate().unwrap_err();
        assert!(said.to_string().contains("%04d"), "{said}");
    }
}
