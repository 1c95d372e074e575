//! Runs the check of `targets/read.rs` on inputs of libFuzzer.

#![no_main]

mod measure;
#[path = "../targets/read.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::check(bytes));
