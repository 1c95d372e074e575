//! `genga study`: counts keys and drawings while one or two settings vary.

mod caption;

use std::path::PathBuf;
use std::slice::from_ref;

use clap::Args;
use clap::builder::PossibleValuesParser;
use rayon::prelude::*;

use crate::clip::{NamedClip, Part};
use crate::console::{Words, counted};
use crate::corrections::Settings;
use crate::failure::Failure;
use crate::several::Several;
use crate::{files, paths};

use genga::error::Error;
use genga::recipe::{Kind, Knob, Recipe};
use genga_lab::study::{self, Axis, Grid, Measure, Plateau, Study};
use genga_plot::{HeatMap, StudyPlot};

/// Parser for the kinds of filter.
fn filters() -> PossibleValuesParser {
    let kind = Knob::find("filter.kind").map(|knob| knob.kind);
    let words: &[&str] = if let Ok(Kind::Choice(words)) = kind { words } else { &[] };
    PossibleValuesParser::new(words)
}

#[derive(Debug, Args)]
#[command(after_help = study_help())]
pub(super) struct StudyArgs {
    /// Motion files; - is stdin.
    #[arg(value_name = "CLIP", required = true)]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    settings: Settings,
    /// Setting to vary and its values [default: filter.width=10,20,30].
    #[arg(long, value_name = "KNOB=VALUES")]
    x: Option<Axis>,
    /// Second setting to vary, for each value of the first [default: turns.persistence=5,10; none with --x].
    #[arg(long, value_name = "KNOB=VALUES")]
    y: Option<Axis>,
    /// Filter widths, in source frames or seconds: like --x filter.width=VALUES, but --y keeps its default.
    #[arg(long, value_name = "VALUES", value_parser = filter_width, conflicts_with = "x")]
    filter_width: Option<Axis>,
    /// Persistences, in source frames or seconds: --y turns.persistence=VALUES.
    #[arg(long, value_name = "VALUES", value_parser = persistence, conflicts_with = "y")]
    persistence: Option<Axis>,
    /// Kind of filter.
    #[arg(long, value_name = "KIND", value_parser = filters())]
    filter: Option<String>,
    /// Measures to count [default: turns,genga,fills,union,total; all measures if a setting of the sheet varies].
    #[arg(long, value_name = "MEASURE,…", value_delimiter = ',')]
    measure: Vec<Measure>,
    /// Compare the layer's keys of each cell with those of the neighbouring cells: columns kept (share of keys),
    /// mean_move and largest_move (source frames). Reports the region in which the keys do not change, and draws its
    /// edge on the map.
    #[arg(long)]
    stability: bool,
    /// Largest move of a key that still counts as the same, in koma of the sheet.
    #[arg(long, value_name = "KOMA", allow_negative_numbers = true, default_value_t = 1.0, requires = "stability", value_parser = tolerance)]
    tolerance: f64,
    /// CSV file of the table; - is stdout.
    #[arg(long, short, value_name = "FILE.csv", default_value = "-")]
    out: PathBuf,
    #[arg(long, value_name = "FILE.svg", help = paths::picture_help("Draw a measure as curves over the first setting"))]
    plot: Option<PathBuf>,
    #[arg(long, value_name = "FILE.svg", help = paths::picture_help("Draw a measure as a map of both settings, with its value in each cell"))]
    heat: Option<PathBuf>,
    /// Write a caption for the pictures as a Markdown file: their content and clips, and the recipe and command that
    /// reproduce them.
    #[arg(long, value_name = "FILE.md")]
    caption: Option<PathBuf>,
    /// Measure to draw [default: the first one counted; union with the axes of Table 1 or --paper, genga with
    /// --stability or a setting of keys, drawings with a setting of the sheet].
    #[arg(long, value_name = "MEASURE")]
    show: Option<Measure>,
    /// Draw counts per second of the sheet, so that clips of different lengths compare. The table keeps the counts.
    #[arg(long)]
    per_second: bool,
    /// Also draw the paper's six counts, from a clip that is not public.
    #[arg(long, requires = "plot")]
    paper: bool,
}

impl StudyArgs {
    /// Measure to draw, if the arguments name one.
    fn shown(&self) -> Option<Measure> {
        self.show.or(self.paper.then_some(Measure::Union))
    }
}

