//! Draws the genga as poses in a row (SVG): `cargo run --example picture`, with `-- POSES.svg` into that file.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::fs;
use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_plot::PoseRow;

fn main() -> Result<(), Box<dyn Error>> {
    let made = || std::env::temp_dir().join("genga-poses.svg");
    let path = std::env::args_os().nth(1).map_or_else(made, PathBuf::from);
    let mut engine = Engine::new(bvh::open("data/kick.bvh".as_ref())?.clip)?;
    let breakdown = engine.run(&Recipe::default(), &Edits::default())?;

    let picture = PoseRow { figure_height: 120, in_line: 6, ..PoseRow::default() };
    let svg = picture.draw_kept(breakdown.clip, breakdown.sheet)?;
    fs::write(&path, &svg)?;
    let kept =
        breakdown.sheet.first_layer()?.drawings.iter().filter(|drawing| drawing.role.is_kept());
    println!("{} figures, six in a row, as SVG", kept.count());

    // An impossible setting is refused with a hint.
    let too_small = PoseRow { figure_height: 4, ..picture };
    if let Err(error) = too_small.draw_kept(breakdown.clip, breakdown.sheet) {
        println!("{error}");
    }
    Ok(())
}
