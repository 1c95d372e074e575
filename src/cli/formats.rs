//! The formats that a person asks for, and their files.

use std::path::Path;

use clap::{Args, ValueEnum};

use super::corrections::assignment;
use super::failure::Failure;
use super::staging::Bundle;
use super::{files, paths};
use crate::deliver::{BoneMap, Cut, FORMATS, Format, MmdModel, Settings, Sink, Vmd, sheet_json};
use crate::error::{Error, Warning};
use crate::plot::Camera;

/// What both commands that write formats take.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct FormatArgs {
    /// A BVH with these rows: the formats bvh and bvh-keys by other words.
    #[arg(long, value_name = "ROWS")]
    bvh: Option<BvhRows>,
    /// From where the pictures of figures are seen: front, side, three-quarter, or auto, from where most of
    /// the movement is seen.
    #[arg(long, value_name = "CAMERA")]
    camera: Option<Camera>,
    /// One setting of a format: --with csv.bom=true (may be given again).
    #[arg(long, value_name = "FORMAT.KEY=VALUE", value_parser = assignment)]
    with: Vec<(String, String)>,
    /// Write over files that were changed since genga wrote them, and into a folder of another clip.
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BvhRows {
    /// A row a koma, holds repeated: limited.bvh.
    Stepped,
    /// A row a key drawing, a pose library: keys.bvh.
    Keys,
}

/// The formats, a line each.
pub(super) fn help() -> String {
    let lines = FORMATS.iter().map(|format| {
        let (name, help, japanese) = (format.name, format.help, format.japanese);
        format!("\n  {name:<12}{help} ({japanese}): {}", format.files.join(" "))
    });
    format!("Formats:{}", lines.collect::<String>())
}

/// The formats, and what `--with` sets of them.
pub(super) fn long_help() -> String {
    let settings = Settings::default().knobs().into_iter().map(|knob| {
        format!("\n  {:<22}{} ({}): {}", knob.name, knob.help, knob.japanese, knob.takes())
    });
    format!("{}\n\nSettings of formats (--with):{}", help(), settings.collect::<String>())
}

/// More files of one format than this are named by the first and the last.
const MOST_NAMES: usize = 3;

/// The sheet, which a person may have edited.
const SHEET: &str = "sheet.json";

/// Hears of each file before it is written, and may stop it all.
pub(super) type Tell<'a> = &'a dyn Fn(&str) -> Result<(), Error>;

/// What was written.
pub(super) struct Written {
    /// The files, for a person to read.
    pub(super) files: Vec<String>,
    /// Numbered files of a longer sheet that stand beside them.
    pub(super) stale: Vec<String>,
}

/// Formats and their settings.
#[derive(Debug, Clone)]
pub(super) struct Formats {
    formats: Vec<&'static Format>,
    /// Those that are not only among `all`.
    named: Vec<&'static str>,
    settings: Settings,
    is_forced: bool,
}

impl Formats {
    /// What `--option` names, what else is asked for, and what comes `always`.
    pub(super) fn new(
        option: &str,
        names: &[String],
        always: &[&str],
        args: &FormatArgs,
        bones: Option<&BoneMap>,
    ) -> Result<Self, Failure> {
        let bvh = args.bvh.map(|rows| match rows {
            BvhRows::Stepped => "bvh",
            BvhRows::Keys => "bvh-keys",
        });
        let names = names.iter().map(String::as_str).chain(bvh).chain(always.iter().copied());
        let names: Vec<&str> = names.collect();
        let found = |names: &[&str]| {
            Format::find_all(names.iter().copied()).map_err(|error| wrongly(option, &error))
        };
        let formats = found(&names)?;
        let by_name: Vec<&str> = names.into_iter().filter(|name| name.trim() != "all").collect();
        let named = found(&by_name)?.iter().map(|format| format.name).collect();
        let mut settings = Settings::default();
        if let Some(camera) = args.camera {
            settings.look_from(camera);
        }
        for (name, value) in &args.with {
            if name == "vmd.model" && Vmd::is_file(value) {
                settings.vmd.play(model(Path::new(value))?);
            } else {
                settings.set(name, value).map_err(|error| wrongly("with", &error))?;
            }
        }
        settings.vmd.map = bones.cloned();
        Ok(Self { formats, named, settings, is_forced: args.force })
    }

    /// The same with other settings.
    #[cfg(feature = "studio-files")]
    pub(super) fn set(self, settings: &Settings) -> Self {
        Self { settings: settings.clone(), ..self }
    }

