//! Processes one clip of a batch: reads it, draws it, writes it to staging.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::{self, Read};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::{Args, Command, FromArgMatches};

use super::super::console::{Words, is_loss};
use super::super::failure::Failure;
use super::super::format_args::Formats;
use super::super::numbers::{self, Numbering};
use super::super::plan::{Plan, PlanArgs};
use super::super::sheets::SHEET;
use super::super::staging::Staging;
use super::super::{files, paths, stop, whose_corrections};
use super::list::Item;
use super::pack::Parcel;
use super::place;
use super::row::{Line, Row};
use genga::edits::Edits;
use genga::error::Error;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga_files::{ClipMark, Drawings, Manifest, Report, Rows, Run, numbers_csv, run_notes};

/// The options shared by all clips.
pub(crate) struct Asked<'a> {
    plan: &'a PlanArgs,
    formats: &'a Formats,
    recipe: Recipe,
    edits: Edits,
    /// The corrections in the recipe, without those of the command line.
    read: Edits,
    /// Digest of the options.
    pub(crate) digest: String,
}

/// The options of one clip.
struct OfOne {
    plan: PlanArgs,
    recipe: Recipe,
    edits: Edits,
}

impl<'a> Asked<'a> {
    pub(crate) fn new(plan: &'a PlanArgs, formats: &'a Formats) -> Result<Self, Failure> {
        let Plan { recipe, edits, read, .. } = Plan::from_args(plan)?;
        let digest = digest(plan, formats, &recipe, &edits)?;
        Ok(Self { plan, formats, recipe, edits, read, digest })
    }

    /// Refuses corrections of frames for all clips, in a recipe or on the command line.
    pub(crate) fn check(&self, items: &[Item]) -> Result<(), Failure> {
        let corrections = &self.plan.corrections;
        if let Some(recipe) = &corrections.settings.recipe {
            whose_corrections::check(recipe, &self.read, without(items, "recipe"))?;
        }
        corrections.of_frames().iter().try_for_each(|(option, given)| {
            whose_corrections::check_given(option, given, without(items, option))
        })
    }

    /// Returns the settings of a clip, its own options included, and a digest of all.
    fn of_one(&self, item: &Item) -> Result<(OfOne, String), Failure> {
        let mut plan = self.plan.for_clip(&item.path);
        if item.own.words.is_empty() {
            let (recipe, edits) = (self.recipe.clone(), self.edits.clone());
            return Ok((OfOne { plan, recipe, edits }, self.digest.clone()));
        }
        plan = with(plan, &item.own.words)?;
        let Plan { recipe, edits, .. } = Plan::from_args(&plan)?;
        let digest = digest(&plan, self.formats, &recipe, &edits)?;
        Ok((OfOne { plan, recipe, edits }, digest))
    }

    /// Returns the same, and names the row of a table if its options are wrong.
    fn of_row(&self, item: &Item) -> Result<(OfOne, String), Failure> {
        self.of_one(item).map_err(|failure| match item.own.words.is_empty() {
            true => failure,
            false => {
                let (row, clip) = (&item.own.row, item.path.display());
                Failure::AskedWrongly(format!("{row}: {clip}: {failure}"))
            }
        })
    }
}

/// Number of clips that have no such option of their own, and so take that of all clips.
fn without(items: &[Item], option: &str) -> usize {
    let takes_it = |item: &&Item| !item.own.has(option);
    let clips: BTreeSet<&Path> = items.iter().filter(takes_it).map(|item| &*item.path).collect();
    clips.len()
}

/// Adds command-line words to a plan.
fn with(mut plan: PlanArgs, words: &[String]) -> Result<PlanArgs, Failure> {
    let set = plan.corrections.settings.set.clone();
    let command = PlanArgs::augment_args_for_update(Command::new("genga").no_binary_name(true));
    let wrong = |error: clap::Error| Failure::AskedWrongly(first_line(&error.to_string()));
    let matches = command.try_get_matches_from(words).map_err(wrong)?;
    plan.update_from_arg_matches(&matches).map_err(wrong)?;
    let own = &mut plan.corrections.settings.set;
    if *own != set {
        // Settings for all clips come first, so that the clip's own override them.
        own.splice(0..0, set);
    }
    Ok(plan)
}

fn first_line(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    line.trim_start_matches("error: ").to_owned()
}

