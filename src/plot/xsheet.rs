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
mod speech;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::knob::{choices, knob, knobs};
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
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum InbetweenMark {
    /// ・, as by hand.
    #[default]
    Dot,
    /// ○, as programs show it.
    Circle,
}

choices!(InbetweenMark { Dot: "dot", Circle: "circle" });

/// Which drawings have a hold line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum HoldLine {
    /// Those on screen for more than 3 koma.
    #[default]
    Long,
    /// All that stay longer than a koma.
    Always,
    /// None.
    Never,
}

choices!(HoldLine { Long: "long", Always: "always", Never: "never" });

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

knobs!(xsheet::XSheet {
    title: knob(
        "作品",
        "The work's title; empty, it is written in by hand.",
        "作品名。空なら手で書き込む。"
    )
    .unit("words"),
    episode: knob("話数", "The episode.", "話数。").unit("words"),
    scene: knob("シーン", "The scene.", "シーン。").unit("words"),
    animator: knob("原画", "The key animator.", "原画担当。").unit("words"),
    inbetween: knob(
        "中割りの印",
        "How an inbetween is marked in ACTION.",
        "ACTION欄の中割りの印。"
    ),
    hold_line: knob(
        "止めの線",
        "Which drawings have a line down their koma: those for more than 3, for more than 1, or none.",
        "止めの線を引く絵。3コマを超えるもの（long）、1コマを超えるもの（always）、引かない（never）。",
    ),
    gauges: knob(
        "ツメ指示",
        "Whether pages with the spacing gauges follow.",
        "ツメ指示のページを付けるか。"
    ),
});

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
