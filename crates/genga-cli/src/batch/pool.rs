//! Worker threads (人手): they take the largest clip first, and wait if all clips together would exceed the memory
//! budget.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};

use super::super::failure::Failure;

/// Memory of a clip with all its intermediate data, as a multiple of its file size.
const TIMES: u64 = 16;
/// Fixed memory per clip, in bytes.
const LEAST: u64 = 1 << 20;

/// The worker threads and their shared memory budget.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pool {
    /// Number of threads.
    pub(crate) jobs: usize,
    /// Bytes for all clips in progress. A larger clip is worked on alone.
    pub(crate) room: u64,
}

impl Pool {
    /// Runs `work` for each index, in `order` as far as memory allows, until `is_over`.
    pub(crate) fn each(
        &self,
        order: &[usize],
        size: impl Fn(usize) -> u64 + Sync,
        is_over: impl Fn() -> bool + Sync,
        work: impl Fn(usize) + Sync,
    ) -> Result<(), Failure> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(self.jobs).build();
        let pool =
            pool.map_err(|error| Failure::CouldNot(format!("no threads to work with: {error}")))?;
        let (next, room) = (AtomicUsize::new(0), Room::new(self.room));
        // Each thread loops on its own, so that none waits for room while holding some.
        pool.broadcast(|_| {
            while let Some(at) =
                order.get(next.fetch_add(1, Ordering::Relaxed)).filter(|_| !is_over())
            {
                let bytes = room.enter(TIMES * size(*at) + LEAST);
                work(*at);
                room.leave(bytes);
            }
        });
        Ok(())
    }
}

/// The memory budget, in bytes.
struct Room {
    most: u64,
    free: Mutex<u64>,
    left: Condvar,
}

impl Room {
    fn new(most: u64) -> Self {
        Self { most, free: Mutex::new(most), left: Condvar::new() }
    }

    /// Waits until there is room, and returns the number of bytes taken.
    fn enter(&self, bytes: u64) -> u64 {
        let bytes = bytes.min(self.most);
        let free = self.free.lock().unwrap_or_else(PoisonError::into_inner);
        let mut free = self
            .left
            .wait_while(free, |free| *free < bytes)
            .unwrap_or_else(PoisonError::into_inner);
        *free -= bytes;
        bytes
    }

    fn leave(&self, bytes: u64) {
        *self.free.lock().unwrap_or_else(PoisonError::into_inner) += bytes;
        self.left.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicU64;

    #[test]
    fn clips_that_are_worked_on_at_once_have_room_and_each_is_worked_on() {
        let crew = Pool { jobs: 4, room: 10 * (TIMES * 1000 + LEAST) };
        let sizes: Vec<u64> =
            (0..200).map(|at| if at % 50 == 0 { 1_000_000_000 } else { at * 40 }).collect();
        let (taken, most, done) = (AtomicU64::new(0), AtomicU64::new(0), Mutex::new(vec![]));
        let order: Vec<usize> = (0..sizes.len()).collect();
        let work = |at: usize| {
            let bytes = (TIMES * sizes[at] + LEAST).min(crew.room);
            let now = taken.fetch_add(bytes, Ordering::SeqCst) + bytes;
            most.fetch_max(now, Ordering::SeqCst);
            std::thread::yield_now();
            taken.fetch_sub(bytes, Ordering::SeqCst);
            done.lock().unwrap().push(at);
        };
        crew.each(&order, |at| sizes[at], || false, work).unwrap();
        assert!(most.into_inner() <= crew.room);
        let mut done = done.into_inner().unwrap();
        done.sort_unstable();
        assert_eq!(done, order);
    }

    #[test]
    fn it_ends_when_it_is_over() {
        let count = AtomicUsize::new(0);
        let crew = Pool { jobs: 1, room: 1 };
        let is_over = || count.load(Ordering::SeqCst) >= 3;
        crew.each(&[0; 9], |_| 1, is_over, |_| _ = count.fetch_add(1, Ordering::SeqCst)).unwrap();
        assert_eq!(count.into_inner(), 3);
    }
}
