//! The subcommands and their dispatch.

mod batch;
mod compare;
mod deliver;
mod eval;
mod inspect;
mod keys;
mod omit;
mod pages;
mod preview;
mod recipe;
mod run;
mod split;
mod studio;
mod study;
mod trial;

use clap::{CommandFactory, Parser, Subcommand};

use super::console::Words;
use super::failure::Failure;

#[cfg(feature = "studio-files")]
pub use studio::Disk;

/// Motion capture to Japanese limited animation.
///
/// Reads a clip, finds its key drawings (genga, 原画), adds inbetweens (中割り) with spacing (詰め),
/// leaves out the fastest (naka-nashi, 中無し) and holds the slowest (koma-dori, コマ撮り).
/// The result is a timesheet: the drawing shown on each koma, at 24 koma per second.
///
/// Start with: genga run clip.bvh
#[derive(Debug, Parser)]
#[command(name = "genga", version, max_term_width = 100)]
pub(super) struct Args {
    /// Print only errors.
    #[arg(long, short, global = true)]
    pub(super) quiet: bool,
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Run the whole chain: write key tables, timesheet, limited motion and pictures to a folder.
    Run(run::RunArgs),
    /// Process many clips: one sheet per clip, and tables of the whole batch.
    Batch(batch::BatchArgs),
    /// Open the window: view the motion, change settings, correct keys, export.
    Studio(studio::StudioArgs),
    /// Write a sheet, edited or not, in other formats.
    Deliver(deliver::DeliverArgs),
    /// Show two sheets of one take side by side, as a web page, a GIF or a video.
    Preview(preview::PreviewArgs),
    /// Write the key table as CSV.
    Keys(keys::KeysArgs),
    /// Apply only naka-nashi and koma-dori, to the clip at 24 drawings per second.
    Omit(omit::OmitArgs),
    /// Split a long take into its actions: list them, or write a BVH of each.
    Split(split::SplitArgs),
    /// Count keys and drawings while one or two settings vary, as in Table 1 of the first paper.
    Study(study::StudyArgs),
    /// Measure the quality of a sheet: its drawings against the source, its genga against your own keys.
    Eval(eval::EvalArgs),
    /// Compare methods that choose the same number of keys, including the optimum.
    Compare(compare::CompareArgs),
    /// Make a blind test, a page that asks people to choose between two films, and evaluate the answers.
    Trial(trial::TrialArgs),
    /// Describe a clip: joints, rate, length, size, inserted T-pose, warnings.
    Inspect(inspect::InspectArgs),
    /// Print the default recipe with comments.
    Recipe(recipe::RecipeArgs),
    /// Print completions for a shell.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Print the manual page.
    Man,
}

impl Args {
    /// Runs the chosen subcommand.
    pub(super) fn run(self, words: &Words) -> Result<(), Failure> {
        match self.command {
            Command::Run(args) => run::run(&args, words),
            Command::Batch(args) => batch::run(&args, words),
            Command::Studio(args) => studio::run(args),
            Command::Deliver(args) => deliver::run(&args, words),
            Command::Preview(args) => preview::run(&args, words),
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
