//! The order of rooms: a module imports only from rooms to its left or from the ground.

use std::fs;
use std::path::Path;

use crate::clips::here;

/// From left to right. The first entry is the ground, whose modules may know each other.
const ROOMS: [&[&str]; 15] = [
    &["error", "time", "sheet", "edits"],
    &["motion"],
    &["exaggerate"],
    &["signal"],
    &["keys"],
    &["timing"],
    &["recipe"],
    &["pipeline"],
    &["target"],
    &["study"],
    &["quality"],
    &["plot"],
    &["deliver"],
    &["studio"],
    &["cli"],
];

/// What `lib.rs` hands on from the ground under its own name.
const HANDED_ON: [&str; 2] = ["Error", "Warning"];

fn place(room: &str) -> Option<usize> {
    if HANDED_ON.contains(&room) {
        return Some(0);
    }
    ROOMS.iter().position(|rooms| rooms.contains(&room))
}

/// What is wrong with a file, one line each. `path` is relative to `src`, with `/`.
fn violations(path: &str, text: &str) -> Vec<String> {
    let module = path.trim_end_matches(".rs");
    let room = module.split('/').next().unwrap_or_default();
    let Some(own) = place(room) else {
        return vec![format!("{path}: {room} has no place in the order of rooms")];
    };
    let code = without_comments(text);
    let depth = module.split('/').count();
    imports(&code, depth)
        .into_iter()
        .filter(|(_, target)| target != room)
        .filter_map(|(line, target)| match place(&target) {
            None => Some(format!("{path}:{line}: {target} is no room")),
            Some(0) => None,
            Some(other) if other < own => None,
            Some(_) => Some(format!("{path}:{line}: {room} may not import {target}")),
        })
        .collect()
}

/// The text with comments blanked, so that links in docs do not count and lines stay.
fn without_comments(text: &str) -> String {
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_owned() + "\n";
    text.lines().map(code).collect()
}

/// Line and first name after every path to the crate's root: `crate::x`, `crate::{x, y::z}` and, in a
/// module `depth` below the root, as many `super::`.
fn imports(code: &str, depth: usize) -> Vec<(usize, String)> {
    let up = "super::".repeat(depth);
    let mut found = Vec::new();
    for root in ["crate::", up.as_str()] {
        for (at, _) in code.match_indices(root) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|letter| letter.is_alphanumeric() || "_:".contains(letter)) {
                continue;
            }
            let line = code[..at].matches('\n').count() + 1;
            let names = first_names(&code[at + root.len()..]);
            found.extend(names.into_iter().map(|name| (line, name)));
        }
    }
    found.retain(|(_, name)| name != "super" && name != "self" && name != "*");
    found
}

fn first_names(rest: &str) -> Vec<String> {
    let word = |text: &str| -> String {
        text.trim_start().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let Some(group) = rest.strip_prefix('{') else {
        let name = word(rest);
        return if name.is_empty() { vec![] } else { vec![name] };
    };
    let mut names = Vec::new();
    let (mut depth, mut begin) = (0, 0);
    for (at, letter) in group.char_indices() {
        match letter {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(word(&group[begin..at]));
                begin = at + 1;
                if letter == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|name| !name.is_empty());
    names
}

/// Every source file as a path relative to `src` and its text.
fn sources(folder: &Path, under: &str, found: &mut Vec<(String, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = format!("{under}{}", path.file_name().unwrap().to_string_lossy());
        if path.is_dir() {
            sources(&path, &format!("{name}/"), found);
        } else if name.ends_with(".rs") {
            found.push((name, fs::read_to_string(&path).unwrap()));
        }
    }
}

#[test]
fn every_room_imports_only_from_its_left() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    files.retain(|(path, _)| path != "lib.rs" && path != "main.rs");
    assert!(files.len() > 50, "only {} files were found", files.len());
    let wrong: Vec<_> = files.iter().flat_map(|(path, text)| violations(path, text)).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn the_library_opens_every_room_and_no_other() {
    let library = fs::read_to_string(here("src/lib.rs")).unwrap();
    let mut opened: Vec<&str> = library
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';'))
        .collect();
    let mut rooms = ROOMS.concat();
    opened.sort_unstable();
    rooms.sort_unstable();
    assert_eq!(opened, rooms);
}

#[test]
fn an_import_from_the_right_is_found_however_it_is_written() {
    for (path, text, wrong) in [
        (
            "signal/turns.rs",
            "use crate::keys::Key;",
            "signal/turns.rs:1: signal may not import keys",
        ),
        ("keys.rs", "\n\nuse crate::timing;\n", "keys.rs:3: keys may not import timing"),
        (
            "time.rs",
            "fn f() { crate::motion::bvh::read(b); }",
            "time.rs:1: time may not import motion",
        ),
        (
            "keys/vote.rs",
            "use crate::{\n    error::Error,\n    timing::{Stills, Spacing},\n};",
            "keys/vote.rs:1: keys may not import timing",
        ),
        ("plot.rs", "pub(crate) use super::cli::main;", "plot.rs:1: plot may not import cli"),
        ("plot/a.rs", "use super::super::cli;", "plot/a.rs:1: plot may not import cli"),
        ("keys.rs", "use crate::gauge::Gauge;", "keys.rs:1: gauge is no room"),
        ("gauge.rs", "", "gauge.rs: gauge has no place in the order of rooms"),
    ] {
        assert_eq!(violations(path, text), [wrong], "{text}");
    }
}

#[test]
fn what_is_allowed_is_not_found() {
    for (path, text) in [
        ("keys.rs", "use crate::signal::Turn;\nuse crate::{Error, sheet::Source, motion::Clip};"),
        ("sheet.rs", "use crate::time::Clock;"),
        ("keys/price.rs", "use super::vote::Poll;\nuse crate::keys::Key;"),
        ("signal.rs", "/// See [`Keys`](crate::keys::Choose).\nfn f() {} // crate::keys::f"),
        ("cli/run.rs", "use crate::plot;\nuse crate::deliver::{self, Rows};"),
        ("time.rs", "use othercrate::motion;\npub(crate) fn motion() {}"),
    ] {
        assert_eq!(violations(path, text), [""; 0], "{text}");
    }
}
