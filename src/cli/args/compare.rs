//! What `genga compare` takes.

use std::path::PathBuf;

use clap::Args;

use super::{Part, Settings};
use crate::quality::Method;

#[derive(Debug, Args)]
#[command(after_help = help())]
pub(in crate::cli) struct CompareArgs {
    /// The motions, BVH files; - is stdin.
    #[arg(value_name = "CLIP.bvh", required = true)]
    pub(in crate::cli) clips: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) part: Part,
    #[command(flatten)]
    pub(in crate::cli) settings: Settings,
    /// How many keys every method chooses, both ends of the clip apart: --keys 8,16,32 [default: as many
    /// as the recipe finds, half and double].
    #[arg(long, value_name = "N,…", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..))]
    pub(in crate::cli) keys: Vec<u32>,
    /// Degrees of noise on every rotation under which keys are chosen once more; 0 for none.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.1)]
    pub(in crate::cli) noise: f64,
    /// Tell how long each method took, which is other on each run.
    #[arg(long)]
    pub(in crate::cli) times: bool,
    /// The table as a CSV file; - is stdout, in place of the one for people.
    #[arg(long, short, value_name = "FILE.csv|-")]
    pub(in crate::cli) out: Option<PathBuf>,
    /// The same as JSON; - is stdout.
    #[arg(long, value_name = "FILE|-")]
    pub(in crate::cli) json: Option<PathBuf>,
}

/// The methods and columns, a line each.
fn help() -> String {
    let paces = Method::PACES.map(|(method, _)| method);
    let lines = Method::ALL.into_iter().chain(paces).map(|method| {
        let (english, japanese) = method.words();
        format!("\n  {method:<15}{english} ({japanese})")
    });
    format!(
        "Methods:{}\n\n\
         Columns:\n  mean, worst    error of the motion made again by slerp from the keys, over all koma and at the\n                 \
         worst: root mean square over the body, in % of its height\n  \
         × mean, worst  the same as a multiple of the least there is for as many keys\n  \
         hits           the share of the moments at which wrists, ankles or head turn furthest in the world, as\n                 \
         many as keys, that have a key within a koma\n  \
         by chance      the same in the mean when the keys are turned round the clip by 1, 2, 3 … koma\n  \
         off            how far the nearest key is from such a moment in the mean, in koma\n  \
         steady         F1, within a koma, of the keys with and without noise on the clip\n\n\
         Examples:\n  genga compare kick.bvh --keys 8,16,32\n  genga compare *.bvh --out methods.csv",
        lines.collect::<String>()
    )
}
