//! Unsaved work (未保存), kept beside the clip in case of a crash, and offered to be recovered.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::document::Document;
use super::host::Host;

/// Endings of the files that keep the current sheet and the other one.
const WORKED_ON: &str = ".genga-autosave.toml";
const OTHER: &str = ".genga-autosave-other.toml";
/// First line of the other sheet's file if that is sheet A.
const IS_FIRST: &str = "# sheet A\n";

/// The current sheet, and sheet A or B beside it if the take has two.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unsaved {
    pub(super) document: Document,
    pub(super) other: Option<Document>,
    /// Whether the current sheet is sheet B.
    pub(super) is_second: bool,
}

impl Unsaved {
    /// State without unsaved work.
    pub(super) fn nothing(saved: &Document) -> Self {
        Self { document: saved.clone(), other: None, is_second: false }
    }

    /// Reads the unsaved work of an earlier session. `None` if everything was saved. Unreadable files are ignored.
    pub(super) fn read(desk: &dyn Host, clip: &Path, saved: &Document) -> Option<Self> {
        let kept = |name| read(desk, &beside(clip, name)).ok().flatten();
        let (document, other) = (kept(WORKED_ON), kept(OTHER));
        let text = desk.read(&beside(clip, OTHER)).ok().flatten().unwrap_or_default();
        let is_second = other.is_some() && text.starts_with(IS_FIRST);
        let document = document.unwrap_or_else(|| saved.clone());
        (other.is_some() || document != *saved).then_some(Self { document, other, is_second })
    }

    /// Whether it consists of these sheets.
    pub(super) fn is(&self, document: &Document, other: Option<&Document>, second: bool) -> bool {
        self.document == *document && self.other.as_ref() == other && self.is_second == second
    }

    /// Writes the sheets that are not saved, and removes the files of those that are.
    pub(super) fn keep(
        &self,
        desk: &dyn Host,
        clip: &Path,
        saved: &Document,
    ) -> Result<(), String> {
        let worked_on = (self.document != *saved).then(|| self.document.text());
        let head = if self.is_second { IS_FIRST } else { "" };
        let other = self.other.as_ref().map(|other| format!("{head}{}", other.text()));
        let kept = |name, text: Option<String>| match text {
            Some(text) => desk.keep(&beside(clip, name), &text),
            None => desk.remove(&beside(clip, name)),
        };
        // The first file is kept even if the second cannot be.
        kept(WORKED_ON, worked_on).and(kept(OTHER, other))
    }
}

/// Path of a file beside a clip, named after it.
pub(super) fn beside(clip: &Path, ending: &str) -> PathBuf {
    let mut name = clip.file_stem().map_or_else(OsString::new, OsString::from);
    name.push(ending);
    clip.with_file_name(name)
}

/// Reads the document in a file. `None` if the file does not exist.
pub(super) fn read(desk: &dyn Host, path: &Path) -> Result<Option<Document>, String> {
    let text = desk.read(path)?;
    let document = text.map(|text| Document::parse(&text)).transpose();
    document.map_err(|error| format!("{}: {error}", path.display()))
}
