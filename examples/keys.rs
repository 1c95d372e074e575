//! The genga of a clip, each with its reason: `cargo run --example keys`, with `-- CLIP.bvh` of another one.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::edits::Edits;
use genga::motion::bvh;
use genga::motion::clean::Cleaning;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let (clip, _) = Cleaning::default().apply(bvh::open(&path)?.clip)?;
    let names: Vec<_> = clip.skeleton().joints.iter().map(|joint| joint.name.clone()).collect();

    let mut engine = Engine::new(clip)?;
    let found = engine.find_keys(&Recipe::default(), &Edits::default())?;
    println!("{} turns of the body, {} genga:", found.body.turns.len(), found.keys.keys.len());
    for key in &found.keys.keys {
        let reason = key.origin.reason().word();
        let turning: Vec<_> = key.voters.iter().take(2).map(|joint| &names[joint.0][..]).collect();
        // The price is the error in % of body height without this key; the end of a rest is kept at any price.
        println!(
            "frame {:>2} {reason:<5} saves {:>4.1} {}",
            key.frame,
            key.price,
            turning.join(" ")
        );
    }
    Ok(())
}
