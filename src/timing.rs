//! **Time** (時間を割る): spacing (詰め) puts drawings on the sheet, naka-nashi (中無し) and koma-dori
//! (コマ撮り) leave some out, and a person holds what they want held.

mod amount;
mod gauge;
mod holds;
mod koma_dori;
mod naka_nashi;
mod omission;
mod on;
mod report;
mod spacing;
mod stills;
mod strip;
mod tournament;

#[cfg(test)]
mod tests;

pub use amount::Amount;
pub use gauge::{Gauge, Packing, fraction};
pub use holds::{held_for, with_holds};
pub use omission::{Course, Omission, Omitted, Order};
pub use on::{On, Pace};
pub use report::{Gone, OmissionReport, Shortfall, StageReport};
pub(crate) use spacing::alike;
pub use spacing::{InbetweenSource, Pull, Spaced, Spacing};
pub use stills::Stills;
