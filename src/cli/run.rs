//! `genga run`: the whole chain, into a folder.

use std::path::{Path, PathBuf};

use super::args::RunArgs;
use super::asked::{Asked, Written};
use super::failure::Failure;
use super::results::{ALWAYS, OWN, RECIPE, Results};
use super::words::{Words, counted};
use super::{io, pins, seen, source, targets};
use crate::deliver::{LayerReport, Report};
use crate::edits::Edits;
use crate::pipeline::Engine;
use crate::recipe::Recipe;

/// A recipe that is used in its place and is not as genga writes it is somebody's text, with comments that
/// the settings do not hold. A run after an edit is how a recipe is tuned, so it is kept and not refused.
const KEPT: &str = "recipe.toml is the recipe that was given, and stays as it is";

/// The same where the run has more than the file says.
const KEPT_WITHOUT: &str = "recipe.toml is the recipe that was given, in your own writing, and stays as it is: the \
                            corrections and settings that this run adds are not in it; write them there, or \
                            run with --out into another folder, whose recipe.toml then has them";

pub(super) fn run(args: &RunArgs, words: &Words) -> Result<(), Failure> {
    targets::check(&args.targets, &args.corrections)?;
    let (mut recipe, mut edits) = source::corrected(&args.corrections)?;
    let mut asked = Asked::new("deliver", &args.deliver, &ALWAYS, &args.formats)?;
    let name = io::stem(&args.clip.clip);
    let folder = folder(args, &name)?;
    spare(args, &asked, &folder, &name)?;
    let working = words.working();
    working.on("reading the motion");
    let mut source = source::clip(&args.clip)?;
    let (seen_from, notes) = seen::asked(&args.corrections.seen, &source.clip)?;
    recipe.seen_from = seen_from.unwrap_or(recipe.seen_from);
    source.notes.extend(notes);
    working.on("finding the key drawings");
    let mut engine = Engine::new(source.clip)?;
    let marked = pins::marked(&args.corrections, &mut engine, &recipe, &mut edits)?;
    let short = targets::meet(&args.targets, &mut engine, &mut recipe, &edits, words)?;
    let breakdown = engine.run_once(&recipe, &edits)?;
    working.on("writing");
    let unmoved = pins::unmoved(&edits, &breakdown);
    let unheld = pins::unheld(&edits, &breakdown);
    let notes = source.notes.iter().map(ToString::to_string);
    let notes = notes.chain(marked).chain(short).chain(unmoved).chain(unheld);
    let results = Results {
        name: &name,
        clip_file: &io::file_name(&args.clip.clip),
        breakdown: &breakdown,
        recipe: &recipe,
        edits: &edits,
        notes: notes.collect(),
        kept: kept(args, &folder.join(RECIPE), (&recipe, &edits)),
        tell: &|_| {},
    };
    let (report, Written { files, stale }) = results.write(&mut asked, &folder)?;
    drop(working);
    summary(words, &name, &report);
    for layer in breakdown.layers() {
        let of = if report.layers.is_empty() { "" } else { &format!("{}: ", layer.layer.name) };
        let shortfalls = layer.omission.shortfalls();
        shortfalls.for_each(|reason| words.say(format_args!("note        {of}{reason}")));
    }
    stale.iter().for_each(|stale| words.say(format_args!("note        {stale}")));
    words.say(format_args!("files       {}: {}", folder.display(), files.join(" ")));
    Ok(())
}

/// Refuses to write over what is read, and over a sheet that was edited.
fn spare(args: &RunArgs, asked: &Asked, folder: &Path, cut: &str) -> Result<(), Failure> {
    let corrections = &args.corrections;
    let (recipe, bones) = (corrections.settings.recipe.as_deref(), args.formats.bones.as_deref());
    let others = [
        recipe.map(|path| ("recipe", path)),
        bones.map(|path| ("table of bones", path)),
        seen::file(&corrections.seen).map(|path| ("camera", path)),
    ];
    for (what, path) in
        [("motion", &*args.clip.clip)].into_iter().chain(others.into_iter().flatten())
    {
        asked.spare(what, path, folder, cut)?;
        let own = OWN.iter().filter(|file| (what, **file) != ("recipe", RECIPE));
        own.into_iter().try_for_each(|file| io::spare_the(what, path, &folder.join(file)))?;
    }
    pins::spare(corrections, asked, folder, cut)?;
    asked.spare_edited(folder)
}

/// Why the recipe in the folder stays as it is; none where it is to be written, as it is for one that was
/// given but has nothing that would be lost.
fn kept(args: &RunArgs, file: &Path, used: (&Recipe, &Edits)) -> Option<&'static str> {
    let given = args.corrections.settings.recipe.as_deref()?;
    if !io::is_same(given, file) {
        return None;
    }
    let text = String::from_utf8(io::read(file).ok()?).ok()?;
    match Recipe::parse(&text) {
        Ok((recipe, edits)) if recipe.write(&edits) == text => None,
        Ok((recipe, edits)) if (&recipe, &edits) == used => Some(KEPT),
        _ => Some(KEPT_WITHOUT),
    }
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
    if let Some(seen_from) = &report.seen_from {
        words.say(format_args!("seen from   画面       {seen_from}"));
    }
    if report.layers.is_empty() {
        of_body(words, report);
    } else {
        words.say(format_args!("sheet       シート     {koma} koma"));
        report.layers.iter().for_each(|layer| words.say(of_layer(layer)));
    }
    if report.inbetweens_that_did_not_fit > 0 {
        let count = report.inbetweens_that_did_not_fit;
        words.say(format_args!("note        {count} inbetweens did not fit between their keys"));
    }
}

/// A layer in a line.
fn of_layer(layer: &LayerReport) -> String {
    let LayerReport { name, joints, genga, longest_hold, .. } = layer;
    let drawings = counted(layer.drawings, "drawing");
    let first = joints.first().map_or("", String::as_str);
    let others = match joints.len() {
        0 | 1 => String::new(),
        count => format!(" and {} more", count - 1),
    };
    format!(
        "layer       セル       {name}: {genga} genga, {drawings}, {:.1} a second, longest hold {longest_hold} koma \
         ({first}{others})",
        layer.drawings_per_second
    )
}

/// The figures of a sheet of one layer.
fn of_body(words: &Words, report: &Report) {
    let koma = report.koma;
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
    if report.actions.len() > 1 {
        let begins = report.actions[1..].iter().map(|action| action.from.to_string());
        words.say(format_args!(
            "actions     動作       {}, beginning with frames {} and {}",
            report.actions.len(),
            report.first_frame,
            begins.collect::<Vec<_>>().join(" ")
        ));
    }
    let omission = &report.omission;
    words.say(format_args!(
        "left out    中無し     {} of {} by naka-nashi, where it is fastest",
        omission.naka_nashi_done, omission.naka_nashi_asked
    ));
    words.say(format_args!(
        "held        コマ撮り   {} of {} by koma-dori, where it is slowest",
        omission.koma_dori_done, omission.koma_dori_asked
    ));
}
