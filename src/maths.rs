//! Sines, powers and logarithms that are the same on every processor, because they are compiled into genga.
//!
//! The standard library calls the system's functions, which are picked by processor: their last digits differ where a
//! product and a sum are one instruction. `clippy.toml` forbids them. Square roots are exact everywhere and stay.
//! Random numbers are drawn here too.

mod random;

pub use libm::{
    acos, asin, atan, atan2, cos, erfc, exp, hypot, log as ln, log10, sin, sincos as sin_cos, tan,
};
pub use random::{Lots, mixed};

/// Returns the median, averaging the middle two of an even number of values; `None` if there are none.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut values: Vec<f64> = values.into_iter().collect();
    values.sort_by(f64::total_cmp);
    let (low, high) = (values.get(values.len().saturating_sub(1) / 2)?, values[values.len() / 2]);
    Some(f64::midpoint(*low, high))
}
