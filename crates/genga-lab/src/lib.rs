//! **Judge** (評価): studies of many recipes, and measures of the quality of a sheet.

// Tests may compare with the standard library.
#![cfg_attr(test, allow(clippy::disallowed_methods))]

pub mod quality;
pub mod study;

#[cfg(test)]
#[path = "../../../tests/cases/mod.rs"]
mod cases;
