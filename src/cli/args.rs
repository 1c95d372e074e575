//! What can be asked on the command line.

mod clip;
mod compare;
mod corrections;
mod eval;
mod formats;
mod seen;
mod split;
mod study;
mod targets;

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand};

use crate::timing::Amount;

pub(super) use clip::{ClipArgs, Part, Reading};
pub(super) use compare::CompareArgs;
pub(super) use corrections::{Corrections, LayerArgs, Settings};
pub(super) use eval::EvalArgs;
pub(super) use formats::{BvhRows, DeliverArgs, FormatArgs, RunArgs};
pub(super) use seen::SeenArgs;
pub(super) use split::SplitArgs;
pub(super) use study::{Filter, StudyArgs};
pub(super) use targets::TargetArgs;

/// Motion capture to Japanese limited animation.
///
/// Reads a BVH clip and finds its key drawings (genga, 原画), puts inbetweens (中割り) between them with
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
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// The whole chain: key tables, timesheet, limited motion and pictures into a folder.
    Run(RunArgs),
    /// The window: see the motion, turn the knobs, correct the keys, export.
    Studio(StudioArgs),
    /// A sheet again, edited or not, in the formats that are asked for.
    Deliver(DeliverArgs),
    /// The key table as CSV.
    Keys(KeysArgs),
    /// Naka-nashi and koma-dori alone, on the clip at 24 drawings a second.
    Omit(OmitArgs),
    /// A long take as the single actions that it consists of: where they part, and a BVH of each.
    Split(SplitArgs),
    /// What is found when one or two settings vary: the first paper's Table 1, or any knob.
    Study(StudyArgs),
    /// How good a sheet is: its drawings beside the source, its genga beside keys of your own.
    Eval(EvalArgs),
    /// Several ways to choose the same number of keys, side by side, the best possible among them.
    Compare(CompareArgs),
    /// What is in a clip: joints, rate, length, size, an inserted T-pose, warnings.
    Inspect(InspectArgs),
    /// The commented default recipe on stdout.
    Recipe(RecipeArgs),
    /// Completions for a shell on stdout.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// The manual page on stdout.
    Man,
}

#[derive(Debug, ClapArgs)]
#[cfg_attr(not(feature = "studio"), allow(dead_code, reason = "this build has no studio"))]
pub(super) struct StudioArgs {
    /// The motion, a BVH file; without one the window waits for a file to be dropped on it.
    #[arg(value_name = "CLIP.bvh")]
    pub(super) clip: Option<PathBuf>,
    #[command(flatten)]
    pub(super) part: Part,
    /// A recipe with its corrections [default: CLIP.genga.toml beside the clip, where a save of the studio
    /// goes].
    #[arg(long, value_name = "R.toml", requires = "clip")]
    pub(super) recipe: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct KeysArgs {
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    #[command(flatten)]
    pub(super) corrections: Corrections,
    #[command(flatten)]
    pub(super) targets: TargetArgs,
    /// Every joint's keys and walls instead of the body's keys.
    #[arg(long, conflicts_with = "TargetArgs")]
    pub(super) per_joint: bool,
    /// The table, a CSV file; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    pub(super) out: PathBuf,
}

#[derive(Debug, ClapArgs)]
pub(super) struct OmitArgs {
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    #[command(flatten)]
    pub(super) seen: SeenArgs,
    /// How many of the fastest drawings to leave out: a count (4) or a share of the koma (4%).
    #[arg(long, value_name = "N", default_value = "4")]
    pub(super) naka_nashi: Amount,
    /// How many of the slowest drawings to hold over: a count (33) or a share of the drawings (1/3).
    #[arg(long, value_name = "N|SHARE", default_value = "1/3")]
    pub(super) koma_dori: Amount,
    /// The longest hold, in koma.
    #[arg(long, value_name = "K", default_value_t = 4)]
    pub(super) max_hold: usize,
    /// Leave the fastest out all at once, by their first speed (for comparison).
    #[arg(long)]
    pub(super) all_at_once: bool,
    /// Hold first, leave out after.
    #[arg(long)]
    pub(super) koma_dori_first: bool,
    /// Let the motion get shorter by what naka-nashi leaves out.
    #[arg(long)]
    pub(super) let_length_change: bool,
    /// The limited motion, a BVH file at 24 frames a second; - is stdout.
    #[arg(long, short, value_name = "FILE.bvh")]
    pub(super) out: PathBuf,
    /// The timesheet, a CSV file.
    #[arg(long, value_name = "FILE.csv")]
    pub(super) sheet: Option<PathBuf>,
    /// The movement into each koma before and after, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) plot: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct InspectArgs {
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    /// Only the warnings, on stdout: one a line, its code, line:column (- for the whole clip), sentence.
    #[arg(long)]
    pub(super) warnings: bool,
    /// Draw the skeleton too: its rest pose and its hierarchy, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg", conflicts_with = "warnings")]
    pub(super) plot: Option<PathBuf>,
}

#[derive(Debug, ClapArgs)]
pub(super) struct RecipeArgs {
    /// The settings of the first paper's Table 1 instead.
    #[arg(long)]
    pub(super) study: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_definition_holds() {
        Args::command().debug_assert();
    }
}
