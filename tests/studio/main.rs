//! The studio without a window: every control by its name, every key, and pictures of it.
//!
//! The harness fails a test by itself where a letter has no glyph or a control has no name.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

mod at_ease; // what once was rough: quick hands, menus, notices, Japanese
mod beside; // pictures and sound that were recorded beside the motion
mod corrected; // keys by hand: on the keyboard, on the sheet, over the curves
mod day; // a minute of motion from loading to reopening, in ten pictures
mod desk; // files in memory, and a disk that is full
mod kept; // saved, opened, recovered, exported
mod keyboard; // every act without a mouse
mod layered; // several columns, each with its own pins
mod local; // frozen genga, a part found again, genga copied, two sheets
mod pictures; // what it looks like
#[path = "../real/mod.rs"]
mod real; // clips that are not in the repository
mod scaled; // small windows, and screens with many pixels a point
mod seen; // play, step, loop, flip, look from a side
mod soft; // a renderer without a graphics card
mod spoken; // lines of the S column
mod table; // a studio with a clip on the table
mod turned; // knobs and presets, undone and redone
