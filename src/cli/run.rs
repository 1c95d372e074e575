//! `genga run`: the whole chain, into a folder.

use std::path::PathBuf;

use super::args::RunArgs;
use super::asked::Asked;
use super::failure::Failure;
use super::words::{Words, counted};
use super::{io, pictures, pins, source};
use crate::deliver::sheet_json::MadeWith;
use crate::deliver::{Cut, Report};
use crate::pipeline::Engine;

/// What a run writes whether or not it is asked for: formats, and files of its own.
const ALWAYS: [&str; 6] = ["json", "csv", "remap", "bvh", "bars", "poses"];
const OWN: [&str; 3] = ["speed.svg", "recipe.toml", "report.json"];

pub(super) fn run(args: &RunArgs, words: &Words) -> Result<(), Failure> {
    let (recipe, mut edits) = source::corrected(&args.corrections)?;
    let asked = Asked::new("deliver", &args.deliver, &ALWAYS, &args.formats)?;
    let name = io::stem(&args.clip.clip);
    let folder = folder(args, &name)?;
    let own = OWN.map(str::to_owned);
    asked.spare(&args.clip.clip, &folder)?;
    pins::spare(&args.corrections, &args.deliver, &folder, &name)?;
    own.iter().try_for_each(|file| io::spare(&args.clip.clip, &folder.join(file)))?;
    let working = words.working();
    working.on("reading the motion");
    let source = source::clip(&args.clip)?;
    working.on("finding the key drawings");
    let mut engine = Engine::new(source.clip)?;
    let marked = pins::marked(&args.corrections, &mut engine, &recipe, &mut edits)?;
    let breakdown = engine.run_once(&recipe, &edits)?;
    working.on("writing");
    let notes = source.notes.iter().map(ToString::to_string).chain(marked);
    let mut report = Report::of(&breakdown, notes.collect());
    let cut = Cut {
        name: &name,
        clip_file: &io::file_name(&args.clip.clip),
        clip: breakdown.clip,
        sheet: breakdown.sheet,
        spaced: Some(breakdown.spaced),
        made_with: Some(&MadeWith::of(&recipe, &edits)),
    };
    report.notes.extend(asked.notes(&cut)?.iter().map(ToString::to_string));
    let mut bundle = io::Bundle::begin(&folder)?;
    let mut files = asked.write(&cut, &mut bundle)?;
    bundle.add("speed.svg", pictures::speed(&breakdown)?)?;
    bundle.add("recipe.toml", recipe.write(&edits))?;
    bundle.add("report.json", json(&report)?)?;
    bundle.finish()?;
    drop(working);
    summary(words, &name, &report);
    let shortfalls = breakdown.omission.shortfalls();
    shortfalls.for_each(|reason| words.say(format_args!("note        {reason}")));
    files.extend(own);
    words.say(format_args!("files       {}: {}", folder.display(), files.join(" ")));
    Ok(())
}

fn json(report: &Report) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(report)
        .map_err(|error| Failure::CouldNot(format!("report.json: {error}")))?;
    Ok(text + "\n")
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
