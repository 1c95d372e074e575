//! `genga eval`: how good a sheet is.

use super::args::EvalArgs;
use super::failure::Failure;
use super::table::Table;
use super::words::{Words, counted, two};
use super::{io, source};
use crate::deliver::{reference_keys, sheet_json};
use crate::quality::{Evaluation, Off, Slip, Timing};
use crate::time::Frame;

pub(super) fn run(args: &EvalArgs, words: &Words) -> Result<(), Failure> {
    check_files(args)?;
    let of_sheet = |error| Failure::of_file(&io::named(&args.sheet), error);
    let file = sheet_json::read(&io::read(&args.sheet)?).map_err(of_sheet)?;
    let reference = match &args.reference {
        None => None,
        Some(path) => Some(
            reference_keys(&io::read(path)?)
                .map_err(|error| Failure::of_file(&io::named(path), error))?,
        ),
    };
    let read = source::whole(&args.clip, &args.reading)?;
    let (source, notes) = file.fit(read.clip).map_err(of_sheet)?;
    source.check_size().map_err(|error| Failure::of_file(&io::named(&args.clip), error))?;
    let drawn = file.drawn(&source).map_err(of_sheet)?;
    read.warnings.iter().chain(&notes).for_each(|note| words.say(note));
    if drawn.is_some() {
        words.say("the sheet is of an exaggerated motion, and is judged beside that: it is the source here");
    }
    let clip = drawn.as_ref().unwrap_or(&source);
    if let [first, _, ..] = &file.sheet.layers[..] {
        words.say(format_args!(
            "of several layers what is on screen is judged together, keys and pace by the first: {}",
            first.name
        ));
    }
    let outside = |keys: &Vec<_>| keys.iter().filter(|frame| !clip.contains(**frame)).count();
    if let Some(count) = reference.as_ref().map(outside).filter(|count| *count > 0) {
        let keys = counted(count, "reference key");
        let (first, last) = (clip.first(), clip.last());
        words.say(format_args!("{keys} beyond frames {first} to {last} of the sheet do not count"));
    }
    let found = Evaluation::of(clip, &file.sheet, reference.as_deref(), args.tolerance)
        .map_err(of_sheet)?;
    if let Some(path) = &args.json {
        io::write_json(path, &found)?;
    }
    if args.json.as_deref().is_some_and(io::is_stream) {
        return Ok(());
    }
    let ends = [clip.first(), clip.last()];
    io::to_stdout(page(&file.cut, &found, args.tolerance, ends).as_bytes())
}

/// One stdin, and nothing written over what is read.
fn check_files(args: &EvalArgs) -> Result<(), Failure> {
    let sources = || [Some(&args.sheet), Some(&args.clip), args.reference.as_ref()];
    if sources().into_iter().flatten().filter(|path| io::is_stream(path)).count() > 1 {
        let message = "only one of sheet, clip and reference can come from stdin".into();
        return Err(Failure::AskedWrongly(message));
    }
    let named = ["sheet", "motion", "reference"].into_iter().zip(sources());
    for (what, path) in named {
        if let (Some(path), Some(target)) = (path, &args.json) {
            io::spare_the(what, path, target)?;
        }
    }
    Ok(())
}

/// The measures for people.
fn page(cut: &str, found: &Evaluation, tolerance: f64, ends: [Frame; 2]) -> String {
    let pace = &found.pace;
    let (koma, drawings) = (pace.koma, counted(pace.drawings, "drawing"));
    let mut table = Table::default();
    let mut line = |english: &str, japanese: &str, value: String| {
        table.row([english.to_owned(), japanese.to_owned(), value]);
    };
    line(
        "sheet",
        "シート",
        format!(
            "{cut}: {koma} koma, {drawings}, {:.1} a second, {} genga",
            pace.drawings_per_second, pace.genga
        ),
    );
    let holds = pace.holds.iter().map(|(koma, count)| format!("{count} × {koma}"));
    line("exposures", "コマ打ち", holds.collect::<Vec<_>>().join(", ") + " koma");
    line("pops", "飛び", pops(found));
    match &found.timing {
        None => {}
        Some(timing) if timing.reference == 0 => {
            line("reference", "照合", nothing_to_match(ends));
        }
        Some(timing) => {
            line("reference", "照合", matched(timing, tolerance));
            line("", "", shares(timing));
            line("", "", distance(timing));
        }
    }
    format!("{}\n{}", table.text(3), errors(found))
}

/// Errors and slips, with the keys alone and on screen.
fn errors(found: &Evaluation) -> String {
    let mut table = Table::default();
    table.row(["% of body height", "", "error", "worst", "slip", "worst", "in source", "contacts"]);
    table.row(["身長の%", "", "誤差", "最大", "足滑り", "最大", "元の動き", "接地"]);
    let mut row = |english: &str, japanese: &str, off: Off, slip: Slip| {
        let cells = [Some(off.mean), Some(off.worst), slip.mean, slip.worst, slip.source];
        let cells = cells.map(two);
        let names = [english.to_owned(), japanese.to_owned()];
        table.row(names.into_iter().chain(cells).chain([slip.contacts.to_string()]));
    };
    row("keys alone", "原画のみ", found.keys, found.keys_slip);
    row("on screen", "画面", found.shown, found.shown_slip);
    table.text(2)
}

fn pops(found: &Evaluation) -> String {
    let of = format!("{} of {}", found.pops.pops.len(), counted(found.pops.holds, "hold"));
    match found.pops.worst() {
        None => of,
        Some(pop) => {
            let koma = pop.koma + 1;
            format!("{of}, the worst at koma {koma}, {:.1} times the speed round it", pop.times)
        }
    }
}

fn nothing_to_match([first, last]: [Frame; 2]) -> String {
    format!("no key of it stands between the ends, frames {first} and {last}: nothing to match")
}

fn matched(timing: &Timing, tolerance: f64) -> String {
    let Timing { pairs, found, reference, .. } = timing;
    let reference = counted(*reference, "reference key");
    format!("{pairs} of {found} genga and {reference} within {tolerance} koma")
}

fn shares(timing: &Timing) -> String {
    let [precision, recall, f1] = [timing.precision, timing.recall, timing.f1].map(two);
    format!("precision {precision}, recall {recall}, F1 {f1}")
}

fn distance(timing: &Timing) -> String {
    match (timing.mean_off, timing.off_95) {
        (Some(mean), Some(most)) => {
            format!(
                "the nearest genga is {mean:.2} koma off in the mean, 95 % within {most:.2} koma"
            )
        }
        _ => "there is nothing to measure a distance by".into(),
    }
}
