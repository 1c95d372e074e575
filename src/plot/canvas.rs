//! A sheet of paper in px with fractions: the few strokes that the pictures are made of.

use plotters::backend::SVGBackend;
use plotters::prelude::DrawingBackend;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontDesc, FontFamily, FontStyle, RGBColor, ShapeStyle, TextStyle};

use crate::error::Error;
use crate::plot::style;

/// Length of a dash, and of the gap after it, in px.
const DASH: f64 = 5.0;

/// Units of the drawing library in one px. It counts in whole units, too coarse for thin lines.
const FINE: f64 = 8.0;

/// Where the text stands against its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Center,
    Right,
}

/// How a text looks.
#[derive(Debug, Clone, Copy)]
pub(super) struct Type {
    pub(super) size: f64,
    pub(super) color: RGBColor,
    pub(super) bold: bool,
    pub(super) align: Align,
}

impl Type {
    /// Plain dark words.
    pub(super) fn new(size: f64) -> Self {
        Self { size, color: style::INK, bold: false, align: Align::Left }
    }

    pub(super) fn color(self, color: RGBColor) -> Self {
        Self { color, ..self }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn align(self, align: Align) -> Self {
        Self { align, ..self }
    }
}

/// A point in px, from the upper left corner.
pub(super) type Point = (f64, f64);

/// The paper while it is being drawn on.
pub(super) struct Canvas<'a> {
    backend: SVGBackend<'a>,
}

