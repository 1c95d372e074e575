//! Reads a BVH file into a [`Clip`].

use std::fs::File;
use std::io::{Read as _, Seek};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::columns::Columns;
use super::file::{self, Blocks};
use super::hierarchy::{self, Head};
use super::scanner::Scanner;
use super::table_tolerant::{self, Rows, Table};
use super::warnings::{CHANNEL_COUNT, FRAMES_MISMATCH, Notices, POSES, VALUE_HELD};
use super::{Read, frame_time, names, repair, table_fast, text, threads, trees};
use crate::error::{Error, Place};
use crate::motion::{Clip, Skeleton, StreamLimit};
use crate::time::{Frame, FrameRate};

/// Reads (読む) a BVH file as [`Options::read`] does by default.
///
/// # Errors
/// Errors of [`Options::read`].
///
/// ```
/// let text = std::fs::read("data/kick.bvh").expect("it is part of the repository");
/// let read = genga::motion::bvh::read(&text)?;
/// assert_eq!((read.clip.len(), read.clip.rate().fps()), (92, 24.0));
/// assert!(read.warnings.is_empty(), "a file as it should be");
/// # Ok::<(), genga::Error>(())
/// ```
pub fn read(bytes: &[u8]) -> Result<Read, Error> {
    Options::default().read(bytes)
}

/// Opens (開く) a BVH file and reads it as [`Options::open`] does by default.
///
/// # Errors
/// Errors of [`Options::open`].
pub fn open(path: &Path) -> Result<Read, Error> {
    Options::default().open(path)
}

/// Options of the BVH reader.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Options {
    /// Makes the first warning about the file an error. Default: false. It rejects every file that its
    /// program wrote slightly wrong.
    pub strict: bool,
    /// Replaces a non-finite value by the value before it, and drops surplus values in a row, each reported
    /// by one warning. Default: false, which makes them errors. It hides the evidence that the file is
    /// broken.
    pub repair: bool,
    /// Frame rate that overrides the file's frame time. Default: none, the file's.
    pub fps: Option<FrameRate>,
    /// Root of the one tree to read, if a file has several; of two roots `Hips` the second is `Hips.2`.
    /// Default: none, all trees. It discards the others.
    pub root: Option<String>,
    /// Limit for input that is not a regular file.
    pub stream: StreamLimit,
}

