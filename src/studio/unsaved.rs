//! What is not saved (未保存): kept beside the clip, so that a crash takes nothing with it, and offered again.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use super::desk::Desk;
use super::document::Document;

/// What the files beside a clip are called that keep it: what is worked on, and the other sheet.
const WORKED_ON: &str = ".genga-autosave.toml";
const OTHER: &str = ".genga-autosave-other.toml";
/// The line by which the other sheet is known as the first of the two.
const IS_FIRST: &str = "# sheet A\n";

/// The sheet that is worked on, and the other where there are two.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unsaved {
    pub(super) document: Document,
    pub(super) other: Option<Document>,
    /// Whether the one that is worked on is the second.
    pub(super) is_second: bool,
}

impl Unsaved {
    /// Nothing but what is saved.
    pub(super) fn nothing(saved: &Document) -> Self {
        Self { document: saved.clone(), other: None, is_second: false }
    }

    /// What an earlier session left of a clip; none where all of it was saved. What cannot be read is nothing.
    pub(super) fn read(desk: &dyn Desk, clip: &Path, saved: &Document) -> Option<Self> {
        let kept = |name| read(desk, &beside(clip, name)).ok().flatten();
        let (document, other) = (kept(WORKED_ON), kept(OTHER));
        let text = desk.read(&beside(clip, OTHER)).ok().flatten().unwrap_or_default();
        let is_second = other.is_some() && text.starts_with(IS_FIRST);
        let document = document.unwrap_or_else(|| saved.clone());
        (other.is_some() || document != *saved).then_some(Self { document, other, is_second })
    }

    /// Whether it is of these sheets.
    pub(super) fn is(&self, document: &Document, other: Option<&Document>, second: bool) -> bool {
        self.document == *document && self.other.as_ref() == other && self.is_second == second
    }

    /// Keeps what is not saved. What is needs no second copy.
    pub(super) fn keep(
        &self,
        desk: &dyn Desk,
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
        // The one is kept even where the other cannot be.
        kept(WORKED_ON, worked_on).and(kept(OTHER, other))
    }
}

/// A file beside a clip, of its name.
pub(super) fn beside(clip: &Path, ending: &str) -> PathBuf {
    let mut name = clip.file_stem().map_or_else(OsString::new, OsString::from);
    name.push(ending);
    clip.with_file_name(name)
}

/// The document in a file; none where there is no such file.
pub(super) fn read(desk: &dyn Desk, path: &Path) -> Result<Option<Document>, String> {
    let text = desk.read(path)?;
    let document = text.map(|text| Document::parse(&text)).transpose();
    document.map_err(|error| format!("{}: {error}", path.display()))
}
