//! Writes one format into a folder: `cargo run --example deliver`, with `-- FORMAT DIR` another one, elsewhere.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_files::{Cut, Format, Settings};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let format = Format::find(&words.next().unwrap_or("xdts".into()))?;
    let folder = words.next().map_or(std::env::temp_dir().join("genga-deliver"), PathBuf::from);
    let mut engine = Engine::new(bvh::open("data/kick.bvh".as_ref())?.clip)?;
    let breakdown = engine.run(&Recipe::default(), &Edits::default())?;
    let cut = Cut {
        name: "s03_c012",
        clip_file: "kick.bvh",
        clip: breakdown.clip,
        exaggerated: None,
        sheet: breakdown.sheet,
        spaced: Some(breakdown.spaced),
        splits: &[],
        made_with: None,
    };
    println!("{}: {}", format.name, format.help);
    fs::create_dir_all(&folder)?;
    Ok(format.write(&cut, &Settings::default(), &mut |name, bytes| {
        println!("{name}: {} bytes", bytes.len());
        let failed = |source| genga::Error::Io { path: folder.join(name), source };
        fs::write(folder.join(name), bytes).map_err(failed)
    })?)
}
