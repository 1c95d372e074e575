//! Loads the fonts of the system, for words in pictures other than SVG.

use std::sync::{Arc, OnceLock};

use resvg::usvg::fontdb::{Database, Family, ID, Query};
use ttf_parser::Face;

use genga::error::Warning;

/// Fonts to use as `sans-serif`, best first: fonts with Japanese letters, then common plain ones.
const PLAIN: [&str; 13] = [
    "Noto Sans CJK JP",
    "Noto Sans JP",
    "Hiragino Sans",
    "Yu Gothic",
    "Meiryo",
    "IPAexGothic",
    "Noto Sans",
    "DejaVu Sans",
    "Liberation Sans",
    "Arial",
    "Helvetica",
    "Segoe UI",
    "FreeSans",
];

/// A letter of each script that pictures are written in. A font that has it has the others.
const LATIN: char = 'a';
const JAPANESE: char = '原';

/// Where fonts come from.
const WAY_OUT: &str = "install one (Debian: apt install fonts-noto-cjk; macOS and Windows: Noto Sans CJK JP from \
    Google Fonts), or take the SVG, whose letters its viewer writes";

/// Returns a warning if words of pictures in pixels and of PDF cannot be written with the fonts of this machine.
pub fn font_note() -> Option<Warning> {
    note(&fonts())
}

fn note(fonts: &Database) -> Option<Warning> {
    let what = match (has_letter(fonts, LATIN), has_letter(fonts, JAPANESE)) {
        (true, true) => return None,
        (true, false) => "no font of this machine has Japanese letters: their words are missing",
        (false, _) => "this machine has no fonts: words are missing",
    };
    let message = format!("{what} in pictures in pixels and PDF; {WAY_OUT}");
    Some(Warning::new("W_NO_FONT", message))
}

/// Whether a font has a letter. The one that pictures ask for is looked at first.
fn has_letter(fonts: &Database, letter: char) -> bool {
    let asked = fonts.query(&Query { families: &[Family::SansSerif], ..Query::default() });
    let has = |id: ID| {
        let face = |data: &[u8], index| Face::parse(data, index).ok()?.glyph_index(letter);
        fonts.with_face_data(id, face).flatten().is_some()
    };
    asked.into_iter().chain(fonts.faces().map(|face| face.id)).any(has)
}

/// Returns the system's fonts. They are read only once, since that takes a while.
pub(super) fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    FONTS.get_or_init(|| Arc::new(read_fonts())).clone()
}

fn read_fonts() -> Database {
    let mut fonts = Database::new();
    fonts.load_system_fonts();
    let there = |family: &&str| {
        fonts.query(&Query { families: &[Family::Name(family)], ..Query::default() }).is_some()
    };
    let known = PLAIN.iter().find(|family| there(family)).map(|family| (*family).to_owned());
    let any = || Some(fonts.faces().next()?.families.first()?.0.clone());
    if let Some(family) = known.or_else(any) {
        fonts.set_sans_serif_family(family.clone());
        // The rasteriser falls back to the serif family.
        fonts.set_serif_family(family);
    }
    fonts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_without_fonts_is_told_what_is_missing_and_what_to_install() {
        let note = note(&Database::new()).unwrap().to_string();
        assert!(note.contains("no fonts") && note.contains("fonts-noto-cjk"), "{note}");
    }

    #[test]
    fn a_machine_whose_fonts_have_all_letters_is_told_nothing() {
        let fonts = fonts();
        let (latin, japanese) = (has_letter(&fonts, LATIN), has_letter(&fonts, JAPANESE));
        assert_eq!(note(&fonts).is_none(), latin && japanese);
        assert!(!has_letter(&fonts, '\u{10ffff}'), "no font has a letter that is none");
    }
}
