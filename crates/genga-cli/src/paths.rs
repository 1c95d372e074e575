//! Paths: `-` is stdin or stdout, a clip is named after its file, and input files are never overwritten.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use genga_read::FORMATS;

/// Whether a path means stdin or stdout.
pub(super) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Refuses to overwrite an input file, which may be somebody's only take. Each source is a noun for the message and a
/// path, if there is one.
pub(super) fn spare(sources: &[(&str, Option<&Path>)], target: &Path) -> Result<(), Failure> {
    let is_target =
        |(_, path): &&(&str, Option<&Path>)| path.is_some_and(|path| is_same(path, target));
    let Some((what, _)) = sources.iter().find(is_target) else { return Ok(()) };
    let target = target.display();
    let message = format!("{target}: this is the {what} itself; write elsewhere, as with --out");
    Err(Failure::AskedWrongly(message))
}

/// Refuses two outputs to the same path: only the last would be left.
pub(super) fn distinct<'a>(targets: impl Iterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    let targets: Vec<&PathBuf> = targets.collect();
    for (at, target) in targets.iter().enumerate() {
        if targets[..at].iter().any(|other| other == target || is_same(other, target)) {
            let target = target.display();
            let message = format!("{target}: two outputs are to go there; name another for one");
            return Err(Failure::AskedWrongly(message));
        }
    }
    Ok(())
}

/// Whether two paths are the same existing file.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| fs::canonicalize(path).ok();
    !is_stream(a) && real(a).is_some_and(|a| real(b) == Some(a))
}

/// Whether a path has the extension of a motion format.
pub(super) fn is_motion(path: &Path) -> bool {
    FORMATS.iter().any(|format| format.ends(path))
}

