//! Numbered images as pixels.

use super::NumberedImages;
use crate::error::Error;
use crate::motion::{Clip, Composite};
use crate::plot::canvas::{Canvas, Inks};
use crate::plot::drawings::{composed, drawn_poses};
use crate::plot::figure::Figure;
use crate::plot::pixels::{Digits, Pixels};
use crate::plot::points::Showing;
use crate::plot::stage::{Bounds, Stage};
use crate::plot::style;
use crate::sheet::Sheet;

/// The share of the picture on each side that figures stay out of: the safe area's edge.
const SAFE: f64 = 0.05;

impl NumberedImages {
    /// Draws an image a drawing and gives each with its file name to `take`, one after the other.
    ///
    /// # Errors
    /// [`Error::Setting`] as [`NumberedImages::validate`]; [`Error::Sheet`] or [`Error::Picture`] when clip and sheet have
    /// nothing to show; what `take` says.
    pub fn draw<E: From<Error>>(
        &self,
        clip: &Clip,
        sheet: &Sheet,
        mut take: impl FnMut(&str, Vec<u8>) -> Result<(), E>,
    ) -> Result<(), E> {
        self.validate()?;
        let composite = composed(clip, sheet)?;
        let figure = Figure::of(clip, self.body);
        let stage = self.stage(&composite, &figure);
        let backdrop = Pixels::of(&self.backdrop(&stage))?;
        let digits = Digits::new(0.03 * f64::from(self.height).max(300.0), style::FAINT)?;
        let mut pixels = backdrop.clone();
        let mut showing = Showing::of(&composite, figure.marks());
        let name: String = composite.layer().name.chars().map(plain).collect();
        for (at, koma) in composite.first_koma().into_iter().enumerate() {
            pixels.copy(&backdrop);
            pixels.figure(&stage.draw(&showing.points(at, koma)), Inks::Sides);
            if self.marks {
                let (x, y) = self.inside(0.99 - SAFE);
                digits.write(&mut pixels, at + 1, (x, y));
            }
            take(&format!("{name}_{:04}.png", at + 1), pixels.png()?)?;
        }
        Ok(())
    }

    /// A point as a share of the picture from its upper left corner.
    fn inside(&self, share: f64) -> (f64, f64) {
        (share * f64::from(self.width), share * f64::from(self.height))
    }

    fn stage(&self, composite: &Composite<'_>, figure: &Figure) -> Stage {
        let clip = composite.clip();
        let poses = drawn_poses(composite, figure.marks(), composite.layer().drawings.len());
        let view = self.camera.view(clip, &poses);
        let bounds = Bounds::of(figure, &view, &poses);
        let (wide, high) = self.inside(1.0 - 4.0 * SAFE);
        let (width, height) = self.inside(1.0);
        let floor = (1.0 - 2.0 * SAFE) * height;
        Stage::filling(figure.clone(), view, &bounds, (0.5 * width, floor), (wide, high))
    }

    /// What all images have behind the figure.
    fn backdrop(&self, stage: &Stage) -> String {
        let (width, height) = self.inside(1.0);
        let mut canvas = if self.transparent {
            Canvas::clear((width, height))
        } else {
            Canvas::new((width, height))
        };
        if !self.marks {
            return canvas.finish();
        }
        let (x, y) = self.inside(SAFE);
        canvas.frame((x, y), (width - 2.0 * x, height - 2.0 * y), style::GRID, 0.0);
        canvas.line((x, stage.at.1), (width - x, stage.at.1), style::GRID, 1.25);
        let arm = 0.02 * height;
        for x in [1.5 * arm, width - 1.5 * arm] {
            for y in [1.5 * arm, height - 1.5 * arm] {
                canvas.line((x - arm, y), (x + arm, y), style::INK, 1.0);
                canvas.line((x, y - arm), (x, y + arm), style::INK, 1.0);
                canvas.hoop((x, y), 0.5 * arm, style::INK, 1.0);
            }
        }
        canvas.finish()
    }
}

/// A letter as a file name can have it on every system.
fn plain(letter: char) -> char {
    let kept = letter.is_alphanumeric() || letter == '-';
    if kept { letter } else { '_' }
}
