//! Draws figures straight onto pixels, for pictures made by the hundred: none of them needs an SVG.

use plotters::style::RGBColor;
use resvg::tiny_skia::{
    FillRule, LineCap, LineJoin, Paint, PathBuilder, Pixmap, PixmapPaint, PremultipliedColorU8,
    Rect, Stroke, Transform,
};

use crate::canvas::{Align, Canvas, Inks, Type};
use crate::convert::pixels_from_svg;
use crate::figure::{Drawn, Shape};
use crate::paper_point::Point;
use crate::style;
use genga::error::Error;
use genga::motion::BodySide;

/// A bitmap to draw on.
#[derive(Clone)]
pub(super) struct Pixels {
    map: Pixmap,
}

impl Pixels {
    /// Renders an SVG.
    ///
    /// # Errors
    /// [`Error::Picture`] if it is too large.
    pub(super) fn new(svg: &str) -> Result<Self, Error> {
        Ok(Self { map: pixels_from_svg(svg, 1.0)? })
    }

    /// Returns red, green, blue and opacity of each pixel, row after row.
    pub(super) fn colors(&self) -> &[PremultipliedColorU8] {
        self.map.pixels()
    }

    /// Returns the pixels as bytes.
    pub(super) fn bytes(&self) -> &[u8] {
        self.map.data()
    }

    /// Encodes the bitmap as PNG.
    ///
    /// # Errors
    /// [`Error::Picture`] if memory runs out.
    pub(super) fn png(&self) -> Result<Vec<u8>, Error> {
        self.map.encode_png().map_err(style::failed)
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

/// The ten digits, drawn once with the system's fonts, to write numbers on pixels.
pub(super) struct Digits {
    digits: Vec<Pixmap>,
    /// Width of a digit, in px.
    wide: f64,
    /// Distance from the top to the base line, in px.
    base: f64,
}

impl Digits {
    /// Draws the digits in a size and a colour.
    ///
    /// # Errors
    /// [`Error::Picture`] if memory runs out.
    pub(super) fn new(size: f64, color: RGBColor) -> Result<Self, Error> {
        let wide = (0.62 * size).ceil();
        let base = size.ceil();
        let digit = |digit: u8| {
            let mut canvas = Canvas::clear((wide, base + 2.0));
            let look = Type::new(size).bold().color(color).align(Align::Center);
            canvas.text(&digit.to_string(), (0.5 * wide, base), look);
            pixels_from_svg(&canvas.finish(), 1.0)
        };
        Ok(Self { digits: (0..10).map(digit).collect::<Result<_, _>>()?, wide, base })
    }

    /// Writes a number that ends at a point on its base line.
    pub(super) fn write(&self, pixels: &mut Pixels, number: usize, (x, base): Point) {
        let mut x = x.round();
        for digit in number.to_string().bytes().rev() {
            x -= self.wide;
            let at = (x as i32, (base - self.base).round() as i32);
            let digit = self.digits[usize::from(digit - b'0')].as_ref();
            let paint = PixmapPaint::default();
            pixels.map.draw_pixmap(at.0, at.1, digit, &paint, Transform::identity(), None);
        }
    }
}
