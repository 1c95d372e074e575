//! `docs/quality.md`: the program's keys beside other methods, and its sheets beside their sources.

use std::slice::from_ref;

use genga::quality::{Compare, Comparison, Evaluation, Method, Row};
use genga::signal::{ContactFinder, Limb};

use crate::Outcome;
use crate::on_screen;
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::takes::Take;

/// What is asked of the mean error at an equal number of keys, as a multiple of the least there is.
const ASKED: f64 = 1.25;

/// With double as many keys the worst koma should not be more than so many times as far off as the
/// least there is with as many as found.
const GAP: f64 = 1.25;

/// A clip and its comparison.
struct Judged<'a> {
    take: &'a Take,
    found: Comparison,
}

/// A measure of a row by name.
type Measure = (&'static str, fn(&Row) -> Option<f64>);

/// What each table of clips shows.
const MEASURES: [Measure; 6] = [
    ("mean-error", |row| row.mean_ratio),
    ("worst-error", |row| row.worst_ratio),
    ("hits", |row| row.hits),
    ("by-chance", |row| row.by_chance),
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
    on_screen::add(takes, &mut part)?;
    part.text("blind", list(takes.iter().filter_map(blind)));
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
    let header =
        ["keys", "method", ">× mean", ">× worst", ">hits", ">by chance", ">off", ">steady"];
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
    let mut table = Table::new(&["keys", ">a second", ">mean error", ">× mean", ">× worst"]);
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
        ">in source",
        ">shown slip mean",
        ">worst",
        ">in source",
        ">pops",
        ">holds",
        ">worst pop",
    ];
    let mut table = Table::new(&header);
    for take in takes {
        let found = Evaluation::of(&take.clip, &take.default().sheet, None, 1.0)?;
        let two = |value: f64| number(value, 2);
        let some = |value: Option<f64>| value.map_or("–".into(), two);
        table.row(&[
            take.name.clone(),
            number(found.pace.drawings_per_second, 1),
            two(found.keys.mean),
            two(found.keys.worst),
            two(found.shown.mean),
            two(found.shown.worst),
            found.shown_slip.contacts.to_string(),
            some(found.keys_slip.mean),
            some(found.keys_slip.worst),
            some(found.keys_slip.source),
            some(found.shown_slip.mean),
            some(found.shown_slip.worst),
            some(found.shown_slip.source),
            found.pops.pops.len().to_string(),
            found.pops.holds.to_string(),
            found.pops.worst().map_or("–".into(), |pop| number(pop.times, 1)),
        ]);
    }
    Ok(table)
}

/// A clip on which no foot is seen standing for more than so large a share of it.
const BLIND: f64 = 0.4;

/// A clip on which no foot is seen standing for long, and from where to where.
fn blind(take: &Take) -> Option<String> {
    let clock = take.clip.clock(24.0);
    let koma = clock.frame_rate.koma_from_frames(take.clip.len(), clock.koma_rate);
    let mut stands = vec![false; koma];
    let contacts = ContactFinder::default().find(&take.clip, clock);
    for contact in contacts.iter().filter(|contact| contact.limb == Limb::Foot) {
        contact.koma.clone().filter(|at| *at < koma).for_each(|at| stands[at] = true);
    }
    let mut begin = 0;
    let mut longest = 0..0;
    for run in stands.chunk_by(|a, b| a == b) {
        if !run[0] && run.len() > longest.len() {
            longest = begin..begin + run.len();
        }
        begin += run.len();
    }
    (longest.len() as f64 > BLIND * koma as f64).then(|| {
        let (name, first, last) = (&take.name, longest.start + 1, longest.end);
        format!("{name} (koma {first} to {last} of {koma})")
    })
}

