//! Draws the legend beside a chart of a study, and the bands behind its lines.

use crate::canvas::{Canvas, Type};
use crate::chart::Plot;
use crate::paper_point::Point;
use crate::study_chart::lines::{LOOKS, Line, Look};
use crate::study_chart::{FEW_CLIPS, with_unit};
use crate::style;
use genga_lab::study::Grid;

/// Lines or bands behind the medians of several clips.
pub(super) enum Behind {
    Nothing,
    /// A thin line for each clip and each value of the second setting.
    Clips(Vec<Line>),
    /// The lower and the upper quartile, one line each per value of the second setting.
    Bands(Vec<Line>, Vec<Line>),
}

impl Behind {
    /// Returns the values for which the chart needs room: those of the clips, or the upper quartiles.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> + '_ {
        let lines: &[Line] = match self {
            Self::Nothing => &[],
            Self::Clips(lines) | Self::Bands(_, lines) => lines,
        };
        lines.iter().flatten().map(value)
    }

    /// Returns the lines of single clips.
    pub(super) fn lines(&self) -> impl Iterator<Item = &Line> {
        if let Self::Clips(lines) = self { lines.iter() } else { [].iter() }
    }

    /// Draws the bands.
    pub(super) fn veils(&self, canvas: &mut Canvas, plot: &Plot, looks: &[Look]) {
        let Self::Bands(low, high) = self else { return };
        for ((low, high), look) in low.iter().zip(high).zip(looks) {
            let way = high.iter().chain(low.iter().rev());
            let edge: Vec<Point> = way.map(|(x, y)| plot.at(*x, *y)).collect();
            canvas.veil(&edge, look.color);
        }
    }
}

fn value(point: &(f64, f64)) -> f64 {
    point.1
}

/// Height of a line of words, in px.
const LINE: f64 = 20.0;
/// Distance from the left edge of a sign to its words, in px.
const SIGN: f64 = 34.0;

/// The legend to the right of the chart.
pub(super) struct Legend {
    /// Look of each line.
    pub(super) looks: Vec<Look>,
    /// Name of the second setting, in two languages.
    names: Vec<String>,
    /// Values of the second setting that are named, each with the index of its line.
    values: Vec<(usize, String)>,
    clips: usize,
    has_paper: bool,
}

impl Legend {
    pub(super) fn new(grid: &Grid, clips: usize, has_paper: bool) -> Self {
        let looks = Look::for_lines(grid.rows());
        let (mut names, mut values) = (vec![], vec![]);
        if let Some(y) = &grid.y {
            names = vec![with_unit(y), y.knob().japanese.to_owned()];
            // Of many lines, only a few are named, since their colours are in order.
            let (last, every) = (y.len() - 1, y.len().div_ceil(LOOKS.len()));
            let is_named = |at: &usize| {
                every == 1 || *at == last || (at.is_multiple_of(every) && at + every <= last)
            };
            let named = (0..y.len()).filter(is_named);
            values = named.map(|at| (at, y.values()[at].clone())).collect();
        }
        Self { looks, names, values, clips, has_paper }
    }

    /// Returns the words for the signs of the medians, of the clips or quartiles, and of the paper's counts.
    fn notes(&self) -> [Option<&'static str>; 3] {
        let is_several = self.clips > 1;
        let behind =
            if self.clips > FEW_CLIPS { "quartiles 四分位" } else { "each clip 各素材" };
        [
            is_several.then_some("median 中央値"),
            is_several.then_some(behind),
            self.has_paper.then_some("[KT11] Table 1, another clip"),
        ]
    }

    /// Returns the width in px, with white on both sides; without words it is that white alone.
    pub(super) fn width(&self) -> f64 {
        let own = |words: &str| style::text_width(words, style::WORDS);
        let names = self.names.iter().map(|name| 1.06 * own(name));
        let values = self.values.iter().map(|(_, value)| SIGN + own(value));
        let notes = self.notes().into_iter().flatten().map(|note| SIGN + own(note));
        let widest = names.chain(values).chain(notes).fold(0.0, f64::max);
        if widest == 0.0 { 40.0 } else { 24.0 + widest + style::MARGIN }
    }

    /// Draws the legend downwards from its upper left corner.
    pub(super) fn draw(&self, canvas: &mut Canvas, (left, top): Point) {
        let words = Type::new(style::WORDS);
        let mut base = top;
        for (at, name) in self.names.iter().enumerate() {
            canvas.text(name, (left, base), if at == 0 { words.bold() } else { words });
            base += LINE;
        }
        for (line, value) in &self.values {
            let look = self.looks[*line];
            canvas.line((left, base - 4.5), (left + 26.0, base - 4.5), look.color, 2.0);
            look.mark(canvas, (left + 13.0, base - 4.5), 4.0);
            canvas.text(value, (left + SIGN, base), words);
            base += LINE;
        }
        if !self.names.is_empty() {
            base += 0.5 * LINE;
        }
        for (at, note) in self.notes().into_iter().enumerate() {
            let Some(note) = note else { continue };
            let (from, to) = ((left, base - 4.5), (left + 26.0, base - 4.5));
            match at {
                0 => canvas.line(from, to, style::INK, 2.0),
                1 if self.clips > FEW_CLIPS => {
                    let (high, low) = (base - 11.0, base + 2.0);
                    let corners = [(from.0, high), (to.0, high), (to.0, low), (from.0, low)];
                    canvas.veil(&corners, style::INK);
                }
                1 => canvas.line(from, to, style::mixed(style::INK, style::PAPER, 0.6), 1.0),
                _ => canvas.ring((left + 13.0, base - 4.5), 6.5, style::INK, 1.75),
            }
            canvas.text(note, (left + SIGN, base), words);
            base += LINE;
        }
    }
}
