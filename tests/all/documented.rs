//! Every format and setting is in the docs.

use std::fs;

use genga_files::{FORMATS, Settings};

use crate::clips::here;

#[test]
fn every_format_is_in_the_table_of_formats_with_its_files() {
    let docs = fs::read_to_string(here("docs/formats.md")).unwrap();
    let (_, table) = docs.split_once("## Formats by name").unwrap();
    let (table, _) = table.split_once("\n## ").unwrap();
    for format in FORMATS {
        let begin = format!("| `{}` |", format.name);
        let row = table.lines().find(|line| line.starts_with(&begin));
        let row = row.unwrap_or_else(|| panic!("{} has no row", format.name));
        for file in format.files {
            assert!(row.contains(&format!("`{file}`")), "{} lacks {file}", format.name);
        }
    }
}

#[test]
fn every_setting_of_a_format_is_named_in_the_docs() {
    let page = |name: &str| fs::read_to_string(here("docs").join(name)).unwrap();
    let docs = page("formats.md") + &page("pictures.md");
    let names = Settings::default().names();
    let missing: Vec<_> =
        names.iter().filter(|name| !docs.contains(&format!("`{name}`"))).collect();
    assert!(missing.is_empty(), "{missing:?}");
}

/// Pages that a release has, which has no tests.
#[test]
fn a_test_named_on_a_page_of_a_release_is_said_to_be_in_the_source() {
    for page in ["blender", "farm", "formats", "guide", "input", "pictures"] {
        let text = fs::read_to_string(here(&format!("docs/{page}.md"))).unwrap();
        for paragraph in text.split("\n\n").filter(|paragraph| paragraph.contains("`tests/")) {
            assert!(paragraph.contains("source"), "{page}: {paragraph}");
        }
    }
}
