//! The clip on the command line: which, which part of it, and how it is read.

use std::path::PathBuf;

use clap::Args;

use crate::time::FrameRate;

/// The clip, and which part of it.
#[derive(Debug, Args)]
pub(in crate::cli) struct ClipArgs {
    /// The motion, a BVH file; - is stdin.
    #[arg(value_name = "CLIP.bvh")]
    pub(in crate::cli) clip: PathBuf,
    #[command(flatten)]
    pub(in crate::cli) part: Part,
}

/// Which part of a clip, and how it is read.
#[derive(Debug, Default, Args)]
pub(in crate::cli) struct Part {
    /// Keep a T-pose that was put in front of the motion.
    #[arg(long)]
    pub(in crate::cli) keep_lead_in: bool,
    /// Work on source frames A up to but not including B, numbered from 0 as in the file.
    #[arg(long, value_name = "A..B", value_parser = frames)]
    pub(in crate::cli) trim: Option<Frames>,
    #[command(flatten)]
    pub(in crate::cli) reading: Reading,
}

/// How a clip is read.
#[derive(Debug, Default, Args)]
pub(in crate::cli) struct Reading {
    /// The frame rate, whatever the file says.
    #[arg(long, value_name = "N", value_parser = rate)]
    pub(in crate::cli) fps: Option<FrameRate>,
    /// Of several trees of joints only the one whose root has this name.
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) root: Option<String>,
    /// Hold the value before a nan or inf, and leave out what is too much in a row; said in a note.
    #[arg(long, conflicts_with = "strict")]
    pub(in crate::cli) repair: bool,
    /// Refuse a file that has anything to warn of (see inspect --warnings).
    #[arg(long)]
    pub(in crate::cli) strict: bool,
}

/// A half-open range of source frames.
pub(in crate::cli) type Frames = std::ops::Range<usize>;

fn frames(text: &str) -> Result<Frames, String> {
    let number = |text: &str, open: usize| match text.trim() {
        "" => Some(open),
        text => text.parse().ok(),
    };
    let parsed = text
        .split_once("..")
        .and_then(|(begin, end)| Some(number(begin, 0)?..number(end, usize::MAX)?));
    parsed.ok_or_else(|| "expected frame numbers, as in 120..480, 120.. or ..480".into())
}

fn rate(text: &str) -> Result<FrameRate, String> {
    let fps = text.parse().ok().and_then(|fps| FrameRate::new(fps).ok());
    fps.ok_or_else(|| "expected frames a second from 0.001 to 1000000, as in 120 or 29.97".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rate_is_a_number_of_frames_a_second() {
        assert_eq!(rate("29.97").unwrap().fps(), 29.97);
        for wrong in ["0", "-24", "nan", "inf", "fast", ""] {
            assert!(rate(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_range_is_two_frames_or_open() {
        assert_eq!(frames("120..480").unwrap(), 120..480);
        assert_eq!(frames("120..").unwrap(), 120..usize::MAX);
        assert_eq!(frames("..480").unwrap(), 0..480);
        for wrong in ["120-480", "a..480", "120..b", "-1..5"] {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
    }
}
