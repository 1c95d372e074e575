//! Makes the tables, pictures and numbers of three pages: `docs/lab/reproduction.md` compares both papers with this
//! program, `docs/lab/evidence.md` shows how good its keys are on real clips, and `docs/lab/quality.md` compares its keys with
//! those of other methods.
//!
//! `cargo run --release --example reproduce` writes them. With `-- --check` it writes nothing and proves that the files
//! are what it would write: the bytes are the same on every run, except for tables of times.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

mod chain;
mod evidence;
mod kitamura;
#[path = "../../tests/all/known_keys/made.rs"]
mod known;
mod kuroda_tokoi;
mod on_screen;
mod ones;
mod page;
mod part;
mod quality;
#[path = "../../tests/real/mod.rs"]
mod real;
mod samples;
mod steady;
mod table;
mod takes;
mod windows;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::part::Part;
use crate::takes::Take;

/// The result of a fallible step; an error is printed and ends the program.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error>>;

/// Makes a part of a page from the samples of `data/`.
type FromSamples = fn() -> Outcome<Part>;

/// Makes a part of a page from the real clips. If the clips are missing, the part is left as it is.
type FromTakes = fn(&[Take]) -> Outcome<Part>;

/// A page of `docs`. Its pictures are in a folder of the same name.
struct Page {
    name: &'static str,
    from_samples: &'static [FromSamples],
    from_takes: &'static [FromTakes],
    /// Whether every number in the prose must be a made one.
    is_bound: bool,
}

const PAGES: [Page; 3] = [
    Page {
        name: "reproduction",
        from_samples: &[kuroda_tokoi::from_samples, kitamura::from_samples, steady::from_samples],
        from_takes: &[
            kuroda_tokoi::from_takes,
            kitamura::from_takes,
            chain::from_takes,
            steady::from_takes,
        ],
        is_bound: true,
    },
    Page {
        name: "evidence",
        from_samples: &[evidence::from_samples],
        from_takes: &[evidence::from_takes],
        is_bound: false,
    },
    Page { name: "quality", from_samples: &[], from_takes: &[quality::from_takes], is_bound: true },
];

fn main() -> ExitCode {
    let check = std::env::args().nth(1).is_some_and(|word| word == "--check");
    match run(check) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            println!("reproduce: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Writes the files that differ, or with `check` only reports them. Returns whether all is well.
fn run(check: bool) -> Outcome<bool> {
    // Times of an unoptimised build would be meaningless.
    let times = !check && !cfg!(debug_assertions);
    let takes = takes::all()?;
    if takes.is_empty() {
        println!(
            "LEFT OUT: what these pages show of real clips stays as it is, for not all of them are there"
        );
    }
    let mut is_well = true;
    for page in &PAGES {
        for (path, text) in page.files(&takes, times)? {
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
    }
    Ok(is_well)
}

impl Page {
    /// Returns the page and its pictures, each as path and text.
    fn files(&self, takes: &[Take], times: bool) -> Outcome<Vec<(PathBuf, String)>> {
        let docs = root().join("docs/lab");
        let part = self.made(takes)?;
        let path = docs.join(format!("{}.md", self.name));
        let text =
            fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let text = page::filled(&text, &part, times)?;
        if !takes.is_empty() {
            page::all_is_made(&text, &part)?;
        }
        if let (true, [first, rest @ ..]) = (self.is_bound, &*page::loose_numbers(&text)) {
            let more = rest.len();
            let message = format!("\"{first}\" and {more} more numbers of the prose are by hand");
            return Err(format!("{}: {message}", path.display()).into());
        }
        let folder = docs.join(self.name);
        if !part.pictures.is_empty() {
            fs::create_dir_all(&folder)?;
        }
        let pictures = part.pictures.into_iter().map(|(name, svg)| (folder.join(name), svg));
        Ok([(path, text)].into_iter().chain(pictures).collect())
    }

    fn made(&self, takes: &[Take]) -> Outcome<Part> {
        let mut part = Part::default();
        for make in self.from_samples {
            part.join(make()?);
        }
        if !takes.is_empty() {
            for make in self.from_takes {
                part.join(make(takes)?);
            }
        }
        Ok(part)
    }
}

/// The repository's root folder.
pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
