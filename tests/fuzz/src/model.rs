//! Runs the check of `targets/model.rs` on inputs of libFuzzer.

#![no_main]

mod measure;
#[path = "../targets/model.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::check(bytes));
