//! What `targets/model.rs` checks, on what libFuzzer makes up.

#![no_main]

mod measure;
#[path = "../targets/model.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::check(bytes));
