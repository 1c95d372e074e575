//! The one place that asks which processor this is.

use std::ops::Range;

/// Turns of a long loop that are one call of [`wide`].
const PIECE: usize = 8;

/// A long loop in pieces, each for one call of [`wide`]: a browser makes a function quick only from one call to the next,
/// and one call for all of it would be slow to its end.
pub(crate) fn pieces(turns: usize) -> impl DoubleEndedIterator<Item = Range<usize>> {
    (0..turns.div_ceil(PIECE)).map(move |piece| PIECE * piece..turns.min(PIECE * (piece + 1)))
}

/// Does some work on lanes with registers of four numbers, where the processor has them.
///
/// The work is compiled twice, and what is to be wide must be inlined into it: `#[inline(always)]`
/// before the closure and before the functions it calls. Both give the same bits, as each operation is
/// rounded by itself whatever the register: the compiler fuses none of its own accord.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
#[inline]
pub(crate) fn wide<T>(work: impl FnOnce() -> T) -> T {
    use fearless_simd::{Level, Simd};
    #[cfg(test)]
    if narrow::is_asked_for() {
        return work();
    }
    // Not AVX-512: four lanes gain nothing by it, and eight would not fit the few koma between two keys.
    match Level::new().as_avx2() {
        Some(avx2) => avx2.vectorize(work),
        None => work(),
    }
}

/// Elsewhere the registers that every processor has are the widest. Never inlined: see [`pieces`].
#[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
#[inline(never)]
pub(crate) fn wide<T>(work: impl FnOnce() -> T) -> T {
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

    /// Does some work as a processor without wide registers would.
    pub(crate) fn narrow<T>(work: impl FnOnce() -> T) -> T {
        ASKED_FOR.set(true);
        let done = work();
        ASKED_FOR.set(false);
        done
    }
}
