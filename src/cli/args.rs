//! What can be asked on the command line.

mod compare;
mod eval;
mod split;

use std::path::PathBuf;

use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};

use crate::deliver::FORMATS;
use crate::error::Error;
use crate::plot::Camera;
use crate::study::{Axis, Measure};
use crate::time::{Frame, FrameRate};
use crate::timing::Amount;

pub(super) use compare::CompareArgs;
pub(super) use eval::EvalArgs;
pub(super) use split::SplitArgs;

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

/// The clip, and which part of it.
#[derive(Debug, ClapArgs)]
pub(super) struct ClipArgs {
    /// The motion, a BVH file; - is stdin.
    #[arg(value_name = "CLIP.bvh")]
    pub(super) clip: PathBuf,
    #[command(flatten)]
    pub(super) part: Part,
}

/// Which part of a clip, and how it is read.
#[derive(Debug, Default, ClapArgs)]
pub(super) struct Part {
    /// Keep a T-pose that was put in front of the motion.
    #[arg(long)]
    pub(super) keep_lead_in: bool,
    /// Work on source frames A up to but not including B, numbered from 0 as in the file.
    #[arg(long, value_name = "A..B", value_parser = frames)]
    pub(super) trim: Option<Frames>,
    #[command(flatten)]
    pub(super) reading: Reading,
}

/// How a clip is read.
#[derive(Debug, Default, ClapArgs)]
pub(super) struct Reading {
    /// The frame rate, whatever the file says.
    #[arg(long, value_name = "N", value_parser = rate)]
    pub(super) fps: Option<FrameRate>,
    /// Of several trees of joints only the one whose root has this name.
    #[arg(long, value_name = "NAME")]
    pub(super) root: Option<String>,
    /// Hold the value before a nan or inf, and leave out what is too much in a row; said in a note.
    #[arg(long, conflicts_with = "strict")]
    pub(super) repair: bool,
    /// Refuse a file that has anything to warn of (see inspect --warnings).
    #[arg(long)]
    pub(super) strict: bool,
}

/// The recipe: a file, then single settings on top.
#[derive(Debug, ClapArgs)]
pub(super) struct Settings {
    /// A recipe file; see `genga recipe`.
    #[arg(long, value_name = "R.toml")]
    pub(super) recipe: Option<PathBuf>,
    /// One setting, over the recipe: --set spacing.on=3 (may be given again).
    #[arg(long, value_name = "KEY=VALUE", value_parser = assignment)]
    pub(super) set: Vec<(String, String)>,
}

/// The recipe, and a person's corrections.
#[derive(Debug, ClapArgs)]
pub(super) struct Corrections {
    #[command(flatten)]
    pub(super) settings: Settings,
    #[command(flatten)]
    pub(super) layers: LayerArgs,
    /// Frames that are keys whatever is found, with a name and a spacing weight of their own if you like:
    /// --pin 12,150:wrist-top,180@0.5,200:hit@0. Of one layer alone: B/150, with forbid and move as well.
    #[arg(long, value_name = "[LAYER/]FRAME[:NAME][@WEIGHT],…", value_delimiter = ',')]
    pub(super) pin: Vec<String>,
    /// Frames near which no key may be found, and ranges without their last frame: --forbid 12,120..140
    #[arg(long, value_name = "FRAME|A..B,…", value_delimiter = ',')]
    pub(super) forbid: Vec<String>,
    /// Keys that are found near one frame and drawn at another instead: --move 41:42,80:84:hit@0.2
    #[arg(long = "move", value_name = "FROM:TO[:NAME][@WEIGHT],…", value_delimiter = ',')]
    pub(super) moves: Vec<String>,
    /// Drawings, each by the source frame it shows, and for how many koma they stay: --hold 42:4,60:1
    #[arg(long = "hold", value_name = "FRAME:KOMA,…", value_delimiter = ',')]
    pub(super) holds: Vec<String>,
    /// Source frames with which actions begin, instead of those that are found (see genga split): --split
    /// 310,774
    #[arg(long, value_name = "FRAME,…", value_delimiter = ',', value_parser = frame)]
    pub(super) split: Vec<Frame>,
    /// Keys marked in a file of this clip: the genga of an edited keys.csv, drawings.csv, sheet.csv or
    /// sheet.json, or the numbers on an XDTS timesheet, if any are circled those.
    #[arg(long, value_name = "FILE")]
    pub(super) pin_from: Option<PathBuf>,
    /// No keys but those that are pinned or moved, and the clip's ends; =false takes back what a recipe says
    /// of it.
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    pub(super) only_pins: Option<bool>,
    /// The column of that file [default: the only one, or A].
    #[arg(long, value_name = "NAME", requires = "pin_from")]
    pub(super) pin_column: Option<String>,
}

