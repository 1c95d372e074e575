//! The memory of this process, as Linux counts it.

use std::fs;

/// Bytes that it has now; from here on its peak is counted anew.
pub(crate) fn now() -> usize {
    fs::write("/proc/self/clear_refs", "5").unwrap();
    status("VmRSS:")
}

/// The most bytes that it had since then.
pub(crate) fn peak() -> usize {
    status("VmHWM:")
}

/// A line of /proc/self/status, in bytes.
fn status(name: &str) -> usize {
    let text = fs::read_to_string("/proc/self/status").unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix(name)).unwrap();
    1024 * line.trim().trim_end_matches(" kB").parse::<usize>().unwrap()
}
