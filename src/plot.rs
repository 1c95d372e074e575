//! **Show** (見る): pictures of what was measured and decided, as SVG text.
//!
//! A picture is a settings struct with one verb, `draw`. Same input, same bytes: no time stamps and
//! no order that could change. Text names a list of fonts; the last, `sans-serif`, is always there.

mod axis;
mod canvas;
mod pose_row;
#[cfg(feature = "cli")]
mod raster;
mod sheet;
mod speed;
mod study;
mod style;
mod view;

#[cfg(test)]
mod tests;

pub(crate) use pose_row::BodySide;
pub use pose_row::PoseRow;
#[cfg(feature = "cli")]
pub use raster::png_from_svg;
pub use sheet::SheetPlot;
pub use speed::SpeedPlot;
pub use study::{StudyCount, StudyPlot, StudyRow};
