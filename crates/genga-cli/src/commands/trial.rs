//! `genga trial`: makes a blind test for people, and evaluates their answers.

mod tables;

use std::path::{Path, PathBuf};

use clap::Args;

use super::preview::DRAWINGS;
use crate::clip::{ClipArgs, OfSheet, Part};
use crate::console::{Words, counted};
use crate::corrections::Corrections;
use crate::failure::Failure;
use crate::plan::{Plan, PlanArgs, TargetArgs};
use crate::staging::Bundle;
use crate::{files, paths, sheets};
use genga::motion::Clip;
use genga::sheet::Sheet;
use genga_files::sheet_json::SheetFile;
use genga_plot::{Camera, FigureBody};
use genga_trial::{Answer, Bootstrap, Condition, OwnSheet, Take, Trial, Verdict};

const HELP: &str = "\
Conditions:
  source   the capture, a drawing every koma
  twos     a drawing every second koma
  threes   a drawing every third koma
  uniform  as many drawings as genga, spaced as evenly as whole koma allow: the decisive one
  genga    the sheet of this program
  and each name given with --sheet

The page shows two films one after the other without naming them, and asks two questions separately. It is one file:
send it, or put it on a share. Participants save a CSV and return it. Publish trial.json, which lies beside the page,
before anybody answers: it lists the conditions, the numbers, which persons count, and the evaluation.

Examples:
  genga trial kick.bvh jump.bvh --out page
  genga trial kick.bvh --sheet hand=by-hand.json --conditions source,genga --out page
  genga trial kick.bvh --sheet a=kick-genga --sheet b=kick-ones.xdts --conditions none --out page
  genga trial kick.bvh --drawings-per-second 12 --out page    genga with as many drawings as twos
  genga trial --read answers-*.csv";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct TrialArgs {
    /// Motion files of one action each: BVH, or another format that `genga inspect --help` lists.
    #[arg(value_name = "CLIP", required_unless_present = "read")]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    corrections: Corrections,
    #[command(flatten)]
    targets: TargetArgs,
    /// Add your own sheet as a condition: --sheet hand=by-hand.json; with several clips, once for each. A sheet is a
    /// sheet.json, a results folder, or a timesheet of all drawings (XDTS or TDTS), and belongs to the clip with the
    /// file name that it was made of.
    #[arg(long, value_name = "NAME=SHEET", value_parser = named)]
    sheet: Vec<(String, PathBuf)>,
    /// Other conditions to include, none for your own sheets alone [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = condition)]
    conditions: Option<Vec<Option<Condition>>>,
    /// Number of pairs that a person sees for each question.
    #[arg(long, value_name = "N", allow_negative_numbers = true, default_value_t = Trial::default().pairs)]
    pairs: usize,
    /// Camera of all films: front, side, three-quarter or auto.
    #[arg(long, value_name = "WORD", default_value_t = Camera::default())]
    camera: Camera,
    /// Style of the figures: mannequin or sticks.
    #[arg(long, value_name = "WORD", default_value_t = FigureBody::default())]
    body: FigureBody,
    /// Output folder for the page, index.html, and its plan, trial.json.
    #[arg(long, short, value_name = "DIR", required_unless_present = "read")]
    out: Option<PathBuf>,
    /// Evaluate the answers that people saved.
    #[arg(long, value_name = "ANSWERS.csv", num_args = 1.., conflicts_with_all = ["clips", "out", "sheet", "conditions"])]
    read: Vec<PathBuf>,
    /// Seed of the bootstrap.
    #[arg(
        long,
        value_name = "N",
        allow_negative_numbers = true,
        default_value_t = 0,
        requires = "read"
    )]
    seed: u64,
    /// Evaluation as JSON; - is stdout, in place of the tables.
    #[arg(long, value_name = "FILE|-", requires = "read")]
    json: Option<PathBuf>,
}

fn named(text: &str) -> Result<(String, PathBuf), String> {
    let (name, path) =
        text.split_once('=').ok_or("expected NAME=SHEET, as in hand=by-hand.json")?;
    Ok((name.trim().into(), path.into()))
}

/// Parses the name of a condition; `None` for the word none.
fn condition(text: &str) -> Result<Option<Condition>, String> {
    match text.trim() {
        "none" => Ok(None),
        name => {
            name.parse().map(Some).map_err(|error: String| format!("{error}; none leaves out all"))
        }
    }
}

pub(super) fn run(args: &TrialArgs, words: &Words) -> Result<(), Failure> {
    match &args.out {
        Some(folder) => make(args, folder, words),
        None => read(args),
    }
}

/// A motion with its sheets.
struct Ready<'a> {
    name: String,
    source: Clip,
    drawn: Clip,
    sheet: Sheet,
    own: Vec<(&'a str, SheetFile, OfSheet)>,
}

