//! The X-sheet (タイムシート) as one HTML file that prints, and a page each as SVG.

use crate::error::Error;
use crate::motion::Clip;
use crate::plot::{XSheet, escaped};
use crate::sheet::Sheet;

/// The files of an X-sheet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct XSheetFiles {
    /// All pages in one file, which needs no other and no network.
    pub html: String,
    /// Each page alone, as SVG.
    pub pages: Vec<String>,
}

/// Margins of 10 mm leave A4 and B4 the proportions of a page; on shorter paper, as Letter, a page is as high as
/// the paper. Which it is, the printer knows.
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

/// The X-sheet of a cut.
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
    use crate::motion::bvh;

    #[test]
    fn the_page_needs_nothing_but_itself_and_names_cannot_break_it() {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("data/kick.bvh");
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
