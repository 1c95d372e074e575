//! Sines, powers and logarithms that are the same on every processor, as they are compiled into genga.
//!
//! Those of the standard library are the system's, which picks them by processor: their last digits differ where a product
//! and a sum are one instruction. `clippy.toml` forbids them. Square roots are exact everywhere and stay.

pub(crate) use libm::{
    acos, asin, atan, atan2, cos, exp, hypot, log as ln, log10, sin, sincos as sin_cos, tan,
};
