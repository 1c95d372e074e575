//! Knobs that several pictures of figures have.

use crate::knob::{Knob, knob};

pub(super) const CAMERA: Knob = knob("カメラ", "From where it is seen.", "どこから見るか。");

pub(super) const WIDTH: Knob =
    knob("幅", "How wide it is.", "絵の幅。").unit("px").at_least(600.0).at_most(20_000.0);

pub(super) const HEIGHT: Knob = knob("高さ", "How high it is.", "絵の高さ。").unit("px");

pub(super) const FIGURE_HEIGHT: Knob =
    knob("人物の高さ", "How high the tallest figure is.", "いちばん高い人物の高さ。")
        .unit("px")
        .at_least(40.0)
        .at_most(2000.0);

pub(super) const ROWS: Knob = knob("段数", "How many rows a page has.", "1ページの段数。")
    .unit("rows")
    .at_least(1.0)
    .at_most(1000.0);

pub(super) const IN_ROW: Knob =
    knob("一段の数", "How many stand in a row at most.", "一段に並べる数の上限。")
        .unit("figures")
        .at_least(1.0)
        .at_most(1000.0);

/// The whole picture stands in memory.
pub(super) const MOST: Knob = knob(
    "コマの上限",
    "How many koma it shows at most, from the first on.",
    "先頭から何コマまで見せるか。",
)
.unit("koma")
.at_least(1.0)
.at_most(100_000.0);
