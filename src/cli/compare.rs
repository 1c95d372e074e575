//! `genga compare`: several ways to choose keys, side by side.

use serde::Serialize;

use super::args::CompareArgs;
use super::failure::Failure;
use super::table::Table;
use super::words::{Words, counted, two};
use super::{io, source};
use crate::deliver;
use crate::motion::Clip;
use crate::quality::{Compare, Comparison, Method, Row};
use crate::recipe::Recipe;
use crate::study::Noise;

/// A comparison with the name of its clip.
#[derive(Serialize)]
struct Named<'a> {
    clip: &'a str,
    #[serde(flatten)]
    comparison: &'a Comparison,
}

pub(super) fn run(args: &CompareArgs, words: &Words) -> Result<(), Failure> {
    let targets = || args.out.iter().chain(&args.json);
    for clip in &args.clips {
        targets().try_for_each(|target| io::spare(clip, target))?;
    }
    io::distinct(targets())?;
    let asked = asked(args)?;
    let names = io::names(&args.clips);
    let clips: Vec<Clip> = source::parts(&args.clips, &args.part, words)?;
    let counter = words.counting(clips.len(), "clips");
    let mut comparisons = Vec::with_capacity(clips.len());
    // One after the other: each works on all cores, and times would say nothing.
    for (name, clip) in names.iter().zip(clips) {
        let comparison = asked.run(clip)?;
        if comparison.koma > asked.longest {
            let longest = asked.longest;
            words.say(format_args!(
                "{name}: optimal sets and polylines of more than {longest} koma are not looked for; see --trim"
            ));
        }
        comparisons.push(comparison);
        counter.count();
    }
    drop(counter);
    if let Some(path) = &args.out {
        io::write(path, deliver::comparison_csv(&names, &comparisons)?.as_bytes())?;
    }
    if let Some(path) = &args.json {
        let named = names.iter().zip(&comparisons);
        let named: Vec<_> = named.map(|(clip, comparison)| Named { clip, comparison }).collect();
        io::write_json(path, &named)?;
    }
    if targets().any(|target| io::is_stream(target)) {
        return Ok(());
    }
    let pages = names.iter().zip(&comparisons).map(|(name, found)| page(name, found));
    io::to_stdout(pages.collect::<Vec<_>>().join("\n").as_bytes())
}

fn asked(args: &CompareArgs) -> Result<Compare, Failure> {
    let (recipe, _) = source::recipe(&args.settings, Recipe::default())?;
    let counts = args.keys.iter().map(|count| *count as usize).collect();
    let noise = Noise { degrees: args.noise, ..Noise::default() };
    let asked = Compare { recipe, counts, noise, times: args.times, ..Compare::default() };
    asked.validate()?;
    Ok(asked)
}

/// The table of a clip for people.
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
