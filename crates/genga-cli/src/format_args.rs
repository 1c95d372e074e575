//! The output formats of a command, and their files.

use std::collections::{BTreeMap, HashSet};
use std::ffi::OsStr;
use std::path::Path;

use clap::builder::{StringValueParser, TypedValueParser};
use clap::{Arg, Args, Command, ValueEnum};

use super::failure::Failure;
use super::headings::FILES;
use super::look_args::{self, LookArgs};
use super::sheets::SHEET;
use super::staging::Bundle;
use super::{files, paths};
use genga::error::{Error, Warning};
use genga_files::{Attempt, BoneMap, Cut, FORMATS, Format, Settings, Sink, Vmd, sheet_json};

/// Arguments of every command that writes formats.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct FormatArgs {
    /// Write a BVH, like the formats: stepped (bvh), keys (bvh-keys).
    #[arg(long, value_name = "ROWS", hide_possible_values = true, help_heading = FILES)]
    bvh: Option<BvhRows>,
    #[command(flatten)]
    look: LookArgs,
    /// Overwrite changed files and another clip's, not paint.
    ///
    /// Files that were changed since genga wrote them, and the folder of another clip.
    #[arg(long, help_heading = FILES)]
    force: bool,
    /// Overwrite these changed or painted files too (repeatable).
    ///
    /// A file or a folder of pictures: --overwrite images/A_0003.png.
    #[arg(long, value_name = "FILE|FOLDER,…", value_delimiter = ',', help_heading = FILES)]
    overwrite: Vec<String>,
}

/// Changed files that the user allows to overwrite.
#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Overwrites<'a> {
    /// All files but pictures.
    pub(super) is_forced: bool,
    /// Files, or folders.
    named: &'a [String],
}

impl Overwrites<'_> {
    /// Whether the user named this file of a results folder, or a folder above it.
    pub(super) fn has(&self, folder: &Path, file: &str) -> bool {
        self.named.iter().any(|name| is_named(name, folder, file))
    }

    /// Refuses a name that is that of no file which comes into the folder.
    pub(super) fn check(
        &self,
        folder: &Path,
        come: &BTreeMap<String, String>,
    ) -> Result<(), Failure> {
        let is_of_none = |name: &&String| !come.keys().any(|file| is_named(name, folder, file));
        match self.named.iter().find(is_of_none) {
            None => Ok(()),
            Some(name) => Err(Failure::AskedWrongly(format!(
                "--overwrite {name}: this run writes no such file or folder into {}",
                folder.display()
            ))),
        }
    }
}

/// Whether a name, from the results folder or from where the program runs, means a file or a folder that it is in.
fn is_named(name: &str, folder: &Path, file: &str) -> bool {
    Path::new(file).starts_with(name) || folder.join(file).starts_with(name)
}

impl FormatArgs {
    /// Whether a BVH is asked for.
    pub(super) fn asks_for_bvh(&self) -> bool {
        self.bvh.is_some()
    }

    /// Changed files that the arguments allow to overwrite.
    pub(super) fn over(&self) -> Overwrites<'_> {
        Overwrites { is_forced: self.force, named: &self.overwrite }
    }
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
            // Clap prints a help as it is, but puts "error:" before a message of ours.
            Some("help") => Err(Command::new("formats")
                .override_help(long_help() + "\n")
                .try_get_matches_from(["formats", "--help"])
                .expect_err("a request for help is an error")),
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

/// Callback before each file is written. An error stops the writing.
pub(super) type Tell<'a> = &'a dyn Fn(&str) -> Result<(), Error>;

/// The result of writing.
#[derive(Default)]
pub(super) struct Written {
    /// The written files, as shown to the user.
    pub(super) files: Vec<String>,
    /// Numbered files beside them that are left over from a longer sheet.
    pub(super) stale: Vec<String>,
    /// Notes on the formats.
    pub(super) said: FormatNotes,
}

/// Notes on formats, for the user.
#[derive(Default)]
pub(super) struct FormatNotes {
    /// Notes on the files, and on what `all` goes without.
    pub(super) notes: Vec<Warning>,
    /// Formats that were asked for by name and cannot be made of this cut.
    unmade: Vec<(&'static Format, Error)>,
}

impl FormatNotes {
    /// Returns a warning for each format that is not made.
    pub(super) fn unmade(&self) -> Vec<Warning> {
        self.unmade.iter().map(|(format, error)| format.unmade(error)).collect()
    }
}

/// Fails, after all else is written, if formats are not made.
pub(super) fn all_made(unmade: &[Warning]) -> Result<(), Failure> {
    let what = match unmade.len() {
        0 => return Ok(()),
        1 => "one format is".to_owned(),
        many => format!("{many} formats are"),
    };
    Err(Failure::CouldNot(format!("{what} not made, as said above; all else is written")))
}

/// Formats and their settings.
#[derive(Debug, Clone)]
pub(super) struct Formats {
    formats: Vec<&'static Format>,
    /// Formats requested by name, not only through `all`.
    named: Vec<&'static str>,
    /// Formats that the folder has.
    again: Vec<&'static str>,
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
        let mut settings = args.look.settings()?;
        settings.vmd.map = bones.cloned();
        Ok(Self { formats, named, again: vec![], settings, is_forced: args.force })
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

