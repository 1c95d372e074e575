//! Pictures beside a clip, on a disk: lists and reads them.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Color32, ColorImage};
use image::{DynamicImage, ImageDecoder, ImageReader, Limits};

use genga::recipe::Footage;
use genga_files::Mp4;
use genga_studio::Pictures;

/// Largest size, in pixels, of pictures extracted from a video; a view is no larger.
const WITHIN: (usize, usize) = (960, 540);
/// Most bytes of memory for reading a picture.
const MOST_BYTES: u64 = 256 << 20;

/// Lists the pictures of a folder, of the sequence that a picture belongs to, or of a video.
pub(super) fn list(path: &Path) -> Result<Pictures, String> {
    let files = match fs::metadata(path) {
        Err(error) => return Err(format!("{}: {error}", path.display())),
        Ok(found) if found.is_dir() => in_folder(path),
        Ok(_) if is_picture(path) => sequence(path),
        Ok(_) => return of_video(path),
    };
    match files.is_empty() {
        true => Err(format!("{}: there is no picture (png, jpg) in it", path.display())),
        false => Ok(Pictures { files, note: None, kept: None }),
    }
}

fn is_picture(path: &Path) -> bool {
    let own = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    own.is_some_and(|own| Footage::PICTURES.contains(&&*own))
}

/// Lists the pictures in a folder, with `take_9.png` before `take_10.png`.
pub(super) fn in_folder(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let pictures = entries.map(|entry| entry.path()).filter(|path| is_picture(path));
    let mut pictures: Vec<PathBuf> = pictures.filter(|path| path.is_file()).collect();
    pictures.sort_by_cached_key(|path| {
        let (before, number) = numbered(path);
        (before, number, path.clone())
    });
    pictures
}

/// Lists the pictures with the same name before their number. A picture without a number stands alone.
fn sequence(of: &Path) -> Vec<PathBuf> {
    let (before, number) = numbered(of);
    if number.is_none() {
        return vec![of.to_owned()];
    }
    let is_of_it = |path: &PathBuf| {
        let (own, number) = numbered(path);
        own == before && number.is_some() && path.extension() == of.extension()
    };
    let folder = of.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    in_folder(folder).into_iter().filter(is_of_it).collect()
}

/// Splits the name of a picture into the text before its number and the number at its end.
fn numbered(path: &Path) -> (String, Option<u64>) {
    let stem = path.file_stem().map(OsStr::to_string_lossy).unwrap_or_default();
    let before = stem.trim_end_matches(|letter: char| letter.is_ascii_digit());
    (before.to_owned(), stem[before.len()..].parse().ok())
}

/// Extracts the pictures of a video to a folder that exists as long as they are used.
fn of_video(video: &Path) -> Result<Pictures, String> {
    let failed = |error: &dyn std::fmt::Display| format!("{}: {error}", video.display());
    let folder = tempfile::tempdir().map_err(|error| failed(&error))?;
    Mp4::default().take_apart(video, folder.path(), WITHIN).map_err(|error| failed(&error))?;
    let files = in_folder(folder.path());
    if files.is_empty() {
        return Err(failed(&"ffmpeg found no picture in it"));
    }
    let is_whole = files.len() < Mp4::MOST_PICTURES;
    let note = (!is_whole).then(|| failed(&"its first ten minutes are shown, and no more"));
    Ok(Pictures { files, note, kept: Some(Arc::new(folder)) })
}

/// Reads a picture, turned upright and scaled down to fit the given size.
pub(super) fn read(file: &Path, [wide, high]: [usize; 2]) -> Result<ColorImage, String> {
    let said = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
    let picture = decoded(file).map_err(|error| said(&error))?;
    let (wide, high) = (wide as u32, high as u32);
    let picture = match picture.width() > wide || picture.height() > high {
        true => picture.thumbnail(wide, high),
        false => picture,
    };
    let picture = picture.to_rgb8();
    let size = [picture.width() as usize, picture.height() as usize];
    let pixels = picture.pixels().map(|pixel| Color32::from_rgb(pixel[0], pixel[1], pixel[2]));
    Ok(ColorImage::new(size, pixels.collect()))
}

