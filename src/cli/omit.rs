//! `genga omit`: the second paper alone, on the clip at 24 drawings a second.

use super::args::OmitArgs;
use super::failure::Failure;
use super::words::{Words, counted};
use super::{io, pictures, seen, source};
use crate::deliver;
use crate::motion::Screen;
use crate::sheet::Sheet;
use crate::time::KOMA_RATE;
use crate::timing::{Omission, Omitted, Order, Report, Stills};

pub(super) fn run(args: &OmitArgs, words: &Words) -> Result<(), Failure> {
    for target in args.sheet.iter().chain(&args.plot).chain([&args.out]) {
        io::spare(&args.clip.clip, target)?;
        seen::file(&args.seen).map_or(Ok(()), |camera| io::spare_the("camera", camera, target))?;
    }
    args.plot.iter().try_for_each(|path| pictures::check_name("plot", path))?;
    io::distinct(args.sheet.iter().chain(&args.plot).chain([&args.out]))?;
    let source = source::clip(&args.clip)?;
    let (seen_from, notes) = seen::asked(&args.seen, &source.clip)?;
    let seen_from = seen_from.unwrap_or_default();
    source.notes.iter().chain(&notes).for_each(|note| words.say(note));
    let clip = source.clip;
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
        io::write(path, deliver::sheet_csv(&sheet)?.as_bytes())?;
    }
    if let Some(path) = &args.plot {
        pictures::write_omission(path, &clip, (&ones, &sheet), seen_from)?;
    }
    io::write(&args.out, motion.as_bytes())?;
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
    }
}

fn summary(words: &Words, koma: usize, sheet: &Sheet, report: &Report, seconds: f64) {
    let layer = &sheet.layers[0];
    let (naka, dori) = (&report.naka_nashi, &report.koma_dori);
    words.say(format_args!("length      尺         {koma} → {} koma", layer.length()));
    words.say(format_args!("left out    中無し     {} of {} by naka-nashi", naka.done, naka.asked));
    words.say(format_args!("held        コマ撮り   {} of {} by koma-dori", dori.done, dori.asked));
    let (drawings, longest) = (counted(layer.shown().count(), "drawing"), layer.longest_hold());
    words.say(format_args!("sheet       シート     {drawings}, longest hold {longest} koma"));
    words.say(format_args!(
        "time                   {:.3} ms for positions and both stages",
        1e3 * seconds
    ));
    report.shortfalls().for_each(|reason| words.say(format_args!("note        {reason}")));
}
