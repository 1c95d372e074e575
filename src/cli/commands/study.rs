//! `genga study`: what is found when one or two settings vary.

mod caption;

use std::path::PathBuf;
use std::slice::from_ref;

use clap::Args;
use clap::builder::PossibleValuesParser;
use rayon::prelude::*;

use crate::cli::clip::Part;
use crate::cli::corrections::Settings;
use crate::cli::failure::Failure;
use crate::cli::words::{Words, counted};
use crate::cli::{files, paths};
use crate::deliver;
use crate::error::Error;
use crate::motion::Clip;
use crate::plot::{HeatMap, StudyPlot};
use crate::recipe::{Kind, Knob, Recipe};
use crate::study::{self, Axis, Grid, Measure, Plateau, Study};

/// Sections of the recipe that change the sheet and not the keys.
const OF_THE_SHEET: [&str; 2] = ["spacing", "omission"];

/// The kinds of filter.
fn filters() -> PossibleValuesParser {
    let kind = Knob::find("filter.kind").map(|knob| knob.kind);
    let words: &[&str] = if let Ok(Kind::Choice(words)) = kind { words } else { &[] };
    PossibleValuesParser::new(words)
}

#[derive(Debug, Args)]
#[command(after_help = study_help())]
pub(super) struct StudyArgs {
    /// The motions; - is stdin.
    #[arg(value_name = "CLIP", required = true)]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    settings: Settings,
    /// The setting that is varied and its values, in the recipe of `genga run` [default:
    /// filter.width=10,20,30 in the recipe of Table 1].
    #[arg(long, value_name = "KNOB=VALUES")]
    x: Option<Axis>,
    /// Another setting, varied for each value of the first [default: turns.persistence=5,10, and none
    /// with --x].
    #[arg(long, value_name = "KNOB=VALUES")]
    y: Option<Axis>,
    /// Filter widths of a Table 1 study, source frames or seconds: --x filter.width=VALUES, but in the
    /// recipe of Table 1.
    #[arg(long, value_name = "VALUES", value_parser = filter_width, conflicts_with = "x")]
    filter_width: Option<Axis>,
    /// Persistences of a Table 1 study, source frames or seconds: --y turns.persistence=VALUES, but in
    /// the recipe of Table 1 unless --x is given.
    #[arg(long, value_name = "VALUES", value_parser = persistence, conflicts_with = "y")]
    persistence: Option<Axis>,
    /// The filter.
    #[arg(long, value_name = "KIND", value_parser = filters())]
    filter: Option<String>,
    /// What is counted [default: turns,genga,fills,union,total; all of the sheet too when a setting of the
    /// sheet is varied].
    #[arg(long, value_name = "MEASURE,…", value_delimiter = ',')]
    measure: Vec<Measure>,
    /// Compare the layer's keys of each cell with those of the cells beside it: columns kept (share of
    /// keys), mean_move and largest_move (source frames). Says in which region the keys do not change,
    /// and draws its edge on the map.
    #[arg(long)]
    stability: bool,
    /// How far a key may be moved and still be the same, in koma of the sheet.
    #[arg(long, value_name = "KOMA", default_value_t = 1.0, requires = "stability", value_parser = tolerance)]
    tolerance: f64,
    /// The table, a CSV file; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    out: PathBuf,
    /// A measure as curves over the first setting, an SVG, PDF or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// A measure as a map of both settings, its value in each cell, an SVG, PDF or PNG file.
    #[arg(long, value_name = "FILE.svg")]
    heat: Option<PathBuf>,
    /// What stands below the pictures on paper: what they show, of which clips, with the recipe and the
    /// command that make them again, a Markdown file.
    #[arg(long, value_name = "FILE.md")]
    caption: Option<PathBuf>,
    /// The measure that is drawn [default: the first that is counted; genga with --stability or a
    /// setting of keys, drawings with one of the sheet, union with --paper].
    #[arg(long, value_name = "MEASURE")]
    show: Option<Measure>,
    /// Draw a count as that of a second of its clip, so that clips of other lengths compare; the table keeps
    /// the counts.
    #[arg(long)]
    per_second: bool,
    /// Draw the paper's own six counts beside, of a clip that is not public.
    #[arg(long, requires = "plot")]
    paper: bool,
}

impl StudyArgs {
    /// The measure that is to be drawn, where it is said.
    fn shown(&self) -> Option<Measure> {
        self.show.or(self.paper.then_some(Measure::Union))
    }
}

