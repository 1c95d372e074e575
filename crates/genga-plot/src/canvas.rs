//! Provides the canvas that pictures are drawn on: an SVG that grows stroke by stroke.
//!
//! Drawing cannot fail. NaN becomes 0, coordinates too far away are clamped to what an SVG can hold, and
//! words are escaped.

use std::fmt::{Arguments, Write};

use plotters::style::RGBColor;

use crate::figure::{Drawn, Ink, Shape, Stroke};
use crate::paper_point::Point;
use crate::style;
use genga::motion::BodySide;

/// Alignment of a text to its point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Center,
    Right,
}

/// The look of a text.
#[derive(Debug, Clone, Copy)]
pub(super) struct Type {
    pub(super) size: f64,
    pub(super) color: RGBColor,
    pub(super) bold: bool,
    pub(super) align: Align,
}

impl Type {
    /// Returns the look of plain dark words.
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

/// The colours of a figure's lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Inks {
    /// Left, right and trunk in different colours.
    Sides,
    /// Colours of the sides, mixed with this share of paper, 0 to 1.
    Faded(f64),
    /// All in one colour.
    One(RGBColor),
}

impl Inks {
    pub(super) fn color(self, side: BodySide) -> RGBColor {
        match self {
            Self::Sides => style::side_color(side),
            Self::Faded(paper) => style::mixed(style::side_color(side), style::PAPER, paper),
            Self::One(color) => color,
        }
    }

    /// Returns the colour of a line.
    pub(super) fn line(self, ink: Ink) -> RGBColor {
        match (self, ink) {
            (_, Ink::Side(side)) => self.color(side),
            (Self::Sides, Ink::Guide) => style::INBETWEEN,
            (Self::Faded(paper), Ink::Guide) => style::mixed(style::INBETWEEN, style::PAPER, paper),
            (Self::One(color), Ink::Guide) => color,
        }
    }

    /// Returns the fill of a part: paper with a tint of its side's colour.
    pub(super) fn fill(self, side: BodySide) -> RGBColor {
        match side {
            BodySide::Trunk => style::PAPER,
            side => style::mixed(self.color(side), style::PAPER, 0.86),
        }
    }
}

/// A picture in progress. Lengths are px, written to a tenth.
pub(super) struct Canvas {
    svg: String,
}

