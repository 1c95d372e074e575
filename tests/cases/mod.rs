//! How many cases a heavy property test takes.

#![allow(dead_code, reason = "no test program needs all of it")]

/// Whether all cases are to be tried.
pub(crate) fn is_full() -> bool {
    std::env::var("GENGA_CASES").is_ok_and(|word| word == "all")
}

/// `quick` cases, or `all` of them where `GENGA_CASES` is `all`, as in `.ci/full`.
pub(crate) fn cases(quick: u32, all: u32) -> proptest::test_runner::Config {
    proptest::test_runner::Config::with_cases(if is_full() { all } else { quick })
}
