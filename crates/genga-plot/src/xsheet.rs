//! Draws the X-sheet (タイムシート) as it lies on an animator's desk: time runs down, 144 koma a page in two
//! halves, ACTION beside CELL.

mod column;
mod gauge_page;
mod gauge_strip;
mod grid;
mod half_page;
mod head;
mod layout;
mod page;
mod paper_layer;
mod speech;
mod spread;
#[cfg(test)]
mod tests;

use serde::{Deserialize, Serialize};

use crate::xsheet::layout::Page;
use crate::xsheet::paper_layer::Leaf;
use genga::error::Error;
use genga::knob::{choices, knob, knobs};
use genga::motion::{Clip, played_out};
use genga::sheet::Sheet;
use genga::slate::Slate;
use genga::timing::Gauge;

/// The X-sheet (タイムシート): pages for A4 or B4, followed by the spacing gauges (ツメ指示).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct XSheet {
    /// The work's title (作品). If it or one of the next three is empty, that of the sheet's slate is written, or
    /// nothing, so that it can be written in by hand.
    pub title: String,
    /// The episode (話数).
    pub episode: String,
    /// The scene (シーン).
    pub scene: String,
    /// The key animator (原画).
    pub animator: String,
    /// How an inbetween is marked in ACTION; default a dot.
    pub inbetween: InbetweenMark,
    /// Drawings that have a line down the koma for which they are held; default the long ones.
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

/// The drawings that have a hold line.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum HoldLine {
    /// Drawings on screen for more than 3 koma.
    #[default]
    Long,
    /// Drawings on screen for more than 1 koma.
    Always,
    /// No drawing.
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
        "Title of the work. If empty, it is written in by hand.",
        "作品名。空欄なら手で書き込む。"
    )
    .unit("words"),
    episode: knob("話数", "The episode.", "話数。").unit("words"),
    scene: knob("シーン", "The scene.", "シーン。").unit("words"),
    animator: knob("原画", "The key animator.", "原画担当。").unit("words"),
    inbetween: knob(
        "中割りの印",
        "Mark of an inbetween in the ACTION column.",
        "ACTION欄の中割りの印。"
    ),
    hold_line: knob(
        "止めの線",
        "Drawings with a line down their koma: those held for more than 3 koma (long), for more \
         than 1 koma (always), or none (never).",
        "止めの線を引く絵。3コマを超えるもの（long）、1コマを超えるもの（always）、\
         引かない（never）。",
    ),
    gauges: knob(
        "ツメ指示",
        "Whether pages with spacing gauges are added.",
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
    /// Draws the pages as SVG, each of 1000 × 1440 px and with at most eight layers. The pages of the first
    /// eight layers come first, then those of the next eight, then the gauges, all numbered as one series. An empty sheet has one page. The rounds of a
    /// loop after the first are written as a repeat (リピート).
    ///
    /// # Errors
    /// [`Error::Sheet`] as in [`Sheet::check`].
    pub fn draw(&self, cut: &str, clip: &Clip, sheet: &Sheet) -> Result<Vec<String>, Error> {
        sheet.check()?;
        let slate = self.slate(cut, sheet);
        let rounds = sheet.rounds();
        let repeat = (rounds > 1).then(|| sheet.length() / rounds);
        // The way over a seam shows only where the rounds follow each other.
        let (played_clip, played) = played_out(clip, sheet);
        let gauges: Vec<Vec<Gauge>> =
            played.layers.iter().map(|layer| Gauge::from_layer(&played_clip, layer)).collect();
        let leaves: Vec<Leaf<'_>> = sheet
            .layers
            .iter()
            .zip(&gauges)
            .map(|(layer, gauges)| Leaf::new(layer, gauges, sheet.blank.before, repeat))
            .collect();
        let gauges = if self.gauges { gauge_page::entries(&leaves) } else { Vec::new() };
        let mut koma = Page::all(self, (cut, &slate), sheet, &leaves);
        let of = koma.len() + gauge_page::count(&gauges);
        koma.iter_mut().for_each(|page| page.of = of);
        let mut pages: Vec<String> = koma.iter().map(page::draw).collect();
        if let Some(last) = koma.last() {
            let next = Page { number: last.number + 1, ..*last };
            pages.extend(gauge_page::draw(&next, clip, &gauges));
        }
        Ok(pages)
    }

    /// What stands in the head: these settings over the sheet's slate, over the numbers in the name of the cut.
    fn slate(&self, cut: &str, sheet: &Sheet) -> Slate {
        let own = Slate {
            title: self.title.clone(),
            episode: self.episode.clone(),
            scene: self.scene.clone(),
            animator: self.animator.clone(),
            ..Slate::default()
        };
        own.over(sheet.slate.clone()).over(Slate::from_name(cut))
    }
}
