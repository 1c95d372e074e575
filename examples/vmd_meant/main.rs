//! Writes VMD files, and beside each a JSON file with its intended content, to test other VMD readers: `cargo run
//! --example vmd_meant -- FOLDER CLIP.bvh…`. `.keys.vmd` has few keys with curves and IK, `.take.vmd` the same motion on
//! every frame without.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use genga::edits::Edits;
use genga::motion::bvh;
use genga::motion::clean::Cleaning;
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::Sheet;
use genga_files::{Curves, Vmd};

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args_os().skip(1).map(PathBuf::from);
    let folder = words.next().ok_or("say a folder and clips")?;
    fs::create_dir_all(&folder)?;
    words.try_for_each(|clip| write(&folder, &clip))
}

fn write(folder: &Path, path: &Path) -> Result<(), Box<dyn Error>> {
    let name = path.file_stem().unwrap_or_default();
    let (clip, _) = Cleaning::default().apply(bvh::read(&fs::read(path)?)?.clip)?;
    let mut engine = Engine::new(clip)?;
    let breakdown = engine.run_once(&Recipe::default(), &Edits::default())?;
    let (vmd, clip) = (Vmd::default(), breakdown.clip);
    let made = vmd.make(clip, breakdown.sheet)?;
    let target = folder.join(name);
    let keys = vmd.make_keys(clip, breakdown.sheet, &Curves::default())?.motion;
    let length = keys.keys.last().map_or(0, |key| key.frame as usize + 1);
    let take = vmd.make(clip, &Sheet::on_ones(clip.clock(vmd.fps), length))?.motion;
    fs::write(target.with_extension("keys.vmd"), keys.bytes()?)?;
    fs::write(target.with_extension("take.vmd"), take.bytes()?)?;
    fs::write(target.with_extension("vmd"), made.motion.bytes()?)?;
    fs::write(target.with_extension("json"), serde_json::to_string(&made.motion)?)?;
    let (keys, bones) = (made.motion.keys.len(), made.report.bones.len());
    println!("{}: {keys} keys of {bones} bones", name.to_string_lossy());
    Ok(())
}
