//! Draws the head that all pages of figures share: the title, the counts of the cut, the legend.

use crate::canvas::{Align, Canvas, Type};
use crate::drawings::{columns, counts, seconds_and_koma};
use crate::legend::{self, Entry};
use crate::style;
use genga::sheet::{Blank, Layer, Sheet};

/// Height of the head, in px.
pub(super) const HEAD: f64 = 72.0;
/// Minimum width of a page in px, so that its head fits.
pub(super) const NARROWEST: f64 = 560.0;

/// The head of a page.
pub(super) struct Head<'a> {
    /// Title, in English and Japanese.
    pub(super) title: &'a str,
    /// Name of the cut.
    pub(super) cut: &'a str,
    /// Counts of the layer, in small type.
    pub(super) facts: String,
    pub(super) legend: &'a [Entry],
    /// Number of this page, from 1, and number of pages.
    pub(super) page: (usize, usize),
}

impl Head<'_> {
    pub(super) fn draw(&self, canvas: &mut Canvas, width: f64) {
        let right = width - style::MARGIN;
        canvas.text(self.title, (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
        let legend = right - legend::width(self.legend);
        legend::draw(canvas, (legend, 34.0), self.legend);
        let title = style::BOLDER * style::text_width(self.title, style::TITLE);
        let begin = style::MARGIN + title + 16.0;
        let cut = style::fitted(self.cut, style::WORDS, legend - 18.0 - begin);
        canvas.text(&cut, (begin, 34.0), Type::new(style::WORDS).color(style::FAINT));
        let (page, pages) = self.page;
        let mut room = right - style::MARGIN;
        if pages > 1 {
            let look = Type::new(style::WORDS).color(style::FAINT).align(Align::Right);
            canvas.text(&format!("page {page} of {pages}"), (right, 56.0), look);
            room -= 110.0;
        }
        let facts = style::fitted(&self.facts, style::WORDS, room);
        canvas.text(&facts, (style::MARGIN, 56.0), Type::new(style::WORDS).color(style::FAINT));
    }
}

/// Formats the counts of a cut: the koma of its composited `layer`, genga and drawings of all columns.
pub(super) fn facts(sheet: &Sheet, layer: &Layer) -> String {
    let koma = layer.length();
    let length = seconds_and_koma(koma, sheet.clock.koma_rate);
    let [genga, drawings] = counts(sheet);
    let plural = if drawings == 1 { "" } else { "s" };
    let of = match columns(sheet).len() {
        1 => String::new(),
        count => format!(" · {count} columns セル"),
    };
    with_first_koma(
        &format!(
            "尺 {length} ({koma} koma) · genga 原画 {genga} · {drawings} drawing{plural} 動画{of}"
        ),
        sheet.blank,
    )
}

/// Adds to words of a head on which koma of the cut the drawings begin, if that is not the first.
pub(super) fn with_first_koma(words: &str, blank: Blank) -> String {
    if blank.before == 0 {
        return words.to_owned();
    }
    let begin = format!("koma 1 here is koma {} of the cut", blank.before + 1);
    let words = [words, &begin].into_iter().filter(|words| !words.is_empty());
    words.collect::<Vec<_>>().join(" · ")
}