/// Help on the syntax of axes, the measures, and three example studies.
fn study_help() -> String {
    let measures = Measure::ALL.map(|measure| {
        let (english, japanese) = measure.words();
        format!("\n  {measure:<21}{english} ({japanese})")
    });
    format!(
        "Axes:\n  KNOB is any setting of `genga recipe`, or noise (standard deviation in degrees of Gaussian \
         noise,\n  independent for every rotation channel and frame) or noise.seed (0, unless it varies). VALUES is a list; FROM..TO:STEP is a range, which includes TO if a \
         step\n  lands on it. Values keep their units: 0.1s..0.5s:0.05s. With both axes of Table 1 of the first paper, \
         filter.width and\n  turns.persistence, the recipe is that of Table 1 (`genga recipe --study`), else and \
         with --stability\n  that of `genga run`; --recipe goes over both.\n\n\
         Measures:{}\n\n\
         Examples:\n  genga study a.bvh --filter-width 5..40:5 --persistence 1..20:1 --heat map.svg\n  \
         genga study a.bvh b.bvh --x keys.min_price=2..20:2 --plot curves.svg\n  \
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
        let sources = [("motion", Some(&**clip)), ("recipe", args.settings.recipe.as_deref())];
        targets().try_for_each(|target| paths::spare(&sources, target))?;
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
    // Refuses what cannot be drawn before the work begins.
    plot.fits(&study.x, study.y.as_ref())?;
    if args.heat.is_some() {
        HeatMap::fits(&study.x, study.y.as_ref())?;
    }
    let mut several = Several::new(args.clips.len(), words);
    let clips = args.part.read_all(&args.clips, &mut several, words)?;
    let rates: Vec<_> = clips.iter().map(|named| named.clip.rate()).collect();
    let (names, grids) = swept(&study, clips, &mut several, words)?;
    let tolerance = args.stability.then_some(args.tolerance);
    let plateaus = tolerance.map(|koma| Plateaus::new(&grids, koma));
    if let Some(path) = &args.plot {
        files::write_picture(path, &plot.draw(&names, &grids)?, words)?;
    }
    if let Some(path) = &args.heat {
        let edges = plateaus.as_ref().map(|plateaus| &plateaus.found);
        files::write_picture(path, &heat.draw(&names, &grids, edges)?, words)?;
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
    files::write(&args.out, genga_files::study_csv(&names, &grids, tolerance)?.as_bytes())?;
    let begins = match (&args.settings.recipe, is_table_1(args, &study.x, study.y.as_ref())) {
        (Some(path), true) => {
            format!("{}, over that of Table 1 (genga recipe --study)", path.display())
        }
        (Some(path), false) => path.display().to_string(),
        (None, true) => "that of Table 1 (genga recipe --study)".into(),
        (None, false) => "that of genga run".into(),
    };
    words.say(format_args!("recipe      設定       {begins}"));
    dead_band_in_doubt(&study)
        .iter()
        .for_each(|note| words.say(format_args!("note        {note}")));
    let seconds = study.in_seconds(&rates);
    seconds.iter().for_each(|line| words.say(format_args!("seconds     {line}")));
    if tells_turns_apart(&study.measures) {
        words.say(TURNS);
    }
    if let Some(plateaus) = plateaus {
        say_plateaus(words, &names, &grids, &plateaus);
    }
    let files = targets().filter(|path| !paths::is_stream(path));
    let files: Vec<String> = files.map(|path| path.display().to_string()).collect();
    if !files.is_empty() {
        words.say(format_args!("files       {}", files.join(" ")));
    }
    several.end()
}

/// What is said of turns, for the report of a run calls those of the joints `turns` too.
const TURNS: &str = "turns       変わり目   turns: of the body; union, total: keys of joints \
                     (in report.json turns.union, turns.total)";

/// Says that the dead band may not fit the measure of the recipe, or one that an axis takes.
fn dead_band_in_doubt(study: &Study) -> Option<String> {
    let axes = || [Some(&study.x), study.y.as_ref()].into_iter().flatten();
    if axes().any(|axis| axis.name() == "turns.steady") {
        return None;
    }
    let measures = axes().filter(|axis| axis.name() == "speed.measure").flat_map(Axis::values);
    let other = |measure: &String| {
        let mut recipe = study.recipe.clone();
        recipe.set("speed.measure", measure).ok()?;
        recipe.dead_band_in_doubt()
    };
    study.recipe.dead_band_in_doubt().or_else(|| measures.into_iter().find_map(other))
}

/// Whether turns of the body and turns of the joints are columns of one table.
fn tells_turns_apart(measures: &[Measure]) -> bool {
    let has = |measure| measures.contains(&measure);
    has(Measure::Turns) && (has(Measure::Union) || has(Measure::Total))
}

/// Regions of settings with identical keys, and with nearly identical keys, of all clips.
struct Plateaus {
    koma: [f64; 2],
    found: [Option<Plateau>; 2],
}

impl Plateaus {
    fn new(grids: &[Grid], koma: f64) -> Self {
        let koma = [0.0, koma];
        Self { koma, found: koma.map(|koma| Plateau::largest(grids, koma)) }
    }

    fn say(&self, words: &Words, name: &str, grid: &Grid) {
        for (koma, plateau) in self.koma.iter().zip(&self.found) {
            words.say(format_args!("{name}: {}", sentence(grid, *koma, plateau.as_ref())));
        }
    }
}

/// Prints the regions in which the keys do not change, for each clip and for all together.
fn say_plateaus(words: &Words, names: &[String], grids: &[Grid], of_all: &Plateaus) {
    words.say("plateau  変わらない範囲");
    if let ([name], [grid]) = (names, grids) {
        return of_all.say(words, name, grid);
    }
    for (name, grid) in names.iter().zip(grids) {
        Plateaus::new(from_ref(grid), of_all.koma[1]).say(words, name, grid);
    }
    of_all.say(words, "all clips", &grids[0]);
}

fn sentence(grid: &Grid, koma: f64, plateau: Option<&Plateau>) -> String {
    let is_exact = koma == 0.0;
    let Some(plateau) = plateau else {
        return match is_exact {
            true => "the very same keys in no two cells side by side".into(),
            false => format!("the same keys within {koma} koma in no two cells side by side"),
        };
    };
    let same = match is_exact {
        true => "the very same keys at".into(),
        false => {
            let seed = plateau.seed_words(grid);
            format!("each key within {koma} koma of its place at {seed}, over")
        }
    };
    let own = match grid.own {
        None => "the recipe\u{2019}s own settings lie outside the study",
        Some(own) if plateau.holds(own) => "the recipe\u{2019}s own settings stand on it",
        Some(_) => "the recipe\u{2019}s own settings stand beside it",
    };
    let (place, keys) = (plateau.words(grid), counted(plateau.keys, "key"));
    format!("{same} {place}, {keys} before they are timed; {own}")
}

fn asked(args: &StudyArgs) -> Result<Study, Failure> {
    let (x, y) = axes(args)?;
    let base =
        if is_table_1(args, &x, y.as_ref()) { study::table_1_recipe() } else { Recipe::default() };
    let (mut recipe, _) = args.settings.read(base)?;
    if let Some(kind) = &args.filter {
        recipe.set("filter.kind", kind)?;
    }
    for axis in [Some(&x), y.as_ref()].into_iter().flatten() {
        not_set_too(args, axis)?;
    }
    let mut measures =
        if args.measure.is_empty() { Measure::usual(&x, y.as_ref()) } else { args.measure.clone() };
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

/// Whether the study begins with the recipe of Table 1: it has its axes, and counts. How steady keys are is asked of the
/// recipe that finds them.
fn is_table_1(args: &StudyArgs, x: &Axis, y: Option<&Axis>) -> bool {
    study::is_table_1(x, y) && !args.stability
}

/// The axes to vary; Table 1 of the paper by default.
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

/// Refuses a setting that is both on an axis and given a value.
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

/// The measure drawn by default: genga if keys are compared, what Table 1 counts with its axes, else the first measure
/// that the axes can change.
fn usually_shown(study: &Study) -> Measure {
    let varies = |is_of: fn(&Axis) -> bool| is_of(&study.x) || study.y.as_ref().is_some_and(is_of);
    let varies_keys = varies(|axis| axis.knob().path().0 == Some("keys"));
    let is_table_1 = study::is_table_1(&study.x, study.y.as_ref());
    let wanted = match study.keep_keys {
        false if is_table_1 => Measure::Union,
        false if varies(Axis::is_of_the_sheet) => Measure::Drawings,
        false if !varies_keys => study.measures[0],
        _ => Measure::Genga,
    };
    if study.measures.contains(&wanted) { wanted } else { study.measures[0] }
}

/// Runs the study of every clip. Returns the names of the clips and their grids.
fn swept<'a>(
    study: &Study,
    clips: Vec<NamedClip<'a>>,
    several: &mut Several<'_>,
    words: &Words,
) -> Result<(Vec<String>, Vec<Grid>), Failure> {
    let counter = words.counting(study.len() * clips.len(), "cells");
    let grid = |NamedClip { name, path, clip }: NamedClip<'a>| {
        let grid = study.run(clip, || counter.count()).map_err(files::fault_of(path));
        (path, grid.map(|grid| (name, grid)))
    };
    let grids: Vec<_> = clips.into_par_iter().map(grid).collect();
    drop(counter);
    // What fails is told in the order of the clips, whichever thread failed first.
    let mut kept = (Vec::new(), Vec::new());
    for (path, grid) in grids {
        kept.extend(several.keep(path, grid)?);
    }
    Ok(kept)
}
