//! Checks that the files shown in `docs/formats.md` are those that the program writes and reads.

use std::fs;

use genga::recipe::Recipe;

use super::page::{blocks, page};
use super::reader::{place, said};

/// The block of the page that contains a line.
fn block_with(line: &str) -> String {
    let page = page("docs/formats.md");
    let found = blocks(&page).into_iter().find(|block| block.lines.contains(&line));
    found.unwrap_or_else(|| panic!("no block has {line}")).lines.join("\n") + "\n"
}

/// The pieces of a shown file between omissions (`…`), trimmed.
fn shown(block: &str) -> Vec<&str> {
    block.split('…').map(str::trim).filter(|piece| !piece.is_empty()).collect()
}

/// The first piece that does not occur in a text after the pieces before it.
fn missing<'a>(block: &'a str, text: &str) -> Option<&'a str> {
    let mut rest = text;
    shown(block).into_iter().find(|piece| {
        let behind = rest.split_once(piece).map(|(_, behind)| behind);
        rest = behind.unwrap_or(rest);
        behind.is_none()
    })
}

#[test]
fn the_sheet_that_is_shown_is_the_one_that_is_written() {
    let place = place();
    said("genga run data/kick.bvh", place.path()).unwrap();
    let written = fs::read_to_string(place.path().join("kick-genga/sheet.json")).unwrap();
    let block = block_with("  \"schema\": \"genga-sheet-2\",");
    assert_eq!(missing(&block, &written), None);
    assert!(missing(&block.replace("92", "93"), &written).is_some(), "a wrong one is seen");
}

#[test]
fn corrections_as_shown_are_read() {
    let block = block_with("[[edits.pins]]");
    let (recipe, edits) = Recipe::parse(&block).unwrap();
    assert!(edits.only_pins && edits.pins.len() == 1 && edits.moves.len() == 1, "{edits:?}");
    assert_eq!(edits.forbidden.len() + edits.splits.len() + edits.holds.len(), 5, "{edits:?}");
    assert_eq!(Recipe::parse(&recipe.write(&edits)).unwrap(), (recipe, edits));
    assert!(Recipe::parse(&block.replace("koma = 6", "komas = 6")).is_err());
}
