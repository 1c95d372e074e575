//! Draws the head of a chart: its title, the names of its clips, its legend.

use crate::canvas::{Canvas, Type};
use crate::legend::{self, Entry};
use crate::style;

/// Height of the title and of the names from the top edge, in px.
pub(super) const HIGH: f64 = 60.0;

/// The head of a chart. The legend stands right of the title or, if it has no room there, below the names.
pub(super) struct Title<'a> {
    pub(super) words: &'a str,
    /// Names of the clips, which are cut off at the right edge.
    pub(super) clips: &'a str,
    pub(super) legend: &'a [Entry],
    /// Width of the picture, in px.
    pub(super) width: f64,
}

impl Title<'_> {
    /// Returns the height from the top edge, in px.
    pub(super) fn height(&self) -> f64 {
        HIGH + legend::LINE * self.below().len() as f64
    }

    /// Returns the lines of the legend below the names.
    fn below(&self) -> Vec<&[Entry]> {
        let title = style::BOLDER * style::text_width(self.words, style::TITLE);
        let room = self.width - 2.0 * style::MARGIN;
        if title + 24.0 + legend::width(self.legend) <= room {
            return Vec::new();
        }
        legend::lines(self.legend, room)
    }

    pub(super) fn draw(&self, canvas: &mut Canvas) {
        let right = self.width - style::MARGIN;
        canvas.text(self.words, (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
        let clips = style::fitted(self.clips, style::WORDS, right - style::MARGIN);
        canvas.text(&clips, (style::MARGIN, 55.0), Type::new(style::WORDS).color(style::FAINT));
        let below = self.below();
        if below.is_empty() {
            legend::draw(canvas, (right - legend::width(self.legend), 34.0), self.legend);
        }
        for (at, line) in below.into_iter().enumerate() {
            let base = HIGH + 17.0 + legend::LINE * at as f64;
            legend::draw(canvas, (style::MARGIN, base), line);
        }
    }
}
