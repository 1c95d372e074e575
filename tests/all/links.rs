//! Every link from one Markdown page to another, or to a heading, leads somewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::clips::here;

/// Folders that contain no pages of the repository.
const PASSED_OVER: [&str; 1] = ["target"];

/// The Markdown files of the repository, by path.
fn pages() -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(here("").join(&folder)).unwrap() {
            let entry = entry.unwrap();
            let name = entry.file_name().to_string_lossy().into_owned();
            let path = folder.join(&name);
            let is_passed_over = name.starts_with('.') || PASSED_OVER.contains(&name.as_str());
            if entry.file_type().unwrap().is_dir() && !is_passed_over {
                folders.push(path);
            } else if name.ends_with(".md") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The lines of a page outside fenced blocks, numbered from 1.
fn prose(page: &str) -> Vec<(usize, &str)> {
    let mut inside = false;
    let lines = (1..).zip(page.lines());
    let outside = lines.filter(|(_, line)| {
        let fence = line.trim_start().starts_with("```");
        inside ^= fence;
        !fence && !inside
    });
    outside.collect()
}

/// The anchors of a page, as used in links. The second of two headings with the same name gets `-1`.
fn anchors(page: &str) -> BTreeSet<String> {
    let mut times: BTreeMap<String, usize> = BTreeMap::new();
    let mut found = BTreeSet::new();
    for (_, line) in prose(page) {
        let text = line.trim_start_matches('#');
        if text.len() == line.len() || !text.starts_with(' ') {
            continue;
        }
        let anchor = anchor(text.trim());
        let before = times.entry(anchor.clone()).or_default();
        let own = if *before == 0 { anchor } else { format!("{anchor}-{before}") };
        *before += 1;
        found.insert(own);
    }
    found
}

/// Converts a heading to an anchor: letters, digits, `-` and `_` are kept in lowercase, spaces become `-`.
fn anchor(heading: &str) -> String {
    let stays = |letter: &char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_');
    let small = heading.chars().filter(stays).flat_map(char::to_lowercase);
    small.map(|letter| if letter == ' ' { '-' } else { letter }).collect()
}

/// The targets of a line's links and pictures.
fn links(line: &str) -> Vec<&str> {
    let after = line.split("](").skip(1);
    after.filter_map(|rest| rest.split_once(')')).map(|(target, _)| target).collect()
}

/// Writes a path as links do, with `/` on every system.
fn written(path: &Path) -> String {
    let parts = path.iter().map(|part| part.to_string_lossy());
    parts.collect::<Vec<_>>().join("/")
}

/// Lists the broken links of a page, one a line.
fn broken(path: &Path, page: &str, read: impl Fn(&Path) -> Option<String>) -> Vec<String> {
    let mut wrong = Vec::new();
    for (number, line) in prose(page) {
        for link in links(line) {
            if link.contains("://") || link.starts_with("mailto:") {
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let folder = path.parent().unwrap_or(Path::new(""));
            let there = if file.is_empty() { path.to_owned() } else { folder.join(file) };
            let found = match read(&there) {
                None => Some(format!("there is no {file}")),
                Some(_) if heading.is_empty() => None,
                Some(text) if anchors(&text).contains(heading) => None,
                Some(_) => Some(format!("{} has no heading #{heading}", written(&there))),
            };
            let place = format!("{}:{number}", written(path));
            wrong.extend(found.map(|what| format!("{place}: {what}")));
        }
    }
    wrong
}

/// The text of a file in the repository; empty for a folder or a file that is not text. `None` if it does not exist.
fn read(path: &Path) -> Option<String> {
    let whole = here("").join(path);
    whole.exists().then(|| fs::read_to_string(whole).unwrap_or_default())
}

#[test]
fn every_link_of_every_page_leads_somewhere() {
    let pages = pages();
    assert!(pages.len() > 10, "{pages:?}");
    let of = |path: &PathBuf| broken(path, &read(path).unwrap(), read);
    let wrong: Vec<_> = pages.iter().flat_map(of).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn a_link_that_leads_nowhere_is_seen() {
    let there = |path: &Path| match &*written(path) {
        "docs/a.md" => Some("# Its *name*, `x` — 画面\n\n# Two\n# Two\n".to_owned()),
        "docs/b.md" => Some(String::new()),
        _ => None,
    };
    let wrong = |page: &str| broken(Path::new("docs/b.md"), page, there);
    assert!(wrong("[a](a.md#its-name-x--画面), [b](a.md#two-1), [b](#x) `[c]`").len() == 1);
    assert_eq!(wrong("\n[a](c.md)"), ["docs/b.md:2: there is no c.md"]);
    assert_eq!(wrong("[a](a.md#its)"), ["docs/b.md:1: docs/a.md has no heading #its"]);
    assert!(wrong("![p](p.svg) [q](q)").len() == 2);
    assert!(wrong("```\n[a](c.md)\n```\n[a](https://example.org/a.md)").is_empty());
}
