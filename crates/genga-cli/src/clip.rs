//! The motion of a command: which clip, which part of it, and how it is read.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;

use super::console::Words;
use super::failure::Failure;
use super::headings::READING;
use super::several::Several;
use super::{files, paths};
use genga::error::{Error, Warning};
use genga::motion::clean::{Cleaning, glitches};
use genga::motion::{Axis, BoneMap, Clip, StreamLimit};
use genga::pipeline::Budget;
use genga::time::FrameRate;
use genga_files::ClipMark;
use genga_files::sheet_json::SheetFile;
use genga_read::{Found, Take};

/// Arguments for a clip and the part of it to read.
#[derive(Debug, Clone, Args)]
pub(super) struct ClipArgs {
    /// Motion file: BVH, FBX, glTF (GLB, VRM, VRMA), VMD or ASF/AMC; - is stdin.
    #[arg(id = "clip", value_name = "CLIP")]
    pub(super) path: PathBuf,
    #[command(flatten)]
    pub(super) part: Part,
}

/// A clip of several, with the name that tells it from the others.
pub(super) struct NamedClip<'a> {
    pub(super) name: String,
    pub(super) path: &'a Path,
    pub(super) clip: Clip,
}

/// Which part of a clip, and how it is read.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct Part {
    /// Keep a T-pose that was inserted before or after the motion.
    #[arg(long, help_heading = READING)]
    keep_lead_in: bool,
    /// Only frames A up to but not including B, from 0.
    #[arg(long, value_name = "A..B", value_parser = frames, help_heading = READING)]
    trim: Option<Frames>,
    #[command(flatten)]
    reading: Reading,
}

/// How a clip is read.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct Reading {
    /// Frames per second, over the file's.
    ///
    /// Rows are played at this rate; curves (FBX, glTF) are sampled at it.
    #[arg(long, value_name = "N", value_parser = rate, allow_negative_numbers = true, help_heading = READING)]
    fps: Option<FrameRate>,
    /// The tree of joints to use, by the name of its root.
    #[arg(long, value_name = "NAME", help_heading = READING)]
    root: Option<String>,
    /// The take to use, of several; inspect lists them.
    #[arg(long, value_name = "NAME", help_heading = READING)]
    take: Option<String>,
    /// The axis that points up: y or z.
    ///
    /// Whatever the file says and however the body stands.
    #[arg(long, value_name = "AXIS", value_parser = up, help_heading = READING)]
    up: Option<Axis>,
    /// Table of bones: head, limbs, bones of vmd and vrma.
    ///
    /// Over the built-in one: which joints are head and limbs, and which joints drive which bones of vmd and vrma.
    #[arg(long, value_name = "BONES.toml", help_heading = READING)]
    pub(super) bones: Option<PathBuf>,
    /// Skeleton of a VMD (.pmx, .pmd) or an AMC (.asf).
    ///
    /// For a motion without one; an .asf beside its .amc is found.
    #[arg(long, value_name = "FILE", help_heading = READING)]
    skeleton: Option<PathBuf>,
    /// Camera of the take (.vmd, .glb, .gltf).
    ///
    /// In a file of its own, as in MMD. Its moves fill the CAMERA column. The keys of a VMD are written in the sheet's
    /// time, beside the motion for MMD.
    #[arg(long, value_name = "FILE", help_heading = READING)]
    pub(super) camera_work: Option<PathBuf>,
    /// Keep frames that fly off, and broken ends.
    ///
    /// Glitches are single frames that fly off, and ends at which the tracker comes from the origin.
    #[arg(long, help_heading = READING)]
    keep_glitches: bool,
    /// Repair nan, inf and rows that are too long.
    ///
    /// nan and inf get the value before them, and surplus values of a row are dropped. A note reports each repair.
    #[arg(long, conflicts_with = "strict", help_heading = READING)]
    repair: bool,
    /// Refuse faults of the file; what is said of the motion passes.
    #[arg(long, help_heading = READING)]
    strict: bool,
    /// Memory limit in GiB.
    ///
    /// Of the work [default: 1 plus 18 times the values of the clip], and of input from a pipe [default: 1].
    #[arg(long, value_name = "GIB", allow_negative_numbers = true, value_parser = gib, help_heading = READING)]
    memory: Option<f64>,
}

/// A half-open range of source frames.
type Frames = std::ops::Range<usize>;

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

fn gib(text: &str) -> Result<f64, String> {
    let gib = text.parse().ok().filter(|gib: &f64| *gib > 0.0 && gib.is_finite());
    gib.ok_or_else(|| "expected GiB above 0, as in 8 or 0.5".into())
}

