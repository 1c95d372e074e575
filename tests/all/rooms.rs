//! The order of rooms: a module imports only from rooms above it or from the ground.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::clips::here;

mod motion;
mod picture;
mod public;

/// From left to right. The first entry is the ground, whose modules may know each other.
const ROOMS: [&[&str]; 16] = [
    &["error", "knob", "maths", "plain", "time", "sheet", "edits"],
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
    &["trial"],
    &["studio"],
    &["cli"],
];

/// What tests of all rooms use, from `tests`.
const OF_TESTS: [&str; 2] = ["cases", "real"];

/// What `lib.rs` hands on from the ground under its own name.
const HANDED_ON: [&str; 2] = ["Error", "Warning"];

fn place(room: &str) -> Option<usize> {
    if HANDED_ON.contains(&room) || OF_TESTS.contains(&room) {
        return Some(0);
    }
    ROOMS.iter().position(|rooms| rooms.contains(&room))
}

/// What is wrong with a file, one line each. `path` is relative to `src`, with `/`.
fn violations(path: &str, text: &str) -> Vec<String> {
    let module = module_of(path);
    let room = &module[0];
    let Some(own) = place(room) else {
        return vec![format!("{path}: {room} has no place in the order of rooms")];
    };
    let wrong = |(line, target): (usize, Vec<String>)| {
        let target = target.into_iter().next().filter(|target| target != room)?;
        match place(&target) {
            None => Some(format!("{path}:{line}: {target} is no room")),
            Some(0) => None,
            Some(other) if other < own => None,
            Some(_) => Some(format!("{path}:{line}: {room} may not import {target}")),
        }
    };
    let mut found: Vec<_> =
        paths(&without_comments(text), &module).into_iter().filter_map(wrong).collect();
    found.dedup();
    found
}

fn module_of(path: &str) -> Vec<String> {
    path.trim_end_matches(".rs").split('/').map(String::from).collect()
}

/// The text with comments blanked, so that links in docs do not count and lines stay.
fn without_comments(text: &str) -> String {
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_owned() + "\n";
    text.lines().map(code).collect()
}

/// Line and whole path from the crate's root, of every path in a module that begins with `crate`, `super`, `self` or a
/// module of its own, group by group.
fn paths(code: &str, module: &[String]) -> Vec<(usize, Vec<String>)> {
    let declared =
        code.lines().filter_map(|line| line.trim().strip_suffix(';')?.split_once("mod "));
    let own = declared.map(|(_, name)| format!("{name}::"));
    let roots = ["crate::", "super::", "self::"].map(String::from);
    let mut found = Vec::new();
    for root in roots.into_iter().chain(own) {
        for (at, _) in code.match_indices(&root) {
            let before = code[..at].chars().next_back();
            let is_inside = |letter: char| letter.is_alphanumeric() || "_:".contains(letter);
            // A path behind `pub(in` says who may import, and imports nothing.
            if before.is_some_and(is_inside) || code[..at].ends_with("(in ") {
                continue;
            }
            let line = code[..at].matches('\n').count() + 1;
            let written = take(&mut &code[at..]).into_iter();
            found.extend(written.filter_map(|path| Some((line, from_root(path, module)?))));
        }
    }
    found
}

/// A path as it is written as one from the crate's root; none for all names of a module at once, as tests take them.
fn from_root(written: Vec<String>, module: &[String]) -> Option<Vec<String>> {
    let mut path = module.to_vec();
    for name in &written {
        match name.as_str() {
            "crate" => path.clear(),
            "self" => {}
            "super" => drop(path.pop()),
            "*" => return None,
            name => path.push(name.into()),
        }
    }
    (!path.is_empty()).then_some(path)
}

/// Takes the paths with which a text begins: `a::{b, c::d}` is two.
fn take(text: &mut &str) -> Vec<Vec<String>> {
    let end = text.find(|c: char| !(c.is_alphanumeric() || "_*".contains(c)));
    let (word, rest) = text.split_at(end.unwrap_or(text.len()));
    *text = rest;
    let Some(rest) = rest.strip_prefix("::") else { return vec![vec![word.into()]] };
    *text = rest;
    let mut under = Vec::new();
    if let Some(group) = rest.strip_prefix('{') {
        *text = group.trim_start();
        while text.starts_with(|c: char| c.is_alphanumeric() || c == '_' || c == '*') {
            under.extend(take(text));
            *text = text.trim_start_matches(|c: char| c == ',' || c.is_whitespace());
        }
        *text = text.strip_prefix('}').unwrap_or(text);
    } else {
        under = take(text);
    }
    under.iter_mut().for_each(|path| path.insert(0, word.into()));
    under
}

