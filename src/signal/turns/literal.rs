//! Finds turns by the paper's words: the signs of the two steps around a frame, and the frames that follow.

use std::cmp::Ordering::{Equal, Greater, Less};

use super::{Scan, Side, Turn, TurnKind};

/// Finds every candidate by the table of [KT11 §3.3, §3.4], exactly where it stands.
pub(super) fn turns(scan: &Scan, turns: &mut Vec<Turn>) {
    for row in 1..=scan.frames - 2 {
        let kind = match (scan.signs[row - 1], scan.signs[row]) {
            (Less, Greater) | (Equal, Greater) | (Less, Equal) => TurnKind::Key,
            (Greater, Less) | (Greater, Equal) => TurnKind::Wall,
            _ => continue,
        };
        let after = scan.persistence.after(kind, row);
        let confirmed_for = match scan.finder.side {
            Side::After | Side::Rising => after,
            Side::Both => after.min(scan.persistence.before(kind, row)),
        };
        turns.push(scan.turn(row, kind, confirmed_for));
    }
}
