//! The rooms inside of `motion`: a file imports only from those above its own.

use std::collections::BTreeMap;
use std::fs;

use super::{module_of, paths, sources, without_comments};
use crate::clips::here;

/// From the top down.
const ROOMS: [&str; 7] = ["axis", "lanes", "clip", "body", "seen", "composite", "read"];

fn place(room: &str) -> Option<usize> {
    ROOMS.iter().position(|own| *own == room)
}

/// From which of its rooms `motion.rs` hands on each name.
fn handed_on(motion: &str) -> BTreeMap<String, String> {
    let paths = paths(&without_comments(motion), &["motion".to_owned()]);
    let of = |(_, path): (usize, Vec<String>)| Some((path.get(2)?.clone(), path[1].clone()));
    paths.into_iter().filter_map(of).collect()
}

/// What is wrong with a file of `motion`, one line each; what its tests import is no part of it.
fn violations(path: &str, text: &str, handed_on: &BTreeMap<String, String>) -> Vec<String> {
    let module = module_of(path);
    let Some(own) = place(&module[1]) else {
        return vec![format!("{path}: {} is no room", module[1])];
    };
    let code = without_comments(text.split("#[cfg(test)]").next().unwrap_or_default());
    let wrong = |(line, target): (usize, Vec<String>)| {
        let [first, name, ..] = &target[..] else { return None };
        let room = place(name)
            .map_or_else(|| handed_on.get(name).map(String::as_str), |at| Some(ROOMS[at]));
        match (first == "motion").then(|| room.and_then(place)) {
            None => None,
            Some(None) => Some(format!("{path}:{line}: {name} is of no room")),
            Some(Some(other)) if other <= own => None,
            Some(Some(_)) => Some(format!("{path}:{line}: {} may not import {name}", module[1])),
        }
    };
    let mut found: Vec<_> = paths(&code, &module).into_iter().filter_map(wrong).collect();
    found.dedup();
    found
}

#[test]
fn every_room_of_motion_imports_only_from_above() {
    let mut files = Vec::new();
    sources(&here("src/motion"), "motion/", &mut files);
    files.retain(|(path, _)| !path.contains("/tests"));
    assert!(files.len() > 30, "only {} files were found", files.len());
    let handed_on = handed_on(&fs::read_to_string(here("src/motion.rs")).unwrap());
    assert_eq!(handed_on.get("Clip").map(String::as_str), Some("clip"));
    let wrong = |(path, text): &(String, String)| violations(path, text, &handed_on);
    let wrong: Vec<String> = files.iter().flat_map(wrong).collect();
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

#[test]
fn an_import_from_below_is_found_under_the_name_that_is_handed_on() {
    let handed_on =
        handed_on("mod clip;\nmod read;\npub use clip::Clip;\npub use read::{Camera, bvh};\n");
    let of = |path, text| violations(path, text, &handed_on).join(" ");
    assert_eq!(of("motion/read/bvh.rs", "use crate::motion::{Clip, Camera};"), "");
    assert_eq!(of("motion/body.rs", "use crate::time::Frame;\nuse crate::motion::Clip;"), "");
    assert_eq!(
        of("motion/clip/a.rs", "use crate::motion::bvh;"),
        "motion/clip/a.rs:1: clip may not import bvh"
    );
    assert_eq!(
        of("motion/clip.rs", "use super::body::Leg;"),
        "motion/clip.rs:1: clip may not import body"
    );
    assert_eq!(of("motion/body/a.rs", "#[cfg(test)]\nuse crate::motion::bvh;"), "");
    assert_eq!(
        of("motion/seen.rs", "use crate::motion::Gauge;"),
        "motion/seen.rs:1: Gauge is of no room"
    );
}
