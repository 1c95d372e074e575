//! Keys of somebody else, against which a sheet is judged.

use crate::deliver::sheet_json;
use crate::error::Error;
use crate::sheet::Role;
use crate::time::Frame;

/// Columns that say which frame a row is of, the first that a table has.
const FRAMES: [&str; 2] = ["source_frame", "frame"];

/// Reads reference keys, source frames as the clip numbers them, from any of: a `sheet.json`, whose
/// genga they are; a table as `genga keys` writes it, or any CSV with a column `frame` or
/// `source_frame`, of which the rows with a `role` other than genga do not count; a list of frames, one
/// a line, in which `#` begins a comment.
///
/// They come sorted, each once. A fractional frame counts as the nearest.
///
/// # Errors
/// [`Error::Sheet`] with line and column where a frame is no number, where there is no such column, and
/// where there is no key at all.
pub fn reference_keys(bytes: &[u8]) -> Result<Vec<Frame>, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|_| {
        Error::sheet("this is not text in UTF-8; keys are a sheet.json, a CSV or a list of frames")
    })?;
    let mut frames = match text.trim_start().chars().next() {
        Some('{') => of_sheet(bytes)?,
        Some(letter) if letter.is_ascii_digit() || letter == '#' => listed(text)?,
        Some(_) => of_table(text)?,
        None => Vec::new(),
    };
    if frames.is_empty() {
        return Err(Error::sheet("there is no key in it"));
    }
    frames.sort_unstable();
    frames.dedup();
    Ok(frames)
}

fn of_sheet(bytes: &[u8]) -> Result<Vec<Frame>, Error> {
    let sheet = sheet_json::read(bytes)?.sheet;
    let drawings = sheet.layers.iter().take(1).flat_map(|layer| layer.shown());
    let genga = drawings.filter(|drawing| drawing.role == Role::Genga);
    Ok(genga.map(|drawing| Frame(drawing.source.place().round() as usize)).collect())
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

fn of_table(text: &str) -> Result<Vec<Frame>, Error> {
    let mut table =
        csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_reader(text.as_bytes());
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
        let line = row.position().map_or(1, |place| place.line() as usize);
        let is_key = role.and_then(|at| row.get(at)).is_none_or(|role| role == Role::Genga.word());
        if is_key {
            let text = row.get(at).unwrap_or_default();
            frames.push(frame(text).ok_or_else(|| no_frame(line, at + 1, text))?);
        }
    }
    Ok(frames)
}

fn frame(text: &str) -> Option<Frame> {
    // A number that large is no frame of anything, and would be no exact whole number either.
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

    fn keys(text: &str) -> Vec<usize> {
        reference_keys(text.as_bytes()).unwrap().into_iter().map(|frame| frame.0).collect()
    }

    fn refused(text: &str) -> String {
        reference_keys(text.as_bytes()).unwrap_err().to_string()
    }

    #[test]
    fn a_list_is_one_frame_a_line() {
        assert_eq!(keys("# by hand\n12\n150  # wrist\n\n40.6\r\n12\n"), [12, 41, 150]);
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
        assert!(refused("koma,drawing\n1,2\n").contains("begins with koma, drawing"));
    }

    #[test]
    fn nothing_is_no_reference() {
        for nothing in ["", "  \n", "# none\n", "frame\n", "role,frame\nend,0\n"] {
            assert_eq!(refused(nothing), "there is no key in it", "{nothing:?}");
        }
        assert!(reference_keys(&[0xff, 0xfe, 0x31]).unwrap_err().to_string().contains("UTF-8"));
        assert!(refused("{\"schema\": \"other\"}").contains("schema"));
    }
}
