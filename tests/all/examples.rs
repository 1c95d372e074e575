//! Runs the examples for newcomers with the command of their first line, and checks their output.
//!
//! `INSTA_UPDATE=always cargo test --test all examples` accepts their current output.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::clips::here;

/// Most lines of an example, so that a newcomer reads it without a break.
const MOST_LINES: usize = 40;

/// The examples that consist of a single file.
fn examples() -> Vec<PathBuf> {
    let entries = fs::read_dir(here("examples")).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "rs"));
    paths.sort();
    paths
}

fn name(path: &Path) -> &str {
    path.file_stem().unwrap().to_str().unwrap()
}

/// The words of the first command in backticks.
fn command(text: &str) -> Vec<&str> {
    text.split('`').nth(1).unwrap_or_default().split(' ').collect()
}

/// Output of a cargo command in a build with the tested profile and features, in the same target folder.
fn printed(words: &[&str], temporary: &Path) -> String {
    let [verb, rest @ ..] = words else { panic!("a command has a verb") };
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args([verb, "--locked", "--quiet"]).args(rest).current_dir(here(""));
    if !cfg!(debug_assertions) {
        cargo.arg("--release");
    }
    cargo.env("CARGO_TARGET_DIR", Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap());
    // Files that an example writes go to a temporary folder, on every system.
    cargo.envs(["TMPDIR", "TMP", "TEMP"].map(|name| (name, temporary)));
    let output = cargo.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo {}: {errors}", words.join(" "));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn every_example_prints_what_it_printed() {
    let paths = examples();
    assert!(paths.len() >= 8, "only {} examples were found", paths.len());
    for path in paths {
        let text = fs::read_to_string(&path).unwrap();
        let temporary = tempfile::tempdir().unwrap();
        let [_, words @ ..] = &command(&text)[..] else { panic!("{}", path.display()) };
        insta::assert_snapshot!(name(&path), printed(words, temporary.path()));
    }
}

#[test]
fn every_example_is_short_and_says_first_how_it_is_run() {
    for path in examples() {
        let (text, name) = (fs::read_to_string(&path).unwrap(), name(&path));
        let lines = text.lines().count();
        assert!(lines <= MOST_LINES, "{name} has {lines} lines, {MOST_LINES} at the most");
        let first = text.lines().next().unwrap();
        assert!(first.starts_with("//! "), "{name} does not begin with what it shows");
        assert_eq!(command(first), ["cargo", "run", "--example", name], "{first}");
    }
}
