//! Everything that a run writes (書き出し), as one archive. Each file has the same bytes as the program's.

use std::collections::BTreeMap;
use std::fmt::Display;

use genga_files::{Attempt, ClipMark, FORMATS, Format, Manifest, Report, Run, zip};
use genga_studio::Export;

/// Returns the archive of a folder, and the names of its files, then a sentence in brackets for each format that cannot
/// be made of this clip.
pub(crate) fn archive(
    folder: &str,
    export: &Export<'_>,
    clip: &ClipMark,
    tell: &dyn Fn(&str),
) -> Result<(Vec<u8>, Vec<String>), String> {
    let Export { breakdown, recipe, edits, .. } = *export;
    let name = export.clip.file_stem().unwrap_or_default().to_string_lossy();
    let run = Run { name: &name, clip, breakdown, recipe, edits };
    let mut files = Files::default();
    let mut report = Report::new(breakdown, export.notes.to_vec());
    let names = Run::FORMATS.iter().chain(export.formats).copied();
    let formats = Format::find_all(names).map_err(said)?;
    let mut unmade = Vec::new();
    run.with_cut(|cut| {
        for format in &formats {
            tell(format.name);
            let attempt = format.try_write(cut, export.settings, &mut |name, bytes| {
                files.add(name, bytes.to_vec());
                Ok(())
            })?;
            match attempt {
                Attempt::Made(notes) => report.notes.extend(notes.iter().map(ToString::to_string)),
                Attempt::NotMade(error) => unmade.push(format.unmade(&error)),
            }
        }
        Ok(())
    })
    .map_err(|error: genga::Error| said(error))?;
    report.losses.extend(unmade.iter().map(ToString::to_string));
    tell(Run::SPEEDS);
    files.add(Run::SPEEDS, run.speeds().map_err(said)?.into_bytes());
    let recipe = recipe.write(edits);
    let mut manifest = Manifest::new(clip.clone());
    manifest.formats = formats.iter().map(|format| format.name.to_owned()).collect();
    manifest.formats.sort_unstable();
    manifest.settings = export.settings.own();
    manifest.recipe = Some(Manifest::digest(recipe.as_bytes()));
    files.add(Run::RECIPE, recipe.into_bytes());
    files.add(Run::REPORT, report.write().map_err(said)?.into_bytes());
    manifest.files = files.digests();
    files.add(Run::MANIFEST, manifest.write().map_err(said)?.into_bytes());
    let (archive, mut names) = files.packed(folder).map_err(said)?;
    names.extend(unmade.into_iter().map(|warning| format!("({})", warning.message)));
    Ok((archive, names))
}

/// Looks up the formats that a text names, separated by spaces.
pub(crate) fn names(text: &str) -> Vec<&'static str> {
    let is_meant = |name: &&str| text.split(' ').any(|word| word == *name);
    FORMATS.iter().map(|format| format.name).filter(is_meant).collect()
}

/// Files in the order in which they were made.
#[derive(Default)]
struct Files(Vec<(String, Vec<u8>)>);

impl Files {
    fn add(&mut self, name: &str, bytes: Vec<u8>) {
        self.0.push((name.into(), bytes));
    }

    fn digests(&self) -> BTreeMap<String, String> {
        self.0.iter().map(|(name, bytes)| (name.clone(), Manifest::digest(bytes))).collect()
    }

    /// Packs all files into a folder of an archive.
    fn packed(self, folder: &str) -> std::io::Result<(Vec<u8>, Vec<String>)> {
        let (names, bytes): (Vec<_>, Vec<_>) = self.0.into_iter().unzip();
        let places: Vec<String> = names.iter().map(|name| format!("{folder}/{name}")).collect();
        let files = places.iter().map(String::as_str).zip(bytes.iter().map(Vec::as_slice));
        Ok((zip::archive(files)?, names))
    }
}

fn said(error: impl Display) -> String {
    error.to_string()
}
