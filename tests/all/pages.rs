//! Checks that everything named on the pages for newcomers exists.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use genga::recipe::Knob;
use genga_files::FORMATS;

use crate::clips::here;

const PAGES: [&str; 2] = ["ARCHITECTURE.md", "CONTRIBUTING.md"];

/// Files of a run that belong to no format.
const OWN: [&str; 4] = ["speed.svg", "recipe.toml", "report.json", "manifest.json"];

/// Words of a page in code spans and code blocks.
fn coded(page: &str) -> BTreeSet<&str> {
    let spans = page.split('`').skip(1).step_by(2);
    let blocks = page.split("```").skip(1).step_by(2);
    spans.chain(blocks).flat_map(str::split_whitespace).collect()
}

/// Whether a word is a path in the repository, but not one made by cargo.
fn is_path(word: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || "_-./".contains(c);
    let is_outside = word.starts_with("..") || word.starts_with("target/");
    let is_file = word.ends_with(".rs") || word.ends_with(".md") || word.contains('/');
    is_file && !is_outside && word.chars().all(is_name)
}

/// Whether a word is a Rust identifier or path.
fn is_name(word: &str) -> bool {
    let is_letter = |c: char| c.is_alphanumeric() || "_:".contains(c);
    let is_camel = word.starts_with(char::is_uppercase) && word.contains(char::is_lowercase);
    word.chars().all(is_letter) && (is_camel || word.contains("::"))
}

/// Whether a word looks like a knob, or a file that a run writes.
fn is_dotted(word: &str) -> bool {
    let is_plain =
        |part: &str| !part.is_empty() && part.chars().all(|c| c.is_ascii_lowercase() || c == '_');
    word.split_once('.').is_some_and(|(section, field)| is_plain(section) && is_plain(field))
}

/// Lists names on a page that do not exist, one a line; `code` is all of `src` and `crates`.
fn missing(page: &str, code: &str) -> Vec<String> {
    let links = page.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let links = links.map(|link| link.split('#').next().unwrap_or_default());
    let words = coded(page);
    let is_known = |word: &str| {
        let mut files = FORMATS.iter().flat_map(|format| format.files).chain(&OWN);
        Knob::find(word).is_ok() || files.any(|file| *file == word)
    };
    let is_missing = |word: &&str| match *word {
        path if is_path(path) => !here(path).exists(),
        name if is_name(name) => name.split("::").any(|part| !code.contains(part)),
        word if is_dotted(word) => !is_known(word) && !here(word).exists(),
        _ => false,
    };
    let paths = links.filter(|link| !link.is_empty() && !here(link).exists());
    words.into_iter().filter(is_missing).chain(paths).map(String::from).collect()
}

/// Returns all code in a folder as text.
fn code(folder: &Path) -> String {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let text = |path: std::path::PathBuf| match path.is_dir() {
        true => code(&path),
        false => fs::read_to_string(&path).unwrap_or_default(),
    };
    entries.map(text).collect()
}

#[test]
fn what_the_pages_for_newcomers_name_is_there() {
    let code = code(&here("src")) + &code(&here("crates"));
    for name in PAGES {
        let page = fs::read_to_string(here(name)).unwrap();
        let paths = coded(&page).into_iter().filter(|word| is_path(word)).count();
        assert!(paths > 10, "only {paths} paths were found in {name}");
        assert_eq!(missing(&page, &code), [""; 0], "{name} names what is not there");
    }
}

#[test]
fn what_is_not_there_is_found_however_it_is_written() {
    let code = "pub struct LowPass; fn apply() {}";
    let there = "`src/lib.rs`, `LowPass::apply`, `keys.rest`, `keys.csv`, [a](data/README.md#a), `Cargo.toml`, \
        `../shared/data/bvh`\n```sh\ncargo run -- run data/kick.bvh\n```\n";
    assert_eq!(missing(there, code), [""; 0]);
    for wrong in
        ["src/libs.rs", "lib.rs", "LowPass::aply", "HighPass", "keys.rst", "keys.cvs", "tests/al"]
    {
        assert_eq!(missing(&format!("a `{wrong}` b"), code), [wrong]);
    }
    assert_eq!(missing("see [a](data/READ.md)", code), ["data/READ.md"]);
    assert_eq!(missing("```sh\ntests/others/none/run\n```", code), ["tests/others/none/run"]);
}

#[test]
fn the_citation_is_of_this_version() {
    let citation = fs::read_to_string(here("CITATION.cff")).unwrap();
    let version = citation.lines().find_map(|line| line.strip_prefix("version: "));
    assert_eq!(version, Some(env!("CARGO_PKG_VERSION")));
}