    /// Text that is the same for formats that write the same files.
    pub(super) fn fingerprint(&self) -> String {
        let Self { named, settings, .. } = self;
        format!("{:?} {named:?} {settings:?}", self.names())
    }

    /// Adds formats that the folder has. One that cannot be made is left out.
    pub(super) fn with(mut self, names: &[&'static str]) -> Self {
        let is_wanted = |format: &&Format| self.writes(format.name) || names.contains(&format.name);
        self.formats = FORMATS.iter().filter(is_wanted).collect();
        self.again = names.to_vec();
        self
    }

    /// Takes those settings that the formats of the folder had and that are not given now. Returns what was kept and what
    /// cannot be, in words.
    pub(super) fn keep(
        &mut self,
        before: &BTreeMap<String, String>,
        args: &FormatArgs,
        way_out: &str,
    ) -> Vec<String> {
        let before = before.iter().filter(|(name, _)| !args.look.gives(name));
        let (kept, lost): (Vec<_>, Vec<_>) = before.partition(|(name, value)| {
            let is_unread = *name == "vmd.model" && Vmd::is_file(value);
            !is_unread && self.settings.set(name, value).is_ok()
        });
        let said = [
            (kept, format!("settings of formats, as the folder has them ({way_out})")),
            (lost, "settings of formats that do not stay; give them again".into()),
        ];
        let said = said.into_iter().filter(|(settings, _)| !settings.is_empty());
        said.map(|(settings, what)| format!("{what}: {}", look_args::options(&settings))).collect()
    }

    /// The settings that differ from the defaults, by name.
    pub(super) fn own_settings(&self) -> BTreeMap<String, String> {
        self.settings.own()
    }

    /// The names that ask for the same formats again, `all` among them if it was.
    pub(super) fn asked(&self) -> Vec<String> {
        let all = (self.names() != self.named).then_some("all");
        all.into_iter().chain(self.named.iter().copied()).map(str::to_owned).collect()
    }

    /// Names of the formats, in the order in which they are written.
    pub(super) fn names(&self) -> Vec<&'static str> {
        self.formats.iter().map(|format| format.name).collect()
    }

    /// Encodes a table as the settings of tables say.
    pub(super) fn table(&self, table: String) -> Vec<u8> {
        self.settings.csv.encode(table)
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
        let mut written = Written::default();
        for format in &self.formats {
            tell(format.name)?;
            let mut names = Vec::new();
            self.make(format, cut, &mut written.said, &mut |name, bytes| {
                tell(name)?;
                names.push(name.to_owned());
                bundle.add(name, bytes)
            })?;
            if format.is_numbered {
                written.stale.extend(paths::stale(bundle.folder(), &names));
            }
            written.files.extend(shortened(names));
        }
        written.said = self.some_made(written.said)?;
        Ok(written)
    }

    /// Passes the files of every format to `put`, in turn. It is no failure if none can be made.
    pub(super) fn each(&self, cut: &Cut<'_>, put: &mut Sink<'_>) -> Result<FormatNotes, Error> {
        let mut said = FormatNotes::default();
        self.formats.iter().try_for_each(|format| self.make(format, cut, &mut said, put))?;
        Ok(said)
    }

    /// Makes the files of a format, or says that it cannot be made of this cut.
    fn make(
        &self,
        format: &'static Format,
        cut: &Cut<'_>,
        said: &mut FormatNotes,
        put: &mut Sink<'_>,
    ) -> Result<(), Error> {
        match format.try_write(cut, &self.settings, put)? {
            // Several formats may say the same.
            Attempt::Made(notes) => {
                let fresh = notes.into_iter().filter(|note| !said.notes.contains(note));
                said.notes.extend(fresh.collect::<Vec<_>>());
            }
            Attempt::NotMade(error) if self.is_named(format.name) => {
                said.unmade.push((format, error));
            }
            Attempt::NotMade(error) => {
                let message = match self.again.contains(&format.name) {
                    true => format!("{} is not written again: {error}", format.name),
                    false => format!("all goes without {}: {error}", format.name),
                };
                said.notes.push(Warning::new("W_LEFT_OUT_OF_ALL", message));
            }
        }
        Ok(())
    }

    /// Fails with the first reason if no format at all is made.
    fn some_made(&self, mut said: FormatNotes) -> Result<FormatNotes, Failure> {
        match said.unmade.len() {
            0 => Ok(said),
            count if count < self.formats.len() => Ok(said),
            _ => Err(said.unmade.swap_remove(0).1.into()),
        }
    }
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
