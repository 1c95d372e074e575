//! Filter width against the number of keys, as a table: `cargo run --example widths`, with `-- CLIP.bvh` of another clip.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::motion::bvh;
use genga::pipeline::Budget;
use genga::recipe::Recipe;
use genga_lab::study::{Axis, Measure, Study};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let study = Study {
        recipe: Recipe::default(),
        x: Axis::new("filter.width", "0.05s..0.35s:0.1s")?,
        y: Some(Axis::new("filter.kind", "box,gaussian,butterworth")?),
        measures: vec![Measure::Union, Measure::Turns, Measure::Genga],
        keep_keys: false,
        budget: Budget::default(),
    };
    let grid = study.run(bvh::open(&path)?.clip, || {})?;
    println!("joints' key frames / turns of the body / genga");
    print!("{:>12}", "filter.width");
    study.y.iter().flat_map(|kinds| kinds.values()).for_each(|kind| print!("{kind:>14}"));
    println!();
    for (x, width) in study.x.values().iter().enumerate() {
        print!("{width:>12}");
        for y in 0..grid.rows() {
            let counts: Vec<_> = grid.cell(x, y).values.iter().map(f64::to_string).collect();
            print!("{:>14}", counts.join(" / "));
        }
        println!();
    }
    Ok(())
}
