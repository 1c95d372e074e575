//! Checks that everything named in backticks in the prose of all pages exists.

use std::fs;

use super::page::{Piece, page, pieces};
use super::reader::{place, said};
use crate::clips::here;

/// The pages of the project, including those of `docs`.
fn pages() -> Vec<String> {
    let in_folder = |folder: &'static str| {
        let names = fs::read_dir(here(folder)).unwrap().map(|entry| entry.unwrap().file_name());
        names.map(move |name| format!("{folder}/{}", name.to_string_lossy()))
    };
    let docs = ["docs", "docs/lab"].into_iter().flat_map(in_folder);
    let pages = docs.filter(|name| name.ends_with(".md"));
    let first = ["README.md", "README.ja.md", "CHANGELOG.md"].map(str::to_owned);
    let mut pages: Vec<_> = first.into_iter().chain(pages).collect();
    pages.sort();
    pages
}

/// All text in backticks in the prose of all pages, each with its page.
fn codes() -> Vec<(String, String)> {
    let mut codes = Vec::new();
    for name in pages() {
        let page = page(&name);
        for piece in pieces(&page) {
            let Piece::Prose(line) = piece else { continue };
            codes.extend(
                line.split('`').skip(1).step_by(2).map(|code| (name.clone(), code.to_owned())),
            );
        }
    }
    codes
}

#[test]
fn settings_named_in_the_prose_are_accepted() {
    let place = place();
    let codes: Vec<_> =
        codes().into_iter().filter(|(_, code)| code.starts_with("--set ")).collect();
    assert!(codes.len() > 20, "{codes:?}");
    for (name, code) in codes {
        let command = format!("genga run data/kick.bvh {code}");
        said(&command, place.path()).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn commands_and_options_named_in_the_prose_are_there() {
    let place = place();
    let help = said("genga help", place.path()).unwrap();
    let (_, commands) = help.split_once("Commands:").unwrap();
    let (commands, _) = commands.split_once("Options:").unwrap();
    let begins = |line: &'_ str| line.starts_with("  ") && !line.starts_with("   ");
    let lines = commands.lines().filter(|line| begins(line));
    let commands: Vec<_> = lines.filter_map(|line| line.split_whitespace().next()).collect();
    let helps = commands.iter().map(|command| said(&format!("genga help {command}"), place.path()));
    let helps = helps.collect::<Result<String, _>>().unwrap();
    let end = |letter: char| !(letter.is_ascii_lowercase() || letter == '-');
    let options: Vec<_> = helps.split(end).filter(|word| word.starts_with("--")).collect();
    let ours = |code: &str| {
        code.starts_with("genga ") || (code.starts_with("--") && !code.starts_with("-- "))
    };
    let mut missing = Vec::new();
    for (name, code) in codes().into_iter().filter(|(_, code)| ours(code)) {
        let command = code.strip_prefix("genga ").and_then(|rest| rest.split_whitespace().next());
        // A file in place of a command is one of the documented mistakes.
        let is_there = |word: &str| commands.contains(&word) || word.contains('.');
        let mut named = code.split(end).filter(|word| word.starts_with("--"));
        if !command.is_none_or(is_there) || named.any(|word| !options.contains(&word)) {
            missing.push(format!("{name}: {code}"));
        }
    }
    assert!(missing.is_empty(), "{missing:#?}");
}
