//! **Show** (見る): pictures of what was measured and decided.
//!
//! A picture is a settings struct with one verb, `draw`. Same input, same bytes: no time stamps and
//! no order that could change. Text names a list of fonts; the last, `sans-serif`, is always there.
//! One canvas writes SVG. A library draws the axes and curves of charts on it; only what is by the hundred goes
//! straight to pixels.

pub(crate) mod browser;
mod canvas;
mod chart;
mod contact_sheet;
#[cfg(feature = "pictures")]
mod convert;
mod drawings;
mod figure;
pub(crate) mod films;
mod flipbook;
mod heat;
mod hierarchy;
mod images;
mod legend;
mod onion;
mod page;
#[cfg(feature = "panels")]
pub(crate) mod parts;
#[cfg(feature = "pictures")]
mod pixels;
mod points;
mod pose_row;
mod preview;
mod px;
mod shared;
mod sheet;
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

pub use crate::motion::Camera;
pub(crate) use canvas::escaped;
pub use contact_sheet::ContactSheet;
#[cfg(feature = "pdf")]
pub use convert::pdf_from_svg;
#[cfg(feature = "pictures")]
pub use convert::png_from_svg;
pub use figure::FigureBody;
pub use flipbook::FlipBook;
pub use heat::HeatMap;
pub use hierarchy::SkeletonPlot;
pub use images::NumberedImages;
pub use onion::OnionSkin;
pub use pose_row::PoseRow;
pub use preview::Preview;
pub use sheet::SheetPlot;
pub use spacing::SpacingPlot;
pub use speed::{SpeedCurves, SpeedPlot};
pub use ssd::SsdPlot;
pub use strip::Strip;
pub use study_chart::StudyPlot;
pub use xsheet::{HoldLine, InbetweenMark, XSheet};
