//! The reader compared with its peers and its limits, in one run: `benches/compare.sh`.
//!
//! Every round runs every engine once on the same file, in rotating order. A ratio is taken within a round, so that a
//! slow minute of the machine hits both sides. Times are CPU time of this thread.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "it prints a table")]

use std::env;
use std::fs::{self, File};
use std::hint::black_box;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::time::Instant;

use genga::motion::{Clip, bvh};

#[path = "common/cpu.rs"]
mod cpu;

const FILES: [&str; 6] = [
    "cmu-01_06-playground-long",
    "cmu-02_05-punch-strike",
    "optitrack-arena-louise",
    "rokoko-jesse-dance",
    "threejs-pirouette",
    "cmu-11_01-soccer-kick",
];

const ROUNDS: usize = 15;

/// A file in the forms that the engines need.
struct Input {
    path: PathBuf,
    bytes: Vec<u8>,
    /// Byte offset at which the numbers of the motion begin.
    table: usize,
    /// Number of values.
    values: usize,
}

/// The result of an engine. It is dropped outside the measured time, because a program would keep it.
enum Made {
    Clip(Clip),
    Values(Vec<f64>),
    Bvh(bvh_anim::Bvh),
    Bytes(Vec<u8>),
    Count(usize),
}

struct Engine {
    name: &'static str,
    run: fn(&Input) -> Made,
}

const ENGINES: [Engine; 9] = [
    Engine { name: "genga, file to clip", run: |input| Made::Clip(open(&input.path)) },
    Engine {
        name: "genga, from memory",
        run: |input| Made::Clip(bvh::read(&input.bytes).unwrap().clip),
    },
    Engine { name: "fast-float2, numbers alone", run: |input| Made::Values(fast_float(input)) },
    Engine { name: "str::parse, numbers alone", run: |input| Made::Values(std_parse(input)) },
    Engine { name: "bvh_anim, from a file", run: bvh_anim_file },
    Engine {
        name: "bvh_anim, from memory",
        run: |input| Made::Bvh(bvh_anim::from_bytes(&input.bytes).unwrap()),
    },
    Engine {
        name: "read the file, nothing else",
        run: |input| Made::Bytes(fs::read(&input.path).unwrap()),
    },
    Engine { name: "memcpy", run: |input| Made::Bytes(black_box(&input.bytes).clone()) },
    Engine { name: "count line ends", run: count_lines },
];

const GENGA: usize = 0;
const GENGA_MEMORY: usize = 1;
const FAST_FLOAT: usize = 2;
const BVH_ANIM: usize = 4;

/// Reads a clip from a file, as a program does.
fn open(path: &Path) -> Clip {
    bvh::open(path).unwrap().clip
}

fn words(input: &Input) -> impl Iterator<Item = &[u8]> {
    let blank = |byte: &u8| byte.is_ascii_whitespace();
    input.bytes[input.table..].split(blank).filter(|word| !word.is_empty())
}

fn fast_float(input: &Input) -> Vec<f64> {
    let mut values = Vec::with_capacity(input.values);
    let mut rest = &input.bytes[input.table..];
    while !rest.is_empty() {
        if rest[0].is_ascii_whitespace() {
            rest = &rest[1..];
            continue;
        }
        let (value, length) = fast_float2::parse_partial::<f64, _>(rest).unwrap();
        values.push(value);
        rest = &rest[length..];
    }
    values
}

fn std_parse(input: &Input) -> Vec<f64> {
    let mut values = Vec::with_capacity(input.values);
    values.extend(
        words(input).map(|word| std::str::from_utf8(word).unwrap().parse::<f64>().unwrap()),
    );
    values
}

fn bvh_anim_file(input: &Input) -> Made {
    Made::Bvh(bvh_anim::from_reader(BufReader::new(File::open(&input.path).unwrap())).unwrap())
}

fn count_lines(input: &Input) -> Made {
    Made::Count(input.bytes.iter().map(|byte| usize::from(*byte == b'\n')).sum())
}

/// The sum of all values, each rounded to `f32` for a peer that has no more.
fn check(made: &Made, single: bool) -> Option<f64> {
    let round = |value: f64| if single { f64::from(value as f32) } else { value };
    match made {
        Made::Clip(clip) => Some(clip.rows().flatten().map(|value| round(*value)).sum()),
        Made::Values(values) => Some(values.iter().map(|value| round(*value)).sum()),
        Made::Bvh(bvh) => Some(
            bvh.frames().flat_map(|frame| frame.as_slice()).map(|value| f64::from(*value)).sum(),
        ),
        Made::Bytes(bytes) => black_box(bytes.last()).and(None),
        Made::Count(count) => black_box(Some(*count)).and(None),
    }
}

/// Checks that every engine has read the same numbers.
fn agree(input: &Input, name: &str) {
    let clip = ENGINES[GENGA].run_on(input);
    let (exact, single) = (check(&clip, false).unwrap(), check(&clip, true).unwrap());
    for engine in &ENGINES {
        let made = engine.run_on(input);
        // The parser of bvh_anim is not correctly rounded.
        let (expected, near) = match made {
            Made::Bvh(_) => (single, 1e-6 * input.values as f64),
            _ => (exact, 0.0),
        };
        let Some(found) = check(&made, false) else { continue };
        assert!(
            (found - expected).abs() <= near,
            "{name}: {} reads {found}, not {expected}",
            engine.name
        );
    }
}

