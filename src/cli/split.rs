//! `genga split`: a long take as the actions that it consists of.

use std::path::Path;

use super::args::SplitArgs;
use super::failure::Failure;
use super::table::Table;
use super::words::{Words, counted};
use super::{io, source, stale};
use crate::deliver::{Cut, actions_csv};
use crate::keys::{Action, Actions, SplitReason};
use crate::motion::{Clip, bvh};
use crate::pipeline::Engine;
use crate::recipe::Recipe;
use crate::time::{Frame, FrameRate};

pub(super) fn run(args: &SplitArgs, words: &Words) -> Result<(), Failure> {
    let (recipe, mut edits) = source::recipe(&args.settings, Recipe::default())?;
    if !args.at.is_empty() {
        edits.splits = args.at.clone();
    }
    check_folder(args.out.as_deref())?;
    let source = source::clip(&args.clip)?;
    source.notes.iter().for_each(|note| words.say(note));
    let mut engine = Engine::new(source.clip)?;
    let actions = engine.find_actions(&recipe, &edits)?.clone();
    let clip = engine.clip();
    if let Some(folder) = &args.out {
        let parts = Parts { clip, actions: &actions, name: &io::stem(&args.clip.clip) };
        parts.write(&args.clip.clip, folder, words)?;
    }
    io::to_stdout(table(&actions, clip.rate()).as_bytes())
}

fn check_folder(folder: Option<&Path>) -> Result<(), Failure> {
    if folder.is_some_and(io::is_stream) {
        let message = "--out: split writes a folder of files, not to stdout; without --out it lists the actions there";
        return Err(Failure::AskedWrongly(message.into()));
    }
    Ok(())
}

/// A take in parts.
struct Parts<'a> {
    clip: &'a Clip,
    actions: &'a Actions,
    name: &'a str,
}

impl Parts<'_> {
    /// Writes a BVH of each action and the table of them: all files, or none.
    fn write(&self, source: &Path, folder: &Path, words: &Words) -> Result<(), Failure> {
        let files = self.files();
        let table = Cut::file_of(self.name, "CUT-actions.csv");
        for file in files.iter().chain([&table]) {
            io::spare(source, &folder.join(file))?;
        }
        let mut bundle = io::Bundle::begin(folder)?;
        for (file, action) in files.iter().zip(self.actions.iter()) {
            bundle.add(file, self.bvh(action))?;
        }
        bundle.add(&table, actions_csv(self.actions, self.clip.rate(), &files)?)?;
        bundle.finish()?;
        let left = stale::stale(folder, &files);
        if !left.is_empty() {
            let left = left.join(" ");
            words.say(format_args!("note        of an earlier split, not of this one: {left}"));
        }
        let (count, folder) = (counted(files.len(), "action"), folder.display());
        words.say(format_args!("files       {folder}: {count}, and {table}"));
        Ok(())
    }

    /// Numbered from 01, all as wide as the last.
    fn files(&self) -> Vec<String> {
        let count = self.actions.iter().count();
        let digits = count.to_string().len().max(2);
        let file = |number| Cut::file_of(self.name, &format!("CUT-{number:0digits$}.bvh"));
        (1..=count).map(file).collect()
    }

    /// The rows of an action as they stand in the take.
    fn bvh(&self, action: Action) -> String {
        let mut writer = bvh::Writer::new(self.clip.skeleton(), self.clip.rate());
        writer.rows((action.from.0..action.past.0).map(|frame| self.clip.row(Frame(frame))));
        writer.finish()
    }
}

/// The actions for people.
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

/// Why an action begins, in both languages.
fn words_of(why: SplitReason) -> &'static str {
    match why {
        SplitReason::Rest => "a rest 止め",
        SplitReason::Lull => "a lull 緩み",
        SplitReason::Change => "a change 動きの変化",
        SplitReason::Asked => "a frame asked for 指定",
    }
}
