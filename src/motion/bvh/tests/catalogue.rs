//! Tests every case of the catalogue in `docs/input.md`, by its number: the sample with one peculiarity.

mod skeleton; // the HIERARCHY part
mod table; // the MOTION part
mod text; // bytes, lines and names

use super::{clip, sample};
use crate::error::Warning;
use crate::motion::Clip;
use crate::motion::bvh::warnings::{self, AXIS_TWICE, POSES, ROOTS};
use crate::motion::bvh::{Options, Read, open, read, write};

/// A file and the expected result.
pub(super) struct Case {
    number: usize,
    pub(super) bytes: Vec<u8>,
    expected: Expected,
}

enum Expected {
    /// A clip without a warning.
    Accepted(fn(&Clip)),
    /// A clip with one warning.
    Warned(Warning, fn(&Clip)),
    /// An error at line and column.
    Refused((usize, usize), &'static str),
}

fn accepted(number: usize, bytes: impl Into<Vec<u8>>, check: fn(&Clip)) -> Case {
    Case { number, bytes: bytes.into(), expected: Expected::Accepted(check) }
}

fn warned(
    number: usize,
    bytes: impl Into<Vec<u8>>,
    place: (usize, usize),
    code: &'static str,
    message: &str,
    check: fn(&Clip),
) -> Case {
    let warning = Warning::at(place, code, message);
    Case { number, bytes: bytes.into(), expected: Expected::Warned(warning, check) }
}

fn refused(
    number: usize,
    bytes: impl Into<Vec<u8>>,
    place: (usize, usize),
    message: &'static str,
) -> Case {
    Case { number, bytes: bytes.into(), expected: Expected::Refused(place, message) }
}

/// Checks that the clip equals the plain sample.
fn same(read: &Clip) {
    assert_eq!(*read, clip(&sample()));
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = text::cases();
    cases.extend(skeleton::cases());
    cases.extend(table::cases());
    cases
}

#[test]
#[allow(clippy::print_stdout, reason = "shown when the test fails: the case and its text")]
fn every_case_is_read_as_the_catalogue_asks() {
    for Case { number, bytes, expected } in cases() {
        println!("case {number}: {}", String::from_utf8_lossy(&bytes));
        match (read(&bytes), expected) {
            (Ok(Read { clip, warnings, .. }), Expected::Accepted(check)) => {
                assert_eq!(warnings, [], "case {number}");
                check(&clip);
            }
            (Ok(Read { clip, warnings, .. }), Expected::Warned(warning, check)) => {
                assert_eq!(warnings, [warning], "case {number}");
                check(&clip);
            }
            (Err(error), Expected::Refused((line, column), message)) => {
                let expected = format!("{line}:{column}: {message}");
                assert_eq!(error.to_string(), expected, "case {number}");
            }
            (Ok(read), Expected::Refused(..)) => panic!("case {number} is accepted: {read:?}"),
            (Err(error), _) => panic!("case {number} is refused: {error}"),
        }
    }
}

#[test]
fn every_case_is_opened_as_it_is_read() {
    for Case { number, bytes, .. } in cases() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), &bytes).unwrap();
        // Compared as text, because NaN is not equal to itself.
        let opened = format!("{:?}", open(file.path()));
        assert_eq!(opened, format!("{:?}", read(&bytes)), "case {number}");
    }
}

#[test]
fn there_are_66_cases_and_the_documentation_tells_of_each() {
    let page = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/input.md");
    let page = std::fs::read_to_string(page).unwrap();
    let mut numbers: Vec<usize> = Vec::new();
    for Case { number, expected, .. } in cases() {
        numbers.push(number);
        let row = page.lines().find(|line| line.starts_with(&format!("| {number} | ")));
        let row = row.unwrap_or_else(|| panic!("case {number} is not in the table"));
        let word = match &expected {
            Expected::Accepted(_) => "accepted",
            Expected::Warned(warning, _) => warning.code,
            Expected::Refused(..) => "error",
        };
        assert!(row.contains(word), "{word} is not in {row}");
    }
    for code in warnings::ALL {
        assert!(page.contains(&format!("\n| `{code}` | ")), "{code}");
    }
    numbers.sort_unstable();
    numbers.dedup();
    assert_eq!(numbers, (1..=66).collect::<Vec<_>>());
}

#[test]
fn strict_makes_an_error_of_every_warning_at_its_place() {
    let strict = Options { strict: true, ..Options::default() };
    for Case { number, bytes, expected } in cases() {
        let read = strict.read(&bytes);
        match expected {
            Expected::Accepted(_) => assert!(read.is_ok(), "case {number}"),
            Expected::Refused(..) => assert!(read.is_err(), "case {number}"),
            Expected::Warned(warning, _) => {
                let error = read.expect_err("a warning");
                assert_eq!(error.to_string(), warning.to_string(), "case {number}");
                assert_eq!(error.position(), warning.place, "case {number}");
            }
        }
    }
}

#[test]
fn what_was_accepted_is_written_plainly_and_comes_back() {
    // Peculiarities that are part of the clip give their warning again after writing.
    let lasting = [AXIS_TWICE, POSES, ROOTS];
    for Case { number, bytes, .. } in cases() {
        let Ok(Read { clip, .. }) = read(&bytes) else { continue };
        let again = read(write(&clip).as_bytes()).unwrap();
        assert_eq!(again.clip, clip, "case {number}");
        let warned = again.warnings.iter().find(|warning| !lasting.contains(&warning.code));
        assert_eq!(warned, None, "case {number}");
    }
}
