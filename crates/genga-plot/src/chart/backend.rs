//! Lets the chart library draw on the canvas.

use std::convert::Infallible;

use plotters::style::RGBColor;
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontStyle,
};

use crate::canvas::{Align, Canvas, Type};
use crate::paper_point::Point;

/// Units per px. The library counts in whole units. A unit is a tenth of a px, the precision that the canvas
/// writes, so nothing is rounded more coarsely than it would be anyway.
const UNITS: f64 = 10.0;

/// Converts a length in px to units.
pub(super) fn units(px: f64) -> u32 {
    (px * UNITS).round().clamp(0.0, 1e6) as u32
}

/// The canvas up to a lower right corner, in units. It draws what charts consist of: lines, filled boxes,
/// words. Marks are drawn on the canvas itself.
pub(crate) struct Tenths<'a> {
    pub(super) canvas: &'a mut Canvas,
    pub(super) size: (u32, u32),
}

type Outcome = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for Tenths<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Outcome {
        Ok(())
    }

    fn present(&mut self) -> Outcome {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Outcome {
        self.canvas.disc(px(at), 0.5, ink(color));
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        a: BackendCoord,
        b: BackendCoord,
        look: &S,
    ) -> Outcome {
        self.canvas.line(px(a), px(b), ink(look.color()), width(look));
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        a: BackendCoord,
        b: BackendCoord,
        look: &S,
        _: bool,
    ) -> Outcome {
        self.canvas.rect(px(a), px(b), ink(look.color()));
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        look: &S,
    ) -> Outcome {
        let points: Vec<Point> = path.into_iter().map(px).collect();
        self.canvas.path(&points, ink(look.color()), width(look));
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        look: &S,
        at: BackendCoord,
    ) -> Outcome {
        let size = look.size() / UNITS;
        let align = match look.anchor().h_pos {
            HPos::Left => Align::Left,
            HPos::Center => Align::Center,
            HPos::Right => Align::Right,
        };
        let down = match look.anchor().v_pos {
            VPos::Top => 0.8,
            VPos::Center => 0.36,
            VPos::Bottom => -0.2,
        };
        let bold = matches!(look.style(), FontStyle::Bold);
        let (x, y) = px(at);
        let look = Type { size, color: ink(look.color()), bold, align };
        self.canvas.text(text, (x, y + down * size), look);
        Ok(())
    }
}

fn px((x, y): BackendCoord) -> Point {
    (f64::from(x) / UNITS, f64::from(y) / UNITS)
}

fn width(look: &impl BackendStyle) -> f64 {
    f64::from(look.stroke_width()) / UNITS
}

fn ink(BackendColor { rgb: (red, green, blue), .. }: BackendColor) -> RGBColor {
    RGBColor(red, green, blue)
}
