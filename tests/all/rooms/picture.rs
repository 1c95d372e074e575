//! The picture of the rooms in `ARCHITECTURE.md`, made from what the files import.
//!
//! `GENGA_PICTURES=write cargo test --test all rooms` makes it again.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use super::{HANDED_ON, ROOMS, module_of, paths, sources, without_comments};
use crate::clips::here;

const PAGE: &str = "ARCHITECTURE.md";
const BEGIN: &str = "<!-- made: rooms -->";
const END: &str = "<!-- end -->";

/// The rooms on the ground, from left to right.
fn upper() -> impl DoubleEndedIterator<Item = &'static str> + Clone {
    ROOMS[1..].iter().flat_map(|rooms| rooms.iter().copied())
}

/// The code that is there when nobody tests.
pub(super) fn untested(code: &str) -> String {
    let mut kept = String::new();
    let mut lines = code.lines();
    while let Some(line) = lines.next() {
        if line.trim() != "#[cfg(test)]" {
            kept += line;
            kept.push('\n');
            continue;
        }
        // What it stands before ends with a `;`, or with a `}` that is as far from the margin.
        let margin = &line[..line.len() - line.trim_start().len()];
        let block = format!("{margin}}}");
        let first = lines.next().unwrap_or_default();
        if !first.ends_with([';', '}']) {
            lines.by_ref().find(|line| *line == block);
        }
    }
    kept
}

/// The rooms that each room imports, but for the ground.
fn imports(files: &[(String, String)]) -> BTreeMap<String, BTreeSet<String>> {
    let mut imports = BTreeMap::<_, BTreeSet<_>>::new();
    for (path, text) in files {
        let module = module_of(path);
        if module.iter().any(|name| name == "tests") {
            continue;
        }
        let code = untested(&without_comments(text));
        let rooms =
            paths(&code, &module).into_iter().filter_map(|(_, path)| path.into_iter().next());
        let is_other = |room: &String| *room != module[0] && upper().any(|other| other == room);
        imports.entry(module[0].clone()).or_default().extend(rooms.filter(is_other));
    }
    imports
}

/// A row a room: under each room that it imports a dot, under each that only others below import a line.
fn drawn(imports: &BTreeMap<String, BTreeSet<String>>, says: impl Fn(&str) -> String) -> String {
    let takes =
        |room: &str, from: &str| imports.get(room).is_some_and(|rooms| rooms.contains(from));
    let mut picture =
        format!("{}   the ground: plain data, for every room\n", ROOMS[0].join(" · "));
    for (row, room) in upper().enumerate() {
        for from in upper().take(row) {
            let is_taken_below = || upper().skip(row).any(|below| takes(below, from));
            picture += match takes(room, from) {
                true => "●  ",
                false if is_taken_below() => "│  ",
                false => "   ",
            };
        }
        picture += &format!("{room}   {}\n", says(room));
    }
    picture
}

/// What the first line of a room's file says, up to its colon or full stop.
fn first_words(room: &str, files: &[(String, String)]) -> String {
    let file = format!("{room}.rs");
    let (_, text) = files.iter().find(|(path, _)| *path == file).unwrap();
    let line = text.lines().next().and_then(|line| line.strip_prefix("//! ")).unwrap();
    line.split([':', '.']).next().unwrap_or_default().replace("**", "")
}

/// The page with a picture between its marks.
fn filled(page: &str, picture: &str) -> String {
    let (before, rest) = page.split_once(BEGIN).unwrap_or_else(|| panic!("{PAGE} has no {BEGIN}"));
    let (_, after) = rest.split_once(END).unwrap_or_else(|| panic!("{PAGE} has no {END}"));
    format!("{before}{BEGIN}\n\n```text\n{picture}```\n\n{END}{after}")
}

#[test]
fn the_picture_of_the_rooms_is_what_they_import() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    let picture = drawn(&imports(&files), |room| first_words(room, &files));
    let page = fs::read_to_string(here(PAGE)).unwrap();
    let made = filled(&page, &picture);
    if std::env::var_os("GENGA_PICTURES").is_some_and(|wish| wish == "write") {
        return fs::write(here(PAGE), made).unwrap();
    }
    let again = "GENGA_PICTURES=write cargo test --test all rooms";
    assert!(
        page == made,
        "{PAGE} does not show what the rooms import; {again} makes it show\n{picture}"
    );
}

#[test]
fn a_room_has_a_dot_under_what_it_imports_and_nothing_else() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let files = [
        file("signal.rs", "use crate::motion::Clip;\n#[cfg(test)]\nmod tests;\n"),
        file("signal/tests.rs", "use crate::exaggerate::Exaggerate;"),
        file(
            "keys/vote.rs",
            "#[cfg(test)]\nmod tests {\n    use crate::exaggerate;\n}\nuse crate::{motion::Clip, time::Frame};",
        ),
        file("timing.rs", "/// [`crate::keys`]\nfn f() { crate::signal::f() }"),
    ];
    let picture = drawn(&imports(&files), |room| room.to_uppercase());
    let rows: Vec<&str> = picture.lines().skip(1).take(5).collect();
    assert_eq!(
        rows,
        [
            "motion   MOTION",
            "│  exaggerate   EXAGGERATE",
            "●     signal   SIGNAL",
            "●     │  keys   KEYS",
            "      ●     timing   TIMING",
        ]
    );
    assert!(HANDED_ON.iter().all(|name| !picture.contains(name)));
}

#[test]
fn the_picture_stands_between_its_marks() {
    let page = format!("before\n{BEGIN}\nold\n{END}\nafter");
    let made = filled(&page, "new\n");
    assert_eq!(made, format!("before\n{BEGIN}\n\n```text\nnew\n```\n\n{END}\nafter"));
    assert_eq!(filled(&made, "new\n"), made);
}
