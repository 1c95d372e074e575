//! `docs/lab/quality.md`: compares the program's keys with other methods, and its sheets with their sources.

use std::slice::from_ref;

use genga::keys::with_ends;
use genga::signal::{ContactFinder, Limb};
use genga_files::{CurveErrors, Curves};
use genga_lab::quality::baselines::{Objective, Optimal, Segments};
use genga_lab::quality::{Compare, Comparison, Evaluation, KomaFrames, Method, Row};

use crate::Outcome;
use crate::on_screen;
use crate::part::Part;
use crate::table::{Table, number, spread};
use crate::takes::Take;

/// Target for the mean error at an equal number of keys, as a multiple of the optimum.
const ASKED: f64 = 1.25;

/// Target for the worst koma with double as many keys, as a multiple of the optimum with as many keys as found.
const GAP: f64 = 1.25;

/// A clip and its comparison.
struct Judged<'a> {
    take: &'a Take,
    found: Comparison,
}

/// A named measure of a row.
type Measure = (&'static str, fn(&Row) -> Option<f64>);

/// The measures of the summary.
const MEASURES: [Measure; 5] = [
    ("mean-error", |row| row.mean_ratio),
    ("worst-error", |row| row.worst_ratio),
    ("hits", |row| row.hits),
    ("by-chance", |row| row.by_chance),
    ("steady", |row| row.steady),
];

/// Makes the whole page.
pub(crate) fn from_takes(takes: &[Take]) -> Outcome<Part> {
    let judge = |take| {
        let take: &Take = take;
        Ok(Judged { take, found: Compare::default().run(take.clip.clone())? })
    };
    let judged = takes.iter().map(judge).collect::<Outcome<Vec<_>>>()?;
    let mut part = Part::default();
    part.table("counts", counts(&judged));
    part.table("mean-error", mean_errors(&judged));
    part.table("summary", summary(&judged));
    part.table("paces", paces(&judged));
    part.table("sheets", sheets(takes)?);
    part.table("curves", curves(takes)?);
    on_screen::add(takes, &mut part)?;
    part.text("blind", list(takes.iter().filter_map(blind)));
    part.number("clips", judged.len());
    verdicts(&judged, &mut part);
    Ok(part)
}

/// Returns the rows of a method at half the number of keys that the recipe finds (`which` 0), at that number (1) and at
/// double (2).
fn rows<'a>(
    judged: &'a [Judged<'a>],
    method: Method,
    which: usize,
) -> impl Iterator<Item = &'a Row> {
    judged.iter().filter_map(move |clip| {
        let count = *clip.found.counts().get(which)?;
        clip.found.row(method, count)
    })
}

/// A table of the number of keys and the error of the program's own.
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
        ]);
    }
    table
}

