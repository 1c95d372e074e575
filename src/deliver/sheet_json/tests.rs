//! What is written reads back, and what is wrong is said with its place.

use super::*;
use crate::deliver::Cut;
use crate::deliver::tests::{edits, recipe, wave};
use crate::error::Error;
use crate::motion::Clip;
use crate::pipeline::Engine;

/// The sheet of the wave.
fn file() -> (Clip, SheetFile) {
    let (recipe, edits) = (recipe(), edits());
    let mut engine = Engine::new(wave()).unwrap();
    let breakdown = engine.run(&recipe, &edits).unwrap();
    let cut = Cut {
        name: "波 \"wave\"",
        clip_file: "wave.bvh",
        clip: breakdown.clip,
        sheet: breakdown.sheet,
        spaced: None,
        made_with: Some((&recipe, &edits)),
    };
    (wave(), SheetFile::of(&cut))
}

fn said(error: Error) -> String {
    error.to_string()
}

#[test]
fn the_sheet_looks_as_it_did() {
    insta::assert_snapshot!(file().1.write().unwrap());
}

#[test]
fn what_is_written_reads_back() {
    let (_, file) = file();
    let text = file.write().unwrap();
    let again = read(text.as_bytes()).unwrap();
    assert_eq!(again, file);
    assert_eq!(again.write().unwrap(), text);
}

#[test]
fn another_version_is_named() {
    let text = file().1.write().unwrap().replace(SCHEMA, "genga-sheet-7");
    let error = said(read(text.as_bytes()).unwrap_err());
    assert!(error.starts_with("2:13: the sheet is of the schema genga-sheet-7"), "{error}");
}