/// How axes are written, what can be counted, and three studies to begin with.
fn study_help() -> String {
    let measures = Measure::ALL.map(|measure| {
        let (english, japanese) = measure.words();
        format!("\n  {measure:<21}{english} ({japanese})")
    });
    format!(
        "Axes:\n  KNOB is any setting of `genga recipe`, or noise (degrees of Gaussian noise on every rotation) \
         or\n  noise.seed. VALUES is a list, in which FROM..TO:STEP is a range: both ends are in it when \
         the step\n  lands on them. Units stay: 0.1s..0.5s:0.05s. Without --x and --y the recipe is that of \
         the first\n  paper\u{2019}s Table 1 (`genga recipe --study`), with them it is that of `genga run`.\n\n\
         Measures:{}\n\n\
         Examples:\n  genga study a.bvh --filter-width 5..40:5 --persistence 1..20:1 --heat map.svg\n  \
         genga study a.bvh b.bvh --x keys.min_price=2..20:2 --plot curves.pdf\n  \
         genga study a.bvh --x noise=0..1:0.1 --y filter.width=0.05s..0.2s:0.05s --stability",
        measures.concat()
    )
}

pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let koma = text.parse().ok().filter(|koma: &f64| koma.is_finite() && *koma >= 0.0);
    koma.ok_or_else(|| "expected koma, 0 or more, as in 1 or 0.5".into())
}

fn filter_width(values: &str) -> Result<Axis, Error> {
    Axis::new("filter.width", values)
}

fn persistence(values: &str) -> Result<Axis, Error> {
    Axis::new("turns.persistence", values)
}

pub(super) fn run(args: &StudyArgs, words: &Words) -> Result<(), Failure> {
    let targets = || args.plot.iter().chain(&args.heat).chain(&args.caption).chain([&args.out]);
    for clip in &args.clips {
        targets().try_for_each(|target| paths::spare(&[("motion", Some(clip))], target))?;
    }
    paths::distinct(targets())?;
    paths::check_picture("plot", args.plot.as_ref())?;
    paths::check_picture("heat", args.heat.as_ref())?;
    caption::check(args)?;
    let study = asked(args)?;
    let show = args.shown().unwrap_or_else(|| usually_shown(&study));
    let (paper, per_second) = (args.paper, args.per_second);
    let plot = StudyPlot { show, per_second, paper, ..StudyPlot::default() };
    let heat = HeatMap { show, per_second };
    // What cannot be drawn is refused before the work.
    plot.fits(&study.x, study.y.as_ref())?;
    if args.heat.is_some() {
        HeatMap::fits(&study.x, study.y.as_ref())?;
    }
    let clips = args.part.read_all(&args.clips, words)?;
    let grids = swept(&study, clips, &args.clips, words)?;
    let names = paths::names(&args.clips);
    let tolerance = args.stability.then_some(args.tolerance);
    let plateaus = tolerance.map(|koma| Plateaus::of(&grids, koma));
    if let Some(path) = &args.plot {
        files::write_picture(path, &plot.draw(&names, &grids)?)?;
    }
    if let Some(path) = &args.heat {
        let edges = plateaus.as_ref().map(|plateaus| &plateaus.found);
        files::write_picture(path, &heat.draw(&names, &grids, edges)?)?;
    }
    if let Some(path) = &args.caption {
        let drawn = caption::Drawn {
            show,
            per_second,
            paper,
            curves: args.plot.is_some(),
            map: args.heat.is_some(),
        };
        files::write(path, drawn.caption(&study, &names, &grids).as_bytes())?;
    }
    files::write(&args.out, deliver::study_csv(&names, &grids, tolerance)?.as_bytes())?;
    if let Some(plateaus) = plateaus {
        say_plateaus(words, &names, &grids, &plateaus);
    }
    let files = targets().filter(|path| !paths::is_stream(path));
    let files: Vec<String> = files.map(|path| path.display().to_string()).collect();
    if !files.is_empty() {
        words.say(format_args!("files       {}", files.join(" ")));
    }
    Ok(())
}

/// Where the keys of some clips are the very same, and where they are nearly so.
struct Plateaus {
    koma: [f64; 2],
    found: [Option<Plateau>; 2],
}

impl Plateaus {
    fn of(grids: &[Grid], koma: f64) -> Self {
        let koma = [0.0, koma];
        Self { koma, found: koma.map(|koma| Plateau::largest(grids, koma)) }
    }

    fn say(&self, words: &Words, name: &str, grid: &Grid) {
        for (koma, plateau) in self.koma.iter().zip(&self.found) {
            words.say(format_args!("{name}: {}", sentence(grid, *koma, plateau.as_ref())));
        }
    }
}

/// Where the keys do not change, of each clip and of all together.
fn say_plateaus(words: &Words, names: &[String], grids: &[Grid], of_all: &Plateaus) {
    words.say("plateau  変わらない範囲");
    if let ([name], [grid]) = (names, grids) {
        return of_all.say(words, name, grid);
    }
    for (name, grid) in names.iter().zip(grids) {
        Plateaus::of(from_ref(grid), of_all.koma[1]).say(words, name, grid);
    }
    of_all.say(words, "all clips", &grids[0]);
}

