//! `--seen-from`: the camera in which movement is measured, as a word, a place, or a camera of a glTF file.

use std::path::Path;

use clap::Args;

use super::failure::Failure;
use super::files;
use super::headings::SHEET;
use genga::error::{Error, Warning};
use genga::motion::{Clip, SeenFrom};
use genga_read::GltfCamera;

/// Extensions of files that may contain a camera.
const ENDINGS: [&str; 2] = [".glb", ".gltf"];

/// The camera that measures movement, in place of the recipe's.
#[derive(Debug, Default, Clone, Args)]
pub(super) struct SeenArgs {
    /// Measure on the screen (画面) of a camera: auto, cut.glb …
    ///
    /// Otherwise movement is measured in the world. The camera is front, side, three-quarter or auto (which sees most);
    /// a place, X,Y,Z:X,Y,Z (position and target, in the file's unit); or the first camera of a .glb or .gltf file, or
    /// the one with the given name: --seen-from cut.glb:Camera.001
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true, help_heading = SHEET)]
    seen_from: Option<String>,
}

/// Returns the camera asked for, if any, and warnings about it.
pub(super) fn asked(
    args: &SeenArgs,
    clip: &Clip,
) -> Result<(Option<SeenFrom>, Vec<Warning>), Failure> {
    let Some(text) = &args.seen_from else { return Ok((None, vec![])) };
    let (seen_from, notes) = match file_and_name(text) {
        Some((file, name)) => camera(Path::new(file), name, clip)?,
        None => (word(text)?, vec![]),
    };
    Ok((Some(seen_from), notes))
}

/// Whether a camera is asked for.
pub(super) fn is_asked(args: &SeenArgs) -> bool {
    args.seen_from.is_some()
}

/// The file that a camera is read from.
pub(super) fn file(args: &SeenArgs) -> Option<&Path> {
    args.seen_from.as_deref().and_then(file_and_name).map(|(file, _)| Path::new(file))
}

/// Text that is the same for the same camera, wherever its file lies.
pub(super) fn fingerprint(args: &SeenArgs) -> Result<Option<String>, Failure> {
    let of = |text: &str| match file_and_name(text) {
        Some((file, name)) => Ok(format!("{} {name:?}", files::digest(Path::new(file))?)),
        None => Ok(text.to_owned()),
    };
    args.seen_from.as_deref().map(of).transpose()
}

/// Parses a word or a place.
fn word(text: &str) -> Result<SeenFrom, Failure> {
    text.parse().map_err(|error| match error {
        Error::Setting { message, .. } => Failure::AskedWrongly(format!(
            "--seen-from: {message}; or a .glb or .gltf file with a camera"
        )),
        other => other.into(),
    })
}

/// Splits the text into a file and the camera name after it, if it ends in `.glb` or `.gltf` or contains one followed
/// by `:`.
fn file_and_name(text: &str) -> Option<(&str, Option<&str>)> {
    let lower = text.to_ascii_lowercase();
    if ENDINGS.iter().any(|ending| lower.ends_with(ending)) {
        return Some((text, None));
    }
    let ends = |ending: &&str| Some(lower.find(&format!("{ending}:"))? + ending.len());
    let end = ENDINGS.iter().filter_map(ends).min()?;
    Some((&text[..end], Some(&text[end + 1..])))
}

fn camera(
    path: &Path,
    name: Option<&str>,
    clip: &Clip,
) -> Result<(SeenFrom, Vec<Warning>), Failure> {
    let of_file = files::fault_of(path);
    let camera = GltfCamera::read(&files::read(path)?, name).map_err(&of_file)?;
    let eye = camera.eye(clip).map_err(&of_file)?;
    let mut notes = Vec::new();
    if camera.is_animated {
        let message = format!(
            "camera {} of {} moves; movement is measured from where it rests, through the whole clip",
            camera.name,
            path.display()
        );
        notes.push(Warning::new("W_CAMERA_MOVES", message));
    }
    Ok((SeenFrom::Eye(eye), notes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_may_stand_behind_a_file() {
        for (text, expected) in [
            ("front", None),
            ("0,1,2:3,4,5", None),
            ("cut.glb", Some(("cut.glb", None))),
            ("a/b c.GLTF", Some(("a/b c.GLTF", None))),
            ("cut.glb:Camera.001", Some(("cut.glb", Some("Camera.001")))),
            ("cut.gltf:正面", Some(("cut.gltf", Some("正面")))),
            (r"C:\cut.glb:a:b", Some((r"C:\cut.glb", Some("a:b")))),
            ("cut.glb:top.glb", Some(("cut.glb:top.glb", None))),
        ] {
            assert_eq!(file_and_name(text), expected, "{text}");
        }
    }
}
