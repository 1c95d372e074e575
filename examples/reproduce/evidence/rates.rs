//! Drawing rates of every clip, and of the merges compared.

use crate::Outcome;
use crate::evidence::events::{self, Event};
use crate::evidence::rigs;
use crate::table::{Table, number, percent, spread};
use crate::takes::{MERGES, Take};

/// A table with one row per clip with the defaults, and the spread at the bottom.
pub(crate) fn table(takes: &[Take]) -> String {
    let mut table = Table::new(&[
        "clip",
        ">fps",
        ">frames",
        ">lead-in frames left out",
        ">koma",
        ">genga",
        ">genga/s",
        ">drawings",
        ">drawings/s",
        ">longest hold",
        ">naka-nashi done/asked",
        ">koma-dori done/asked",
    ]);
    for take in takes {
        let report = &take.default().report;
        let omission = &report.omission;
        table.row(&[
            take.name.clone(),
            report.frame_rate.to_string(),
            report.frames.to_string(),
            take.lead_in.to_string(),
            report.koma.to_string(),
            report.genga.to_string(),
            number(report.genga_per_second, 1),
            report.drawings.to_string(),
            number(report.drawings_per_second, 1),
            report.longest_hold.to_string(),
            format!("{}/{}", omission.naka_nashi_done, omission.naka_nashi_asked),
            format!("{}/{}", omission.koma_dori_done, omission.koma_dori_asked),
        ]);
    }
    let genga = spread(takes.iter().map(|take| take.default().report.genga_per_second));
    let drawings = spread(takes.iter().map(|take| take.default().report.drawings_per_second));
    let mut spreads = Table::new(&["", ">least", ">median", ">most"]);
    for (name, values) in [("genga/s", genga), ("drawings/s", drawings)] {
        let [least, median, most] = values.map(|value| number(value, 1));
        spreads.row(&[name.into(), least, median, most]);
    }
    format!("{}\n{}", table.text(), spreads.text())
}

/// A table with one row per merge: events found, rate on all clips, steadiness between two rigs.
pub(crate) fn merges(takes: &[Take], events: &[Event]) -> Outcome<String> {
    let mut table = Table::new(&[
        "`keys.merge`",
        ">chosen-with",
        ">held-out",
        ">chance, held-out",
        ">genga/s least",
        ">median",
        ">most",
        ">F1 of two rigs, ±1 koma",
    ]);
    for merge in MERGES {
        let chosen = events::score(takes, events, merge, |event| event.set == "chosen-with")?;
        let held_out = events::score(takes, events, merge, |event| event.set == "held-out")?;
        let rates = spread(takes.iter().map(|take| take.merged(merge).report.genga_per_second));
        let [least, median, most] = rates.map(|value| number(value, 1));
        table.row(&[
            merge.into(),
            chosen.hits_and_share(),
            held_out.hits_and_share(),
            percent(held_out.chance),
            least,
            median,
            most,
            number(rigs::f1(takes, merge, 1.0)?, 2),
        ]);
    }
    Ok(table.text())
}
