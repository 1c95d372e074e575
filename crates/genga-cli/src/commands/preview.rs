//! `genga preview`: two sheets of one take side by side, in step.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::clip::{OfSheet, Reading, Whole};
use crate::console::{Words, counted};
use crate::failure::Failure;
use crate::look_args::LookArgs;
use crate::sheets::{SHEET, near};
use crate::{files, paths, sheets};
use genga::error::Error;
use genga_files::sheet_json::SheetFile;
use genga_files::{Cut, Format};
use genga_plot::{SideBySide, Version};

const HELP: &str = "\
The ending of --out chooses the film: .html plays and steps in any browser, .gif and .mp4 play.
Each sheet has its name, the number of its drawing (genga in red) and its bars; ≠ marks the koma
on which the drawings differ. Settings are those of the formats flipbook, preview and mp4 (see
genga help deliver). Of one sheet: genga deliver --to flipbook,preview,mp4.

Examples:
  genga preview kick-genga kick-ones --clip kick.bvh
  genga preview kick-genga by-hand.xdts --names genga,hand --out kick.mp4";

#[derive(Debug, Args)]
#[command(after_help = HELP)]
pub(super) struct PreviewArgs {
    /// A results folder, a sheet.json, or a timesheet of all drawings (XDTS or TDTS).
    #[arg(value_name = "A")]
    one: PathBuf,
    /// The same of another sheet of the take.
    #[arg(value_name = "B")]
    other: PathBuf,
    /// The motion that the sheets were made of, the whole file [default: the one of its name beside a sheet or here].
    #[arg(long, short, value_name = "CLIP")]
    clip: Option<PathBuf>,
    /// Film to write: .html, .gif or .mp4 [default: A-B.html, by their names].
    #[arg(long, short, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Names shown for the two [default: those of the folders or files].
    #[arg(long, value_name = "NAME,NAME", value_delimiter = ',')]
    names: Vec<String>,
    #[command(flatten)]
    look: LookArgs,
    #[command(flatten)]
    reading: Reading,
}

/// How to find the drawings of a timesheet here, as an error ends.
pub(super) const DRAWINGS: &str = "put it into the results folder that it came from";

pub(super) fn run(args: &PreviewArgs, words: &Words) -> Result<(), Failure> {
    check_streams(args)?;
    let names = names(args)?;
    let out = args.out.clone().unwrap_or_else(|| {
        let [one, other] = &names;
        Cut::file_of(&format!("{one}-{other}"), "CUT.html").into()
    });
    let film = Format::find_film(&paths::ending(&out).unwrap_or_default()).map_err(wrongly)?;
    let settings = args.look.settings()?;
    let sheets = [sheets::file_of(&args.one)?, sheets::file_of(&args.other)?];
    let read = |path: &PathBuf| sheets::read(path, (None, DRAWINGS), words);
    let read = [read(&sheets[0])?, read(&sheets[1])?];
    check_take(&names, &read)?;
    let clip = clip(args, &sheets, &read)?;
    let [one, other] = sheets.each_ref().map(|path| ("sheet", Some(path.as_path())));
    paths::spare(&[one, other, ("motion", Some(clip.as_path()))], &out)?;
    let whole = args.reading.read_whole(&clip, words)?;
    let motions = motions(whole, [0, 1].map(|at| (&names[at], &sheets[at], &read[at])), words)?;
    let version =
        |at: usize| Version { name: &names[at], clip: motions[at].clip(), sheet: &read[at].sheet };
    let shown = SideBySide::versions([version(0), version(1)]).map_err(could_not)?;
    let (bytes, notes) = film.film(&cut(&read), &shown, &settings)?;
    notes.iter().for_each(|note| words.warn(note));
    files::write(&out, &bytes)?;
    summary(&names, &read, &shown.differences()?, words);
    words.say(format_args!("files       {}", out.display()));
    Ok(())
}

fn wrongly(error: Error) -> Failure {
    match error {
        Error::Setting { name, message } if name == "out" => {
            Failure::AskedWrongly(format!("--out: {message}"))
        }
        Error::Setting { name, message } => {
            Failure::AskedWrongly(format!("--out: {name}: {message}"))
        }
        other => other.into(),
    }
}

fn could_not(error: Error) -> Failure {
    match error {
        Error::Sheet { message, .. } => Failure::AskedWrongly(message),
        other => other.into(),
    }
}

