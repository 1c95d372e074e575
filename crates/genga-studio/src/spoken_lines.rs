//! Spoken lines (セリフ) on the sheet, each with the koma on which it is heard.

use super::document::Document;
use genga::edits::Speech;
use genga::sheet::{Sheet, SpokenLine};
use genga::time::Frame;

/// A spoken line, and where it is heard.
#[derive(Debug, Clone)]
pub(super) struct Spoken<'a> {
    pub(super) speech: &'a Speech,
    pub(super) line: SpokenLine,
    /// Its place among the lines heard at once, from 0, and the number of places side by side.
    pub(super) column: usize,
    pub(super) columns: usize,
}

/// Returns every spoken line of a document on a sheet, sorted by beginning. `last` is the clip's last frame.
pub(super) fn all<'a>(wanted: &'a Document, sheet: &Sheet, last: Frame) -> Vec<Spoken<'a>> {
    let (clock, length) = (sheet.clock, sheet.length());
    let heard = wanted.edits.speech.iter();
    let heard = heard.filter_map(|speech| Some((speech, speech.on_sheet(clock, last, length)?)));
    let mut heard: Vec<_> = heard.collect();
    heard.sort_by_key(|(_, line)| line.begin);
    let lines: Vec<SpokenLine> = heard.iter().map(|(_, line)| line.clone()).collect();
    let places = SpokenLine::side_by_side(&lines);
    let columns = places.iter().max().map_or(0, |last| last + 1);
    let spoken = heard.into_iter().zip(places);
    spoken.map(|((speech, line), column)| Spoken { speech, line, column, columns }).collect()
}
