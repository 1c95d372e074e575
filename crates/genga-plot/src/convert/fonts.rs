//! Loads the fonts of the system, for words in pictures other than SVG.

use std::sync::{Arc, OnceLock};

use resvg::usvg::fontdb::{Database, Family, Query};

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
