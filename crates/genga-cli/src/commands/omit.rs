//! `genga omit`: applies the second paper's omission alone, to the clip at 24 drawings a second.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::camera_args::{self, SeenArgs};
use crate::clip::Part;
use crate::console::{Words, counted};
use crate::failure::Failure;
use crate::several::Several;
use crate::{files, paths};

use genga::motion::Screen;
use genga::sheet::Sheet;
use genga::time::KOMA_RATE;
use genga::timing::{Amount, Omission, OmissionReport, Omitted, Order, Stills};
use genga_files::OmissionRow;
use genga_plot::SsdPlot;

#[derive(Debug, Args)]
pub(super) struct OmitArgs {
    /// Motion files; - is stdin. Of several there is only the table.
    #[arg(value_name = "CLIP", required = true)]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    seen: SeenArgs,
    /// Number of the fastest drawings to leave out: a count (4) or a share of the koma (4%), by which at most 6 go. The
    /// second paper: 4, and 6 for the swing.
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value = "4")]
    naka_nashi: Amount,
    /// Number of the slowest drawings to replace by holds: a count (33) or a share of the inbetweens (1/3). The
    /// second paper: 33 for the pitch, 30 for the kick, 29 for tennis, 40 for the swing.
    #[arg(long, value_name = "N|SHARE", allow_negative_numbers = true, default_value = "1/3")]
    koma_dori: Amount,
    /// Longest hold, in koma.
    #[arg(long, value_name = "K", allow_negative_numbers = true, default_value_t = 4)]
    max_hold: usize,
    /// Leave the fastest drawings out all at once, by their initial speed (for comparison).
    #[arg(long)]
    all_at_once: bool,
    /// Apply koma-dori before naka-nashi.
    #[arg(long)]
    koma_dori_first: bool,
    /// Let naka-nashi shorten the motion by the drawings it leaves out.
    #[arg(long)]
    let_length_change: bool,
    /// Limited motion as a BVH file at 24 frames per second; - is stdout.
    #[arg(long, short, value_name = "FILE.bvh")]
    out: Option<PathBuf>,
    /// Print a row of the second paper's Table 1 for each clip as CSV, or write them to a file (--table=FILE.csv): frames at 24 per
    /// second, left-out ones (N_io), held ones (N_hf), and the time in milliseconds, which differs from run to run.
    /// N_io counts the koma that were cut, each of which lengthens another drawing. The koma so given can be cut
    /// again, so that a high N_io is more than the drawings that are gone.
    #[arg(long, value_name = "FILE.csv", num_args = 0..=1, require_equals = true, default_missing_value = "-")]
    table: Option<PathBuf>,
    /// Timesheet as a CSV file.
    #[arg(long, value_name = "FILE.csv")]
    sheet: Option<PathBuf>,
    #[arg(long, value_name = "FILE.svg", help = paths::picture_help("Draw the movement into each koma, before and after omission"))]
    plot: Option<PathBuf>,
}

pub(super) fn run(args: &OmitArgs, words: &Words) -> Result<(), Failure> {
    check_files(args)?;
    let mut rows = Vec::with_capacity(args.clips.len());
    let mut several = Several::new(args.clips.len(), words);
    for (name, path) in paths::names(&args.clips).into_iter().zip(&args.clips) {
        if args.clips.len() > 1 {
            words.say(format_args!("clip        動き       {name}"));
        }
        rows.extend(several.keep(path, one(args, (name, path), words))?);
    }
    if let Some(path) = &args.table {
        files::write(path, genga_files::omission_csv(&rows)?.as_bytes())?;
    }
    several.end()
}

