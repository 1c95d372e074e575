//! Reference keys (another person's or program's), against which a sheet is judged.

use crate::sheet_json;
use crate::table::table_reader;
use genga::error::Error;
use genga::motion::Clip;
use genga::sheet::Role;
use genga::time::Frame;
use genga_read::{is_vmd, vmd_key_frames};

/// Frames per second of every VMD.
const VMD_RATE: f64 = 30.0;

/// Share of keyed frames from which a motion counts as captured or baked: no animator sets so many keys.
const BAKED: f64 = 0.8;

/// Length in frames below which a motion may have a key on every frame.
const SHORT: u32 = 12;

/// Names of the frame column, in order of preference.
const FRAMES: [&str; 2] = ["source_frame", "frame"];

/// Reads reference keys as source frames in the clip's numbering. Accepts:
///
/// - a `sheet.json`, whose genga are the keys;
/// - a table as `genga keys` writes it, or any CSV with a column `frame` or `source_frame`; rows whose
///   `role` is not genga are skipped, and fields may be separated by semicolons or tabs too;
/// - a list of frames, one per line, in which `#` begins a comment; a table may have such lines before its header;
/// - an MMD motion (.vmd): the frames on which a bone of the body has a key. It runs at 30 frames per second,
///   and its frame 0 is the first frame of the `clip`.
///
/// Returns the frames sorted; a list or table keeps those that it repeats. A fractional frame counts as the nearest one.
///
/// # Errors
/// [`Error::Sheet`] with line and column if a frame is not a number; without a place if the table lacks a frame
/// column or the input contains no key.
pub fn reference_keys(bytes: &[u8], clip: &Clip) -> Result<Vec<Frame>, Error> {
    if is_vmd(bytes) {
        return of_vmd(bytes, clip);
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::sheet("this is not text in UTF-8; keys are a sheet.json, a CSV or a list of frames")
    })?;
    let lead: usize =
        text.split_inclusive('\n').take_while(|line| is_comment(line)).map(str::len).sum();
    let (lead, rest) = text.split_at(lead);
    let mut frames = match rest.trim_start().chars().next() {
        Some('{') => of_sheet(bytes)?,
        Some(letter) if letter.is_ascii_digit() => listed(text)?,
        Some(_) => of_table(rest, lead.lines().count())?,
        None => Vec::new(),
    };
    if frames.is_empty() {
        return Err(Error::sheet("there is no key in it"));
    }
    frames.sort_unstable();
    Ok(frames)
}

/// Reads an animator's keys. Rejects a motion keyed on nearly every frame, because it was captured or baked.
fn of_vmd(bytes: &[u8], clip: &Clip) -> Result<Vec<Frame>, Error> {
    let keyed = vmd_key_frames(bytes)?;
    let span = keyed.last().zip(keyed.first()).map_or(0, |(last, first)| last - first + 1);
    if span >= SHORT && keyed.len() as f64 >= BAKED * f64::from(span) {
        return Err(Error::sheet(format!(
            "{} of its {span} frames have a key: it was captured or baked, and an animator's keys are not in it",
            keyed.len()
        )));
    }
    let since = |frame: u32| (f64::from(frame) * clip.rate().fps() / VMD_RATE).round() as usize;
    let in_clip = |frame: u32| Frame(clip.first().0 + since(frame));
    let mut frames: Vec<Frame> = keyed.into_iter().map(in_clip).collect();
    frames.dedup();
    if frames.is_empty() {
        return Err(Error::sheet("there is no key in it"));
    }
    Ok(frames)
}

fn of_sheet(bytes: &[u8]) -> Result<Vec<Frame>, Error> {
    let sheet = sheet_json::read(bytes)?.sheet;
    let drawings = sheet.layers.iter().take(1).flat_map(|layer| layer.shown());
    let genga = drawings.filter(|drawing| drawing.role == Role::Genga);
    let mut frames: Vec<Frame> =
        genga.map(|drawing| Frame(drawing.source.place().round() as usize)).collect();
    // Below the rate of the sheet several koma share a frame.
    frames.dedup();
    Ok(frames)
}

fn listed(text: &str) -> Result<Vec<Frame>, Error> {
    let lines = text
        .lines()
        .enumerate()
        .map(|(line, text)| (line + 1, text.split('#').next().unwrap_or_default().trim()));
    lines
        .filter(|(_, text)| !text.is_empty())
        .map(|(line, text)| frame(text).ok_or_else(|| no_frame(line, 1, text)))
        .collect()
}

/// Whether a line has nothing but a comment.
fn is_comment(line: &str) -> bool {
    let line = line.trim();
    line.is_empty() || line.starts_with('#')
}

