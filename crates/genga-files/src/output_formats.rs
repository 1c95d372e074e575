//! The registry of formats. A new format is a row in [`FORMATS`] and a file of its own.

use std::fmt;

use crate::beside::{Passes, unpassed};
#[cfg(feature = "images")]
use crate::cut_folder;
use crate::films::{Film, shortened};
use crate::settings::Settings;
use crate::{
    Cut, Drawings, Rows, Sink, after_effects, columns_csv, figures, films, keys_bvh, limited_bvh,
    pictures, remap, remap_csv, sheet_csv, sheet_json, sts, vrma, xdts, xsheet,
};
use genga::error::{Error, Warning, did_you_mean};
use genga::sheet::{Layer, Sheet};
use genga_plot::SideBySide;

/// A format in which a sheet is handed over (納品形式).
#[derive(Clone, Copy)]
pub struct Format {
    /// The name that selects it.
    pub name: &'static str,
    /// A one-line description.
    pub help: &'static str,
    /// The Japanese term of the trade.
    pub japanese: &'static str,
    /// Where its files go: the kind of program, or of use.
    pub goes_to: &'static str,
    /// Patterns of the files it writes. `CUT` stands for the name of the cut, `0001` for the number of a
    /// drawing or a page.
    pub files: &'static [&'static str],
    /// Whether it writes one numbered file per drawing or page.
    pub is_numbered: bool,
    /// How its file is made, if it is a film of what stands side by side.
    film: Option<Film>,
    /// Makes the files of any other format and passes them to the sink, one at a time.
    make: fn(&Cut<'_>, &Settings, &mut Sink<'_>) -> Result<(), Error>,
    /// Collects warnings about the files.
    notes: fn(&Cut<'_>, &Settings) -> Result<Vec<Warning>, Error>,
}

/// What became of a format that [`Format::try_write`] was asked for.
#[derive(Debug)]
pub enum Attempt {
    /// Its files are made, with warnings about them.
    Made(Vec<Warning>),
    /// It cannot be made of this cut, and none of its files is.
    NotMade(Error),
}

/// The defaults of most rows: no numbered files and no notes.
const PLAIN: Format = Format {
    name: "",
    help: "",
    japanese: "",
    goes_to: "",
    files: &[],
    is_numbered: false,
    film: None,
    make: |_, _, _| Ok(()),
    notes: |_, _| Ok(Vec::new()),
};

