//! `genga keys`: the key table.

use std::path::PathBuf;

use clap::Args;

use crate::cli::failure::Failure;
use crate::cli::plan::{Plan, PlanArgs};
use crate::cli::words::Words;
use crate::cli::{corrections, files, paths, seen};
use crate::deliver::{self, Drawings, Rows};

#[derive(Debug, Args)]
pub(super) struct KeysArgs {
    #[command(flatten)]
    plan: PlanArgs,
    /// Every joint's keys and walls instead of the body's keys.
    #[arg(long, conflicts_with = "TargetArgs")]
    per_joint: bool,
    /// The table, a CSV file; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    out: PathBuf,
}

pub(super) fn run(args: &KeysArgs, words: &Words) -> Result<(), Failure> {
    let (clip, corrections) = (&args.plan.clip.path, &args.plan.corrections);
    let sources = [
        ("motion", Some(&**clip)),
        ("file with your keys", corrections.pin_from.as_deref()),
        ("frozen sheet", corrections.freeze.as_deref()),
        ("camera", seen::file(&corrections.seen)),
    ];
    paths::spare(&sources, &args.out)?;
    let mut plan = Plan::of(&args.plan)?;
    let (mut engine, _) = plan.read(&mut |warning| words.warn(warning))?;
    plan.settle(&mut engine, words, &mut |note| words.say(note))?;
    let breakdown = engine.run(&plan.recipe, &plan.edits).map_err(files::fault_of(clip))?;
    let idle = corrections::idle(&plan.edits, &breakdown);
    let unmoved = corrections::unmoved(&plan.edits, &breakdown);
    unmoved.iter().chain(&idle).for_each(|note| words.say(note));
    let table = if args.per_joint {
        deliver::turns_csv(breakdown.clip.skeleton(), breakdown.filtered, breakdown.turns)?
    } else {
        let table = Drawings { cut: paths::stem(clip), rows: Rows::Keys };
        table.write(breakdown.clip, breakdown.sheet)?
    };
    files::write(&args.out, table.as_bytes())
}