fn decoded(file: &Path) -> image::ImageResult<DynamicImage> {
    let mut limits = Limits::default();
    limits.max_alloc = Some(MOST_BYTES);
    let mut reader = ImageReader::open(file)?.with_guessed_format()?;
    reader.limits(limits);
    let mut decoder = reader.into_decoder()?;
    let orientation = decoder.orientation()?;
    let mut picture = DynamicImage::from_decoder(decoder)?;
    picture.apply_orientation(orientation);
    Ok(picture)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(names: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in names {
            image::RgbImage::from_pixel(8, 4, image::Rgb([200, 50, 16]))
                .save(folder.path().join(name))
                .unwrap();
        }
        folder
    }

    fn names(pictures: Result<Pictures, String>) -> Vec<String> {
        let name = |path: PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
        pictures.unwrap().files.into_iter().map(name).collect()
    }

    #[test]
    fn pictures_come_by_their_numbers_and_a_sequence_has_one_name() {
        let all = ["a_10.png", "a_9.png", "a_9.jpg", "b_1.png", "c.png", "a_11.JPG"];
        let folder = folder(&all);
        fs::write(folder.path().join("notes.txt"), "no picture").unwrap();
        let of = |name: &str| names(list(&folder.path().join(name)));
        assert_eq!(of(""), ["a_9.jpg", "a_9.png", "a_10.png", "a_11.JPG", "b_1.png", "c.png"]);
        assert_eq!(of("a_10.png"), ["a_9.png", "a_10.png"]);
        assert_eq!(of("c.png"), ["c.png"]);
    }

    #[test]
    fn what_is_none_is_said_by_its_name() {
        let folder = folder(&["torn_1.png"]);
        let torn = folder.path().join("torn_1.png");
        let bytes = fs::read(&torn).unwrap();
        fs::write(&torn, &bytes[..bytes.len() / 2]).unwrap();
        let error = read(&torn, [640, 480]).unwrap_err();
        assert!(error.contains("torn_1.png: "), "{error}");
        let gone = list(&folder.path().join("gone")).err().unwrap();
        assert!(gone.contains("gone: "), "{gone}");
        fs::remove_file(&torn).unwrap();
        let empty = list(folder.path()).err().unwrap();
        assert!(empty.contains("there is no picture (png, jpg) in it"), "{empty}");
    }

    #[test]
    fn a_large_picture_is_made_small_and_keeps_its_sides() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("large.png");
        image::RgbImage::from_pixel(3000, 1000, image::Rgb([10, 200, 30])).save(&file).unwrap();
        let picture = read(&file, [640, 480]).unwrap();
        assert_eq!(
            (picture.size, picture.pixels[77]),
            ([640, 213], Color32::from_rgb(10, 200, 30))
        );
        let small = read(&file, [4000, 4000]).unwrap();
        assert_eq!(small.size, [3000, 1000]);
    }

    #[test]
    #[allow(clippy::print_stderr, reason = "it says what it leaves out")]
    fn a_video_is_taken_apart_where_there_is_ffmpeg() {
        let folder = tempfile::tempdir().unwrap();
        let video = folder.path().join("a take: 1.mp4");
        let made = std::process::Command::new("ffmpeg")
            .args([
                "-loglevel",
                "error",
                "-f",
                "lavfi",
                "-i",
                "testsrc=size=1280x720:rate=60:duration=1",
            ])
            .arg(format!("file:{}", video.display()))
            .status();
        if !made.is_ok_and(|made| made.success()) {
            return eprintln!("left out: there is no ffmpeg to make a video");
        }
        let pictures = list(&video).unwrap();
        assert_eq!((pictures.files.len(), pictures.note), (24, None));
        let first = read(&pictures.files[0], [640, 480]).unwrap();
        assert_eq!(first.size, [640, 360]);
        let kept = pictures.files[0].clone();
        drop(pictures.kept);
        assert!(!kept.exists(), "what nobody keeps is not left on the disk");
        fs::write(&video, "no video").unwrap();
        let error = list(&video).err().unwrap();
        assert!(
            error.contains(
                "a take: 1.mp4: the pictures of a video could not be written: ffmpeg says: "
            ),
            "{error}"
        );
    }
}