/// A table of the mean error for every clip and method, at as many keys as the recipe finds.
fn mean_errors(judged: &[Judged<'_>]) -> Table {
    let names = Method::ALL.map(|method| format!(">{method}"));
    let header: Vec<&str> = ["clip"].into_iter().chain(names.iter().map(String::as_str)).collect();
    let mut table = Table::new(&header);
    for clip in judged {
        let cells = Method::ALL.map(|method| {
            let ratio = as_found(clip, method).and_then(|row| row.mean_ratio);
            ratio.map_or("–".into(), |ratio| number(ratio, 2))
        });
        table.row(&[from_ref(&clip.take.name), &cells[..]].concat());
    }
    table
}

/// A table of medians over the clips at half, equal and double the number of keys.
fn summary(judged: &[Judged<'_>]) -> Table {
    let header = ["keys", "method", ">× mean", ">× worst", ">hits", ">by chance", ">steady"];
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

/// A table of keys with curves beside as many keys with straight lines between them, over the clips. Those are the best
/// of all sets for the worst koma, as Salient Poses finds them.
fn curves(takes: &[Take]) -> Outcome<Table> {
    let mut values: [Vec<f64>; 5] = Default::default();
    for take in takes {
        let sheet = &take.runs[0].sheet;
        let found = Curves::default().errors(&take.clip, sheet)?;
        let grid = KomaFrames::new(take.clip.clone().into(), sheet.clock);
        if grid.reference.koma() > Compare::default().longest {
            continue;
        }
        let best = Optimal::new(&Segments::new(&grid), Objective::Worst, found.keys - 2);
        let inner = grid.frames_at(&best.keys(found.keys - 2));
        let lines = CurveErrors::from_lines(&take.clip, &with_ends(&take.clip, &inner));
        let genga = (found.keys - found.added) as f64;
        let shares = [found.mean, found.largest, lines.mean, lines.largest];
        let row = [found.keys as f64 / genga].into_iter().chain(shares.map(|share| 100.0 * share));
        values.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
    }
    let header = ["clips", ">keys a genga", ">mean", ">largest", ">lines: mean", ">largest"];
    let mut table = Table::new(&header);
    let spreads = values.map(spread);
    for (at, name) in ["least", "median", "most"].into_iter().enumerate() {
        let cells = spreads.iter().map(|of| number(of[at], 2));
        table.row(&[name.to_owned()].into_iter().chain(cells).collect::<Vec<_>>());
    }
    Ok(table)
}

/// A table of keys on threes and on twos, medians over the clips.
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
    let values: Vec<f64> = rows(judged, method, which).filter_map(measure).collect();
    (!values.is_empty()).then(|| spread(values)[1])
}

/// A table of the measures of the default sheets.
fn sheets(takes: &[Take]) -> Outcome<Table> {
    let header = [
        "clip",
        ">drawings/s",
        ">shown mean",
        ">worst",
        ">contacts",
        ">keys slip",
        ">in source",
        ">shown slip",
        ">in source",
        ">pops",
        ">holds",
        ">worst pop",
    ];
    let mut table = Table::new(&header);
    for take in takes {
        let found = Evaluation::new(&take.clip, &take.default().sheet, None, 1.0)?;
        let two = |value: f64| number(value, 2);
        let some = |value: Option<f64>| value.map_or("–".into(), two);
        table.row(&[
            take.name.clone(),
            number(found.pace.drawings_per_second, 1),
            two(found.shown.mean),
            two(found.shown.worst),
            found.shown_slip.contacts.to_string(),
            some(found.keys_slip.mean),
            some(found.keys_slip.source),
            some(found.shown_slip.mean),
            some(found.shown_slip.source),
            found.pops.pops.len().to_string(),
            found.pops.holds.to_string(),
            found.pops.worst().map_or("–".into(), |pop| number(pop.times, 1)),
        ]);
    }
    Ok(table)
}

/// A clip is blind if no foot is seen standing for more than this share of it.
const BLIND: f64 = 0.4;

/// Describes a clip on which no foot is seen standing for long, with the range; `None` for other clips.
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

/// Lists the clips on which the program's own keys lead and those on which they do not, and adds numbers for the prose.
fn verdicts(judged: &[Judged<'_>], part: &mut Part) {
    let ratios = rows(judged, Method::Own, 1).filter_map(|row| row.mean_ratio);
    part.number("asked", number(ASKED, 2));
    part.number("gap", number(GAP, 2));
    part.number("within", ratios.filter(|ratio| *ratio <= ASKED).count());
    let leads = |clip: &&Judged<'_>| behind(clip).is_none();
    part.number("leads", judged.iter().filter(leads).count());
    part.text("behind", list(judged.iter().filter_map(behind)));
    part.text("even", list(judged.iter().filter_map(even)));
    part.text("gaps", list(judged.iter().filter_map(gap)));
    let searched = |clip: &&Judged<'_>| {
        let row = as_found(clip, Method::OptimalMean);
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

/// Describes a clip on which another method hits more of the moments at which the body turns; `None` for other clips.
fn behind(clip: &Judged<'_>) -> Option<String> {
    let own = as_found(clip, Method::Own)?.hits?;
    let others = Method::ALL.into_iter().filter_map(|method| {
        Some((method, as_found(clip, method)?.hits?)).filter(|(_, hits)| *hits > own)
    });
    let (method, hits) = others.reduce(|a, b| if b.1 > a.1 { b } else { a })?;
    let name = &clip.take.name;
    Some(format!("{name} ({} against {} of {method})", number(own, 2), number(hits, 2)))
}

/// Describes a clip on which evenly spaced keys do as well as the program's own or better; `None` for other clips.
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

/// Describes a clip whose worst koma stays far off however many keys are asked for: with twice as many keys it still
/// exceeds [`GAP`] times the optimum with as many as found.
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
