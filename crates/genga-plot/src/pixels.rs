//! Draws figures straight onto pixels, for pictures made by the hundred: none of them needs an SVG.

mod digits;
mod letters;

use plotters::style::RGBColor;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, Stroke, Transform,
};
#[cfg(feature = "pictures")]
use tiny_skia::{PremultipliedColorU8, Rect};

use crate::canvas::Inks;
use crate::figure::{Drawn, Shape};
use crate::paper_point::Point;
use crate::style;
pub(super) use digits::Digits;
use genga::error::Error;
use genga::motion::BodySide;

/// A bitmap to draw on.
#[derive(Clone)]
pub(super) struct Pixels {
    map: Pixmap,
}

impl Pixels {
    /// Creates a transparent bitmap of a size in px.
    ///
    /// # Errors
    /// [`Error::Picture`] if it has no pixels.
    pub(super) fn clear((width, height): (u32, u32)) -> Result<Self, Error> {
        let map = Pixmap::new(width, height);
        let map =
            map.ok_or_else(|| style::cannot(format!("{width} × {height} px is no picture")))?;
        Ok(Self { map })
    }

    /// Creates white paper of a size in px.
    ///
    /// # Errors
    /// As [`Pixels::clear`].
    pub(super) fn paper(size: (u32, u32)) -> Result<Self, Error> {
        let mut paper = Self::clear(size)?;
        paper.map.fill(Color::WHITE);
        Ok(paper)
    }

    /// Renders an SVG.
    ///
    /// # Errors
    /// [`Error::Picture`] if it is too large.
    #[cfg(feature = "pictures")]
    pub(super) fn from_svg(svg: &str) -> Result<Self, Error> {
        Ok(Self { map: crate::convert::pixels_from_svg(svg, 1.0)? })
    }

    /// Returns red, green, blue and opacity of each pixel, row after row.
    #[cfg(feature = "pictures")]
    pub(super) fn colors(&self) -> &[PremultipliedColorU8] {
        self.map.pixels()
    }

    /// Returns the pixels as bytes.
    #[cfg(feature = "pictures")]
    pub(super) fn bytes(&self) -> &[u8] {
        self.map.data()
    }

    /// Encodes the bitmap as PNG, quickly: figures are flat colours, which any compression makes small.
    ///
    /// # Errors
    /// [`Error::Picture`] if memory runs out.
    pub(super) fn png(&self) -> Result<Vec<u8>, Error> {
        let mut colors = self.map.data().to_vec();
        for (color, pixel) in colors.chunks_exact_mut(4).zip(self.map.pixels()) {
            // Most pixels are opaque, and their colours are as they are.
            if !pixel.is_opaque() {
                let pixel = pixel.demultiply();
                color.copy_from_slice(&[pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]);
            }
        }
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.map.width(), self.map.height());
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header().map_err(style::failed)?;
        writer.write_image_data(&colors).map_err(style::failed)?;
        writer.finish().map_err(style::failed)?;
        Ok(bytes)
    }

    /// Copies the contents of another bitmap of the same size.
    pub(super) fn copy(&mut self, other: &Self) {
        self.map.data_mut().copy_from_slice(other.map.data());
    }

    pub(super) fn line(&mut self, from: Point, to: Point, color: RGBColor, width: f64) {
        let mut path = PathBuilder::new();
        path.move_to(from.0 as f32, from.1 as f32);
        path.line_to(to.0 as f32, to.1 as f32);
        let stroke = Stroke { width: width as f32, line_cap: LineCap::Round, ..Stroke::default() };
        // A path without length is `None`: only its round end is drawn.
        match path.finish() {
            Some(path) if from != to => {
                self.map.stroke_path(&path, &paint(color), &stroke, Transform::identity(), None);
            }
            _ => self.disc(from, 0.5 * width, color),
        }
    }

    pub(super) fn disc(&mut self, (x, y): Point, radius: f64, color: RGBColor) {
        if let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) {
            let (paint, rule) = (paint(color), FillRule::Winding);
            self.map.fill_path(&path, &paint, rule, Transform::identity(), None);
        }
    }

    /// Draws a circle without a fill.
    pub(super) fn hoop(&mut self, (x, y): Point, radius: f64, color: RGBColor, width: f64) {
        if let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) {
            let stroke = Stroke { width: width as f32, ..Stroke::default() };
            self.map.stroke_path(&path, &paint(color), &stroke, Transform::identity(), None);
        }
    }

    /// Draws the four sides of a rectangle, 1 px wide.
    pub(super) fn frame(&mut self, (left, top): Point, (right, bottom): Point, color: RGBColor) {
        let corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
        for (at, corner) in corners.into_iter().enumerate() {
            self.line(corner, corners[(at + 1) % 4], color, 1.0);
        }
    }

    #[cfg(feature = "pictures")]
    pub(super) fn rect(&mut self, (x, y): Point, (width, height): (f64, f64), color: RGBColor) {
        if let Some(rect) = Rect::from_xywh(x as f32, y as f32, width as f32, height as f32) {
            self.map.fill_rect(rect, &paint(color), Transform::identity(), None);
        }
    }

    pub(super) fn figure(&mut self, drawn: &Drawn, inks: Inks) {
        let ink = inks.color(BodySide::Trunk);
        for shape in &drawn.shapes {
            match shape {
                Shape::Line(stroke) => {
                    self.line(stroke.from, stroke.to, inks.line(stroke.ink), stroke.width);
                }
                Shape::Part { outline, width, side } => {
                    self.part(outline, inks.fill(*side), (inks.color(*side), *width));
                }
                Shape::Ring(center, radius) => {
                    let width = (0.24 * radius).clamp(0.8, 4.0);
                    self.disc(*center, radius + 0.5 * width, ink);
                    self.disc(*center, radius - 0.5 * width, style::PAPER);
                }
                Shape::Dot(dot) => self.disc(*dot, 4.0, ink),
            }
        }
    }

    /// Fills an outline and draws its edge.
    fn part(&mut self, outline: &[Point], fill: RGBColor, (ink, width): (RGBColor, f64)) {
        let mut path = PathBuilder::new();
        let mut points = outline.iter().map(|(x, y)| (*x as f32, *y as f32));
        let Some((x, y)) = points.next() else { return };
        path.move_to(x, y);
        points.for_each(|(x, y)| path.line_to(x, y));
        path.close();
        let Some(path) = path.finish() else { return };
        let stroke =
            Stroke { width: width as f32, line_join: LineJoin::Round, ..Stroke::default() };
        let identity = Transform::identity();
        self.map.fill_path(&path, &paint(fill), FillRule::Winding, identity, None);
        self.map.stroke_path(&path, &paint(ink), &stroke, identity, None);
    }
}

fn paint(color: RGBColor) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(color.0, color.1, color.2, 255);
    paint
}
