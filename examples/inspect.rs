//! Reads a BVH file and says what is in it: `cargo run --example inspect`, with `-- CLIP.bvh` another one.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::path::PathBuf;

use genga::motion::clean::Cleaning;
use genga::motion::{Stature, Unit, bvh};

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map_or("data/kick.bvh".into(), PathBuf::from);
    let read = bvh::open(&path)?;
    // Removes a T-pose in front of the motion, which would be its fastest frame.
    let (clip, cleaned) = Cleaning::default().apply(read.clip)?;
    for warning in read.warnings.iter().chain(&cleaned) {
        println!("{warning}");
    }
    println!("{} frames at {} a second: {:.2} s", clip.len(), clip.rate(), clip.seconds());

    let skeleton = clip.skeleton();
    println!("{} joints with {} channels", skeleton.len(), skeleton.channels());
    for joint in &skeleton.joints[..4] {
        let parent = joint.parent.map_or("nothing", |parent| &skeleton.joints[parent.0].name);
        println!("  {} hangs on {parent}", joint.name);
    }

    let Stature { size, up, .. } = Stature::new(&clip);
    println!("{size:.0} units high along {up:?}; a unit is probably a {:?}", Unit::nearest(size));
    Ok(())
}
