//! Text from files and people, so that nothing in it is hidden or runs.

use std::borrow::Cow;

/// Whether a letter is not seen, or changes in which order others are read: a control character, or a mark of
/// direction.
pub fn is_hidden(letter: char) -> bool {
    let turns = matches!(
        letter,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    letter.is_control() || turns
}

/// Text with each hidden letter as its number, such as `\u{202e}`.
pub fn shown(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// The same for text of several lines, which stay.
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

/// What a cell begins with that a spreadsheet takes for a formula, in the width of Japanese letters too.
const FORMULA: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// A cell of a table: hidden letters as numbers, and a `'` before what a spreadsheet would run. Numbers stay.
///
/// ```
/// use genga::plain::{cell, shown};
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

/// The text of a [`cell`], but for letters that were hidden.
pub(crate) fn text_of(cell: &str) -> &str {
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
