//! One large file, opened by one core and by all cores: `cargo bench -p genga-benches --bench cores -- FILE.bvh`.
//!
//! Each measurement is a process of its own, in turn pinned to one core and unpinned. A ratio is taken within a round.
//! Wall time is measured, since that is what more cores should save.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "it prints a table")]

use std::env;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::Instant;

use genga::motion::bvh;

const ROUNDS: usize = 9;

/// Times that a process opens the file. The best counts, because other work runs on the machine too.
const TIMES: usize = 3;

fn main() {
    let arguments: Vec<String> = env::args().skip(1).filter(|word| word != "--bench").collect();
    match &arguments[..] {
        [path] => table(Path::new(path)),
        [word, path] if word == "one" => println!("{}", best(Path::new(path))),
        _ => println!("cargo bench -p genga-benches --bench cores -- FILE.bvh"),
    }
}

/// Seconds from the path to the clip.
fn best(path: &Path) -> f64 {
    let open = || {
        let start = Instant::now();
        let read = bvh::open(path).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        assert!(!read.clip.is_empty());
        seconds
    };
    (0..TIMES).map(|_| open()).fold(f64::INFINITY, f64::min)
}

fn table(path: &Path) {
    let megabytes = path.metadata().unwrap().len() as f64 / 1e6;
    let cores = thread::available_parallelism().unwrap();
    let rounds: Vec<[f64; 2]> =
        (0..ROUNDS).map(|_| [child(path, &["taskset", "-c", "0"]), child(path, &[])]).collect();
    let [one, all] = [0, 1].map(|at| median(rounds.iter().map(|round| megabytes / round[at])));
    let ratios = || rounds.iter().map(|[one, all]| one / all);
    let (least, most) = ratios().fold((f64::INFINITY, 0.0), |(least, most): (f64, f64), ratio| {
        (least.min(ratio), most.max(ratio))
    });
    println!("| {megabytes:.0} MB, path to clip | wall MB/s |\n| --- | --- |");
    println!("| one core | {one:.0} |\n| {cores} cores | {all:.0} |");
    println!("| ratio (smallest to largest) | {:.2} ({least:.2} to {most:.2}) |", median(ratios()));
}

fn child(path: &Path, before: &[&str]) -> f64 {
    let this = env::current_exe().unwrap();
    let words: Vec<&str> = before
        .iter()
        .copied()
        .chain([this.to_str().unwrap(), "one", path.to_str().unwrap()])
        .collect();
    let output = Command::new(words[0]).args(&words[1..]).output().unwrap();
    String::from_utf8(output.stdout).unwrap().trim().parse().unwrap()
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