/// Files each of which imports the next, and the last the first; none where there is no such circle.
fn circle(files: &[(&str, &str)]) -> Option<Vec<String>> {
    let modules: Vec<_> = files.iter().map(|(path, _)| module_of(path)).collect();
    let imported = |at: usize| {
        // What a test takes is no part of what the file needs.
        let code = without_comments(files[at].1.split("#[cfg(test)]").next().unwrap_or_default());
        let file_of = |(_, path): (usize, Vec<String>)| {
            let prefixes = (1..=path.len()).rev().map(|length| &path[..length]);
            let mut files = prefixes.filter_map(|path| modules.iter().position(|own| own == path));
            files.next().filter(|file| *file != at)
        };
        paths(&code, &modules[at]).into_iter().filter_map(file_of).collect::<BTreeSet<_>>()
    };
    let mut imports: Vec<_> = (0..files.len()).map(imported).collect();
    // A file that imports none of the others that are left stands in no circle.
    while let Some(free) = imports.iter().position(BTreeSet::is_empty) {
        for (at, of) in imports.iter_mut().enumerate() {
            if at == free {
                of.insert(free)
            } else {
                of.remove(&free)
            };
        }
    }
    let stuck = |at: &usize| !imports[*at].contains(at);
    let mut round = vec![(0..files.len()).find(stuck)?];
    loop {
        let next = *imports[round[round.len() - 1]].first()?;
        if let Some(begin) = round.iter().position(|at| *at == next) {
            return Some(round[begin..].iter().map(|at| files[*at].0.to_owned()).collect());
        }
        round.push(next);
    }
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
fn no_files_of_the_studio_import_each_other_in_a_circle() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    files.retain(|(path, _)| path == "studio.rs" || path.starts_with("studio/"));
    assert!(files.len() > 30, "only {} files were found", files.len());
    let files: Vec<_> = files.iter().map(|(path, text)| (&path[..], &text[..])).collect();
    assert_eq!(circle(&files), None);
}

#[test]
fn a_circle_is_found_however_its_imports_are_written() {
    let of = |files: &[(&str, &str)]| circle(files).unwrap_or_default().join(" ");
    let used = ("bar/a.rs", "use super::b::{self, Size};\nfn f() { b::g() }");
    assert_eq!(of(&[used, ("bar/b.rs", "use crate::bar::{c::C, a::f};")]), "bar/a.rs bar/b.rs");
    let parent = ("bar.rs", "mod a;\nmod b;\nfn f() { a::f() }\nconst ROW: u8 = 2;");
    assert_eq!(of(&[parent, ("bar/a.rs", "use super::ROW;")]), "bar.rs bar/a.rs");
    assert_eq!(
        of(&[parent, ("bar/a.rs", "use super::b::ROW;"), ("bar/b.rs", "use super::a;")]),
        "bar/a.rs bar/b.rs"
    );
    let tested = "#[cfg(test)]\nmod tests { use crate::bar::ROW; }";
    assert_eq!(
        of(&[parent, ("bar/a.rs", tested), ("bar/b.rs", "/// [`super::a`]\nuse super::a;")]),
        ""
    );
}

#[test]
fn the_library_opens_every_room_and_no_other() {
    let library = fs::read_to_string(here("src/lib.rs")).unwrap();
    let mut opened: Vec<&str> = library
        .lines()
        .filter_map(|line| line.trim_start_matches("pub ").strip_prefix("mod ")?.strip_suffix(';'))
        .collect();
    let mut rooms = [ROOMS.concat(), OF_TESTS.to_vec()].concat();
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

/// Fields of public structs that only some builds have: whoever writes such a struct out would break with the others.
fn fields_of_a_feature(path: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_field = |line: &str| line.starts_with("pub ") && line.ends_with(',');
    let pairs = lines.windows(2).filter(|pair| pair[0].starts_with("#[cfg(feature"));
    pairs.filter(|pair| is_field(pair[1])).map(|pair| format!("{path}: {}", pair[1])).collect()
}

#[test]
fn public_structs_have_the_same_fields_in_every_build() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    let found: Vec<_> =
        files.iter().flat_map(|(path, text)| fields_of_a_feature(path, text)).collect();
    assert_eq!(found, [""; 0]);
}
