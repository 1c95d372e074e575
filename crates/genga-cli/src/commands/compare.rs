//! `genga compare`: compares several methods of choosing keys.

use std::path::PathBuf;

use clap::Args;
use serde::Serialize;

use crate::clip::{NamedClip, Part};
use crate::console::{Table, Words, counted, two};
use crate::corrections::Settings;
use crate::failure::Failure;
use crate::several::Several;
use crate::{files, paths};

use genga::recipe::Recipe;
use genga_lab::quality::{Compare, Comparison, Method, Row};
use genga_lab::study::Noise;

#[derive(Debug, Args)]
#[command(after_help = help())]
pub(super) struct CompareArgs {
    /// Motion files; - is stdin.
    #[arg(value_name = "CLIP", required = true)]
    clips: Vec<PathBuf>,
    #[command(flatten)]
    part: Part,
    #[command(flatten)]
    settings: Settings,
    /// Number of keys that each method chooses, not counting both ends of the clip: --keys 8,16,32 [default: as many
    /// as the recipe finds, half and double].
    #[arg(long, value_name = "N,…", allow_negative_numbers = true, value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..))]
    keys: Vec<u32>,
    /// Noise on every rotation, in degrees, under which keys are chosen a second time; 0 for none.
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, default_value_t = 0.1)]
    noise: f64,
    /// Report how long each method took; times differ from run to run.
    #[arg(long)]
    times: bool,
    /// Table as a CSV file; - is stdout, in place of the printed table.
    #[arg(long, short, value_name = "FILE.csv|-")]
    out: Option<PathBuf>,
    /// Table as JSON; - is stdout.
    #[arg(long, value_name = "FILE|-")]
    json: Option<PathBuf>,
}

/// Returns the list of methods and columns, one a line.
fn help() -> String {
    let paces = Method::PACES.map(|(method, _)| method);
    let lines = Method::ALL.into_iter().chain(paces).map(|method| {
        let (english, japanese) = method.words();
        format!("\n  {method:<15}{english} ({japanese})")
    });
    format!(
        "Methods:{}\n\n  \
         Recipe and settings are those of genga. kt11 takes none of them but the rate: its settings\n  \
         are those of Table 1 (`genga recipe --study`), without rests. The keys that a recipe finds\n  \
         are counted before timing, without both ends and corrections. `genga run` counts both\n  \
         ends, and on its sheet a key that is too close to another or to an end gives way.\n\n\
         Columns:\n  mean, worst    error of the motion slerped between the keys, mean over koma and worst koma:\n                 \
         root mean square over joints and tips, weighed by bones, in % of body height\n  \
         × mean, worst  the same errors as a multiple of the least possible with as many keys\n  \
         hits           share of the largest turns of wrists, ankles or head in the world, as many as keys,\n                 \
         that have a key within a koma\n  \
         by chance      mean of the same share if the keys are rotated around the clip by 1, 2, 3 … koma\n  \
         off            mean distance from such a turn to the nearest key, in koma\n  \
         steady         F1, within a koma, between the keys with and without noise on the clip\n\n\
         Examples:\n  genga compare kick.bvh --keys 8,16,32\n  genga compare *.bvh --out methods.csv",
        lines.collect::<String>()
    )
}

/// A comparison and the name of its clip.
#[derive(Serialize)]
struct Named<'a> {
    clip: &'a str,
    #[serde(flatten)]
    comparison: &'a Comparison,
}

