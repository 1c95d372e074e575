//! **Time** (時間を割る): spacing (詰め) puts drawings on the sheet, naka-nashi (中無し) and koma-dori (コマ撮り) leave some out, and
//! a person's holds are applied last.

mod amount;
mod by_passage;
mod drawing_list;
mod gauge;
mod holds;
mod koma_dori;
mod koma_per_drawing;
mod naka_nashi;
mod omission;
mod report;
mod spacing;
mod stills;
mod tournament;

#[cfg(test)]
mod tests;

pub use amount::Amount;
pub use by_passage::ByPassage;
pub use gauge::{Gauge, Packing, fraction};
pub use holds::{held_for, is_of_last, owed_at_end, with_holds};
pub use koma_per_drawing::{On, Pace};
pub use omission::{Course, Omission, Omitted, Order};
pub use report::{Gone, OmissionReport, Shortfall, StageReport};
pub(crate) use spacing::alike;
pub use spacing::{InbetweenSource, Pull, Spaced, Spacing};
pub use stills::Stills;
