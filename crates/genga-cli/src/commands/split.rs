//! `genga split`: splits a long take into its actions.

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::clip::ClipArgs;
use crate::console::{Table, Words, counted};
use crate::corrections::{Settings, frame};
use crate::failure::Failure;
use crate::staging::Bundle;
use crate::{files, paths};
use genga::error::Error;
use genga::keys::{Action, Actions, Cycle, SplitReason};
use genga::motion::{Clip, bvh};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::{Frame, FrameRate};
use genga_files::{Cut, actions_csv, cycles_csv};

const HELP: &str = "\
An action (動作) is one movement: a throw, a swing, a kick. The second paper leaves 4 to 6
drawings out of an action; its clips were cut by hand into single actions. An action is not
a cut (カット), which is a shot.

A take is split in the middle of its rests (止め), in lulls (緩み) and where other parts of
the body take over the movement (動きの変化). Actions last about 4.4 seconds, and at least
1 second. genga run splits takes by itself and counts left-out drawings in each action. Use
its --split or actions.split=false where it splits wrongly.

Examples:
  genga split take.bvh                            where it would be split, and why
  genga split take.bvh --out parts                parts/take-01.bvh, take-02.bvh …
  genga split take.bvh --at 310,774 --out parts   there and nowhere else
  genga split take.bvh --set actions.length=8s    fewer and longer actions
  genga split walk.bvh --cycles                   its best cycles, for genga run --trim … --loop";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct SplitArgs {
    #[command(flatten)]
    clip: ClipArgs,
    #[command(flatten)]
    settings: Settings,
    /// Source frames at which actions begin, instead of the detected ones: --at 310,774
    #[arg(long, value_name = "FRAME,…", value_delimiter = ',', value_parser = frame)]
    at: Vec<Frame>,
    /// List cycles (循環) instead of actions: stretches that can be repeated, the closest first.
    ///
    /// A gait's go from a foot's contact to its next or second next one. Other motions are searched for poses 0.4 to 4
    /// seconds apart that are alike. run --trim FRAMES --loop makes a sheet that repeats.
    #[arg(long, conflicts_with = "at")]
    cycles: bool,
    /// Write a BVH of each action or cycle, and a table of them, to this folder. Without it, they are only listed.
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
}

pub(super) fn run(args: &SplitArgs, words: &Words) -> Result<(), Failure> {
    let (recipe, mut edits) = args.settings.read(Recipe::default())?;
    if !args.at.is_empty() {
        edits.splits = args.at.clone();
    }
    paths::check_folder(
        args.out.as_deref(),
        "split",
        "; without --out it lists the actions there",
    )?;
    let source = args.clip.read()?;
    source.notes.iter().for_each(|warning| words.warn(warning));
    let of_clip = files::fault_of(&args.clip.path);
    let mut engine = Engine::new(source.clip)?.with_budget(args.clip.budget());
    if args.cycles {
        return list_cycles(args, engine.clip(), words);
    }
    let actions = engine.find_actions(&recipe, &edits).map_err(of_clip)?.clone();
    let clip = engine.clip();
    if let Some(folder) = &args.out {
        let (name, rate) = (paths::stem(&args.clip.path), clip.rate());
        let ranges = actions.iter().map(|action| action.from.0..action.past.0).collect();
        let parts = Parts { clip, ranges, name: &name, what: "action" };
        let csv = |files: &[String]| actions_csv(&actions, rate, files);
        parts.write(&args.clip.path, folder, &csv, words)?;
    }
    files::page_to_stdout(&table(&actions, clip.rate()))
}

/// Lists the best cycles of a clip, and writes them if a folder is given.
fn list_cycles(args: &SplitArgs, clip: &Clip, words: &Words) -> Result<(), Failure> {
    let cycles = Cycle::find_all(clip);
    if cycles.is_empty() {
        let message = "no cycle is found: no two poses 0.4 to 4 seconds apart are alike; name the frames of a round by \
                       run --trim A..B --loop";
        words.say(format_args!("note        {message}"));
    }
    if let Some(folder) = &args.out {
        let (name, rate) = (paths::stem(&args.clip.path), clip.rate());
        let ranges = cycles.iter().map(frames_of).collect();
        let parts = Parts { clip, ranges, name: &name, what: "cycle" };
        let csv = |files: &[String]| cycles_csv(&cycles, rate, files);
        parts.write(&args.clip.path, folder, &csv, words)?;
    }
    files::page_to_stdout(&cycle_table(&cycles, clip.rate()))
}

