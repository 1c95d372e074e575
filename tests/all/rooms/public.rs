//! What is public is shown, and enough for the program and the window, but for the parts of pictures.

use super::picture::untested;
use super::{ROOMS, module_of, paths, sources, without_comments};
use crate::clips::here;

/// Who stands where anybody outside stands.
const OUTSIDE: [&str; 2] = ["cli", "studio"];
/// What the library keeps to itself.
const INSIDE: &str = "maths";
/// What the window shares with the pictures.
const SHARED: [&str; 2] = ["plot", "parts"];

/// Whether a file opens a name to the crate alone.
fn hides(code: &str, name: &str) -> bool {
    let items = code.split("\npub(crate) ").skip(1).map(|item| match item.starts_with("use ") {
        true => item.split(';').next().unwrap_or_default(),
        false => item.split(['(', '<', '{', '=', ':', ';']).next().unwrap_or_default(),
    });
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    items.flat_map(|item| item.split(|c| !is_part(c))).any(|word| word == name)
}

/// What files outside import that is hidden, one line each.
fn hidden(files: &[(String, String)]) -> Vec<String> {
    let code = |path: &[String]| {
        let file = path.join("/") + ".rs";
        let (_, text) = files.iter().find(|(path, _)| *path == file)?;
        Some(format!("\n{}", untested(&without_comments(text))))
    };
    let is_hidden = |path: &Vec<String>| {
        let at = |depth: usize| code(&path[..depth]).is_some_and(|code| hides(&code, &path[depth]));
        !path.starts_with(&SHARED.map(String::from)) && (1..path.len()).any(at)
    };
    let mut found = Vec::new();
    for (file, text) in files {
        let module = module_of(file);
        if OUTSIDE.contains(&&module[0][..]) {
            let paths = paths(&untested(&without_comments(text)), &module).into_iter();
            let others = paths.filter(|(_, path)| path[0] != module[0] && is_hidden(path));
            found.extend(others.map(|(line, path)| format!("{file}:{line}: {}", path.join("::"))));
        }
    }
    found
}

#[test]
fn the_program_and_the_window_import_what_is_public() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    assert_eq!(hidden(&files), [""; 0]);
}

#[test]
fn what_is_hidden_is_found_however_it_is_opened() {
    let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
    let motion = "pub mod bvh;\npub(crate) mod rig;\npub(crate) use build::{Build, Plan};\npub use clip::Clip;\n\
        pub(crate) const fn plain() {}\npub(crate) struct Wide<Clip>(Clip);\n";
    for (import, found) in [
        ("use crate::motion::{Clip, bvh};", vec![]),
        ("use crate::plot::parts::Figure;", vec![]),
        ("use crate::motion::rig::Rig;", vec!["studio/a.rs:1: motion::rig::Rig"]),
        ("use crate::motion::{Clip, Plan};", vec!["studio/a.rs:1: motion::Plan"]),
        ("fn f() { crate::motion::plain() }", vec!["studio/a.rs:1: motion::plain"]),
        ("use crate::motion::bvh::Lines;", vec!["studio/a.rs:1: motion::bvh::Lines"]),
    ] {
        let files = [
            file("motion.rs", motion),
            file("motion/bvh.rs", "pub(crate) type Lines = u8;"),
            file("plot.rs", "pub(crate) mod parts;"),
            file("studio/a.rs", import),
            file("timing.rs", "use crate::motion::rig;"),
        ];
        assert_eq!(hidden(&files), found, "{import}");
    }
}

#[test]
fn every_room_of_the_library_shows_how_it_is_used() {
    let mut files = Vec::new();
    sources(&here("src"), "", &mut files);
    let is_shown = |room: &&str| !OUTSIDE.contains(room) && *room != INSIDE;
    for room in ROOMS.concat().into_iter().filter(is_shown) {
        let of_room = |path: &str| module_of(path)[0] == room;
        let mut texts = files.iter().filter(|(path, _)| of_room(path)).map(|(_, text)| text);
        assert!(texts.any(|text| text.contains("/// ```\n")), "no item of {room} has an example");
    }
}
