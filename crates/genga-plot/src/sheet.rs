//! Draws the timesheet as bars over koma (タイムシート) [KKMFT Fig. 8].

pub(super) mod fate;
mod paper;

use plotters::style::RGBColor;
use serde::{Deserialize, Serialize};

use crate::canvas::{Canvas, Type};
use crate::chart::robust_top;
use crate::legend::{CUT, Entry, LEFT_OUT, SPLIT};
use crate::page_head;
use crate::paper_point::Point;
use crate::sheet::fate::{BY_HAND, row_before};
use crate::sheet::paper::{Band, LEFT, Paper, badges};
use crate::style;
use crate::title::Title;
use genga::error::Error;
use genga::motion::SeenFrom;
use genga::sheet::{Layer, Sheet};

/// The timesheet (タイムシート): a bar on the first koma of each drawing, and a line while it is held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SheetPlot {
    /// Name of the clip, below the title; default empty, not shown.
    pub clip: String,
    /// Width in px, 400 to 20000; default 960. The height follows from the sheet.
    pub width: u32,
    /// Koma on a line, 6 to 1440; default 144, the six seconds of a paper sheet. More koma make thinner bars,
    /// and the numbers of close genga are left out.
    pub koma_in_line: usize,
    /// Koma, from 0, on which actions (動作) begin, shown as dashed lines; default none.
    pub splits: Vec<usize>,
    /// Camera in which SSD was measured; default: world space.
    pub seen_from: SeenFrom,
}

impl Default for SheetPlot {
    fn default() -> Self {
        Self {
            clip: String::new(),
            width: style::WIDTH,
            koma_in_line: 144,
            splits: Vec::new(),
            seen_from: SeenFrom::World,
        }
    }
}

/// Height of a line of words about a layer, in the title, in px.
const COUNTS: f64 = 19.0;
/// Koma for which a movement lasts that is no glitch.
const LASTING: usize = 3;

impl SheetPlot {
    /// Checks the settings.
    ///
    /// # Errors
    /// [`Error::Setting`] if the width cannot be drawn, or if a line has too few or too many koma.
    pub fn validate(&self) -> Result<(), Error> {
        style::check_size("width", self.width, 400)?;
        if !(6..=1440).contains(&self.koma_in_line) {
            let message = format!("{} koma; it must be between 6 and 1440", self.koma_in_line);
            return Err(Error::setting("koma_in_line", message));
        }
        Ok(())
    }

    /// Draws the sheet as SVG: genga tall with their numbers, the first and the last dark, inbetweens short.
    ///
    /// `spaced` is the sheet before omission. It adds a thin row above each layer, with the drawings left
    /// out. `ssd` has one value per koma (how far the body moved into it) and is drawn as its square root. A glitch is
    /// cut at the edge of its lane, under a sign.
    ///
    /// # Errors
    /// [`Error::Setting`] as in [`SheetPlot::validate`]; [`Error::Sheet`] as in [`Sheet::check`].
    pub fn draw(
        &self,
        sheet: &Sheet,
        spaced: Option<&Sheet>,
        ssd: Option<&[f64]>,
    ) -> Result<String, Error> {
        self.validate()?;
        sheet.check()?;
        spaced.map_or(Ok(()), Sheet::check)?;
        let paper = self.paper(sheet, spaced, ssd);
        let entries = self.entries(spaced.is_some(), &paper);
        let width = f64::from(self.width);
        let clips = page_head::with_first_koma(&self.clip, sheet.blank);
        let words = "Timesheet タイムシート";
        let title = Title { words, clips: &clips, legend: &entries, width };
        let words = title.height() + 14.0 + COUNTS * sheet.layers.len() as f64;
        let lines = paper.koma.div_ceil(paper.in_line).max(1);
        let line = paper.line_height();
        let height = words + line * lines as f64;
        let mut canvas = Canvas::new((width, height));
        title.draw(&mut canvas);
        for (at, layer) in sheet.layers.iter().enumerate() {
            let base = title.height() + 17.0 + COUNTS * at as f64;
            let counts = counts(layer, sheet.clock.koma_rate);
            let text = style::fitted(&counts, style::WORDS, width - 2.0 * style::MARGIN);
            canvas.text(&text, (style::MARGIN, base), Type::new(style::WORDS));
        }
        for at in 0..lines {
            paper.line(&mut canvas, at, words + line * at as f64);
        }
        Ok(canvas.finish())
    }

