//! The recipe on the command line, and what a person corrects.

use std::path::PathBuf;

use clap::Args;

use super::SeenArgs;
use crate::time::Frame;

/// The recipe: a file, then single settings on top.
#[derive(Debug, Args)]
pub(in crate::cli) struct Settings {
    /// A recipe file; see `genga recipe`.
    #[arg(long, value_name = "R.toml")]
    pub(in crate::cli) recipe: Option<PathBuf>,
    /// One setting, over the recipe: --set spacing.on=3 (may be given again).
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment)]
    pub(in crate::cli) set: Vec<(String, String)>,
}

/// The recipe, and a person's corrections.
#[derive(Debug, Args)]
pub(in crate::cli) struct Corrections {
    #[command(flatten)]
    pub(in crate::cli) settings: Settings,
    #[command(flatten)]
    pub(in crate::cli) layers: LayerArgs,
    #[command(flatten)]
    pub(in crate::cli) seen: SeenArgs,
    /// Frames that are keys whatever is found, with a name and a spacing weight of their own if you like:
    /// --pin 12,150:wrist-top,180@0.5,200:hit@0. Of one layer alone: B/150, with forbid and move as well.
    #[arg(long, value_name = "[LAYER/]FRAME[:NAME][@WEIGHT],…", value_delimiter = ',')]
    pub(in crate::cli) pin: Vec<String>,
    /// Frames near which no key may be found, and ranges without their last frame: --forbid 12,120..140
    #[arg(long, value_name = "FRAME|A..B,…", value_delimiter = ',')]
    pub(in crate::cli) forbid: Vec<String>,
    /// Keys that are found near one frame and drawn at another instead: --move 41:42,80:84:hit@0.2
    #[arg(long = "move", value_name = "FROM:TO[:NAME][@WEIGHT],…", value_delimiter = ',')]
    pub(in crate::cli) moves: Vec<String>,
    /// Drawings, each by the source frame it shows, and for how many koma they stay: --hold 42:4,60:1
    #[arg(long = "hold", value_name = "FRAME:KOMA,…", value_delimiter = ',')]
    pub(in crate::cli) holds: Vec<String>,
    /// Source frames with which actions begin, instead of those that are found (see genga split): --split
    /// 310,774
    #[arg(long, value_name = "FRAME,…", value_delimiter = ',', value_parser = frame)]
    pub(in crate::cli) split: Vec<Frame>,
    /// Keys marked in a file of this clip: the genga of an edited keys.csv, drawings.csv, sheet.csv or
    /// sheet.json, or the numbers on an XDTS timesheet, if any are circled those.
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) pin_from: Option<PathBuf>,
    /// No keys but those that are pinned or moved, and the clip's ends; =false takes back what a recipe says
    /// of it.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    pub(in crate::cli) only_pins: Option<bool>,
    /// The column of that file [default: the only one, or A].
    #[arg(long, value_name = "NAME", requires = "pin_from")]
    pub(in crate::cli) pin_column: Option<String>,
}

/// The cels of the sheet, over the recipe.
#[derive(Debug, Args)]
pub(in crate::cli) struct LayerArgs {
    /// Layers (セル) with keys and timing of their own: body (one), limbs (trunk with head A, arms B and C, legs D and
    /// E), joints (one for each that moves), or a TOML file of [[layers]] with name and joints.
    #[arg(long, value_name = "body|limbs|joints|FILE")]
    pub(in crate::cli) layers: Option<String>,
    /// What carries the body through the room: drawings, or ones, by which a held drawing slides on with the
    /// source (移動を1コマで).
    #[arg(long, value_name = "drawings|ones")]
    pub(in crate::cli) root_on: Option<String>,
}

pub(super) fn frame(text: &str) -> Result<Frame, String> {
    text.trim().parse().map(Frame).map_err(|_| "expected a source frame, as in 310".into())
}

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("expected KEY=VALUE, as in spacing.on=3")?;
    Ok((name.trim().into(), value.trim().into()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_a_number_of_the_file() {
        assert_eq!(frame(" 310").unwrap(), Frame(310));
        for wrong in ["", "-1", "1.5", "10s", "a"] {
            assert!(frame(wrong).unwrap_err().contains("as in 310"), "{wrong}");
        }
    }
}
