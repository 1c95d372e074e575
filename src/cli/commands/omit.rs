//! `genga omit`: the second paper alone, on the clip at 24 drawings a second.

use std::path::PathBuf;

use clap::Args;

use crate::cli::clip::ClipArgs;
use crate::cli::failure::Failure;
use crate::cli::seen::{self, SeenArgs};
use crate::cli::words::{Words, counted};
use crate::cli::{files, paths};
use crate::deliver;
use crate::motion::Screen;
use crate::plot::SsdPlot;
use crate::sheet::Sheet;
use crate::time::KOMA_RATE;
use crate::timing::{Amount, Omission, OmissionReport, Omitted, Order, Stills};

#[derive(Debug, Args)]
pub(super) struct OmitArgs {
    #[command(flatten)]
    clip: ClipArgs,
    #[command(flatten)]
    seen: SeenArgs,
    /// How many of the fastest drawings to leave out: a count (4) or a share of the koma (4%).
    #[arg(long, value_name = "N", default_value = "4")]
    naka_nashi: Amount,
    /// How many of the slowest drawings to hold over: a count (33) or a share of the inbetweens (1/3).
    #[arg(long, value_name = "N|SHARE", default_value = "1/3")]
    koma_dori: Amount,
    /// The longest hold, in koma.
    #[arg(long, value_name = "K", default_value_t = 4)]
    max_hold: usize,
    /// Leave the fastest out all at once, by their first speed (for comparison).
    #[arg(long)]
    all_at_once: bool,
    /// Hold first, leave out after.
    #[arg(long)]
    koma_dori_first: bool,
    /// Let the motion get shorter by what naka-nashi leaves out.
    #[arg(long)]
    let_length_change: bool,
    /// The limited motion, a BVH file at 24 frames a second; - is stdout.
    #[arg(long, short, value_name = "FILE.bvh")]
    out: PathBuf,
    /// The timesheet, a CSV file.
    #[arg(long, value_name = "FILE.csv")]
    sheet: Option<PathBuf>,
    /// The movement into each koma before and after, an SVG, PDF or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

pub(super) fn run(args: &OmitArgs, words: &Words) -> Result<(), Failure> {
    let targets = || args.sheet.iter().chain(&args.plot).chain([&args.out]);
    let sources = [("motion", Some(&*args.clip.path)), ("camera", seen::file(&args.seen))];
    targets().try_for_each(|target| paths::spare(&sources, target))?;
    paths::check_picture("plot", args.plot.as_ref())?;
    paths::distinct(targets())?;
    let source = args.clip.read()?;
    let (seen_from, notes) = seen::asked(&args.seen, &source.clip)?;
    let seen_from = seen_from.unwrap_or_default();
    source.notes.iter().chain(&notes).for_each(|warning| words.warn(warning));
    let clip = source.clip;
    args.clip.budget().check(&clip, KOMA_RATE).map_err(files::fault_of(&args.clip.path))?;
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let ones = Sheet::on_ones(clip.clock(KOMA_RATE), koma);
    let started = std::time::Instant::now();
    let Omitted { layer, report } = {
        let stills = Stills::on(&clip, &ones.layers[0], &Screen::of(seen_from, &clip));
        omission(args).apply(&ones.layers[0], &stills, 1)?
    };
    let took = started.elapsed();
    let sheet = Sheet::new(ones.clock, vec![layer]);
    let motion = deliver::limited_bvh(&clip, &sheet)?;
    if let Some(path) = &args.sheet {
        files::write(path, deliver::sheet_csv(&sheet)?.as_bytes())?;
    }
    if let Some(path) = &args.plot {
        let plot = SsdPlot { seen_from, ..SsdPlot::default() };
        files::write_picture(path, &plot.draw(&clip, &ones, &sheet)?)?;
    }
    files::write(&args.out, motion.as_bytes())?;
    if !seen_from.is_world() {
        words.say(format_args!("seen from   画面       {seen_from}"));
    }
    summary(words, koma, &sheet, &report, took.as_secs_f64());
    Ok(())
}

fn omission(args: &OmitArgs) -> Omission {
    Omission {
        naka_nashi: args.naka_nashi,
        koma_dori: args.koma_dori,
        max_hold: args.max_hold,
        keep_length: !args.let_length_change,
        all_at_once: args.all_at_once,
        order: if args.koma_dori_first { Order::KomaDoriFirst } else { Order::NakaNashiFirst },
        // On ones without genga the others do not count.
        ..Omission::default()
    }
}

fn summary(words: &Words, koma: usize, sheet: &Sheet, report: &OmissionReport, seconds: f64) {
    let layer = &sheet.layers[0];
    let (naka, dori) = (&report.naka_nashi, &report.koma_dori);
    words.say(format_args!("length      尺         {koma} → {} koma", layer.length()));
    words.say(format_args!(
        "naka-nashi  中無し     {} of {} inbetweens left out",
        naka.done, naka.asked
    ));
    words.say(format_args!(
        "koma-dori   コマ撮り   {} of {} inbetweens held over",
        dori.done, dori.asked
    ));
    let (drawings, longest) = (counted(layer.shown().count(), "drawing"), layer.longest_hold());
    words.say(format_args!("sheet       シート     {drawings}, longest hold {longest} koma"));
    words.say(format_args!(
        "time                   {:.3} ms for positions and both stages",
        1e3 * seconds
    ));
    report.shortfalls().for_each(|reason| words.say(format_args!("note        {reason}")));
}
