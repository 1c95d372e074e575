//! Figs 4 to 7: the four actions at their fastest, source above and result below.

use genga::sheet::{Exposure, Layer, Sheet};
use genga_plot::Strip;

use crate::Outcome;
use crate::kitamura::at_once::koma;
use crate::kitamura::table_1::ACTIONS;
use crate::ones::{Done, Ones, counts};
use crate::part::Part;
use crate::table::Table;

/// Koma in a line of the strip.
const LINE: usize = 12;

/// A figure of the paper.
struct Figure {
    name: &'static str,
    picture: &'static str,
    /// Index of the first deleted frame in the upper row, from 1, and the deleted frames as the paper states them.
    first: usize,
    deleted: &'static str,
}

/// The figures in the order of Table 1. The paper does not state the last frame of the kick.
const FIGURES: [Figure; 4] = [
    figure("Fig. 4, pitch", "fig-4-pitch", 3, "3–6"),
    figure("Fig. 5, kick", "fig-5-kick", 2, "2–(not said)"),
    figure("Fig. 6, tennis", "fig-6-tennis", 2, "2–5"),
    figure("Fig. 7, swing", "fig-7-swing", 2, "2–7"),
];

const fn figure(
    name: &'static str,
    picture: &'static str,
    first: usize,
    deleted: &'static str,
) -> Figure {
    Figure { name, picture, first, deleted }
}

/// Makes the strips, cropped so that the first deletion is at the same index as in the paper, and the table of frames
/// left out.
pub(super) fn add(part: &mut Part) -> Outcome<()> {
    let mut table = Table::new(&[
        "figure",
        ">paper: deleted frames of the strip",
        ">genga: deleted frames of the strip",
        ">koma of the action",
        ">koma late",
    ]);
    for (action, figure) in ACTIONS.iter().zip(FIGURES) {
        let ones = action.ones()?;
        let done = ones.omit(&counts(action.naka_nashi, action.koma_dori))?;
        let left_out = done.left_out();
        let begin = (left_out[0] + 1).saturating_sub(figure.first);
        let in_strip: Vec<usize> = left_out.iter().map(|at| at - begin).collect();
        let jump = done.shown.iter().position(|koma| *koma > left_out[0]).unwrap_or(left_out[0]);
        table.row(&[
            figure.name.into(),
            figure.deleted.into(),
            koma(&in_strip),
            koma(&left_out),
            (jump - left_out[0]).to_string(),
        ]);
        part.picture(figure.picture, draw(&ones, &done, begin, action.name)?);
    }
    part.table("strips", table);
    Ok(())
}

/// Draws a line of koma that begins at `begin`.
pub(super) fn draw(ones: &Ones, done: &Done, begin: usize, name: &str) -> Outcome<String> {
    let strip = Strip { in_line: LINE, figure_height: 110, ..Strip::default() };
    let pages = strip.draw(name, &ones.clip, &cropped(&done.sheet, begin))?;
    Ok(pages.into_iter().next().ok_or("a strip without a page")?)
}

/// Crops a sheet to the line that begins on a koma.
fn cropped(sheet: &Sheet, begin: usize) -> Sheet {
    let layer = &sheet.layers[0];
    let part = |(at, shown): (usize, Exposure)| {
        let (from, past) = (at.max(begin), (at + shown.koma).min(begin + LINE));
        (from < past).then(|| Exposure { koma: past - from, ..shown })
    };
    let exposures = layer.timed().filter_map(part).collect();
    let mut clock = sheet.clock;
    clock.first.0 = sheet.clock.place_from_koma(begin).round() as usize;
    Sheet::new(clock, vec![Layer { exposures, ..layer.clone() }])
}
