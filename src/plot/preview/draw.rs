//! The preview as it moves: as a GIF, or koma by koma for what makes a film of it.

use std::io::Write;

use super::Preview;
use super::movie::Movie;
use super::palette::Palette;
use super::scene::Scene;
use crate::error::Error;
use crate::motion::Clip;
use crate::plot::drawings::composed;
use crate::plot::figure::Figure;
use crate::plot::pixels::Pixels;
use crate::sheet::Sheet;

impl Preview {
    /// Draws a sheet beside its source, one picture after the other, and gives how many koma it shows;
    /// `cut` is the name on it.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`Preview::validate`]; [`Error::Sheet`] or [`Error::Picture`] when clip and sheet have nothing
    /// to show, or `file` cannot be written.
    pub fn draw(
        &self,
        cut: &str,
        clip: &Clip,
        sheet: &Sheet,
        file: impl Write,
    ) -> Result<usize, Error> {
        self.validate()?;
        let palette = Palette::new();
        let mut movie = Movie::begin(file, (self.width, self.height), &palette)?;
        let koma = self.each(cut, (clip, sheet), self.most, |at, pixels| {
            movie.show(palette.indices(pixels.colors()), at, sheet.clock.koma_rate)
        })?;
        movie.finish(koma, sheet.clock.koma_rate)?;
        Ok(koma)
    }

    /// Shows the same pictures one after the other, one a koma and of the whole sheet: red, green, blue and 255 of
    /// each pixel, row after row. Gives how many koma it showed.
    ///
    /// # Errors
    /// Those of [`Preview::draw`], and what `show` says.
    pub fn play(
        &self,
        cut: &str,
        clip: &Clip,
        sheet: &Sheet,
        mut show: impl FnMut(&[u8]) -> Result<(), Error>,
    ) -> Result<usize, Error> {
        self.validate()?;
        self.each(cut, (clip, sheet), usize::MAX, |_, pixels| show(pixels.bytes()))
    }

    /// The picture of each koma, `most` at most, and how many there are.
    fn each(
        &self,
        cut: &str,
        (clip, sheet): (&Clip, &Sheet),
        most: usize,
        mut show: impl FnMut(usize, &Pixels) -> Result<(), Error>,
    ) -> Result<usize, Error> {
        let composite = composed(clip, sheet)?;
        let layer = composite.layer();
        let koma = layer.length().min(most);
        let figure = Figure::of(clip, self.body);
        let mut scene = Scene::new(self, cut, (&composite, &figure), sheet, koma)?;
        for (at, drawing) in layer.koma().take(koma).enumerate() {
            show(at, scene.draw(at, drawing))?;
        }
        Ok(koma)
    }
}
