//! The memory of this process, as Linux counts it.

use std::fs;

/// Returns the bytes in use now and resets the peak.
pub(crate) fn now() -> usize {
    fs::write("/proc/self/clear_refs", "5").unwrap();
    status("VmRSS:")
}

/// Returns the peak in bytes since the last reset.
pub(crate) fn peak() -> usize {
    status("VmHWM:")
}

/// Reads a line of /proc/self/status, in bytes.
fn status(name: &str) -> usize {
    let text = fs::read_to_string("/proc/self/status").unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix(name)).unwrap();
    1024 * line.trim().trim_end_matches(" kB").parse::<usize>().unwrap()
}
