//! `genga batch`: processes many clips, keeps what is finished, and writes tables of all.

use std::fs;
use std::io::{Write, stdout};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use clap::{Args, ValueEnum};

use crate::batch::again;
use crate::batch::journal::{Header, Journal, Written, check_parts, is_journal};
use crate::batch::left;
use crate::batch::list::{self, Clips, Item};
use crate::batch::pack::{self, ARCHIVE, Pack, Parcel};
use crate::batch::place::{CLIPS, Places};
use crate::batch::pool::Pool;
use crate::batch::row::{KEPT, Line, Row};
use crate::batch::shard::{Shard, largest_first};
use crate::batch::tables::{self, Count, NAMED};
use crate::batch::work::{Asked, Begun, Earlier};
use crate::clip::{ClipArgs, Part};
use crate::console::{Bar, Words, counted};
use crate::corrections::Corrections;
use crate::failure::Failure;
use crate::format_args::{FormatArgs, FormatName, Formats, help, long_help, shortened};
use crate::plan::{PlanArgs, TargetArgs};
use crate::staging::{self, Staging};
use crate::stop;
use crate::{files, paths};
use genga_files::Manifest;

#[derive(Debug, Args)]
#[command(after_help = help(), after_long_help = long_help())]
pub(super) struct BatchArgs {
    /// Motion files, folders, patterns ("lib/**/*.bvh"), @list.txt (one file per line), @table.csv or @table.jsonl (a
    /// column clip, and columns named after options: trim, fps, recipe, pin, set.spacing.on), or - for a list on stdin.
    #[arg(value_name = "CLIPS", required_unless_present = "join")]
    clips: Vec<String>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    corrections: Corrections,
    #[command(flatten)]
    targets: TargetArgs,
    /// Formats to write for each clip: --deliver json,xdts, or all [default: those of the last batch in DIR, or json].
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', value_parser = FormatName)]
    deliver: Vec<String>,
    #[command(flatten)]
    formats: FormatArgs,
    /// Output folder, for the tables and one folder per clip. Finished clips are not processed again.
    #[arg(long, short, value_name = "DIR", required = true)]
    out: PathBuf,
    /// Process one part of the list: 1/4 to 4/4 on four machines. All parts have about the same number of bytes.
    /// Afterwards, run --join.
    #[arg(long, value_name = "I/N")]
    shard: Option<Shard>,
    /// Make the tables of finished parts, from these folders.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = ["clips", "shard"])]
    join: Vec<PathBuf>,
    /// Number of clips processed at the same time [default: one per core].
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Write one archive, clips.zip, instead of one folder per clip. --join merges the archives of all parts.
    #[arg(long)]
    pack: bool,
    /// Number the drawings from 1. Otherwise those that a clip's sheet.json has too keep their numbers (not with --pack).
    #[arg(long)]
    renumber: bool,
    /// Stop at the first clip that fails.
    #[arg(long)]
    fail_fast: bool,
    /// Exit with code 0 even if clips fail. Failed clips are rows of the tables, and --join reports them.
    #[arg(long, conflicts_with = "fail_fast")]
    allow_failures: bool,
    /// Only print the list that --shard divides, one file per line, for other machines.
    #[arg(long, conflicts_with_all = ["shard", "join"])]
    list: bool,
    /// How progress is shown: a bar on a terminal, or lines on stdout for programs.
    #[arg(long, value_name = "HOW", default_value = "bar")]
    progress: Progress,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Progress {
    /// A bar on a terminal.
    Bar,
    /// One JSON object per clip: clip, status, message, and done, failed, of: how many.
    Json,
    /// Open Job Description messages, for render farms.
    Openjd,
    /// No progress.
    None,
}

/// Memory for all clips in progress, unless --memory is given.
const ROOM: f64 = 2.0 * 1024.0 * 1024.0 * 1024.0;

/// Cost of a clip besides its bytes, in bytes. The progress bar estimates the time left from this and the file size.
const LEAST: u64 = 1 << 14;

pub(super) fn run(args: &BatchArgs, words: &Words) -> Result<(), Failure> {
    paths::check_folder(Some(&args.out), "batch", "")?;
    if args.list {
        return files::to_stdout(&list::written(&clips(args, words)?));
    }
    staging::check_folder(&args.out)?;
    if args.shard.is_none() && !args.formats.over().is_forced {
        tables::check(&args.out)?;
    }
    if !args.join.is_empty() {
        return join(args, words);
    }
    let clip = ClipArgs { path: PathBuf::new(), part: args.part.clone() };
    let bones = clip.part.reading().bones()?;
    let before = Header::written_in(&args.out, args.shard.unwrap_or_default());
    let (formats, notes) = again::formats(&args.deliver, &args.formats, bones.as_ref(), &before)?;
    let plan = PlanArgs::new(clip, args.corrections.clone(), args.targets.clone());
    let asked = Asked::new(&plan, &formats)?;
    let items = clips(args, words)?;
    asked.check(&items)?;
    let batch = Batch::begin(args, &items, &asked, &formats)?;
    batch.state().journal.note().iter().for_each(|note| words.say(note));
    notes.iter().for_each(|note| words.say(format_args!("note        {note}")));
    batch.work(words)?;
    batch.close(args, words)
}

/// Makes the output folder, once nothing that was asked wrongly could leave it behind empty.
fn make_folder(out: &Path) -> Result<(), Failure> {
    fs::create_dir_all(out).map_err(|error| Failure::io(out, error))
}

/// Returns the clips that are named, and says which results of genga are not taken for clips.
fn clips(args: &BatchArgs, words: &Words) -> Result<Vec<Item>, Failure> {
    let Clips { items, skipped } = list::clips(&args.clips, &args.out)?;
    if !skipped.is_empty() {
        let skipped = shortened(skipped).join(" ");
        words.say(format_args!("note        results of genga, not taken for clips: {skipped}"));
    }
    Ok(items)
}

/// A batch in progress.
struct Batch<'a> {
    items: &'a [Item],
    asked: &'a Asked<'a>,
    formats: &'a Formats,
    places: Places<'a>,
    staging: Staging,
    /// Indices of this part's clips in the list, in order.
    own: Vec<usize>,
    crew: Pool,
    is_packed: bool,
    renumbers: bool,
    fails_fast: bool,
    progress: Progress,
    state: Mutex<State>,
}

