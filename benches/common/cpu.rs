//! The time that a thread works, without the time that it waits for others.

use std::fs;
use std::thread;
use std::time::Instant;

/// Nanoseconds that this thread has run; those since `begin` where the system does not tell.
pub(crate) fn nanos(begin: Instant) -> f64 {
    // The system brings its account up to date when a thread yields, and otherwise a few times a second.
    thread::yield_now();
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let ran = told.as_deref().and_then(|text| text.split(' ').next()?.parse().ok());
    ran.unwrap_or_else(|| begin.elapsed().as_nanos() as f64)
}
