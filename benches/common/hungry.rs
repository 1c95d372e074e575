//! Small files that ask for much memory, and an endless pipe. Each is opened and run in a process of its own.

use std::env;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use genga::Error;
use genga::edits::Edits;
use genga::motion::bvh;
use genga::pipeline::Engine;
use genga::recipe::Recipe;

use crate::memory;

const MIB: f64 = 1_048_576.0;

/// Bytes that a run may take in addition to 18 times the size of its values. A pipe may bring as many:
/// `docs/lab/reliability.md`.
const BOUND: f64 = 1024.0 * MIB;

/// Allowance for the file's own lines and the process's own pages.
const BESIDE: f64 = 4.0 * MIB;

/// A moving root: name, number of joints without channels, number of rows, seconds per row.
type Body = (&'static str, usize, usize, &'static str);

/// Pairs of a refused file and one near the largest of its kind that is accepted.
const BODIES: [Body; 6] = [
    ("2,000 joints without channels, 20,000 rows", 2000, 20_000, "0.01"),
    ("2,000 joints without channels, 5,000 rows", 2000, 5000, "0.01"),
    ("200,000 rows at 0.999 s", 0, 200_000, "0.999"),
    ("35,000 rows at 0.999 s", 0, 35_000, "0.999"),
    ("1,000,000 joints, a flat list", 1_000_000, 2, "0.01"),
    ("400,000 joints, a flat list", 400_000, 2, "0.01"),
];

/// Prints the result of a child process: bytes of memory, of values, and the outcome.
pub(crate) fn one(path: &Path) {
    let before = memory::now();
    let mut values = 0;
    let mut run = || -> Result<String, Error> {
        let clip = bvh::open(path)?.clip;
        values = 8 * clip.len() * clip.skeleton().channels();
        let mut engine = Engine::new(clip)?;
        let breakdown = engine.run_once(&Recipe::default(), &Edits::default())?;
        Ok(format!("run: {} koma", breakdown.sheet.length()))
    };
    let outcome = run().unwrap_or_else(|error| error.to_string());
    println!("{}\t{values}\t{outcome}", memory::peak() - before);
}

/// Prints a row per file. Panics if one takes more than its bound.
pub(crate) fn table() {
    println!("| file | size | memory | bound | outcome |\n| --- | --- | --- | --- | --- |");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("body.bvh");
    let mut kept = true;
    for body in &BODIES {
        write(&path, body).unwrap();
        let size = path.metadata().unwrap().len() as f64 / 1e6;
        kept &= row(body.0, &format!("{size:.1} MB"), &process(&path, Stdio::null()));
    }
    let (end, mut pipe) = std::io::pipe().unwrap();
    let feeder = std::thread::spawn(move || {
        let rows = "0.5 1 2\n".repeat(8192);
        // Writes until the reader closes the pipe.
        while pipe.write_all(rows.as_bytes()).is_ok() {}
    });
    kept &= row("rows from a pipe without end", "–", &process(Path::new("/dev/stdin"), end.into()));
    feeder.join().unwrap();
    assert!(kept, "a bound does not hold");
}

fn write(path: &Path, (_, joints, rows, seconds): &Body) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    write!(file, "HIERARCHY ROOT a {{ OFFSET 0 0 0 CHANNELS 1 Xposition ")?;
    (0..*joints).try_for_each(|joint| writeln!(file, "JOINT j{joint} {{OFFSET 0 1 0}}"))?;
    write!(file, "}}\nMOTION\nFrames: {rows}\nFrame Time: {seconds}\n")?;
    (0..*rows).try_for_each(|row| writeln!(file, "{}", row * row % 7))?;
    file.flush()
}

fn process(path: &Path, input: Stdio) -> String {
    let mut command = Command::new(env::current_exe().unwrap());
    let output = command.arg("hungry").arg(path).stdin(input).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

/// Prints a row. Returns whether the bound is kept.
fn row(name: &str, size: &str, said: &str) -> bool {
    let words: Vec<&str> = said.trim_end().splitn(3, '\t').collect();
    let number = |at: usize| words[at].parse::<f64>().unwrap();
    let bound = BOUND + 18.0 * number(1) + BESIDE;
    let (taken, allowed) = (number(0) / MIB, bound / MIB);
    println!("| {name} | {size} | {taken:.0} MiB | {allowed:.0} MiB | {} |", words[2]);
    number(0) <= bound
}
