//! The formats that can be asked for by name. A new one is a row here and a file of its own.

use std::fmt;

#[cfg(feature = "pictures")]
use crate::deliver::cut_folder;
use crate::deliver::settings::Settings;
use crate::deliver::{
    Cut, Drawings, Rows, Sink, after_effects, columns_csv, figures, keys_bvh, limited_bvh,
    pictures, remap_csv, sheet_csv, sheet_json, sts, vrma, xsheet,
};
use crate::error::{Error, Warning};
use crate::sheet::{Layer, Sheet};

/// A form in which a sheet is handed over (納品形式).
#[derive(Clone, Copy)]
pub struct Format {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// What it is, in a line.
    pub help: &'static str,
    /// The word of the field.
    pub japanese: &'static str,
    /// The files that it writes: `CUT` stands for the name of the cut, `0001` for the number of a
    /// drawing or a page.
    pub files: &'static [&'static str],
    /// Whether it writes as many files as a sheet has drawings or pages, by their numbers.
    pub is_numbered: bool,
    /// Makes the files and hands them on, one at a time.
    make: fn(&Cut<'_>, &Settings, &mut Sink<'_>) -> Result<(), Error>,
    /// What a person should know of the files.
    notes: fn(&Cut<'_>, &Settings) -> Result<Vec<Warning>, Error>,
}

/// What most rows have in common: files of fixed names, of which there is nothing to say.
const PLAIN: Format = Format {
    name: "",
    help: "",
    japanese: "",
    files: &[],
    is_numbered: false,
    make: |_, _, _| Ok(()),
    notes: |_, _| Ok(Vec::new()),
};

