//! One word each for pin, forbid, move and hold, as in the glossary, in everything that a person reads in two languages.

use std::fs;
use std::path::{Path, PathBuf};

use crate::clips::here;

/// Beginnings of the English words, and the Japanese word of the glossary.
const WORDS: [(&[&str], &str); 4] = [
    (&["pin"], "固定"),
    (&["forbid"], "禁止"),
    (&["move", "moving", "travel", "displacement", "combined"], "移動"),
    (&["hold", "held", "rest", "stays"], "止め"),
];

/// English words that mean the first and the second of these as surely as Japanese does.
const EXACT: usize = 2;

/// Other words for them, which would be a second one.
const STRAYS: [&str; 8] =
    ["lock", "locked", "unlock", "ロック", "ピン留め", "ピンする", "ホールド", "キープ"];

/// Source files of programs that a person reads.
fn sources() -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        ["crates/genga-studio/src", "addons/blender/genga", "src/target", "src/sheet"]
            .map(here)
            .into();
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            let is_test = path.file_stem().is_some_and(|stem| stem == "tests");
            let is_source = path.extension().is_some_and(|ending| ending == "rs" || ending == "py");
            if path.is_dir() {
                folders.push(path);
            } else if is_source && !is_test {
                files.push(path);
            }
        }
    }
    files
}

/// The string literals of a source, each with what stands between it and the one before.
fn literals(source: &str) -> Vec<(String, String)> {
    let (mut found, mut between) = (Vec::new(), String::new());
    let mut letters = source.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '/' if letters.peek() == Some(&'/') => {
                letters.by_ref().take_while(|own| *own != '\n').for_each(drop)
            }
            '\'' if source.contains("fn ") => {
                // A character: a quote in it begins no string.
                let next = letters.next();
                if next == Some('\\') || letters.peek() == Some(&'\'') {
                    letters.by_ref().take_while(|own| *own != '\'').for_each(drop);
                }
            }
            '"' => {
                let mut text = String::new();
                while let Some(own) = letters.next().filter(|own| *own != '"') {
                    if own != '\\' {
                        text.push(own);
                    } else if letters.next() == Some('\n') {
                        while letters.next_if(|own| own.is_whitespace()).is_some() {}
                    }
                }
                found.push((std::mem::take(&mut between), text));
            }
            other => between.push(other),
        }
    }
    found
}

fn is_japanese(text: &str) -> bool {
    text.chars().any(|letter| ('\u{3040}'..='\u{9fff}').contains(&letter))
}

/// Each English text with the Japanese one behind it.
fn pairs(path: &Path) -> Vec<(String, String)> {
    let all = literals(&fs::read_to_string(path).unwrap());
    let is_pair = |two: &&[(String, String)]| {
        let joins =
            two[1].0.chars().all(|letter| letter.is_alphabetic() || " \n\t,:_.".contains(letter));
        joins && !is_japanese(&two[0].1) && is_japanese(&two[1].1)
    };
    all.windows(2).filter(is_pair).map(|two| (two[0].1.clone(), two[1].1.clone())).collect()
}

/// Whether a word of a text begins so, or with un- before it.
fn has(text: &str, begins: &[&str]) -> bool {
    let lower = text.to_lowercase();
    let mut words = lower.split(|letter: char| !letter.is_alphabetic());
    words.any(|word| {
        let bare = word.strip_prefix("un").unwrap_or(word);
        begins.iter().any(|begin| bare.starts_with(begin))
    })
}

#[test]
fn the_same_thing_has_the_same_word_in_both_languages_everywhere() {
    let glossary = fs::read_to_string(here("docs/glossary.md")).unwrap();
    for (begins, japanese) in WORDS {
        assert!(glossary.contains(japanese) && has(&glossary, begins), "{japanese}");
    }
    let (mut wrong, mut looked_at) = (Vec::new(), 0);
    for path in sources() {
        for (english, japanese) in pairs(&path) {
            looked_at += 1;
            // A moving average moves nothing.
            let japanese = japanese.replace("移動平均", "");
            let said = format!("{}: {english} / {japanese}", path.display());
            for (at, (begins, word)) in WORDS.into_iter().enumerate() {
                let (of_english, of_japanese) = (has(&english, begins), japanese.contains(word));
                if of_japanese && !of_english || at < EXACT && of_english && !of_japanese {
                    wrong.push(format!("{said}: {word}"));
                }
            }
            let is_stray = |stray: &&&str| has(&english, &[stray]) || japanese.contains(**stray);
            wrong.extend(STRAYS.iter().find(is_stray).map(|stray| format!("{said}: {stray}")));
        }
    }
    assert!(looked_at > 300, "{looked_at} texts in two languages");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
