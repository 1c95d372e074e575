//! `genga run`: runs the whole chain and writes a folder.

mod again;
mod passages;

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use clap::{Arg, ArgAction, Args};

use crate::batch::own_results::spare_batch;
use crate::console::{Words, counted};
use crate::failure::Failure;
use crate::folder::Folder;
use crate::format_args::{FormatArgs, FormatName, Formats, all_made, help, long_help};
use crate::numbers::Numbering;
use crate::plan::{Plan, PlanArgs};
use crate::results::{OWN, Outcome, Results};
use crate::{cut_args, files, found_settings, kept, outcomes, part_of_take, paths, pin_args};
use genga::edits::Edits;
use genga::pipeline::Breakdown;
use genga::recipe::Recipe;
use genga_files::{GaitReport, LayerReport, LoopReport, Report, Run, run_notes};

#[derive(Debug, Args)]
#[command(after_help = help(), after_long_help = long_help(), disable_help_flag = true, arg = help_flag())]
pub(super) struct RunArgs {
    /// Output folder [default: the clip's name with -genga].
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Drop corrections, settings and formats of the run before.
    ///
    /// Those of the same folder stay otherwise, and so do the numbers of drawings. A --recipe has settings of its own, and
    /// corrections if it has any.
    #[arg(long)]
    fresh: bool,
    /// Number the drawings from 1; corrections stay.
    ///
    /// Otherwise drawings that the sheet in the folder has too keep their numbers, and one between 3 and 4 is 3a.
    /// numbers.csv has the old and the new numbers.
    #[arg(long)]
    renumber: bool,
    /// Additional formats to write: --deliver remap,bvh, or all.
    #[arg(long, value_name = "FORMAT,…", value_delimiter = ',', value_parser = FormatName)]
    deliver: Vec<String>,
    #[command(flatten)]
    formats: FormatArgs,
    #[command(flatten)]
    plan: PlanArgs,
}

/// Both `-h` and `--help` print the page that fits on a screen or two.
fn help_flag() -> Arg {
    let help = "Print this; genga help run has every option in full";
    Arg::new("help").short('h').long("help").action(ArgAction::HelpShort).help(help)
}

/// Note when the recipe in the folder is the input and was written by hand: overwriting it would lose comments that the
/// settings do not hold. A run after an edit is how a recipe is tuned, so the file is kept and the run not refused.
const KEPT: &str = "recipe.toml is the recipe that was given, and stays as it is";

/// Most actions whose begins are printed; a long take has hundreds.
const ACTIONS: usize = 8;

/// Note when the recipe is kept although the run has settings that are not in it.
const KEPT_WITHOUT: &str = "recipe.toml is the recipe that was given, in your own writing, and stays as it is: the \
                            corrections and settings that this run adds are not in it; write them there, or \
                            run with --out into another folder, whose recipe.toml then has them";

