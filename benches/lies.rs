//! Time and memory that a reader spends on lying files, and memory of runs on small files that ask for much: `cargo
//! bench -p genga-benches --bench lies`, or `-- memory` for the second table alone.
//!
//! Every file is read in a process of its own, whose peak memory is taken from /proc. Two sizes show whether time and
//! memory grow no faster than the size.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "it prints a table")]

use std::env;
use std::hint::black_box;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use genga::motion::bvh;

#[path = "common/cpu.rs"]
mod cpu;
#[path = "common/hungry.rs"]
mod hungry;
#[path = "../tests/all/lying_files.rs"]
mod lying_files;
#[path = "common/memory.rs"]
mod memory;

use lying_files::LIES;

/// Sizes of a file in bytes.
const SIZES: [usize; 2] = [8 << 20, 64 << 20];

/// Seconds after which a file counts as a hang.
const LONGEST: u64 = 20;

fn main() {
    let arguments: Vec<String> = env::args().collect();
    match &arguments[1..] {
        [word, lie, size] if word == "one" => one(lie.parse().unwrap(), size.parse().unwrap()),
        [word, path] if word == "hungry" => hungry::one(Path::new(path)),
        [word, ..] if word == "memory" => hungry::table(),
        _ => {
            table();
            println!();
            hungry::table();
        }
    }
}

/// Prints the result of a child process: bytes, outcome, nanoseconds, bytes of memory beyond the file's.
fn one(lie: usize, size: usize) {
    let bytes = (LIES[lie].2)(size);
    let before = memory::now();
    let begin = Instant::now();
    let ran = cpu::nanos(begin);
    let read = bvh::read(black_box(&bytes));
    let nanos = cpu::nanos(begin) - ran;
    let taken = memory::peak().saturating_sub(before);
    let outcome = match &read {
        Ok(read) => {
            let (clip, codes) = (&read.clip, read.warnings.len());
            format!(
                "read: {} joints, {} frames, {codes} warnings",
                clip.skeleton().len(),
                clip.len()
            )
        }
        Err(error) => error.to_string().chars().take(90).collect(),
    };
    println!("{}\t{nanos}\t{taken}\t{outcome}", bytes.len());
}

fn table() {
    println!(
        "| file | size | CPU time | ns a byte | at 8 times the size | memory beyond the file | outcome |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for (lie, (name, ..)) in LIES.iter().enumerate() {
        let both = || Some((run(lie, SIZES[0])?, run(lie, SIZES[1])?));
        let Some((small, large)) = both() else {
            println!("| {name} | | over {LONGEST} s: A HANG | | | | |");
            continue;
        };
        // Of a file of a few bytes, only the fixed cost of a process would be measured.
        let growth =
            if large.0 > small.0 { format!("{:.1} times", large.1 / small.1) } else { "-".into() };
        let memory =
            if large.0 > 1e6 { format!("{:.2} times", large.2 / large.0) } else { "-".into() };
        println!(
            "| {name} | {:.1} MB | {:.1} ms | {:.2} | {growth} | {memory} | {} |",
            large.0 / 1e6,
            large.1 / 1e6,
            large.1 / large.0,
            large.3.replace('|', "\\|"),
        );
    }
}

/// Bytes, nanoseconds, bytes of memory and outcome of one file. `None` if it takes too long.
fn run(lie: usize, size: usize) -> Option<(f64, f64, f64, String)> {
    let program = env::current_exe().unwrap();
    let arguments = ["one".to_owned(), lie.to_string(), size.to_string()];
    let mut child = Command::new(program).args(arguments).stdout(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(LONGEST) {
            child.kill().unwrap();
            child.wait().unwrap();
            return None;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success(), "{}: {output:?}", LIES[lie].0);
    let text = String::from_utf8(output.stdout).unwrap();
    let words: Vec<&str> = text.trim_end().splitn(4, '\t').collect();
    let number = |at: usize| words[at].parse().unwrap();
    Some((number(0), number(1), number(2), words[3].to_owned()))
}