    fn paper<'a>(
        &'a self,
        sheet: &'a Sheet,
        spaced: Option<&'a Sheet>,
        ssd: Option<&'a [f64]>,
    ) -> Paper<'a> {
        let koma = sheet.length().max(spaced.map_or(0, Sheet::length));
        // A short sheet is stretched to the line, a long one is wrapped.
        let in_line = koma.max(24).min(self.koma_in_line);
        let slot = (f64::from(self.width) - LEFT - style::MARGIN) / in_line as f64;
        let bands: Vec<_> = sheet
            .layers
            .iter()
            .enumerate()
            .map(|(at, layer)| Band {
                layer,
                badges: badges(layer, in_line, slot),
                before: spaced.map(|spaced| {
                    spaced.layers.get(at).map_or_else(Vec::new, |before| row_before(before, layer))
                }),
            })
            .collect();
        let used = bands.iter().flat_map(|band| &band.badges).filter_map(|badge| badge.lane);
        let lanes = used.max().map_or(0, |lane| lane + 1);
        let roots = ssd.unwrap_or_default().iter().map(|ssd| ssd.max(0.0).sqrt());
        Paper {
            lanes,
            bands,
            top: robust_top(roots.clone(), LASTING),
            roots: ssd.is_some().then(|| roots.collect()),
            is_on_screen: !self.seen_from.is_world(),
            splits: &self.splits,
            koma,
            in_line,
            koma_rate: sheet.clock.koma_rate,
            slot,
        }
    }

    fn entries(&self, has_spaced: bool, paper: &Paper<'_>) -> Vec<Entry> {
        let mut entries = LEGEND[..if has_spaced { 6 } else { 4 }].to_vec();
        entries.extend(paper.is_held_by_hand().then_some(BY_HAND));
        entries.extend((!self.splits.is_empty()).then_some(SPLIT));
        entries.extend(paper.is_cut().then_some(CUT));
        entries
    }
}

/// Formats the numbers of a layer as one line.
fn counts(layer: &Layer, koma_rate: f64) -> String {
    let (koma, drawings) = (layer.length(), layer.shown().count());
    let seconds = koma as f64 / koma_rate;
    let a_second = layer.drawings_per_second(koma_rate);
    let joints = match layer.joints.as_slice() {
        [] => String::new(),
        [only] => format!("  ·  {only}"),
        [first, others @ ..] => format!("  ·  {first} and {} more", others.len()),
    };
    format!(
        "{}:  {koma} koma ({seconds:.1} s)  ·  {drawings} drawings  ·  {} genga  ·  {a_second:.1} drawings a second  ·  longest hold {} koma{joints}",
        layer.name,
        layer.genga(),
        layer.longest_hold()
    )
}

/// Legend of the strokes. The last two are shown only beside the sheet before omission.
const LEGEND: [Entry; 6] = [
    ("genga 原画", |canvas, at| bar(canvas, at, 15.0, style::GENGA)),
    ("inbetween 中割り", |canvas, at| bar(canvas, at, 9.0, style::INBETWEEN)),
    ("first, last 端", |canvas, at| bar(canvas, at, 15.0, style::END)),
    ("hold 止め", |canvas, (x, y)| {
        canvas.line((x - 7.5, y), (x + 7.5, y), style::INBETWEEN, 2.5)
    }),
    LEFT_OUT,
    ("held over コマ撮り", |canvas, at| canvas.ring(at, 3.25, style::FAINT, 1.25)),
];

fn bar(canvas: &mut Canvas, (x, y): Point, high: f64, color: RGBColor) {
    canvas.rect((x - 3.5, y + 7.0 - high), (x + 3.5, y + 7.0), color);
}
