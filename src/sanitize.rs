//! Makes text from files and people safe to show: no hidden characters, no spreadsheet formulas.

use std::borrow::Cow;

/// Whether a character is invisible or changes the reading order of others: a control character or a mark of
/// direction.
pub fn is_hidden(letter: char) -> bool {
    let turns = matches!(
        letter,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    letter.is_control() || turns
}

/// Replaces each hidden character by its number, such as `\u{202e}`.
pub fn shown(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// Replaces each hidden character except newlines by its number, for text of several lines.
pub fn shown_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |letter| letter != '\n' && is_hidden(letter))
}

fn escaped(text: &str, is_hidden: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    for letter in text.chars() {
        if is_hidden(letter) {
            shown.extend(letter.escape_unicode());
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

/// First characters of a cell that a spreadsheet takes for a formula, full-width forms included.
const FORMULA: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// Makes a table cell safe: hidden characters become numbers, and a `'` goes before a formula. Numbers stay as they
/// are.
///
/// ```
/// use genga::sanitize::{cell, shown};
///
/// assert_eq!(shown("arm\u{202e}L"), "arm\\u{202e}L");
/// assert_eq!(cell("=1+1"), "'=1+1");
/// assert_eq!(cell("-0.5"), "-0.5");
/// ```
pub fn cell(text: &str) -> Cow<'_, str> {
    let cell = shown(text);
    let is_number = cell.parse::<f64>().is_ok();
    let is_formula = cell.trim_start_matches('\'').starts_with(FORMULA) && !is_number;
    if is_formula { Cow::Owned(format!("'{cell}")) } else { cell }
}

/// Returns the text of a [`cell`] without its `'`. Hidden characters stay numbers.
pub fn text_of(cell: &str) -> &str {
    let bare = cell.strip_prefix('\'');
    bare.filter(|rest| rest.trim_start_matches('\'').starts_with(FORMULA)).unwrap_or(cell)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn a_spreadsheet_runs_nothing_and_numbers_stay() {
        let cases = [
            ("=1+1", "'=1+1"),
            ("+cmd|' /C calc'!A0", "'+cmd|' /C calc'!A0"),
            ("@SUM(A1)", "'@SUM(A1)"),
            ("-left", "'-left"),
            ("＝1", "'＝1"),
            ("'=1", "''=1"),
            ("\t=1", "\\u{9}=1"),
            ("-0.5", "-0.5"),
            ("+3", "+3"),
            ("1-2", "1-2"),
            ("左腕", "左腕"),
            ("'tis", "'tis"),
        ];
        for (text, written) in cases {
            assert_eq!(cell(text), written);
        }
    }

    #[test]
    fn what_is_hidden_is_shown() {
        assert_eq!(shown("a\u{202e}b\u{7}\n"), "a\\u{202e}b\\u{7}\\u{a}");
        assert_eq!(shown("脚本 é"), "脚本 é");
    }

    proptest! {
        #[test]
        fn a_cell_is_read_back(text in "[-='+@a1 ]{0,6}") {
            let written = cell(&text);
            prop_assert_eq!(text_of(&written), &*text);
        }

        #[test]
        fn no_cell_begins_a_formula(text in any::<String>()) {
            let written = cell(&text);
            let is_number = written.parse::<f64>().is_ok();
            prop_assert!(is_number || !written.starts_with(FORMULA));
            prop_assert!(!written.contains(is_hidden));
        }
    }
}