fn up(text: &str) -> Result<Axis, String> {
    match text {
        "y" | "Y" => Ok(Axis::Y),
        "z" | "Z" => Ok(Axis::Z),
        _ => Err("expected y or z".into()),
    }
}

fn rate(text: &str) -> Result<FrameRate, String> {
    let fps = text.parse().ok().and_then(|fps| FrameRate::new(fps).ok());
    fps.ok_or_else(|| "expected frames a second from 0.001 to 1000000, as in 120 or 29.97".into())
}

/// A clip that is ready to be worked on, and notes about it.
pub(super) struct Source {
    pub(super) clip: Clip,
    pub(super) notes: Vec<Warning>,
    /// Seconds per frame as written in the file, if they are.
    pub(super) written_frame_time: Option<f64>,
    /// Facts found in the file, if it is not a BVH.
    pub(super) found: Vec<Found>,
    /// The file's takes; empty for formats without takes.
    pub(super) takes: Vec<Take>,
    /// Identifies the whole file.
    pub(super) of: ClipMark,
}

impl ClipArgs {
    /// Reads the clip as [`Part::read`] does.
    pub(super) fn read(&self) -> Result<Source, Failure> {
        self.part.read(&self.path)
    }

    /// The memory budget of a run of this clip.
    pub(super) fn budget(&self) -> Budget {
        self.part.budget()
    }
}

impl Part {
    /// The options of reading.
    pub(super) fn reading(&self) -> &Reading {
        &self.reading
    }

    /// The memory limit in bytes, if one was asked for.
    pub(super) fn memory(&self) -> Option<f64> {
        self.reading.memory.map(|gib| gib * 1024.0 * 1024.0 * 1024.0)
    }

    /// Text that is the same for parts that are read alike: files count by their contents, and memory, which changes no
    /// result, does not count.
    pub(super) fn fingerprint(&self) -> Result<String, Failure> {
        let mut alike = self.clone();
        let Reading { bones, skeleton, camera_work, memory, .. } = &mut alike.reading;
        for file in [bones, skeleton, camera_work].into_iter().flatten() {
            *file = files::digest(file)?.into();
        }
        *memory = None;
        Ok(format!("{alike:?}"))
    }

    /// The memory budget of work on this clip.
    pub(super) fn budget(&self) -> Budget {
        self.reading.memory.map_or(Budget::default(), Budget::gib)
    }

    /// Reads the clip, removes or repairs lead-ins and glitches unless asked to keep them, and trims.
    ///
    /// A T-pose or a glitch is a fact about the motion and no fault of the file, so `--strict` accepts it.
    pub(super) fn read(&self, path: &Path) -> Result<Source, Failure> {
        let read = self.reading.read(path)?;
        let genga_read::Read { clip, warnings: mut notes, written_frame_time, found, takes } = read;
        let of = ClipMark::new(&paths::file_name(path), &clip);
        let Self { keep_lead_in, trim, reading } = self;
        let (keep_lead_in, keep_glitches) = (*keep_lead_in, reading.keep_glitches);
        let cleaning = Cleaning { keep_lead_in, keep_glitches, trim: trim.clone() };
        let (clip, cleaned) = cleaning.apply(clip).map_err(|error| match error {
            Error::Clip { message } => Failure::AskedWrongly(format!("--trim: {message}")),
            other => files::fault_of(path)(other),
        })?;
        notes.extend(cleaned);
        clip.check_size().map_err(files::fault_of(path))?;
        Ok(Source { clip, notes, written_frame_time, found, takes, of })
    }

    /// Reads every file before any work begins, and prints each one's warnings. A file that cannot be read is told and
    /// left out, if there are others.
    pub(super) fn read_all<'a>(
        &self,
        paths: &'a [PathBuf],
        several: &mut Several<'_>,
        words: &Words,
    ) -> Result<Vec<NamedClip<'a>>, Failure> {
        let mut clips = Vec::with_capacity(paths.len());
        for (name, path) in paths::names(paths).into_iter().zip(paths) {
            let Some(source) = several.keep(path, self.read(path))? else { continue };
            let of = if paths.len() > 1 { format!("{}: ", path.display()) } else { String::new() };
            source.notes.iter().for_each(|warning| words.warn_of(&of, warning));
            clips.push(NamedClip { name, path, clip: source.clip });
        }
        Ok(clips)
    }
}

