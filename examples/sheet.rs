//! A timesheet with corrections of a person: `cargo run --example sheet`, with `-- CLIP.bvh` of another clip.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::edits::{Edits, Forbidden, Pin};
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Role;
use genga::time::Frame;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let mut engine = Engine::new(bvh::open(&path)?.clip)?;
    let corrected = Edits {
        pins: vec![Pin::parse("30:wind-up@0.5")?],
        forbidden: vec![Forbidden::one(Frame(40))],
        ..Edits::default()
    };
    for edits in [Edits::default(), corrected] {
        let breakdown = engine.run(&Recipe::default(), &edits)?;
        let layer = breakdown.sheet.first_layer()?;
        // Prints a column of the sheet, one letter per koma: O genga, X end, o inbetween, | the drawing before it
        // stays.
        let letters = layer.exposures.iter().map(|exposure| {
            let letter = match layer.drawings[exposure.drawing].role {
                Role::Genga => "O",
                Role::End => "X",
                Role::Inbetween => "o",
            };
            letter.to_owned() + &"|".repeat(exposure.koma - 1)
        });
        println!("{}", letters.collect::<String>());
    }
    Ok(())
}