/// Every format, in the order in which they are listed and written.
pub const FORMATS: &[Format] = &[
    Format {
        name: "json",
        help: "the sheet itself, to edit by hand and deliver again",
        japanese: "タイムシート",
        files: &["sheet.json"],
        make: |cut, _, put| put("sheet.json", sheet_json::write(cut)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "csv",
        help: "tables of the keys, of every drawing and of every koma",
        japanese: "表",
        files: &["keys.csv", "drawings.csv", "sheet.csv"],
        make: |cut, settings, put| {
            let table = |rows| Drawings { cut: cut.name.into(), rows }.write(cut.clip, cut.sheet);
            let csv = &settings.csv;
            put("keys.csv", &csv.encode(table(Rows::Keys)?))?;
            put("drawings.csv", &csv.encode(table(Rows::All)?))?;
            put("sheet.csv", &csv.encode(sheet_csv(cut.sheet)?))
        },
        ..PLAIN
    },
    Format {
        name: "remap",
        help: "the timing alone, for a rig or rendered pictures of the same take",
        japanese: "タイムリマップ",
        files: &["remap.csv", "remap.ffconcat"],
        make: |cut, settings, put| {
            put("remap.csv", &settings.csv.encode(remap_csv(cut.sheet)?))?;
            settings.remap.write(cut, put)
        },
        ..PLAIN
    },
    Format {
        name: "bvh",
        help: "the motion stepped: a row a koma, holds repeated",
        japanese: "リミテッドモーション",
        files: &["limited.bvh"],
        make: |cut, _, put| put("limited.bvh", limited_bvh(cut.clip, cut.sheet)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "bvh-keys",
        help: "the key drawings as poses: a row a genga",
        japanese: "ポーズ集",
        files: &["keys.bvh"],
        make: |cut, _, put| put("keys.bvh", keys_bvh(cut.clip, cut.sheet)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "xdts",
        help: "timesheets for drawing programs: the keys for ACTION, every drawing for CELL",
        japanese: "デジタルタイムシート",
        files: &["CUT_genga_ts.xdts", "CUT_douga_ts.xdts"],
        make: |cut, settings, put| {
            let made = settings.xdts.write(cut.sheet, cut.name)?;
            put(&cut.file("CUT_genga_ts.xdts"), made.genga.as_bytes())?;
            put(&cut.file("CUT_douga_ts.xdts"), made.douga.as_bytes())
        },
        ..PLAIN
    },
    Format {
        name: "tdts",
        help: "the same timesheets as one file, with ACTION and CELL",
        japanese: "デジタルタイムシート",
        files: &["CUT.tdts"],
        make: |cut, settings, put| {
            put(&cut.file("CUT.tdts"), settings.tdts.write(cut.sheet, cut.name)?.as_bytes())
        },
        ..PLAIN
    },
    Format {
        name: "sts",
        help: "every drawing for programs that read ShiraheiTimeSheet",
        japanese: "タイムシート（STS）",
        files: &["CUT.sts"],
        make: |cut, _, put| put(&cut.file("CUT.sts"), &sts(cut.sheet)?),
        ..PLAIN
    },
    Format {
        name: "columns",
        help: "a table as timesheet programs write it: a row a koma, a column a layer",
        japanese: "タイムシートの表",
        files: &["CUT_timesheet.csv"],
        make: |cut, settings, put| {
            let table = columns_csv(cut.sheet)?;
            put(&cut.file("CUT_timesheet.csv"), &settings.csv.encode(table))
        },
        ..PLAIN
    },
    Format {
        name: "ae",
        help: "time remapping to paste into After Effects, a file a column",
        japanese: "タイムリマップ（After Effects）",
        files: &["ae/A.txt"],
        make: |cut, _, put| after_effects::write(cut.sheet, put),
        ..PLAIN
    },
    Format {
        name: "xsheet",
        help: "the timesheet on paper, to print on A4 or B4: HTML, and a page each as SVG",
        japanese: "タイムシート用紙",
        files: &["CUT_xsheet.html", "xsheet/0001.svg"],
        is_numbered: true,
        make: |cut, settings, put| {
            let made = xsheet(&settings.xsheet, cut.name, cut.clip, cut.sheet)?;
            put(&cut.file("CUT_xsheet.html"), made.html.as_bytes())?;
            made.pages.iter().enumerate().try_for_each(|(at, page)| {
                put(&format!("xsheet/{:04}.svg", at + 1), page.as_bytes())
            })
        },
        ..PLAIN
    },
    Format {
        name: "vmd",
        help: "the motion for MikuMikuDance, and which joint became which bone",
        japanese: "MMDモーション",
        files: &["CUT.vmd", "CUT-bones.csv"],
        make: |cut, settings, put| {
            let made = settings.vmd.make(cut.clip, cut.sheet)?;
            put(&cut.file("CUT.vmd"), &made.motion.bytes()?)?;
            put(&cut.file("CUT-bones.csv"), &settings.csv.encode(made.report.csv()?))
        },
        notes: |cut, settings| settings.vmd.notes(cut.clip, cut.sheet),
        ..PLAIN
    },
    Format {
        name: "glb",
        help: "the motion stepped, with bones to see and the role of every drawing",
        japanese: "リミテッドモーション",
        files: &["limited.glb"],
        make: |cut, settings, put| put("limited.glb", &settings.glb.write(cut.clip, cut.sheet)?),
        ..PLAIN
    },
    Format {
        name: "vrma",
        help: "the motion stepped for VRM avatars",
        japanese: "VRMアニメーション",
        files: &["CUT.vrma"],
        make: |cut, settings, put| {
            let made = vrma::write(cut.clip, cut.sheet, settings.vmd.map.as_ref())?;
            put(&cut.file("CUT.vrma"), &made)
        },
        notes: |cut, settings| vrma::notes(cut.clip, settings.vmd.map.as_ref()),
        ..PLAIN
    },
    Format {
        name: "bars",
        help: "picture: a bar a drawing over koma, with what was left out",
        japanese: "シートの図",
        files: &["sheet.svg"],
        make: |cut, _, put| put("sheet.svg", pictures::bars(cut)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "poses",
        help: "picture: genga and ends as poses in a row",
        japanese: "ポーズの図",
        files: &["poses.svg"],
        make: |cut, settings, put| {
            put("poses.svg", pictures::poses(cut, settings.figures.body)?.as_bytes())
        },
        ..PLAIN
    },
    Format {
        name: "strip",
        help: "picture: source above, result below, koma by koma",
        japanese: "素材と結果",
        files: &["strip.svg"],
        is_numbered: true,
        make: figures::strip,
        notes: |cut, settings| Ok(shortened("strip", settings.strip.most, cut.sheet)),
    },
    Format {
        name: "contact",
        help: "picture: contact sheet of the genga",
        japanese: "原画一覧",
        files: &["contact.svg"],
        is_numbered: true,
        make: figures::contact,
        ..PLAIN
    },
    Format {
        name: "onion",
        help: "picture: the drawings from each genga to the next through each other",
        japanese: "オニオンスキン",
        files: &["onion.svg"],
        is_numbered: true,
        make: figures::onion,
        ..PLAIN
    },
    Format {
        name: "flipbook",
        help: "a page to play and step through in any browser",
        japanese: "パラパラ",
        files: &["flipbook.html"],
        make: figures::flipbook,
        notes: |cut, settings| Ok(shortened("flipbook", settings.flipbook.most, cut.sheet)),
        ..PLAIN
    },
    #[cfg(feature = "pictures")]
    Format {
        name: "preview",
        help: "source beside result, moving",
        japanese: "プレビュー",
        files: &["preview.gif"],
        make: figures::preview,
        notes: |cut, settings| Ok(shortened("preview", settings.preview.most, cut.sheet)),
        ..PLAIN
    },
    #[cfg(feature = "cli")]
    Format {
        name: "mp4",
        help: "source beside result as a video, where the system has ffmpeg",
        japanese: "動画ファイル",
        files: &["CUT.mp4"],
        make: |cut, settings, put| settings.mp4.write(settings.figures.body, cut, put),
        notes: |_, settings| settings.mp4.notes(),
        ..PLAIN
    },
    #[cfg(feature = "pictures")]
    Format {
        name: "images",
        help: "a picture a drawing, numbered as the sheet, to draw over",
        japanese: "連番画像",
        files: &["images/A_0001.png"],
        is_numbered: true,
        make: figures::images,
        ..PLAIN
    },
    #[cfg(feature = "pictures")]
    Format {
        name: "cut",
        help: "a folder as a cut is handed on: timesheets, and each column's pictures under the numbers of its cells",
        japanese: "カット袋",
        files: &["CUT/CUT_genga_ts.xdts", "CUT/douga/A/A_0001.png"],
        is_numbered: true,
        make: cut_folder::write,
        ..PLAIN
    },
];

impl Format {
    /// The format of that name.
    ///
    /// # Errors
    /// [`Error::Setting`] listing the formats there are.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        FORMATS.iter().find(|format| format.name == name).ok_or_else(|| {
            let known: Vec<&str> = FORMATS.iter().map(|format| format.name).collect();
            let message = format!("there is no such format; there are {}", known.join(", "));
            Error::setting(name, message)
        })
    }

    /// The formats of some names, each once and in the order of [`FORMATS`]; `all` is every one.
    ///
    /// # Errors
    /// Those of [`Format::find`].
    pub fn find_all<'a>(
        names: impl IntoIterator<Item = &'a str>,
    ) -> Result<Vec<&'static Self>, Error> {
        let mut asked = Vec::new();
        for name in names.into_iter().map(str::trim) {
            match name {
                "all" => asked.extend(FORMATS),
                name => asked.push(Self::find(name)?),
            }
        }
        let is_asked = |format: &&Self| asked.iter().any(|other| other.name == format.name);
        Ok(FORMATS.iter().filter(is_asked).collect())
    }

    /// Makes the files of this format and hands them on, one at a time.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::check`]; what the format cannot be made of, what is wrong with a
    /// setting, and what `put` says.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga::deliver::{Cut, Format, Settings};
    ///
    /// # let clip = genga::motion::bvh::open("data/kick.bvh".as_ref())?.clip;
    /// # let mut engine = Engine::new(clip)?;
    /// # let breakdown = engine.run(&Recipe::default(), &Edits::default())?;
    /// # let (clip, sheet) = (breakdown.clip, breakdown.sheet);
    /// # let cut = Cut {
    /// #     name: "c012",
    /// #     clip_file: "kick.bvh",
    /// #     clip,
    /// #     exaggerated: None,
    /// #     sheet,
    /// #     spaced: None,
    /// #     splits: &[],
    /// #     made_with: None,
    /// # };
    /// let mut names = Vec::new();
    /// Format::find("csv")?.write(&cut, &Settings::default(), &mut |name, _bytes| {
    ///     names.push(name.to_owned());
    ///     Ok(())
    /// })?;
    /// assert_eq!(names, ["keys.csv", "drawings.csv", "sheet.csv"]);
    /// # Ok::<(), genga::Error>(())
    /// ```
    pub fn write(
        &self,
        cut: &Cut<'_>,
        settings: &Settings,
        put: &mut Sink<'_>,
    ) -> Result<(), Error> {
        cut.sheet.check()?;
        (self.make)(cut, settings, put)
    }

    /// What a person should know of its files, such as what they cannot hold.
    ///
    /// # Errors
    /// Those of [`Format::write`].
    pub fn notes(&self, cut: &Cut<'_>, settings: &Settings) -> Result<Vec<Warning>, Error> {
        (self.notes)(cut, settings)
    }
}

