//! Runs the check of `targets/fbx.rs` on inputs of libFuzzer.

#![no_main]

mod measure;
#[path = "../targets/fbx.rs"]
mod target;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| target::check(bytes));