/// The cels of the sheet, over the recipe.
#[derive(Debug, ClapArgs)]
pub(super) struct LayerArgs {
    /// Layers (セル) with keys and timing of their own: body (one), limbs (trunk with head A, arms B and C, legs D and
    /// E), joints (one for each that moves), or a TOML file of [[layers]] with name and joints.
    #[arg(long, value_name = "body|limbs|joints|FILE")]
    pub(super) layers: Option<String>,
    /// What carries the body through the room: drawings, or ones, by which a held drawing slides on with the
    /// source (移動を1コマで).
    #[arg(long, value_name = "drawings|ones")]
    pub(super) root_on: Option<String>,
}

/// What the sheet is to be, instead of the settings that make it so.
#[derive(Debug, ClapArgs)]
pub(super) struct TargetArgs {
    /// So many genga on the sheet, pins and ends of rests with them, the clip's two ends without; over
    /// keys.min_price and keys.per_second.
    #[arg(long, value_name = "N", value_parser = genga, allow_negative_numbers = true)]
    pub(super) keys: Option<usize>,
    /// Few keys with which the body, slerped from key to key, is nowhere further off than that share
    /// of its height: 5%; over keys.min_price and keys.per_second.
    #[arg(long, value_name = "P%", value_parser = percent, allow_negative_numbers = true, conflicts_with = "keys")]
    pub(super) max_error: Option<f64>,
    /// So many drawings a second: found with koma-dori, then spacing.on, naka-nashi and the number of keys
    /// where that is not asked for.
    #[arg(long, value_name = "X", value_parser = drawings, allow_negative_numbers = true)]
    pub(super) drawings_per_second: Option<f64>,
}

/// What both commands that write formats take.
#[derive(Debug, Default, ClapArgs)]
pub(super) struct FormatArgs {
    /// A BVH with these rows: the formats bvh and bvh-keys by other words.
    #[arg(long, value_name = "ROWS")]
    pub(super) bvh: Option<BvhRows>,
    /// From where the pictures of figures are seen: front, side, three-quarter, or auto, from where most of
    /// the movement is seen.
    #[arg(long, value_name = "CAMERA")]
    pub(super) camera: Option<Camera>,
    /// One setting of a format: --with csv.bom=true (may be given again).
    #[arg(long, value_name = "FORMAT.KEY=VALUE", value_parser = assignment)]
    pub(super) with: Vec<(String, String)>,
    /// For vmd: which of your joints drive which bone, over the table that comes with genga.
    #[arg(long, value_name = "BONES.toml")]
    pub(super) bones: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum BvhRows {
    /// A row a koma, holds repeated: limited.bvh.
    Stepped,
    /// A row a key drawing, a pose library: keys.bvh.
    Keys,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = formats_help())]
