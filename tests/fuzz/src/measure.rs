//! Measures memory and time of one call, which libFuzzer itself cannot do on stable Rust.
//!
//! Its `-malloc_limit_mb` needs the hooks of a sanitizer's runtime, and its slowest unit is reported in whole seconds.
//! So the allocator counts the memory here, and it is compared with a bound.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering::Relaxed};
use std::time::Instant;

struct Counting;

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);
static SLOWEST: AtomicU64 = AtomicU64::new(0);
static LARGEST: AtomicUsize = AtomicUsize::new(0);

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call is passed to the system's allocator unchanged; only sizes are noted.
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

/// Bytes of memory that a call may take, and the unit in which multiples are reported.
pub struct Bound {
    pub most: usize,
    pub unit: usize,
}

/// Runs `call` on an input of `size` bytes, and panics if it took more memory than the bound. Reports on stderr if it
/// was the slowest so far, or took the largest multiple.
pub fn measured<T>(size: usize, Bound { most, unit }: Bound, call: impl FnOnce() -> T) -> T {
    let before = NOW.load(Relaxed);
    PEAK.store(before, Relaxed);
    let start = Instant::now();
    let result = call();
    let micros = start.elapsed().as_micros() as u64;
    let taken = PEAK.load(Relaxed) - before;
    assert!(
        taken <= most,
        "{taken} bytes of memory for an input of {size}, and {most} are allowed"
    );
    if SLOWEST.fetch_max(micros, Relaxed) < micros {
        eprintln!("slowest: {micros} us for {size} bytes");
    }
    // A small input says little: a String alone has 24 bytes.
    let multiple = 100 * taken / unit.max(1);
    if unit >= 256 && LARGEST.fetch_max(multiple, Relaxed) < multiple {
        eprintln!("memory: {}.{:02} times {unit} bytes", multiple / 100, multiple % 100);
    }
    result
}