pub(super) fn run(args: &RunArgs, words: &Words) -> Result<(), Failure> {
    let mut plan = Plan::from_args(&args.plan)?;
    let formats = Formats::new(
        "deliver",
        &args.deliver,
        &Run::FORMATS,
        &args.formats,
        args.plan.clip.part.reading().bones()?.as_ref(),
    )?;
    let clip = &args.plan.clip.path;
    let name = paths::stem(clip);
    paths::check_folder(args.out.as_deref(), "run", "; genga keys writes a table there")?;
    let folder = args.out.clone().unwrap_or_else(|| format!("{name}-genga").into());
    spare(args, &formats, &folder, &name)?;
    spare_batch(&folder)?;

    let (working, mut notes) = (words.working(), Vec::new());
    working.on("reading the motion");
    let (mut engine, of) = plan.read(&mut |warning| {
        words.warn_if_quiet(warning);
        notes.push(warning.to_string());
    })?;
    let place = Folder::look(&folder, args.formats.over());
    place.check(&of)?;
    let (formats, kept_formats) = again::add(formats, args, (&place, &of));
    let recipe = args.plan.corrections.settings.recipe.as_deref().and_then(Path::parent);
    let beside = recipe.filter(|beside| Folder::look(beside, args.formats.over()).is_of(&of));
    let own = place.is_of(&of).then_some(&*folder);
    let part = beside.or(own).and_then(|before| part_of_take::other(before, engine.clip()));
    notes.extend(part.clone());
    notes.extend(plan.of_another(&of));
    let is_again = !args.fresh && place.has_run_of(&of);
    let kept_corrections = match plan.read.is_empty() {
        true if is_again => kept::keep(&mut plan, (&folder, &place.found(&of)), &engine)?,
        false if is_again => kept::left_out(&folder, &plan.edits).into_iter().collect(),
        _ => vec![],
    };
    notes.extend(run_notes::of_cycle(engine.clip(), plan.recipe.r#loop));
    working.on("finding the key drawings");
    plan.settle(&mut engine, words, &mut |note| notes.push(note))
        .map_err(|failure| of_part(failure, part.as_deref()))?;
    let settings_stay = plan.earlier.notes(&plan.recipe);
    let mut found = found_settings::still_in(&plan.recipe, place.found(&of));
    found.extend(plan.found.clone());
    let (Plan { recipe, edits, .. }, fault) = (&plan, plan.fault_of(&engine));
    let breakdown =
        engine.run_once(recipe, edits).map_err(|error| of_part(fault(error), part.as_deref()))?;
    let numbering = match args.fresh {
        true => Numbering::fresh(breakdown.sheet),
        false => Numbering::new(breakdown.sheet, &place, &of, args.renumber),
    };
    let breakdown = breakdown.with_sheet(&numbering.sheet);
    notes.extend(numbering.note.clone());
    notes.extend(run_notes::of_held_inbetween(&breakdown));
    notes.extend(run_notes::of_corrections(edits, &breakdown));

    working.on("writing");
    let results = Results {
        name: &name,
        clip: of,
        breakdown: &breakdown,
        recipe,
        edits,
        found,
        renumbered: &numbering.drawings,
        notes,
        is_own_recipe: given(args, &folder).is_some(),
        sources: sources(args).map(|(_, path)| path).collect(),
        kept: kept(given(args, &folder), (recipe, edits)),
        tell: &|_| Ok(()),
    };
    let Outcome { report, files, unmade, left } = results.write(&formats, place)?;
    drop(working);

    summary(words, &name, &report);
    kept_formats
        .iter()
        .chain(&kept_corrections)
        .chain(&settings_stay)
        .for_each(|line| words.say(format_args!("note        {line}")));
    outcomes::of_corrections(edits, &breakdown)
        .iter()
        .for_each(|line| words.say(format_args!("correction  修正       {line}")));
    numbering.line().iter().for_each(|line| words.say(line));
    cut_args::lines(breakdown.sheet, &name).iter().for_each(|line| words.say(line));
    passages::lines(recipe, &breakdown).iter().for_each(|line| words.say(line));
    shortfalls(words, &report, &breakdown);
    left.notes().iter().for_each(|note| words.say(format_args!("note        {note}")));
    words.say(format_args!("files       {}: {}", folder.display(), files.join(" ")));
    all_made(&unmade)
}

/// Adds to a failure that the run is of another part of the take than the one before, which may be its reason.
fn of_part(failure: Failure, part: Option<&str>) -> Failure {
    match (failure, part) {
        (Failure::AskedWrongly(message), Some(part)) => {
            Failure::AskedWrongly(format!("{message}; {part}"))
        }
        (failure, _) => failure,
    }
}

/// The files that are read, and what each is.
fn sources(args: &RunArgs) -> impl Iterator<Item = (&'static str, &Path)> {
    let (clip, reading) = (&args.plan.clip, args.plan.clip.part.reading());
    let of_motion = [
        ("motion", Some(&*clip.path)),
        ("table of bones", reading.bones.as_deref()),
        ("camera", reading.camera_work.as_deref()),
    ];
    let sources = of_motion.into_iter().chain(args.plan.corrections.sources());
    sources.filter_map(|(what, path)| Some((what, path?)))
}

/// Refuses to overwrite an input or an edited sheet.
fn spare(args: &RunArgs, formats: &Formats, folder: &Path, cut: &str) -> Result<(), Failure> {
    pin_args::spare(&args.plan.corrections, formats, folder, cut)?;
    for (what, path) in sources(args) {
        formats.spare(what, path, folder, cut)?;
        let mut own = OWN.iter().filter(|file| (what, **file) != ("recipe", Run::RECIPE));
        own.try_for_each(|file| paths::spare(&[(what, Some(path))], &folder.join(file)))?;
    }
    formats.spare_edited(folder)
}

/// Path of the `--recipe`, if it names the recipe in the results folder.
fn given<'a>(args: &'a RunArgs, folder: &Path) -> Option<&'a Path> {
    let given = args.plan.corrections.settings.recipe.as_deref()?;
    paths::is_same(given, &folder.join(Run::RECIPE)).then_some(given)
}

/// Reason to keep the folder's recipe unchanged. `None` to write it: there was no `--recipe`, or overwriting it loses
/// no comment.
fn kept(given: Option<&Path>, used: (&Recipe, &Edits)) -> Option<&'static str> {
    let text = String::from_utf8(files::read(given?).ok()?).ok()?;
    match Recipe::parse(&text) {
        // The head of corrections stays when the last of them is deleted.
        Ok((recipe, edits))
            if is_edit_of(&text, &recipe.write(&Edits { only_pins: true, ..edits.clone() })) =>
        {
            None
        }
        Ok((recipe, edits)) if (&recipe, &edits) == used => Some(KEPT),
        _ => Some(KEPT_WITHOUT),
    }
}

