//! `genga inspect`: describes a clip.

use std::fmt::Write;
use std::path::PathBuf;

use clap::Args;

use crate::clip::{ClipArgs, Source};
use crate::console::{Words, counted};
use crate::failure::Failure;
use crate::{files, paths};
use genga::error::Warning;
use genga::motion::{Axis, Channel, Description, Joint, Stature, Unit};
use genga::time::{FrameRate, KOMA_RATE};
use genga_plot::SkeletonPlot;
use genga_read::{Found, Take};

/// Levels that are indented; deeper ones would run off the screen.
const DEEPEST: usize = 32;

#[derive(Debug, Args)]
pub(super) struct InspectArgs {
    #[command(flatten)]
    clip: ClipArgs,
    /// Print only the warnings, on stdout, one per line: code, line:column (- for the whole clip), sentence.
    #[arg(long)]
    warnings: bool,
    #[arg(long, value_name = "FILE.svg", help = paths::picture_help("Also draw the skeleton, its rest pose and hierarchy"), conflicts_with = "warnings")]
    plot: Option<PathBuf>,
}

pub(super) fn run(args: &InspectArgs, words: &Words) -> Result<(), Failure> {
    if let Some(target) = &args.plot {
        paths::spare(&[("motion", Some(&args.clip.path))], target)?;
    }
    paths::check_picture("plot", args.plot.as_ref())?;
    let source = args.clip.read()?;
    if args.warnings {
        return files::page_to_stdout(&listed(&source.notes));
    }
    source.notes.iter().for_each(|warning| words.warn(warning));
    let name = paths::stem(&args.clip.path);
    if let Some(path) = &args.plot {
        files::write_picture(path, &SkeletonPlot::default().draw(&name, &source.clip)?, words)?;
    }
    files::page_to_stdout(&page(&name, &source))
}

/// Lists warnings for a script: code, place, sentence.
fn listed(warnings: &[Warning]) -> String {
    let mut list = String::new();
    for Warning { code, message, place } in warnings {
        let place = place.map_or("-".into(), |(line, column)| format!("{line}:{column}"));
        let _ = writeln!(list, "{code} {place} {message}");
    }
    list
}

fn page(name: &str, source: &Source) -> String {
    let clip = &source.clip;
    let skeleton = clip.skeleton();
    let koma = clip.rate().koma_from_frames(clip.len(), KOMA_RATE);
    let mut page = String::new();
    let mut line = |label: &str, value: String| {
        let _ = writeln!(page, "{label:<9} {value}");
    };
    line("clip", name.into());
    let is_said = |found: &&Found| found.what != "up";
    source.found.iter().filter(is_said).for_each(|found| line(found.what, found.is.clone()));
    source.takes.iter().for_each(|take| line("take", described_take(take)));
    line("frames", format!("{}, numbers {} to {}", clip.len(), clip.first(), clip.last()));
    line("rate", rate(clip.rate(), source.written_frame_time));
    line("length", format!("{:.2} s, {koma} koma at 24 a second", clip.seconds()));
    line("joints", format!("{}, {}", skeleton.len(), counted(skeleton.channels(), "channel")));
    line("size", size(source));
    if !clip.is_empty() {
        Description::new(clip).lines.into_iter().for_each(|(part, words)| line(part, words));
    }
    page.push('\n');
    let mut depths = Vec::with_capacity(skeleton.len());
    for (_, joint) in skeleton.iter() {
        let depth = joint.parent.map_or(0, |parent| depths[parent.0] + 1);
        depths.push(depth);
        let _ = writeln!(page, "{}{}", "  ".repeat(depth.min(DEEPEST)), described(joint));
    }
    page
}

/// Describes the rate, and the one written in the file if it differs.
fn rate(rate: FrameRate, written: Option<f64>) -> String {
    let text = format!("{rate} frames a second");
    let Some(written) = written else { return text };
    let by_file = 1.0 / written;
    // A difference is reported only if it shows in five decimals.
    if (by_file - rate.fps()).abs() < 5e-6 {
        return text;
    }
    if written > 0.0 {
        return format!("{text} (the file writes {written} s a frame: {by_file:.5} a second)");
    }
    format!("{text} (the file writes {written} s a frame)")
}

fn described_take(take: &Take) -> String {
    let still = if take.moves { "" } else { ", nothing moves" };
    format!("{}, {:.2} s{still}", take.name, take.seconds)
}

fn described(joint: &Joint) -> String {
    let letter = |axis: &Axis| match axis {
        Axis::X => 'x',
        Axis::Y => 'y',
        Axis::Z => 'z',
    };
    let mut words = joint.name.clone();
    for (label, is_position) in [("position", true), ("rotation", false)] {
        let axes: String = joint
            .channels
            .iter()
            .filter_map(|channel| match channel {
                Channel::Position(axis) if is_position => Some(letter(axis)),
                Channel::Rotation(axis) if !is_position => Some(letter(axis)),
                _ => None,
            })
            .collect();
        if !axes.is_empty() {
            let _ = write!(words, "  {label} {axes}");
        }
    }
    words
}

/// Describes the body height in the file's unit and, if the file states no unit, the unit that makes it a person's
/// height.
fn size(source: &Source) -> String {
    let clip = &source.clip;
    if clip.is_empty() {
        return "unknown, there is no frame".into();
    }
    let size = Stature::new(clip).size;
    if source.found.iter().any(|found| found.what == "unit") {
        let is_odd = Unit::of_size(size).is_none();
        let odd = if is_odd { ": no person's size, so the unit is likely another" } else { "" };
        return format!("{size:.2} high{odd}");
    }
    let unit = match Unit::of_size(size) {
        Some(Unit::Metre) => "metres, by the size",
        Some(Unit::Decimetre) => "decimetres, by the size",
        Some(Unit::Cmu) => "the CMU unit of 5.64 cm, by the size",
        Some(Unit::Inch) => "inches, by the size",
        Some(Unit::Centimetre) => "centimetres, by the size",
        Some(Unit::Millimetre) => "millimetres, by the size",
        None => "an unknown unit",
    };
    format!("{size:.1} high: {unit}")
}
