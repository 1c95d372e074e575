//! Converts SVG to PNG and PDF, with the fonts of the system.

mod fonts;
#[cfg(feature = "pdf")]
mod pdf;

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use crate::style::{cannot, failed};
pub use fonts::font_note;
use genga::error::Error;
#[cfg(feature = "pdf")]
pub use pdf::pdf_from_svg;

/// Maximum length of a side in px: a larger picture would take gigabytes.
const MOST: f32 = 32_000.0;

/// Renders the picture as PNG, with `scale` px for one px of the SVG.
///
/// Words use the fonts of the system; `sans-serif` is the first one found with Japanese letters. On a machine
/// without any font the words are left out: [`font_note`] says so.
///
/// # Errors
/// [`Error::Setting`] if the scale is not above 0; [`Error::Picture`] if the text is not SVG, or if the
/// picture has no px or more than 32000 on a side.
pub fn png_from_svg(svg: &str, scale: f32) -> Result<Vec<u8>, Error> {
    pixels_from_svg(svg, scale)?.encode_png().map_err(failed)
}

/// Renders the picture as pixels.
///
/// # Errors
/// As [`png_from_svg`].
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
