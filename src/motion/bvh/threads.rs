//! Runs jobs in parallel, so that several threads read the parts of a large file.

use std::num::NonZero;
use std::thread;

/// Number of bytes worth a thread of their own.
pub(super) const PART: u64 = 4 << 20;

/// The best number of parts for this many bytes on this machine.
pub(super) fn parts(bytes: u64) -> usize {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    threads.min((bytes / PART) as usize).max(1)
}

/// Runs each job in a thread of its own, and returns their results in order.
pub(super) fn all<T: Send>(jobs: impl Iterator<Item: FnOnce() -> T + Send>) -> Vec<T> {
    thread::scope(|scope| {
        let threads: Vec<_> = jobs.map(|job| scope.spawn(job)).collect();
        let result = |thread: thread::ScopedJoinHandle<'_, T>| {
            thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        threads.into_iter().map(result).collect()
    })
}