/// Whether a recipe is one that genga wrote and a person changed, without comments that would be lost if it was written
/// again.
fn is_edit_of(text: &str, written: &str) -> bool {
    let comments = |text: &str| -> HashSet<String> {
        let comment = |line: &str| Some(line.split_once('#')?.1.trim().to_owned());
        text.lines().filter_map(comment).filter(|comment| !comment.is_empty()).collect()
    };
    text.lines().next() == written.lines().next() && comments(text).is_subset(&comments(written))
}

fn summary(words: &Words, cut: &str, report: &Report) {
    let Report { frames, joints, frame_rate, seconds, koma, .. } = report;
    let joints = counted(*joints, "joint");
    let line = format!("{cut}: {frames} frames at {frame_rate} fps, {joints}, {seconds:.2} s");
    if report.losses.is_empty() {
        words.say(line);
    } else {
        words.lose(format_args!("{line}; warning: {}", report.losses.join("; ")));
    }
    report.notes.iter().for_each(|note| words.say(format_args!("note        {note}")));
    if let Some(line) = drawn(report) {
        words.say(format_args!("drawn       手付け     {line}"));
    }
    if let Some(seen_from) = &report.seen_from {
        words.say(format_args!("seen from   画面       {seen_from}"));
    }
    if let Some(round) = &report.repeat {
        words.say(of_loop(round));
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

/// Share of the motion that counts as drawn, per layer if they differ. `None` for a pure capture.
fn drawn(report: &Report) -> Option<String> {
    let percent = |drawn: f64| format!("{:.0} %", 100.0 * drawn);
    let first = report.drawn;
    let much = if report.layers.iter().all(|layer| layer.drawn == first) {
        (first > 0.0).then(|| percent(first))?
    } else {
        let of_layer = |layer: &LayerReport| format!("{} {}", layer.name, percent(layer.drawn));
        report.layers.iter().map(of_layer).collect::<Vec<_>>().join(", ")
    };
    Some(format!("{much} keyed by hand, so that turns are smoothed less (turns.drawn)"))
}

/// Prints what could not be left out or held as asked.
fn shortfalls(words: &Words, report: &Report, breakdown: &Breakdown<'_>) {
    for layer in breakdown.layers() {
        let of = if report.layers.is_empty() { "" } else { &format!("{}: ", layer.layer.name) };
        let shortfalls = layer.omission.shortfalls();
        shortfalls.for_each(|reason| words.say(format_args!("note        {of}{reason}")));
    }
}

/// Describes a layer in one line.
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

/// Describes the round of a loop in one line.
fn of_loop(round: &LoopReport) -> String {
    let LoopReport { koma, source_koma, rounds, from_frame } = round;
    let (rounds, frame) = (counted(*rounds, "round"), (100.0 * from_frame).round() / 100.0);
    format!(
        "loop        リピート   {koma} koma a round ({source_koma:.2} in the take), {rounds}; drawing 1 shows frame {frame}"
    )
}

/// Describes a gait in one line.
fn of_gait(gait: &GaitReport) -> String {
    let GaitReport { steps, koma, phases } = gait;
    let steps = counted(*steps, "step");
    format!("gait        歩き       {steps} of {koma:.0} koma: {}", phases.join(", "))
}

/// Prints the figures of a sheet with one layer.
fn of_body(words: &Words, report: &Report) {
    let koma = report.koma;
    // A loop has no ends.
    let ends = if report.repeat.is_none() { ", first and last drawing among them" } else { "" };
    words.say(format_args!(
        "genga       原画       {}{ends}, {:.1} a second",
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
        let begins = report.actions.iter().map(|action| action.from.to_string());
        let more = if report.actions.len() > ACTIONS { " …, all in report.json" } else { "" };
        words.say(format_args!(
            "actions     動作       {}, which begin at frames {}{more}",
            report.actions.len(),
            begins.take(ACTIONS).collect::<Vec<_>>().join(", ")
        ));
    }
    report.gaits.iter().for_each(|gait| words.say(of_gait(gait)));
    let omission = &report.omission;
    words.say(format_args!(
        "naka-nashi  中無し     {} of {} inbetweens left out, where it is fastest",
        omission.naka_nashi_done, omission.naka_nashi_asked
    ));
    words.say(format_args!(
        "koma-dori   コマ撮り   {} of {} inbetweens held over, where it is slowest",
        omission.koma_dori_done, omission.koma_dori_asked
    ));
}
