//! `genga run`: the whole chain, into a folder.

use std::path::PathBuf;

use super::args::RunArgs;
use super::failure::Failure;
use super::words::{Words, counted};
use super::{io, pictures, source};
use crate::deliver::{self, Drawings, Report, Rows};
use crate::edits::Edits;
use crate::pipeline::{Breakdown, Engine};
use crate::recipe::Recipe;

pub(super) fn run(args: &RunArgs, words: &Words) -> Result<(), Failure> {
    let (recipe, edits) = source::corrected(&args.corrections)?;
    let working = words.working();
    working.on("reading the motion");
    let source = source::clip(&args.clip)?;
    working.on("finding the key drawings");
    let mut engine = Engine::new(source.clip)?;
    let breakdown = engine.run(&recipe, &edits)?;
    working.on("writing");
    let cut = io::stem(&args.clip.clip);
    let folder = folder(args, &cut)?;
    let report = Report::of(&breakdown, source.notes.iter().map(ToString::to_string).collect());
    let files = files(&cut, &breakdown, &recipe, &edits, &report)?;
    io::write_all(&folder, &files)?;
    drop(working);
    summary(words, &cut, &report);
    let shortfalls = breakdown.omission.shortfalls();
    shortfalls.for_each(|reason| words.say(format_args!("note        {reason}")));
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    words.say(format_args!("files       {}: {}", folder.display(), names.join(" ")));
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

/// Every file of a run, made in memory: nothing is written before all of it is known.
fn files(
    cut: &str,
    breakdown: &Breakdown<'_>,
    recipe: &Recipe,
    edits: &Edits,
    report: &Report,
) -> Result<Vec<(&'static str, Vec<u8>)>, Failure> {
    let (clip, sheet) = (breakdown.clip, breakdown.sheet);
    let table = |rows| Drawings { cut: cut.into(), rows }.write(clip, sheet);
    let report = serde_json::to_string_pretty(report)
        .map_err(|error| Failure::CouldNot(format!("report.json: {error}")))?;
    Ok(vec![
        ("keys.csv", table(Rows::Keys)?.into()),
        ("drawings.csv", table(Rows::All)?.into()),
        ("sheet.csv", deliver::sheet_csv(sheet)?.into()),
        ("remap.csv", deliver::remap_csv(sheet)?.into()),
        ("limited.bvh", deliver::limited_bvh(clip, sheet)?.into()),
        ("speed.svg", pictures::speed(breakdown)?.into()),
        ("sheet.svg", pictures::sheet(breakdown)?.into()),
        ("poses.svg", pictures::poses(breakdown)?.into()),
        ("recipe.toml", recipe.write(edits).into()),
        ("report.json", (report + "\n").into()),
    ])
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