/// All formats, in the order in which they are listed and written.
pub const FORMATS: &[Format] = &[
    Format {
        name: "json",
        help: "the timesheet, to edit by hand and deliver again",
        japanese: "タイムシート",
        goes_to: "scripts, tables",
        files: &["sheet.json"],
        make: |cut, _, put| put("sheet.json", sheet_json::write(cut)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "csv",
        help: "tables of keys, drawings and koma",
        japanese: "表",
        goes_to: "scripts, tables",
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
        help: "only the timing, for a rig or rendered pictures of the same take",
        japanese: "タイムリマップ",
        goes_to: "scripts, tables",
        files: &["remap.csv", "remap.ffconcat"],
        make: |cut, settings, put| {
            put("remap.csv", &settings.csv.encode(remap_csv(cut.sheet)?))?;
            settings.remap.write(cut, put)
        },
        notes: |cut, _| Ok(remap::notes(cut)),
        ..PLAIN
    },
    Format {
        name: "bvh",
        help: "stepped motion: one row per koma, holds repeated",
        japanese: "リミテッドモーション",
        goes_to: "3-D programs",
        files: &["limited.bvh"],
        make: |cut, _, put| put("limited.bvh", limited_bvh(cut.clip, cut.sheet)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "bvh-keys",
        help: "key poses: one row per genga",
        japanese: "ポーズ集",
        goes_to: "3-D programs",
        files: &["keys.bvh"],
        make: |cut, _, put| put("keys.bvh", keys_bvh(cut.clip, cut.sheet)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "xdts",
        help: "timesheets for drawing programs: keys in ACTION, all drawings in CELL",
        japanese: "デジタルタイムシート",
        goes_to: "drawing programs",
        files: &["CUT_genga_ts.xdts", "CUT_douga_ts.xdts"],
        make: |cut, settings, put| {
            let made = settings.xdts.write(cut.sheet, cut.name)?;
            put(&cut.file("CUT_genga_ts.xdts"), made.genga.as_bytes())?;
            put(&cut.file("CUT_douga_ts.xdts"), made.douga.as_bytes())
        },
        notes: |cut, _| Ok(xdts::notes(cut.sheet)),
        ..PLAIN
    },
    Format {
        name: "tdts",
        help: "one timesheet for drawing programs, with ACTION and CELL",
        japanese: "デジタルタイムシート",
        goes_to: "drawing programs",
        files: &["CUT.tdts"],
        make: |cut, settings, put| {
            put(&cut.file("CUT.tdts"), settings.tdts.write(cut.sheet, cut.name)?.as_bytes())
        },
        notes: |cut, _| Ok(xdts::unsaid_rate("tdts", cut.sheet).into_iter().collect()),
        ..PLAIN
    },
    Format {
        name: "sts",
        help: "all drawings, for programs that read ShiraheiTimeSheet",
        japanese: "タイムシート（STS）",
        goes_to: "drawing programs",
        files: &["CUT.sts"],
        make: |cut, _, put| put(&cut.file("CUT.sts"), &sts(cut.sheet)?),
        notes: |cut, _| Ok(sts::notes(cut.sheet)),
        ..PLAIN
    },
    Format {
        name: "columns",
        help: "timesheet table: one row per koma, one column per layer",
        japanese: "タイムシートの表",
        goes_to: "scripts, tables",
        files: &["CUT_timesheet.csv"],
        make: |cut, settings, put| {
            let table = columns_csv(cut.sheet)?;
            put(&cut.file("CUT_timesheet.csv"), &settings.csv.encode(table))
        },
        ..PLAIN
    },
    Format {
        name: "ae",
        help: "time remapping to paste into After Effects, one file per column",
        japanese: "タイムリマップ（After Effects）",
        goes_to: "After Effects, paper",
        files: &["ae/A.txt"],
        make: |cut, _, put| after_effects::write(cut.sheet, put),
        notes: |cut, _| Ok([after_effects::notes(cut.sheet), remap::notes(cut)].concat()),
        ..PLAIN
    },
    Format {
        name: "xsheet",
        help: "timesheet to print on A4 or B4: HTML, and one SVG per page",
        japanese: "タイムシート用紙",
        goes_to: "After Effects, paper",
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
        help: "motion for MikuMikuDance, with a table of joints and their bones",
        japanese: "MMDモーション",
        goes_to: "MMD, VRM",
        files: &["CUT.vmd", "CUT-bones.csv", "CUT-camera.vmd"],
        make: |cut, settings, put| {
            let made = settings.vmd.make(cut.clip, cut.sheet)?;
            put(&cut.file("CUT.vmd"), &made.motion.bytes()?)?;
            put(&cut.file("CUT-bones.csv"), &settings.csv.encode(made.report.csv()?))?;
            made.put_camera(&cut.file("CUT-camera.vmd"), put)
        },
        notes: |cut, settings| settings.vmd.notes(cut.clip, cut.sheet),
        ..PLAIN
    },
    Format {
        name: "glb",
        help: "stepped motion with visible bones and the role of every drawing",
        japanese: "リミテッドモーション",
        goes_to: "3-D programs",
        files: &["limited.glb"],
        make: |cut, settings, put| put("limited.glb", &settings.glb.write(cut.clip, cut.sheet)?),
        notes: |cut, _| Ok(unpassed("glb", cut.clip, Passes::Gltf).into_iter().collect()),
        ..PLAIN
    },
    Format {
        name: "keys-vmd",
        help: "few keys for MikuMikuDance, at the genga, with its curves between them",
        japanese: "MMDのキーと補間曲線",
        goes_to: "MMD, VRM",
        files: &["CUT-keys.vmd", "CUT-keys-camera.vmd"],
        make: |cut, settings, put| {
            let made = settings.vmd.make_keys(cut.clip, cut.sheet, &settings.curves)?;
            put(&cut.file("CUT-keys.vmd"), &made.motion.bytes()?)?;
            made.put_camera(&cut.file("CUT-keys-camera.vmd"), put)
        },
        notes: |cut, settings| {
            Ok(settings.vmd.make_keys(cut.clip, cut.sheet, &settings.curves)?.notes)
        },
        ..PLAIN
    },
    Format {
        name: "keys-glb",
        help: "few keys, at the genga, with smooth curves between them",
        japanese: "キーとカーブ",
        goes_to: "3-D programs",
        files: &["keys.glb"],
        make: |cut, settings, put| {
            let made = settings.glb.write_keys(cut.clip, cut.sheet, &settings.curves)?;
            put("keys.glb", &made)
        },
        notes: |cut, settings| {
            let mut notes = settings.curves.notes(cut.clip, cut.sheet)?;
            notes.extend(unpassed("keys-glb", cut.clip, Passes::Gltf));
            Ok(notes)
        },
        ..PLAIN
    },
    Format {
        name: "vrma",
        help: "stepped motion for VRM avatars",
        japanese: "VRMアニメーション",
        goes_to: "MMD, VRM",
        files: &["CUT.vrma"],
        make: |cut, settings, put| {
            let made = vrma::write(cut.clip, cut.sheet, settings.vmd.map.as_ref())?;
            put(&cut.file("CUT.vrma"), &made)
        },
        notes: |cut, settings| {
            let mut notes = vrma::notes(cut.clip, settings.vmd.map.as_ref())?;
            notes.extend(unpassed("vrma", cut.clip, Passes::Nothing));
            Ok(notes)
        },
        ..PLAIN
    },
    Format {
        name: "bars",
        help: "picture: one bar per drawing over koma, with left-out drawings",
        japanese: "シートの図",
        goes_to: "pictures",
        files: &["sheet.svg"],
        make: |cut, _, put| put("sheet.svg", pictures::bars(cut)?.as_bytes()),
        ..PLAIN
    },
    Format {
        name: "poses",
        help: "picture: poses of the genga and ends in a row",
        japanese: "ポーズの図",
        goes_to: "pictures",
        files: &["poses.svg"],
        make: |cut, settings, put| {
            put("poses.svg", pictures::poses(cut, &settings.figures)?.as_bytes())
        },
        ..PLAIN
    },
    Format {
        name: "strip",
        help: "picture: source above, result below, koma by koma",
        japanese: "素材と結果",
        goes_to: "pictures",
        files: &["strip.svg"],
        is_numbered: true,
        make: figures::strip,
        notes: |cut, settings| {
            let mut notes = shortened("strip", settings.strip.most, drawn(cut.sheet));
            notes.extend(figures::font_notes(cut, settings)?);
            Ok(notes)
        },
        ..PLAIN
    },
    Format {
        name: "contact",
        help: "picture: contact sheet of the genga",
        japanese: "原画一覧",
        goes_to: "pictures",
        files: &["contact.svg"],
        is_numbered: true,
        make: figures::contact,
        notes: figures::font_notes,
        ..PLAIN
    },
    Format {
        name: "onion",
        help: "picture: the drawings from each genga to the next, overlaid",
        japanese: "オニオンスキン",
        goes_to: "pictures",
        files: &["onion.svg"],
        is_numbered: true,
        make: figures::onion,
        notes: figures::font_notes,
        ..PLAIN
    },
    Format {
        name: "flipbook",
        help: "web page that plays and steps through the drawings",
        japanese: "パラパラ",
        goes_to: "films",
        files: &["flipbook.html"],
        film: Some(films::FLIPBOOK),
        ..PLAIN
    },
    #[cfg(feature = "pictures")]
    Format {
        name: "preview",
        help: "animated picture: source beside result",
        japanese: "プレビュー",
        goes_to: "films",
        files: &["preview.gif"],
        film: Some(films::PREVIEW),
        ..PLAIN
    },
    #[cfg(feature = "video")]
    Format {
        name: "mp4",
        help: "video: source beside result; needs ffmpeg",
        japanese: "動画ファイル",
        goes_to: "films",
        files: &["CUT.mp4"],
        film: Some(films::MP4),
        ..PLAIN
    },
    #[cfg(feature = "images")]
    Format {
        name: "images",
        help: "one picture per drawing, numbered as on the sheet, to draw over",
        japanese: "連番画像",
        goes_to: "drawing programs",
        files: &["images/A_0001.png"],
        is_numbered: true,
        make: figures::images,
        ..PLAIN
    },
    #[cfg(feature = "images")]
    Format {
        name: "cut",
        help: "cut folder: timesheets, and the pictures of each column under their cel numbers",
        japanese: "カット袋",
        goes_to: "drawing programs",
        files: &["CUT/CUT_genga_ts.xdts", "CUT/douga/A/A_0001.png"],
        is_numbered: true,
        make: cut_folder::write,
        notes: |cut, _| cut_folder::notes(cut),
        ..PLAIN
    },
];

/// The formats that not every build has, with the feature that they need.
const OPTIONAL: [(&str, &str); 4] =
    [("images", "images"), ("cut", "images"), ("preview", "pictures"), ("mp4", "pictures")];

impl Format {
    /// Finds a format by name.
    ///
    /// # Errors
    /// [`Error::Setting`] that lists the known formats, or names the feature that a build lacks.
    pub fn find(name: &str) -> Result<&'static Self, Error> {
        FORMATS.iter().find(|format| format.name == name).ok_or_else(|| {
            let known: Vec<&str> = FORMATS.iter().map(|format| format.name).collect();
            let feature = OPTIONAL.iter().find(|(format, _)| *format == name);
            let message = match feature {
                Some((_, feature)) => {
                    format!(
                        "this genga was built without it, that is, without the feature `{feature}`"
                    )
                }
                None => {
                    let hint = match did_you_mean(name, known.iter().copied()) {
                        none if none.is_empty() => ";".to_owned(),
                        hint => hint,
                    };
                    format!("there is no such format{hint} there are {}", known.join(", "))
                }
            };
            Error::setting(name, message)
        })
    }

    /// Finds formats by name, each once and in the order of [`FORMATS`]; `all` selects every format.
    ///
    /// # Errors
    /// The errors of [`Format::find`].
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

    /// Makes the files of this format and passes them to `put`, one at a time.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::check`]; the format's own errors if it cannot be made of this cut; an invalid
    /// setting; and any error that `put` returns.
    ///
    /// ```
    /// # use genga::{edits::Edits, pipeline::Engine, recipe::Recipe};
    /// use genga_files::{Cut, Format, Settings};
    ///
    /// # let clip = genga::motion::bvh::open("../../data/kick.bvh".as_ref())?.clip;
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
        self.put(cut, settings, put)
    }

    fn put(&self, cut: &Cut<'_>, settings: &Settings, put: &mut Sink<'_>) -> Result<(), Error> {
        match self.film {
            None => (self.make)(cut, settings, put),
            Some(film) => {
                let shown = SideBySide::Source(cut.clip, cut.sheet);
                put(&cut.file(self.files[0]), &(film.make)(cut.name, &shown, settings)?)
            }
        }
    }

    /// Finds the film whose file has an ending: `html`, `gif` or `mp4`.
    ///
    /// # Errors
    /// [`Error::Setting`] that lists the endings, or names the feature that a build lacks.
    pub fn find_film(ending: &str) -> Result<&'static Self, Error> {
        match ending {
            "html" => Self::find("flipbook"),
            "gif" => Self::find("preview"),
            "mp4" => Self::find("mp4"),
            _ => Err(Error::setting("out", "a film is .html, .gif or .mp4")),
        }
    }

    /// Makes a film of what stands side by side, with warnings about it; `cut` is the name of the cut.
    ///
    /// # Errors
    /// As [`Format::write`]; [`Error::Setting`] if this format is no film.
    pub fn film(
        &self,
        cut: &str,
        shown: &SideBySide<'_>,
        settings: &Settings,
    ) -> Result<(Vec<u8>, Vec<Warning>), Error> {
        let film = self.film.ok_or_else(|| Error::setting(self.name, "this is no film"))?;
        let notes = (film.notes)(shown, settings)?;
        Ok(((film.make)(cut, shown, settings)?, notes))
    }

    /// Makes the files as [`Format::write`], but takes a format that cannot be made of this cut for no error, so that
    /// others can go on.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::first_layer`]; any error that `put` returns, or that comes after the first file.
    pub fn try_write(
        &self,
        cut: &Cut<'_>,
        settings: &Settings,
        put: &mut Sink<'_>,
    ) -> Result<Attempt, Error> {
        cut.sheet.first_layer()?;
        let mut has_begun = false;
        let mut put_one = |name: &str, bytes: &[u8]| {
            has_begun = true;
            put(name, bytes)
        };
        let made = self.notes(cut, settings).and_then(|notes| {
            self.put(cut, settings, &mut put_one)?;
            Ok(Attempt::Made(notes))
        });
        made.or_else(|error| if has_begun { Err(error) } else { Ok(Attempt::NotMade(error)) })
    }

    /// Returns the warning `W_NOT_MADE`: which format cannot be made, and why.
    pub fn unmade(&self, error: &Error) -> Warning {
        Warning::new("W_NOT_MADE", format!("{} is not made: {error}", self.name))
    }

    /// Collects warnings about the files, such as what they cannot hold.
    ///
    /// # Errors
    /// The errors of [`Format::write`].
    pub fn notes(&self, cut: &Cut<'_>, settings: &Settings) -> Result<Vec<Warning>, Error> {
        match self.film {
            None => (self.notes)(cut, settings),
            Some(film) => (film.notes)(&SideBySide::Source(cut.clip, cut.sheet), settings),
        }
    }
}

/// Number of koma that have a drawing of the first layer.
fn drawn(sheet: &Sheet) -> usize {
    sheet.layers.first().map_or(0, Layer::length)
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
            error.starts_with(
                "xdst: there is no such format; did you mean xdts? there are json, csv,"
            ),
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
