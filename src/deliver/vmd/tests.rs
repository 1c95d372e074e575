//! The motion for MMD, as a file and as a body.

mod body;
mod file;
mod given;
mod names;
mod reader;
mod rests;
mod structure;
