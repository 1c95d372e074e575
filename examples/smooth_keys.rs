//! Writes what `tests/blender/smooth` compares: `cargo run --release --example smooth_keys -- FOLDER CLIP.bvh…`.
//!
//! For each clip, the folder gets the take and the motion between keys with curves, frame by frame as BVH: for the genga
//! alone, for the keys of `keys-glb`, and for as many keys of other methods. A table says which file is what.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use genga::edits::Edits;
use genga::keys::with_ends;
use genga::motion::clean::Cleaning;
use genga::motion::{Axis, Channel, Clip, Poser, Stature, bvh, set_local_rotation};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::sheet::{Drawing, Exposure, Layer, Role, Sheet, Source};
use genga::time::Frame;
use genga_files::{Curves, Glb};
use genga_lab::quality::KomaFrames;
use genga_lab::quality::baselines::{Objective, Optimal, Segments};
use genga_read::Options;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// As much error as keeps every set of keys as it is.
const ANY: f64 = 1.0;

fn main() -> Outcome<()> {
    let mut words = std::env::args_os().skip(1).map(PathBuf::from);
    let folder = words.next().ok_or("say a folder and clips")?;
    fs::create_dir_all(&folder)?;
    let mut table = String::from("clip,density,method,keys,height\n");
    for clip in words {
        table += &write(&folder, &clip)?;
    }
    fs::write(folder.join("made.csv"), table)?;
    Ok(())
}

/// Writes the motions of a clip, and returns their rows of the table.
fn write(folder: &Path, path: &Path) -> Outcome<String> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let (clip, _) = Cleaning::default().apply(bvh::read(&fs::read(path)?)?.clip)?;
    let mut engine = Engine::new(clip.clone())?;
    let sheet = engine.run(&Recipe::default(), &Edits::default())?.sheet.clone();
    let height = Stature::new(&clip).size;
    // Salient Poses chooses among all frames, not among koma.
    let grid = KomaFrames::new(clip.clone().into(), clip.clock(clip.rate().fps()));
    let segments = Segments::new(&grid);
    let (mut rows, mut motions) = (String::new(), vec![("take".to_owned(), clip.clone())]);
    for (density, error) in [("genga", ANY), ("error", Curves::default().error)] {
        let curves = Curves { error };
        let keys = curves.errors(&clip, &sheet)?.keys;
        let mut sheets = vec![("genga", sheet.clone(), curves)];
        for (method, objective) in
            [("salient-mean", Objective::Mean), ("salient-worst", Objective::Worst)]
        {
            let best = Optimal::new(&segments, objective, keys - 2);
            let keys = with_ends(&clip, &grid.frames_at(&best.keys(keys - 2)));
            sheets.push((method, of_keys(&clip, &keys), Curves { error: ANY }));
        }
        for (method, sheet, curves) in sheets {
            assert_eq!(curves.errors(&clip, &sheet)?.keys, keys, "{name}: as many keys");
            motions.push((format!("{density}.{method}"), played(&clip, &sheet, &curves)?));
            rows += &format!("{name},{density},{method},{keys},{height}\n");
        }
        println!("{name}: {keys} keys of {} frames", clip.len());
    }
    // The last drawing may show a frame before the last one.
    let frames = motions.iter().map(|(_, motion)| motion.len()).min().unwrap_or_default();
    for (what, motion) in motions {
        let mut writer = bvh::Writer::new(motion.skeleton(), motion.rate());
        writer.rows(motion.rows().take(frames));
        fs::write(folder.join(format!("{name}.{what}.bvh")), writer.finish())?;
    }
    Ok(rows)
}

/// A sheet whose genga stand on some frames.
fn of_keys(clip: &Clip, keys: &[Frame]) -> Sheet {
    let drawing =
        |key: &Frame| Drawing::new(Source::At(key.0 as f64), Role::Genga, Default::default());
    let exposure = |drawing: usize| Exposure { drawing, koma: 1 };
    let layer = Layer {
        name: "A".into(),
        joints: Vec::new(),
        drawings: keys.iter().map(drawing).collect(),
        exposures: (0..keys.len()).map(exposure).collect(),
        gone: Vec::new(),
    };
    Sheet::new(clip.clock(24.0), vec![layer])
}

/// Plays `keys.glb` on the skeleton of the clip.
fn played(clip: &Clip, sheet: &Sheet, curves: &Curves) -> Outcome<Clip> {
    let file = Glb::default().write_keys(clip, sheet, curves)?;
    let options = Options { fps: Some(clip.rate()), ..Options::default() };
    let read = options.read(&file)?.clip;
    let metres = Stature::new(clip).metres;
    let joints = &clip.skeleton().joints;
    let own = |name: &str| read.skeleton().find(name).ok_or_else(|| format!("{name} is not read"));
    let own = joints.iter().map(|joint| own(&joint.name)).collect::<Result<Vec<_>, _>>()?;
    let mut poser = Poser::new(&read);
    let mut rows = Vec::new();
    let frames = read.len().min(clip.len());
    for at in 0..frames {
        let pose = poser.frame(Frame(read.first().0 + at));
        let mut row = clip.row(Frame(clip.first().0 + at)).to_vec();
        for (joint, own) in joints.iter().zip(&own) {
            set_local_rotation(joint, pose.rotations[own.0], &mut row);
            let place = pose.translations[own.0] / metres;
            for (channel, value) in joint.channels.iter().zip(&mut row[joint.first_channel..]) {
                match channel {
                    Channel::Position(Axis::X) => *value = place.x,
                    Channel::Position(Axis::Y) => *value = place.y,
                    Channel::Position(Axis::Z) => *value = place.z,
                    Channel::Rotation(_) => {}
                }
            }
        }
        rows.extend(row);
    }
    Ok(Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), frames, rows)?)
}
