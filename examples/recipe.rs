//! Your own recipe, from text and knob by knob: `cargo run --example recipe`, with `-- CLIP.bvh` on another clip.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::{Knob, Recipe};

const OWN: &str = "
[spacing]
on = \"2-3\"           # twos and threes, by how fast it is

[edits]
pins = [{ frame = 30, name = \"wind-up\" }]
";

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let mut engine = Engine::new(bvh::open(&path)?.clip)?;
    let (mut recipe, edits) = Recipe::parse(OWN)?;
    for price in ["7.5", "15", "30"] {
        recipe.set("keys.min_price", price)?;
        let breakdown = engine.run(&recipe, &edits)?;
        let (keys, layer) =
            (breakdown.first_layer().keys.keys.len(), breakdown.sheet.first_layer()?);
        println!(
            "keys.min_price = {price:<4} {keys:>2} genga, {:>2} drawings",
            layer.drawings.len()
        );
    }
    println!("{}", Knob::find("keys.min_price")?.help);
    if let Err(error) = recipe.set("keys.min_prize", "15") {
        println!("{error}");
    }
    Ok(())
}
