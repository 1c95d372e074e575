//! Writes numbers and their letters with strokes, so that they need no font and look the same on every machine.

use plotters::style::RGBColor;
use tiny_skia::{LineCap, LineJoin, Path, PathBuilder, Rect, Stroke, Transform};

use super::letters::LETTERS;
use super::{Pixels, paint};
use crate::paper_point::Point;
use genga::sheet::Number;

/// Distance from one digit to the next, width and height of its strokes' middle line, and the strokes' width, as
/// shares of the size of the letters.
const ADVANCE: f64 = 0.62;
const WIDE: f32 = 0.42;
const HIGH: f32 = 0.64;
const BOLD: f32 = 0.115;

/// A part of a sign, in a square of 1 by 1 with y down.
pub(super) enum Part {
    /// Begins a stroke.
    From(f32, f32),
    /// A straight line.
    To(f32, f32),
    /// A Bézier curve: two control points and the end.
    Curve([f32; 2], [f32; 2], [f32; 2]),
    /// An ellipse: left, top, right, bottom.
    Ring(f32, f32, f32, f32),
}

use Part::{Curve, From, Ring, To};

/// The strokes of the digits 0 to 9.
const DIGITS: [&[Part]; 10] = [
    &[Ring(0.0, 0.0, 1.0, 1.0)],
    &[From(0.12, 0.2), To(0.58, 0.0), To(0.58, 1.0)],
    &[
        From(0.03, 0.25),
        Curve([0.06, 0.09], [0.24, 0.0], [0.5, 0.0]),
        Curve([0.78, 0.0], [0.96, 0.12], [0.96, 0.29]),
        Curve([0.96, 0.52], [0.5, 0.68], [0.0, 1.0]),
        To(1.0, 1.0),
    ],
    &[
        From(0.06, 0.14),
        Curve([0.16, 0.05], [0.3, 0.0], [0.47, 0.0]),
        Curve([0.75, 0.0], [0.93, 0.09], [0.93, 0.24]),
        Curve([0.93, 0.39], [0.75, 0.47], [0.42, 0.47]),
        Curve([0.8, 0.47], [1.0, 0.57], [1.0, 0.73]),
        Curve([1.0, 0.9], [0.8, 1.0], [0.47, 1.0]),
        Curve([0.26, 1.0], [0.1, 0.95], [0.0, 0.85]),
    ],
    &[From(0.74, 1.0), To(0.74, 0.0), To(0.0, 0.7), To(1.0, 0.7)],
    &[
        From(0.9, 0.0),
        To(0.15, 0.0),
        To(0.08, 0.45),
        Curve([0.2, 0.38], [0.33, 0.35], [0.47, 0.35]),
        Curve([0.8, 0.35], [1.0, 0.47], [1.0, 0.67]),
        Curve([1.0, 0.88], [0.8, 1.0], [0.46, 1.0]),
        Curve([0.26, 1.0], [0.1, 0.95], [0.0, 0.86]),
    ],
    &[
        From(0.86, 0.09),
        Curve([0.78, 0.03], [0.67, 0.0], [0.56, 0.0]),
        Curve([0.2, 0.0], [0.0, 0.27], [0.0, 0.68]),
        Ring(0.0, 0.38, 1.0, 1.0),
    ],
    &[From(0.0, 0.0), To(1.0, 0.0), Curve([0.66, 0.36], [0.42, 0.64], [0.36, 1.0])],
    &[Ring(0.09, 0.0, 0.91, 0.46), Ring(0.0, 0.46, 1.0, 1.0)],
    &[
        From(0.14, 0.91),
        Curve([0.22, 0.97], [0.33, 1.0], [0.44, 1.0]),
        Curve([0.8, 1.0], [1.0, 0.73], [1.0, 0.32]),
        Ring(0.0, 0.0, 1.0, 0.62),
    ],
];

/// Numbers of one size and colour.
pub(crate) struct Digits {
    digits: Vec<Path>,
    letters: Vec<Path>,
    size: f64,
    color: RGBColor,
}

impl Digits {
    /// Prepares the digits for letters of a size in px.
    pub(crate) fn new(size: f64, color: RGBColor) -> Self {
        let paths = |strokes: &[&[Part]]| {
            strokes.iter().filter_map(|parts| outline(parts, size as f32)).collect()
        };
        Self { digits: paths(&DIGITS), letters: paths(&LETTERS), size, color }
    }

    /// Writes a number that ends at a point on its base line.
    pub(crate) fn write(&self, pixels: &mut Pixels, number: &Number, (x, base): Point) {
        let advance = (ADVANCE * self.size).ceil();
        let size = self.size as f32;
        let stroke = Stroke {
            width: BOLD * size,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        let mut left = x.round();
        for sign in number.to_string().bytes().rev() {
            left -= advance;
            let place = Transform::from_translate(
                left as f32 + 0.5 * (advance as f32 - WIDE * size),
                base.round() as f32 - (HIGH + 0.5 * BOLD) * size,
            );
            let path = match sign {
                b'a'..=b'z' => &self.letters[usize::from(sign - b'a')],
                digit => &self.digits[usize::from(digit - b'0')],
            };
            pixels.map.stroke_path(path, &paint(self.color), &stroke, place, None);
        }
    }
}

/// Builds the middle line of a sign for letters of a size in px.
fn outline(parts: &[Part], size: f32) -> Option<Path> {
    let (wide, high) = (WIDE * size, HIGH * size);
    let mut path = PathBuilder::new();
    for part in parts {
        match *part {
            From(x, y) => path.move_to(wide * x, high * y),
            To(x, y) => path.line_to(wide * x, high * y),
            Curve(a, b, end) => path.cubic_to(
                wide * a[0],
                high * a[1],
                wide * b[0],
                high * b[1],
                wide * end[0],
                high * end[1],
            ),
            Ring(left, top, right, bottom) => {
                let place = Rect::from_ltrb(wide * left, high * top, wide * right, high * bottom)?;
                path.push_oval(place);
            }
        }
    }
    path.finish()
}
