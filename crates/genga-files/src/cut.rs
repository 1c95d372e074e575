//! The input of every format (clip, sheet and names) and the sink that takes its files.

use crate::sheet_json::MadeWith;
use genga::error::Error;
use genga::exaggerate::Exaggerate;
use genga::motion::Clip;
use genga::sanitize::is_hidden;
use genga::sheet::Sheet;

/// Receives the files of a format one at a time: the name, in which `/` makes a folder, and the bytes.
pub type Sink<'a> = dyn FnMut(&str, &[u8]) -> Result<(), Error> + 'a;

/// A cut (カット): everything a format can be made from.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// Its name, usually that of the clip's file without the extension. Any text is allowed: see [`Cut::file`].
    pub name: &'a str,
    /// The name of the clip's file, without folders.
    pub clip_file: &'a str,
    /// The motion that is drawn.
    pub clip: &'a Clip,
    /// The motion before exaggeration, and its exaggeration; `None` if `clip` is not exaggerated.
    pub exaggerated: Option<(&'a Clip, &'a Exaggerate)>,
    /// The sheet, of any number of layers. A drawing may be on screen several times or not at all.
    pub sheet: &'a Sheet,
    /// The sheet before omission, if known.
    pub spaced: Option<&'a Sheet>,
    /// Koma from 0 at which the actions after the first begin; empty if they are not known.
    pub splits: &'a [usize],
    /// The recipe and corrections of the sheet, if known.
    pub made_with: Option<&'a MadeWith>,
}

impl Cut<'_> {
    /// Makes a file name for this cut: see [`Cut::file_of`].
    pub fn file(&self, pattern: &str) -> String {
        Self::file_of(self.name, pattern)
    }

    /// Makes a file name by putting the cut's name in place of `CUT`. Characters that are not allowed in file names
    /// on every system become `_`, and so do the dots of `.` and `..`, which are folders. A cut without a name is called
    /// `cut`.
    pub fn file_of(cut: &str, pattern: &str) -> String {
        let letter = |letter: char| match letter {
            '/' | '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|' => '_',
            letter if is_hidden(letter) => '_',
            letter => letter,
        };
        let name: String = cut.trim().chars().map(letter).collect();
        let stem = name.split('.').next().unwrap_or_default().trim_end();
        let name = match stem {
            _ if name.is_empty() => "cut".into(),
            _ if name.chars().all(|letter| letter == '.') => "_".repeat(name.len()),
            stem if is_device(stem) => format!("{stem}_{}", &name[stem.len()..]),
            _ => name,
        };
        pattern.replace("CUT", &name)
    }
}

/// Whether a name is a reserved device name on Windows, and so cannot be a file's stem.
fn is_device(stem: &str) -> bool {
    let stem = stem.to_uppercase();
    let port = ["COM", "LPT"].iter().find_map(|port| stem.strip_prefix(port));
    ["CON", "PRN", "AUX", "NUL"].contains(&&stem[..])
        || port.is_some_and(|number| number.len() == 1 && ("1"..="9").contains(&number))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_cut_makes_a_name_of_a_file_on_every_system() {
        for (cut, file) in [
            ("s03_c012", "s03_c012.vmd"),
            ("カット1", "カット1.vmd"),
            ("a:b*c/d\u{7}", "a_b_c_d_.vmd"),
            ("", "cut.vmd"),
            (".", "_.vmd"),
            (" ..", "__.vmd"),
            ("../..", ".._...vmd"),
            (" ", "cut.vmd"),
            ("con", "con_.vmd"),
            ("COM1.take.2", "COM1_.take.2.vmd"),
            ("COM10", "COM10.vmd"),
            ("console", "console.vmd"),
        ] {
            assert_eq!(Cut::file_of(cut, "CUT.vmd"), file, "{cut}");
        }
    }
}
