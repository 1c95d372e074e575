//! The actions found in each clip by default.

use genga::keys::SplitReason;

use crate::table::{Table, number};
use crate::takes::Take;

/// A table with one row per clip.
pub(crate) fn table(takes: &[Take]) -> String {
    let mut table = Table::new(&[
        "clip",
        ">seconds",
        ">actions",
        ">shortest, s",
        ">longest, s",
        "begins in a rest, frame",
        "begins in a lull, frame",
        "begins with a change, frame",
    ]);
    for take in takes {
        let actions = &take.default().actions;
        let fps = take.clip.rate().fps();
        let seconds = || actions.iter().map(|action| (action.past.0 - action.from.0) as f64 / fps);
        let begins = |why| {
            let of_that = actions.splits().iter().filter(|split| split.why == why);
            let frames: Vec<_> = of_that.map(|split| split.frame.to_string()).collect();
            if frames.is_empty() { "–".into() } else { frames.join(" ") }
        };
        table.row(&[
            take.name.clone(),
            number(take.clip.len() as f64 / fps, 1),
            actions.iter().count().to_string(),
            number(seconds().fold(f64::INFINITY, f64::min), 1),
            number(seconds().fold(0.0, f64::max), 1),
            begins(SplitReason::Rest),
            begins(SplitReason::Lull),
            begins(SplitReason::Change),
        ]);
    }
    table.text()
}
