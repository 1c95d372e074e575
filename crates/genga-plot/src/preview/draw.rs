//! Draws the moving preview: as a GIF, or koma by koma for a film.

use std::io::Write;

use super::movie::Movie;
use super::palette::Palette;
use super::scene::{Cast, Scene};
use super::{Preview, ahead};
use crate::figure::Figure;
use crate::pixels::Pixels;
use crate::side_by_side::{SideBySide, longest};
use genga::error::Error;

impl Preview {
    /// Draws what stands side by side as a GIF, and returns the number of koma shown; `cut` is the name printed on
    /// it.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`Preview::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and
    /// sheet have nothing to show, or if `file` cannot be written.
    pub fn draw(
        &self,
        cut: &str,
        shown: &SideBySide<'_>,
        file: impl Write,
    ) -> Result<usize, Error> {
        self.validate()?;
        let palette = Palette::new();
        let mut movie = Movie::begin(file, (self.width, self.height), &palette)?;
        let rate = shown.koma_rate();
        let koma = self.each(cut, shown, self.most, |at, pixels| {
            movie.show(palette.indices(pixels.colors()), at, rate)
        })?;
        movie.finish(koma, rate)?;
        Ok(koma)
    }

    /// Passes the picture of each koma to `show`, and returns their number. A picture is red, green, blue and 255
    /// for each pixel, row after row.
    ///
    /// # Errors
    /// As [`Preview::draw`], and any error of `show`.
    pub fn play(
        &self,
        cut: &str,
        shown: &SideBySide<'_>,
        mut show: impl FnMut(&[u8]) -> Result<(), Error>,
    ) -> Result<usize, Error> {
        self.validate()?;
        self.each(cut, shown, usize::MAX, |_, pixels| show(pixels.bytes()))
    }

    /// Passes the picture of each koma, `most` at most, to `show`, and returns their number.
    fn each(
        &self,
        cut: &str,
        shown: &SideBySide<'_>,
        most: usize,
        show: impl FnMut(usize, &Pixels) -> Result<(), Error>,
    ) -> Result<usize, Error> {
        let played = shown.played_out()?;
        let reels = played.iter().map(|played| played.reel()).collect::<Result<Vec<_>, _>>()?;
        let figure = Figure::new(reels[0].composite.clip(), self.body);
        let koma = longest(&reels).min(most);
        let scene = Scene::new(self, (cut, shown), (&reels, &figure), koma)?;
        ahead::play(&scene, Cast::new(shown, &reels, &figure), show)?;
        Ok(koma)
    }
}