/// Returns a digest of everything besides the motion that a result depends on, however its files are called.
fn digest(
    plan: &PlanArgs,
    formats: &Formats,
    recipe: &Recipe,
    edits: &Edits,
) -> Result<String, Failure> {
    let (genga, recipe) = (env!("CARGO_PKG_VERSION"), recipe.write(edits));
    let text = format!("{genga}\n{}\n{}\n{recipe}", plan.fingerprint()?, formats.fingerprint());
    Ok(Manifest::digest(text.as_bytes()))
}

/// Bytes of a file in memory at a time.
const BLOCK: usize = 1 << 20;

/// Returns a digest of the digests of a file's blocks.
fn digest_of_file(path: &Path) -> Result<String, Failure> {
    let failed = |source| Failure::from(Error::Io { path: path.to_owned(), source });
    let mut file = File::open(path).map_err(failed)?;
    let (mut block, mut digests) = (Vec::new(), String::new());
    loop {
        block.clear();
        let count = (&mut file).take(BLOCK as u64).read_to_end(&mut block).map_err(failed)?;
        if count == 0 {
            return Ok(Manifest::digest(digests.as_bytes()));
        }
        digests += &Manifest::digest(&block);
    }
}

/// What a batch before left in a clip's folder. The drawings of its sheet keep their numbers.
#[derive(Default)]
pub(crate) struct Earlier {
    folder: PathBuf,
    /// The motion that its files are made of.
    of: Option<ClipMark>,
    /// Whether numbers begin at 1 all the same.
    is_anew: bool,
}

impl Earlier {
    /// Describes a clip's folder; `line` is what is known of its files.
    pub(crate) fn new(folder: PathBuf, line: Option<&Line>, is_anew: bool) -> Self {
        let of = line.and_then(|line| line.made_of.clone());
        Self { folder, of, is_anew }
    }

    fn numbering(&self, sheet: &Sheet, clip: &ClipMark) -> Numbering {
        let is_of_clip = self.of.as_ref().is_some_and(|of| of.is_of(clip));
        let before = if is_of_clip { numbers::read(&self.folder.join(SHEET)) } else { Ok(None) };
        Numbering::after(sheet, before, self.is_anew)
    }
}

/// A clip whose digests are known, before any work on it.
pub(crate) struct Begun<'a> {
    at: usize,
    item: &'a Item,
    file: String,
    asked: Result<(OfOne, String), Failure>,
}

impl<'a> Begun<'a> {
    pub(crate) fn new(asked: &Asked<'_>, at: usize, item: &'a Item) -> Self {
        let (file, asked) = match digest_of_file(&item.path) {
            Ok(file) => (file, asked.of_row(item)),
            Err(failure) => (String::new(), Err(failure)),
        };
        Self { at, item, file, asked }
    }

    /// Digests of the clip's file and of its options.
    pub(crate) fn digests(&self) -> (&str, &str) {
        (&self.file, self.asked.as_ref().map_or("", |(_, digest)| digest))
    }

    /// Draws the clip, and writes its files to the staging or into a parcel. A clip that fails still becomes
    /// a row; only a write error stops the batch.
    pub(crate) fn finish(
        self,
        formats: &Formats,
        earlier: &Earlier,
        staging: &Staging,
        mut parcel: Option<&mut Parcel>,
    ) -> Result<Line, Failure> {
        let Self { at, item, file, asked } = self;
        let digest = asked.as_ref().map(|(_, digest)| digest.clone()).unwrap_or_default();
        let ready = |file: &str| staging.place(&place::staged(&item.name, file));
        let (mut warnings, mut is_unwritten) = (Vec::new(), false);
        let drawn = asked.and_then(|(own, digest)| {
            let put = &mut |name: &str, bytes: &[u8], of: &str| match &mut parcel {
                Some(parcel) => parcel
                    .add(&item.name, name, of, bytes)
                    .map_err(|source| Error::Io { path: item.path.clone(), source }),
                None => write(&ready(name), bytes).map_err(|source| {
                    is_unwritten = !place::is_too_long(&source);
                    Error::Io { path: earlier.folder.join(name), source }
                }),
            };
            let work = || drawn(&own, &digest, formats, earlier, put, &mut warnings);
            let fault = |_| {
                Failure::CouldNot(format!(
                    "{}: genga failed on this clip, which is a fault of its own",
                    item.path.display()
                ))
            };
            catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(fault(panic)))
        });
        let mut line = Line {
            at,
            clip: item.name.clone(),
            file,
            asked: digest,
            row: Row::default(),
            keys: String::new(),
            files: BTreeMap::new(),
            made_of: None,
            has_old_numbers: false,
            keeps_numbers: false,
            ms: [0.0; 3],
        };
        match drawn {
            Ok(Drawn { row, keys, files, made_of, has_old_numbers, keeps_numbers, ms }) => {
                (line.row, line.keys, line.files, line.ms) = (row, keys, files, ms);
                line.made_of = Some(made_of);
                (line.has_old_numbers, line.keeps_numbers) = (has_old_numbers, keeps_numbers);
            }
            // A write error is the fault of the place, not of the clip.
            Err(failure) if is_unwritten => return Err(failure),
            Err(failure) => {
                let _ = fs::remove_dir_all(ready(""));
                line.row = Row::failed(named(item, &failure), warnings);
            }
        }
        Ok(line)
    }
}

