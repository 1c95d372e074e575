//! What `genga split` takes.

use std::path::PathBuf;

use clap::Args;

use super::corrections::frame;
use super::{ClipArgs, Settings};
use crate::time::Frame;

const HELP: &str = "\
An action (動作) is one movement: a throw, a swing, a kick. The second paper leaves 4 to 6
drawings out of an action, and its clips were cut by hand into single ones. Not to be
confused with a cut (カット), the shot.

A take is split in the middle of its rests (止め), in lulls (緩み) and where other parts of
the body take over the movement (動きの変化), so that actions last 4.4 seconds or so, and
none less than one. genga run does the same by itself and counts what is left out in each
action; its --split and actions.split=false are for when it is wrong.

Examples:
  genga split take.bvh                            where it would be split, and why
  genga split take.bvh --out parts                parts/take-01.bvh, take-02.bvh …
  genga split take.bvh --at 310,774 --out parts   there and nowhere else
  genga split take.bvh --set actions.length=8s    fewer and longer actions";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(in crate::cli) struct SplitArgs {
    #[command(flatten)]
    pub(in crate::cli) clip: ClipArgs,
    #[command(flatten)]
    pub(in crate::cli) settings: Settings,
    /// Source frames with which actions begin, instead of those that are found: --at 310,774
    #[arg(long, value_name = "FRAME,…", value_delimiter = ',', value_parser = frame)]
    pub(in crate::cli) at: Vec<Frame>,
    /// Write each action as a BVH of its own into this folder, and a table of them; without it they are
    /// only listed.
    #[arg(long, short, value_name = "DIR")]
    pub(in crate::cli) out: Option<PathBuf>,
}