/// That a picture shows only the beginning of a long sheet.
fn shortened(name: &str, most: usize, sheet: &Sheet) -> Vec<Warning> {
    let koma = sheet.layers.first().map_or(0, Layer::length);
    let message =
        format!("{name} shows the first {most} of {koma} koma; {name}.most says how many");
    if koma > most { vec![Warning::new("W_SHORTENED", message)] } else { vec![] }
}

impl fmt::Debug for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Format").field(&self.name).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_format_lists_the_known_ones() {
        let error = Format::find("xdst").unwrap_err().to_string();
        assert!(
            error.starts_with("xdst: there is no such format; there are json, csv,"),
            "{error}"
        );
        for format in FORMATS {
            assert!(error.contains(format.name), "{error}");
        }
    }

    #[test]
    fn formats_come_once_and_in_their_order() {
        let names = |asked: &[&str]| -> Vec<&str> {
            let found = Format::find_all(asked.iter().copied()).unwrap();
            found.iter().map(|format| format.name).collect()
        };
        assert_eq!(names(&["bvh", " json", "bvh"]), ["json", "bvh"]);
        assert_eq!(names(&["all", "bvh"]).len(), FORMATS.len());
        assert_eq!(names(&[]), [""; 0]);
        assert!(Format::find_all(["json", ""]).is_err());
    }

    #[test]
    fn no_two_formats_have_one_name_or_write_one_file() {
        let mut names: Vec<_> = FORMATS.iter().map(|format| format.name).collect();
        names.extend(FORMATS.iter().flat_map(|format| format.files));
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        assert!(!names.contains(&"all"));
    }
}
