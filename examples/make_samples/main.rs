//! Makes the sample motions of `data/`: five actions of one performer, defined by key poses.
//!
//! `cargo run --example make_samples` writes them; `--check` proves that the existing files are identical. The bytes
//! are the same on every run.

#![allow(clippy::print_stdout, reason = "a program that reports to a person")]

pub(crate) mod actions;
mod bvh_text;
mod feet;
mod limb;
mod noise;
pub(crate) mod perform;
pub(crate) mod score;
mod skeleton;
mod track;

use std::path::PathBuf;
use std::process::ExitCode;

use glam::DVec3;

use self::perform::{Body, Performance};
use self::score::{Key, Score};

fn main() -> ExitCode {
    let check = std::env::args().nth(1).is_some_and(|word| word == "--check");
    let mut code = ExitCode::SUCCESS;
    for score in actions::all() {
        let performance = Performance::new(&score);
        let text = file(&score, &performance);
        let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../data").join(score.file);
        if check {
            if std::fs::read_to_string(&path).is_ok_and(|found| found == text) {
                println!("{}: as made", score.file);
            } else {
                println!("{}: differs from what this program makes", score.file);
                code = ExitCode::FAILURE;
            }
        } else if let Err(error) = std::fs::write(&path, text) {
            println!("{}: {error}", path.display());
            return ExitCode::FAILURE;
        } else {
            describe(&score, &performance);
        }
    }
    code
}

/// Returns the text of a sample's file.
pub(crate) fn file(score: &Score, performance: &Performance) -> String {
    bvh_text::text(score.fps, &performance.rows())
}

/// Prints the named poses and the fastest hand and foot.
fn describe(score: &Score, performance: &Performance) {
    println!("{}: {} frames at {} fps", score.file, score.frames, score.fps);
    println!("  {}", timeline(score));
    for (joint, name) in
        [(15, "left hand"), (19, "right hand"), (3, "left foot"), (7, "right foot")]
    {
        let (wrist, at) = peak(score, performance, |body| body.places[joint]);
        let (tip, _) = peak(score, performance, |body| match joint {
            15 | 19 => body.tip(joint),
            _ => body.tip(joint + 1),
        });
        println!("  {name}: {wrist:.1} m/s, its tip {tip:.1} m/s, at frame {at}");
    }
}

/// Lists the named poses, each after the number of its nearest frame.
pub(crate) fn timeline(score: &Score) -> String {
    let pose = |key: &Key| format!("{} {}", (key.at * score.fps).round(), key.name);
    score.keys.iter().map(pose).collect::<Vec<_>>().join(" · ")
}

/// Returns the peak speed of a point in metres per second, sampled at 100 fps, and the frame of the peak.
fn peak(score: &Score, performance: &Performance, point: impl Fn(&Body) -> DVec3) -> (f64, f64) {
    let mut before = point(&performance.body(0.0));
    let mut peak = (0.0, 0.0);
    for step in 1..(100.0 * (score.frames - 1) as f64 / score.fps) as usize {
        let time = step as f64 / 100.0;
        let now = point(&performance.body(time));
        let speed = now.distance(before);
        if speed > peak.0 {
            peak = (speed, (time * score.fps).round());
        }
        before = now;
    }
    peak
}
