//! Finds clips' folders that are of no clip of a batch: what earlier batches of other lists left. They stay.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::Path;

use super::super::paths::is_same;
use super::place::CLIPS;

/// Returns the names of such folders below the output folder, in order. Only folders on the way to a clip's are read.
pub(crate) fn folders<'a>(out: &Path, names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut clips =
        Clips { folder: &out.join(CLIPS), names: HashMap::new(), above: HashSet::new() };
    for name in names {
        let lower = name.to_lowercase();
        clips.above.extend(lower.match_indices('/').map(|(at, _)| lower[..at].to_owned()));
        clips.names.insert(lower, name);
    }
    let mut left = Vec::new();
    clips.look("", &mut left);
    left.sort();
    left
}

struct Clips<'a> {
    /// The folder of all.
    folder: &'a Path,
    /// The clips, by their names in lowercase.
    names: HashMap<String, &'a str>,
    /// Folders with folders of clips, in lowercase.
    above: HashSet<String>,
}

impl Clips<'_> {
    /// Looks into a folder, given from the folder of all with a `/` behind it.
    fn look(&self, inside: &str, left: &mut Vec<String>) {
        let is_clip = self.names.contains_key(inside.trim_end_matches('/'));
        let entries = fs::read_dir(self.folder.join(inside)).into_iter().flatten().flatten();
        for entry in entries.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir())) {
            let name = format!("{inside}{}", entry.file_name().to_string_lossy());
            let is_above = self.above.contains(&name.to_lowercase());
            if is_above {
                self.look(&format!("{name}/"), left);
            }
            // A clip may have folders of its own, as of pictures.
            if !(is_above || is_clip || self.is_clip(&name)) {
                left.push(name);
            }
        }
    }

    /// Whether a folder is a clip's. Some file systems take names for equal that differ in capitals alone.
    fn is_clip(&self, name: &str) -> bool {
        let clip = self.names.get(&name.to_lowercase());
        let is_one = |clip: &str| is_same(&self.folder.join(clip), &self.folder.join(name));
        clip.is_some_and(|clip| *clip == name || is_one(clip))
    }
}