/// The mutable state of a batch in progress.
struct State {
    journal: Journal,
    /// The archive, if one is written instead of folders.
    pack: Option<Pack>,
    done: usize,
    failed: usize,
    /// Clips that were done before, among those that are done.
    resumed: usize,
    /// Clips with another motion than that whose files are replaced.
    replaced: Vec<String>,
    /// The error that stops the batch.
    fault: Option<Failure>,
}

impl<'a> Batch<'a> {
    fn begin(
        args: &'a BatchArgs,
        items: &'a [Item],
        asked: &'a Asked<'a>,
        formats: &'a Formats,
    ) -> Result<Self, Failure> {
        let names: Vec<&str> = items.iter().map(|item| item.name.as_str()).collect();
        let sizes: Vec<u64> = items.iter().map(|item| item.size).collect();
        let shard = args.shard.unwrap_or_default();
        let list = Manifest::digest(names.join("\n").as_bytes());
        make_folder(&args.out)?;
        let staging = Staging::within(&args.out).map_err(|error| Failure::io(&args.out, error))?;
        let written = Written { deliver: formats.asked(), with: formats.own_settings() };
        let header = Header::new(list, asked.digest.clone(), items.len(), shard, written);
        let journal = Journal::open(&args.out, header, &names)?;
        let pack = args
            .pack
            .then(|| Pack::open(&args.out, &journal.header, args.formats.over().is_forced))
            .transpose()?;
        // From here on a signal lets clips in progress finish.
        stop::gently();
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let jobs = args.jobs.map_or(cores, usize::from);
        let room = args.part.memory().unwrap_or(ROOM) as u64;
        Ok(Self {
            items,
            asked,
            formats,
            places: Places { out: &args.out, over: args.formats.over() },
            staging,
            own: shard.deal(&sizes),
            crew: Pool { jobs, room },
            is_packed: args.pack,
            renumbers: args.renumber,
            fails_fast: args.fail_fast,
            progress: args.progress,
            state: Mutex::new(State {
                journal,
                pack,
                done: 0,
                failed: 0,
                resumed: 0,
                replaced: vec![],
                fault: None,
            }),
        })
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn work(&self, words: &Words) -> Result<(), Failure> {
        let is_watched = self.progress == Progress::Bar;
        let sizes: Vec<u64> = self.own.iter().map(|at| self.items[*at].size).collect();
        let bytes = sizes.iter().map(|size| size + LEAST).sum();
        let bar = is_watched.then(|| words.weighing(bytes));
        let order: Vec<usize> = largest_first(&sizes).into_iter().map(|at| self.own[at]).collect();
        let is_over = || {
            let state = self.state();
            stop::is_asked() || state.fault.is_some() || self.fails_fast && state.failed > 0
        };
        self.crew.each(
            &order,
            |at| self.items[at].size,
            is_over,
            |at| {
                let told = self.one(at).and_then(|row| self.tell(at, &row, bar.as_ref()));
                if let Err(failure) = told {
                    self.state().fault.get_or_insert(failure);
                }
            },
        )?;
        self.state().fault.take().map_or(Ok(()), Err)
    }

    /// Processes a clip unless it is done already. Returns its row.
    fn one(&self, at: usize) -> Result<Row, Failure> {
        let item = &self.items[at];
        let begun = Begun::new(self.asked, at, item);
        let before = self.state().journal.line(&item.name)?;
        if let Some(row) =
            before.as_ref().map(|line| self.done(&begun, line)).transpose()?.flatten()
        {
            self.state().resumed += 1;
            return Ok(row);
        }
        let earlier = self.earlier(&item.name, before.as_ref());
        let mut parcel = self.is_packed.then(Parcel::default);
        let mut line = begun.finish(self.formats, &earlier, &self.staging, parcel.as_mut())?;
        let is_other = self.is_other(&line, before.as_ref());
        let mut state = self.state();
        state.replaced.extend(is_other.then(|| item.name.clone()));
        stop::undisturbed(|| {
            match (&mut state.pack, parcel) {
                (Some(pack), Some(parcel)) if line.row.is_done() => pack.add(parcel)?,
                (Some(_), _) => {}
                (None, _) => self.put(&mut line, before)?,
            }
            let row = line.row.clone();
            state.journal.add(line).map(|()| row)
        })
    }

    /// Whether a clip's files, if they come into its folder, are of another motion than those that were there.
    fn is_other(&self, line: &Line, before: Option<&Line>) -> bool {
        let before = before.and_then(|line| line.made_of.as_ref());
        let both = before.zip(line.made_of.as_ref());
        !self.is_packed && both.is_some_and(|(before, now)| !before.is_of(now))
    }

    /// Returns what is in a clip's folder. An archive has no numbers to keep.
    fn earlier(&self, name: &str, before: Option<&Line>) -> Earlier {
        let folder = self.places.clip_folder(name);
        match self.is_packed {
            true => Earlier::default(),
            false => Earlier::new(folder, before, self.renumbers),
        }
    }

    /// Returns the row of a clip that is done as it is asked for now, and writes down which of its files a person has
    /// changed since.
    fn done(&self, begun: &Begun<'_>, before: &Line) -> Result<Option<Row>, Failure> {
        if self.renumbers && before.has_old_numbers {
            return Ok(None);
        }
        let (name, files) = (&before.clip, &before.files);
        let (file, asked) = begun.digests();
        let is_packed = {
            let state = self.state();
            if !state.journal.has(name, file, asked) {
                return Ok(None);
            }
            state.pack.as_ref().map(|pack| pack.has(name, files))
        };
        let changed = match is_packed {
            Some(is_packed) => is_packed.then(Vec::new),
            None => self.places.changed(name, files),
        };
        let Some(kept) = changed.filter(|changed| !self.places.writes_over(name, files, changed))
        else {
            return Ok(None);
        };
        let row = Row { kept, ..before.row.clone() };
        if row != before.row {
            self.state().journal.add(Line { row: row.clone(), ..before.clone() })?;
        }
        Ok(Some(row))
    }

    /// Moves the files of a clip into its folder. A clip whose files would replace those of a person fails.
    fn put(&self, line: &mut Line, before: Option<Line>) -> Result<(), Failure> {
        let (files, made_of, has_old_numbers) =
            before.map(|line| (line.files, line.made_of, line.has_old_numbers)).unwrap_or_default();
        match self.places.put(line, &self.staging, &files) {
            Err(Failure::AskedWrongly(message)) => {
                line.row = Row::failed(message, vec![]);
                (line.files, line.made_of, line.has_old_numbers) =
                    (files, made_of, has_old_numbers);
                line.keys.clear();
            }
            put => {
                line.row.kept = put?;
                // A file that stays is still known, so that it is not taken for one that no batch wrote.
                let kept = files.into_iter().filter(|(file, _)| line.row.kept.contains(file));
                kept.for_each(|(file, digest)| {
                    line.files.entry(file).or_insert(digest);
                });
            }
        }
        Ok(())
    }

    fn tell(&self, at: usize, row: &Row, bar: Option<&Bar>) -> Result<(), Failure> {
        let mut state = self.state();
        state.done += usize::from(row.is_done());
        state.failed += usize::from(!row.is_done());
        let (done, failed, of) = (state.done, state.failed, self.own.len());
        let finished = done + failed;
        if let Some(bar) = bar {
            bar.weigh(
                self.items[at].size + LEAST,
                format!("{finished} of {of} clips, {failed} failed"),
            );
        }
        let line = match self.progress {
            Progress::Bar | Progress::None => return Ok(()),
            Progress::Json => {
                let (clip, status, message) = (&self.items[at].name, &row.status, row.said());
                serde_json::json!({
                    "clip": clip, "status": status, "message": message, "done": done, "failed": failed, "of": of
                })
                .to_string()
            }
            Progress::Openjd => {
                let share = 100.0 * finished as f64 / of as f64;
                format!(
                    "openjd_progress: {share:.1}\nopenjd_status: {finished} of {of} clips, {failed} failed"
                )
            }
        };
        // A closed stdout is no reason to stop.
        let _ = writeln!(stdout(), "{line}");
        Ok(())
    }

    /// Writes the tables of the finished clips, and reports the outcome.
    fn close(self, args: &BatchArgs, words: &Words) -> Result<(), Failure> {
        let names = || self.own.iter().map(|at| self.items[*at].name.as_str());
        let state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        let journals = [state.journal];
        let mut count = match args.shard {
            None => tables::write(&args.out, &journals, names())?,
            Some(_) => Count::of(&journals, names())?,
        };
        (count.resumed, count.replaced) = (state.resumed, state.replaced);
        count.replaced.sort_unstable();
        let of = self.own.len();
        if stop::is_asked() {
            let finished = count.done + count.failures;
            return Err(Failure::Stopped(format!(
                "stopped with {finished} of {of} clips finished; the same command goes on from there"
            )));
        }
        count.other = match state.pack {
            Some(_) => Some(CLIPS).filter(|name| args.out.join(name).is_dir()),
            None => Some(ARCHIVE).filter(|name| args.out.join(name).is_file()),
        };
        if let Some(pack) = state.pack {
            let packs = [pack];
            pack::all(packs[0].path(), &packs, &journals, names())?;
            packs.into_iter().for_each(Pack::clear);
        } else if args.shard.is_none() {
            count.left = left::folders(&args.out, names());
        }
        end(&count, of, args, words)
    }
}

/// Merges all parts into one set of tables.
fn join(args: &BatchArgs, words: &Words) -> Result<(), Failure> {
    let (mut journals, mut packs) = (Vec::new(), Vec::new());
    for folder in &args.join {
        let entries = fs::read_dir(folder).map_err(|error| Failure::io(folder, error))?;
        let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        files.retain(|file| {
            file.file_name().is_some_and(|name| is_journal(&name.to_string_lossy()))
        });
        files.sort();
        for file in files {
            let journal = Journal::read(&file)?;
            journal.note().iter().for_each(|note| words.say(note));
            packs.push(Pack::read(folder, &journal.header)?);
            journals.push(journal);
        }
    }
    check_parts(&journals)?;
    let mut clips: Vec<(usize, String)> = Vec::new();
    journals
        .iter()
        .for_each(|journal| clips.extend(journal.places().map(|(at, name)| (at, name.to_owned()))));
    clips.sort();
    let of = journals.first().map_or(0, |journal| journal.header.clips);
    let names = || clips.iter().map(|(_, name)| name.as_str());
    make_folder(&args.out)?;
    let count = tables::write(&args.out, &journals, names())?;
    if packs.iter().any(Pack::is_there) {
        pack::all(&args.out.join(ARCHIVE), &packs, &journals, names())?;
    }
    end(&count, of, args, words)?;
    match of.saturating_sub(clips.len()) {
        0 => Ok(()),
        missing => Err(Failure::CouldNot(format!(
            "{missing} of {of} clips not in these folders; run the batches of the parts to their ends"
        ))),
    }
}

/// Reports the outcome.
fn end(count: &Count, of: usize, args: &BatchArgs, words: &Words) -> Result<(), Failure> {
    let Count { done, resumed, failed, failures, lacking, lacks, kept, keeps, warned, .. } = count;
    let out = args.out.display();
    let tables =
        if args.shard.is_none() { "summary.csv keys.csv times.csv" } else { "next --join" };
    words.say(format_args!(
        "batch       一括       {} of {of} done into {out}: {tables}",
        counted(*done, "clip")
    ));
    if *resumed > 0 {
        let clips = counted(*resumed, "clip");
        words.say(format_args!("note        {clips} done already, not processed again"));
    }
    count
        .of_before(&args.out)
        .iter()
        .for_each(|line| words.say(format_args!("note        {line}")));
    let listed = |count: usize, clips: &[String]| {
        let more = if count > NAMED { "; …, all in summary.csv" } else { "" };
        format!("{}{more}", clips.join("; "))
    };
    if !warned.is_empty() {
        let of_code = |(code, (clips, count)): (&String, &(Vec<String>, usize))| {
            let more = if *count > clips.len() { ", …" } else { "" };
            format!("{code} {count} ({}{more})", clips.join(", "))
        };
        let warned: Vec<String> = warned.iter().map(of_code).collect();
        words.say(format_args!(
            "note        clips with warnings (--strict refuses damaged ones): {}",
            warned.join(", ")
        ));
    }
    if count.notes > 0 {
        words.say(format_args!("note        {}", listed(count.notes, &count.noted)));
    }
    if *keeps > 0 {
        words.say(format_args!("note        {KEPT}{}", listed(*keeps, kept)));
    }
    let named = |count: usize, what: &str, clips: &[String]| {
        (count > 0).then(|| format!("{count} of {of} {what}: {}", listed(count, clips)))
    };
    let untried = of.saturating_sub(*done + *failures);
    let untried = (untried > 0 && args.fail_fast).then(|| format!("{untried} of {of} not tried"));
    let faults = [named(*failures, "failed", failed), named(*lacks, "lack a format", lacking)];
    let faults = faults.into_iter().flatten().chain(untried);
    let message = faults.collect::<Vec<_>>().join("; ");
    if message.is_empty() {
        return Ok(());
    }
    if args.progress == Progress::Openjd {
        let word = if args.allow_failures { "openjd_status" } else { "openjd_fail" };
        let _ = writeln!(stdout(), "{word}: {message}");
    }
    if args.allow_failures {
        if args.progress != Progress::Openjd {
            words.say(message);
        }
        return Ok(());
    }
    Err(Failure::CouldNot(message))
}
