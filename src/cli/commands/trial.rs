//! `genga trial`: a blind test for people, and what they answered.

mod told;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::cli::clip::{ClipArgs, OfSheet, Part};
use crate::cli::corrections::Corrections;
use crate::cli::failure::Failure;
use crate::cli::plan::{Plan, PlanArgs, TargetArgs};
use crate::cli::staging::Bundle;
use crate::cli::words::{Words, counted};
use crate::cli::{files, paths};
use crate::deliver::sheet_json::{self, SheetFile};
use crate::motion::Clip;
use crate::plot::{Camera, FigureBody};
use crate::sheet::Sheet;
use crate::trial::{Answer, Bootstrap, Condition, OwnSheet, Take, Trial, Verdict};

const HELP: &str = "\
Conditions:
  source   the capture, a drawing every koma
  twos     a drawing every second koma
  threes   a drawing every third koma
  uniform  as many drawings as genga has, as evenly as whole koma allow: the one that decides
  genga    the sheet of this program
  and each name that --sheet gives

The page shows two films one after the other, never says what they are, and asks two questions apart. It is one file:
send it, or put it on a share. Who answers saves a CSV and hands it back. trial.json, beside it, is what you publish
before anybody answers: conditions, numbers, who counts, and how it is evaluated.

Examples:
  genga trial kick.bvh jump.bvh --out page
  genga trial kick.bvh --sheet hand=by-hand.json --conditions source,genga --out page
  genga trial kick.bvh --drawings-per-second 12 --out page    genga with as many drawings as twos
  genga trial --read answers-*.csv";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct TrialArgs {
    /// The motions, of one action each; BVH or another format that `genga inspect --help` lists.
    #[arg(value_name = "CLIP", required_unless_present = "read")]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    corrections: Corrections,
    #[command(flatten)]
    targets: TargetArgs,
    /// A sheet of your own as one more condition: --sheet hand=by-hand.json; with several clips once for each. It finds its
    /// clip by the name of the file that it was made of.
    #[arg(long, value_name = "NAME=SHEET.json", value_parser = named)]
    sheet: Vec<(String, PathBuf)>,
    /// Which conditions there are besides [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    conditions: Option<Vec<Condition>>,
    /// Pairs that a person is asked of in each question.
    #[arg(long, value_name = "N", default_value_t = Trial::default().pairs)]
    pairs: usize,
    /// From where all films are seen: front, side, three-quarter or auto.
    #[arg(long, value_name = "WORD", default_value_t = Camera::default())]
    camera: Camera,
    /// How figures are drawn: mannequin or sticks.
    #[arg(long, value_name = "WORD", default_value_t = FigureBody::default())]
    body: FigureBody,
    /// The folder for index.html, the page, and trial.json, its plan.
    #[arg(long, short, value_name = "DIR", required_unless_present = "read")]
    out: Option<PathBuf>,
    /// Evaluate answers that people saved.
    #[arg(long, value_name = "ANSWERS.csv", num_args = 1.., conflicts_with_all = ["clips", "out", "sheet", "conditions"])]
    read: Vec<PathBuf>,
    /// Which lots the bootstrap draws.
    #[arg(long, value_name = "N", default_value_t = 0, requires = "read")]
    seed: u64,
    /// The evaluation as JSON; - is stdout, in place of the tables.
    #[arg(long, value_name = "FILE|-", requires = "read")]
    json: Option<PathBuf>,
}

fn named(text: &str) -> Result<(String, PathBuf), String> {
    let (name, path) =
        text.split_once('=').ok_or("expected NAME=SHEET.json, as in hand=by-hand.json")?;
    Ok((name.trim().into(), path.into()))
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
        conditions: args.conditions.clone().unwrap_or(Trial::default().conditions),
        pairs: args.pairs,
        camera: args.camera,
        body: args.body,
    };
    trial.validate()?;
    let names = paths::names(&args.clips);
    let sheets = OwnSheets::read(args)?;
    let ready = args.clips.iter().zip(names).map(|(path, name)| {
        let own = sheets.of(path, args, words)?;
        let clip = ClipArgs { path: path.clone(), part: args.part.clone() };
        let plan = PlanArgs::of(clip, args.corrections.clone(), args.targets.clone());
        sheet_of(&plan, name, own, words)
    });
    let ready: Vec<Ready<'_>> = ready.collect::<Result<_, _>>()?;
    let takes: Vec<Take<'_>> = ready.iter().map(Ready::take).collect();
    let made = trial.files(&takes)?;
    let mut bundle = Bundle::begin(folder)?;
    bundle.add("trial.json", &made.json)?;
    bundle.add("index.html", &made.page)?;
    bundle.finish(Vec::new())?;
    words.say(told::planned(&made.plan));
    let pairs = counted(made.plan.shown(), "pair");
    words.say(format_args!("a person sees {pairs}, catch pairs among them"));
    words.say(format_args!("files       {}: index.html trial.json", folder.display()));
    Ok(())
}

/// The sheet of the program.
fn sheet_of<'a>(
    args: &PlanArgs,
    name: String,
    own: Vec<(&'a str, SheetFile, OfSheet)>,
    words: &Words,
) -> Result<Ready<'a>, Failure> {
    let mut plan = Plan::of(args)?;
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

/// Sheets of a person's own.
struct OwnSheets<'a>(Vec<(&'a str, &'a Path, SheetFile)>);

impl<'a> OwnSheets<'a> {
    fn read(args: &'a TrialArgs) -> Result<Self, Failure> {
        let read = |(name, path): &'a (String, PathBuf)| {
            let file = sheet_json::read(&files::read(path)?).map_err(files::fault_of(path))?;
            let is_of = |clip: &&PathBuf| paths::file_name(clip) == file.clip.file;
            if args.clips.len() > 1 && args.clips.iter().filter(is_of).count() != 1 {
                return Err(Failure::AskedWrongly(format!(
                    "--sheet: {} was made of {}, which is not one of the clips",
                    path.display(),
                    file.clip.file
                )));
            }
            Ok((&name[..], path.as_path(), file))
        };
        args.sheet.iter().map(read).collect::<Result<_, _>>().map(Self)
    }

    /// Those of a clip, by name, with their motion.
    fn of(
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
    let verdict = Verdict::of(answers, bootstrap)?;
    if let Some(path) = &args.json {
        files::write_json(path, &verdict)?;
    }
    if args.json.as_deref().is_some_and(paths::is_stream) {
        return Ok(());
    }
    files::page_to_stdout(&told::verdict(&verdict, args.read.len()))
}
