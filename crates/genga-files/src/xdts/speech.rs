//! The S column (セリフ) of a time table: speaker and words on the first koma of a line, then a continuation sign on
//! every further koma. The CAMERA column has only words.

use super::file::{Datum, Entry, Field, Names, Track};
use super::{BLANK, CAMERA, CONTINUED, SPEECH};
use genga::sheet::{CameraWork, SpokenLine};

/// The dialogue field and the names of its columns; `None` if there is no dialogue.
pub(super) fn field(lines: &[SpokenLine]) -> Option<(Field, Names)> {
    let values = |line: &SpokenLine| vec![line.speaker.clone(), line.words.clone()];
    side_by_side(lines, (SPEECH, "S"), values)
}

/// The field of camera work and the names of its columns; `None` if there is none.
pub(super) fn camera_field(camera: &[CameraWork]) -> Option<(Field, Names)> {
    let lines: Vec<SpokenLine> = camera.iter().map(CameraWork::line).collect();
    side_by_side(&lines, (CAMERA, "CAM"), |line| vec![line.words.clone()])
}

/// A field with a track for each column of simultaneous lines, named by a word and a number.
fn side_by_side(
    lines: &[SpokenLine],
    (field_id, word): (u32, &str),
    values: impl Fn(&SpokenLine) -> Vec<String>,
) -> Option<(Field, Names)> {
    let columns = SpokenLine::side_by_side(lines);
    let count = columns.iter().max()? + 1;
    let track = |track_no| {
        let own = lines.iter().zip(&columns).filter(|(_, column)| **column == track_no);
        Track { frames: own.flat_map(|(line, _)| entries(line, values(line))).collect(), track_no }
    };
    let names = (1..=count).map(|number| format!("{word}{number}")).collect();
    let field = Field { field_id, tracks: (0..count).map(track).collect() };
    Some((field, Names { field_id, names }))
}

fn entries(line: &SpokenLine, values: Vec<String>) -> impl Iterator<Item = Entry> {
    let entry = |koma: usize, values: Vec<String>| Entry {
        data: vec![Datum { id: 0, options: vec![], values }],
        frame: koma as i64,
    };
    let first = entry(line.begin, values);
    let further = line.begin + 1..line.past();
    [first].into_iter().chain(further.map(move |koma| entry(koma, vec![CONTINUED.into()])))
}

/// The dialogue of all columns within `length` koma, ordered by first koma.
pub(super) fn lines(fields: &[Field], length: usize) -> Vec<SpokenLine> {
    let fields = fields.iter().filter(|field| field.field_id == SPEECH);
    let tracks = fields.flat_map(|field| &field.tracks);
    let mut lines: Vec<SpokenLine> = tracks.flat_map(|track| of_track(track, length)).collect();
    lines.sort_by_key(|line| line.begin);
    lines
}

fn of_track(track: &Track, length: usize) -> Vec<SpokenLine> {
    let mut entries: Vec<&Entry> = track.frames.iter().collect();
    entries.sort_by_key(|entry| entry.frame);
    let mut lines: Vec<SpokenLine> = Vec::new();
    // Whether a continuation sign may extend the last line.
    let mut goes_on = false;
    for entry in entries {
        let Some(koma) = usize::try_from(entry.frame).ok().filter(|koma| *koma < length) else {
            continue;
        };
        match spoken(&entry.data[0].values) {
            Said::Continued => {
                if let Some(last) = lines.last_mut().filter(|_| goes_on) {
                    last.koma = koma + 1 - last.begin;
                }
            }
            Said::Nothing => goes_on = false,
            Said::Words(speaker, words) => {
                goes_on = true;
                let (speaker, words) = (speaker.to_owned(), words.to_owned());
                lines.pop_if(|last| last.begin == koma);
                lines.push(SpokenLine { begin: koma, koma: 1, speaker, words });
            }
        }
    }
    lines
}

/// The content of an entry of the S column.
enum Said<'a> {
    /// Speaker, possibly empty, and words.
    Words(&'a str, &'a str),
    Continued,
    Nothing,
}

fn spoken(values: &[String]) -> Said<'_> {
    match values {
        [sign, ..] if sign == CONTINUED => Said::Continued,
        [sign, ..] if sign == BLANK => Said::Nothing,
        [speaker, words, ..] if !words.trim().is_empty() => Said::Words(speaker, words),
        [words, ..] if !words.trim().is_empty() => Said::Words("", words),
        _ => Said::Nothing,
    }
}
