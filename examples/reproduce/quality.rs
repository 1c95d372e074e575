//! `docs/quality.md`: the program's keys beside other methods, and its sheets beside their sources.

use std::slice::from_ref;

use genga::quality::{Compare, Comparison, Evaluation, Method, Row};

use crate::Outcome;
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::takes::Take;

/// What is asked of the mean error at an equal number of keys, as a multiple of the least there is.
const ASKED: f64 = 1.25;

/// A clip and its comparison.
struct Judged<'a> {
    take: &'a Take,
    found: Comparison,
}

/// A measure of a row by name.
type Measure = (&'static str, fn(&Row) -> Option<f64>);

/// What each table of clips shows.
const MEASURES: [Measure; 5] = [
    ("mean-error", |row| row.mean_ratio),
    ("worst-error", |row| row.worst_ratio),
    ("timing", |row| Some(row.timing)),
    ("off", |row| row.off),
    ("steady", |row| row.steady),
];

/// The whole page.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let compare = Compare { times: true, ..Compare::default() };
    let judge = |take| {
        let take: &Take = take;
        Ok(Judged { take, found: compare.run(take.clip.clone())? })
    };
    let judged = takes.iter().map(judge).collect::<Outcome<Vec<_>>>()?;
    let mut part = Part::default();
    part.table("counts", counts(&judged));
    for (name, measure) in MEASURES {
        part.table(name, by_clip(&judged, measure));
    }
    part.table("summary", summary(&judged));
    part.table("paces", paces(&judged));
    part.measured("times", times(&judged));
    part.table("sheets", sheets(takes)?);
    part.number("clips", judged.len());
    verdicts(&judged, &mut part);
    Ok(part)
}

/// The rows of a method at half the number of keys that the recipe finds (0), at that number (1) and at
/// double (2), each with its clip.
fn rows<'a>(
    judged: &'a [Judged<'a>],
    method: Method,
    which: usize,
) -> impl Iterator<Item = (&'a str, &'a Row)> {
    judged.iter().filter_map(move |clip| {
        let count = *clip.found.counts().get(which)?;
        Some((clip.take.name.as_str(), clip.found.row(method, count)?))
    })
}

