//! CPU time of a thread, without the time that it waits.

use std::fs;
use std::thread;
use std::time::Instant;

/// Nanoseconds that this thread has run, or wall time since `begin` if the system does not report it.
pub(crate) fn nanos(begin: Instant) -> f64 {
    // Linux updates its account when a thread yields, and otherwise only a few times a second.
    thread::yield_now();
    let told = fs::read_to_string("/proc/thread-self/schedstat").ok();
    let ran = told.as_deref().and_then(|text| text.split(' ').next()?.parse().ok());
    ran.unwrap_or_else(|| begin.elapsed().as_nanos() as f64)
}