impl Engine {
    fn run_on(&self, input: &Input) -> Made {
        (self.run)(black_box(input))
    }

    /// Nanoseconds of one run.
    fn time(&self, input: &Input) -> f64 {
        let begin = Instant::now();
        let before = cpu::nanos(begin);
        let made = black_box(self.run_on(input));
        let nanos = cpu::nanos(begin) - before;
        drop(made);
        nanos
    }
}

fn input(path: PathBuf) -> Input {
    let bytes = fs::read(&path).unwrap();
    let label = b"Frame Time:";
    let label = bytes.windows(label.len()).position(|words| words == label).unwrap();
    let table = label + bytes[label..].iter().position(|byte| *byte == b'\n').unwrap() + 1;
    let clip = bvh::read(&bytes).unwrap().clip;
    Input { path, bytes, table, values: clip.len() * clip.skeleton().channels() }
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Times by engine, then by round.
fn measure(input: &Input, rounds: usize) -> Vec<Vec<f64>> {
    let mut times = vec![Vec::with_capacity(rounds); ENGINES.len()];
    for round in 0..=rounds {
        for turn in 0..ENGINES.len() {
            let engine = (round + turn) % ENGINES.len();
            let nanos = ENGINES[engine].time(input);
            // The first round warms up.
            if round > 0 {
                times[engine].push(nanos);
            }
        }
    }
    times
}

/// Speedup of `a` over `b`: median, smallest and largest of the rounds.
fn faster(times: &[Vec<f64>], a: usize, b: usize) -> [f64; 3] {
    let mut ratios: Vec<f64> = times[a].iter().zip(&times[b]).map(|(a, b)| b / a).collect();
    let median = median(&mut ratios);
    [median, ratios[0], ratios[ratios.len() - 1]]
}

const RATIOS: [(&str, usize, usize); 4] = [
    ("genga from a file / fast-float2", GENGA, FAST_FLOAT),
    ("genga from memory / fast-float2", GENGA_MEMORY, FAST_FLOAT),
    ("genga from a file / bvh_anim from a file", GENGA, BVH_ANIM),
    ("genga from memory / bvh_anim from memory", GENGA_MEMORY, BVH_ANIM + 1),
];

fn main() {
    let rounds = env::var("ROUNDS").ok().and_then(|rounds| rounds.parse().ok()).unwrap_or(ROUNDS);
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/bvh");
    let folder = env::var_os("GENGA_CLIPS").map_or(beside, PathBuf::from);
    let paths = FILES.map(|name| folder.join(name).with_extension("bvh"));
    let mut inputs: Vec<Input> =
        paths.into_iter().filter(|path| path.exists()).map(input).collect();
    if inputs.is_empty() {
        println!("No real clips at {}: the samples of data/ instead.\n", folder.display());
        let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../data");
        inputs
            .extend(["pitch", "kick"].map(|name| input(samples.join(name).with_extension("bvh"))));
    }
    let names: Vec<String> = inputs
        .iter()
        .map(|input| input.path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    let all: Vec<Vec<Vec<f64>>> = inputs
        .iter()
        .zip(&names)
        .map(|(input, name)| {
            agree(input, name);
            measure(input, rounds)
        })
        .collect();
    println!("CPU MB/s of the file's size, median of {rounds} rounds (best).\n");
    heading("engine", &names, "geometric mean");
    for (at, engine) in ENGINES.iter().enumerate() {
        let rate = |(input, times): (&Input, &Vec<Vec<f64>>)| {
            let mut times = times[at].clone();
            let size = 1e3 * input.bytes.len() as f64;
            (size / median(&mut times), size / times[0])
        };
        let rates: Vec<(f64, f64)> = inputs.iter().zip(&all).map(rate).collect();
        let cells: Vec<String> =
            rates.iter().map(|(rate, best)| format!("{rate:.0} ({best:.0})")).collect();
        let means = (mean(rates.iter().map(|rate| rate.0)), mean(rates.iter().map(|rate| rate.1)));
        println!("| {} | {} | {:.0} ({:.0}) |", engine.name, cells.join(" | "), means.0, means.1);
    }
    println!("\nHow many times faster, median of the rounds' ratios (smallest to largest).\n");
    heading("ratio", &names, "geometric mean");
    for (name, a, b) in RATIOS {
        let ratios: Vec<[f64; 3]> = all.iter().map(|times| faster(times, a, b)).collect();
        let cell =
            |[median, least, most]: &[f64; 3]| format!("{median:.2} ({least:.2} to {most:.2})");
        let cells: Vec<String> = ratios.iter().map(cell).collect();
        println!(
            "| {name} | {} | {:.2} |",
            cells.join(" | "),
            mean(ratios.iter().map(|ratio| ratio[0]))
        );
    }
}

fn heading(first: &str, names: &[String], last: &str) {
    println!("| {first} | {} | {last} |", names.join(" | "));
    println!("| --- |{} --- |", " --- |".repeat(names.len()));
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    libm::exp(values.map(libm::log).sum::<f64>() / count)
}
