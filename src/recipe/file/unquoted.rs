//! Values that a person wrote without quotes. TOML takes `2-3` for a broken date and `120..` for a broken number; the
//! reader of a recipe means text, so the error says how genga writes it.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;
use toml::value::Datetime;

use crate::sanitize::is_hidden;

/// Longest value that an error repeats, in bytes.
const LONGEST: usize = 40;

/// Corrections as genga writes them.
const CORRECTIONS: [(&str, &str); 8] = [
    ("forbidden", "[55, \"120..140\"]"),
    ("pins", "[{ frame = 42 }]"),
    ("moves", "[{ from = 79, to = 81 }]"),
    ("holds", "[{ frame = 60, koma = 6 }]"),
    ("frozen", "[12, 21, 33]"),
    ("splits", "[310, 774]"),
    ("speech", "[{ from = 12, past = 40, words = \"Ready?\" }]"),
    ("camera", "[{ frames = [12, 40], text = \"PAN\" }]"),
];

/// Fewest letters by which a correction's name is known.
const FEWEST: usize = 3;

/// Finds the value at a place of a text that TOML does not read, if it is one word without quotes.
pub(super) fn find_unquoted(text: &str, at: usize) -> Option<Range<usize>> {
    let value = value_at(text, at)?;
    let word = &text[value.clone()];
    let is_odd = |letter: char| {
        is_hidden(letter) || letter.is_whitespace() || matches!(letter, '"' | '\'' | '\\')
    };
    let is_word = !word.is_empty() && word.len() <= LONGEST && !word.contains(is_odd);
    // The reader of TOML says best what is wrong with 07 or 1.
    let is_text = is_word && word.parse::<f64>().is_err() && !reads(word);
    (is_text && key_of(text, value.start).is_some()).then_some(value)
}

/// Finds the first date or time among corrections, none of which is one.
pub(super) fn find_date(value: &Spanned<DeValue<'_>>) -> Option<Range<usize>> {
    match value.get_ref() {
        DeValue::Datetime(_) => Some(value.span()),
        DeValue::Array(values) => values.iter().find_map(find_date),
        DeValue::Table(table) => table.iter().find_map(|(_, value)| find_date(value)),
        _ => None,
    }
}

/// Says that a value needs quotes, and how genga writes what stands there.
pub(super) fn describe(text: &str, value: Range<usize>) -> String {
    let word = &text[value.clone()];
    if let Some(switch) = switch(word) {
        return format!("{word} is no switch; write {switch}");
    }
    let key = key_of(text, value.start).unwrap_or_default();
    let is_meant = |name: &str| key.len() >= FEWEST && name.starts_with(key);
    let correction = CORRECTIONS.iter().find(|(name, _)| is_meant(name));
    let writes = correction.map_or_else(
        || format!(": \"{word}\""),
        |(name, value)| format!("; genga writes {name} = {value}"),
    );
    format!("{word} is no number, and text needs quotes{writes}")
}

/// The value of a switch that a word means.
fn switch(word: &str) -> Option<bool> {
    let is_one = |words: [&str; 2]| words.iter().any(|own| word.eq_ignore_ascii_case(own));
    match word {
        _ if is_one(["true", "yes"]) => Some(true),
        _ if is_one(["false", "no"]) => Some(false),
        _ => None,
    }
}

/// Whether TOML reads a word as a value.
fn reads(word: &str) -> bool {
    word.parse::<bool>().is_ok() || word.parse::<Datetime>().is_ok() || word.starts_with(['[', '{'])
}

/// Returns the range between the delimiters around a place, without the spaces.
fn value_at(text: &str, at: usize) -> Option<Range<usize>> {
    let (before, after) = (text.get(..at)?, text.get(at..)?);
    let begin = before.rfind(['=', '[', '{', ',', '\n']).map_or(0, |found| found + 1);
    let end = at + after.find([',', ']', '}', '#', '\n']).unwrap_or(after.len());
    let whole = &text[begin..end];
    let begin = begin + whole.len() - whole.trim_start().len();
    Some(begin..begin + whole.trim().len())
}

/// Returns the last part of the key whose value stands at a place; `None` outside of values.
fn key_of(text: &str, at: usize) -> Option<&str> {
    let lines = text[..at].rsplit('\n').map(str::trim).filter(|line| !line.starts_with('#'));
    let mut lines = lines.skip_while(|line| !line.contains('=') && !line.starts_with('['));
    let (key, _) = lines.next()?.split_once('=').filter(|(key, _)| !key.starts_with('['))?;
    key.rsplit('.').next().map(str::trim)
}
