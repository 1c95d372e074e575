//! Builds the legend of the speed plot.

use plotters::style::RGBColor;

use crate::canvas::Canvas;
use crate::legend::{CUT, Entry, SPLIT};
use crate::paper_point::Point;
use crate::speed::SpeedCurves;
use crate::speed::curve::KEPT;
use crate::style;
use genga::signal::{Turn, TurnKind};

const RAW: Entry = ("raw", |canvas, at| level(canvas, at, style::RAW, 1.5));
const MEASURED: Entry = ("as measured", |canvas, at| level(canvas, at, style::FAINT, 1.25));
const FILTERED: Entry = ("filtered", |canvas, at| level(canvas, at, style::FILTERED, 1.75));
const ALONE: Entry =
    ("its keys alone 候補のみ", |canvas, at| level(canvas, at, style::GENGA, KEPT));
const KEY: Entry =
    ("key of the joint 関節の候補", |canvas, at| canvas.disc(at, 4.5, style::GENGA));
const WALL: Entry = ("wall 壁", |canvas, at| canvas.triangle(at, 5.5, style::WALL));
const GENGA: Entry = ("genga 原画 ①", |canvas, (x, y)| {
    canvas.line((x, y - 9.0), (x, y + 9.0), style::GENGA_LINE, 1.25);
});

/// What a picture shows besides curves and turns.
#[derive(Clone, Copy)]
pub(super) struct Has {
    pub(super) genga: bool,
    pub(super) splits: bool,
    /// Whether a filtered curve goes on beyond its panel.
    pub(super) cuts: bool,
}

/// Returns the entries of the curves and marks that the picture shows.
pub(super) fn entries(curves: SpeedCurves, turns: &[&Turn], also: Has) -> Vec<Entry> {
    let has = |kind| turns.iter().any(|turn| turn.kind == kind);
    let mut entries = match curves {
        SpeedCurves::Both => vec![RAW, FILTERED],
        SpeedCurves::Measured => vec![MEASURED],
        SpeedCurves::Filtered => vec![FILTERED],
        SpeedCurves::Kept => vec![FILTERED, ALONE],
    };
    entries.extend(has(TurnKind::Key).then_some(KEY));
    entries.extend(has(TurnKind::Wall).then_some(WALL));
    entries.extend(also.genga.then_some(GENGA));
    entries.extend(also.splits.then_some(SPLIT));
    entries.extend(also.cuts.then_some(CUT));
    entries
}

fn level(canvas: &mut Canvas, (x, y): Point, color: RGBColor, width: f64) {
    canvas.line((x - 9.0, y), (x + 9.0, y), color, width);
}
