//! Draws the genga of a clip as poses in a row.

use genga_plot::PoseRow;

use crate::Outcome;
use crate::takes::{Take, kept, named};

/// Picture names and their clips.
pub(crate) const PICTURES: [(&str, &str); 3] = [
    ("kick", "cmu-11_01-soccer-kick"),
    ("run", "cmu-09_01-run"),
    ("jump", "cmu-02_04-jump-balance"),
];

/// Draws the genga and both ends of a clip, numbered together as in the key table.
pub(crate) fn draw(takes: &[Take], clip: &str) -> Outcome<String> {
    let take = named(takes, clip)?;
    let kept = kept(&take.default().sheet);
    let label = |at: usize, koma: usize| format!("{} · koma {}", at + 1, koma + 1);
    let poses = kept.iter().enumerate();
    let poses: Vec<_> =
        poses.map(|(at, shown)| (shown.place, label(at, shown.koma), shown.role)).collect();
    Ok(PoseRow::default().draw(&take.clip, &poses)?)
}
