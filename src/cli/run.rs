//! `genga run`: the whole chain, into a folder.

use std::path::PathBuf;

use super::args::RunArgs;
use super::failure::Failure;
use super::words::{Words, counted};
use super::{io, pictures, source};
use crate::deliver::{self, Drawings, Report, Rows};
use crate::pipeline::{Breakdown, Engine};

pub(super) fn run(args: &RunArgs, words: &Words) -> Result<(), Failure> {
    let (recipe, edits) = source::corrected(&args.corrections)?;
    let cut = io::stem(&args.clip.clip);
    let folder = folder(args, &cut)?;
    for name in NAMES {
        io::spare(&args.clip.clip, &folder.join(name))?;
    }
    let working = words.working();
    working.on("reading the motion");
    let source = source::clip(&args.clip)?;
    working.on("finding the key drawings");
    let mut engine = Engine::new(source.clip)?;
    let breakdown = engine.run_once(&recipe, &edits)?;
    working.on("writing");
    let report = Report::of(&breakdown, source.notes.iter().map(ToString::to_string).collect());
    let mut bundle = io::Bundle::begin(&folder)?;
    write(&mut bundle, &cut, &breakdown, &report)?;
    bundle.add("recipe.toml", recipe.write(&edits))?;
    bundle.finish()?;
    drop(working);
    summary(words, &cut, &report);
    let shortfalls = breakdown.omission.shortfalls();
    shortfalls.for_each(|reason| words.say(format_args!("note        {reason}")));
    words.say(format_args!("files       {}: {}", folder.display(), NAMES.join(" ")));
    Ok(())
}

/// The folder that is asked for, or one beside the work with the clip's name.
fn folder(args: &RunArgs, cut: &str) -> Result<PathBuf, Failure> {
    match &args.out {
        None => Ok(PathBuf::from(format!("{cut}-genga"))),
        Some(out) if io::is_stream(out) => Err(Failure::AskedWrongly(
            "--out: run writes a folder of files, not to stdout; genga keys writes a table there"
                .into(),
        )),
        Some(out) => Ok(out.clone()),
    }
}

/// What a run writes.
const NAMES: [&str; 10] = [
    "keys.csv",
    "drawings.csv",
    "sheet.csv",
    "remap.csv",
    "limited.bvh",
    "speed.svg",
    "sheet.svg",
    "poses.svg",
    "recipe.toml",
    "report.json",
];

/// Everything that the breakdown says, one file made after the other.
fn write(
    bundle: &mut io::Bundle<'_>,
    cut: &str,
    breakdown: &Breakdown<'_>,
    report: &Report,
) -> Result<(), Failure> {
    let (clip, sheet) = (breakdown.clip, breakdown.sheet);
    let table = |rows| Drawings { cut: cut.into(), rows }.write(clip, sheet);
    let report = serde_json::to_string_pretty(report)
        .map_err(|error| Failure::CouldNot(format!("report.json: {error}")))?;
    bundle.add("keys.csv", table(Rows::Keys)?)?;
    bundle.add("drawings.csv", table(Rows::All)?)?;
    bundle.add("sheet.csv", deliver::sheet_csv(sheet)?)?;
    bundle.add("remap.csv", deliver::remap_csv(sheet)?)?;
    bundle.add("limited.bvh", deliver::limited_bvh(clip, sheet)?)?;
    bundle.add("speed.svg", pictures::speed(breakdown)?)?;
    bundle.add("sheet.svg", pictures::sheet(breakdown)?)?;
    bundle.add("poses.svg", pictures::poses(breakdown)?)?;
    bundle.add("report.json", report + "\n")
}

fn summary(words: &Words, cut: &str, report: &Report) {
    let Report { frames, joints, frame_rate, seconds, koma, .. } = report;
    words.say(format_args!(
        "{cut}: {frames} frames at {frame_rate} fps, {joints} joints, {seconds:.2} s"
    ));
    report.notes.iter().for_each(|note| words.say(format_args!("note        {note}")));
    words.say(format_args!(
        "genga       原画       {} and both ends, {:.1} a second",
        report.genga, report.genga_per_second
    ));
    if report.genga_over_limit > 0 {
        words.say(format_args!(
            "                       {} more would be worth a drawing (keys.per_second limits them)",
            report.genga_over_limit
        ));
    }
    words.say(format_args!(
        "sheet       シート     {koma} koma, {}, {:.1} a second, longest hold {} koma",
        counted(report.drawings, "drawing"),
        report.drawings_per_second,
        report.longest_hold
    ));
    let omission = &report.omission;
    words.say(format_args!(
        "left out    中無し     {} of {} by naka-nashi, where it is fastest",
        omission.naka_nashi_done, omission.naka_nashi_asked
    ));
    words.say(format_args!(
        "held        コマ撮り   {} of {} by koma-dori, where it is slowest",
        omission.koma_dori_done, omission.koma_dori_asked
    ));
    if report.inbetweens_that_did_not_fit > 0 {
        let count = report.inbetweens_that_did_not_fit;
        words.say(format_args!("note        {count} inbetweens did not fit between their keys"));
    }
}
