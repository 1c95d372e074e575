//! What is handed over, a clip, its sheet and what they are called; and to whom.

use crate::deliver::sheet_json::MadeWith;
use crate::error::Error;
use crate::exaggerate::Exaggerate;
use crate::motion::Clip;
use crate::plain::is_hidden;
use crate::sheet::Sheet;

/// Takes the files of a format one at a time: the name, in which `/` makes a folder, and the bytes.
pub type Sink<'a> = dyn FnMut(&str, &[u8]) -> Result<(), Error> + 'a;

/// A cut (カット): everything that a format may be made of.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// Its name, usually that of the clip's file without the ending. Any text: see [`Cut::file`].
    pub name: &'a str,
    /// The name of the clip's file, without folders.
    pub clip_file: &'a str,
    /// The motion that is drawn.
    pub clip: &'a Clip,
    /// The motion as it was read, and how it became the one that is drawn; none where it is that one.
    pub exaggerated: Option<(&'a Clip, &'a Exaggerate)>,
    /// The sheet, of any number of layers; a drawing may be on screen several times or not at all.
    pub sheet: &'a Sheet,
    /// The sheet before anything was left out, where it is known.
    pub spaced: Option<&'a Sheet>,
    /// Koma from 0 with which the actions after the first begin; none where they are not known.
    pub splits: &'a [usize],
    /// What the sheet was made with, where it is known.
    pub made_with: Option<&'a MadeWith>,
}

impl Cut<'_> {
    /// A file name for this cut: see [`Cut::file_of`].
    pub fn file(&self, pattern: &str) -> String {
        Self::file_of(self.name, pattern)
    }

    /// A file name for the cut of a name, which stands in place of `CUT`, with `_` for every letter that a
    /// file name cannot have everywhere. A cut without a name is called `cut`.
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
            stem if is_device(stem) => format!("{stem}_{}", &name[stem.len()..]),
            _ => name,
        };
        pattern.replace("CUT", &name)
    }
}

/// Whether Windows has a device of that name, and so no file of that stem.
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
