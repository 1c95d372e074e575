//! Films of what stands side by side (見比べ): a page, a GIF, a video.

use crate::Settings;
use genga::error::{Error, Warning};
use genga::sheet::Layer;
use genga_plot::{FlipBook, SideBySide};

/// A format that is one file, of a sheet beside its source or of two versions of a take.
#[derive(Clone, Copy)]
pub(crate) struct Film {
    /// Makes the file; the text is the name of the cut.
    pub(crate) make: fn(&str, &SideBySide<'_>, &Settings) -> Result<Vec<u8>, Error>,
    /// Collects warnings about it.
    pub(crate) notes: fn(&SideBySide<'_>, &Settings) -> Result<Vec<Warning>, Error>,
}

/// The page that plays and steps.
pub(crate) const FLIPBOOK: Film = Film {
    make: |cut, shown, settings| {
        let page = FlipBook { body: settings.figures.body, ..settings.flipbook.clone() };
        Ok(page.draw(cut, shown)?.into_bytes())
    },
    notes: |shown, settings| {
        let koma = match shown {
            // The page has no blank koma of a single sheet.
            SideBySide::Source(_, sheet) => sheet.layers.first().map_or(0, Layer::length),
            SideBySide::Versions(_) => shown.koma(),
        };
        Ok(shortened("flipbook", settings.flipbook.most, koma))
    },
};

/// The animated picture. Frames are compressed as they are drawn, so only the compressed file is held in memory.
#[cfg(feature = "pictures")]
pub(crate) const PREVIEW: Film = Film {
    make: |cut, shown, settings| {
        let mut bytes = Vec::new();
        genga_plot::Preview { body: settings.figures.body, ..settings.preview.clone() }
            .draw(cut, shown, &mut bytes)?;
        Ok(bytes)
    },
    notes: |shown, settings| {
        let mut notes = shortened("preview", settings.preview.most, shown.koma());
        notes.extend(genga_plot::font_note());
        Ok(notes)
    },
};

/// The video.
#[cfg(feature = "video")]
pub(crate) const MP4: Film = Film {
    make: |cut, shown, settings| settings.mp4.encode(settings.figures.body, cut, shown),
    notes: |_, settings| settings.mp4.notes(),
};

/// Warns if a picture shows only the beginning of a long sheet of `koma` koma.
pub(crate) fn shortened(name: &str, most: usize, koma: usize) -> Vec<Warning> {
    let message =
        format!("{name} shows the first {most} of {koma} koma; {name}.most says how many");
    if koma > most { vec![Warning::new("W_SHORTENED", message)] } else { vec![] }
}
