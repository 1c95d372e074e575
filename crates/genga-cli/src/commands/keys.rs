//! `genga keys`: writes the key table.

use std::path::PathBuf;

use clap::Args;

use crate::console::Words;
use crate::failure::Failure;
use crate::plan::{Plan, PlanArgs};
use crate::{files, paths, sheets};
use genga_files::{Drawings, Rows, run_notes};

#[derive(Debug, Args)]
pub(super) struct KeysArgs {
    #[command(flatten)]
    plan: PlanArgs,
    /// Write the keys and walls of every joint instead of the body's keys.
    #[arg(long, conflicts_with = "TargetArgs")]
    per_joint: bool,
    /// CSV file of the table; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    out: PathBuf,
}

pub(super) fn run(args: &KeysArgs, words: &Words) -> Result<(), Failure> {
    let (clip, corrections) = (&args.plan.clip.path, &args.plan.corrections);
    let frozen = corrections.freeze.as_deref().map(sheets::file_of).transpose()?;
    let others = [("motion", Some(&**clip)), ("frozen sheet", frozen.as_deref())];
    paths::spare(&others, &args.out)?;
    paths::spare(&corrections.sources(), &args.out)?;
    let mut plan = Plan::from_args(&args.plan)?;
    let (mut engine, _) = plan.read(&mut |warning| words.warn(warning))?;
    plan.settle(&mut engine, words, &mut |note| words.say(note))?;
    let fault = plan.fault_of(&engine);
    let breakdown = engine.run(&plan.recipe, &plan.edits).map_err(fault)?;
    let idle = run_notes::idle(&plan.edits, &breakdown);
    let unmoved = run_notes::unmoved(&plan.edits, &breakdown);
    unmoved.iter().chain(&idle).for_each(|note| words.say(note));
    let table = if args.per_joint {
        genga_files::turns_csv(breakdown.clip.skeleton(), breakdown.filtered, breakdown.turns)?
    } else {
        let table = Drawings { cut: paths::stem(clip), rows: Rows::Keys };
        table.write(breakdown.clip, breakdown.sheet)?
    };
    files::write(&args.out, table.as_bytes())
}