/// The reason why a clip failed, with its path in front unless the reason names it.
fn named(item: &Item, failure: &Failure) -> String {
    let (path, message) = (item.path.display().to_string(), failure.to_string());
    let row = Some(&item.own.row).filter(|row| !row.is_empty());
    let is_named = row.into_iter().chain([&path]).any(|name| message.starts_with(name));
    if is_named { message } else { format!("{path}: {message}") }
}

/// The results of a clip.
struct Drawn {
    row: Row,
    keys: String,
    files: BTreeMap<String, String>,
    made_of: ClipMark,
    has_old_numbers: bool,
    keeps_numbers: bool,
    ms: [f64; 3],
}

/// Callback that stores a file of a clip: its name, its bytes, their digest.
type Put<'a> = dyn FnMut(&str, &[u8], &str) -> Result<(), Error> + 'a;

fn drawn(
    own: &OfOne,
    digest: &str,
    formats: &Formats,
    earlier: &Earlier,
    put: &mut Put<'_>,
    warnings: &mut Vec<String>,
) -> Result<Drawn, Failure> {
    let (begin, mute) = (Instant::now(), Words::new(true));
    let mut plan = Plan::with(&own.plan, own.recipe.clone(), own.edits.clone());
    let path = own.plan.clip();
    let (mut engine, clip) = plan.read(&mut |warning| {
        if !warnings.iter().any(|code| code == warning.code) {
            warnings.push(warning.code.into());
        }
    })?;
    let read = Instant::now();
    let mut notes = Vec::new();
    plan.settle(&mut engine, &mute, &mut |note| notes.push(note))?;
    let Plan { recipe, edits, .. } = &plan;
    let breakdown = engine.run_once(recipe, edits).map_err(files::fault_of(path))?;
    let numbering = earlier.numbering(breakdown.sheet, &clip);
    let breakdown = breakdown.with_sheet(&numbering.sheet);
    notes.extend(run_notes::of_corrections(edits, &breakdown));
    let report = Report::new(&breakdown, notes.clone());
    let name = paths::stem(path);
    let keys =
        Drawings { cut: name.clone(), rows: Rows::Keys }.write(breakdown.clip, breakdown.sheet)?;
    let found = Instant::now();
    let mut files = BTreeMap::new();
    let motion = clip.motion.clone();
    let run = Run { name: &name, clip: &clip, breakdown: &breakdown, recipe, edits };
    let mut put = |name: &str, bytes: &[u8]| {
        let digest = Manifest::digest(bytes);
        put(name, bytes, &digest)?;
        files.insert(name.to_owned(), digest);
        Ok(())
    };
    let said = run.with_cut(|cut| formats.each(cut, &mut put))?;
    if !numbering.drawings.is_empty() {
        put(Run::NUMBERS, &formats.table(numbers_csv(&numbering.drawings)?))?;
    }
    let unmade = said.unmade();
    let lost = said.notes.iter().filter(|note| is_loss(note)).chain(unmade.first());
    warnings.extend(lost.map(|warning| warning.code.into()));
    let mut row = Row::done(&report, motion, digest.to_owned(), std::mem::take(warnings));
    let reasons: Vec<String> = unmade.into_iter().map(|warning| warning.message).collect();
    row.message = reasons.join("; ");
    row.notes = notes;
    let ms = [read - begin, found - read, found.elapsed()].map(|time| time.as_secs_f64() * 1e3);
    let (has_old_numbers, keeps_numbers) = (numbering.has_old_ones(), numbering.is_kept);
    Ok(Drawn { row, keys, files, made_of: clip, has_old_numbers, keeps_numbers, ms })
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    stop::undisturbed(|| {
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, bytes)
    })
}
