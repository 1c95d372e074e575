//! What `genga study` takes.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{Part, Settings};
use crate::error::Error;
use crate::study::{Axis, Measure};

#[derive(Debug, Args)]
#[command(after_help = study_help())]
pub(in crate::cli) struct StudyArgs {
    /// The motions, BVH files; - is stdin.
    #[arg(value_name = "CLIP.bvh", required = true)]
    pub(in crate::cli) clips: Vec<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) part: Part,
    #[command(flatten)]
    pub(in crate::cli) settings: Settings,
    /// The setting that is varied and its values, in the recipe of `genga run` [default:
    /// filter.width=10,20,30 in the recipe of Table 1].
    #[arg(long, value_name = "KNOB=VALUES")]
    pub(in crate::cli) x: Option<Axis>,
    /// Another setting, varied for each value of the first [default: turns.persistence=5,10, and none
    /// with --x].
    #[arg(long, value_name = "KNOB=VALUES")]
    pub(in crate::cli) y: Option<Axis>,
    /// Filter widths of a Table 1 study, source frames or seconds: --x filter.width=VALUES, but in the
    /// recipe of Table 1.
    #[arg(long, value_name = "VALUES", value_parser = filter_width, conflicts_with = "x")]
    pub(in crate::cli) filter_width: Option<Axis>,
    /// Persistences of a Table 1 study, source frames or seconds: --y turns.persistence=VALUES, but in
    /// the recipe of Table 1 unless --x is given.
    #[arg(long, value_name = "VALUES", value_parser = persistence, conflicts_with = "y")]
    pub(in crate::cli) persistence: Option<Axis>,
    /// The filter.
    #[arg(long, value_name = "KIND")]
    pub(in crate::cli) filter: Option<Filter>,
    /// What is counted [default: turns,genga,fills,union,total; all of the sheet too when a setting of the
    /// sheet is varied].
    #[arg(long, value_name = "MEASURE,…", value_delimiter = ',')]
    pub(in crate::cli) measure: Vec<Measure>,
    /// Compare the layer's keys of each cell with those of the cells beside it: columns kept (share of
    /// keys), mean_move and largest_move (source frames). Says in which region the keys do not change,
    /// and draws its edge on the map.
    #[arg(long)]
    pub(in crate::cli) stability: bool,
    /// How far a key may be moved and still be the same, in koma of the sheet.
    #[arg(long, value_name = "KOMA", default_value_t = 1.0, requires = "stability", value_parser = tolerance)]
    pub(in crate::cli) tolerance: f64,
    /// The table, a CSV file; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    pub(in crate::cli) out: PathBuf,
    /// A measure as curves over the first setting, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    pub(in crate::cli) plot: Option<PathBuf>,
    /// A measure as a map of both settings, its value in each cell, an SVG or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    pub(in crate::cli) heat: Option<PathBuf>,
    /// The measure that is drawn [default: the first that is counted; genga with --stability].
    #[arg(long, value_name = "MEASURE")]
    pub(in crate::cli) show: Option<Measure>,
    /// Draw the paper's own six counts beside, of a clip that is not public.
    #[arg(long, requires = "plot")]
    pub(in crate::cli) paper: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(in crate::cli) enum Filter {
    Box,
    Gaussian,
    Ideal,
    Butterworth,
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

pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let koma = text.parse().ok().filter(|koma: &f64| koma.is_finite() && *koma >= 0.0);
    koma.ok_or_else(|| "expected koma, 0 or more, as in 1 or 0.5".into())
}

fn filter_width(values: &str) -> Result<Axis, Error> {
    Axis::new("filter.width", values)
}

fn persistence(values: &str) -> Result<Axis, Error> {
    Axis::new("turns.persistence", values)
}
