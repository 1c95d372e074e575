//! Events that an eye marked in the source, and the genga nearest to them.

use std::fmt::Write;
use std::fs;
use std::ops::Range;
use std::path::Path;

use genga::time::Clock;

use crate::Outcome;
use crate::table::{Table, percent, signed};
use crate::takes::{Run, Shown, Take, kept, named};

/// How far a genga may stand from an event, in koma.
const NEAR: usize = 1;

/// The sets of which every event is listed.
const LISTED: [&str; 3] = ["chosen-with", "held-out", "run-second-reading"];

/// An event of `docs/evidence/events.csv`: it is over `from..=to`, source frames.
pub(crate) struct Event {
    pub(crate) clip: String,
    pub(crate) set: String,
    from: usize,
    to: usize,
    /// What kind of event it is; nothing in the first list.
    pub(crate) kind: String,
    what: String,
}

/// How many events of some clips were hit.
#[derive(Default)]
pub(crate) struct Score {
    hits: usize,
    hits_with_ends: usize,
    events: usize,
    /// The share of hits were the events anywhere.
    pub(crate) chance: f64,
}

impl Score {
    pub(crate) fn hits_and_share(&self) -> String {
        format!("{}/{} = {}", self.hits, self.events, percent(self.share()))
    }

    fn share(&self) -> f64 {
        self.hits as f64 / self.events as f64
    }
}

impl Event {
    /// The first and the last koma of the event.
    pub(crate) fn koma(&self, clock: &Clock) -> [usize; 2] {
        [self.from, self.to].map(|frame| clock.koma_from_place(frame as f64))
    }

    /// Whether a genga on one of some koma hits it.
    pub(crate) fn is_hit_by(&self, genga: &[usize], clock: &Clock) -> bool {
        is_near(genga, self.koma(clock))
    }

    /// The share of some koma, from one up to another, at which an event as long would be hit.
    pub(crate) fn chance_among(&self, genga: &[usize], clock: &Clock, koma: Range<usize>) -> f64 {
        let [from, to] = self.koma(clock);
        let places = koma.start..koma.end.saturating_sub(to - from);
        let count = places.len().max(1) as f64;
        places.filter(|place| is_near(genga, [*place, place + to - from])).count() as f64 / count
    }

    fn frames(&self) -> String {
        if self.from == self.to {
            self.from.to_string()
        } else {
            format!("{}–{}", self.from, self.to)
        }
    }
}

/// The events of a file, in its order.
pub(crate) fn read(path: &Path) -> Outcome<Vec<Event>> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let bytes = fs::read(path).map_err(|error| failed(&error))?;
    let mut events = Vec::new();
    for row in csv::Reader::from_reader(bytes.as_slice()).deserialize() {
        let (clip, set, from, to, kind, what): (String, String, usize, usize, String, String) =
            row.map_err(|error| failed(&error))?;
        if from > to {
            return Err(failed(&format!("{clip}: {from} to {to} is no range")).into());
        }
        events.push(Event { clip, set, from, to, kind, what });
    }
    Ok(events)
}

/// Koma from an event to a genga: below 0 before it, above 0 after it, 0 in it.
fn apart(koma: usize, [from, to]: [usize; 2]) -> i64 {
    koma.saturating_sub(to) as i64 - from.saturating_sub(koma) as i64
}

fn nearest(genga: &[Shown], event: [usize; 2]) -> Option<(Shown, i64)> {
    let with_distance = genga.iter().map(|genga| (*genga, apart(genga.moment, event)));
    with_distance.min_by_key(|(_, apart)| apart.unsigned_abs())
}

fn is_hit(genga: &[Shown], event: [usize; 2]) -> bool {
    nearest(genga, event).is_some_and(|(_, apart)| apart.unsigned_abs() <= NEAR as u64)
}

fn is_near(genga: &[usize], event: [usize; 2]) -> bool {
    genga.iter().any(|koma| apart(*koma, event).unsigned_abs() <= NEAR as u64)
}

/// The share of all places in the clip at which an event as long as this one would be hit.
fn chance(run: &Run, genga: &[Shown], [from, to]: [usize; 2]) -> f64 {
    let places = run.sheet.length().saturating_sub(to - from);
    let hits = (0..places).filter(|place| is_hit(genga, [*place, place + to - from])).count();
    hits as f64 / places as f64
}

