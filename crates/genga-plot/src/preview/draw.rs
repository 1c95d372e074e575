//! Draws the moving preview: as a GIF, or koma by koma for a film.

use std::io::Write;

use super::movie::Movie;
use super::palette::Palette;
use super::scene::{Cast, Scene};
use super::{Preview, ahead};
use crate::drawings::composed;
use crate::figure::Figure;
use crate::pixels::Pixels;
use genga::error::Error;
use genga::motion::{Clip, played_out};
use genga::sheet::Sheet;

impl Preview {
    /// Draws a sheet beside its source as a GIF, and returns the number of koma shown; `cut` is the name
    /// printed on it.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`Preview::validate`]; [`Error::Sheet`] or [`Error::Picture`] if clip and
    /// sheet have nothing to show, or if `file` cannot be written.
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

    /// Passes the picture of each koma of the whole sheet to `show`, and returns their number. A picture is
    /// red, green, blue and 255 for each pixel, row after row.
    ///
    /// # Errors
    /// As [`Preview::draw`], and any error of `show`.
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

    /// Passes the picture of each koma of the cut, `most` at most, to `show`, and returns their number.
    fn each(
        &self,
        cut: &str,
        (clip, sheet): (&Clip, &Sheet),
        most: usize,
        show: impl FnMut(usize, &Pixels) -> Result<(), Error>,
    ) -> Result<usize, Error> {
        // The rounds of a loop are at other places and show the same drawings.
        let named = composed(clip, sheet)?.layer().clone();
        let (numbers, on_screen) = (named.numbers(), named.koma().take(most));
        let (clip, sheet) = played_out(clip, sheet);
        let (clip, sheet) = (&*clip, &*sheet);
        let composite = composed(clip, sheet)?;
        let koma = (sheet.blank.before + composite.layer().length() + sheet.blank.after).min(most);
        let figure = Figure::new(clip, self.body);
        let scene = Scene::new(self, cut, (&composite, &figure), sheet, koma)?;
        let numbers = on_screen.map(|drawing| numbers[drawing].clone());
        let cast = Cast::new((&composite, &figure), sheet, numbers);
        ahead::play(&scene, cast, show)?;
        Ok(koma)
    }
}
