//! `genga eval`: measures the quality of a sheet.

use std::path::PathBuf;

use clap::Args;

use super::study::tolerance;
use crate::clip::Reading;
use crate::console::{Table, Words, counted, two};
use crate::failure::Failure;
use crate::{files, paths, sheets};
use genga::time::Frame;
use genga_files::{reference_keys, sheet_json};
use genga_lab::quality::{Evaluation, Off, Slip, Timing};

#[derive(Debug, Clone, Args)]
#[command(after_help = HELP)]
pub(super) struct EvalArgs {
    /// The sheet: a sheet.json, or a results folder with one; - is stdin.
    #[arg(value_name = "SHEET")]
    sheet: PathBuf,
    /// The motion that the sheet was made of, the whole file.
    #[arg(long, short, value_name = "CLIP")]
    clip: PathBuf,
    /// Reference keys to judge the genga by: a sheet.json or its folder, a table of `genga keys`, a CSV with a column
    /// frame, a list of source frames, one per line, or the keyed frames of an MMD motion (.vmd).
    #[arg(long, value_name = "KEYS")]
    reference: Option<PathBuf>,
    /// Largest distance between a genga and the reference key that it matches, in koma.
    #[arg(long, value_name = "KOMA", allow_negative_numbers = true, default_value_t = 1.0, requires = "reference", value_parser = tolerance)]
    tolerance: f64,
    /// Measures as JSON; - is stdout, in place of the table.
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
    #[command(flatten)]
    reading: Reading,
}

const HELP: &str = "\
Measures:
  keys alone     error of the motion slerped between the genga and both ends of the clip, against the
                 source at each koma: root mean square over joints and tips, weighed by bones, in % of body height
  on screen      the same error, of the drawing that the sheet shows at each koma
  slip           how far a foot moves along the ground while it stands in the source
  in source      the same distance in the source, over the same koma
  pops           steps out of a hold that are 0.8 % or more, and twice as far as the body would move in
                 the time of the hold at its speed within half a second
  precision, recall, F1
                 genga and reference keys that match one to one within --tolerance
  off            distance from a reference key to the nearest genga, in the mean over all reference keys
  Neither genga nor reference keys within the first or the last koma of the clip count in these: both
  ends are always drawn. A reference key that is given twice counts once.

Examples:
  genga run kick.bvh && genga eval kick-genga --clip kick.bvh
  genga eval kick-genga/sheet.json --clip kick.bvh --reference by-hand.csv --json -";

pub(super) fn run(args: &EvalArgs, words: &Words) -> Result<(), Failure> {
    let sheet = sheets::file_of(&args.sheet)?;
    let reference = args.reference.as_deref().map(sheets::file_of).transpose()?;
    let args = &EvalArgs { sheet, reference, ..args.clone() };
    check_files(args)?;
    let of_sheet = files::fault_of(&args.sheet);
    let file = sheet_json::read(&files::read(&args.sheet)?).map_err(&of_sheet)?;
    let motion = args.reading.read_for((&args.sheet, &file), &args.clip, words)?;
    let keys = |path: &PathBuf| {
        reference_keys(&files::read(path)?, &motion.source).map_err(files::fault_of(path))
    };
    let reference = args.reference.as_ref().map(keys).transpose()?;
    if motion.drawn.is_some() {
        words.say("the sheet is of an exaggerated motion, and is judged beside that: it is the source here");
    }
    let clip = motion.clip();
    let notes = Evaluation::notes(clip, &file.sheet, reference.as_deref());
    notes.iter().for_each(|note| words.say(note));
    let found = Evaluation::new(clip, &file.sheet, reference.as_deref(), args.tolerance)
        .map_err(&of_sheet)?;
    if let Some(path) = &args.json {
        files::write_json(path, &found)?;
    }
    if args.json.as_deref().is_some_and(paths::is_stream) {
        return Ok(());
    }
    let ends = [clip.first(), clip.last()];
    files::page_to_stdout(&page(&file.cut, &found, args.tolerance, ends))
}

/// Refuses more than one stdin, and overwriting an input.
fn check_files(args: &EvalArgs) -> Result<(), Failure> {
    let sources = || [Some(&args.sheet), Some(&args.clip), args.reference.as_ref()];
    if sources().into_iter().flatten().filter(|path| paths::is_stream(path)).count() > 1 {
        let message = "only one of sheet, clip and reference can come from stdin".into();
        return Err(Failure::AskedWrongly(message));
    }
    let [sheet, clip, reference] = sources().map(|path| path.map(PathBuf::as_path));
    let named = [("sheet", sheet), ("motion", clip), ("reference", reference)];
    args.json.iter().try_for_each(|target| paths::spare(&named, target))
}

/// Renders the measures for people.
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

/// Renders the table of errors and foot slips, for the keys alone and for the screen.
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
            let times = match pop.times.is_finite() {
                true => format!("{:.1} times the speed round it", pop.times),
                false => "out of stillness".into(),
            };
            format!("{of}, the worst at koma {koma}, {times}")
        }
    }
}

fn nothing_to_match([first, last]: [Frame; 2]) -> String {
    format!("no key of it stands between the ends, frames {first} and {last}: nothing to match")
}

fn matched(timing: &Timing, tolerance: f64) -> String {
    let Timing { pairs, found, reference, .. } = timing;
    let reference = counted(*reference, "reference key");
    format!("{pairs} of {found} genga and {reference} between the ends, within {tolerance} koma")
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
