//! Memory and time of one call: what libFuzzer itself cannot see on stable Rust.
//!
//! Its `-malloc_limit_mb` needs the hooks of a sanitizer's runtime, and its slowest unit is told in
//! whole seconds. So the memory is counted here, by the allocator, and held against the input's size.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

/// Bytes of memory that a call may take for each byte of its input.
const MULTIPLE: usize = 64;

/// Bytes that it may take for nothing.
const FREE: usize = 64 << 10;

struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static SLOWEST: AtomicU64 = AtomicU64::new(0);
static LARGEST: AtomicUsize = AtomicUsize::new(0);

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call is handed to the system's allocator as it is; only sizes are noted.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let now = NOW.fetch_add(layout.size(), Relaxed) + layout.size();
        PEAK.fetch_max(now, Relaxed);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        NOW.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's promise is passed on.
        unsafe { System.dealloc(at, layout) }
    }
}

/// Runs it and panics when it took more memory than the input's size allows. Says so on stderr when it
/// was the slowest, or took the largest multiple, up to now.
pub fn measured<T>(size: usize, call: impl FnOnce() -> T) -> T {
    let before = NOW.load(Relaxed);
    PEAK.store(before, Relaxed);
    let start = Instant::now();
    let result = call();
    let micros = start.elapsed().as_micros() as u64;
    let taken = PEAK.load(Relaxed) - before;
    assert!(taken <= MULTIPLE * size + FREE, "{taken} bytes of memory for an input of {size}");
    if SLOWEST.fetch_max(micros, Relaxed) < micros {
        eprintln!("slowest: {micros} us for {size} bytes");
    }
    // A small input tells nothing: a String alone has 24 bytes.
    let multiple = 100 * taken / size.max(1);
    if size >= 256 && LARGEST.fetch_max(multiple, Relaxed) < multiple {
        eprintln!("memory: {}.{:02} times {size} bytes", multiple / 100, multiple % 100);
    }
    result
}