/// How many keys there are, and the error of the program's own.
fn counts(judged: &[Judged<'_>]) -> Table {
    let header = [
        "clip",
        ">koma",
        ">keys",
        ">a second",
        ">mean error",
        ">worst error",
        ">least mean",
        ">least worst",
        ">extrema",
    ];
    let mut table = Table::new(&header);
    for clip in judged {
        let found = &clip.found;
        let row = |method| found.row(method, found.own_keys);
        let error = |method, of: fn(&Row) -> f64| {
            row(method).map_or("–".into(), |row| number(of(row), 2))
        };
        table.row(&[
            clip.take.name.clone(),
            found.koma.to_string(),
            found.own_keys.to_string(),
            number(24.0 * found.own_keys as f64 / found.koma as f64, 1),
            error(Method::Own, |row| row.mean),
            error(Method::Own, |row| row.worst),
            error(Method::OptimalMean, |row| row.mean),
            error(Method::OptimalWorst, |row| row.worst),
            found.extrema.to_string(),
        ]);
    }
    table
}

/// A measure of every clip and method at as many keys as the recipe finds.
fn by_clip(judged: &[Judged<'_>], measure: fn(&Row) -> Option<f64>) -> Table {
    let names = Method::ALL.map(|method| format!(">{method}"));
    let header: Vec<&str> = ["clip"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let mut table = Table::new(&header);
    for clip in judged {
        let cell = |method| {
            let row = clip.found.row(method, clip.found.own_keys);
            row.and_then(measure).map_or("–".into(), |value| number(value, 2))
        };
        let cells = Method::ALL.map(cell);
        table.row(&[from_ref(&clip.take.name), &cells[..]].concat());
    }
    let medians = Method::ALL.map(|method| {
        let row = |clip: &Judged<'_>| clip.found.row(method, clip.found.own_keys).and_then(measure);
        let values: Vec<f64> = judged.iter().filter_map(row).collect();
        if values.is_empty() { "–".into() } else { number(spread(values)[1], 2) }
    });
    table.row(&[&["median".to_owned()], &medians[..]].concat());
    table
}

/// Medians over the clips at half, equal and double the number of keys.
fn summary(judged: &[Judged<'_>]) -> Table {
    let header = ["keys", "method", ">× mean", ">× worst", ">timing", ">off", ">steady"];
    let mut table = Table::new(&header);
    for (which, keys) in ["half", "as found", "double"].into_iter().enumerate() {
        for method in Method::ALL {
            let cells = MEASURES.map(|(_, measure)| median(judged, method, which, measure));
            let cells = cells.map(|value| value.map_or("–".into(), |value| number(value, 2)));
            table.row(&[&[keys.to_owned(), method.word().to_owned()], &cells[..]].concat());
        }
    }
    table
}

/// Keys on threes and on twos, medians over the clips.
fn paces(judged: &[Judged<'_>]) -> Table {
    let mut table =
        Table::new(&["keys", ">a second", ">mean error", ">× mean", ">× worst", ">timing", ">off"]);
    for (method, step) in Method::PACES {
        let middle = |measure: fn(&Row) -> Option<f64>| {
            let rows = judged.iter().flat_map(|clip| &clip.found.paces);
            let values: Vec<f64> =
                rows.filter(|row| row.method == method).filter_map(measure).collect();
            if values.is_empty() { "–".into() } else { number(spread(values)[1], 2) }
        };
        table.row(&[
            method.word().into(),
            (24 / step).to_string(),
            middle(|row| Some(row.mean)),
            middle(|row| row.mean_ratio),
            middle(|row| row.worst_ratio),
            middle(|row| Some(row.timing)),
            middle(|row| row.off),
        ]);
    }
    table
}

fn median(
    judged: &[Judged<'_>],
    method: Method,
    which: usize,
    measure: fn(&Row) -> Option<f64>,
) -> Option<f64> {
    let values: Vec<f64> =
        rows(judged, method, which).filter_map(|(_, row)| measure(row)).collect();
    (!values.is_empty()).then(|| spread(values)[1])
}

/// Milliseconds of each method, for all counts together.
fn times(judged: &[Judged<'_>]) -> Table {
    let mut table = Table::new(&["method", ">least ms", ">median", ">most", ">all clips"]);
    for method in Method::ALL {
        let times: Vec<f64> = rows(judged, method, 0).filter_map(|(_, row)| row.ms).collect();
        let all: f64 = times.iter().sum();
        let [least, median, most] = spread(times);
        let cells = [least, median, most, all].map(|ms| number(ms, 1));
        table.row(&[&[method.word().to_owned()], &cells[..]].concat());
    }
    table
}

/// The measures of the sheets that the defaults make.
fn sheets(takes: &[Take]) -> Outcome<Table> {
    let header = [
        "clip",
        ">drawings/s",
        ">keys mean",
        ">worst",
        ">shown mean",
        ">worst",
        ">contacts",
        ">keys slip mean",
        ">worst",
        ">shown slip mean",
        ">worst",
        ">pops",
        ">holds",
        ">worst pop",
    ];
    let mut table = Table::new(&header);
    for take in takes {
        let found = Evaluation::of(&take.clip, &take.default().sheet, None, 1.0)?;
        let two = |value: f64| number(value, 2);
        table.row(&[
            take.name.clone(),
            number(found.pace.drawings_per_second, 1),
            two(found.keys.mean),
            two(found.keys.worst),
            two(found.shown.mean),
            two(found.shown.worst),
            found.shown_slip.contacts.to_string(),
            two(found.keys_slip.mean),
            two(found.keys_slip.worst),
            two(found.shown_slip.mean),
            two(found.shown_slip.worst),
            found.pops.pops.len().to_string(),
            found.pops.holds.to_string(),
            found.pops.worst().map_or("–".into(), |pop| number(pop.times, 1)),
        ]);
    }
    Ok(table)
}

/// Where the program's own keys lead and where not, and numbers for the prose.
fn verdicts(judged: &[Judged<'_>], part: &mut Part) {
    let ratios: Vec<(&str, f64)> = rows(judged, Method::Own, 1)
        .filter_map(|(clip, row)| Some((clip, row.mean_ratio?)))
        .collect();
    let beyond: Vec<_> = ratios.iter().filter(|(_, ratio)| *ratio > ASKED).collect();
    part.number("asked", number(ASKED, 2));
    part.number("within", ratios.len() - beyond.len());
    part.number("ratios", ratios.len());
    part.text(
        "beyond",
        list(beyond.iter().map(|(clip, ratio)| format!("{clip} ({})", number(*ratio, 2)))),
    );
    let leads = |clip: &&Judged<'_>| {
        let timing = |row: &Row| row.timing;
        let own = clip.found.row(Method::Own, clip.found.own_keys).map_or(0.0, timing);
        let rows = clip.found.rows.iter().filter(|row| row.asked == clip.found.own_keys);
        rows.map(timing).all(|other| other <= own)
    };
    part.number("leads", judged.iter().filter(leads).count());
    part.text("behind", list(judged.iter().filter(|clip| !leads(clip)).map(behind)));
    for method in Method::ALL {
        for (name, measure) in MEASURES {
            let value = median(judged, method, 1, measure);
            let value = value.map_or("–".into(), |value| number(value, 2));
            part.number(&format!("{name}.{method}"), value);
        }
    }
}

/// A clip on which another method leads on timing, and by how much.
fn behind(clip: &Judged<'_>) -> String {
    let found = &clip.found;
    let rows = found.rows.iter().filter(|row| row.asked == found.own_keys);
    let best = rows.reduce(|a, b| if b.timing > a.timing { b } else { a });
    let own = found.row(Method::Own, found.own_keys).map_or(0.0, |row| row.timing);
    let (method, timing) = best.map_or(("–", 0.0), |row| (row.method.word(), row.timing));
    format!("{} ({} against {} of {method})", clip.take.name, number(own, 2), number(timing, 2))
}

fn list(items: impl Iterator<Item = String>) -> String {
    let items: Vec<String> = items.map(|item| format!("- {item}\n")).collect();
    if items.is_empty() { "- none\n".into() } else { items.concat() }
}