/// Where the program's own keys lead and where not, and numbers for the prose.
fn verdicts(judged: &[Judged<'_>], part: &mut Part) {
    let ratios: Vec<(&str, f64)> = rows(judged, Method::Own, 1)
        .filter_map(|(clip, row)| Some((clip, row.mean_ratio?)))
        .collect();
    let beyond: Vec<_> = ratios.iter().filter(|(_, ratio)| *ratio > ASKED).collect();
    part.number("asked", number(ASKED, 2));
    part.number("gap", number(GAP, 2));
    part.number("within", ratios.len() - beyond.len());
    part.number("ratios", ratios.len());
    part.text(
        "beyond",
        list(beyond.iter().map(|(clip, ratio)| format!("{clip} ({})", number(*ratio, 2)))),
    );
    let leads = |clip: &&Judged<'_>| behind(clip).is_none();
    part.number("leads", judged.iter().filter(leads).count());
    part.text("behind", list(judged.iter().filter_map(behind)));
    part.text("even", list(judged.iter().filter_map(even)));
    part.text("gaps", list(judged.iter().filter_map(gap)));
    let searched = |clip: &&Judged<'_>| {
        let row = clip.found.row(Method::OptimalMean, clip.found.own_keys);
        row.is_some_and(|row| row.steady.is_some())
    };
    part.number("searched", judged.iter().filter(searched).count());
    for method in Method::ALL {
        for (name, measure) in MEASURES {
            let [half, value] = [0, 1].map(|which| {
                let value = median(judged, method, which, measure);
                value.map_or("–".into(), |value| number(value, 2))
            });
            part.number(&format!("{name}.{method}"), value);
            part.number(&format!("half.{name}.{method}"), half);
        }
    }
}

/// The row of a method at as many keys as the recipe finds.
fn as_found<'a>(clip: &'a Judged<'_>, method: Method) -> Option<&'a Row> {
    clip.found.row(method, clip.found.own_keys)
}

/// A clip on which another method hits more of the moments at which the body turns, and how many.
fn behind(clip: &Judged<'_>) -> Option<String> {
    let own = as_found(clip, Method::Own)?.hits?;
    let others = Method::ALL.into_iter().filter_map(|method| {
        Some((method, as_found(clip, method)?.hits?)).filter(|(_, hits)| *hits > own)
    });
    let (method, hits) = others.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let name = &clip.take.name;
    Some(format!("{name} ({} against {} of {method})", number(own, 2), number(hits, 2)))
}

/// A clip on which keys at even distances do as well as the program's own or better, and by what.
fn even(clip: &Judged<'_>) -> Option<String> {
    let [own, even] = [Method::Own, Method::Uniform].map(|method| as_found(clip, method));
    let (own, even) = (own?, even?);
    let beside = |what: &str, own: f64, even: f64| {
        format!("{what} {} against {}", number(own, 2), number(even, 2))
    };
    let mut words = Vec::new();
    if even.mean <= own.mean {
        words.push(beside("mean error", own.mean, even.mean));
    }
    if even.worst <= own.worst {
        words.push(beside("worst error", own.worst, even.worst));
    }
    if let (Some(own), Some(even)) = (own.hits, even.hits)
        && even >= own
    {
        words.push(beside("hits", own, even));
    }
    (!words.is_empty()).then(|| format!("{}: {}", clip.take.name, words.join(", ")))
}

/// A clip whose worst koma stays far off however many keys are asked for: with twice as many it is no
/// better than so many times the least there is with as many as found.
fn gap(clip: &Judged<'_>) -> Option<String> {
    let found = &clip.found;
    let double = *found.counts().get(2)?;
    let [own, twice] = [found.own_keys, double].map(|count| found.row(Method::Own, count));
    let (own, twice) = (own?, twice?);
    let least = found.row(Method::OptimalWorst, found.own_keys)?.worst;
    (twice.worst > GAP * least).then(|| {
        let errors = [own.worst, twice.worst, least].map(|error| number(error, 2));
        let [own, twice, least] = errors;
        format!(
            "{}: {own} as found, {twice} with double, where {least} is the least as found",
            clip.take.name
        )
    })
}

fn list(items: impl Iterator<Item = String>) -> String {
    let items: Vec<String> = items.map(|item| format!("- {item}\n")).collect();
    if items.is_empty() { "- none\n".into() } else { items.concat() }
}
