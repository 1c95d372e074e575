//! The clips that the studio opened last, in a file of the person's own state: a path a line, the newest first.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::io;

/// As many as can be taken in at a glance.
const MOST: usize = 8;

/// Where the list is kept; none where the system names no place for it.
#[derive(Debug, Default)]
pub(super) struct Recent(Option<PathBuf>);

impl Recent {
    /// The list of whoever runs the program.
    pub(super) fn of_person() -> Self {
        let folder = |name| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let state = match cfg!(windows) {
            true => folder("LOCALAPPDATA"),
            false => folder("XDG_STATE_HOME")
                .or_else(|| folder("HOME").map(|home| home.join(".local/state"))),
        };
        Self(state.map(|state| state.join("genga/recent.txt")))
    }

    /// The clips that are still there.
    pub(super) fn clips(&self) -> Vec<PathBuf> {
        let text = self.0.as_ref().and_then(|file| fs::read_to_string(file).ok());
        let text = text.unwrap_or_default();
        text.lines().map(PathBuf::from).filter(|clip| clip.is_file()).take(MOST).collect()
    }

    /// Puts a clip in front.
    pub(super) fn remember(&self, clip: &Path) -> Result<(), Failure> {
        let Some(file) = &self.0 else { return Ok(()) };
        let clip = std::path::absolute(clip).unwrap_or_else(|_| clip.to_owned());
        let others = self.clips().into_iter().filter(|other| *other != clip);
        let clips = [clip.clone()].into_iter().chain(others).take(MOST);
        // A path that is no text, or more than a line, could not be read back.
        let lines = clips.filter_map(|clip| Some(clip.to_str()?.to_owned()));
        let text: String =
            lines.filter(|line| !line.contains('\n')).map(|line| line + "\n").collect();
        if let Some(folder) = file.parent() {
            fs::create_dir_all(folder)
                .map_err(|error| Failure::CouldNot(format!("{}: {error}", folder.display())))?;
        }
        io::write(file, text.as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_comes_first_and_what_is_gone_is_not_offered() {
        let place = tempfile::tempdir().unwrap();
        let clips: Vec<PathBuf> =
            (0..MOST + 2).map(|at| place.path().join(format!("{at}.bvh"))).collect();
        let recent = Recent(Some(place.path().join("state/recent.txt")));
        assert!(recent.clips().is_empty());
        for clip in &clips {
            fs::write(clip, "").unwrap();
            recent.remember(clip).unwrap();
        }
        let newest: Vec<PathBuf> = clips.iter().rev().take(MOST).cloned().collect();
        assert_eq!(recent.clips(), newest);
        recent.remember(&clips[5]).unwrap();
        assert_eq!(recent.clips()[..2], [clips[5].clone(), clips[MOST + 1].clone()]);
        fs::remove_file(&clips[5]).unwrap();
        assert_eq!(recent.clips()[0], clips[MOST + 1]);
        assert!(Recent(None).remember(&clips[0]).is_ok(), "nowhere to remember is no failure");
    }
}