pub(super) struct RunArgs {
    #[command(flatten)]
    pub(super) clip: ClipArgs,
    #[command(flatten)]
    pub(super) corrections: Corrections,
    #[command(flatten)]
    pub(super) targets: TargetArgs,
    /// Formats to write besides: --deliver remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',')]
    pub(super) deliver: Vec<String>,
    #[command(flatten)]
    pub(super) formats: FormatArgs,
    /// The folder for the results [default: the clip's name with -genga].
    #[arg(long, short, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
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
#[command(after_help = formats_help())]
pub(super) struct DeliverArgs {
    /// The sheet, a sheet.json; - is stdin.
    #[arg(value_name = "SHEET.json")]
    pub(super) sheet: PathBuf,
    /// The motion it was made of, the whole BVH file.
    #[arg(value_name = "CLIP.bvh")]
    pub(super) clip: PathBuf,
    /// The formats to write: --to remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', required_unless_present = "bvh")]
    pub(super) to: Vec<String>,
    #[command(flatten)]
    pub(super) formats: FormatArgs,
    #[command(flatten)]
    pub(super) reading: Reading,
    /// The folder for the files [default: the one the sheet is in].
    #[arg(long, short, value_name = "DIR")]
    pub(super) out: Option<PathBuf>,
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
#[command(after_help = study_help())]
pub(super) struct StudyArgs {
    /// The motions, BVH files; - is stdin.
    #[arg(value_name = "CLIP.bvh", required = true)]
    pub(super) clips: Vec<PathBuf>,
    #[command(flatten)]
    pub(super) part: Part,
    #[command(flatten)]
    pub(super) settings: Settings,
    /// The setting that is varied and its values, in the recipe of `genga run` [default:
    /// filter.width=10,20,30 in the recipe of Table 1].
    #[arg(long, value_name = "KNOB=VALUES")]
    pub(super) x: Option<Axis>,
    /// Another setting, varied for each value of the first [default: turns.persistence=5,10, and none
    /// with --x].
    #[arg(long, value_name = "KNOB=VALUES")]
    pub(super) y: Option<Axis>,
    /// Filter widths of a Table 1 study, source frames or seconds: --x filter.width=VALUES, but in the
    /// recipe of Table 1.
    #[arg(long, value_name = "VALUES", value_parser = filter_width, conflicts_with = "x")]
    pub(super) filter_width: Option<Axis>,
    /// Persistences of a Table 1 study, source frames or seconds: --y turns.persistence=VALUES, but in
    /// the recipe of Table 1 unless --x is given.
    #[arg(long, value_name = "VALUES", value_parser = persistence, conflicts_with = "y")]
    pub(super) persistence: Option<Axis>,
    /// The filter.
    #[arg(long, value_name = "KIND")]
    pub(super) filter: Option<Filter>,
    /// What is counted [default: union,total,layer_keys; all of the sheet too when a setting of the
    /// sheet is varied].
    #[arg(long, value_name = "MEASURE,…", value_delimiter = ',')]
    pub(super) measure: Vec<Measure>,
    /// Compare the layer's keys of each cell with those of the cells beside it: columns kept (share of
    /// keys), mean_move and largest_move (source frames). Says in which region the keys do not change,
    /// and draws its edge on the map.
    #[arg(long)]
    pub(super) stability: bool,
    /// How far a key may be moved and still be the same, in koma of the sheet.
    #[arg(long, value_name = "KOMA", default_value_t = 1.0, requires = "stability", value_parser = tolerance)]
    pub(super) tolerance: f64,
    /// The table, a CSV file; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    pub(super) out: PathBuf,
    /// A measure as curves over the first setting, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) plot: Option<PathBuf>,
    /// A measure as a map of both settings, its value in each cell, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    pub(super) heat: Option<PathBuf>,
    /// The measure that is drawn [default: the first that is counted; layer_keys with --stability].
    #[arg(long, value_name = "MEASURE")]
    pub(super) show: Option<Measure>,
    /// Draw the paper's own six counts beside, of a clip that is not public.
    #[arg(long, requires = "plot")]
    pub(super) paper: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(super) enum Filter {
    Box,
    Gaussian,
    Ideal,
    Butterworth,
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

/// The formats, a line each.
fn formats_help() -> String {
    let lines = FORMATS.iter().map(|format| {
        let (name, help, japanese) = (format.name, format.help, format.japanese);
        format!("\n  {name:<12}{help} ({japanese}): {}", format.files.join(" "))
    });
    format!("Formats:{}", lines.collect::<String>())
}

/// How axes are written, what can be counted, and three studies to begin with.
fn study_help() -> String {
    let measures = Measure::ALL.map(|measure| {
        let (english, japanese) = measure.words();
        format!("\n  {measure:<21}{english} ({japanese})")
    });
    format!(
        "Axes:\n  KNOB is any setting of `genga recipe`, or noise (degrees of Gaussian noise on every rotation) \
         or\n  noise.seed. VALUES is a list, in which FROM..TO:STEP is a range: both ends are in it when \
         the step\n  lands on them. Units stay: 0.1s..0.5s:0.05s. Without --x and --y the recipe is that of \
         the first\n  paper\u{2019}s Table 1 (`genga recipe --study`), with them it is that of `genga run`.\n\n\
         Measures:{}\n\n\
         Examples:\n  genga study a.bvh --filter-width 5..40:5 --persistence 1..20:1 --heat map.svg\n  \
         genga study a.bvh b.bvh --x keys.per_second=2..6:0.5 --plot curves.svg\n  \
         genga study a.bvh --x noise=0..1:0.1 --y filter.width=0.05s..0.2s:0.05s --stability",
        measures.concat()
    )
}

fn tolerance(text: &str) -> Result<f64, String> {
    let koma = text.parse().ok().filter(|koma: &f64| koma.is_finite() && *koma >= 0.0);
    koma.ok_or_else(|| "expected koma, 0 or more, as in 1 or 0.5".into())
}

fn filter_width(values: &str) -> Result<Axis, Error> {
    Axis::new("filter.width", values)
}

fn persistence(values: &str) -> Result<Axis, Error> {
    Axis::new("turns.persistence", values)
}

/// A half-open range of source frames.
pub(super) type Frames = std::ops::Range<usize>;

/// A share of body height. Without its % a number below 1 might be a fraction.
fn percent(text: &str) -> Result<f64, String> {
    let (number, has_sign) = match text.trim().strip_suffix('%') {
        Some(number) => (number.trim_end(), true),
        None => (text.trim(), false),
    };
    let share: f64 = number
        .parse()
        .map_err(|_| format!("expected a share of body height (5%), found \"{text}\""))?;
    if !has_sign && share > 0.0 && share < 1.0 {
        let hundredfold = (share * 1e8).round() / 1e6;
        return Err(format!(
            "{number} may mean {number}% or {hundredfold}% of the body's height; write the one you mean with its %"
        ));
    }
    Ok(share)
}

fn genga(text: &str) -> Result<usize, String> {
    let wrong =
        || format!("expected a whole number of genga, 0 or more, as in 24, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

fn drawings(text: &str) -> Result<f64, String> {
    let wrong = || format!("expected drawings a second, above 0, as in 8 or 6.5, found \"{text}\"");
    text.trim().parse().map_err(|_| wrong())
}

fn frame(text: &str) -> Result<Frame, String> {
    text.trim().parse().map(Frame).map_err(|_| "expected a source frame, as in 310".into())
}

fn frames(text: &str) -> Result<Frames, String> {
    let number = |text: &str, open: usize| match text.trim() {
        "" => Some(open),
        text => text.parse().ok(),
    };
    let parsed = text
        .split_once("..")
        .and_then(|(begin, end)| Some(number(begin, 0)?..number(end, usize::MAX)?));
    parsed.ok_or_else(|| "expected frame numbers, as in 120..480, 120.. or ..480".into())
}

fn rate(text: &str) -> Result<FrameRate, String> {
    let fps = text.parse().ok().and_then(|fps| FrameRate::new(fps).ok());
    fps.ok_or_else(|| "expected frames a second from 0.001 to 1000000, as in 120 or 29.97".into())
}

fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.split_once('=').ok_or("expected KEY=VALUE, as in spacing.on=3")?;
    Ok((name.trim().into(), value.trim().into()))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_definition_holds() {
        Args::command().debug_assert();
    }

    #[test]
    fn a_rate_is_a_number_of_frames_a_second() {
        assert_eq!(rate("29.97").unwrap().fps(), 29.97);
        for wrong in ["0", "-24", "nan", "inf", "fast", ""] {
            assert!(rate(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_share_of_body_height_has_its_sign_where_it_could_be_a_fraction() {
        for (text, share) in [("5%", 5.0), ("5", 5.0), (" 0.5 % ", 0.5), ("1", 1.0), ("0", 0.0)] {
            assert_eq!(percent(text), Ok(share), "{text}");
        }
        assert!(percent("0.02").unwrap_err().contains("0.02% or 2% of"));
        for wrong in ["2%%", "%", "", "5 %x"] {
            assert!(percent(wrong).unwrap_err().contains("(5%)"), "{wrong}");
        }
    }

    #[test]
    fn a_frame_is_a_number_of_the_file() {
        assert_eq!(frame(" 310").unwrap(), Frame(310));
        for wrong in ["", "-1", "1.5", "10s", "a"] {
            assert!(frame(wrong).unwrap_err().contains("as in 310"), "{wrong}");
        }
    }

    #[test]
    fn a_range_is_two_frames_or_open() {
        assert_eq!(frames("120..480").unwrap(), 120..480);
        assert_eq!(frames("120..").unwrap(), 120..usize::MAX);
        assert_eq!(frames("..480").unwrap(), 0..480);
        for wrong in ["120-480", "a..480", "120..b", "-1..5"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
    }
}
