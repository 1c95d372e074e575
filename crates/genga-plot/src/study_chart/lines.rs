//! Places the points of a study's lines, and gives each line a look of its own.

use plotters::style::RGBColor;

use crate::canvas::Canvas;
use crate::paper_point::Point;
use crate::study_chart::name;
use crate::style;
use genga_lab::study::Axis;

/// Points of a line, from left to right.
pub(super) type Line = Vec<(f64, f64)>;

/// Places of an axis's values: on their scale, or one after the other if they are words.
pub(super) struct Places {
    pub(super) numbers: Vec<f64>,
    /// Labels of the values, if they are words.
    pub(super) words: Option<Vec<String>>,
    pub(super) name: String,
}

impl Places {
    pub(super) fn from_axis(axis: &Axis) -> Self {
        let (numbers, words) = match axis.scale() {
            Some((numbers, _)) => (numbers, None),
            None => {
                let numbers = (0..axis.len()).map(|at| at as f64).collect();
                (numbers, Some(axis.values().to_vec()))
            }
        };
        Self { numbers, words, name: name(axis) }
    }

    /// Returns the line of each value of the second axis, along which `values` runs fastest.
    pub(super) fn lines(&self, values: Vec<f64>) -> Vec<Line> {
        let rows = values.len() / self.numbers.len().max(1);
        let line = |y: usize| {
            let of_line = values.iter().skip(y).step_by(rows).copied();
            let mut points: Line = self.numbers.iter().copied().zip(of_line).collect();
            points.retain(|(_, value)| value.is_finite());
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points
        };
        (0..rows).map(line).collect()
    }
}

/// The look of a line: its colour and, for prints without colours, the form of its marks.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) color: RGBColor,
    form: Form,
}

#[derive(Clone, Copy)]
enum Form {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
    Ring,
}

/// Looks of the lines, if there is one for each.
pub(super) const LOOKS: [Look; 6] = [
    Look { color: style::GENGA, form: Form::Disc },
    Look { color: style::WALL, form: Form::Square },
    Look { color: RGBColor(0, 140, 102), form: Form::Triangle },
    Look { color: style::RIGHT, form: Form::Diamond },
    Look { color: RGBColor(140, 80, 140), form: Form::Cross },
    Look { color: style::END, form: Form::Ring },
];

impl Look {
    /// Returns a look for each line: distinct while there are enough, otherwise a colour from blue to
    /// vermilion.
    pub(super) fn for_lines(lines: usize) -> Vec<Self> {
        let share = |line: usize| line as f64 / (lines - 1) as f64;
        if lines <= LOOKS.len() {
            return LOOKS[..lines].to_vec();
        }
        let color = |line| style::mixed(style::WALL, style::GENGA, share(line));
        (0..lines).map(|line| Self { color: color(line), form: Form::Disc }).collect()
    }

    pub(super) fn mark(self, canvas: &mut Canvas, (x, y): Point, radius: f64) {
        let Self { color, form } = self;
        match form {
            Form::Disc => canvas.disc((x, y), radius, color),
            Form::Ring => canvas.ring((x, y), radius, color, 1.75),
            Form::Triangle => canvas.triangle((x, y), 1.25 * radius, color),
            Form::Cross => canvas.cross((x, y), radius, color, 2.0),
            Form::Square => {
                let half = 0.9 * radius;
                canvas.rect((x - half, y - half), (x + half, y + half), color);
            }
            Form::Diamond => {
                let half = 1.3 * radius;
                canvas.area(&[(x, y - half), (x + half, y), (x, y + half), (x - half, y)], color);
            }
        }
    }
}
