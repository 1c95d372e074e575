//! Converts SVG to PDF: lines stay lines.

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};

use super::tree;
use crate::style::cannot;
use genga::error::Error;

/// PDF points (72 an inch) per px (96 an inch).
const POINTS: f32 = 0.75;

/// Converts a picture to a PDF of one page. Lines stay lines, and words can be searched and copied.
///
/// The page has the picture's size on paper, at 96 px an inch. It embeds the fonts of
/// [`png_from_svg`](super::png_from_svg), each with only the letters that it needs. It contains no date: same
/// input, same bytes.
///
/// # Errors
/// [`Error::Picture`] if the text is not SVG, or if a font of the system cannot be embedded in a PDF.
pub fn pdf_from_svg(svg: &str) -> Result<Vec<u8>, Error> {
    let tree = tree(svg)?;
    let (width, height) = (POINTS * tree.size().width(), POINTS * tree.size().height());
    let size = Size::from_wh(width, height)
        .ok_or_else(|| cannot(format!("{width} × {height} points is no page")))?;
    let mut document = Document::new();
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    let drawn = surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    drawn.ok_or_else(|| cannot("the picture cannot be drawn into a PDF"))?;
    document.finish().map_err(|error| cannot(format!("no PDF can be made of it: {error:?}")))
}
