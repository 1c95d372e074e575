//! The commands: what can be asked on the command line.

mod batch;
mod compare;
mod deliver;
mod eval;
mod inspect;
mod keys;
mod omit;
mod pages;
mod recipe;
mod run;
mod split;
mod studio;
mod study;
mod trial;

use clap::{CommandFactory, Parser, Subcommand};

use super::failure::Failure;
use super::words::Words;

#[cfg(feature = "studio-files")]
pub use studio::Disk;

/// Motion capture to Japanese limited animation.
///
/// Reads a clip and finds its key drawings (genga, 原画), puts inbetweens (中割り) between them with
/// spacing (詰め), leaves out the fastest (naka-nashi, 中無し) and holds the slowest (koma-dori, コマ撮り).
/// The result is a timesheet: which drawing stands on which koma of 24 a second.
///
/// Begin with: genga run clip.bvh
#[derive(Debug, Parser)]
#[command(name = "genga", version, max_term_width = 100)]
pub(super) struct Args {
    /// Say nothing but errors.
    #[arg(long, short, global = true)]
    pub(super) quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// The whole chain: key tables, timesheet, limited motion and pictures into a folder.
    Run(run::RunArgs),
    /// Many clips at once: a sheet of each, and tables of all.
    Batch(batch::BatchArgs),
    /// The window: see the motion, turn the knobs, correct the keys, export.
    Studio(studio::StudioArgs),
    /// A sheet again, edited or not, in the formats that are asked for.
    Deliver(deliver::DeliverArgs),
    /// The key table as CSV.
    Keys(keys::KeysArgs),
    /// Naka-nashi and koma-dori alone, on the clip at 24 drawings a second.
    Omit(omit::OmitArgs),
    /// A long take as the single actions that it consists of: where they part, and a BVH of each.
    Split(split::SplitArgs),
    /// What is found when one or two settings vary: the first paper's Table 1, or any knob.
    Study(study::StudyArgs),
    /// How good a sheet is: its drawings beside the source, its genga beside keys of your own.
    Eval(eval::EvalArgs),
    /// Several ways to choose the same number of keys, side by side, the best possible among them.
    Compare(compare::CompareArgs),
    /// A blind test for people: a page that asks which of two films they take, and what they answered.
    Trial(trial::TrialArgs),
    /// What is in a clip: joints, rate, length, size, an inserted T-pose, warnings.
    Inspect(inspect::InspectArgs),
    /// The commented default recipe on stdout.
    Recipe(recipe::RecipeArgs),
    /// Completions for a shell on stdout.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// The manual page on stdout.
    Man,
}

impl Args {
    /// Does what is asked.
    pub(super) fn run(self, words: &Words) -> Result<(), Failure> {
        match self.command {
            Command::Run(args) => run::run(&args, words),
            Command::Batch(args) => batch::run(&args, words),
            Command::Studio(args) => studio::run(args),
            Command::Deliver(args) => deliver::run(&args, words),
            Command::Keys(args) => keys::run(&args, words),
            Command::Omit(args) => omit::run(&args, words),
            Command::Split(args) => split::run(&args, words),
            Command::Study(args) => study::run(&args, words),
            Command::Eval(args) => eval::run(&args, words),
            Command::Compare(args) => compare::run(&args, words),
            Command::Trial(args) => trial::run(&args, words),
            Command::Inspect(args) => inspect::run(&args, words),
            Command::Recipe(args) => recipe::run(&args),
            Command::Completions { shell } => pages::completions(shell, Self::command()),
            Command::Man => pages::man(Self::command()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_holds() {
        Args::command().debug_assert();
    }
}
