//! Makes the tables and pictures of `docs/evidence.md` from the real clips beside the project.
//!
//! `cargo run --example evidence` writes them, with `--check` it writes nothing and proves that what
//! is there is what it would write. The bytes are the same on every run: no time is measured.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

mod clips;
mod events;
mod laws;
mod page;
mod papers;
mod poses;
mod rates;
mod rigs;
mod table;
mod windows;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Whatever goes wrong is told to a person and ends the program.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> ExitCode {
    let check = std::env::args().nth(1).is_some_and(|word| word == "--check");
    match run(check) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            println!("evidence: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes what differs, or only says so. Whether all is well.
fn run(check: bool) -> Outcome<bool> {
    let mut is_well = true;
    for (path, text) in made()? {
        let name = path.strip_prefix(root()).unwrap_or(&path).display();
        if fs::read_to_string(&path).is_ok_and(|found| found == text) {
            println!("{name}: as made");
        } else if check {
            println!("{name}: differs from what this program makes");
            is_well = false;
        } else {
            fs::write(&path, text).map_err(|error| format!("{}: {error}", path.display()))?;
            println!("{name}: written");
        }
    }
    Ok(is_well)
}

/// Every file with its text.
fn made() -> Outcome<Vec<(PathBuf, String)>> {
    let docs = root().join("docs");
    let takes = clips::all()?;
    let events = events::read(&docs.join("evidence/events.csv"))?;
    let mut tables = vec![
        ("rates", rates::table(&takes)),
        ("merges", rates::merges(&takes, &events)?),
        ("hits", events::summary(&takes, &events)?),
        ("rests", events::rests(&takes, &events)?),
        ("rigs", rigs::table(&takes)?),
        ("windows", windows::table(&takes)?),
        ("table-1-keys", papers::keys(&root().join("data"))?),
        ("table-1-omission", papers::omission(&root().join("data"))?),
        ("genga-lost", laws::table(&takes)?),
    ];
    tables.push(("events", events::lists(&takes, &events)?));
    let mut files = Vec::new();
    for (name, clip) in poses::PICTURES {
        files.push((docs.join(format!("evidence/{name}-poses.svg")), poses::draw(&takes, clip)?));
    }
    let page = docs.join("evidence.md");
    let text = fs::read_to_string(&page).map_err(|error| format!("{}: {error}", page.display()))?;
    files.push((page, page::filled(&text, &tables)?));
    Ok(files)
}

/// The project's folder.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