/// Clips and sets in the order of the file, the rests apart.
fn sets(events: &[Event]) -> Vec<(&str, &str)> {
    let mut sets: Vec<(&str, &str)> = Vec::new();
    for event in events.iter().filter(|event| LISTED.contains(&event.set.as_str())) {
        let set = (event.clip.as_str(), event.set.as_str());
        if !sets.contains(&set) {
            sets.push(set);
        }
    }
    sets
}

/// The score of a merge over the events that are asked for.
pub(crate) fn score(
    takes: &[Take],
    events: &[Event],
    merge: &str,
    asked: impl Fn(&Event) -> bool,
) -> Outcome<Score> {
    let mut score = Score::default();
    for event in events.iter().filter(|event| asked(event)) {
        let run = named(takes, &event.clip)?.merged(merge);
        let (genga, kept) = (run.genga(), kept(&run.sheet));
        let koma = event.koma(&run.sheet.clock);
        score.events += 1;
        score.hits += usize::from(is_hit(&genga, koma));
        score.hits_with_ends += usize::from(is_hit(&kept, koma));
        score.chance += chance(run, &genga, koma);
    }
    score.chance /= score.events as f64;
    Ok(score)
}

/// A row a clip and set with the defaults, then both sets as a whole.
pub(crate) fn summary(takes: &[Take], events: &[Event]) -> Outcome<String> {
    let mut table =
        Table::new(&["clip", "set", ">hits", ">share", ">chance", ">hits, ends counted too"]);
    let merge = takes.first().ok_or("no clip")?.default().merge;
    let mut row = |clip: &str, set: &str, score: &Score| {
        table.row(&[
            clip.into(),
            set.into(),
            format!("{}/{}", score.hits, score.events),
            percent(score.share()),
            percent(score.chance),
            format!("{}/{}", score.hits_with_ends, score.events),
        ]);
    };
    for (clip, set) in sets(events) {
        let asked = |event: &Event| event.clip == clip && event.set == set;
        row(clip, set, &score(takes, events, merge, asked)?);
    }
    for set in ["chosen-with", "held-out"] {
        let all = score(takes, events, merge, |event| event.set == set)?;
        row("**all**", set, &all);
    }
    Ok(table.text())
}

/// For each clip and set every event with the genga nearest to it.
pub(crate) fn lists(takes: &[Take], events: &[Event]) -> Outcome<String> {
    let mut text = String::new();
    for (clip, set) in sets(events) {
        let run = named(takes, clip)?.default();
        let genga = run.genga();
        let header = ["event", ">frame(s)", ">nearest genga's frame", ">koma apart", "hit"];
        let mut table = Table::new(&header);
        for event in events.iter().filter(|event| event.clip == clip && event.set == set) {
            let koma = event.koma(&run.sheet.clock);
            let (frame, distance) = nearest(&genga, koma)
                .map_or(("none".into(), "–".into()), |(genga, apart)| {
                    (genga.place.to_string(), signed(apart))
                });
            let hit = if is_hit(&genga, koma) { "yes" } else { "**no**" };
            table.row(&[event.what.clone(), event.frames(), frame, distance, hit.into()]);
        }
        writeln!(text, "### {clip}, {set}\n\n{}", table.text())?;
    }
    Ok(text)
}

/// For each rest the genga or end nearest to its begin and to its end.
pub(crate) fn rests(takes: &[Take], events: &[Event]) -> Outcome<String> {
    let mut table = Table::new(&[
        "clip",
        ">rest, frames",
        ">seconds",
        ">genga or end at its begin",
        ">koma apart",
        ">genga or end at its end",
        ">koma apart",
    ]);
    for event in events.iter().filter(|event| event.set == "rest") {
        let take = named(takes, &event.clip)?;
        let kept = kept(&take.default().sheet);
        let koma = event.koma(&take.default().sheet.clock);
        let mut row = vec![event.clip.clone(), event.frames()];
        row.push(format!("{:.2}", (event.to - event.from) as f64 / take.clip.rate().fps()));
        for koma in koma {
            let (shown, apart) = nearest(&kept, [koma, koma]).ok_or("a sheet without ends")?;
            row.extend([format!("{} ({})", shown.place, shown.role.word()), signed(apart)]);
        }
        table.row(&row);
    }
    Ok(table.text())
}