pub(super) fn run(args: &CompareArgs, words: &Words) -> Result<(), Failure> {
    let targets = || args.out.iter().chain(&args.json);
    for clip in &args.clips {
        let sources = [("motion", Some(&**clip)), ("recipe", args.settings.recipe.as_deref())];
        targets().try_for_each(|target| paths::spare(&sources, target))?;
    }
    paths::distinct(targets())?;
    let asked = asked(args)?;
    let mut several = Several::new(args.clips.len(), words);
    let clips = args.part.read_all(&args.clips, &mut several, words)?;
    let counter = words.counting(clips.len(), "clips");
    let (mut names, mut comparisons) = (Vec::new(), Vec::new());
    // Runs clips one after the other: each uses all cores, and parallel runs would make the times meaningless.
    for NamedClip { name, path, clip } in clips {
        let compared = asked.run(clip).map_err(files::fault_of(path));
        let Some(comparison) = several.keep(path, compared)? else { continue };
        if comparison.koma > asked.longest {
            let longest = asked.longest;
            words.say(format_args!(
                "{name}: optimal sets and polylines of more than {longest} koma are not looked for; see --trim"
            ));
        }
        names.push(name);
        comparisons.push(comparison);
        counter.count();
    }
    drop(counter);
    if let Some(path) = &args.out {
        files::write(path, genga_files::comparison_csv(&names, &comparisons)?.as_bytes())?;
    }
    if let Some(path) = &args.json {
        let named = names.iter().zip(&comparisons);
        let named: Vec<_> = named.map(|(clip, comparison)| Named { clip, comparison }).collect();
        files::write_json(path, &named)?;
    }
    if targets().any(|target| paths::is_stream(target)) {
        return several.end();
    }
    let pages = names.iter().zip(&comparisons).map(|(name, found)| page(name, found));
    files::page_to_stdout(&pages.collect::<Vec<_>>().join("\n"))?;
    several.end()
}

fn asked(args: &CompareArgs) -> Result<Compare, Failure> {
    let (recipe, _) = args.settings.read(Recipe::default())?;
    let counts = args.keys.iter().map(|count| *count as usize).collect();
    let noise = Noise { degrees: args.noise, ..Noise::default() };
    let budget = args.part.budget();
    let asked = Compare { recipe, counts, noise, times: args.times, budget, ..Compare::default() };
    asked.validate()?;
    Ok(asked)
}

/// Renders the table of a clip for people.
fn page(name: &str, found: &Comparison) -> String {
    let (own, extrema) = (counted(found.own_keys, "key"), found.extrema);
    let mut page = format!(
        "{name}: {} koma; the recipe finds {own}; the body turns at {extrema} moments (極値)\n",
        found.koma
    );
    if found.rows.is_empty() && found.paces.is_empty() {
        return page + "no key fits between both ends of the clip: there is nothing to compare\n";
    }
    let has_times = found.rows.iter().any(|row| row.ms.is_some());
    let mut table = Table::default();
    let header = [
        "keys",
        "method",
        "",
        "mean",
        "worst",
        "× mean",
        "× worst",
        "hits",
        "by chance",
        "off",
        "steady",
    ];
    let japanese = ["原画", "手法", "", "平均", "最大", "比", "比", "命中", "偶然", "ずれ", "安定"];
    table.row(header.into_iter().chain(has_times.then_some("ms")));
    table.row(japanese.into_iter().chain(has_times.then_some("時間")));
    let mut last = None;
    for row in found.rows.iter().chain(&found.paces) {
        let count = if last == Some(row.asked) { String::new() } else { row.asked.to_string() };
        last = Some(row.asked);
        table.row(cells(row, count, has_times));
    }
    page += &table.text(3);
    page
}

fn cells(row: &Row, count: String, has_times: bool) -> Vec<String> {
    let method = if row.keys == row.asked {
        row.method.word().to_owned()
    } else {
        format!("{} ({})", row.method, row.keys)
    };
    let mut cells = vec![
        count,
        method,
        Method::words(row.method).1.into(),
        two(Some(row.mean)),
        two(Some(row.worst)),
        two(row.mean_ratio),
        two(row.worst_ratio),
        two(row.hits),
        two(row.by_chance),
        two(row.off),
        two(row.steady),
    ];
    if has_times {
        cells.push(row.ms.map_or("–".into(), |ms| format!("{ms:.1}")));
    }
    cells
}
