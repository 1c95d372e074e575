//! Tests of the MMD motion, as a file and as a posed body.

mod body;
mod file;
mod given;
mod keyed;
mod legs;
mod names;
mod passed;
mod reader;
mod rests;
mod structure;
