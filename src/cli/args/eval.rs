//! What `genga eval` takes.

use std::path::PathBuf;

use clap::Args;

use super::Reading;
use super::study::tolerance;

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(in crate::cli) struct EvalArgs {
    /// The sheet, a sheet.json; - is stdin.
    #[arg(value_name = "SHEET.json")]
    pub(in crate::cli) sheet: PathBuf,
    /// The motion it was made of, the whole BVH file.
    #[arg(long, short, value_name = "CLIP.bvh")]
    pub(in crate::cli) clip: PathBuf,
    /// Keys of somebody else to judge the genga by: a sheet.json, a table of `genga keys`, a CSV with a
    /// column frame, or a list of source frames, one a line.
    #[arg(long, value_name = "KEYS")]
    pub(in crate::cli) reference: Option<PathBuf>,
    /// How far a genga may be from a key of the reference and still be the same, in koma.
    #[arg(long, value_name = "KOMA", default_value_t = 1.0, requires = "reference", value_parser = tolerance)]
    pub(in crate::cli) tolerance: f64,
    /// The measures as JSON; - is stdout, in place of the table.
    #[arg(long, value_name = "FILE|-")]
    pub(in crate::cli) json: Option<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) reading: Reading,
}

const HELP: &str = "\
Measures:
  keys alone     the motion made again by slerp from the genga and both ends of the clip, beside the
                 source at each koma: root mean square over the body, in % of its height
  on screen      the same of what the sheet shows at each koma
  slip           how far a foot goes along the ground while it stands in the source
  in source      the same in the source itself over the same koma
  pops           steps out of a hold that are twice as far as the speed within half a second gives in
                 the time of the hold, and 1 % or more
  precision, recall, F1
                 genga and keys of the reference that have each other within --tolerance, one to one
  off            how far the nearest genga is from a key of the reference

Examples:
  genga run kick.bvh && genga eval kick-genga/sheet.json --clip kick.bvh
  genga eval kick-genga/sheet.json --clip kick.bvh --reference by-hand.csv --json -";
