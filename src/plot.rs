//! **Show** (見る): pictures of what was measured and decided.
//!
//! A picture is a settings struct with one verb, `draw`. Same input, same bytes: no time stamps and
//! no order that could change. Text names a list of fonts; the last, `sans-serif`, is always there.
//! Charts are drawn with a library, figures by an SVG writer of our own; only what is by the hundred goes straight to
//! pixels.

mod axis;
mod canvas;
mod cells;
mod contact_sheet;
mod figure;
mod flipbook;
mod heat;
mod hierarchy;
mod images;
mod onion;
mod page;
#[cfg(feature = "studio")]
pub(crate) mod parts;
#[cfg(feature = "cli")]
mod pixels;
mod points;
mod pose_row;
mod preview;
#[cfg(feature = "cli")]
mod raster;
mod shared;
mod sheet;
mod spacing;
mod speed;
mod ssd;
mod stage;
mod strip;
mod study;
mod style;
mod svg;
mod xsheet;

#[cfg(test)]
mod tests;

pub use crate::motion::Camera;
pub use contact_sheet::ContactSheet;
pub use flipbook::FlipBook;
pub use heat::HeatMap;
pub use hierarchy::SkeletonPlot;
pub use images::NumberedImages;
pub use onion::OnionSkin;
pub use pose_row::PoseRow;
pub use preview::Preview;
#[cfg(feature = "cli")]
pub use raster::png_from_svg;
pub use sheet::SheetPlot;
pub use spacing::SpacingPlot;
pub use speed::{SpeedCurves, SpeedPlot};
pub use ssd::SsdPlot;
pub use strip::Strip;
pub use study::StudyPlot;
pub(crate) use svg::escaped;
pub use xsheet::{HoldLine, InbetweenMark, XSheet};