/// Draws a picture of that size in px and gives its SVG.
///
/// # Errors
/// What `draw` says, or [`Error::Picture`] from the drawing library.
pub(super) fn paint(
    (width, height): (u32, u32),
    draw: impl FnOnce(&mut Canvas<'_>) -> Result<(), Error>,
) -> Result<String, Error> {
    let mut svg = String::new();
    let units = (width * FINE as u32, height * FINE as u32);
    let mut canvas = Canvas { backend: SVGBackend::with_string(&mut svg, units) };
    canvas.rect((0.0, 0.0), (f64::from(width), f64::from(height)), style::PAPER)?;
    draw(&mut canvas)?;
    done(canvas.backend.present())?;
    drop(canvas);
    // The viewBox keeps the units; the size is the one in px.
    let of_size = |(width, height): (u32, u32)| format!("width=\"{width}\" height=\"{height}\"");
    let size = of_size(units);
    if let Some(at) = svg.find(&size) {
        svg.replace_range(at..at + size.len(), &of_size((width, height)));
    }
    // Opaque is what a stroke is anyhow. Quotes in words are escaped, so no word can hold this.
    Ok(without(svg, " opacity=\"1\""))
}

/// A text with every occurrence of a word taken out, in its own memory: pictures of long clips are
/// large.
fn without(text: String, word: &str) -> String {
    let mut bytes = text.into_bytes();
    let (mut read, mut kept) = (0, 0);
    while read < bytes.len() {
        if bytes[read..].starts_with(word.as_bytes()) {
            read += word.len();
        } else {
            bytes[kept] = bytes[read];
            (read, kept) = (read + 1, kept + 1);
        }
    }
    bytes.truncate(kept);
    String::from_utf8(bytes).expect("whole words were taken out of a text")
}

impl Canvas<'_> {
    pub(super) fn line(
        &mut self,
        from: Point,
        to: Point,
        color: RGBColor,
        width: f64,
    ) -> Result<(), Error> {
        done(self.backend.draw_line(units(from), units(to), &stroke(color, width)))
    }

    /// A dashed line from the top down.
    pub(super) fn dashes(
        &mut self,
        (x, top): Point,
        bottom: f64,
        color: RGBColor,
        width: f64,
    ) -> Result<(), Error> {
        let mut y = top;
        while y < bottom {
            self.line((x, y), (x, (y + DASH).min(bottom)), color, width)?;
            y += 2.0 * DASH;
        }
        Ok(())
    }

    pub(super) fn path(
        &mut self,
        points: &[Point],
        color: RGBColor,
        width: f64,
    ) -> Result<(), Error> {
        let points = points.iter().map(|point| units(*point));
        done(self.backend.draw_path(points, &stroke(color, width)))
    }

    pub(super) fn area(&mut self, points: &[Point], color: RGBColor) -> Result<(), Error> {
        let points = points.iter().map(|point| units(*point));
        done(self.backend.fill_polygon(points, &color.filled()))
    }

    /// A filled rectangle between two corners.
    pub(super) fn rect(&mut self, from: Point, to: Point, color: RGBColor) -> Result<(), Error> {
        done(self.backend.draw_rect(units(from), units(to), &color.filled(), true))
    }

    pub(super) fn disc(
        &mut self,
        center: Point,
        radius: f64,
        color: RGBColor,
    ) -> Result<(), Error> {
        done(self.backend.draw_circle(units(center), length(radius), &color.filled(), true))
    }

    /// A circle, white inside.
    pub(super) fn ring(
        &mut self,
        center: Point,
        radius: f64,
        color: RGBColor,
        width: f64,
    ) -> Result<(), Error> {
        self.disc(center, radius, style::PAPER)?;
        let stroke = stroke(color, width);
        done(self.backend.draw_circle(units(center), length(radius), &stroke, false))
    }

    /// A triangle standing on its base.
    pub(super) fn triangle(
        &mut self,
        (x, y): Point,
        radius: f64,
        color: RGBColor,
    ) -> Result<(), Error> {
        let (half, low) = (0.95 * radius, 0.65 * radius);
        self.area(&[(x, y - radius), (x + half, y + low), (x - half, y + low)], color)
    }

    /// An ×.
    pub(super) fn cross(
        &mut self,
        (x, y): Point,
        radius: f64,
        color: RGBColor,
        width: f64,
    ) -> Result<(), Error> {
        self.line((x - radius, y - radius), (x + radius, y + radius), color, width)?;
        self.line((x - radius, y + radius), (x + radius, y - radius), color, width)
    }

    /// A text whose base line goes through the point. Control characters become spaces.
    pub(super) fn text(&mut self, text: &str, (x, base): Point, look: Type) -> Result<(), Error> {
        let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let h_pos = match look.align {
            Align::Left => HPos::Left,
            Align::Center => HPos::Center,
            Align::Right => HPos::Right,
        };
        let weight = if look.bold { FontStyle::Bold } else { FontStyle::Normal };
        // The library divides by 1.24 and goes 0.76 em down from the top to the base line.
        let size = look.size * FINE * 1.24;
        let font = FontDesc::new(FontFamily::Name(style::FONTS), size, weight);
        let text_style = TextStyle::from(font).color(&look.color).pos(Pos::new(h_pos, VPos::Top));
        done(self.backend.draw_text(&text, &text_style, units((x, base - 0.76 * look.size))))
    }

    /// A number in a circle (丸数字). Pinned ones are filled.
    pub(super) fn badge(
        &mut self,
        center: Point,
        number: usize,
        color: RGBColor,
        filled: bool,
    ) -> Result<(), Error> {
        if filled {
            self.disc(center, style::BADGE, color)?;
        } else {
            self.ring(center, style::BADGE - 0.6, color, 1.25)?;
        }
        let size = [11.0, 10.0, 8.0][number.to_string().len().clamp(1, 3) - 1];
        let ink = if filled { style::PAPER } else { color };
        let look = Type::new(size).bold().color(ink).align(Align::Center);
        self.text(&number.to_string(), (center.0, center.1 + 0.37 * size), look)
    }
}

fn stroke(color: RGBColor, width: f64) -> ShapeStyle {
    color.stroke_width(length(width))
}

fn length(px: f64) -> u32 {
    (px * FINE).round().clamp(1.0, 1e6) as u32
}

fn units((x, y): Point) -> (i32, i32) {
    let unit = |px: f64| (px * FINE).round().clamp(-1e9, 1e9) as i32;
    (unit(x), unit(y))
}

fn done(result: Result<(), impl std::fmt::Display>) -> Result<(), Error> {
    result.map_err(|error| style::cannot(error.to_string()))
}
