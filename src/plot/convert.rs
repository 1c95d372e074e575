//! PNG and PDF from SVG, with the fonts of the system.

mod fonts;
#[cfg(feature = "pdf")]
mod pdf;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::error::Error;
use crate::plot::style::{cannot, failed};
#[cfg(feature = "pdf")]
pub use pdf::pdf_from_svg;

/// Px on a side at most: a larger picture would take gigabytes.
const MOST: f32 = 32_000.0;

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
