//! Reads a BVH file.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::careful::{self, Rows, Table};
use super::file;
use super::hierarchy::{self, Head};
use super::scanner::Scanner;
use super::warnings::{CHANNEL_COUNT, FRAMES_MISMATCH, Notices, VALUE_HELD};
use super::{Read, names, repair, table, text, trees};
use crate::error::Error;
use crate::motion::Clip;
use crate::time::{Frame, FrameRate};

/// Reads (読む) a BVH file as [`Options::read`] does by default.
///
/// # Errors
/// As [`Options::read`].
pub fn read(bytes: &[u8]) -> Result<Read, Error> {
    Options::default().read(bytes)
}

/// Opens (開く) a BVH file and reads it as [`Options::open`] does by default.
///
/// # Errors
/// As [`Options::open`].
pub fn open(path: &Path) -> Result<Read, Error> {
    Options::default().open(path)
}

/// How a BVH file is read.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Makes the first warning in the file an error. Default: false. It destroys every file that its
    /// program wrote a little wrong.
    pub strict: bool,
    /// Holds the value before one that is no finite number, and leaves out what is too much in a row:
    /// each told in one warning. Default: false, an error. It destroys the evidence that the file is
    /// broken.
    pub repair: bool,
    /// The rate, whatever the file's frame time says. Default: none, the file's.
    pub fps: Option<FrameRate>,
    /// The root of the one tree to read, where a file has several; of two roots `Hips` the second is
    /// `Hips.2`. Default: none, all trees. It destroys the others.
    pub root: Option<String>,
}

impl Options {
    /// Opens a file and reads it: large ones with as many threads as the machine has cores for them.
    ///
    /// # Errors
    /// [`Error::Io`] when the file cannot be read, and those of [`Options::read`].
    pub fn open(&self, path: &Path) -> Result<Read, Error> {
        let bytes =
            file::bytes(path).map_err(|source| Error::Io { path: path.to_owned(), source })?;
        self.read(&bytes)
    }

    /// Reads a file from memory: any channel order and number of channels, positions on any joint, several roots,
    /// and the spellings that programs in use write.
    ///
    /// Values are exactly the decimals of the file, correctly rounded, in degrees and the file's unit. A
    /// frame time within 0.05 % of a usual rate is that rate. When the file has more or fewer frames
    /// than it says, all complete ones are used, with the warning `W_FRAMES_MISMATCH`. A column that no
    /// joint of the clip can use is read and left out.
    ///
    /// # Errors
    /// [`Error::Bvh`] with line and column where the file stops being one, where a value is not a finite
    /// number, and when there is no motion. [`Error::Setting`] when no tree is called `root`.
    pub fn read(&self, bytes: &[u8]) -> Result<Read, Error> {
        let mut notices = Notices::default();
        let text = text::decode(bytes, &mut notices)?;
        let mut scanner = Scanner::new(&text, notices);
        let mut head = hierarchy::read(&mut scanner)?;
        trees::choose(self.root.as_deref(), &mut head, &mut scanner.notices)?;
        names::make_unique(&mut head.skeleton.joints, &head.names_at, &mut scanner.notices);
        let (clip, written_frame_time) = self.motion(&mut scanner, head)?;
        let warnings = scanner.notices.into_warnings(&text);
        match warnings.first() {
            Some(warning) if self.strict => {
                let (line, column) = warning.place.unwrap_or((1, 1));
                let message = format!("{} [{}]", warning.message, warning.code);
                Err(Error::Bvh { line, column, message })
            }
            _ => Ok(Read { clip, warnings, written_frame_time }),
        }
    }

    /// The MOTION part, and the frame time that it writes.
    fn motion(&self, scanner: &mut Scanner, head: Head) -> Result<(Clip, f64), Error> {
        let Head { skeleton, columns, .. } = head;
        let channels = skeleton.channels();
        if channels == 0 {
            let message = "no joint has a channel: there is no motion";
            return Err(scanner.error(scanner.at(), message));
        }
        let (said_at, said) = frames(scanner)?;
        let (rate, written) = self.rate(scanner)?;
        check_channel_count(scanner, columns.width())?;
        let Rows { mut values, cut } = match table::read(scanner.rest(), columns.width(), said) {
            Some(values) => Rows { values, cut: 0 },
            None => Table { skeleton: &skeleton, columns: &columns, said, repair: self.repair }
                .read(scanner)?,
        };
        columns.compact(&mut values);
        if scanner.notices.first(VALUE_HELD).is_some() {
            repair::hold(&mut values, &skeleton);
        }
        let frames = values.len() / channels;
        if frames != said || cut > 0 {
            scanner.notices.add(FRAMES_MISMATCH, said_at, || mismatch(said, frames, cut));
        }
        Ok((Clip::of_finite(skeleton, rate, Frame(0), frames, values), written))
    }

    /// The rate of the clip, and the frame time that the file writes.
    fn rate(&self, scanner: &mut Scanner) -> Result<(FrameRate, f64), Error> {
        scanner.label(&["Frame", "Time"])?;
        let Some(fps) = self.fps else {
            let at = scanner.peek().at;
            let seconds = scanner.number()?;
            return Ok((rate_from_frame_time(scanner, at, seconds)?, seconds));
        };
        Ok((fps, scanner.value()?.unwrap_or(f64::NAN)))
    }
}

/// How many frames the file says it has, and where.
fn frames(scanner: &mut Scanner) -> Result<(usize, usize), Error> {
    scanner.label(&["Frames"])?;
    let at = scanner.peek().at;
    match scanner.count()? {
        0 => Err(scanner.error(at, "the file says it has 0 frames: there is no motion")),
        frames => Ok((at, frames)),
    }
}

fn rate_from_frame_time(scanner: &Scanner, at: usize, seconds: f64) -> Result<FrameRate, Error> {
    if seconds >= 1.0 {
        let message = if (10.0..1000.0).contains(&seconds) {
            format!("{seconds} seconds a frame looks like a rate; --fps {seconds} reads it as one")
        } else {
            format!("expected a frame time below 1 second, found {seconds}; --fps gives the rate")
        };
        return Err(scanner.error(at, message));
    }
    FrameRate::from_frame_time(seconds).map_err(|_| {
        let message =
            format!("expected a frame time of at least a millionth of a second, found {seconds}; --fps gives the rate");
        scanner.error(at, message)
    })
}

/// Where CHANNELS says another number than there are names, the names count if the first row of the
/// table is as wide as they need.
fn check_channel_count(scanner: &Scanner, width: usize) -> Result<(), Error> {
    let Some(at) = scanner.notices.first(CHANNEL_COUNT) else { return Ok(()) };
    let found = careful::first_line(scanner);
    if found == width {
        return Ok(());
    }
    let message = format!(
        "CHANNELS says another number than names follow; the names need {width} values in a row, and the first row has {found}"
    );
    Err(scanner.error(at, message))
}

fn mismatch(said: usize, frames: usize, cut: usize) -> String {
    let cut = match cut {
        0 => String::new(),
        1 => " and 1 value of a cut one, left out".to_owned(),
        cut => format!(" and {cut} values of a cut one, left out"),
    };
    let s = if frames == 1 { "" } else { "s" };
    format!("the file says {said} frames and has {frames} complete frame{s}{cut}")
}