/// Returns the names of the two: those asked for, else those of the folders or files, else the paths.
fn names(args: &PreviewArgs) -> Result<[String; 2], Failure> {
    match args.names.as_slice() {
        [] => {}
        [one, other] if ![one, other].iter().any(|name| name.trim().is_empty()) => {
            return Ok([one, other].map(|name| name.trim().to_owned()));
        }
        _ => {
            let message = "--names: expected one name for each sheet, as in genga,hand".into();
            return Err(Failure::AskedWrongly(message));
        }
    }
    let [one, other] = [&args.one, &args.other];
    let short = [one, other].map(|path| name_of(path));
    match short[0] == short[1] {
        false => Ok(short),
        true => Ok([one, other].map(|path| path.display().to_string())),
    }
}

/// Names a sheet by its folder if the file is called sheet.json, else by its file.
fn name_of(path: &Path) -> String {
    let folder = if path.is_dir() { Some(path) } else { path.parent() };
    if path.is_dir() || paths::file_name(path) == SHEET {
        let folder = folder.and_then(|folder| std::path::absolute(folder).ok());
        let name = folder.as_deref().and_then(Path::file_name);
        return name.map_or_else(|| paths::stem(path), |name| name.to_string_lossy().into_owned());
    }
    paths::stem(path)
}

/// Refuses sheets of two motions: with the same frames and another motion, or with other frames of another file.
fn check_take(names: &[String; 2], [one, other]: &[SheetFile; 2]) -> Result<(), Failure> {
    let (one, other) = (&one.clip, &other.clip);
    let are_same_frames = (one.first_frame, one.frames) == (other.first_frame, other.frames);
    let is_one_take = match are_same_frames {
        true => one.motion == other.motion && one.joints == other.joints,
        false => one.file == other.file,
    };
    if is_one_take {
        return Ok(());
    }
    Err(Failure::AskedWrongly(format!(
        "{} was made of {} and {} of {}, with another motion: two versions are of one take",
        names[0], one.file, names[1], other.file
    )))
}

/// Returns the motion of the sheets: the one that is named, else the file of its name beside a sheet, up to two folders
/// above, or here.
fn clip(
    args: &PreviewArgs,
    sheets: &[PathBuf; 2],
    read: &[SheetFile; 2],
) -> Result<PathBuf, Failure> {
    if let Some(clip) = &args.clip {
        return Ok(clip.clone());
    }
    let name = &read[0].clip.file;
    let is_plain = Path::new(name).file_name().is_some_and(|file| *file == **name);
    let folders = sheets.iter().flat_map(|path| near(path)).chain([Path::new(".")]);
    let found = folders.map(|folder| folder.join(name)).find(|file| is_plain && file.is_file());
    found.ok_or_else(|| {
        Failure::AskedWrongly(format!(
            "the motion {name} is neither beside the sheets nor here: name it, as in --clip data/{name}"
        ))
    })
}

/// Refuses more than one stdin.
fn check_streams(args: &PreviewArgs) -> Result<(), Failure> {
    let streams = [&args.one, &args.other]
        .into_iter()
        .chain(&args.clip)
        .filter(|path| paths::is_stream(path));
    if streams.count() > 1 {
        let message = "only one of the sheets and the clip can come from stdin".into();
        return Err(Failure::AskedWrongly(message));
    }
    Ok(())
}

/// Cuts the motion of each sheet out of the whole file.
fn motions(
    whole: Whole,
    [one, other]: [(&String, &PathBuf, &SheetFile); 2],
    words: &Words,
) -> Result<[OfSheet; 2], Failure> {
    let of = |whole: Whole, (name, path, file): (&String, &PathBuf, &SheetFile)| {
        whole.of_sheet((path, file), &format!("{name}: "), words)
    };
    Ok([of(whole.clone(), one)?, of(whole, other)?])
}

/// Returns the name of the cut, or those of both.
fn cut([one, other]: &[SheetFile; 2]) -> String {
    if one.cut == other.cut { one.cut.clone() } else { format!("{} · {}", one.cut, other.cut) }
}

/// Says what is shown of each sheet, which one holds its end, and on how many koma they differ.
fn summary(names: &[String; 2], read: &[SheetFile; 2], differences: &[bool], words: &Words) {
    for (name, file) in names.iter().zip(read) {
        let of_layer = |layer: &genga::sheet::Layer| layer.shown().count();
        let drawings: usize = file.sheet.layers.iter().map(of_layer).sum();
        let (koma, drawings) = (file.sheet.cut_length(), counted(drawings, "drawing"));
        words.say(format_args!("sheet       シート     {name}: {koma} koma, {drawings}"));
    }
    let [one, other] = [0, 1].map(|at| read[at].sheet.cut_length());
    if one != other {
        let shorter = &names[usize::from(other < one)];
        words.say(format_args!("length      尺         {shorter} is shorter, and holds its end"));
    }
    let (differ, koma) = (differences.iter().filter(|differ| **differ).count(), differences.len());
    words.say(format_args!(
        "different   違い       {differ} of {koma} koma show different drawings"
    ));
}