impl Canvas {
    /// Creates white paper of a size in px.
    pub(super) fn new((width, height): (f64, f64)) -> Self {
        let (width, height) = (width.ceil(), height.ceil());
        let fonts = escaped(style::FONTS);
        let mut canvas = Self {
            svg: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
                 viewBox=\"0 0 {width} {height}\" font-family=\"{fonts}\" stroke-linejoin=\"round\" \
                 fill=\"none\">\n"
            ),
        };
        canvas.rect((0.0, 0.0), (width, height), style::PAPER);
        canvas
    }

    pub(super) fn finish(mut self) -> String {
        self.svg.push_str("</svg>\n");
        self.svg
    }

    pub(super) fn line(&mut self, from: Point, to: Point, color: RGBColor, width: f64) {
        self.segment(from, to, color, width, "");
    }

    /// Draws a dashed line.
    pub(super) fn dashes(&mut self, from: Point, to: Point, color: RGBColor, width: f64) {
        self.segment(from, to, color, width, " stroke-dasharray=\"5 4\"");
    }

    fn segment(&mut self, from: Point, to: Point, color: RGBColor, width: f64, more: &str) {
        let (x1, y1, x2, y2) = (tenth(from.0), tenth(from.1), tenth(to.0), tenth(to.1));
        let stroke = stroke(color, width);
        self.tag(format_args!(
            "<line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\"{stroke}{more}/>"
        ));
    }

    /// Draws an open line through points.
    pub(super) fn path(&mut self, points: &[Point], color: RGBColor, width: f64) {
        let (points, stroke) = (list(points), stroke(color, width));
        self.tag(format_args!("<polyline points=\"{points}\"{stroke}/>"));
    }

    /// Fills the polygon through points.
    pub(super) fn area(&mut self, points: &[Point], color: RGBColor) {
        let (points, color) = (list(points), hex(color));
        self.tag(format_args!("<polygon points=\"{points}\" fill=\"{color}\"/>"));
    }

    /// Fills the polygon through points, translucently.
    pub(super) fn veil(&mut self, points: &[Point], color: RGBColor) {
        let (points, color) = (list(points), hex(color));
        self.tag(format_args!(
            "<polygon points=\"{points}\" fill=\"{color}\" fill-opacity=\"0.18\"/>"
        ));
    }

    /// Fills the rectangle between two corners.
    pub(super) fn rect(&mut self, from: Point, to: Point, color: RGBColor) {
        let (x, y) = (tenth(from.0), tenth(from.1));
        // Computed from the rounded corners, so that neighbours meet.
        let (width, height) = (tenth(tenth(to.0) - x), tenth(tenth(to.1) - y));
        let color = hex(color);
        self.tag(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{color}\"/>"
        ));
    }

    /// Draws the edge of a card from its upper left corner; `radius` rounds its corners.
    pub(super) fn frame(&mut self, (x, y): Point, size: (f64, f64), color: RGBColor, radius: f64) {
        let (x, y, width, height) = (tenth(x), tenth(y), tenth(size.0), tenth(size.1));
        let (radius, color) = (tenth(radius), hex(color));
        self.tag(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" rx=\"{radius}\" \
             stroke=\"{color}\"/>"
        ));
    }

    pub(super) fn disc(&mut self, center: Point, radius: f64, color: RGBColor) {
        self.circle(center, radius, Some(color), None);
    }

    /// Draws a disc with a white rim, which sets it apart from what lies behind.
    pub(super) fn spot(&mut self, center: Point, radius: f64, color: RGBColor) {
        self.circle(center, radius + 0.5, Some(color), Some((style::PAPER, 1.0)));
    }

    /// Draws a circle, white inside.
    pub(super) fn ring(&mut self, center: Point, radius: f64, color: RGBColor, width: f64) {
        self.circle(center, radius, Some(style::PAPER), Some((color, width)));
    }

    fn circle(
        &mut self,
        (x, y): Point,
        radius: f64,
        fill: Option<RGBColor>,
        edge: Option<(RGBColor, f64)>,
    ) {
        let (x, y, radius) = (tenth(x), tenth(y), tenth(radius));
        let fill = fill.map(|color| format!(" fill=\"{}\"", hex(color))).unwrap_or_default();
        let edge = edge.map(|(color, width)| stroke(color, width)).unwrap_or_default();
        self.tag(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{fill}{edge}/>"));
    }

    /// Draws a triangle standing on its base.
    pub(super) fn triangle(&mut self, (x, y): Point, radius: f64, color: RGBColor) {
        let (half, low) = (0.95 * radius, 0.65 * radius);
        self.area(&[(x, y - radius), (x + half, y + low), (x - half, y + low)], color);
    }

    /// Draws an ×.
    pub(super) fn cross(&mut self, (x, y): Point, radius: f64, color: RGBColor, width: f64) {
        self.line((x - radius, y - radius), (x + radius, y + radius), color, width);
        self.line((x - radius, y + radius), (x + radius, y - radius), color, width);
    }

    /// Draws a text with its base line through the point. Control characters become spaces.
    pub(super) fn text(&mut self, text: &str, (x, base): Point, look: Type) {
        if text.is_empty() {
            return;
        }
        let anchor = match look.align {
            Align::Left => "",
            Align::Center => " text-anchor=\"middle\"",
            Align::Right => " text-anchor=\"end\"",
        };
        let weight = if look.bold { " font-weight=\"bold\"" } else { "" };
        let (x, base, size) = (tenth(x), tenth(base), tenth(look.size));
        let (color, text) = (hex(look.color), escaped(text));
        self.tag(format_args!(
            "<text x=\"{x}\" y=\"{base}\" font-size=\"{size}\" fill=\"{color}\"{anchor}{weight}>{text}</text>"
        ));
    }

    /// Draws a text that runs upwards, its middle at the point.
    pub(super) fn text_upwards(&mut self, text: &str, (x, y): Point, look: Type) {
        let (x, y) = (tenth(x), tenth(y));
        self.tag(format_args!("<g transform=\"rotate(-90 {x} {y})\">"));
        self.text(text, (x, y), Type { align: Align::Center, ..look });
        self.tag(format_args!("</g>"));
    }

    /// Draws a text that runs from top to bottom (縦書き), from the point on, its letters centred on it.
    pub(super) fn text_downwards(&mut self, text: &str, (x, y): Point, look: Type) {
        if text.is_empty() {
            return;
        }
        let (x, y, size) = (tenth(x), tenth(y), tenth(look.size));
        let (color, text) = (hex(look.color), escaped(text));
        self.tag(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{color}\" writing-mode=\"vertical-rl\">{text}</text>"
        ));
    }

    /// Draws the sign of a genga, its number in a circle (丸数字). It is filled for pinned drawings.
    pub(super) fn badge(&mut self, center: Point, number: &str, color: RGBColor, filled: bool) {
        let (fill, ink) = if filled { (color, style::PAPER) } else { (style::PAPER, color) };
        let (reach, radius) = (style::badge_reach(number) - 0.6, style::BADGE - 0.6);
        match number.len() {
            0..=2 => self.circle(center, radius, Some(fill), Some((color, 1.2))),
            _ => self.pill(center, (reach, radius), fill, (color, 1.2)),
        }
        let look = Type::new(style::SMALL).bold().color(ink).align(Align::Center);
        self.text(number, (center.0, center.1 + 0.36 * style::SMALL), look);
    }

    /// Draws a circle that is longer than high, by half its length and half its height.
    fn pill(
        &mut self,
        (x, y): Point,
        (reach, radius): (f64, f64),
        fill: RGBColor,
        (edge, width): (RGBColor, f64),
    ) {
        let (left, top, radius) = (tenth(x - reach), tenth(y - radius), tenth(radius));
        let (width, stroke) = (tenth(2.0 * reach), stroke(edge, width));
        let (high, fill) = (tenth(2.0 * radius), hex(fill));
        self.tag(format_args!(
            "<rect x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{high}\" rx=\"{radius}\" \
             fill=\"{fill}\"{stroke}/>"
        ));
    }

    /// Draws the sign of a curve that is cut off: two strokes across it, with paper between them.
    pub(super) fn cut(&mut self, (x, y): Point) {
        self.line((x - 5.0, y + 2.5), (x + 5.0, y - 2.5), style::PAPER, 4.0);
        for off in [-2.0, 2.0] {
            self.line((x - 5.0, y + 2.5 + off), (x + 5.0, y - 2.5 + off), style::INK, 1.25);
        }
    }

    /// Draws a figure. Consecutive lines of one look become one path.
    pub(super) fn figure(&mut self, drawn: &Drawn, inks: Inks) {
        self.tag(format_args!("<g stroke-linecap=\"round\">"));
        for run in drawn.shapes.chunk_by(is_alike) {
            match &run[0] {
                Shape::Line(stroke) => self.strokes(run, stroke, inks),
                Shape::Part { outline, width, side } => {
                    let (points, fill) = (list(outline), hex(inks.fill(*side)));
                    let stroke = stroke(inks.color(*side), *width);
                    self.tag(format_args!(
                        "<polygon points=\"{points}\" fill=\"{fill}\"{stroke}/>"
                    ));
                }
                Shape::Ring(center, radius) => {
                    let width = (0.24 * radius).clamp(0.8, 4.0);
                    self.ring(*center, *radius, inks.color(BodySide::Trunk), width);
                }
                Shape::Dot(dot) => self.disc(*dot, 4.0, inks.color(BodySide::Trunk)),
            }
        }
        self.tag(format_args!("</g>"));
    }

    /// Draws lines that all look like `one`, as one path.
    fn strokes(&mut self, run: &[Shape], one: &Stroke, inks: Inks) {
        let ways = run.iter().filter_map(|shape| match shape {
            Shape::Line(line) => Some(format!("M{}L{}", pair(line.from, ' '), pair(line.to, ' '))),
            _ => None,
        });
        let (way, stroke) = (ways.collect::<String>(), stroke(inks.line(one.ink), one.width));
        self.tag(format_args!("<path d=\"{way}\"{stroke}/>"));
    }

    fn tag(&mut self, tag: Arguments<'_>) {
        self.svg.write_fmt(tag).expect("a String takes every text");
        self.svg.push('\n');
    }
}

/// Whether two shapes are lines of one look.
fn is_alike(a: &Shape, b: &Shape) -> bool {
    let (Shape::Line(a), Shape::Line(b)) = (a, b) else { return false };
    (a.ink, a.width) == (b.ink, b.width)
}

/// Rounds to a tenth of a px, without a negative zero. NaN becomes 0; values beyond ±1e6 are clamped.
fn tenth(px: f64) -> f64 {
    let px = if px.is_nan() { 0.0 } else { px };
    (px.clamp(-1e6, 1e6) * 10.0).round() / 10.0 + 0.0
}

fn pair((x, y): Point, between: char) -> String {
    format!("{}{between}{}", tenth(x), tenth(y))
}

fn list(points: &[Point]) -> String {
    points.iter().map(|point| pair(*point, ',')).collect::<Vec<_>>().join(" ")
}

fn stroke(color: RGBColor, width: f64) -> String {
    format!(" stroke=\"{}\" stroke-width=\"{}\"", hex(color), tenth(width))
}

pub(super) fn hex(color: RGBColor) -> String {
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}

/// Escapes text for XML and HTML. Control characters become spaces.
pub fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