fn make(args: &TrialArgs, folder: &Path, words: &Words) -> Result<(), Failure> {
    paths::check_folder(Some(folder), "trial", "")?;
    let trial = Trial {
        conditions: match &args.conditions {
            Some(asked) => asked.iter().copied().flatten().collect(),
            None => Trial::default().conditions,
        },
        pairs: args.pairs,
        camera: args.camera,
        body: args.body,
    };
    trial.validate()?;
    let names = paths::names(&args.clips);
    let sheets = OwnSheets::read(args, words)?;
    let ready = args.clips.iter().zip(names).map(|(path, name)| {
        let own = sheets.find(path, args, words)?;
        let clip = ClipArgs { path: path.clone(), part: args.part.clone() };
        let plan = PlanArgs::new(clip, args.corrections.clone(), args.targets.clone());
        sheet_of(&plan, name, own, words)
    });
    let ready: Vec<Ready<'_>> = ready.collect::<Result<_, _>>()?;
    let takes: Vec<Take<'_>> = ready.iter().map(Ready::take).collect();
    let made = trial.files(&takes)?;
    let mut bundle = Bundle::begin(folder)?;
    bundle.add("trial.json", &made.json)?;
    bundle.add("index.html", &made.page)?;
    bundle.finish(Vec::new())?;
    words.say(tables::planned(&made.plan));
    let pairs = counted(made.plan.shown(), "pair");
    words.say(format_args!("a person sees {pairs}, catch pairs among them"));
    words.say(format_args!("files       {}: index.html trial.json", folder.display()));
    Ok(())
}

/// Makes the program's own sheet of a clip.
fn sheet_of<'a>(
    args: &PlanArgs,
    name: String,
    own: Vec<(&'a str, SheetFile, OfSheet)>,
    words: &Words,
) -> Result<Ready<'a>, Failure> {
    let mut plan = Plan::from_args(args)?;
    let say = |line: &dyn std::fmt::Display| words.say(format_args!("{name}: {line}"));
    let (mut engine, _) = plan.read(&mut |warning| words.warn_of(&format!("{name}: "), warning))?;
    plan.settle(&mut engine, words, &mut |note| say(&note))?;
    let made = engine.run(&plan.recipe, &plan.edits).map_err(files::fault_of(args.clip()))?;
    let (source, drawn) = (made.source.clone(), made.clip.clone());
    Ok(Ready { name, source, drawn, sheet: made.sheet.clone(), own })
}

impl Ready<'_> {
    fn take(&self) -> Take<'_> {
        let own = self.own.iter().map(|(name, file, motion)| OwnSheet {
            name,
            drawn: motion.clip(),
            sheet: &file.sheet,
        });
        let Self { name, source, drawn, sheet, .. } = self;
        Take { name, source, drawn, sheet, own: own.collect() }
    }
}

/// Sheets made by a person.
struct OwnSheets<'a>(Vec<(&'a str, PathBuf, SheetFile)>);

impl<'a> OwnSheets<'a> {
    fn read(args: &'a TrialArgs, words: &Words) -> Result<Self, Failure> {
        let read = |(name, path): &'a (String, PathBuf)| {
            let path = sheets::file_of(path)?;
            let file = sheets::read(&path, (None, DRAWINGS), words)?;
            let is_of = |clip: &&PathBuf| paths::file_name(clip) == file.clip.file;
            if args.clips.len() > 1 && args.clips.iter().filter(is_of).count() != 1 {
                return Err(Failure::AskedWrongly(format!(
                    "--sheet: {} was made of {}, which is not one of the clips",
                    path.display(),
                    file.clip.file
                )));
            }
            Ok((&name[..], path, file))
        };
        args.sheet.iter().map(read).collect::<Result<_, _>>().map(Self)
    }

    /// The sheets of a clip, by name, with their motion.
    fn find(
        &self,
        clip: &Path,
        args: &TrialArgs,
        words: &Words,
    ) -> Result<Vec<(&'a str, SheetFile, OfSheet)>, Failure> {
        let is_of =
            |file: &SheetFile| args.clips.len() == 1 || paths::file_name(clip) == file.clip.file;
        let own = self.0.iter().filter(|(_, _, file)| is_of(file)).map(|(name, path, file)| {
            let motion = args.part.reading().read_for((path, file), clip, words)?;
            Ok((*name, file.clone(), motion))
        });
        let mut own: Vec<_> = own.collect::<Result<_, Failure>>()?;
        own.sort_by_key(|(name, ..)| *name);
        Ok(own)
    }
}

fn read(args: &TrialArgs) -> Result<(), Failure> {
    if let Some(target) = &args.json {
        args.read.iter().try_for_each(|path| paths::spare(&[("answers", Some(path))], target))?;
    }
    let mut answers = Vec::new();
    for path in &args.read {
        answers.extend(Answer::read(&files::read(path)?).map_err(files::fault_of(path))?);
    }
    let bootstrap = Bootstrap { seed: args.seed, ..Bootstrap::default() };
    let verdict = Verdict::new(answers, bootstrap)?;
    if let Some(path) = &args.json {
        files::write_json(path, &verdict)?;
    }
    if args.json.as_deref().is_some_and(paths::is_stream) {
        return Ok(());
    }
    files::page_to_stdout(&tables::verdict(&verdict, args.read.len()))
}
