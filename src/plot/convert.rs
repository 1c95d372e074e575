//! PNG and PDF from SVG, with the fonts of the system.

mod fonts;

use krilla::Document;
use krilla::geom::Size;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::error::Error;
use crate::plot::style::{cannot, failed};

/// Px on a side at most: a larger picture would take gigabytes.
const MOST: f32 = 32_000.0;

/// Points of a PDF, 72 an inch, in a px, 96 an inch.
const POINTS: f32 = 0.75;

/// The picture as PNG, `scale` px for one px of the SVG.
///
/// Letters need fonts: those of the system are used, `sans-serif` being the first there is with
/// Japanese letters. On a machine without any font the words are left out.
///
/// # Errors
/// [`Error::Setting`] for a scale that is not above 0; [`Error::Picture`] when the text is no SVG or
/// the picture has no px or more than 32000 on a side.
pub fn png_from_svg(svg: &str, scale: f32) -> Result<Vec<u8>, Error> {
    pixels_from_svg(svg, scale)?.encode_png().map_err(failed)
}

/// The picture as a PDF of one page: lines stay lines, and words can be searched and copied.
///
/// The page is as large as the picture is on paper, 96 px an inch. It has the fonts of [`png_from_svg`] in
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

/// The picture as pixels.
///
/// # Errors
/// Those of [`png_from_svg`].
pub(super) fn pixels_from_svg(svg: &str, scale: f32) -> Result<Pixmap, Error> {
    if !(scale.is_finite() && scale > 0.0) {
        return Err(Error::setting("scale", format!("{scale}; it must be above 0")));
    }
    let tree = tree(svg)?;
    let (width, height) = (tree.size().width() * scale, tree.size().height() * scale);
    if width.max(height) > MOST {
        return Err(cannot(format!(
            "{width} × {height} px; a PNG may have {MOST} on a side, so write the SVG or a smaller scale"
        )));
    }
    let mut pixels = Pixmap::new(width.round() as u32, height.round() as u32)
        .ok_or_else(|| cannot(format!("{width} × {height} px is no picture")))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixels.as_mut());
    Ok(pixels)
}

fn tree(svg: &str) -> Result<Tree, Error> {
    let options = Options { fontdb: fonts::fonts(), ..Options::default() };
    Tree::from_str(svg, &options).map_err(failed)
}
