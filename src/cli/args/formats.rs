//! The formats on the command line.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::corrections::assignment;
use super::{ClipArgs, Corrections, Reading, TargetArgs};
use crate::deliver::FORMATS;
use crate::plot::Camera;

/// What both commands that write formats take.
#[derive(Debug, Default, Args)]
pub(in crate::cli) struct FormatArgs {
    /// A BVH with these rows: the formats bvh and bvh-keys by other words.
    #[arg(long, value_name = "ROWS")]
    pub(in crate::cli) bvh: Option<BvhRows>,
    /// From where the pictures of figures are seen: front, side, three-quarter, or auto, from where most of
    /// the movement is seen.
    #[arg(long, value_name = "CAMERA")]
    pub(in crate::cli) camera: Option<Camera>,
    /// One setting of a format: --with csv.bom=true (may be given again).
    #[arg(long, value_name = "FORMAT.KEY=VALUE", value_parser = assignment)]
    pub(in crate::cli) with: Vec<(String, String)>,
    /// For vmd: which of your joints drive which bone, over the table that comes with genga.
    #[arg(long, value_name = "BONES.toml")]
    pub(in crate::cli) bones: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(in crate::cli) enum BvhRows {
    /// A row a koma, holds repeated: limited.bvh.
    Stepped,
    /// A row a key drawing, a pose library: keys.bvh.
    Keys,
}

#[derive(Debug, Args)]
#[command(after_help = formats_help())]
pub(in crate::cli) struct RunArgs {
    #[command(flatten)]
    pub(in crate::cli) clip: ClipArgs,
    #[command(flatten)]
    pub(in crate::cli) corrections: Corrections,
    #[command(flatten)]
    pub(in crate::cli) targets: TargetArgs,
    /// Formats to write besides: --deliver remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',')]
    pub(in crate::cli) deliver: Vec<String>,
    #[command(flatten)]
    pub(in crate::cli) formats: FormatArgs,
    /// The folder for the results [default: the clip's name with -genga].
    #[arg(long, short, value_name = "DIR")]
    pub(in crate::cli) out: Option<PathBuf>,
}

#[derive(Debug, Args)]
#[command(after_help = formats_help())]
pub(in crate::cli) struct DeliverArgs {
    /// The sheet, a sheet.json; - is stdin.
    #[arg(value_name = "SHEET.json")]
    pub(in crate::cli) sheet: PathBuf,
    /// The motion it was made of, the whole BVH file.
    #[arg(value_name = "CLIP.bvh")]
    pub(in crate::cli) clip: PathBuf,
    /// The formats to write: --to remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', required_unless_present = "bvh")]
    pub(in crate::cli) to: Vec<String>,
    #[command(flatten)]
    pub(in crate::cli) formats: FormatArgs,
    #[command(flatten)]
    pub(in crate::cli) reading: Reading,
    /// The folder for the files [default: the one the sheet is in].
    #[arg(long, short, value_name = "DIR")]
    pub(in crate::cli) out: Option<PathBuf>,
}

/// The formats, a line each.
fn formats_help() -> String {
    let lines = FORMATS.iter().map(|format| {
        let (name, help, japanese) = (format.name, format.help, format.japanese);
        format!("\n  {name:<12}{help} ({japanese}): {}", format.files.join(" "))
    });
    format!("Formats:{}", lines.collect::<String>())
}
