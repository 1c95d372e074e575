//! **Time** (時間を割る): spacing (詰め) puts drawings on the sheet, naka-nashi (中無し) and koma-dori
//! (コマ撮り) leave some out.

mod amount;
mod gauge;
mod koma_dori;
mod naka_nashi;
mod omission;
mod on;
mod report;
mod spacing;
mod stills;
mod strip;
mod tournament;

pub use amount::Amount;
pub use gauge::{Gauge, Packing, fraction};
pub use omission::{Omission, Omitted, Order};
pub use on::{On, Pace};
pub use report::{Gone, Report, Shortfall, StageReport};
pub use spacing::{InbetweenSource, Spaced, Spacing};
pub use stills::Stills;
