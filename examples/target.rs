//! A sheet of so many drawings a second, without turning a knob: `cargo run --example target`, or `-- CLIP.bvh`.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::target::{Target, meet};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let mut engine = Engine::new(bvh::open(&path)?.clip)?;
    let (recipe, edits) = (Recipe::default(), Edits::default());
    let met =
        meet(&mut engine, &recipe, &edits, &[Target::Keys(8), Target::DrawingsPerSecond(6.0)])?;
    for outcome in &met.outcomes {
        println!("{:?}: {:.2} reached", outcome.target, outcome.reached);
        outcome.shortfall.iter().for_each(|why| println!("  {why}"));
    }
    // The settings found are a recipe like any other.
    let (before, after) = (recipe.settings(), met.recipe.settings());
    for ((name, was), (_, is)) in before.iter().zip(&after).filter(|(was, is)| was != is) {
        println!("{name} = {is} (was {was})");
    }
    Ok(())
}
