//! Defines the knobs that several pictures of figures share.

use genga::knob::{Knob, knob};

pub(super) const CAMERA: Knob = knob("カメラ", "Camera of the figures.", "人物を見るカメラ。");

pub(super) const WIDTH: Knob =
    knob("幅", "Width of the picture.", "絵の幅。").unit("px").at_least(600.0).at_most(20_000.0);

pub(super) const HEIGHT: Knob = knob("高さ", "Height of the picture.", "絵の高さ。").unit("px");

pub(super) const FIGURE_HEIGHT: Knob =
    knob("人物の高さ", "Height of the tallest figure.", "最も高い人物の高さ。")
        .unit("px")
        .at_least(40.0)
        .at_most(2000.0);

pub(super) const ROWS: Knob =
    knob("段数", "Rows on a page.", "1ページの段数。").unit("rows").at_least(1.0).at_most(1000.0);

pub(super) const IN_ROW: Knob =
    knob("一段の数", "Maximum number in a row.", "一段に並べる数の上限。")
        .unit("figures")
        .at_least(1.0)
        .at_most(1000.0);

/// Maximum number of koma, needed because the whole picture is held in memory.
pub(super) const MOST: Knob = knob(
    "コマの上限",
    "Maximum number of koma shown, from the first.",
    "先頭から見せるコマ数の上限。",
)
.unit("koma")
.at_least(1.0)
.at_most(100_000.0);
