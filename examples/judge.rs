//! How good sheets are beside one another: `cargo run --example judge`, with `-- CLIP.bvh` of another clip.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga_lab::quality::Evaluation;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let mut engine = Engine::new(bvh::open(&path)?.clip)?;
    println!(
        "{:>10} {:>9} {:>18} {:>14}",
        "spacing.on", "drawings", "off on screen, %", "genga alone"
    );
    for on in ["1", "2", "3", "1-3"] {
        let mut recipe = Recipe::default();
        recipe.set("spacing.on", on)?;
        let breakdown = engine.run(&recipe, &Edits::default())?;
        let Evaluation { pace, shown, keys, .. } =
            Evaluation::new(breakdown.clip, breakdown.sheet, None, 1.0)?;
        println!("{on:>10} {:>9} {:>18.1} {:>14.1}", pace.drawings, shown.mean, keys.mean);
    }
    Ok(())
}
