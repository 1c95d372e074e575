//! Writes what `tests/blender/smooth` compares: `cargo run --release --example smooth_keys -- FOLDER CLIP.bvh…`.
//!
//! For each clip, the folder gets the take and the motion between keys with curves, frame by frame as BVH: for the genga
//! alone, for the keys of `keys-glb`, and for as many keys of other methods. A table says which file is what.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use glam::{DQuat, DVec3};

use genga::edits::Edits;
use genga::keys::with_ends;
use genga::motion::clean::Cleaning;
use genga::motion::{Axis, Channel, Clip, Poser, Stature, bvh, set_local_rotation};
use genga::pipeline::Engine;
use genga::recipe::Recipe;
use genga::time::Frame;
use genga_files::{Curves, Glb, tangents};
use genga_lab::quality::KomaFrames;
use genga_lab::quality::baselines::{Objective, Optimal, Segments};
use genga_read::Options;

type Outcome<T> = Result<T, Box<dyn Error>>;

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
    let kept = sheet.layers[0].shown().filter(|drawing| drawing.role.is_kept());
    let mut genga: Vec<f64> = kept.map(|drawing| drawing.source.place()).collect();
    genga.sort_by(f64::total_cmp);
    genga.dedup();
    let curves = Curves::default();
    let of_error = curves.errors(&clip, &sheet)?.keys;
    let file = Glb::default().write_keys(&clip, &sheet, &curves)?;
    motions.push(("genga.genga".into(), between(&clip, &genga)?));
    motions.push(("error.genga".into(), played(&clip, &file)?));
    for (density, keys) in [("genga", genga.len()), ("error", of_error)] {
        println!("{name}: {keys} keys of {} frames", clip.len());
        rows += &format!("{name},{density},genga,{keys},{height}\n");
        for (method, objective) in
            [("salient-mean", Objective::Mean), ("salient-worst", Objective::Worst)]
        {
            let best = Optimal::new(&segments, objective, keys - 2);
            let found = with_ends(&clip, &grid.frames_at(&best.keys(keys - 2)));
            let found: Vec<f64> = found.iter().map(|frame| frame.0 as f64).collect();
            assert_eq!(found.len(), keys, "{name}: as many keys");
            motions.push((format!("{density}.{method}"), between(&clip, &found)?));
            rows += &format!("{name},{density},{method},{keys},{height}\n");
        }
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

/// Values of a joint as independent numbers: the rotation as a quaternion, and the translation.
const NUMBERS: usize = 7;

/// Puts the same smooth curves through keys on some frames as `keys.glb` has.
fn between(clip: &Clip, keys: &[f64]) -> Outcome<Clip> {
    let channels = NUMBERS * clip.skeleton().len();
    let mut poser = Poser::new(clip);
    let mut samples: Vec<f64> = Vec::with_capacity(channels * clip.len());
    for at in 0..clip.len() {
        let pose = poser.frame(Frame(clip.first().0 + at));
        for (rotation, translation) in pose.rotations.iter().zip(&pose.translations) {
            let mut turn = rotation.to_array();
            // q and −q are the same rotation: a curve through both would turn the long way round.
            if let Some(before) = samples.len().checked_sub(channels) {
                let is_far =
                    turn.iter().zip(&samples[before..]).map(|(a, b)| a * b).sum::<f64>() < 0.0;
                turn = turn.map(|part| if is_far { -part } else { part });
            }
            samples.extend(turn.into_iter().chain(translation.to_array()));
        }
    }
    let keys: Vec<f64> = keys.iter().map(|key| key - clip.first().0 as f64).collect();
    let slopes = tangents(&keys, &samples, channels);
    let value = |place: f64, channel: usize| {
        let before = (place as usize).min(clip.len() - 2);
        let [from, to] = [before, before + 1].map(|frame| samples[frame * channels + channel]);
        from + (place - before as f64) * (to - from)
    };
    let last = keys[keys.len() - 1].floor() as usize;
    let poses = (0..=last).map(|frame| {
        let after = keys.partition_point(|key| *key <= frame as f64).clamp(1, keys.len() - 1);
        let [from, to] = [keys[after - 1], keys[after]];
        let (t, way) = ((frame as f64 - from) / (to - from), to - from);
        let number = |channel: usize| {
            let [leaving, arriving] =
                [after - 1, after].map(|key| slopes[key * channels + channel]);
            let rest = 1.0 - t;
            value(from, channel) * rest * rest * (1.0 + 2.0 * t)
                + value(to, channel) * t * t * (3.0 - 2.0 * t)
                + way * t * rest * (leaving * rest - arriving * t)
        };
        let joint = |joint: usize| {
            let [x, y, z, w, a, b, c] = std::array::from_fn(|at| number(NUMBERS * joint + at));
            (DQuat::from_xyzw(x, y, z, w).normalize(), DVec3::new(a, b, c))
        };
        (0..clip.skeleton().len()).map(joint).collect()
    });
    posed(clip, poses)
}

/// Plays `keys.glb` on the skeleton of the clip.
fn played(clip: &Clip, file: &[u8]) -> Outcome<Clip> {
    let options = Options { fps: Some(clip.rate()), ..Options::default() };
    let read = options.read(file)?.clip;
    let metres = Stature::new(clip).metres;
    let own = |name: &str| read.skeleton().find(name).ok_or_else(|| format!("{name} is not read"));
    let joints = clip.skeleton().joints.iter();
    let own = joints.map(|joint| own(&joint.name)).collect::<Result<Vec<_>, _>>()?;
    let mut poser = Poser::new(&read);
    let poses = (0..read.len().min(clip.len())).map(|at| {
        let pose = poser.frame(Frame(read.first().0 + at));
        own.iter().map(|own| (pose.rotations[own.0], pose.translations[own.0] / metres)).collect()
    });
    posed(clip, poses)
}

/// A motion of a clip's body: the rotation and translation of each joint, frame by frame.
fn posed(clip: &Clip, poses: impl Iterator<Item = Vec<(DQuat, DVec3)>>) -> Outcome<Clip> {
    let (mut rows, mut frames) = (Vec::new(), 0);
    for pose in poses {
        let mut row = clip.row(Frame(clip.first().0 + frames)).to_vec();
        for (joint, (rotation, place)) in clip.skeleton().joints.iter().zip(pose) {
            set_local_rotation(joint, rotation, &mut row);
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
        frames += 1;
    }
    Ok(Clip::new(clip.skeleton().clone(), clip.rate(), clip.first(), frames, rows)?)
}