/// Whether a path has the extension of a picture that genga writes, on which a person may paint.
pub(super) fn is_picture(path: &Path) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    ["png", "svg", "gif"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// The first motion file of a folder, by name.
pub(super) fn first_clip(folder: &Path) -> Option<PathBuf> {
    let entries = folder.read_dir().ok()?.flatten().map(|entry| entry.path());
    entries.filter(|path| is_motion(path)).min()
}

/// The name of a clip: its file name without the extension, `stdin` for `-`.
pub(super) fn stem(path: &Path) -> String {
    if is_stream(path) {
        return "stdin".into();
    }
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// Names several clips: by file name alone if that tells them apart, else by path.
pub(super) fn names(clips: &[PathBuf]) -> Vec<String> {
    let stems: Vec<String> = clips.iter().map(|clip| stem(clip)).collect();
    let is_one = |stem: &String| stems.iter().filter(|other| *other == stem).count() == 1;
    if stems.iter().all(is_one) {
        return stems;
    }
    clips.iter().map(|clip| clip.display().to_string()).collect()
}

/// The name of a file without its folders, `stdin` for `-`.
pub(super) fn file_name(path: &Path) -> String {
    let named = named(path);
    named.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The path shown in messages for an input file.
pub(super) fn named(path: &Path) -> PathBuf {
    if is_stream(path) { PathBuf::from("stdin") } else { path.to_owned() }
}

/// Refuses stdout, a device or a pipe as `--out` of a `command` that writes a folder. `instead` names an alternative.
pub(super) fn check_folder(
    out: Option<&Path>,
    command: &str,
    instead: &str,
) -> Result<(), Failure> {
    let Some(out) = out else { return Ok(()) };
    let is_device = std::fs::metadata(out).is_ok_and(|about| !about.is_file() && !about.is_dir());
    let what = match is_stream(out) {
        true => "stdout".to_owned(),
        false if is_device => out.display().to_string(),
        false => return Ok(()),
    };
    let message = format!("--out: {command} writes a folder of files, not to {what}{instead}");
    Err(Failure::AskedWrongly(message))
}

/// Help on an option that draws: what it draws, and the formats that this build writes.
pub(super) fn picture_help(what: &str) -> String {
    let formats = match (cfg!(feature = "pdf"), cfg!(feature = "pictures")) {
        (true, _) => "SVG, PDF or PNG",
        (false, true) => "SVG or PNG",
        (false, false) => "SVG",
    };
    format!("{what}, as an {formats} file")
}

/// Refuses, before any work, a picture whose format cannot be written.
pub(super) fn check_picture(option: &str, path: Option<&PathBuf>) -> Result<(), Failure> {
    match path.and_then(|path| ending(path)).as_deref() {
        Some("pdf") if !cfg!(feature = "pdf") => Err(Failure::AskedWrongly(format!(
            "--{option}: this genga was built without PDF; name an .svg or .png, or build it with \
             cargo install --path crates/genga-cli --features pdf --locked"
        ))),
        Some("png") if !cfg!(feature = "pictures") => Err(Failure::AskedWrongly(format!(
            "--{option}: this genga was built without PNG; name an .svg, or build it with \
             cargo install --path crates/genga-cli --features pictures --locked"
        ))),
        Some("pdf" | "png" | "svg") | None => Ok(()),
        Some(other) => Err(Failure::AskedWrongly(format!(
            "--{option}: a picture is .svg, .pdf or .png, not .{other}"
        ))),
    }
}

/// The file's extension in lowercase.
pub(super) fn ending(path: &Path) -> Option<String> {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase())
}

/// Finds numbered files left over from a longer sheet: they continue a numbered series of `written` but are not in it.
///
/// They are reported and not removed: numbered images are made to be drawn over, and a drawing is a person's work
/// whatever its number.
pub(super) fn stale(folder: &Path, written: &[String]) -> Vec<String> {
    let series: BTreeSet<_> = written.iter().filter_map(|name| series(name)).collect();
    let written: BTreeSet<&str> = written.iter().map(String::as_str).collect();
    let mut stale = Vec::new();
    for (inside, begin, end) in series {
        let Ok(entries) = fs::read_dir(folder.join(inside)) else { continue };
        for entry in entries.flatten().filter(|entry| entry.path().is_file()) {
            let file = entry.file_name().to_string_lossy().into_owned();
            let number = file.strip_prefix(&begin).and_then(|rest| rest.strip_suffix(end));
            let name = format!("{inside}{file}");
            if number.is_some_and(is_number) && !written.contains(&name[..]) {
                stale.push(name);
            }
        }
    }
    stale.sort();
    stale
}

/// Splits the name of a numbered file into its folder with the `/`, and the text before and after the number. The first
/// page of a picture has no number.
fn series(name: &str) -> Option<(&str, String, &str)> {
    let (inside, file) = name.split_at(name.rfind('/').map_or(0, |at| at + 1));
    let (stem, end) = file.split_at(file.rfind('.')?);
    let begin = stem.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let begin = if begin == stem { format!("{stem}-") } else { begin.into() };
    Some((inside, begin, end))
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_longer_sheet_left_is_told_from_what_a_person_put_there() {
        let place = tempfile::tempdir().unwrap();
        fs::create_dir(place.path().join("images")).unwrap();
        fs::create_dir(place.path().join("strip-4.svg")).unwrap();
        for file in
            ["strip.svg", "strip-2.svg", "strip-3.svg", "strip-b.svg", "strip-2.png", "strip2.svg"]
        {
            fs::write(place.path().join(file), "").unwrap();
        }
        for file in ["A_0001.png", "A_0002.png", "A_0002b.png", "B_0002.png", "A_.png"] {
            fs::write(place.path().join("images").join(file), "").unwrap();
        }
        let left = |written: &[&str]| {
            let written: Vec<_> = written.iter().map(|name| (*name).to_owned()).collect();
            stale(place.path(), &written)
        };
        assert_eq!(left(&["strip.svg"]), ["strip-2.svg", "strip-3.svg"]);
        assert_eq!(left(&["strip.svg", "strip-2.svg"]), ["strip-3.svg"]);
        assert_eq!(left(&["images/A_0001.png"]), ["images/A_0002.png"]);
        assert_eq!(left(&["images/A_0001.png", "images/A_0002.png"]), [""; 0]);
    }
}
