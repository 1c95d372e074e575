//! The head of the speeds: a title, and what the strokes mean.

use crate::plot::canvas::{Canvas, Point, Type};
use crate::plot::speed::SpeedCurves;
use crate::plot::speed::curve::KEPT;
use crate::plot::style;
use crate::signal::{Turn, TurnKind};

/// What is on the picture.
pub(super) fn of(
    curves: SpeedCurves,
    turns: &[&Turn],
    (has_genga, has_splits): (bool, bool),
) -> Vec<Stroke> {
    let has = |kind| turns.iter().any(|turn| turn.kind == kind);
    let mut strokes = match curves {
        SpeedCurves::Both => vec![Stroke::Raw, Stroke::Filtered],
        SpeedCurves::Measured => vec![Stroke::Measured],
        SpeedCurves::Filtered => vec![Stroke::Filtered],
        SpeedCurves::Kept => vec![Stroke::Filtered, Stroke::Kept],
    };
    strokes.extend(has(TurnKind::Key).then_some(Stroke::Key));
    strokes.extend(has(TurnKind::Wall).then_some(Stroke::Wall));
    strokes.extend(has_genga.then_some(Stroke::Genga));
    strokes.extend(has_splits.then_some(Stroke::Split));
    strokes
}

/// The title and, on its right, what the strokes mean.
pub(super) fn head(canvas: &mut Canvas, width: f64, legend: &[Stroke]) {
    canvas.text("Speed 速度", (style::MARGIN, 34.0), Type::new(style::TITLE).bold());
    let wide = |stroke: &Stroke| style::text_width(stroke.words(), style::WORDS) + 48.0;
    let mut x = width - style::MARGIN - legend.iter().map(wide).sum::<f64>() + 16.0;
    for stroke in legend {
        stroke.draw(canvas, (x + 12.0, 29.0));
        canvas.text(stroke.words(), (x + 30.0, 34.0), Type::new(style::WORDS));
        x += wide(stroke);
    }
}

/// What the legend explains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stroke {
    Raw,
    Measured,
    Filtered,
    Kept,
    Key,
    Wall,
    Genga,
    Split,
}

impl Stroke {
    fn words(self) -> &'static str {
        match self {
            Self::Raw => "raw",
            Self::Measured => "as measured",
            Self::Filtered => "filtered",
            Self::Kept => "keys alone 原画のみ",
            Self::Key => "key 原画",
            Self::Wall => "wall 壁",
            Self::Genga => "genga of the layer ①",
            Self::Split => "next action 区切り",
        }
    }

    /// An example about the point.
    fn draw(self, canvas: &mut Canvas, (x, y): Point) {
        match self {
            Self::Raw => canvas.line((x - 12.0, y), (x + 12.0, y), style::RAW, 1.5),
            Self::Measured => canvas.line((x - 12.0, y), (x + 12.0, y), style::FAINT, 1.25),
            Self::Filtered => canvas.line((x - 12.0, y), (x + 12.0, y), style::FILTERED, 1.75),
            Self::Kept => canvas.line((x - 12.0, y), (x + 12.0, y), style::GENGA, KEPT),
            Self::Key => canvas.disc((x, y), 4.5, style::GENGA),
            Self::Wall => canvas.triangle((x, y), 5.5, style::WALL),
            Self::Genga => canvas.line((x, y - 9.0), (x, y + 9.0), style::GENGA_LINE, 1.25),
            Self::Split => canvas.dashes((x, y - 9.0), (x, y + 9.0), style::INK, 1.25),
        }
    }
}
