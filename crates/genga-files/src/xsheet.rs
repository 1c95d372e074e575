//! The X-sheet (タイムシート) as a printable HTML file, and each page as SVG.

use genga::error::Error;
use genga::motion::Clip;
use genga::sheet::Sheet;
use genga_plot::{XSheet, escaped};

/// The files of an X-sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XSheetFiles {
    /// All pages in one self-contained file, which needs no network.
    pub html: String,
    /// One SVG per page.
    pub pages: Vec<String>,
}

/// With margins of 10 mm, A4 and B4 have the proportions of a page. On shorter paper such as Letter, the page height is
/// limited to that of the paper. CSS leaves the paper size to the printer.
const STYLE: &str = "
@page { size: portrait; margin: 10mm }
html { background: #d9dedb }
body { margin: 0 }
section { background: #fff; max-width: 1000px; margin: 20px auto; padding: 28px; box-shadow: 0 1px 6px #0003 }
svg { display: block; width: 100%; height: auto }
@media print {
  html { background: none }
  section { max-width: none; margin: 0; padding: 0; box-shadow: none; break-after: page; break-inside: avoid }
  section:last-child { break-after: auto }
  svg { max-height: calc(100vh - 1px) }
}
";

/// Draws the X-sheet of a cut.
///
/// # Errors
/// [`Error::Sheet`] as [`Sheet::check`].
pub fn xsheet(
    settings: &XSheet,
    cut: &str,
    clip: &Clip,
    sheet: &Sheet,
) -> Result<XSheetFiles, Error> {
    let pages = settings.draw(cut, clip, sheet)?;
    let sections: String =
        pages.iter().map(|page| format!("<section>\n{}\n</section>\n", page.trim_end())).collect();
    let html = format!(
        "<!DOCTYPE html>\n<html lang=\"ja\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <title>{} タイムシート X-sheet</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n{sections}</body>\n</html>\n",
        escaped(cut)
    );
    Ok(XSheetFiles { html, pages })
}

#[cfg(test)]
mod tests {
    use super::*;
    use genga::motion::bvh;

    #[test]
    fn the_page_needs_nothing_but_itself_and_names_cannot_break_it() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/kick.bvh");
        let clip = bvh::read(&std::fs::read(path).unwrap()).unwrap().clip;
        let sheet = Sheet::on_ones(clip.clock(24.0), 200);
        let made = xsheet(&XSheet::default(), "<b>&カット", &clip, &sheet).unwrap();
        assert_eq!(made.html.matches("<section>").count(), made.pages.len());
        assert!(made.pages.iter().all(|page| made.html.contains(page.trim_end())));
        for outside in ["<script", "<link", "<img", "src=", "href=", "@import", "url("] {
            assert!(!made.html.contains(outside), "{outside}");
        }
        assert!(made.html.contains("<title>&lt;b&gt;&amp;カット タイムシート X-sheet</title>"));
        assert!(!made.html.contains("<b>"));
    }
}