/// Reads a table, which some `lines` of its file precede.
fn of_table(text: &str, lines: usize) -> Result<Vec<Frame>, Error> {
    let mut table = table_reader(text);
    let failed = |error: csv::Error| Error::sheet(format!("this is no table: {error}"));
    let header = table.headers().map_err(failed)?.clone();
    let column = |name: &str| header.iter().position(|other| other.eq_ignore_ascii_case(name));
    let Some(at) = FRAMES.iter().find_map(|name| column(name)) else {
        let found: Vec<&str> = header.iter().take(6).collect();
        return Err(Error::sheet(format!(
            "the table has no column frame or source_frame; it begins with {}",
            found.join(", ")
        )));
    };
    let role = column("role");
    let mut frames = Vec::new();
    for row in table.records() {
        let row = row.map_err(failed)?;
        let line = lines + row.position().map_or(1, |place| place.line() as usize);
        let is_key = role.and_then(|at| row.get(at)).is_none_or(|role| role == Role::Genga.word());
        if is_key {
            let text = row.get(at).unwrap_or_default();
            frames.push(frame(text).ok_or_else(|| no_frame(line, at + 1, text))?);
        }
    }
    Ok(frames)
}

fn frame(text: &str) -> Option<Frame> {
    // Larger numbers are not frames of any clip, and f64 could not hold them exactly.
    let is_frame = |place: &f64| (0.0..1e15).contains(place);
    text.parse::<f64>().ok().filter(is_frame).map(|place| Frame(place.round() as usize))
}

fn no_frame(line: usize, column: usize, text: &str) -> Error {
    let message = format!("expected the number of a source frame, found \"{text}\"");
    Error::sheet_at((line, column), message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{VmdKey, VmdMotion};
    use genga::motion::Skeleton;
    use genga::time::FrameRate;

    /// A clip at 24 frames per second.
    fn clip(first: usize) -> Clip {
        let rate = FrameRate::new(24.0).unwrap();
        Clip::new(Skeleton::default(), rate, Frame(first), 60, vec![]).unwrap()
    }

    fn keys(text: &str) -> Vec<usize> {
        reference_keys(text.as_bytes(), &clip(0))
            .unwrap()
            .into_iter()
            .map(|frame| frame.0)
            .collect()
    }

    fn refused(text: &str) -> String {
        reference_keys(text.as_bytes(), &clip(0)).unwrap_err().to_string()
    }

    #[test]
    fn a_list_is_one_frame_a_line() {
        assert_eq!(keys("# by hand\n12\n150  # wrist\n\n40.6\r\n12\n"), [12, 12, 41, 150]);
        assert_eq!(
            refused("12\nabout 40\n"),
            "2:1: expected the number of a source frame, found \"about 40\""
        );
        assert!(refused("12\n-4").starts_with("2:1: "));
        assert!(refused("12\nnan").starts_with("2:1: "));
    }

    #[test]
    fn of_a_table_the_genga_count_where_it_has_roles() {
        assert_eq!(keys("\u{feff}frame,why\n30,a\n10,\"b, c\"\n"), [10, 30]);
        let table = "role,source_frame\nend,0\ngenga,20\ngenga,45.5\ninbetween,60\nend,90\n";
        assert_eq!(keys(table), [20, 46]);
        assert_eq!(
            refused("name,frame\na,1\nb,x\n"),
            "3:2: expected the number of a source frame, found \"x\""
        );
        for parted_by in [";", "\t"] {
            assert_eq!(keys(&table.replace(',', parted_by)), [20, 46], "{parted_by:?}");
        }
        let commented =
            "# Dragon stand, 31 frames\n\nframe\tbones keyed (of 8 moving)\n0\t8\n12\t2\n";
        assert_eq!(keys(commented), [0, 12]);
        assert!(refused(&commented.replace("12", "x")).starts_with("5:1: "));
        assert!(refused("koma,drawing\n1,2\n").contains("begins with koma, drawing"));
    }

    /// An MMD motion with keys of the head on the given frames.
    fn vmd(frames: impl Iterator<Item = u32>) -> Vec<u8> {
        let key = |frame| VmdKey {
            bone: "頭".into(),
            frame,
            translation: [0.0; 3],
            rotation: [0.0, 0.0, 0.0, 1.0],
            curves: [[20, 20, 107, 107]; 4],
        };
        let keys = frames.map(key).collect();
        let (faces, shown) = (vec![], vec![]);
        VmdMotion { model: "人形".into(), keys, ik_on: vec![], ik_off: vec![], faces, shown }
            .bytes()
            .unwrap()
    }

    #[test]
    fn keyed_frames_of_an_mmd_motion_are_keys_in_the_clips_own_frames() {
        let animated = vmd([0, 10, 30, 55].into_iter());
        let found = |first: usize| reference_keys(&animated, &clip(first)).unwrap();
        assert_eq!(found(0), [0, 8, 24, 44].map(Frame));
        assert_eq!(found(5), [5, 13, 29, 49].map(Frame), "it begins where the clip does");
        let baked = reference_keys(&vmd(0..40), &clip(0)).unwrap_err().to_string();
        assert!(baked.starts_with("40 of its 40 frames have a key"), "{baked}");
    }

    #[test]
    fn nothing_is_no_reference() {
        for nothing in ["", "  \n", "# none\n", "frame\n", "role,frame\nend,0\n"] {
            assert_eq!(refused(nothing), "there is no key in it", "{nothing:?}");
        }
        assert!(
            reference_keys(&[0xff, 0xfe, 0x31], &clip(0))
                .unwrap_err()
                .to_string()
                .contains("UTF-8")
        );
        assert!(refused("{\"schema\": \"other\"}").contains("schema"));
    }
}
