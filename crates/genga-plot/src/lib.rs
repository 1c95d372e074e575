//! **Show** (見る): pictures of what was measured and decided.
//!
//! Each picture is a settings struct with one method, `draw`. The same input gives the same bytes: there are
//! no time stamps, and every order is fixed. Text names a list of fonts; the last, `sans-serif`, always
//! exists. One canvas writes SVG. A library draws the axes and curves of charts on it. Only pictures made by
//! the hundred are drawn straight to pixels.

// Tests may compare with the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod browser;
mod canvas;
mod chart;
mod contact_sheet;
#[cfg(feature = "pictures")]
mod convert;
mod drawings;
mod figure;
pub mod films;
mod flipbook;
mod heat;
mod hierarchy;
mod images;
mod legend;
mod onion;
mod page_head;
mod paper_point;
#[doc(hidden)]
pub mod parts;
#[cfg(feature = "images")]
mod pixels;
mod points;
mod pose_row;
mod preview;
mod shared;
mod sheet;
mod side_by_side;
mod spacing;
mod speed;
mod ssd;
mod stage;
mod strip;
mod study_chart;
mod style;
mod title;
mod xsheet;

#[cfg(test)]
mod tests;

pub use canvas::escaped;
pub use contact_sheet::ContactSheet;
#[cfg(feature = "pdf")]
pub use convert::pdf_from_svg;
#[cfg(feature = "pictures")]
pub use convert::{font_note, png_from_svg};
pub use figure::FigureBody;
pub use flipbook::FlipBook;
pub use genga::motion::Camera;
pub use heat::HeatMap;
pub use hierarchy::SkeletonPlot;
pub use images::NumberedImages;
#[cfg(feature = "images")]
pub use images::{CelGap, ColumnPictures};
pub use onion::OnionSkin;
pub use pose_row::PoseRow;
pub use preview::Preview;
pub use sheet::SheetPlot;
pub use side_by_side::{SideBySide, Version};
pub use spacing::SpacingPlot;
pub use speed::{SpeedCurves, SpeedPlot};
pub use ssd::SsdPlot;
pub use strip::Strip;
pub use study_chart::StudyPlot;
pub use xsheet::{HoldLine, InbetweenMark, XSheet};

#[cfg(test)]
#[path = "../../../tests/real/mod.rs"]
mod real;
#[cfg(test)]
#[path = "../../../src/motion/bvh/sample.rs"]
mod sample;