impl Reading {
    /// Reads the bone table given by `--bones`.
    pub(super) fn bones(&self) -> Result<Option<BoneMap>, Failure> {
        let parsed = |path| files::parsed("bones", path, BoneMap::parse);
        self.bones.as_deref().map(parsed).transpose()
    }

    /// Reads the whole file with its metadata and warnings.
    fn read(&self, path: &Path) -> Result<genga_read::Read, Failure> {
        if path.is_dir() {
            return Err(Failure::AskedWrongly(folder(path)));
        }
        let Self { fps, root, take, up, skeleton, repair, strict, memory, camera_work, .. } =
            self.clone();
        let stream = memory.map_or(StreamLimit::default(), StreamLimit::gib);
        let bones = self.bones()?;
        let options = genga_read::Options {
            strict,
            repair,
            fps,
            root,
            take,
            skeleton,
            camera: camera_work,
            up,
            bones,
            stream,
        };
        let read = if paths::is_stream(path) {
            options.read(&files::read_up_to(stream, path)?)
        } else {
            options.open(path)
        };
        read.map_err(|error| match error {
            Error::Setting { name, message } => {
                Failure::AskedWrongly(format!("--{name}: {message}"))
            }
            Error::Motion { .. } if is_sheet(path) => Failure::AskedWrongly(sheet(path)),
            other => files::fault_of(path)(other),
        })
    }

    /// Reads the motion that a sheet was made of, and prints its warnings.
    pub(super) fn read_for(
        &self,
        sheet: (&Path, &SheetFile),
        path: &Path,
        words: &Words,
    ) -> Result<OfSheet, Failure> {
        self.read_whole(path, words)?.of_sheet(sheet, "", words)
    }

    /// Reads the whole file that sheets were made of, and prints its warnings.
    pub(super) fn read_whole(&self, path: &Path, words: &Words) -> Result<Whole, Failure> {
        let read = self.read(path)?;
        let of = ClipMark::new(&paths::file_name(path), &read.clip);
        let (clip, note) =
            if self.keep_glitches { (read.clip, None) } else { glitches::mend(read.clip) };
        read.warnings.iter().chain(&note).for_each(|warning| words.warn(warning));
        Ok(Whole { clip, of, path: path.to_owned() })
    }
}

/// A whole motion file that sheets were made of.
#[derive(Clone)]
pub(super) struct Whole {
    clip: Clip,
    of: ClipMark,
    path: PathBuf,
}

impl Whole {
    /// Cuts out the motion of a sheet, and prints warnings with a prefix that names the sheet.
    pub(super) fn of_sheet(
        self,
        (sheet, file): (&Path, &SheetFile),
        name: &str,
        words: &Words,
    ) -> Result<OfSheet, Failure> {
        let of_sheet = files::fault_of(sheet);
        let (source, notes) = file.fit(self.clip).map_err(&of_sheet)?;
        source.check_size().map_err(files::fault_of(&self.path))?;
        let drawn = file.drawn(&source).map_err(&of_sheet)?;
        notes.iter().for_each(|warning| words.warn_of(name, warning));
        Ok(OfSheet { source, drawn, of: self.of })
    }
}

/// The motion that a sheet was made of.
pub(super) struct OfSheet {
    /// The motion as captured.
    pub(super) source: Clip,
    /// The motion as drawn, if it was exaggerated.
    pub(super) drawn: Option<Clip>,
    /// Identifies the whole file.
    pub(super) of: ClipMark,
}

impl OfSheet {
    /// The motion that the drawings show.
    pub(super) fn clip(&self) -> &Clip {
        self.drawn.as_ref().unwrap_or(&self.source)
    }
}

/// The message for a folder given in place of a clip.
fn folder(path: &Path) -> String {
    let name = path.display();
    match paths::first_clip(path) {
        Some(clip) => {
            let clip = clip.display();
            format!(
                "{name} is a folder: name a clip in it, such as {clip}; of all: genga batch {name} --out library"
            )
        }
        None => format!("{name} is a folder without a motion file: name a clip"),
    }
}

/// Whether a file is a genga sheet.
fn is_sheet(path: &Path) -> bool {
    let mut begin = String::new();
    let file = fs::File::open(path).map(|file| file.take(256));
    // The limit may split a multi-byte character; the text read before it is kept.
    let _ = file.and_then(|mut file| file.read_to_string(&mut begin));
    begin.contains("\"genga-sheet-")
}

/// The message for a sheet given in place of a clip.
fn sheet(path: &Path) -> String {
    let sheet = path.display();
    format!(
        "{sheet} is a sheet and no motion; for files of it: genga deliver {sheet} CLIP.bvh --to xdts"
    )
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
