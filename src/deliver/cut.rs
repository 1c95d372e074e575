//! What is handed over: a clip, its sheet and what they are called.

use crate::deliver::sheet_json::MadeWith;
use crate::motion::Clip;
use crate::sheet::Sheet;

/// A cut (カット): everything that a format may be made of.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// Its name, usually that of the clip's file without the ending. Any text: see [`Cut::file`].
    pub name: &'a str,
    /// The name of the clip's file, without folders.
    pub clip_file: &'a str,
    /// The motion.
    pub clip: &'a Clip,
    /// The sheet, of any number of layers; a drawing may be on screen several times or not at all.
    pub sheet: &'a Sheet,
    /// The sheet before anything was left out, where it is known.
    pub spaced: Option<&'a Sheet>,
    /// What the sheet was made with, where it is known.
    pub made_with: Option<&'a MadeWith>,
}

impl Cut<'_> {
    /// A file name for this cut: its name in place of `CUT`, with `_` for every letter that a file name
    /// cannot have everywhere.
    pub fn file(&self, pattern: &str) -> String {
        let letter = |letter: char| match letter {
            '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|' => '_',
            letter if letter.is_control() => '_',
            letter => letter,
        };
        pattern.replace("CUT", &self.name.chars().map(letter).collect::<String>())
    }
}
