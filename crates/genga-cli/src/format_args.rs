//! The output formats of a command, and their files.

use std::collections::HashSet;
use std::ffi::OsStr;
use std::path::Path;

use clap::builder::{StringValueParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::{Arg, Args, Command, ValueEnum};

use super::corrections::assignment;
use super::failure::Failure;
use super::headings::FILES;
use super::staging::Bundle;
use super::{files, paths};
use genga::error::{Error, Warning};
use genga_files::{BoneMap, Cut, FORMATS, Format, MmdModel, Settings, Sink, Vmd, sheet_json};
use genga_plot::Camera;

/// What both commands that write formats take.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct FormatArgs {
    /// Write a BVH, like the formats bvh and bvh-keys.
    #[arg(long, value_name = "ROWS", help_heading = FILES)]
    bvh: Option<BvhRows>,
    /// Camera of the figures: front, side, three-quarter, auto.
    ///
    /// auto sees most of the movement.
    #[arg(long, value_name = "CAMERA", help_heading = FILES)]
    camera: Option<Camera>,
    /// One setting of a format: --with csv.bom=true (repeatable).
    #[arg(long, value_name = "FORMAT.KEY=VALUE", value_parser = assignment, help_heading = FILES)]
    with: Vec<(String, String)>,
    /// Overwrite changed files, and those of another clip.
    ///
    /// Files that were changed since genga wrote them, and the folder of another clip.
    #[arg(long, help_heading = FILES)]
    pub(super) force: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum BvhRows {
    /// One row per koma, holds repeated: limited.bvh.
    Stepped,
    /// One row per key drawing, as a pose library: keys.bvh.
    Keys,
}

/// Parses the name of a format; `help` prints the list of formats instead of doing anything.
#[derive(Debug, Clone)]
pub(super) struct FormatName;

impl TypedValueParser for FormatName {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        match value.to_str().map(str::trim) {
            Some("help") => Err(clap::Error::raw(ErrorKind::DisplayHelp, long_help() + "\n")),
            _ => StringValueParser::new().parse_ref(command, arg, value),
        }
    }
}

/// Returns the names of the formats, by where they go.
pub(super) fn help() -> String {
    let mut places: Vec<&str> = FORMATS.iter().map(|format| format.goes_to).collect();
    let mut seen = HashSet::new();
    places.retain(|place| seen.insert(*place));
    let line = |place: &str| {
        let there = FORMATS.iter().filter(|format| format.goes_to == place);
        let names: Vec<&str> = there.map(|format| format.name).collect();
        format!("\n  {place:<22}{}", names.join(" "))
    };
    let lines: String = places.into_iter().map(line).collect();
    format!("Formats, by where they go; the word help in their place describes each:{lines}")
}

/// Returns the list of formats, one a line.
fn list() -> String {
    let lines = FORMATS.iter().map(|format| {
        let (name, help, japanese) = (format.name, format.help, format.japanese);
        format!("\n  {name:<12}{help} ({japanese}): {}", format.files.join(" "))
    });
    format!("Formats:{}", lines.collect::<String>())
}

/// Returns the list of formats and of the settings for `--with`.
pub(super) fn long_help() -> String {
    let settings = Settings::default().knobs().into_iter().map(|knob| {
        format!("\n  {:<22}{} ({}): {}", knob.name, knob.help, knob.japanese, knob.takes())
    });
    format!("{}\n\nSettings of formats (--with):{}", list(), settings.collect::<String>())
}

/// Most file names listed in full; of more, only the first and the last are named.
const MOST_NAMES: usize = 3;

/// File name of the sheet, which a person may have edited.
const SHEET: &str = "sheet.json";

/// Callback before each file is written. An error stops the writing.
pub(super) type Tell<'a> = &'a dyn Fn(&str) -> Result<(), Error>;

/// The result of writing.
pub(super) struct Written {
    /// The written files, as shown to the user.
    pub(super) files: Vec<String>,
    /// Numbered files beside them that are left over from a longer sheet.
    pub(super) stale: Vec<String>,
}

/// Formats and their settings.
#[derive(Debug, Clone)]
pub(super) struct Formats {
    formats: Vec<&'static Format>,
    /// Names of formats that were asked for by name, not only by `all`.
    named: Vec<&'static str>,
    settings: Settings,
    is_forced: bool,
}

impl Formats {
    /// Combines the formats named by `--option`, those asked for otherwise, and those that are written `always`.
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

    /// Replaces the settings.
    #[cfg(feature = "studio-files")]
    pub(super) fn set(self, settings: &Settings) -> Self {
        Self { settings: settings.clone(), ..self }
    }

    /// Refuses to overwrite `source`, which `what` is read from.
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

    /// Refuses, before any work, to overwrite a sheet that a person has edited.
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

    /// Leaves the sheet that is read as it is: `all` omits it, and asking for it by name is an error.
    pub(super) fn leave_sheet(&mut self, sheet: &Path, folder: &Path) -> Result<(), Failure> {
        let target = folder.join(SHEET);
        if !self.is_named("json") && paths::is_same(sheet, &target) {
            self.formats.retain(|format| format.name != "json");
        }
        let sheet = Some(sheet).filter(|_| self.writes("json"));
        paths::spare(&[("sheet", sheet)], &target)
    }

    /// Whether a format of that name will be written.
    pub(super) fn writes(&self, name: &str) -> bool {
        self.formats.iter().any(|format| format.name == name)
    }

    fn is_named(&self, name: &str) -> bool {
        self.named.contains(&name)
    }

    /// Writes the files of every format in turn, and calls `tell` with the format's name first.
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

    /// Passes the files of every format to `put`, in turn.
    pub(super) fn each(&self, cut: &Cut<'_>, put: &mut Sink<'_>) -> Result<(), Failure> {
        for format in &self.formats {
            format.write(cut, &self.settings, put)?;
        }
        Ok(())
    }

    /// Drops formats that cannot be made of this cut if only `all` asked for them. Returns notes on the files for the
    /// user.
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

/// Reads an MMD model from a file.
fn model(path: &Path) -> Result<MmdModel, Failure> {
    MmdModel::read(&files::read(path)?).map_err(files::fault_of(path))
}

/// Shortens a long list of names to the first and the last.
pub(super) fn shortened(mut names: Vec<String>) -> Vec<String> {
    if names.len() > MOST_NAMES {
        names.splice(1..names.len() - 1, ["…".into()]);
    }
    names
}

fn wrongly(option: &str, error: &Error) -> Failure {
    Failure::AskedWrongly(format!("--{option}: {error}"))
}
