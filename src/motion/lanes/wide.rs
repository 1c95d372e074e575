//! Chooses code by processor; no other module does.

use std::ops::Range;

/// Iterations of a long loop per call of [`wide`].
const PIECE: usize = 8;

/// Splits a long loop into pieces, one per call of [`wide`]. A browser optimizes a function only between two calls,
/// so a single call would stay slow to its end.
pub fn pieces(turns: usize) -> impl DoubleEndedIterator<Item = Range<usize>> {
    (0..turns.div_ceil(PIECE)).map(move |piece| PIECE * piece..turns.min(PIECE * (piece + 1)))
}

/// Runs some work on lanes with registers of four numbers, if the processor has them.
///
/// The work is compiled twice, and everything in it must be inlined to be wide: put `#[inline(always)]` before the
/// closure and before the functions it calls. Both versions give the same bits, because each operation is rounded by
/// itself in any register, and the compiler never fuses operations unasked.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline]
pub fn wide<T>(work: impl FnOnce() -> T) -> T {
    use fearless_simd::{Level, Simd};
    #[cfg(test)]
    if narrow::is_asked_for() {
        return work();
    }
    // AVX-512 is not used: four lanes gain nothing from it, and eight would not fit the few koma between two keys.
    match Level::new().as_avx2() {
        Some(avx2) => avx2.vectorize(work),
        None => work(),
    }
}

/// Runs some work. On these processors the registers of the base architecture are already the widest. Never inlined:
/// see [`pieces`].
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
#[inline(never)]
pub fn wide<T>(work: impl FnOnce() -> T) -> T {
    work()
}

#[cfg(test)]
pub(crate) mod narrow {
    use std::cell::Cell;

    thread_local! {
        static ASKED_FOR: Cell<bool> = const { Cell::new(false) };
    }

    pub(super) fn is_asked_for() -> bool {
        ASKED_FOR.get()
    }

    /// Runs some work as on a processor without wide registers.
    pub(crate) fn narrow<T>(work: impl FnOnce() -> T) -> T {
        ASKED_FOR.set(true);
        let done = work();
        ASKED_FOR.set(false);
        done
    }
}
