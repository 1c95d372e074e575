//! Compares events that a person marked in the source with the nearest genga.

use std::fs;
use std::ops::Range;
use std::path::Path;

use genga::time::Clock;

use crate::Outcome;
use crate::table::{Table, percent, signed};
use crate::takes::{Run, Shown, Take, kept, named};

/// Largest distance in koma at which a genga hits an event.
const NEAR: usize = 1;

/// Sets of moments; other rows are rests.
const LISTED: [&str; 3] = ["chosen-with", "held-out", "run-second-reading"];

/// An event of `docs/lab/evidence/events.csv`, over `from..=to` source frames.
pub(crate) struct Event {
    pub(crate) clip: String,
    pub(crate) set: String,
    from: usize,
    to: usize,
    /// Kind of event; empty in the first list.
    pub(crate) kind: String,
}

/// Hits of the events of some clips.
#[derive(Default)]
pub(crate) struct Score {
    hits: usize,
    hits_with_ends: usize,
    events: usize,
    /// Expected share of hits if the events were anywhere.
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
    /// First and last koma of the event.
    pub(crate) fn koma(&self, clock: &Clock) -> [usize; 2] {
        [self.from, self.to].map(|frame| clock.koma_from_place(frame as f64))
    }

    /// Whether a genga on one of the given koma hits the event.
    pub(crate) fn is_hit_by(&self, genga: &[usize], clock: &Clock) -> bool {
        is_near(genga, self.koma(clock))
    }

    /// Share of the koma in a range at which an event of the same length would be hit.
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

/// Reads the events of a file, in its order.
pub(crate) fn read(path: &Path) -> Outcome<Vec<Event>> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let bytes = fs::read(path).map_err(|error| failed(&error))?;
    let mut events = Vec::new();
    for row in csv::Reader::from_reader(bytes.as_slice()).deserialize() {
        let (clip, set, from, to, kind, _what): (String, String, usize, usize, String, String) =
            row.map_err(|error| failed(&error))?;
        if from > to {
            return Err(failed(&format!("{clip}: {from} to {to} is no range")).into());
        }
        events.push(Event { clip, set, from, to, kind });
    }
    Ok(events)
}

/// Koma from an event to a genga: negative before it, positive after it, 0 within it.
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

/// Share of all places in the clip at which an event of the same length would be hit.
fn chance(run: &Run, genga: &[Shown], [from, to]: [usize; 2]) -> f64 {
    let places = run.sheet.length().saturating_sub(to - from);
    let hits = (0..places).filter(|place| is_hit(genga, [*place, place + to - from])).count();
    hits as f64 / places as f64
}

/// Clips and sets in the order of the file, without the rests.
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

/// The score of a merge over the events selected by `asked`.
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

/// A table with one row per clip and set with the defaults, then both sets as a whole.
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

/// A table of the genga or end nearest to the begin and to the end of each rest.
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