/// The frames of a cycle, the last one included, as --trim takes them.
fn frames_of(cycle: &Cycle) -> Range<usize> {
    cycle.first.0..cycle.last.0 + 1
}

/// A take and its parts, actions or cycles.
struct Parts<'a> {
    clip: &'a Clip,
    ranges: Vec<Range<usize>>,
    name: &'a str,
    /// Their name: action or cycle.
    what: &'a str,
}

impl Parts<'_> {
    /// Writes a BVH of each part and the table that `csv` makes of their files: all files or none.
    fn write(
        &self,
        source: &Path,
        folder: &Path,
        csv: &dyn Fn(&[String]) -> Result<String, Error>,
        words: &Words,
    ) -> Result<(), Failure> {
        let files = self.files();
        let table = Cut::file_of(self.name, &format!("CUT-{}s.csv", self.what));
        for file in files.iter().chain([&table]) {
            paths::spare(&[("motion", Some(source))], &folder.join(file))?;
        }
        let mut bundle = Bundle::begin(folder)?;
        for (file, range) in files.iter().zip(&self.ranges) {
            bundle.add(file, self.bvh(range.clone()))?;
        }
        bundle.add(&table, csv(&files)?)?;
        bundle.finish(Vec::new())?;
        let left = paths::stale(folder, &files);
        if !left.is_empty() {
            let left = left.join(" ");
            words.say(format_args!("note        of an earlier split, not of this one: {left}"));
        }
        let (count, folder) = (counted(files.len(), self.what), folder.display());
        words.say(format_args!("files       {folder}: {count}, and {table}"));
        Ok(())
    }

    /// File names, numbered from 01, all padded to the same width.
    fn files(&self) -> Vec<String> {
        let count = self.ranges.len();
        let digits = count.to_string().len().max(2);
        let of = if self.what == "action" { "" } else { &format!("{}-", self.what) };
        let file = |number| Cut::file_of(self.name, &format!("CUT-{of}{number:0digits$}.bvh"));
        (1..=count).map(file).collect()
    }

    /// Writes the rows of a part as BVH, unchanged.
    fn bvh(&self, range: Range<usize>) -> String {
        let mut writer = bvh::Writer::new(self.clip.skeleton(), self.clip.rate());
        writer.rows(range.map(|frame| self.clip.row(Frame(frame))));
        writer.finish()
    }
}

/// Renders the table of cycles for people.
fn cycle_table(cycles: &[Cycle], rate: FrameRate) -> String {
    let mut table = Table::default();
    table.row(["cycle 循環", "--trim", "koma", "pose apart", "speed apart"]);
    for (at, cycle) in cycles.iter().enumerate() {
        let Range { start, end } = frames_of(cycle);
        table.row([
            (at + 1).to_string(),
            format!("{start}..{end}"),
            format!("{:.2}", cycle.koma(rate)),
            format!("{:.2} %", cycle.pose),
            format!("{:.1} %/s", cycle.speed),
        ]);
    }
    table.text(2)
}

/// Renders the table of actions for people.
fn table(actions: &Actions, rate: FrameRate) -> String {
    let mut table = Table::default();
    table.row(["action 動作", "begins with 始まり", "frames", "seconds"]);
    for (at, Action { from, past, why }) in actions.iter().enumerate() {
        let why = why.map_or("the clip クリップの頭", words_of);
        let seconds = (past.0 - from.0) as f64 / rate.fps();
        table.row([
            (at + 1).to_string(),
            why.into(),
            format!("{from}..{past}"),
            format!("{seconds:.2}"),
        ]);
    }
    table.text(2)
}

/// The reason an action begins, in both languages.
fn words_of(why: SplitReason) -> &'static str {
    match why {
        SplitReason::Rest => "a rest 止め",
        SplitReason::Lull => "a lull 緩み",
        SplitReason::Change => "a change 動きの変化",
        SplitReason::Asked => "a frame asked for 指定",
    }
}
