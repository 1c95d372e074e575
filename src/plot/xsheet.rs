//! The X-sheet (タイムシート) as it lies on an animator's desk: time runs down, 144 koma a page in two
//! halves, ACTION beside CELL.

mod column;
mod gauge_page;
mod gauge_strip;
mod grid;
mod half;
mod head;
mod layout;
mod leaf;
mod page;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::motion::Clip;
use crate::plot::xsheet::layout::Page;
use crate::plot::xsheet::leaf::Leaf;
use crate::sheet::Sheet;
use crate::timing::Gauge;

/// The X-sheet (タイムシート): pages for A4 or B4, and after them the spacing gauges (ツメ指示).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct XSheet {
    /// The work's title (作品); default empty, to be written in by hand, as the next three.
    pub title: String,
    /// The episode (話数).
    pub episode: String,
    /// The scene (シーン).
    pub scene: String,
    /// The key animator (原画).
    pub animator: String,
    /// How an inbetween is marked in ACTION; default a dot.
    pub inbetween: InbetweenMark,
    /// Which drawings have a line down the koma that they are held for; default the long ones.
    pub hold_line: HoldLine,
    /// Whether pages with the spacing gauges follow; default yes.
    pub gauges: bool,
}

/// How an inbetween is marked in the ACTION column.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum InbetweenMark {
    /// ・, as by hand.
    #[default]
    Dot,
    /// ○, as programs show it.
    Circle,
}

/// Which drawings have a hold line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HoldLine {
    /// Those on screen for more than 3 koma.
    #[default]
    Long,
    /// All that stay longer than a koma.
    Always,
    /// None.
    Never,
}

impl Default for XSheet {
    fn default() -> Self {
        Self {
            title: String::new(),
            episode: String::new(),
            scene: String::new(),
            animator: String::new(),
            inbetween: InbetweenMark::default(),
            hold_line: HoldLine::default(),
            gauges: true,
        }
    }
}

impl HoldLine {
    fn draws(self, koma: usize) -> bool {
        match self {
            Self::Long => koma > 3,
            Self::Always => koma > 1,
            Self::Never => false,
        }
    }
}

impl XSheet {
    /// Draws the pages as SVG, each of 1000 × 1440 px: eight layers on a page at most, first all time of
    /// the first eight, then of the next, then the gauges. An empty sheet has one page.
    ///
    /// # Errors
    /// [`Error::Sheet`] as [`Sheet::check`].
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        sheet.check()?;
        let gauges: Vec<_> = sheet.layers.iter().map(|layer| Gauge::of(clip, layer)).collect();
        let leaves: Vec<Leaf<'_>> = sheet
            .layers
            .iter()
            .zip(&gauges)
            .map(|(layer, gauges)| Leaf::new(layer, gauges))
            .collect();
        let mut pages = Vec::new();
        for page in Page::all(self, cut, sheet, &leaves) {
            pages.push(page::draw(&page));
        }
        if self.gauges {
            pages.extend(gauge_page::draw(self, cut, clip, sheet, &leaves));
        }
        Ok(pages)
    }
}
