//! Runs after all other tests. Reports which of them looked at fewer real clips than they should, and which went
//! without a third-party program.

#![allow(clippy::print_stdout, reason = "it says what was left out")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

mod real;

fn main() {
    // This is no test harness: it has no tests to list, as some runners ask first.
    if std::env::args().any(|word| word == "--list") {
        return;
    }
    let records = real::records();
    let list = real::built().join("left-out.txt");
    let text = fs::read_to_string(&records).unwrap_or_default();
    let lines = text.lines().filter_map(|line| line.rsplit_once(' '));
    let (of_clips, of_programs): (Vec<_>, Vec<_>) =
        lines.partition(|(_, what)| real::NAMES.contains(what));
    let mut clips: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for (test, clip) in of_clips {
        clips.entry(test).or_default().insert(clip);
    }
    let list_of = |missing: &BTreeSet<&str>| missing.iter().copied().collect::<Vec<_>>().join(",");
    let rows: String =
        clips.iter().map(|(test, missing)| format!("{test} {}\n", list_of(missing))).collect();
    fs::write(&list, rows).expect("the folder of the build can be written");
    if text.is_empty() {
        println!("nothing was left out: the tests that ran had all that they look at");
        return;
    }
    fs::remove_file(&records).expect("the records were read");
    for (test, program) in BTreeSet::from_iter(of_programs) {
        println!("LEFT OUT: {test} goes without {program}, which is not here");
    }
    if clips.is_empty() {
        return;
    }
    let whole = clips.values().filter(|missing| missing.len() == real::NAMES.len()).count();
    println!(
        "LEFT OUT: {} tests looked at fewer real clips than they should, {whole} of them at none of {}.\n\
         Their names are in {}.\n\
         To run them too: put the BVH files that docs/lab/evidence.md names into a folder, and name it by GENGA_CLIPS.",
        clips.len(),
        real::NAMES.len(),
        list.display(),
    );
}