impl Options {
    /// Opens a file and reads it. Large files are read by several threads, up to the machine's parallelism;
    /// a pipe or a device is read up to the limit of `stream`.
    ///
    /// # Errors
    /// [`Error::Io`] if the file cannot be read, and the errors of [`Options::read`].
    pub fn open(&self, path: &Path) -> Result<Read, Error> {
        let failed = |source| Error::Io { path: path.to_owned(), source };
        let mut file = File::open(path).map_err(failed)?;
        if let Some(read) = self.read_blocks(&file) {
            return read;
        }
        if file::length(&file).is_none() {
            return self.read(&self.stream.read(file).map_err(failed)?);
        }
        // On Windows, reading at an offset moves the file cursor.
        file.rewind().map_err(failed)?;
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).map_err(failed)?;
        self.read(&bytes)
    }

    /// Reads a file in blocks without ever holding its whole text, which is faster than going through main
    /// memory. `None` means only that this is not possible; the file is then read whole.
    fn read_blocks(&self, file: &File) -> Option<Result<Read, Error>> {
        let size = file::length(file)?;
        let mut head = Blocks::new(file, 0..size);
        let first = head.next()?;
        let mut notices = Notices::default();
        let text = text::decode(first, &mut notices).ok()?;
        if text.len() != first.len() {
            return None;
        }
        let mut scanner = Scanner::new(&text, notices);
        let begun = self.begin(&mut scanner).ok()?;
        scanner.has_more();
        let (width, said) = (begun.columns.width(), begun.said);
        let table = scanner.at() as u64..size;
        let parts = threads::parts(size);
        let by_parts = (parts > 1).then(|| table_fast::read_parts(file, table, width, said, parts));
        let values = by_parts.flatten().or_else(|| {
            let rest = Blocks::new(file, first.len() as u64..size);
            table_fast::read_on(scanner.rest(), rest, width, said)
        });
        Some(self.finish(scanner, begun, Rows { values: values?, cut: 0 }))
    }

    /// Reads a file from memory. Accepts any order and number of channels, positions on any joint, several
    /// roots, and the spellings that real programs write.
    ///
    /// Values are the decimals of the file, correctly rounded, in degrees and the file's unit. A frame time
    /// within 0.05 % of a usual rate becomes that rate. If the number of frames differs from the declared
    /// one, all complete frames are used, with the warning `W_FRAMES_MISMATCH`. Columns that no joint of
    /// the clip can use are skipped.
    ///
    /// # Errors
    /// [`Error::Motion`] with line and column if the text is not valid BVH, if a value is not a finite number,
    /// or if there is no motion. [`Error::Setting`] if no tree is called `root`.
    pub fn read(&self, bytes: &[u8]) -> Result<Read, Error> {
        let mut notices = Notices::default();
        let text = text::decode(bytes, &mut notices)?;
        let mut scanner = Scanner::new(&text, notices);
        let begun = self.begin(&mut scanner)?;
        let Begun { skeleton, columns, said, .. } = &begun;
        let rows = match table_fast::read(scanner.rest(), columns.width(), *said) {
            Some(values) => Rows { values, cut: 0 },
            None => {
                Table { skeleton, columns, said: *said, repair: self.repair }.read(&mut scanner)?
            }
        };
        self.finish(scanner, begun, rows)
    }

    /// Reads everything before the table.
    fn begin(&self, scanner: &mut Scanner) -> Result<Begun, Error> {
        let mut head = hierarchy::read(scanner)?;
        trees::choose(self.root.as_deref(), &mut head, &mut scanner.notices)?;
        let Head { mut skeleton, columns, names_at } = head;
        names::make_unique(&mut skeleton.joints, &names_at, &mut scanner.notices);
        if skeleton.channels() == 0 {
            let message = "no joint has a channel: there is no motion";
            return Err(scanner.error(scanner.at(), message));
        }
        let (said_at, said) = frames(scanner)?;
        let (rate, written_frame_time) = self.rate(scanner)?;
        check_channel_count(scanner, columns.width())?;
        Ok(Begun { skeleton, columns, said_at, said, rate, written_frame_time })
    }

    /// Builds the clip from the rows, and collects the warnings.
    fn finish(&self, mut scanner: Scanner, begun: Begun, rows: Rows) -> Result<Read, Error> {
        let Begun { skeleton, columns, said_at, said, rate, written_frame_time } = begun;
        let Rows { mut values, cut } = rows;
        columns.compact(&mut values);
        if scanner.notices.first(VALUE_HELD).is_some() {
            repair::hold(&mut values, &skeleton);
        }
        let frames = values.len() / skeleton.channels();
        if frames != said || cut > 0 {
            scanner.notices.add(FRAMES_MISMATCH, said_at, || mismatch(said, frames, cut));
        }
        let text = scanner.text();
        let warnings = scanner.notices.into_warnings(text);
        match warnings.first() {
            Some(warning) if self.strict => {
                let (line, column) = warning.place.unwrap_or((1, 1));
                let message = format!("{} [{}]", warning.message, warning.code);
                Err(Error::Motion { place: Place::Line(line, column), message })
            }
            _ => {
                let clip = Clip::of_finite(skeleton, rate, Frame(0), frames, values);
                Ok(Read { clip, warnings, written_frame_time })
            }
        }
    }

    /// The frame rate of the clip, and the frame time written in the file.
    fn rate(&self, scanner: &mut Scanner) -> Result<(FrameRate, f64), Error> {
        scanner.label(&["Frame", "Time"])?;
        let Some(fps) = self.fps else {
            let at = scanner.peek().at;
            let seconds = scanner.number()?;
            let rate = frame_time::rate(seconds).map_err(|message| scanner.error(at, message))?;
            if let Some(message) = frame_time::poses(seconds) {
                scanner.notices.add(POSES, at, || message);
            }
            return Ok((rate, seconds));
        };
        Ok((fps, scanner.value()?.unwrap_or(f64::NAN)))
    }
}

/// The part of a file before its table.
struct Begun {
    skeleton: Skeleton,
    columns: Columns,
    /// Number of frames that the file declares, and the byte where it does.
    said: usize,
    said_at: usize,
    rate: FrameRate,
    written_frame_time: f64,
}

/// The byte offset of the declared frame count, and the count.
fn frames(scanner: &mut Scanner) -> Result<(usize, usize), Error> {
    scanner.label(&["Frames"])?;
    let at = scanner.peek().at;
    match scanner.count()? {
        0 => Err(scanner.error(at, "the file says it has 0 frames: there is no motion")),
        frames => Ok((at, frames)),
    }
}

/// Checks a CHANNELS count that differs from the number of names. The names win if the first row of the
/// table has the width that they need.
fn check_channel_count(scanner: &Scanner, width: usize) -> Result<(), Error> {
    let Some(at) = scanner.notices.first(CHANNEL_COUNT) else { return Ok(()) };
    let found = table_tolerant::first_line(scanner);
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