    /// Refuses to write where `what` is read from.
    pub(super) fn spare(
        &self,
        what: &str,
        source: &Path,
        folder: &Path,
        cut: &str,
    ) -> Result<(), Failure> {
        let mut files = self.formats.iter().flat_map(|format| format.files);
        let place = |file| folder.join(Cut::file_of(cut, file));
        files.try_for_each(|file| paths::spare(&[(what, Some(source))], &place(file)))
    }

    /// Refuses to write over a sheet that is not as it was made, before any work: a person's is in it.
    pub(super) fn spare_edited(&self, folder: &Path) -> Result<(), Failure> {
        let path = folder.join(SHEET);
        if self.is_forced || !self.writes("json") || !path.is_file() {
            return Ok(());
        }
        let sheet = files::read(&path).map(|bytes| sheet_json::read(&bytes));
        if matches!(sheet, Ok(Ok(sheet)) if sheet.is_as_made()) {
            return Ok(());
        }
        Err(Failure::AskedWrongly(format!(
            "{}: this sheet is not as a run wrote it, and would be lost; genga deliver takes it as it is: \
             move it, write elsewhere with --out, or write over it with --force",
            path.display()
        )))
    }

    /// Leaves the sheet that is read as it is: `all` goes without it.
    ///
    /// Where it is asked for by name, that is refused.
    pub(super) fn leave_sheet(&mut self, sheet: &Path, folder: &Path) -> Result<(), Failure> {
        let target = folder.join(SHEET);
        if !self.is_named("json") && paths::is_same(sheet, &target) {
            self.formats.retain(|format| format.name != "json");
        }
        let sheet = Some(sheet).filter(|_| self.writes("json"));
        paths::spare(&[("sheet", sheet)], &target)
    }

    /// Whether a format of that name is among them.
    pub(super) fn writes(&self, name: &str) -> bool {
        self.formats.iter().any(|format| format.name == name)
    }

    fn is_named(&self, name: &str) -> bool {
        self.named.contains(&name)
    }

    /// Writes every file, one made after the other, and tells of which format it is about to write.
    pub(super) fn write(
        &self,
        cut: &Cut<'_>,
        bundle: &mut Bundle<'_>,
        tell: Tell<'_>,
    ) -> Result<Written, Failure> {
        let (mut files, mut stale) = (Vec::new(), Vec::new());
        for format in &self.formats {
            tell(format.name)?;
            let mut names = Vec::new();
            format.write(cut, &self.settings, &mut |name, bytes| {
                tell(name)?;
                names.push(name.to_owned());
                bundle.add(name, bytes)
            })?;
            if format.is_numbered {
                stale.extend(paths::stale(bundle.folder(), &names));
            }
            files.extend(shortened(names));
        }
        Ok(Written { files, stale })
    }

    /// Makes every file, one after the other.
    pub(super) fn each(&self, cut: &Cut<'_>, put: &mut Sink<'_>) -> Result<(), Failure> {
        for format in &self.formats {
            format.write(cut, &self.settings, put)?;
        }
        Ok(())
    }

    /// Leaves out what cannot be made of the cut and is asked for only by `all`, and gives what a person
    /// should know of the files.
    pub(super) fn settle(&mut self, cut: &Cut<'_>) -> Result<Vec<Warning>, Failure> {
        let mut notes = Vec::new();
        for format in std::mem::take(&mut self.formats) {
            match format.notes(cut, &self.settings) {
                Ok(of_format) => notes.extend(of_format),
                Err(error) if !self.is_named(format.name) => {
                    let message = format!("all goes without {}: {error}", format.name);
                    notes.push(Warning::new("W_LEFT_OUT_OF_ALL", message));
                    continue;
                }
                Err(error) => return Err(error.into()),
            }
            self.formats.push(format);
        }
        Ok(notes)
    }
}

/// The model of MMD in a file.
fn model(path: &Path) -> Result<MmdModel, Failure> {
    MmdModel::read(&files::read(path)?).map_err(files::fault_of(path))
}

/// Many names as the first and the last.
pub(super) fn shortened(mut names: Vec<String>) -> Vec<String> {
    if names.len() > MOST_NAMES {
        names.splice(1..names.len() - 1, ["…".into()]);
    }
    names
}

fn wrongly(option: &str, error: &Error) -> Failure {
    Failure::AskedWrongly(format!("--{option}: {error}"))
}
