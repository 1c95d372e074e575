//! PDF: lines stay lines.

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};

use super::tree;
use crate::error::Error;
use crate::plot::style::cannot;

/// Points of a PDF, 72 an inch, in a px, 96 an inch.
const POINTS: f32 = 0.75;

/// The picture as a PDF of one page: lines stay lines, and words can be searched and copied.
///
/// The page is as large as the picture is on paper, 96 px an inch. It has the fonts of [`png_from_svg`](super::png_from_svg) in
/// it, of each no more than the letters that it needs. There is no date in it: same input, same bytes.
///
/// # Errors
/// [`Error::Picture`] when the text is no SVG, or a font of the system cannot be put into a PDF.
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
