//! Parses unusual spellings of numbers: a decimal comma, a minus glued to the number before it, and the
//! words for NaN and infinity.

use super::number::{self, ends_a_word};

/// The word at the start of `text`, cut before a glued minus: `3` of `3-10`, but all of `1e-3`.
pub(super) fn piece(text: &[u8]) -> &[u8] {
    let mut before = b'e';
    let ends = |&byte: &u8| {
        let is_glued_minus = byte == b'-' && !matches!(before, b'e' | b'E');
        before = byte;
        is_glued_minus || ends_a_word(byte)
    };
    &text[..text.iter().position(ends).unwrap_or(text.len())]
}

/// Parses a word with [`number::scan`], its first comma replaced by a decimal point.
pub(super) fn with_point(word: &[u8]) -> Option<(f64, usize)> {
    let comma = word.iter().position(|&byte| byte == b',')?;
    let mut pointed = word.to_vec();
    pointed[comma] = b'.';
    number::scan(&pointed)
}

/// Whether a word is a program's spelling of a non-finite number: `nan`, `-nan(ind)`, `Infinity`,
/// `-1.#IND00`.
pub(super) fn is_no_finite_number(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word);
    let starts =
        |with: &[u8]| word.get(..with.len()).is_some_and(|it| it.eq_ignore_ascii_case(with));
    let is = |name: &[u8]| starts(name) && word.len() == name.len();
    let is_windows = || {
        let rest = word.strip_prefix(b"1.#");
        rest.is_some_and(|rest| !rest.is_empty() && rest.iter().all(u8::is_ascii_alphanumeric))
    };
    is(b"nan")
        || starts(b"nan(")
        || is(b"inf")
        || is(b"infinity")
        || is("∞".as_bytes())
        || is_windows()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_ends_before_a_minus_that_is_no_sign() {
        for (text, first) in [
            ("3-10", "3"),
            ("-3-10", "-3"),
            ("-1e-3-4 5", "-1e-3"),
            ("1E-3", "1E-3"),
            ("0.0-7.5", "0.0"),
            ("--1", "-"),
            ("a}b", "a"),
            ("", ""),
        ] {
            assert_eq!(piece(text.as_bytes()), first.as_bytes(), "{text}");
        }
    }

    #[test]
    fn one_comma_is_a_point_and_two_are_not() {
        assert_eq!(with_point(b"-0,5"), Some((-0.5, 4)));
        assert_eq!(with_point(b"1,5e-1"), Some((0.15, 6)));
        for wrong in ["1,2,3", "1,5.0", ",", "5", "a,b"] {
            assert_eq!(with_point(wrong.as_bytes()), None, "{wrong}");
        }
    }

    #[test]
    fn programs_say_that_there_is_no_number_in_many_ways() {
        for word in [
            "nan",
            "NaN",
            "-nan",
            "-nan(ind)",
            "NAN(0x8)",
            "inf",
            "-Inf",
            "+infinity",
            "∞",
            "-1.#IND00",
            "1.#QNAN",
            "1.#INF00",
            "-1.#J",
        ] {
            assert!(is_no_finite_number(word.as_bytes()), "{word}");
        }
        for word in ["", "-", "nano", "info", "1.#", "2.#IND", "abc", "1.5", "i"] {
            assert!(!is_no_finite_number(word.as_bytes()), "{word}");
        }
    }
}
