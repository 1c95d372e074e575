//! Numbered files that a longer sheet left behind.
//!
//! They are named and not removed: numbered images are made to be drawn over, and a drawing is a
//! person's work whatever its number.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The files that continue the numbers of some that were written, and were not written with them.
pub(super) fn stale(folder: &Path, written: &[String]) -> Vec<String> {
    let series: BTreeSet<_> = written.iter().filter_map(|name| series(name)).collect();
    let written: BTreeSet<&str> = written.iter().map(String::as_str).collect();
    let mut stale = Vec::new();
    for (inside, begin, end) in series {
        let Ok(entries) = fs::read_dir(folder.join(inside)) else { continue };
        for entry in entries.flatten().filter(|entry| entry.path().is_file()) {
            let file = entry.file_name().to_string_lossy().into_owned();
            let number = file.strip_prefix(&begin).and_then(|rest| rest.strip_suffix(end));
            let name = format!("{inside}{file}");
            if number.is_some_and(is_number) && !written.contains(&name[..]) {
                stale.push(name);
            }
        }
    }
    stale.sort();
    stale
}

/// The folder of a numbered file with its `/`, and what stands before and behind the number. The first
/// page of a picture has none.
fn series(name: &str) -> Option<(&str, String, &str)> {
    let (inside, file) = name.split_at(name.rfind('/').map_or(0, |at| at + 1));
    let (stem, end) = file.split_at(file.rfind('.')?);
    let begin = stem.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let begin = if begin == stem { format!("{stem}-") } else { begin.into() };
    Some((inside, begin, end))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_longer_sheet_left_is_told_from_what_a_person_put_there() {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("images")).unwrap();
        fs::create_dir(place.path().join("strip-4.svg")).unwrap();
        for file in
            ["strip.svg", "strip-2.svg", "strip-3.svg", "strip-b.svg", "strip-2.png", "strip2.svg"]
        {
            fs::write(place.path().join(file), "").unwrap();
        }
        for file in ["A_0001.png", "A_0002.png", "A_0002b.png", "B_0002.png", "A_.png"] {
            fs::write(place.path().join("images").join(file), "").unwrap();
        }
        let left = |written: &[&str]| {
            let written: Vec<_> = written.iter().map(|name| (*name).to_owned()).collect();
            stale(place.path(), &written)
        };
        assert_eq!(left(&["strip.svg"]), ["strip-2.svg", "strip-3.svg"]);
        assert_eq!(left(&["strip.svg", "strip-2.svg"]), ["strip-3.svg"]);
        assert_eq!(left(&["images/A_0001.png"]), ["images/A_0002.png"]);
        assert_eq!(left(&["images/A_0001.png", "images/A_0002.png"]), [""; 0]);
    }
}
