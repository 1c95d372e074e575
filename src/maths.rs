//! Sines, powers and logarithms that are the same on every processor, as they are compiled into genga.
//!
//! Those of the standard library are the system's, which picks them by processor: their last digits differ where a product
//! and a sum are one instruction. `clippy.toml` forbids them. Square roots are exact everywhere and stay. Lots are drawn here too.

mod lot;

pub(crate) use libm::{
    acos, asin, atan, atan2, cos, erfc, exp, hypot, log as ln, log10, sin, sincos as sin_cos, tan,
};
pub(crate) use lot::{Lots, mixed};
