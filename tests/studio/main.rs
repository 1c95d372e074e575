//! The studio without a window: every control by its name, every key, and pictures of it.
//!
//! The harness itself fails a test if a letter has no glyph or a control has no name.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

mod corrected; // keys by hand: on the keyboard, on the sheet, over the curves
mod day; // a minute of motion from loading to reopening, in ten pictures
mod desk; // files in memory, and a disk that is full
mod difference; // what a change made of the sheet, before and after it
mod footage; // pictures and sound that were recorded beside the motion
mod goals; // three goals and presets, and the program's own results
mod harness; // a studio with a clip on the table
mod kept_numbers; // numbers of drawings that stay from export to export
mod keyboard; // every act without a mouse
mod knobs; // expert settings, undone and redone
mod layered; // several columns, each with its own pins
mod leaving; // unsaved work when another clip is opened or the window closed
mod local; // frozen genga, a part found again, genga copied, two sheets
mod passages; // rounds of a loop, and marked ranges with goals of their own
mod pictures; // pictures of the studio, compared with the documentation
#[path = "../real/mod.rs"]
mod real; // clips that are not in the repository
mod regressions; // behaviour that once was rough: quick input, menus, notices, Japanese
mod saving; // saved, opened, recovered, exported
mod seen; // play, step, loop, flip, look from a side
mod software_renderer; // a renderer without a graphics card
mod spoken; // lines of the S column
mod start; // the built-in clip and the tour
mod strip; // genga as figures over time: chosen, dragged, pinned, forbidden, held, played
mod window_sizes; // small windows, and screens with many pixels a point
