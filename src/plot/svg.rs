//! SVG of pictures with many figures: a figure is a few paths, where the drawing library behind
//! [`super::canvas`] writes a line and a disc a bone, ten times as long.

use std::fmt::Write;

use plotters::style::RGBColor;

use crate::motion::BodySide;
use crate::plot::canvas::{Align, Point, Type};
use crate::plot::figure::Drawn;
use crate::plot::style;

/// A picture as it grows. Coordinates are px from the upper left corner, written to a tenth.
pub(super) struct Svg {
    text: String,
}

/// How the lines of a figure are coloured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Inks {
    /// Left, right and trunk apart.
    Sides,
    /// The same, mixed with so much paper, 0 to 1.
    Faded(f64),
    /// All in one colour.
    One(RGBColor),
}

impl Inks {
    pub(super) fn of(self, side: BodySide) -> RGBColor {
        match self {
            Self::Sides => side.color(),
            Self::Faded(paper) => style::mixed(side.color(), style::PAPER, paper),
            Self::One(color) => color,
        }
    }
}

impl Svg {
    /// White paper of a size in px.
    pub(super) fn new((width, height): (f64, f64)) -> Self {
        let mut svg = Self::clear((width, height));
        svg.rect((0.0, 0.0), (width, height), Some(style::PAPER), None, 0.0);
        svg
    }

    /// Nothing at all, of a size in px.
    pub(super) fn clear((width, height): (f64, f64)) -> Self {
        let (width, height) = (width.ceil(), height.ceil());
        let fonts = escaped(style::FONTS);
        Self {
            text: format!(
                "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
                 viewBox=\"0 0 {width} {height}\" font-family=\"{fonts}\" stroke-linecap=\"round\" \
                 stroke-linejoin=\"round\" fill=\"none\">\n"
            ),
        }
    }

    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    /// A rectangle from its upper left corner, with round corners of a radius.
    pub(super) fn rect(
        &mut self,
        (x, y): Point,
        (width, height): (f64, f64),
        fill: Option<RGBColor>,
        edge: Option<RGBColor>,
        round: f64,
    ) {
        let (x, y, width, height) = (tenth(x), tenth(y), tenth(width), tenth(height));
        let mut looks = String::new();
        if round > 0.0 {
            push(&mut looks, format_args!(" rx=\"{}\"", tenth(round)));
        }
        if let Some(fill) = fill {
            push(&mut looks, format_args!(" fill=\"{}\"", hex(fill)));
        }
        if let Some(edge) = edge {
            push(&mut looks, format_args!(" stroke=\"{}\"", hex(edge)));
        }
        self.tag(format_args!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"{looks}/>"
        ));
    }

    pub(super) fn line(&mut self, from: Point, to: Point, color: RGBColor, width: f64) {
        self.path(&[from, to], color, width);
    }

    /// An open line through points.
    pub(super) fn path(&mut self, points: &[Point], color: RGBColor, width: f64) {
        let mut way = String::new();
        for (at, point) in points.iter().enumerate() {
            push(&mut way, format_args!("{}{}", if at == 0 { 'M' } else { 'L' }, pair(*point)));
        }
        self.stroked(&way, color, width, "");
    }

    /// A line of dashes.
    pub(super) fn dashes(&mut self, from: Point, to: Point, color: RGBColor, width: f64) {
        let way = format!("M{}L{}", pair(from), pair(to));
        self.stroked(&way, color, width, " stroke-dasharray=\"3 4\"");
    }

    fn stroked(&mut self, way: &str, color: RGBColor, width: f64, more: &str) {
        let (color, width) = (hex(color), tenth(width));
        self.tag(format_args!(
            "<path d=\"{way}\" stroke=\"{color}\" stroke-width=\"{width}\"{more}/>"
        ));
    }

    /// A filled circle with an edge, either of which may be missing.
    pub(super) fn disc(
        &mut self,
        (x, y): Point,
        radius: f64,
        fill: Option<RGBColor>,
        edge: Option<(RGBColor, f64)>,
    ) {
        let (x, y, radius) = (tenth(x), tenth(y), tenth(radius));
        let mut looks = fill.map(|fill| format!(" fill=\"{}\"", hex(fill))).unwrap_or_default();
        if let Some((color, width)) = edge {
            let (color, width) = (hex(color), tenth(width));
            push(&mut looks, format_args!(" stroke=\"{color}\" stroke-width=\"{width}\""));
        }
        self.tag(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"{looks}/>"));
    }

    /// An ×.
    pub(super) fn cross(&mut self, (x, y): Point, radius: f64, color: RGBColor, width: f64) {
        self.line((x - radius, y - radius), (x + radius, y + radius), color, width);
        self.line((x - radius, y + radius), (x + radius, y - radius), color, width);
    }

    /// A text whose base line goes through the point. Control characters become spaces.
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

    /// A number in a circle (丸数字). Pinned ones are filled.
    pub(super) fn badge(&mut self, center: Point, number: usize, color: RGBColor, filled: bool) {
        let (fill, ink) = if filled { (color, style::PAPER) } else { (style::PAPER, color) };
        self.disc(center, style::BADGE, Some(fill), Some((color, 1.25)));
        let size = [11.0, 10.0, 8.0][number.to_string().len().clamp(1, 3) - 1];
        let look = Type::new(size).bold().color(ink).align(Align::Center);
        self.text(&number.to_string(), (center.0, center.1 + 0.36 * size), look);
    }

    /// A stick figure: neighbouring strokes of one look are one path.
    pub(super) fn figure(&mut self, drawn: &Drawn, inks: Inks) {
        for run in drawn.strokes.chunk_by(|a, b| a.side == b.side && a.width == b.width) {
            let mut way = String::new();
            for stroke in run {
                push(&mut way, format_args!("M{}L{}", pair(stroke.from), pair(stroke.to)));
            }
            self.stroked(&way, inks.of(run[0].side), run[0].width, "");
        }
        let ink = inks.of(BodySide::Trunk);
        if let Some((center, radius)) = drawn.head {
            let width = (0.24 * radius).clamp(0.8, 4.0);
            self.disc(center, radius, Some(style::PAPER), Some((ink, width)));
        }
        if let Some(dot) = drawn.dot {
            self.disc(dot, 4.0, Some(ink), None);
        }
    }

    fn tag(&mut self, tag: std::fmt::Arguments<'_>) {
        push(&mut self.text, tag);
        self.text.push('\n');
    }
}

fn push(text: &mut String, more: std::fmt::Arguments<'_>) {
    text.write_fmt(more).expect("a String takes every text");
}

/// To a tenth of a px, without a needless zero; what no picture can hold is cut.
fn tenth(px: f64) -> f64 {
    let px = if px.is_nan() { 0.0 } else { px };
    (px.clamp(-1e6, 1e6) * 10.0).round() / 10.0 + 0.0
}

fn pair((x, y): Point) -> String {
    format!("{} {}", tenth(x), tenth(y))
}

pub(super) fn hex(color: RGBColor) -> String {
    format!("#{:02x}{:02x}{:02x}", color.0, color.1, color.2)
}

/// Text as XML and HTML have it.
pub(crate) fn escaped(text: &str) -> String {
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