fn sentence(grid: &Grid, koma: f64, plateau: Option<&Plateau>) -> String {
    let same = if koma == 0.0 {
        "the very same keys".to_owned()
    } else {
        format!("the same keys within {koma} koma")
    };
    let Some(plateau) = plateau else {
        return format!("{same} in no two cells side by side");
    };
    let own = match grid.own {
        None => "the recipe\u{2019}s own settings lie outside the study",
        Some(own) if plateau.holds(own) => "the recipe\u{2019}s own settings stand on it",
        Some(_) => "the recipe\u{2019}s own settings stand beside it",
    };
    let (place, keys) = (plateau.words(grid), counted(plateau.keys, "key"));
    format!("{same} at {place}, {keys} between the first and the last drawing; {own}")
}

fn asked(args: &StudyArgs) -> Result<Study, Failure> {
    let is_table_1 = args.x.is_none() && args.y.is_none();
    let base = if is_table_1 { study::table_1_recipe() } else { Recipe::default() };
    let (mut recipe, _) = args.settings.read(base)?;
    if let Some(kind) = &args.filter {
        recipe.set("filter.kind", kind)?;
    }
    let (x, y) = axes(args)?;
    for axis in [Some(&x), y.as_ref()].into_iter().flatten() {
        not_set_too(args, axis)?;
    }
    let mut measures =
        if args.measure.is_empty() { usual(&x, y.as_ref()) } else { args.measure.clone() };
    let shown_too = args.shown().filter(|show| !measures.contains(show));
    measures.extend(shown_too);
    if args.stability && x.len() * y.as_ref().map_or(1, Axis::len) < 2 {
        let message =
            "--stability: compares cells, and there is one alone; give an axis more values";
        return Err(Failure::AskedWrongly(message.into()));
    }
    let study =
        Study { recipe, x, y, measures, keep_keys: args.stability, budget: args.part.budget() };
    study.validate()?;
    Ok(study)
}

/// What is varied: Table 1 of the paper, unless it is said.
fn axes(args: &StudyArgs) -> Result<(Axis, Option<Axis>), Failure> {
    let x = match args.x.as_ref().or(args.filter_width.as_ref()) {
        Some(x) => x.clone(),
        None => Axis::new("filter.width", "10,20,30")?,
    };
    let y = match args.y.as_ref().or(args.persistence.as_ref()) {
        None if args.x.is_none() => Some(Axis::new("turns.persistence", "5,10")?),
        y => y.cloned(),
    };
    Ok((x, y))
}

/// Refuses a setting that is on an axis and given a value, too.
fn not_set_too(args: &StudyArgs, axis: &Axis) -> Result<(), Failure> {
    let name = axis.name();
    if args.settings.set.iter().any(|(set, _)| set == name) {
        return Err(Failure::AskedWrongly(format!("--set {name}: a study varies it already")));
    }
    if name == "filter.kind" && args.filter.is_some() {
        return Err(Failure::AskedWrongly("--filter: a study varies it already".into()));
    }
    Ok(())
}

/// What is counted unless it is said.
fn usual(x: &Axis, y: Option<&Axis>) -> Vec<Measure> {
    let of_the_sheet =
        |axis: &Axis| axis.knob().path().0.is_some_and(|section| OF_THE_SHEET.contains(&section));
    if of_the_sheet(x) || y.is_some_and(of_the_sheet) {
        return Measure::ALL.to_vec();
    }
    vec![Measure::Turns, Measure::Genga, Measure::Fills, Measure::Union, Measure::Total]
}

/// What is drawn unless it is said: what is compared, else the first measure that the axes can change.
fn usually_shown(study: &Study) -> Measure {
    let sections = |axis: &Axis| axis.knob().path().0;
    let axes = [Some(&study.x), study.y.as_ref()].into_iter().flatten();
    let sections: Vec<&str> = axes.filter_map(sections).collect();
    let varies = |names: &[&str]| names.iter().any(|name| sections.contains(name));
    let wanted = match study.keep_keys {
        false if varies(&OF_THE_SHEET) => Measure::Drawings,
        false if !varies(&["keys"]) => study.measures[0],
        _ => Measure::Genga,
    };
    if study.measures.contains(&wanted) { wanted } else { study.measures[0] }
}

fn swept(
    study: &Study,
    clips: Vec<Clip>,
    paths: &[PathBuf],
    words: &Words,
) -> Result<Vec<Grid>, Failure> {
    let counter = words.counting(study.len() * clips.len(), "cells");
    let grid = |(clip, path): (Clip, &PathBuf)| {
        study.run(clip, || counter.count()).map_err(files::fault_of(path))
    };
    let grids: Vec<_> = clips.into_par_iter().zip(paths).map(grid).collect();
    // The first of what went wrong, whichever thread was first.
    grids.into_iter().collect()
}