/// Refuses to write nothing, to overwrite an input, and to write one file of several clips.
fn check_files(args: &OmitArgs) -> Result<(), Failure> {
    let of_one = || args.sheet.iter().chain(&args.plot).chain(&args.out);
    if args.clips.len() > 1 && of_one().next().is_some() {
        let message = "of several clips there is only --table; name one clip for other files";
        return Err(Failure::AskedWrongly(message.into()));
    }
    let targets = || of_one().chain(&args.table);
    if targets().next().is_none() {
        let message = "give one of --out, --table, --sheet, --plot (of several clips: --table)";
        return Err(Failure::AskedWrongly(message.into()));
    }
    let clips = args.clips.iter().map(|clip| ("motion", Some(&**clip)));
    let sources: Vec<_> = clips.chain([("camera", camera_args::file(&args.seen))]).collect();
    targets().try_for_each(|target| paths::spare(&sources, target))?;
    paths::check_picture("plot", args.plot.as_ref())?;
    paths::distinct(targets())
}

/// Applies the omission to a clip, and writes its own files. Returns its row of the table.
fn one(
    args: &OmitArgs,
    (name, path): (String, &Path),
    words: &Words,
) -> Result<OmissionRow, Failure> {
    let source = args.part.read(path)?;
    let (seen_from, notes) = camera_args::asked(&args.seen, &source.clip)?;
    let seen_from = seen_from.unwrap_or_default();
    source.notes.iter().chain(&notes).for_each(|warning| words.warn(warning));
    let clip = source.clip;
    args.part.budget().check(&clip, KOMA_RATE).map_err(files::fault_of(path))?;
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let ones = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let started = std::time::Instant::now();
    let Omitted { layer, report } = {
        let stills = Stills::on(&clip, &ones.layers[0], &Screen::new(seen_from, &clip));
        omission(args).apply(&ones.layers[0], &stills, 1)?
    };
    let seconds = started.elapsed().as_secs_f64();
    let sheet = Sheet::new(ones.clock, vec![layer]);
    let motion = genga_files::limited_bvh(&clip, &sheet)?;
    if let Some(path) = &args.sheet {
        files::write(path, genga_files::sheet_csv(&sheet)?.as_bytes())?;
    }
    if let Some(path) = &args.plot {
        let plot = SsdPlot { seen_from, ..SsdPlot::default() };
        files::write_picture(path, &plot.draw(&clip, &ones, &sheet)?, words)?;
    }
    if let Some(path) = &args.out {
        files::write(path, motion.as_bytes())?;
    }
    if !seen_from.is_world() {
        words.say(format_args!("seen from   画面       {seen_from}"));
    }
    summary(words, koma, &sheet, &report, seconds);
    let capped = omission(args).capped(koma);
    capped.iter().for_each(|note| words.say(format_args!("note        {note}")));
    let (n_io, n_hf) = (report.naka_nashi.done, report.koma_dori.done);
    Ok(OmissionRow { clip: name, frames: koma, n_io, n_hf, seconds })
}

fn omission(args: &OmitArgs) -> Omission {
    Omission {
        naka_nashi: args.naka_nashi,
        koma_dori: args.koma_dori,
        max_hold: args.max_hold,
        keep_length: !args.let_length_change,
        all_at_once: args.all_at_once,
        order: if args.koma_dori_first { Order::KomaDoriFirst } else { Order::NakaNashiFirst },
        // The remaining settings do not matter on ones without genga.
        ..Omission::default()
    }
}

fn summary(words: &Words, koma: usize, sheet: &Sheet, report: &OmissionReport, seconds: f64) {
    let layer = &sheet.layers[0];
    let (naka, dori) = (&report.naka_nashi, &report.koma_dori);
    words.say(format_args!("length      尺         {koma} → {} koma", layer.length()));
    words.say(format_args!("naka-nashi  中無し     {} of {} koma left out", naka.done, naka.asked));
    words
        .say(format_args!("koma-dori   コマ撮り   {} of {} koma held over", dori.done, dori.asked));
    let (drawings, longest) = (counted(layer.shown().count(), "drawing"), layer.longest_hold());
    words.say(format_args!("sheet       シート     {drawings}, longest hold {longest} koma"));
    words.say(format_args!(
        "time                   {:.3} ms for positions and both stages",
        1e3 * seconds
    ));
    report.shortfalls().for_each(|reason| words.say(format_args!("note        {reason}")));
}
