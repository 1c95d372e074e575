//! Sines, powers and logarithms that are the same on every processor, as they are compiled into genga.
//!
//! Those of the standard library are the system's, which picks them by processor: their last digits differ where a product
//! and a sum are one instruction. `clippy.toml` forbids them. Square roots are exact everywhere and stay. Lots are drawn here too.

mod lot;

pub(crate) use libm::{
    acos, asin, atan, atan2, cos, erfc, exp, hypot, log as ln, log10, sin, sincos as sin_cos, tan,
};
pub(crate) use lot::{Lots, mixed};

/// The middle of some values, the mean of both middles for an even number; none of none.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    let (low, high) = (values.get(values.len().saturating_sub(1) / 2)?, values[values.len() / 2]);
    Some(f64::midpoint(*low, high))
}
