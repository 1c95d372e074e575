//! The `genga` program. It uses the public library and nothing else.

mod args;
mod asked;
mod compare;
mod deliver;
#[cfg(feature = "studio")]
mod dialog;
#[cfg(feature = "studio")]
pub mod disk;
mod eval;
mod failure;
mod inspect;
mod io;
mod keys;
mod omit;
mod pages;
mod pictures;
mod pins;
#[cfg(feature = "studio")]
mod recent;
mod recipe;
mod results;
mod run;
mod seen;
mod source;
mod split;
mod stale;
mod studio;
mod study;
mod table;
mod targets;
mod words;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};
use failure::Failure;
use words::Words;

/// Runs the program with the arguments of this process.
pub fn main() -> ExitCode {
    let args = Args::parse();
    let words = Words::new(args.quiet);
    let done = match args.command {
        Command::Run(args) => run::run(&args, &words),
        Command::Studio(args) => studio::run(args),
        Command::Deliver(args) => deliver::run(&args, &words),
        Command::Keys(args) => keys::run(&args, &words),
        Command::Omit(args) => omit::run(&args, &words),
        Command::Split(args) => split::run(&args, &words),
        Command::Study(args) => study::run(&args, &words),
        Command::Eval(args) => eval::run(&args, &words),
        Command::Compare(args) => compare::run(&args, &words),
        Command::Inspect(args) => inspect::run(&args, &words),
        Command::Recipe(args) => recipe::run(&args),
        Command::Completions { shell } => pages::completions(shell),
        Command::Man => pages::man(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        // The reader has what it wanted.
        Err(Failure::ClosedPipe) => ExitCode::SUCCESS,
        Err(failure) => {
            words.error(&failure);
            ExitCode::from(failure.code())
        }
    }
}
