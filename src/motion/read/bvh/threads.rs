//! Large files are read by several threads, each its own part.

use std::num::NonZero;
use std::thread;

/// Bytes that are worth a thread of their own.
pub(super) const PART: u64 = 4 << 20;

/// Into how many parts so many bytes are best divided on this machine.
pub(super) fn parts(bytes: u64) -> usize {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    threads.min((bytes / PART) as usize).max(1)
}

/// What the jobs give, each done in a thread of its own.
pub(super) fn all<T: Send>(jobs: impl Iterator<Item: FnOnce() -> T + Send>) -> Vec<T> {
    thread::scope(|scope| {
        let threads: Vec<_> = jobs.map(|job| scope.spawn(job)).collect();
        let result = |thread: thread::ScopedJoinHandle<'_, T>| {
            thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        threads.into_iter().map(result).collect()
    })
}
