//! The preview as a file.

use std::io::Write;

use super::Preview;
use super::movie::Movie;
use super::palette::Palette;
use super::scene::Scene;
use crate::error::Error;
use crate::motion::Clip;
use crate::plot::drawings::composed;
use crate::plot::figure::Figure;
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
        let composite = composed(clip, sheet)?;
        let layer = composite.layer();
        let koma = layer.length().min(self.most);
        let palette = Palette::new();
        let figure = Figure::of(clip, self.body);
        let mut scene = Scene::new(self, cut, (&composite, &figure), sheet, koma)?;
        let mut movie = Movie::begin(file, (self.width, self.height), &palette)?;
        for (at, drawing) in layer.koma().take(koma).enumerate() {
            let pixels = scene.draw(at, drawing);
            movie.show(palette.indices(pixels.colors()), at, sheet.clock.koma_rate)?;
        }
        movie.finish(koma, sheet.clock.koma_rate)?;
        Ok(koma)
    }
}
